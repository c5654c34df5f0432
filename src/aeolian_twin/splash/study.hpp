#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "aeolian_core/grains/impacts/impact_statistics.hpp"
#include "aeolian_twin/splash/study_journal.hpp"
#include "aeolian_twin/splash/study_settings.hpp"

namespace aeolian {

/// The beds of a study, in the order of its kinds.
template <int Dim>
struct StudyBeds {
  std::vector<std::vector<Bed<Dim>>> kinds;
  double roughness(std::size_t kind) const;  ///< mean over its beds
};

/// What the impacts of one speed, angle and size ratio on one kind of bed did.
struct StudyPoint {
  std::size_t kind;  ///< of bed
  double speed;      ///< [m/s]
  double angle;      ///< [rad]
  double size_ratio;
  double roughness;  ///< of the beds
  std::vector<ImpactOutcome> outcomes;
  ImpactStatistics statistics;
};

/// Told how much of the whole is done, 0 to 1, and with what the program is busy.
using StudyProgress = std::function<void(double share, const std::string& task)>;

/// Lays the beds on all threads. Gives fewer of them, whole kinds, when `stop` becomes true.
template <int Dim>
StudyBeds<Dim> lay_beds(const StudySettings& study, const StudyProgress& progress,
                        const std::atomic<bool>& stop);

/// Fires all impacts but those of the journal, which it keeps; when `stop` becomes true, the result has what
/// is done.
template <int Dim>
std::vector<StudyPoint> fire_all(const StudySettings& study, const StudyBeds<Dim>& beds,
                                 StudyJournal& journal, const StudyProgress& progress,
                                 const std::atomic<bool>& stop);

extern template struct StudyBeds<2>;
extern template struct StudyBeds<3>;
extern template StudyBeds<2> lay_beds(const StudySettings&, const StudyProgress&, const std::atomic<bool>&);
extern template StudyBeds<3> lay_beds(const StudySettings&, const StudyProgress&, const std::atomic<bool>&);
extern template std::vector<StudyPoint> fire_all(const StudySettings&, const StudyBeds<2>&, StudyJournal&,
                                                 const StudyProgress&, const std::atomic<bool>&);
extern template std::vector<StudyPoint> fire_all(const StudySettings&, const StudyBeds<3>&, StudyJournal&,
                                                 const StudyProgress&, const std::atomic<bool>&);

}  // namespace aeolian
