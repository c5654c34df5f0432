#include "aeolian_core/measure/shadow_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr int most_columns = 600;
constexpr int most_rows = 1200;
constexpr int edge_rows = 2;            // beside the bright bar, not looked at
constexpr double least_contrast = 1.5;  // sunlit over shaded, linear light
constexpr double clearly_darker = 1.5;  // of two shadows, in linear light
constexpr double least_darker = 0.4;    // light inside the border over that further in
constexpr float least_light = 0.02F;    // linear, of a lit bed that can be told from noise
constexpr double light_reach = 6e-3;    // so far on either side of the border the light must be right [m]
constexpr int least_shadow = 3;         // rows
constexpr float hidden_cost = 0.4F;
constexpr float bend_cost = 0.25F;     // of a path that changes by one row, in rows of wrong light
constexpr double most_clipped = 0.12;  // of the sunlit bed
constexpr float clipped = 0.985F;      // linear light at which 8 bits are nearly full

/// Linear light over the plane of the top face on one side of the edge: columns along x, rows away from it.
struct Grid {
  double start = 0, step = 0;  // x of the columns [m]
  double row = 0;              // spacing of the rows [m]
  int columns = 0, rows = 0;
  std::vector<float> light;  // column by column
  std::vector<int> depth;    // rows of each column that are on the photo

  float at(int i, int j) const {
    return light[static_cast<std::size_t>(i) * static_cast<std::size_t>(rows) + static_cast<std::size_t>(j)];
  }
  float& at(int i, int j) {
    return light[static_cast<std::size_t>(i) * static_cast<std::size_t>(rows) + static_cast<std::size_t>(j)];
  }
  int depth_of(int i) const { return depth[static_cast<std::size_t>(i)]; }
};

template <class T>
T quantile_of(std::vector<T>& values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

bool on_photo(const Eigen::Vector2d& p, int width, int height) {
  return p.x() >= 1 && p.y() >= 1 && p.x() <= width - 2 && p.y() <= height - 2;
}

/// How far from the edge the photo reaches at x [m].
double reach_at(const PhotoGeometry& geometry, int width, int height, double x, int side, double pixel_size) {
  double far = pixel_size;
  while (far < 2 && on_photo(geometry.pixel(x, side * far), width, height)) far *= 1.5;
  double near = far / 1.5;
  while (far - near > pixel_size) {
    const double middle = (near + far) / 2;
    (on_photo(geometry.pixel(x, side * middle), width, height) ? near : far) = middle;
  }
  return near;
}

Grid sample(const Tone& tone, int width, int height, const PhotoGeometry& geometry, const EdgeSpan& span,
            int side) {
  Grid grid;
  const double middle = (span.from + span.to) / 2;
  const double px_along = geometry.pixels_along(middle);
  const double px_across = geometry.pixels_across(middle);
  grid.step = std::max(2 / px_along, (span.to - span.from) / most_columns);
  grid.columns = static_cast<int>((span.to - span.from) / grid.step);
  grid.start = span.from + grid.step / 2;

  std::vector<double> reaches;
  for (int i = 0; i < grid.columns; ++i)
    reaches.push_back(reach_at(geometry, width, height, grid.start + i * grid.step, side, 1 / px_across));
  const double farthest = *std::max_element(reaches.begin(), reaches.end());
  grid.row = std::max(1 / px_across, farthest / most_rows);
  grid.rows = static_cast<int>(farthest / grid.row);
  grid.light.assign(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows), 0);
  for (int i = 0; i < grid.columns; ++i)
    grid.depth.push_back(static_cast<int>(reaches[static_cast<std::size_t>(i)] / grid.row));

  const int along = std::clamp(static_cast<int>(grid.step * px_along / 2), 1, 4);
  const int across = std::clamp(static_cast<int>(grid.row * px_across + 0.5), 1, 3);
  constexpr int stride = 16;  // rows between which a column is straight on the photo
  for (int i = 0; i < grid.columns; ++i)
    for (int a = 0; a < along; ++a) {
      const double x = grid.start + (i + (a + 0.5) / along - 0.5) * grid.step;
      for (int j = 0; j < grid.depth_of(i); j += stride) {
        const int end = std::min(j + stride, grid.depth_of(i));
        const Eigen::Vector2d first = geometry.pixel(x, side * j * grid.row);
        const Eigen::Vector2d step =
            (geometry.pixel(x, side * end * grid.row) - first) / ((end - j) * across);
        for (int k = 0; k < (end - j) * across; ++k) {
          const Eigen::Vector2d p = first + (k + 0.5) * step;
          grid.at(i, j + k / across) += tone(static_cast<int>(p.x() + 0.5), static_cast<int>(p.y() + 0.5));
        }
      }
    }
  const float share = 1.0F / static_cast<float>(along * across);
  for (float& value : grid.light) value *= share;
  return grid;
}

struct Levels {
  float dark = 0;
  float lit = 0;
};

/// Typical light of the shadow (the darkest stretch of 1.2 mm of each column) and of the bed.
std::optional<Levels> first_levels(const Grid& grid) {
  std::vector<float> darks;
  std::vector<float> lits;
  std::vector<float> column;
  const int stretch = std::max(3, static_cast<int>(1.2e-3 / grid.row));
  for (int i = 0; i < grid.columns; ++i) {
    const int depth = grid.depth_of(i);
    if (depth < edge_rows + std::max(8, stretch)) continue;
    float sum = 0;
    float darkest = std::numeric_limits<float>::infinity();
    for (int j = edge_rows; j < depth; ++j) {
      sum += grid.at(i, j);
      if (j < edge_rows + stretch) continue;
      sum -= grid.at(i, j - stretch);
      darkest = std::min(darkest, sum / static_cast<float>(stretch));
    }
    darks.push_back(darkest);
    column.clear();
    for (int j = edge_rows; j < depth; ++j) column.push_back(grid.at(i, j));
    lits.push_back(quantile_of(column, 0.9));
  }
  if (darks.size() < 10) return {};
  return Levels{quantile_of(darks, 0.5), quantile_of(lits, 0.5)};
}

/// 0 in the shadow, 1 in the sun.
float sunlit(float light, const Levels& levels) {
  return std::clamp((light - levels.dark) / (levels.lit - levels.dark), 0.0F, 1.0F);
}

/// For each column the row at which the shadow ends: the path of least wrong light. A column that ends in
/// the dark has its depth.
std::vector<int> best_path(const Grid& grid, const std::vector<Levels>& levels) {
  const int rows = grid.rows + 1;
  const auto size = static_cast<std::size_t>(rows);
  const int window = std::max(12, static_cast<int>(light_reach / grid.row));
  std::vector<float> cost(size, 0);
  std::vector<float> sums(size + 1);
  std::vector<std::uint16_t> from(size * static_cast<std::size_t>(grid.columns));
  for (int i = 0; i < grid.columns; ++i) {
    std::uint16_t* const origin = &from[static_cast<std::size_t>(i) * size];
    for (int j = 0; j < rows; ++j) origin[j] = static_cast<std::uint16_t>(j);
    for (int j = 1; j < rows; ++j)
      if (cost[static_cast<std::size_t>(j) - 1] + bend_cost < cost[static_cast<std::size_t>(j)]) {
        cost[static_cast<std::size_t>(j)] = cost[static_cast<std::size_t>(j) - 1] + bend_cost;
        origin[j] = origin[j - 1];
      }
    for (int j = rows - 2; j >= 0; --j)
      if (cost[static_cast<std::size_t>(j) + 1] + bend_cost < cost[static_cast<std::size_t>(j)]) {
        cost[static_cast<std::size_t>(j)] = cost[static_cast<std::size_t>(j) + 1] + bend_cost;
        origin[j] = origin[j + 1];
      }
    const int depth = grid.depth_of(i);
    const Levels& level = levels[static_cast<std::size_t>(i)];
    sums[0] = 0;
    for (int j = 0; j < rows; ++j)
      sums[static_cast<std::size_t>(j) + 1] =
          sums[static_cast<std::size_t>(j)] +
          (j < edge_rows || j >= depth ? 0 : sunlit(grid.at(i, j), level));
    float least = std::numeric_limits<float>::infinity();
    for (int j = 0; j < rows; ++j) {
      const auto sum_to = [&](int row) {
        return sums[static_cast<std::size_t>(std::clamp(row, edge_rows, depth))];
      };
      const int at = std::clamp(j, edge_rows, std::max(edge_rows, depth));
      const int inner_rows = std::min(window, at - edge_rows);
      const int outer_rows = std::max(0, std::min(window, depth - at));
      // Rows that the bar or the photo's border hides count as half wrong.
      const float inner =
          inner_rows < least_shadow
              ? static_cast<float>(window)
              : sum_to(at) - sum_to(at - window) + hidden_cost * static_cast<float>(window - inner_rows);
      const float outer = static_cast<float>(outer_rows) - (sum_to(at + window) - sum_to(at)) +
                          hidden_cost * static_cast<float>(window - outer_rows);
      float& c = cost[static_cast<std::size_t>(j)];
      c += inner + outer;
      least = std::min(least, c);
    }
    for (float& c : cost) c -= least;
  }
  std::vector<int> path(static_cast<std::size_t>(grid.columns));
  auto at = static_cast<std::size_t>(std::min_element(cost.begin(), cost.end()) - cost.begin());
  for (int i = grid.columns - 1; i >= 0; --i) {
    path[static_cast<std::size_t>(i)] = std::min(static_cast<int>(at), grid.depth_of(i));
    at = from[static_cast<std::size_t>(i) * size + at];
  }
  return path;
}

/// Mean light of rows [begin, end) of a column; nothing when there are fewer than two.
std::optional<float> mean_light(const Grid& grid, int i, int begin, int end) {
  begin = std::max(begin, edge_rows);
  end = std::min(end, grid.depth_of(i));
  if (end - begin < 2) return {};
  float sum = 0;
  for (int j = begin; j < end; ++j) sum += grid.at(i, j);
  return sum / static_cast<float>(end - begin);
}

/// Levels beside a path, as running medians along it.
std::vector<Levels> levels_along(const Grid& grid, const std::vector<int>& path, const Levels& typical) {
  const int zone = std::max(6, static_cast<int>(4e-3 / grid.row));
  std::vector<Levels> own;
  for (int i = 0; i < grid.columns; ++i) {
    const int end = path[static_cast<std::size_t>(i)];
    own.push_back({mean_light(grid, i, end - 1 - zone, end - 1).value_or(typical.dark),
                   mean_light(grid, i, end + 1, end + 1 + zone).value_or(typical.lit)});
  }
  const int columns = std::max(5, grid.columns / 12);
  std::vector<Levels> result;
  std::vector<float> window;
  for (int i = 0; i < grid.columns; ++i) {
    Levels level;
    const int begin = std::max(0, i - columns);
    const int end = std::min(grid.columns, i + columns + 1);
    window.clear();
    for (int k = begin; k < end; ++k) window.push_back(own[static_cast<std::size_t>(k)].dark);
    level.dark = quantile_of(window, 0.5);
    window.clear();
    for (int k = begin; k < end; ++k) window.push_back(own[static_cast<std::size_t>(k)].lit);
    level.lit = quantile_of(window, 0.5);
    if (!(level.lit > static_cast<float>(least_contrast) * level.dark)) level = typical;
    result.push_back(level);
  }
  return result;
}

struct Verdict {
  RoughTerminus terminus;
  int found = 0;       // columns with a clear border
  int off_photo = 0;   // columns that are dark to the photo's border
  double clipped = 0;  // share of over-exposed bed beyond the border
  double darker = 1;   // light just inside the border over that further in
};

/// Upper quartile of the light of the dark rows of a column that end at row `end`; nothing for fewer than
/// four.
std::optional<float> light_further_in(const Grid& grid, int i, int end, float half_light) {
  std::vector<float> rows;
  for (int j = end - 1; j >= edge_rows && grid.at(i, j) < half_light; --j) rows.push_back(grid.at(i, j));
  if (rows.size() < 4) return {};
  return quantile_of(rows, 0.75);
}

Verdict judge(const Grid& grid, const std::vector<int>& path, const std::vector<Levels>& levels, int side) {
  Verdict verdict;
  verdict.terminus = {side, grid.start, grid.step, grid.row, {}, 0, {}};
  const int zone = std::max(6, static_cast<int>(3e-3 / grid.row));
  std::vector<float> darker;
  std::size_t beyond = 0;
  std::size_t full = 0;
  for (int i = 0; i < grid.columns; ++i) {
    const int end = path[static_cast<std::size_t>(i)];
    const Levels& level = levels[static_cast<std::size_t>(i)];
    double y = std::numeric_limits<double>::quiet_NaN();
    const auto inner = mean_light(grid, i, std::max(edge_rows, end - zone), end);
    const auto outer = mean_light(grid, i, end, end + zone);
    const bool dark = inner && sunlit(*inner, level) < 0.35F;
    if (dark && end + 2 >= grid.depth_of(i)) ++verdict.off_photo;
    if (dark && outer && sunlit(*outer, level) > 0.65F) {
      y = end * grid.row;
      ++verdict.found;
      if (const auto further = light_further_in(grid, i, end - zone, (level.dark + level.lit) / 2))
        darker.push_back(*inner / *further);
    }
    verdict.terminus.y.push_back(y);
    verdict.terminus.reach.push_back(grid.depth_of(i) * grid.row);
    for (int j = end + 2; j < std::min(end + 2 + zone, grid.depth_of(i)); ++j) {
      ++beyond;
      if (grid.at(i, j) > clipped) ++full;
    }
  }
  verdict.darker = darker.size() * 3 > static_cast<std::size_t>(verdict.found)
                       ? static_cast<double>(quantile_of(darker, 0.5))
                       : 1;
  verdict.clipped = beyond > 0 ? static_cast<double>(full) / static_cast<double>(beyond) : 0;
  return verdict;
}

/// The border on one side, or the reason why there is none.
RoughTerminus search_side(const Tone& tone, int width, int height, const PhotoGeometry& geometry,
                          const EdgeSpan& span, int side) {
  const Grid grid = sample(tone, width, height, geometry, span, side);
  const auto typical = first_levels(grid);
  if (!typical) throw Error("no shadow: the photo ends beside the casting edge");
  if (typical->lit < least_light)
    throw Error(fmt::format("under-exposed: the bed has {:.1f} % of full light", 100 * typical->lit));
  if (typical->lit > clipped) throw Error("over-exposed: most of the bed is white");
  if (!(typical->lit > least_contrast * typical->dark))
    throw Error(
        fmt::format("no shadow: beside the casting edge the photo is {:.2f} as bright as the bed beyond",
                    typical->lit > 0 ? typical->dark / typical->lit : 1));
  std::vector<Levels> levels(static_cast<std::size_t>(grid.columns), *typical);
  std::vector<int> path = best_path(grid, levels);
  levels = levels_along(grid, path, *typical);
  path = best_path(grid, levels);
  const Verdict verdict = judge(grid, path, levels, side);
  if (verdict.clipped > most_clipped)
    throw Error(fmt::format("over-exposed: {:.0f} % of the sunlit bed beside the shadow is white",
                            100 * verdict.clipped));
  if (verdict.darker < least_darker) throw Error("something darker than the shadow lies over its border");
  if (verdict.off_photo > grid.columns / 2) throw Error("the far border of the shadow is outside the photo");
  if (verdict.found < std::max(20, grid.columns * 3 / 10))
    throw Error(fmt::format("no shadow with a clear border: it is found in {:.0f} % of the photo's width",
                            100.0 * verdict.found / grid.columns));
  RoughTerminus terminus = verdict.terminus;
  std::vector<float> shades;
  for (const Levels& level : levels) shades.push_back(level.dark);
  terminus.shade = static_cast<double>(quantile_of(shades, 0.5));
  return terminus;
}

}  // namespace

EdgeSpan visible_edge(const PhotoGeometry& geometry, int width_px, int height_px, double seed) {
  const auto seen = [&](double x) { return on_photo(geometry.pixel(x, 0), width_px, height_px); };
  const double px = geometry.pixels_along(seed);
  const double step = 4 / px;
  const int most = 2 * (width_px + height_px) / 4;
  // The seed itself may lie off the photo: the first seen place beside it will do.
  int start = 0;
  while (start < most && !seen(seed + start * step) && !seen(seed - start * step)) ++start;
  if (start == most) throw Error("the casting edge is outside the photo");
  const double inside = seen(seed + start * step) ? seed + start * step : seed - start * step;
  EdgeSpan span{inside, inside};
  while (seen(span.from - step)) span.from -= step;
  while (seen(span.to + step)) span.to += step;
  if ((span.to - span.from) * px < 40) throw Error("the casting edge is outside the photo");
  return span;
}

RoughTerminus search_shadow(const Tone& tone, int width_px, int height_px, const PhotoGeometry& geometry,
                            const EdgeSpan& span, int side) {
  if (side != 0) return search_side(tone, width_px, height_px, geometry, span, side);
  std::vector<RoughTerminus> found;
  std::string reason;
  for (const int either : {1, -1}) try {
      found.push_back(search_side(tone, width_px, height_px, geometry, span, either));
    } catch (const Error& error) {
      reason = error.what();
    }
  if (found.empty()) throw Error(reason);
  if (found.size() == 1) return found.front();
  // On the light's side a grey bar against bright sand may look like a shadow, but never as dark as one.
  const double ratio = found[0].shade / found[1].shade;
  if (ratio > 1 / clearly_darker && ratio < clearly_darker)
    throw Error(
        "there is a shadow on either side of the straightedge: two lights, or give straightedge.shadow_side "
        "or marks with y");
  return found[ratio < 1 ? 0 : 1];
}

}  // namespace aeolian
