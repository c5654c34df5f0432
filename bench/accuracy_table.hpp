#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace aeolian {

/// The rows of a page of docs/accuracy: what should be, what is, how far apart they may be and how well ours
/// is known. Printed as Markdown, with a count of what holds above the tables.
///
///     AccuracyTable table;
///     table.section("Rebound model", "Spec 5.6; 20 000 rays.");
///     table.row("mean eps_iy, 15 degrees", 0.969, 0.970, 0.005, 0.0003);
///     fmt::print("{}", table.markdown());
class AccuracyTable {
 public:
  /// The rows that follow stand under this heading and these words.
  void section(const std::string& title, const std::string& words = "") {
    sections_.push_back({title, words, {}});
  }

  /// Holds where `ours` is within `tolerance` of `target`, all of the same unit. `error`: standard error of
  /// ours, zero where nothing was drawn.
  void row(const std::string& what, double target, double ours, double tolerance, double error = 0) {
    add(what, fmt::format("{:.4g}", target), number(ours, error), fmt::format("± {:.2g}", tolerance), error,
        std::abs(ours - target) <= tolerance);
  }
  /// The same with a tolerance in parts of the target.
  void relative_row(const std::string& what, double target, double ours, double part, double error = 0) {
    add(what, fmt::format("{:.4g}", target), number(ours, error), fmt::format("± {:g} %", 100 * part), error,
        std::abs(ours - target) <= part * std::abs(target));
  }
  /// Holds where `ours` lies from `low` to `high`.
  void range_row(const std::string& what, double low, double high, double ours, double error = 0) {
    add(what, fmt::format("{:.4g} to {:.4g}", low, high), number(ours, error), "within", error,
        low <= ours && ours <= high);
  }
  /// A statement that holds or does not; `ours` tells the figures.
  void statement(const std::string& what, const std::string& ours, bool holds) {
    add(what, "", ours, "", 0, holds);
  }
  /// Only told, not judged: what has no agreed target.
  void remark(const std::string& what, double target, double ours, double error = 0) {
    current().rows.push_back(
        {what, fmt::format("{:.4g}", target), number(ours, error), "", told(error), "told"});
  }

  std::string markdown() const {
    std::string text = fmt::format("{} of {} hold.\n", held_, judged_);
    for (const Section& section : sections_) {
      text += fmt::format("\n## {}\n\n", section.title);
      if (!section.words.empty()) text += section.words + "\n\n";
      if (section.rows.empty()) continue;
      text +=
          "| what | target | ours | tolerance | statistical error | verdict |\n|---|---|---|---|---|---|\n";
      for (const Row& r : section.rows)
        text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", r.what, r.target, r.ours, r.tolerance,
                            r.error, r.verdict);
    }
    return text;
  }

 private:
  struct Row {
    std::string what, target, ours, tolerance, error, verdict;
  };
  struct Section {
    std::string title, words;
    std::vector<Row> rows;
  };

  static std::string told(double error) { return error > 1e-12 ? fmt::format("{:.1g}", error) : ""; }
  /// With as many digits as the error leaves.
  static std::string number(double value, double error) {
    if (!(error > 1e-5 * std::abs(value)) || value == 0) return fmt::format("{:.4g}", value);
    const int digits =
        static_cast<int>(std::floor(std::log10(std::abs(value))) - std::floor(std::log10(error)));
    return fmt::format("{:.{}g}", value, std::max(2, digits + 1));
  }

  Section& current() {
    if (sections_.empty()) section("Rows");
    return sections_.back();
  }
  void add(const std::string& what, const std::string& target, const std::string& ours,
           const std::string& tolerance, double error, bool holds) {
    ++judged_;
    held_ += holds ? 1 : 0;
    current().rows.push_back({what, target, ours, tolerance, told(error), holds ? "holds" : "**misses**"});
  }

  std::vector<Section> sections_;
  int judged_ = 0;
  int held_ = 0;
};

}  // namespace aeolian
