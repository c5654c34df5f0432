#include "aeolian_core/measure/ripple_crests.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "aeolian_core/measure/crest_links.hpp"
#include "aeolian_core/surface/median.hpp"

namespace aeolian {
namespace {

constexpr float none = std::numeric_limits<float>::quiet_NaN();
constexpr double end_margin = 0.6;  ///< wavelengths about an end in which all must be seen

using Line = std::vector<RowPlace>;

/// Finds lines among the maxima of the rows and gives them their shapes and ends.
class CrestFinder {
 public:
  CrestFinder(RippleRelief relief, double grain_diameter) {
    result_.relief = std::move(relief);
    const RippleRelief& r = result_.relief;
    wavelength_ = r.pattern.wavelength / r.cell;
    double squares = 0;
    std::size_t seen = 0;
    for (std::size_t i = 0; i < r.height.size(); ++i) {
      if (r.clearance[i] <= 0) continue;
      squares += static_cast<double>(r.height[i] * r.height[i]);
      ++seen;
      if (static_cast<double>(r.clearance[i]) >= end_margin * r.pattern.wavelength)
        result_.searched_area += r.cell * r.cell;
    }
    const double relief_height =
        2 * std::sqrt(2 * squares / static_cast<double>(std::max<std::size_t>(seen, 1)));
    prominence_ = std::max({4 * r.noise, relief_height / 12, 0.5 * grain_diameter});
  }

  RippleCrests find() {
    const RippleRelief& r = result_.relief;
    for (int row = 0; row < r.rows; ++row) rows_.push_back(row_crests(r, row, prominence_));
    lines_ = link_rows(rows_, wavelength_, static_cast<int>(0.4 * wavelength_));
    lines_.erase(
        std::remove_if(lines_.begin(), lines_.end(), [&](const Line& line) { return !counts(line); }),
        lines_.end());
    lines_ = join_facing(rows_, lines_, 0.5 * wavelength_);
    keep_lines();
    for (std::size_t line = 0; line < lines_.size(); ++line) shape(line);
    return std::move(result_);
  }

 private:
  const RowCrest& crest(RowPlace p) const {
    return rows_[static_cast<std::size_t>(p.row)][static_cast<std::size_t>(p.crest)];
  }
  Eigen::Vector2d point(RowPlace p) const {
    return result_.relief.point(p.row, static_cast<double>(crest(p).place));
  }

  bool counts(const Line& line) const {
    const Eigen::Vector2d chord = point(line.back()) - point(line.front());
    if (chord.norm() < 0.5 * result_.relief.pattern.wavelength) return false;
    std::vector<float> prominence;
    for (const RowPlace& p : line) {
      const float value = crest(p).prominence;
      if (std::isfinite(value)) prominence.push_back(value);
    }
    // A crest whose flanks are both cut off may be anything: what is seen of it has to do.
    return prominence.empty() || static_cast<double>(median(std::move(prominence))) >= 1.5 * prominence_;
  }

  /// Forgets the maxima of lines that do not count.
  void keep_lines() {
    kept_.resize(rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i) kept_[i].assign(rows_[i].size(), false);
    for (const Line& line : lines_)
      for (const RowPlace& p : line)
        kept_[static_cast<std::size_t>(p.row)][static_cast<std::size_t>(p.crest)] = true;
  }

  /// The next crest of a row that belongs to a line, `step` +1 downwind, -1 upwind, over seen ground.
  const RowCrest* neighbour(RowPlace p, int step) const {
    const auto& row = rows_[static_cast<std::size_t>(p.row)];
    const auto& kept = kept_[static_cast<std::size_t>(p.row)];
    for (int c = p.crest + step; c >= 0 && c < static_cast<int>(row.size()); c += step) {
      const auto at = static_cast<std::size_t>(c);
      if (row[at].stretch != crest(p).stretch) return nullptr;
      if (kept[at]) return &row[at];
    }
    return nullptr;
  }

  /// Samples that a line goes downwind per row, about one of its points: the slope of its chord over half a
  /// wavelength.
  double drift(const Line& line, std::size_t at) const {
    const int reach = std::max(1, static_cast<int>(wavelength_ / 4));
    std::size_t first = at;
    std::size_t last = at;
    while (first > 0 && line[at].row - line[first - 1].row <= reach) --first;
    while (last + 1 < line.size() && line[last + 1].row - line[at].row <= reach) ++last;
    if (first == last) return 0;
    return static_cast<double>(crest(line[last]).place - crest(line[first]).place) /
           (line[last].row - line[first].row);
  }

  CrestSection section(const Line& line, std::size_t at) const {
    const RowCrest& c = crest(line[at]);
    const double turn = -std::atan(drift(line, at));
    const auto narrowed = static_cast<float>(std::cos(turn));
    const auto metres = static_cast<float>(result_.relief.cell) * narrowed;
    const RowCrest* next = neighbour(line[at], 1);
    CrestSection s;
    s.turn = static_cast<float>(turn);
    s.spacing = next ? metres * (next->place - c.place) : none;
    s.stoss_length = metres * (c.place - c.upwind_trough);
    s.lee_length = metres * (c.downwind_trough - c.place);
    s.height = c.height - (c.upwind_floor * s.lee_length + c.downwind_floor * s.stoss_length) /
                              (s.stoss_length + s.lee_length);
    s.stoss_mean = std::atan((c.height - c.upwind_floor) / s.stoss_length);
    s.lee_mean = std::atan((c.height - c.downwind_floor) / s.lee_length);
    s.stoss_max = std::atan(c.steepest_rise / narrowed);
    s.lee_max = std::atan(c.steepest_fall / narrowed);
    return s;
  }

  /// Whether a neighbour that is not far stands about as high as the end of a line.
  bool runs_into_neighbour(RowPlace end) const {
    const RowCrest& c = crest(end);
    for (const int step : {-1, 1}) {
      const RowCrest* other = neighbour(end, step);
      if (other && std::abs(other->place - c.place) <= 0.8 * wavelength_ && c.height > 0.4F * other->height)
        return true;
    }
    return false;
  }

  CrestEnd end_kind(RowPlace end) const {
    const double clearance = result_.relief.clearance_at(point(end));
    if (clearance < end_margin * result_.relief.pattern.wavelength) return CrestEnd::unseen;
    return runs_into_neighbour(end) ? CrestEnd::junction : CrestEnd::termination;
  }

  void shape(std::size_t number) {
    const Line& line = lines_[number];
    CrestLine result;
    std::vector<float> heights;
    for (std::size_t i = 0; i < line.size(); ++i) {
      result.points.push_back(point(line[i]));
      if (i > 0) result.length += (result.points[i] - result.points[i - 1]).norm();
      result.sections.push_back(section(line, i));
      if (std::isfinite(result.sections.back().height)) heights.push_back(result.sections.back().height);
    }
    result.height = static_cast<double>(median(std::move(heights)));
    result.right = end_kind(line.front());
    result.left = end_kind(line.back());
    if (result.right != CrestEnd::unseen)
      result_.defects.push_back({result.points.front(), result.right, true});
    if (result.left != CrestEnd::unseen)
      result_.defects.push_back({result.points.back(), result.left, false});
    result_.crests.push_back(std::move(result));
  }

  RippleCrests result_;
  double wavelength_ = 0;  ///< [samples]
  double prominence_ = 0;  ///< [m]
  std::vector<std::vector<RowCrest>> rows_;
  std::vector<std::vector<bool>> kept_;
  std::vector<Line> lines_;
};

}  // namespace

RippleCrests find_crests(const GridGeometry& g, const HeightMap::Layer& elevation, double direction,
                         double grain_diameter) {
  auto relief = ripple_relief(g, elevation, direction);
  if (!relief) return {};
  return CrestFinder(std::move(*relief), grain_diameter).find();
}

}  // namespace aeolian
