#include "aeolian_twin/comparison/surface_files.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "aeolian_core/measure/fusion.hpp"
#include "aeolian_core/surface/cloud_file.hpp"
#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/geotiff.hpp"
#include "aeolian_core/surface/median.hpp"
#include "aeolian_core/surface/resample.hpp"
#include "aeolian_core/surface/text.hpp"
#include "aeolian_core/twin/on_grid.hpp"
#include "aeolian_twin/nodes/map_file.hpp"

namespace aeolian {
namespace {

constexpr const char* default_topic = "/height_map";
constexpr double most_cells = 1e8;

struct Box {
  double min_x = -INFINITY, min_y = -INFINITY, max_x = INFINITY, max_y = INFINITY;

  void cut_to(const Box& other) {
    min_x = std::max(min_x, other.min_x);
    min_y = std::max(min_y, other.min_y);
    max_x = std::min(max_x, other.max_x);
    max_y = std::min(max_y, other.max_y);
  }
};

Box box_of(const GridGeometry& g) {
  return {g.origin_x(), g.origin_y(), g.origin_x() + g.length_x(), g.origin_y() + g.length_y()};
}

Box box_of(const PointCloud& cloud) {
  Box box{INFINITY, INFINITY, -INFINITY, -INFINITY};
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!std::isfinite(cloud.x[i] + cloud.y[i] + cloud.z[i])) continue;
    const double x = cloud.origin_x + static_cast<double>(cloud.x[i]);
    const double y = cloud.origin_y + static_cast<double>(cloud.y[i]);
    box.min_x = std::min(box.min_x, x);
    box.max_x = std::max(box.max_x, x);
    box.min_y = std::min(box.min_y, y);
    box.max_y = std::max(box.max_y, y);
  }
  return box;
}

/// Only what a comparison needs of a map.
HeightMap heights_of(HeightMap map) {
  for (const std::string& name : map.names())
    if (name != layer::elevation && name != layer::variance) map.remove(name);
  return map;
}

/// A table of x and z without y, by its first line. measure_photo tells how far stations lie across the
/// section, too.
bool is_profile(const std::string& path) {
  if (extension_of(path) != "csv") return false;
  const std::string text = read_text(path, "surface");
  std::string_view rest = text;
  const std::string header = "," + lower_case(take_line(rest));
  const auto names = [&](const char* column) { return header.find(column) != std::string::npos; };
  return names(",x_m") && names(",z_m") && (!names(",y") || names(",terminus_x_px"));
}

/// A column in metres, whichever unit it is given in; nothing when it is absent.
std::optional<std::vector<double>> metres(const Table& table, const std::string& name) {
  if (table.has(name + "_m")) return table.column(name + "_m");
  if (!table.has(name + "_mm")) return std::nullopt;
  std::vector<double> values = table.column(name + "_mm");
  for (double& v : values) v /= 1000;
  return values;
}

HeightMap read_profile(const std::string& path) {
  const Table table = read_csv(path);
  const auto x = metres(table, "x");
  const auto z = metres(table, "z");
  const auto sigma = metres(table, "sigma_z");
  const std::string where = "profile '" + path + "': ";
  if (!x || !z) throw Error(where + "has no columns x_m and z_m (or x_mm and z_mm)");
  std::vector<std::size_t> known;
  std::vector<double> steps;
  for (std::size_t i = 0; i < x->size(); ++i) {
    if (!std::isfinite((*x)[i] + (*z)[i])) continue;
    if (!known.empty()) {
      steps.push_back((*x)[i] - (*x)[known.back()]);
      if (!(steps.back() > 0))
        throw Error(where + fmt::format("x does not rise at row {}: {:g} m after {:g} m", i + 1, (*x)[i],
                                        (*x)[known.back()]));
    }
    known.push_back(i);
  }
  if (known.size() < 16)
    throw Error(where + fmt::format("has {} stations, at least 16 are needed", known.size()));
  const double step = median(steps);
  const double first = (*x)[known.front()];
  const auto cells = static_cast<int>(((*x)[known.back()] - first) / step + 1e-6) + 1;
  HeightMap map(GridGeometry(first - step / 2, 0, step, cells, 1));
  HeightMap::Layer& heights = map.add(layer::elevation);
  HeightMap::Layer variances(sigma ? heights.size() : 0, HeightMap::unknown);
  std::size_t next = 1;
  for (int cell = 0; cell < cells; ++cell) {
    const double at = first + cell * step;
    while (next + 1 < known.size() && (*x)[known[next]] < at) ++next;
    const std::size_t before = known[next - 1];
    const std::size_t after = known[next];
    const double gap = (*x)[after] - (*x)[before];
    if (gap > 3 * step) continue;
    const double share = std::clamp((at - (*x)[before]) / gap, 0.0, 1.0);
    const auto i = static_cast<std::size_t>(cell);
    heights[i] = static_cast<float>((1 - share) * (*z)[before] + share * (*z)[after]);
    if (sigma)
      variances[i] =
          static_cast<float>(std::pow((1 - share) * (*sigma)[before] + share * (*sigma)[after], 2));
  }
  if (sigma) map.add(layer::variance, std::move(variances));
  return map;
}

/// A profile as a band of equal rows that covers the coarser cells of another.
HeightMap band_of(const HeightMap& profile, double width) {
  const GridGeometry& g = profile.geometry();
  const int rows = static_cast<int>(std::ceil(width / g.cell()));
  HeightMap band(GridGeometry(g.origin_x(), 0, g.cell(), g.nx(), rows));
  for (const std::string& name : profile.names()) {
    HeightMap::Layer& values = band.add(name);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = profile.layer(name)[i % static_cast<std::size_t>(g.nx())];
  }
  return band;
}

HeightMap gridded(const SurfaceFile& file, const GridGeometry& grid) {
  FusionParameters parameters;
  parameters.robust = false;
  HeightFusion fusion(grid, parameters);
  fusion.add(*file.cloud, Eigen::Isometry3d::Identity(), 0);
  HeightMap map(grid);  // no variance: the sensor is not known
  map.add(layer::elevation, fusion.map().layer(layer::elevation));
  return map;
}

void require_one_system(const std::vector<SurfaceFile>& files) {
  for (const SurfaceFile& a : files)
    for (const SurfaceFile& b : files) {
      if (!a.frame.empty() && !b.frame.empty() && a.frame != b.frame)
        throw Error(fmt::format("'{}' is in the frame {}, '{}' in {}: must be the same", a.name, a.frame,
                                b.name, b.frame));
      if (!a.projection.empty() && !b.projection.empty() && !same_projection(a.projection, b.projection))
        throw Error(
            fmt::format("'{}' and '{}' state different projections or datums, must be the same (gdalwarp "
                        "-t_srs reprojects)",
                        a.name, b.name));
      if (a.profile.has_value() != b.profile.has_value())
        throw Error(fmt::format("'{}' is a profile, '{}' is not: profiles are compared with profiles",
                                a.profile ? a.name : b.name, a.profile ? b.name : a.name));
    }
}

/// The cells of a grid that lie within a box; none when it is narrower than a cell.
std::optional<GridGeometry> part_within(const GridGeometry& g, const Box& box) {
  const double slack = 1e-6;
  const auto first = [&](double low, double origin) {
    return std::max(0, static_cast<int>(std::ceil((low - origin) / g.cell() - slack)));
  };
  const auto last = [&](double high, double origin, int count) {
    return std::min(count, static_cast<int>(std::floor((high - origin) / g.cell() + slack)));
  };
  if (!(box.min_x < box.max_x && box.min_y < box.max_y)) return std::nullopt;
  const int x0 = first(box.min_x, g.origin_x());
  const int y0 = first(box.min_y, g.origin_y());
  const int nx = last(box.max_x, g.origin_x(), g.nx()) - x0;
  const int ny = last(box.max_y, g.origin_y(), g.ny()) - y0;
  if (nx < 1 || ny < 1) return std::nullopt;
  if (nx == g.nx() && ny == g.ny()) return g;
  return GridGeometry(g.origin_x() + x0 * g.cell(), g.origin_y() + y0 * g.cell(), g.cell(), nx, ny);
}

}  // namespace

SurfaceFile read_surface(const std::string& name) {
  SurfaceFile file;
  file.name = name;
  const std::size_t bag = name.rfind(".bag:");
  const std::string path = bag == std::string::npos ? name : name.substr(0, bag + 4);
  const std::string extension = extension_of(path);
  if (extension == "tif" || extension == "tiff" || extension == "bag") {
    StoredMap stored = load_map(path, bag == std::string::npos ? default_topic : name.substr(bag + 5));
    file.map = heights_of(std::move(stored.map));
    file.frame = stored.frame;
    if (extension != "bag") file.projection = read_geotiff_projection(path);
  } else if (is_profile(path)) {
    file.profile = read_profile(path);
  } else {
    file.cloud = read_cloud(path);
  }
  return file;
}

CommonGrid on_common_grid(const std::vector<SurfaceFile>& files, std::optional<double> cell) {
  require_one_system(files);
  CommonGrid result;
  result.profile = files.front().profile.has_value();
  Box overlap;
  const HeightMap* coarsest = nullptr;
  for (const SurfaceFile& file : files) {
    if (file.cloud) {
      overlap.cut_to(box_of(*file.cloud));
      continue;
    }
    const HeightMap& map = file.profile ? *file.profile : *file.map;
    overlap.cut_to(box_of(map.geometry()));
    if (coarsest == nullptr || map.geometry().cell() > coarsest->geometry().cell() * (1 + 1e-6))
      coarsest = &map;
  }
  if (coarsest == nullptr && !cell)
    throw Error("clouds only: --cell must say the side of the cells to grid them in");
  if (!(overlap.min_x < overlap.max_x && overlap.min_y < overlap.max_y))
    throw Error("the surfaces do not overlap: nothing to compare");
  const bool own = coarsest == nullptr || (cell && *cell > coarsest->geometry().cell() * (1 + 1e-6));
  if (own) {
    const double cells = (overlap.max_x - overlap.min_x) * (overlap.max_y - overlap.min_y) / (*cell * *cell);
    if (!(cells <= most_cells))
      throw Error(fmt::format("--cell {:g} m makes {:.3g} cells, at most {:g} are allowed", *cell, cells,
                              most_cells));
  }
  if (result.profile) {  // cells of one row are as wide as they are long: only x counts
    overlap.min_y = 0;
    overlap.max_y = own ? *cell : coarsest->geometry().cell();
  }
  const GridGeometry whole =
      own ? GridGeometry::covering(overlap.min_x, overlap.min_y, overlap.max_x, overlap.max_y, *cell)
          : coarsest->geometry();
  const auto part = part_within(whole, overlap);
  if (!part) throw Error("the surfaces overlap by less than a cell: nothing to compare");
  const GridGeometry& target = *part;
  for (const SurfaceFile& file : files) {
    if (file.cloud) {
      result.maps.push_back(gridded(file, target));
      result.remarks.push_back(fmt::format("{}: {} points gridded in cells of {:g} m", file.name,
                                           file.cloud->size(), target.cell()));
    } else {
      const HeightMap& map = file.profile ? *file.profile : *file.map;
      if (std::abs(map.geometry().cell() / target.cell() - 1) > 1e-6)
        result.remarks.push_back(fmt::format("{}: resampled from cells of {:g} m to {:g} m", file.name,
                                             map.geometry().cell(), target.cell()));
      HeightMap placed = on_grid(file.profile ? band_of(map, target.cell()) : map, target);
      if (count_known(placed.layer(layer::elevation)) == 0)
        throw Error("'" + file.name + "': no cell is known where the surfaces overlap");
      result.maps.push_back(std::move(placed));
    }
  }
  return result;
}

HeightMap::Layer read_mask(const std::string& file, const GridGeometry& grid) {
  const HeightMap map = read_geotiff(file);
  const HeightMap::Layer& values = map.layer(map.names().front());
  HeightMap::Layer mask(grid.size(), 0);
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const CellIndex at = grid.cell_at(i);
    if (const auto cell = map.geometry().find(grid.x(at.x), grid.y(at.y)))
      mask[i] = values[map.geometry().index(*cell)] > 0.5F ? 1.0F : 0.0F;
  }
  if (std::none_of(mask.begin(), mask.end(), [](float v) { return v > 0; }))
    throw Error("'" + file + "': no cell of the compared grid is stable ground (a value above 0.5)");
  return mask;
}

}  // namespace aeolian
