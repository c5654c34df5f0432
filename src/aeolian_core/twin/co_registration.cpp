#include "aeolian_core/twin/co_registration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include <Eigen/Dense>

#include "aeolian_core/measure/ripple_pattern.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/resample.hpp"
#include "aeolian_core/surface/text.hpp"
#include "aeolian_core/surface/thinning.hpp"
#include "aeolian_core/twin/difference.hpp"

namespace aeolian {
namespace {

/// east, north, up [m], tilts east and north [m over half the map's extent], turn [m there].
constexpr int unknowns = 6;
using Vector = Eigen::Matrix<double, unknowns, 1>;
using Matrix = Eigen::Matrix<double, unknowns, unknowns>;
enum : int { east, north, up, tilt_east, tilt_north, turn };

/// A motion about the middle of a grid.
struct Motion {
  double middle_x, middle_y, extent;
  Vector by = Vector::Zero();

  explicit Motion(const GridGeometry& g)
      : middle_x(g.origin_x() + 0.5 * g.length_x()),
        middle_y(g.origin_y() + 0.5 * g.length_y()),
        extent(0.5 * std::hypot(g.length_x(), g.length_y())) {}

  /// The layers of a moved surface on a grid; only the elevation is lifted and tilted.
  HeightMap::Layer moved(const HeightMap& a, const std::string& name, const GridGeometry& grid) const {
    const HeightMap::Layer& values = a.layer(name);
    const bool rises = name == layer::elevation;
    const double c = std::cos(by[turn] / extent);
    const double s = std::sin(by[turn] / extent);
    HeightMap::Layer result;
    result.reserve(grid.size());
    for (int y = 0; y < grid.ny(); ++y)
      for (int x = 0; x < grid.nx(); ++x) {
        const double ux = grid.x(x) - middle_x;
        const double uy = grid.y(y) - middle_y;
        const double vx = ux - by[east];
        const double vy = uy - by[north];
        const double z = sample(a.geometry(), values, middle_x + c * vx + s * vy, middle_y - s * vx + c * vy);
        const double lift = rises ? by[up] + (by[tilt_east] * ux + by[tilt_north] * uy) / extent : 0;
        result.push_back(static_cast<float>(z + lift));
      }
    return result;
  }
  double farthest_sideways() const { return std::hypot(by[east], by[north]) + std::abs(by[turn]); }
  double farthest_up() const { return std::abs(by[up]) + std::hypot(by[tilt_east], by[tilt_north]); }
};

/// Which unknowns are solved for, as columns: horizontal directions may be oblique.
using Basis = Eigen::Matrix<double, unknowns, Eigen::Dynamic>;

/// A cell of the problem: what it says of the unknowns.
struct Row {
  Vector slope;
  double residual;
  int block;
};

struct Problem {
  std::vector<Row> rows;
  double scale = 0;          ///< robust standard deviation of the residuals [m]
  Eigen::Matrix2d gradient;  ///< mean product of slopes
};

/// cell_noise, or nothing where it cannot be told.
double known_noise(const HeightMap& map) {
  const double noise = cell_noise(map.geometry(), map.layer(layer::elevation));
  return std::isfinite(noise) ? noise : 0;
}

HeightMap averaged(const HeightMap& map, int factor) {
  if (factor == 1) return map;
  const GridGeometry grid = thinned(map.geometry(), factor);
  HeightMap result(grid);
  for (const std::string& name : map.names()) {
    HeightMap::Layer values(grid.size());
    thin(map.geometry(), map.layer(name), factor, {0, grid.nx(), 0, grid.ny()}, values);
    result.add(name, std::move(values));
  }
  return result;
}

/// Beside ground that changed, slopes are not those of stable ground.
float least_around(const HeightMap::Layer& values, std::size_t i, std::size_t stride) {
  float least = values[i];
  for (const std::size_t row : {i - stride, i, i + stride})
    for (const std::size_t at : {row - 1, row, row + 1}) least = std::min(least, values[at]);
  return least;
}

Problem problem_at(const HeightMap& a, const HeightMap& b, const HeightMap::Layer* stable,
                   const Motion& motion) {
  const GridGeometry& g = b.geometry();
  const HeightMap::Layer moved = motion.moved(a, layer::elevation, g);
  const HeightMap::Layer& fixed = b.layer(layer::elevation);
  const auto stride = static_cast<std::size_t>(g.nx());
  const int side = std::clamp(std::min(g.nx(), g.ny()) / 6, 4, 32);
  const int blocks_across = (g.nx() + side - 1) / side;
  Problem problem;
  problem.gradient.setZero();
  HeightMap::Layer residuals;
  for (int y = 1; y + 1 < g.ny(); ++y)
    for (int x = 1; x + 1 < g.nx(); ++x) {
      const std::size_t i = g.index(x, y);
      if (stable != nullptr && !(least_around(*stable, i, stride) > 0.99F)) continue;
      const auto mean = [&](std::size_t at) { return static_cast<double>(moved[at] + fixed[at]) / 2; };
      const double gx = (mean(i + 1) - mean(i - 1)) / (2 * g.cell());
      const double gy = (mean(i + stride) - mean(i - stride)) / (2 * g.cell());
      const double residual = static_cast<double>(fixed[i] - moved[i]);
      if (!std::isfinite(gx + gy + residual)) continue;
      const double ux = (g.x(x) - motion.middle_x) / motion.extent;
      const double uy = (g.y(y) - motion.middle_y) / motion.extent;
      Vector slope;
      slope << -gx, -gy, 1, ux, uy, gx * uy - gy * ux;
      problem.rows.push_back({slope, residual, y / side * blocks_across + x / side});
      problem.gradient += Eigen::Vector2d(gx, gy) * Eigen::RowVector2d(gx, gy);
      residuals.push_back(static_cast<float>(residual));
    }
  problem.gradient /= std::max(1.0, static_cast<double>(problem.rows.size()));
  if (!residuals.empty()) problem.scale = difference_statistics(residuals).nmad;
  return problem;
}

/// What is solved for: what the method allows and the relief holds.
Basis basis_of(CoRegistration method, const Problem& problem, double noise_slope, int& held) {
  std::vector<Vector> columns{Vector::Unit(up)};
  held = 0;
  if (method != CoRegistration::plane) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> relief(problem.gradient);
    for (int k = 0; k < 2; ++k) {
      if (!(relief.eigenvalues()[k] > 2 * noise_slope * noise_slope + 1e-12)) continue;
      ++held;
      Vector column = Vector::Zero();
      column.head<2>() = relief.eigenvectors().col(k);
      columns.push_back(column);
    }
  }
  if (method != CoRegistration::shift)
    for (const int unknown : {tilt_east, tilt_north}) columns.push_back(Vector::Unit(unknown));
  if (method == CoRegistration::rigid && held > 0) columns.push_back(Vector::Unit(turn));
  Basis basis(unknowns, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) basis.col(static_cast<Eigen::Index>(i)) = columns[i];
  return basis;
}

/// What a residual counts, and the derivative of its score.
struct Weight {
  double share;
  double derivative;
};

Weight weight_of(double residual, bool redescending) {
  constexpr double huber = 1.345;
  constexpr double tukey = 4.685;
  const double size = std::abs(residual);
  if (!redescending) return size <= huber ? Weight{1, 1} : Weight{huber / size, 0};
  const double u = size / tukey;
  const double rest = 1 - u * u;
  return rest > 0 ? Weight{rest * rest, rest * (1 - 5 * u * u)} : Weight{0, 0};
}

/// A step towards the least differences, and the covariance of where it ends.
std::pair<Vector, Matrix> solve(const Problem& problem, const Basis& basis, bool redescending) {
  const double scale = std::max(problem.scale, 1e-9);
  Matrix normal = Matrix::Zero();
  Matrix bread = Matrix::Zero();
  Vector right = Vector::Zero();
  std::map<int, Vector> scores;
  for (const Row& row : problem.rows) {
    const Weight weight = weight_of(row.residual / scale, redescending);
    const Matrix product = row.slope * row.slope.transpose();
    normal.noalias() += weight.share * product;
    bread.noalias() += weight.derivative * product;
    const Vector score = weight.share * row.residual * row.slope;
    right += score;
    scores.try_emplace(row.block, Vector::Zero()).first->second += score;
  }
  const Eigen::MatrixXd reduced = basis.transpose() * normal * basis;
  const Eigen::LDLT<Eigen::MatrixXd> solver(reduced);
  if (solver.info() != Eigen::Success || !(solver.rcond() > 1e-12))
    throw Error("co-registration: the common cells do not hold the surface (they lie in a line)");
  Matrix meat = Matrix::Zero();
  for (const auto& [block, score] : scores) meat.noalias() += score * score.transpose();
  const Eigen::MatrixXd inverse = Eigen::MatrixXd(basis.transpose() * bread * basis)
                                      .ldlt()
                                      .solve(Eigen::MatrixXd::Identity(basis.cols(), basis.cols()));
  const Eigen::MatrixXd covariance = inverse * (basis.transpose() * meat * basis) * inverse;
  return {basis * solver.solve(basis.transpose() * right), basis * covariance * basis.transpose()};
}

void require_within(const Motion& motion, double max_shift) {
  const double farthest = std::max(motion.farthest_sideways(), motion.farthest_up());
  if (farthest <= max_shift) return;
  std::string text = "co-registration: a point would move by ";
  append_number(text, static_cast<float>(farthest));
  text += " m, more than ";
  append_number(text, static_cast<float>(max_shift));
  throw Error(text + " m is not allowed");
}

}  // namespace

CoRegistered co_register(const HeightMap& a, const HeightMap& b, CoRegistration method, double max_shift,
                         const HeightMap::Layer* stable) {
  if (!(max_shift > 0)) throw Error("co-registration: the longest shift must be positive");
  constexpr std::size_t fewest = 100;
  constexpr int most_steps = 60;
  constexpr double enough = 1e-3;  // of a cell
  Motion motion(b.geometry());
  HeightMap fixed = b;
  if (stable != nullptr) {
    HeightMap::Layer& mask = fixed.add("stable", *stable);
    for (float& v : mask) v = v > 0.5F ? 1.0F : 0.0F;
  }
  CoRegistered result;
  Matrix covariance = Matrix::Zero();
  for (const int factor : {8, 4, 2, 1}) {
    if (factor > 1 && std::min(b.geometry().nx(), b.geometry().ny()) / factor < 32) continue;
    const HeightMap coarse_a = averaged(a, factor);
    const HeightMap coarse_b = averaged(fixed, factor);
    const HeightMap::Layer* ground = stable != nullptr ? &coarse_b.layer("stable") : nullptr;
    const double cell = coarse_b.geometry().cell();
    // Slopes that noise alone makes of the mean of two maps.
    const double noise_slope =
        std::hypot(known_noise(coarse_a), known_noise(coarse_b)) / (std::sqrt(8.0) * cell);
    bool settled = false;
    for (int step = 0; step < most_steps && !settled; ++step) {
      const Problem problem = problem_at(coarse_a, coarse_b, ground, motion);
      if (factor > 1 && problem.rows.size() < fewest) break;
      if (problem.rows.size() < fewest)
        throw Error("co-registration: " + std::to_string(problem.rows.size()) +
                    (stable != nullptr ? " cells of stable ground" : " cells") +
                    " are known in both surfaces, at least " + std::to_string(fewest) + " are needed");
      if (factor == 1 && step == 0) {
        Motion none(b.geometry());
        result.nmad_before = problem_at(coarse_a, coarse_b, ground, none).scale;
      }
      const Basis basis = basis_of(method, problem, noise_slope, result.held);
      Vector by;
      std::tie(by, covariance) = solve(problem, basis, factor == 1);
      // A step is trusted for a cell, within which the surface is linear enough.
      const double farthest = std::hypot(by[east], by[north]) + std::abs(by[turn]);
      if (farthest > cell) by *= cell / farthest;
      motion.by += by;
      result.cells = problem.rows.size();
      result.nmad_after = problem.scale;
      const double height = std::abs(by[up]) + std::hypot(by[tilt_east], by[tilt_north]);
      settled = farthest < enough * cell && height < enough * problem.scale + 1e-9;
    }
    if (factor == 1 && !settled)
      throw Error("co-registration: does not settle within " + std::to_string(most_steps) + " steps");
    require_within(motion, max_shift);
  }
  result.map = HeightMap(b.geometry());
  for (const std::string& name : {layer::elevation, layer::variance})
    if (a.has(name)) result.map.add(name, motion.moved(a, name, b.geometry()));
  const auto figure = [&](int unknown, double factor) -> Figure {
    return {motion.by[unknown] * factor, std::sqrt(covariance(unknown, unknown)) * factor};
  };
  result.east = figure(east, 1);
  result.north = figure(north, 1);
  result.up = figure(up, 1);
  result.tilt_east = figure(tilt_east, 1 / motion.extent);
  result.tilt_north = figure(tilt_north, 1 / motion.extent);
  result.turn = figure(turn, 1 / motion.extent);
  return result;
}

}  // namespace aeolian
