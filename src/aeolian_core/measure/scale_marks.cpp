#include "aeolian_core/measure/scale_marks.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace aeolian {
namespace {

constexpr double to_mm = 1e3;

using Marks = std::vector<PhotoSetup::ScaleMark>;

std::optional<MarkFault> doubled(const Marks& marks) {
  for (std::size_t i = 0; i < marks.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const bool same_place = marks[i].x == marks[j].x && marks[i].y == marks[j].y;
      if (marks[i].pixel == marks[j].pixel)
        return MarkFault{i, fmt::format("has the pixel of mark {}, must be another", j)};
      if (same_place) return MarkFault{i, fmt::format("is the same mark as {}, at another pixel", j)};
    }
  return std::nullopt;
}

/// One row of marks, in order of x.
std::optional<MarkFault> fault_in_row(const Marks& marks, std::vector<std::size_t> row) {
  std::stable_sort(row.begin(), row.end(),
                   [&](std::size_t a, std::size_t b) { return marks[a].x < marks[b].x; });
  const Eigen::Vector2d along = marks[row.back()].pixel - marks[row.front()].pixel;
  double scale_before = 0;
  for (std::size_t i = 1; i < row.size(); ++i) {
    const PhotoSetup::ScaleMark& before = marks[row[i - 1]];
    const PhotoSetup::ScaleMark& mark = marks[row[i]];
    const Eigen::Vector2d step = mark.pixel - before.pixel;
    if (step.dot(along) <= 0)
      return MarkFault{row[i],
                       fmt::format("lies the wrong way from x = {:g} mm: x must rise or fall along a row",
                                   to_mm * before.x)};
    const double scale = step.norm() / (mark.x - before.x);
    constexpr double largest_change = 2;
    if (scale_before > 0 && std::max(scale / scale_before, scale_before / scale) > largest_change)
      return MarkFault{
          row[i], fmt::format("makes {:.3g} px per mm after {:.3g} between the marks before, must not change "
                              "by more than a factor of {:g}",
                              scale / to_mm, scale_before / to_mm, largest_change)};
    scale_before = scale;
  }
  return std::nullopt;
}

}  // namespace

std::optional<MarkFault> contradiction(const Marks& marks) {
  if (marks.size() < 2) return MarkFault{0, "is the only mark, there must be at least two"};
  if (auto fault = doubled(marks)) return fault;
  std::map<std::optional<double>, std::vector<std::size_t>> rows;
  for (std::size_t i = 0; i < marks.size(); ++i) rows[marks[i].y].push_back(i);
  bool spread = false;
  for (const auto& [y, row] : rows) {
    if (row.size() < 2) continue;
    spread = true;
    if (auto fault = fault_in_row(marks, row)) return fault;
  }
  if (!spread && std::all_of(marks.begin(), marks.end(), [&](const auto& m) { return m.x == marks[0].x; }))
    return MarkFault{0, "has the x of all others, there must be two different"};
  return std::nullopt;
}

}  // namespace aeolian
