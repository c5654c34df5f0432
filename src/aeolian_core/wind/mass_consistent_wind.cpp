#include "aeolian_core/wind/mass_consistent_wind.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "aeolian_core/surface/require.hpp"
#include "aeolian_core/wind/flow_potential.hpp"
#include "aeolian_core/wind/wall_law_response.hpp"

namespace aeolian {
namespace {

constexpr Require require("wind volume");
constexpr double allowed_imbalance = 2e-8;  ///< summed over all boxes, of what flows into the grid

std::vector<double> lengths(const std::vector<double>& borders) {
  std::vector<double> result;
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) result.push_back(borders[i + 1] - borders[i]);
  return result;
}

/// Between which middles of boxes, or borders, a place lies.
struct Between {
  int low;
  double part;
};
Between between_borders(const std::vector<double>& b, double at) {
  const auto i = static_cast<int>(std::upper_bound(b.begin(), b.end(), at) - b.begin()) - 1;
  const int low = std::clamp(i, 0, static_cast<int>(b.size()) - 2);
  const auto l = static_cast<std::size_t>(low);
  return {low, std::clamp((at - b[l]) / (b[l + 1] - b[l]), 0.0, 1.0)};
}
Between between_middles(const std::vector<double>& b, double at) {
  const Between box = between_borders(b, at);
  const auto middle = [&](int i) {
    return 0.5 * (b[static_cast<std::size_t>(i)] + b[static_cast<std::size_t>(i) + 1]);
  };
  const int n = static_cast<int>(b.size()) - 1;
  const int low = std::clamp(box.part < 0.5 ? box.low - 1 : box.low, 0, std::max(n - 2, 0));
  if (n == 1) return {0, 0};
  return {low, std::clamp((at - middle(low)) / (middle(low + 1) - middle(low)), 0.0, 1.0)};
}

}  // namespace

MassConsistentVolume::MassConsistentVolume(const WindRelief& relief, double direction,
                                           const UpwindProfile& upwind, const Settings& settings)
    : relief_(relief), upwind_(upwind), grid_(relief_, settings.max_boxes) {
  require(std::isfinite(direction), "direction", direction, "finite [rad]");
  require(settings.max_boxes >= 1000, "number of boxes", static_cast<double>(settings.max_boxes),
          "1000 or more");
  require(settings.vertical_ease > 0 && settings.vertical_ease <= 1e6, "vertical ease",
          settings.vertical_ease, "positive and at most 1e6");
  // The boxes that the ground cuts know their wind least.
  reference_ = 2 * (grid_.z()[1] - grid_.z()[0]);
  top_ = grid_.z().back() - *std::max_element(relief_.height.begin(), relief_.height.end());
  guess(direction);
  correct(settings);
}

void MassConsistentVolume::guess(double direction) {
  const int nx = grid_.nx();
  const int ny = grid_.ny();
  const int nz = grid_.nz();
  open_ = FaceFlows(nx, ny, nz);
  upstream_ = FaceFlows(nx, ny, nz);
  flows_ = FaceFlows(nx, ny, nz);
  const double c = std::cos(direction);
  const double s = std::sin(direction);
  constexpr int samples = AirGrid::samples;
  // The upwind profile over the ground at each sample, where it is open above it.
  const auto face = [&](const double* heights, int iz, double width, double part, double& area, double& speed,
                        double& flow) {
    const double low = grid_.z()[static_cast<std::size_t>(iz)];
    const double high = grid_.z()[static_cast<std::size_t>(iz) + 1];
    area = 0;
    double through = 0;
    for (int n = 0; n < samples; ++n) {
      const double from = std::max(low, heights[n]);
      if (from >= high) continue;
      const double strip = width / samples * (high - from);
      area += strip;
      through += strip * upwind_.mean(from - heights[n], high - heights[n]);
    }
    speed = area > 0 ? through / area : 0;
    flow = part * through;
  };
  tbb::parallel_for(0, ny + 1, [&](int iy) {
    double heights[samples * samples];
    for (int ix = 0; ix <= nx; ++ix) {
      const auto i = static_cast<std::size_t>(ix);
      const auto j = static_cast<std::size_t>(iy);
      if (iy < ny) {
        grid_.western_edge(ix, iy, heights);
        for (int iz = 0; iz < nz; ++iz)
          face(heights, iz, grid_.y()[j + 1] - grid_.y()[j], c, open_.x(ix, iy, iz), upstream_.x(ix, iy, iz),
               flows_.x(ix, iy, iz));
      }
      if (ix < nx) {
        grid_.southern_edge(ix, iy, heights);
        for (int iz = 0; iz < nz; ++iz)
          face(heights, iz, grid_.x()[i + 1] - grid_.x()[i], s, open_.y(ix, iy, iz), upstream_.y(ix, iy, iz),
               flows_.y(ix, iy, iz));
      }
      if (iy == ny || ix == nx) continue;
      grid_.footprint(ix, iy, heights);
      const double area = (grid_.x()[i + 1] - grid_.x()[i]) * (grid_.y()[j + 1] - grid_.y()[j]);
      for (int iz = 1; iz <= nz; ++iz) {
        const double z = grid_.z()[static_cast<std::size_t>(iz)];
        const auto below =
            std::count_if(heights, heights + samples * samples, [&](double h) { return h < z; });
        open_.z(ix, iy, iz) = area * static_cast<double>(below) / (samples * samples);
      }
    }
  });
}

void MassConsistentVolume::correct(const Settings& settings) {
  const int nx = grid_.nx();
  const int ny = grid_.ny();
  const int nz = grid_.nz();
  const std::vector<double> dx = lengths(grid_.x());
  const std::vector<double> dy = lengths(grid_.y());
  const std::vector<double> dz = lengths(grid_.z());
  const auto way = [](const std::vector<double>& length, int border) {
    const auto i = static_cast<std::size_t>(border);
    return 0.5 * ((i > 0 ? length[i - 1] : 0) + (i < length.size() ? length[i] : 0));
  };
  PotentialEquation equation{nx, ny, nz, {}, {}, {}};
  for (int iy = 0; iy < ny; ++iy)
    for (int ix = 0; ix <= nx; ++ix)
      for (int iz = 0; iz < nz; ++iz)
        equation.x.push_back(grid_.thin_x() ? 0 : open_.x(ix, iy, iz) / way(dx, ix));
  for (int iy = 0; iy <= ny; ++iy)
    for (int ix = 0; ix < nx; ++ix)
      for (int iz = 0; iz < nz; ++iz)
        equation.y.push_back(grid_.thin_y() ? 0 : open_.y(ix, iy, iz) / way(dy, iy));
  for (int iy = 0; iy < ny; ++iy)
    for (int ix = 0; ix < nx; ++ix)
      for (int iz = 0; iz <= nz; ++iz)
        equation.z.push_back(settings.vertical_ease * open_.z(ix, iy, iz) / way(dz, iz));

  std::vector<double> right;
  right.reserve(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz));
  for (int iy = 0; iy < ny; ++iy)
    for (int ix = 0; ix < nx; ++ix)
      for (int iz = 0; iz < nz; ++iz)
        right.push_back(flows_.x(ix, iy, iz) - flows_.x(ix + 1, iy, iz) + flows_.y(ix, iy, iz) -
                        flows_.y(ix, iy + 1, iz) + flows_.z(ix, iy, iz) - flows_.z(ix, iy, iz + 1));
  const double inflow = flows_.balance({0, nx, 0, ny, 0, nz}).inflow;
  const PotentialEquation a = equation;
  FlowPotential solver(std::move(equation), dx, dy);
  const std::vector<double> p = solver.solve(right, allowed_imbalance * inflow);
  iterations_ = solver.iterations();
  const auto potential = [&](int ix, int iy, int iz) {
    if (ix < 0 || iy < 0 || iz < 0 || ix >= nx || iy >= ny || iz >= nz) return 0.0;
    return p[(static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(ix)) *
                 static_cast<std::size_t>(nz) +
             static_cast<std::size_t>(iz)];
  };
  std::size_t i = 0;
  for (int iy = 0; iy < ny; ++iy)
    for (int ix = 0; ix <= nx; ++ix)
      for (int iz = 0; iz < nz; ++iz)
        flows_.x(ix, iy, iz) += a.x[i++] * (potential(ix - 1, iy, iz) - potential(ix, iy, iz));
  i = 0;
  for (int iy = 0; iy <= ny; ++iy)
    for (int ix = 0; ix < nx; ++ix)
      for (int iz = 0; iz < nz; ++iz)
        flows_.y(ix, iy, iz) += a.y[i++] * (potential(ix, iy - 1, iz) - potential(ix, iy, iz));
  i = 0;
  for (int iy = 0; iy < ny; ++iy)
    for (int ix = 0; ix < nx; ++ix)
      for (int iz = 0; iz <= nz; ++iz)
        flows_.z(ix, iy, iz) += a.z[i++] * (potential(ix, iy, iz - 1) - potential(ix, iy, iz));
}

AirVelocity MassConsistentVolume::resolved(double x, double y, double height) const {
  const double z = grid_.ground(x, y) + height;
  const Between box[] = {between_middles(grid_.x(), x), between_middles(grid_.y(), y),
                         between_middles(grid_.z(), z)};
  const Between face[] = {between_borders(grid_.x(), x), between_borders(grid_.y(), y),
                          between_borders(grid_.z(), z)};
  // Trilinear between what the faces that are open have over their upwind speed, which varies most with
  // height.
  const auto mean = [](const Between& bx, const Between& by, const Between& bz, auto&& open, auto&& value) {
    double sum = 0;
    double weights = 0;
    for (int n = 0; n < 8; ++n) {
      const double w =
          (n & 1 ? bx.part : 1 - bx.part) * (n & 2 ? by.part : 1 - by.part) * (n & 4 ? bz.part : 1 - bz.part);
      const int ix = bx.low + (n & 1);
      const int iy = by.low + (n >> 1 & 1);
      const int iz = bz.low + (n >> 2 & 1);
      const double counts = w > 0 ? w * open(ix, iy, iz) : 0;
      if (!(counts > 0)) continue;
      weights += counts;
      sum += counts * value(ix, iy, iz);
    }
    return weights > 0 ? sum / weights : 0;
  };
  const auto length = [](const std::vector<double>& borders, int i) {
    return borders[static_cast<std::size_t>(i) + 1] - borders[static_cast<std::size_t>(i)];
  };
  const double east = mean(
      face[0], box[1], box[2],
      [&](int i, int j, int k) {
        const double whole = length(grid_.y(), j) * length(grid_.z(), k);
        return upstream_.x(i, j, k) > 0 ? open_.x(i, j, k) / whole : 0;
      },
      [&](int i, int j, int k) { return flows_.x(i, j, k) / (open_.x(i, j, k) * upstream_.x(i, j, k)); });
  const double north = mean(
      box[0], face[1], box[2],
      [&](int i, int j, int k) {
        const double whole = length(grid_.x(), i) * length(grid_.z(), k);
        return upstream_.y(i, j, k) > 0 ? open_.y(i, j, k) / whole : 0;
      },
      [&](int i, int j, int k) { return flows_.y(i, j, k) / (open_.y(i, j, k) * upstream_.y(i, j, k)); });
  const double up = mean(
      box[0], box[1], face[2],
      [&](int i, int j, int k) { return open_.z(i, j, k) / (length(grid_.x(), i) * length(grid_.y(), j)); },
      [&](int i, int j, int k) { return flows_.z(i, j, k) / open_.z(i, j, k); });
  const double speed = upwind_.speed(height);
  return {speed * east, speed * north, up};
}

AirVelocity MassConsistentVolume::velocity(double x, double y, double height) const {
  if (!relief_.geometry.find(x, y) || !(height <= top())) return {NAN, NAN, NAN};
  if (height <= upwind_.roughness()) return {};
  if (!upwind_.sheared() || height >= reference_) return resolved(x, y, height);
  // Within the lowest boxes by the law of the wall, along the ground.
  AirVelocity wind = resolved(x, y, reference_);
  const double part = upwind_.speed(height) / upwind_.speed(reference_);
  return {part * wind.east, part * wind.north, part * wind.up};
}

TerrainResponse mass_consistent_response(const HeightMap& surface, double direction,
                                         const ReliefSettings& settings,
                                         const MassConsistentVolume::Settings& solver) {
  const WindRelief relief = wind_relief(surface, settings.shortest());
  const MassConsistentVolume volume(relief, direction, UpwindProfile::log_law(settings.roughness), solver);
  return wall_law_response(surface, relief, volume, direction, settings, volume.reference_height());
}

}  // namespace aeolian
