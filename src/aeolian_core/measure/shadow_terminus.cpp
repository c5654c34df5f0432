#include "aeolian_core/measure/shadow_terminus.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "aeolian_core/surface/golden_section.hpp"
#include "aeolian_core/surface/median.hpp"

namespace aeolian {
namespace {

constexpr double edge_px = 2.5;  // beside the bright bar, not looked at

double normal_distribution(double t) { return 0.5 * std::erfc(-t * M_SQRT1_2); }
double normal_density(double t) { return std::exp(-0.5 * t * t) * 0.3989422804014327; }

/// Light across the rough border, station by station; rows run away from the edge, one pixel apart.
struct Strips {
  int rows = 0;              // of each strip; the middle one lies on the rough border
  std::vector<double> x, y;  // of the middle of the strip on the plane of the top face [m]
  std::vector<float> light;  // rows of all strips, NaN where not to be looked at

  std::size_t size() const { return x.size(); }
  const float* strip(std::size_t k) const { return &light[k * static_cast<std::size_t>(rows)]; }
  double offset(int row) const { return row - (rows - 1) / 2; }
};

/// Rough border at x by linear interpolation; nothing where a neighbour is missing.
std::optional<double> rough_at(const RoughTerminus& rough, double x) {
  const double at = (x - rough.start) / rough.step;
  const auto i = static_cast<std::ptrdiff_t>(std::floor(at));
  if (i < 0 || i + 1 >= static_cast<std::ptrdiff_t>(rough.y.size())) return {};
  const double t = at - static_cast<double>(i);
  const double y =
      (1 - t) * rough.y[static_cast<std::size_t>(i)] + t * rough.y[static_cast<std::size_t>(i) + 1];
  if (std::isnan(y)) return {};
  return y;
}

/// The rough path as a running mean over a few columns: steps of whole rows would show.
RoughTerminus smoothed(const RoughTerminus& rough) {
  RoughTerminus result = rough;
  const auto n = static_cast<std::ptrdiff_t>(rough.y.size());
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    double sum = 0;
    int count = 0;
    for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, i - 1); k <= std::min(n - 1, i + 1); ++k)
      if (const double y = rough.y[static_cast<std::size_t>(k)]; !std::isnan(y)) sum += y, ++count;
    if (!std::isnan(rough.y[static_cast<std::size_t>(i)]))
      result.y[static_cast<std::size_t>(i)] = sum / count;
  }
  return result;
}

Strips cut(const Tone& tone, const PhotoGeometry& geometry, const RoughTerminus& rough, double spacing,
           double pixel_size, int half_rows) {
  Strips strips;
  strips.rows = 2 * half_rows + 1;
  const double end = rough.start + rough.step * static_cast<double>(rough.y.size() - 1);
  const int sub_columns = std::max(1, static_cast<int>(spacing / pixel_size + 0.5));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> sum(static_cast<std::size_t>(strips.rows));
  for (double x = rough.start + spacing / 2; x < end; x += spacing) {
    const auto y = rough_at(rough, x);
    if (!y) continue;
    std::fill(sum.begin(), sum.end(), 0.0F);
    for (int c = 0; c < sub_columns; ++c) {
      const double column = x + ((c + 0.5) / sub_columns - 0.5) * spacing;
      const Eigen::Vector2d first = geometry.pixel(column, rough.side * (*y - half_rows * pixel_size));
      const Eigen::Vector2d last = geometry.pixel(column, rough.side * (*y + half_rows * pixel_size));
      const Eigen::Vector2d step = (last - first) / (strips.rows - 1);
      for (int r = 0; r < strips.rows; ++r) {
        const Eigen::Vector2d p = first + r * step;
        sum[static_cast<std::size_t>(r)] += tone(p.x(), p.y());
      }
    }
    for (int r = 0; r < strips.rows; ++r) {
      const bool beside_bar = *y / pixel_size + strips.offset(r) < edge_px;
      strips.light.push_back(beside_bar ? nan
                                        : sum[static_cast<std::size_t>(r)] / static_cast<float>(sub_columns));
    }
    strips.x.push_back(x);
    strips.y.push_back(*y);
  }
  return strips;
}

struct Level {
  double dark = 0;
  double lit = 0;
};

/// Mean light of a strip's rows with offsets from `from` to `to`; NaN where there are none.
double mean_light(const Strips& strips, std::size_t k, double from, double to) {
  double sum = 0;
  int count = 0;
  const int half = (strips.rows - 1) / 2;
  const int begin = std::max(0, static_cast<int>(std::ceil(from)) + half);
  const int end = std::min(strips.rows - 1, static_cast<int>(std::floor(to)) + half);
  for (int r = begin; r <= end; ++r)
    if (const float value = strips.strip(k)[r]; !std::isnan(value))
      sum += static_cast<double>(value), ++count;
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

/// Levels on either side of the border, at least `clear` rows away from it: running medians over stations.
std::vector<Level> surrounding_levels(const Strips& strips, const std::vector<double>& s, double clear,
                                      std::size_t reach) {
  const double half = (strips.rows - 1) / 2;
  std::vector<Level> own(strips.size());
  for (std::size_t k = 0; k < strips.size(); ++k) {
    own[k].dark = mean_light(strips, k, -half, std::min(s[k] - clear, half - 2));
    own[k].lit = mean_light(strips, k, std::max(s[k] + clear, -half + 2), half);
  }
  // Medians of blocks, linear between them: as good as running ones and cheap.
  const std::size_t blocks = std::max<std::size_t>(1, strips.size() / reach);
  std::vector<Level> block(blocks);
  std::vector<double> darks;
  std::vector<double> lits;
  for (std::size_t b = 0; b < blocks; ++b) {
    darks.clear();
    lits.clear();
    for (std::size_t k = b * strips.size() / blocks; k < (b + 1) * strips.size() / blocks; ++k) {
      if (!std::isnan(own[k].dark)) darks.push_back(own[k].dark);
      if (!std::isnan(own[k].lit)) lits.push_back(own[k].lit);
    }
    block[b] = {median(darks), median(lits)};
  }
  for (std::size_t b = 1; b < blocks; ++b)
    if (std::isnan(block[b].dark)) block[b].dark = block[b - 1].dark;
  for (std::size_t b = blocks - 1; b-- > 0;)
    if (std::isnan(block[b].dark)) block[b].dark = block[b + 1].dark;
  std::vector<Level> result(strips.size());
  for (std::size_t k = 0; k < strips.size(); ++k) {
    const double at =
        (static_cast<double>(k) + 0.5) / static_cast<double>(strips.size()) * static_cast<double>(blocks) -
        0.5;
    const double low = std::clamp(std::floor(at), 0.0, static_cast<double>(blocks - 1));
    const auto b = static_cast<std::size_t>(low);
    const std::size_t next = std::min(b + 1, blocks - 1);
    const double t = std::clamp(at - low, 0.0, 1.0);
    result[k] = {(1 - t) * block[b].dark + t * block[next].dark,
                 (1 - t) * block[b].lit + t * block[next].lit};
  }
  return result;
}

/// The light of strips laid over one another at the places found, 0 dark and 1 lit, in bins of half a row.
struct MeanStep {
  std::vector<double> offset;  // from the border [rows]
  std::vector<double> light;
  std::vector<double> count;

  MeanStep(const Strips& strips, const std::vector<double>& s, const std::vector<Level>& levels,
           std::size_t begin, std::size_t end) {
    const int bins = 4 * strips.rows;
    std::vector<double> sums(static_cast<std::size_t>(bins), 0);
    std::vector<double> counts(static_cast<std::size_t>(bins), 0);
    for (std::size_t k = begin; k < end; ++k)
      for (int r = 0; r < strips.rows; ++r) {
        const float value = strips.strip(k)[r];
        const double bin = 2 * (strips.offset(r) - s[k]) + bins / 2;
        if (std::isnan(value) || bin < 0 || bin >= bins) continue;
        sums[static_cast<std::size_t>(bin)] +=
            (static_cast<double>(value) - levels[k].dark) / (levels[k].lit - levels[k].dark);
        ++counts[static_cast<std::size_t>(bin)];
      }
    for (int b = 0; b < bins; ++b) {
      const auto i = static_cast<std::size_t>(b);
      if (counts[i] == 0) continue;
      offset.push_back((b + 0.5 - bins / 2) / 2);
      light.push_back(sums[i] / counts[i]);
      count.push_back(counts[i]);
    }
  }

  /// Standard deviation of the rise in rows: least squares by golden section on its logarithm.
  double width(int rows) const {
    const auto misfit = [&](double log_width) {
      const double w = std::exp(log_width);
      double cost = 0;
      for (std::size_t i = 0; i < offset.size(); ++i)
        cost += count[i] * std::pow(light[i] - normal_distribution(offset[i] / w), 2);
      return cost;
    };
    constexpr double enough = 3e-5;
    return std::exp(minimum_between(std::log(0.3), std::log(static_cast<double>(rows) / 2), enough, misfit));
  }
};

/// The place of half light in one strip, in rows from its middle; nothing when the strip has no clear border.
std::optional<double> fit_border(const Strips& strips, std::size_t k, const Level& level, double width,
                                 double start) {
  const float* light = strips.strip(k);
  const double step = level.lit - level.dark;
  const double half = (strips.rows - 1) / 2;
  double s = start;
  for (int round = 0; round < 12; ++round) {
    double slope_square = 0;
    double slope_miss = 0;
    for (int r = 0; r < strips.rows; ++r) {
      if (std::isnan(light[r])) continue;
      const double t = (strips.offset(r) - s) / width;
      if (std::abs(t) > 4) continue;
      const double n = (static_cast<double>(light[r]) - level.dark) / step;
      const double slope = -normal_density(t) / width;
      slope_square += slope * slope;
      slope_miss += slope * (n - normal_distribution(t));
    }
    if (slope_square < 1e-6) return {};
    const double change = std::clamp(slope_miss / slope_square, -width, width);
    s += change;
    if (std::abs(s) > half) return {};
    if (std::abs(change) < 1e-3) break;
  }
  int rows = 0;
  for (int r = 0; r < strips.rows; ++r)
    if (!std::isnan(light[r]) && std::abs(strips.offset(r) - s) <= 4 * width) ++rows;
  if (rows < 3) return {};
  return s;
}

/// Extremes of the border: the first row with light seen from the shadow, the last row without.
void extremes(const Strips& strips, std::size_t k, const Level& level, double s, double width, double* lower,
              double* upper) {
  const float* light = strips.strip(k);
  const double half_light = (level.dark + level.lit) / 2;
  *lower = s;
  *upper = s;
  const double reach = 2 * width + 2;
  for (int r = 1; r < strips.rows; ++r) {
    const double at = strips.offset(r);
    if (at < s - reach || at > s + reach || std::isnan(light[r - 1]) || std::isnan(light[r])) continue;
    const double before = static_cast<double>(light[r - 1]) - half_light;
    const double after = static_cast<double>(light[r]) - half_light;
    if ((before < 0) == (after < 0)) continue;
    const double crossing = at - 1 + before / (before - after);
    *lower = std::min(*lower, crossing);
    *upper = std::max(*upper, crossing);
  }
}

}  // namespace

Terminus locate_terminus(const Tone& tone, const PhotoGeometry& geometry, const RoughTerminus& rough,
                         double spacing) {
  const RoughTerminus path = smoothed(rough);
  const double middle = rough.start + rough.step * static_cast<double>(rough.y.size()) / 2;
  const double pixel_size = 1 / geometry.pixels_across(middle);

  Terminus terminus;
  terminus.pixel_size = pixel_size;
  int half_rows =
      std::max(10, static_cast<int>(std::ceil(2.5 * rough.row / pixel_size + 2 * spacing / pixel_size)));
  Strips strips;
  std::vector<double> s;
  std::vector<Level> levels;
  std::vector<double> width;
  for (int widening = 0; widening < 4; ++widening) {
    strips = cut(tone, geometry, path, spacing, pixel_size, half_rows);
    s.assign(strips.size(), 0);
    if (strips.size() == 0) return terminus;
    const std::size_t reach = std::max<std::size_t>(10, static_cast<std::size_t>(8e-3 / spacing));
    const std::size_t blocks = std::clamp<std::size_t>(strips.size() / (4 * reach), 1, 16);
    double clear = 0.6 * half_rows;
    width.assign(strips.size(), half_rows / 4.0);
    double widest = 0;
    for (int round = 0; round < 3; ++round) {
      levels = surrounding_levels(strips, s, clear, reach);
      for (std::size_t k = 0; k < strips.size(); ++k)
        s[k] = fit_border(strips, k, levels[k], width[k], s[k]).value_or(0);
      widest = 0;
      for (std::size_t b = 0; b < blocks; ++b) {
        const std::size_t begin = b * strips.size() / blocks;
        const std::size_t end = (b + 1) * strips.size() / blocks;
        const double w = MeanStep(strips, s, levels, begin, end).width(strips.rows);
        std::fill(width.begin() + static_cast<std::ptrdiff_t>(begin),
                  width.begin() + static_cast<std::ptrdiff_t>(end), w);
        widest = std::max(widest, w);
      }
      clear = std::min(0.75 * half_rows, 2.2 * widest + 1);
    }
    if (4 * widest <= half_rows || half_rows > 120) break;
    half_rows = static_cast<int>(std::ceil(5 * widest));
  }

  for (std::size_t k = 0; k < strips.size(); ++k) {
    const auto border = fit_border(strips, k, levels[k], width[k], s[k]);
    if (!border) continue;
    double lower = 0;
    double upper = 0;
    extremes(strips, k, levels[k], *border, width[k], &lower, &upper);
    const auto pixel = [&](double row) {
      return geometry.pixel(strips.x[k], rough.side * (strips.y[k] + row * pixel_size));
    };
    terminus.stations.push_back({pixel(*border), pixel(lower), pixel(upper)});
  }
  terminus.width_px = median(width);
  return terminus;
}

}  // namespace aeolian
