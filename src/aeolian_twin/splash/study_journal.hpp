#pragma once

#include <cstddef>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "aeolian_core/grains/impacts/impact.hpp"

namespace aeolian {

/// The impacts of a study as they are done: a file beside its results until the study has finished, so that
/// the same command goes on from there, whatever has ended it. Results do not tell whether it was.
///
///     StudyJournal journal("case_a", settings);
///     for (each impact that journal.done(point) does not have) journal.add(point, outcome);
///     journal.finish();
class StudyJournal {
 public:
  /// Reads the journal of the folder, or begins one; `fresh`: begins one in any case. `settings` are lines of
  /// text that decide the impacts. Throws Error naming the file where it is of other settings, or holds what
  /// no study has written but for a last line that was cut short.
  StudyJournal(const std::string& folder, const std::string& settings, bool fresh);

  /// Impacts of a point of the study, by number.
  std::vector<ImpactOutcome> done(std::size_t point) const;
  std::size_t count() const;  ///< of all points

  /// Throws Error where the file cannot be written.
  void add(std::size_t point, const ImpactOutcome& outcome);
  /// Removes the file: the study's results are written.
  void finish();

 private:
  void read(const std::string& text);

  std::string path_;
  std::map<std::size_t, std::map<int, ImpactOutcome>> points_;
  std::ofstream file_;
};

}  // namespace aeolian
