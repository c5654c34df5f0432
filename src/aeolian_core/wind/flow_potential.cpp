#include "aeolian_core/wind/flow_potential.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <tbb/parallel_for.h>

namespace aeolian {
namespace {

constexpr int most_iterations = 200;
constexpr int coarsest_sweeps = 6;

std::size_t at(int ix, int iy, int row, int height) {
  return (static_cast<std::size_t>(iy) * static_cast<std::size_t>(row) + static_cast<std::size_t>(ix)) *
         static_cast<std::size_t>(height);
}

/// Joins neighbours in pairs; an odd last one stays alone.
std::vector<double> joined(const std::vector<double>& lengths) {
  std::vector<double> result;
  for (std::size_t i = 0; i < lengths.size(); i += 2)
    result.push_back(lengths[i] + (i + 1 < lengths.size() ? lengths[i + 1] : 0));
  return result;
}

/// Distance of the middles of the boxes on both sides of border i.
double distance(const std::vector<double>& lengths, std::size_t i) {
  return 0.5 * ((i > 0 ? lengths[i - 1] : 0) + (i < lengths.size() ? lengths[i] : 0));
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

FlowPotential::FlowPotential(PotentialEquation equation, const std::vector<double>& lengths_x,
                             const std::vector<double>& lengths_y) {
  levels_.push_back({std::move(equation), lengths_x, lengths_y, {}, {}, {}, {}});
  factor(levels_.back());
  while (levels_.back().a.nx > 2 || levels_.back().a.ny > 2) levels_.push_back(coarser(levels_.back()));
}

FlowPotential::Level FlowPotential::coarser(const Level& fine) {
  const PotentialEquation& f = fine.a;
  Level level{{}, joined(fine.lengths_x), joined(fine.lengths_y), {}, {}, {}, {}};
  PotentialEquation& a = level.a;
  a = {static_cast<int>(level.lengths_x.size()), static_cast<int>(level.lengths_y.size()), f.nz, {}, {}, {}};
  const auto nz = static_cast<std::size_t>(f.nz);
  a.x.resize(at(0, a.ny, a.nx + 1, f.nz));
  a.y.resize(at(0, a.ny + 1, a.nx, f.nz));
  a.z.resize(at(0, a.ny, a.nx, f.nz + 1));
  for (int iy = 0; iy < f.ny; ++iy)
    for (int ix = 0; ix <= a.nx; ++ix) {
      const int from = std::min(2 * ix, f.nx);
      // The same area, but a longer way.
      const double scale = distance(fine.lengths_x, static_cast<std::size_t>(from)) /
                           distance(level.lengths_x, static_cast<std::size_t>(ix));
      for (std::size_t iz = 0; iz < nz; ++iz)
        a.x[at(ix, iy / 2, a.nx + 1, f.nz) + iz] += scale * f.x[at(from, iy, f.nx + 1, f.nz) + iz];
    }
  for (int iy = 0; iy <= a.ny; ++iy) {
    const int from = std::min(2 * iy, f.ny);
    const double scale = distance(fine.lengths_y, static_cast<std::size_t>(from)) /
                         distance(level.lengths_y, static_cast<std::size_t>(iy));
    for (int ix = 0; ix < f.nx; ++ix)
      for (std::size_t iz = 0; iz < nz; ++iz)
        a.y[at(ix / 2, iy, a.nx, f.nz) + iz] += scale * f.y[at(ix, from, f.nx, f.nz) + iz];
  }
  for (int iy = 0; iy < f.ny; ++iy)
    for (int ix = 0; ix < f.nx; ++ix)
      for (std::size_t iz = 0; iz <= nz; ++iz)
        a.z[at(ix / 2, iy / 2, a.nx, f.nz + 1) + iz] += f.z[at(ix, iy, f.nx, f.nz + 1) + iz];
  factor(level);
  return level;
}

void FlowPotential::factor(Level& level) {
  const PotentialEquation& a = level.a;
  const auto nz = static_cast<std::size_t>(a.nz);
  level.diagonal.resize(at(0, a.ny, a.nx, a.nz));
  level.inverse_pivot.resize(level.size());
  level.right.resize(level.size());
  level.potential.resize(level.size());
  for (int iy = 0; iy < a.ny; ++iy)
    for (int ix = 0; ix < a.nx; ++ix) {
      const double* west = &a.x[at(ix, iy, a.nx + 1, a.nz)];
      const double* east = &a.x[at(ix + 1, iy, a.nx + 1, a.nz)];
      const double* south = &a.y[at(ix, iy, a.nx, a.nz)];
      const double* north = &a.y[at(ix, iy + 1, a.nx, a.nz)];
      const double* below = &a.z[at(ix, iy, a.nx, a.nz + 1)];
      const std::size_t column = at(ix, iy, a.nx, a.nz);
      double carried = 0;
      for (std::size_t iz = 0; iz < nz; ++iz) {
        const double d = west[iz] + east[iz] + south[iz] + north[iz] + below[iz] + below[iz + 1];
        const double pivot = d - below[iz] * below[iz] * carried;
        level.diagonal[column + iz] = d;
        // Air shut in by the ground has no way out and no potential.
        carried = pivot > 1e-12 * d ? 1 / pivot : 0;
        level.inverse_pivot[column + iz] = carried;
      }
    }
}

double FlowPotential::neighbours(const Level& level, const std::vector<double>& p, int ix, int iy, int iz) {
  const PotentialEquation& a = level.a;
  const auto z = static_cast<std::size_t>(iz);
  double sum = 0;
  if (ix > 0) sum += a.x[at(ix, iy, a.nx + 1, a.nz) + z] * p[at(ix - 1, iy, a.nx, a.nz) + z];
  if (ix + 1 < a.nx) sum += a.x[at(ix + 1, iy, a.nx + 1, a.nz) + z] * p[at(ix + 1, iy, a.nx, a.nz) + z];
  if (iy > 0) sum += a.y[at(ix, iy, a.nx, a.nz) + z] * p[at(ix, iy - 1, a.nx, a.nz) + z];
  if (iy + 1 < a.ny) sum += a.y[at(ix, iy + 1, a.nx, a.nz) + z] * p[at(ix, iy + 1, a.nx, a.nz) + z];
  return sum;
}

void FlowPotential::smooth(Level& level, bool forward) {
  const PotentialEquation& a = level.a;
  for (int pass = 0; pass < 2; ++pass) {
    const int colour = forward ? pass : 1 - pass;
    tbb::parallel_for(0, a.ny, [&](int iy) {
      std::vector<double> line(static_cast<std::size_t>(a.nz));
      for (int ix = (iy + colour) % 2; ix < a.nx; ix += 2) {
        const std::size_t column = at(ix, iy, a.nx, a.nz);
        const double* below = &a.z[at(ix, iy, a.nx, a.nz + 1)];
        double carried = 0;
        for (int iz = 0; iz < a.nz; ++iz) {
          const auto z = static_cast<std::size_t>(iz);
          const double right = level.right[column + z] + neighbours(level, level.potential, ix, iy, iz);
          carried = (right + below[z] * carried) * level.inverse_pivot[column + z];
          line[z] = carried;
        }
        carried = 0;
        for (int iz = a.nz - 1; iz >= 0; --iz) {
          const auto z = static_cast<std::size_t>(iz);
          carried = line[z] + below[z + 1] * level.inverse_pivot[column + z] * carried;
          level.potential[column + z] = carried;
        }
      }
    });
  }
}

void FlowPotential::multiply(const Level& level, const std::vector<double>& p, std::vector<double>& result) {
  const PotentialEquation& a = level.a;
  tbb::parallel_for(0, a.ny, [&](int iy) {
    for (int ix = 0; ix < a.nx; ++ix) {
      const std::size_t column = at(ix, iy, a.nx, a.nz);
      const double* below = &a.z[at(ix, iy, a.nx, a.nz + 1)];
      for (int iz = 0; iz < a.nz; ++iz) {
        const auto z = static_cast<std::size_t>(iz);
        double sum = neighbours(level, p, ix, iy, iz);
        if (iz > 0) sum += below[z] * p[column + z - 1];
        if (iz + 1 < a.nz) sum += below[z + 1] * p[column + z + 1];
        result[column + z] = level.diagonal[column + z] * p[column + z] - sum;
      }
    }
  });
}

void FlowPotential::cycle(std::size_t number) {
  Level& level = levels_[number];
  std::fill(level.potential.begin(), level.potential.end(), 0.0);
  if (number + 1 == levels_.size()) {
    for (int n = 0; n < coarsest_sweeps; ++n) smooth(level, true);
    for (int n = 0; n < coarsest_sweeps; ++n) smooth(level, false);
    return;
  }
  smooth(level, true);
  Level& next = levels_[number + 1];
  std::vector<double> rest(level.size());
  multiply(level, level.potential, rest);
  const PotentialEquation& a = level.a;
  std::fill(next.right.begin(), next.right.end(), 0.0);
  const auto nz = static_cast<std::size_t>(a.nz);
  for (int iy = 0; iy < a.ny; ++iy)
    for (int ix = 0; ix < a.nx; ++ix) {
      const std::size_t from = at(ix, iy, a.nx, a.nz);
      double* to = &next.right[at(ix / 2, iy / 2, next.a.nx, a.nz)];
      for (std::size_t z = 0; z < nz; ++z) to[z] += level.right[from + z] - rest[from + z];
    }
  cycle(number + 1);
  for (int iy = 0; iy < a.ny; ++iy)
    for (int ix = 0; ix < a.nx; ++ix) {
      const std::size_t to = at(ix, iy, a.nx, a.nz);
      const double* from = &next.potential[at(ix / 2, iy / 2, next.a.nx, a.nz)];
      for (std::size_t z = 0; z < nz; ++z)
        if (level.inverse_pivot[to + z] > 0) level.potential[to + z] += from[z];
    }
  smooth(level, false);
}

std::vector<double> FlowPotential::solve(const std::vector<double>& right, double allowed) {
  Level& top = levels_.front();
  const std::size_t n = top.size();
  std::vector<double> potential(n), rest(right), along(n), product(n);
  double last = 0;
  double least = INFINITY;
  for (iterations_ = 0; iterations_ < most_iterations; ++iterations_) {
    double error = 0;
    for (const double r : rest) error += std::abs(r);
    if (error <= allowed) break;
    if (iterations_ % 20 == 19) {  // rounding has the last word
      if (error > 0.5 * least) break;
      least = error;
    }
    top.right = rest;
    cycle(0);
    const double now = dot(rest, top.potential);
    if (!(now > 0)) break;
    const double turn = last > 0 ? now / last : 0;
    for (std::size_t i = 0; i < n; ++i) along[i] = top.potential[i] + turn * along[i];
    multiply(top, along, product);
    const double curvature = dot(along, product);
    if (!(curvature > 0)) break;
    const double step = now / curvature;
    for (std::size_t i = 0; i < n; ++i) {
      potential[i] += step * along[i];
      rest[i] -= step * product[i];
    }
    last = now;
  }
  return potential;
}

}  // namespace aeolian
