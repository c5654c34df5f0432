#include "aeolian_core/measure/map_surface.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace aeolian {
namespace {

constexpr int plane_reach = 3;  // cells to each side of a plane's own
constexpr int most = (2 * plane_reach + 1) * (2 * plane_reach + 1);
constexpr int fewest_cells = most / 2;
constexpr double least_normal_z = 0.5;
constexpr double most_normal_variance = 0.3 * 0.3;

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Terms = Eigen::Matrix<double, 6, 1>;  // of a quadratic, in cells from the middle

/// The cells of a window that are known.
struct Offsets {
  CellIndex cells[most];
  int count = 0;
  void add(CellIndex cell) { cells[count++] = cell; }
};

Terms terms_of(CellIndex offset) {
  const double x = offset.x;
  const double y = offset.y;
  Terms terms;
  terms << 1, x, y, x * x, x * y, y * y;
  return terms;
}

/// Of the normal matrix of a quadratic through cells; nothing when they do not determine it.
std::optional<Matrix6> inverse_for(const Offsets& known) {
  Matrix6 normal_matrix = Matrix6::Zero();
  for (int i = 0; i < known.count; ++i)
    normal_matrix += terms_of(known.cells[i]) * terms_of(known.cells[i]).transpose();
  const Eigen::LLT<Matrix6> solver(normal_matrix);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return solver.solve(Matrix6::Identity());
}

/// The same for a whole window: most are.
const Matrix6& whole_inverse() {
  static const Matrix6 inverse = [] {
    Offsets all;
    for (int y = -plane_reach; y <= plane_reach; ++y)
      for (int x = -plane_reach; x <= plane_reach; ++x) all.add({x, y});
    return *inverse_for(all);
  }();
  return inverse;
}

}  // namespace

MapSurface::MapSurface(const HeightMap& map, const Eigen::Vector3d& origin)
    : geometry_(map.geometry()),
      elevation_(map.layer(layer::elevation)),
      origin_(origin),
      planes_(map.geometry().size()) {}

MapSurface::Plane MapSurface::fitted(CellIndex cell) const {
  const Plane none{0, 0, 0, 0, State::none};
  const double own = static_cast<double>(elevation_[geometry_.index(cell)]);
  if (!std::isfinite(own)) return none;
  Terms right = Terms::Zero();
  double squares = 0;
  Offsets known;
  for (int y = std::max(cell.y - plane_reach, 0); y <= std::min(cell.y + plane_reach, geometry_.ny() - 1);
       ++y)
    for (int x = std::max(cell.x - plane_reach, 0); x <= std::min(cell.x + plane_reach, geometry_.nx() - 1);
         ++x) {
      const double height = static_cast<double>(elevation_[geometry_.index(x, y)]) - own;
      if (!std::isfinite(height)) continue;
      const CellIndex offset{x - cell.x, y - cell.y};
      right += height * terms_of(offset);
      squares += height * height;
      known.add(offset);
    }
  if (known.count < fewest_cells) return none;
  const std::optional<Matrix6> inverse = known.count == most ? whole_inverse() : inverse_for(known);
  if (!inverse) return none;
  const Terms solution = *inverse * right;
  const double scatter = std::max(squares - solution.dot(right), 0.0) / (known.count - 6);
  const double per_cell = 1 / geometry_.cell();
  const Eigen::Vector2d slope = solution.segment<2>(1) * per_cell;
  const double cosine = 1 / std::sqrt(1 + slope.squaredNorm());
  // An error of the slope turns the normal by at most its cosine times as much.
  const double variance =
      scatter * std::max((*inverse)(1, 1), (*inverse)(2, 2)) * std::pow(per_cell * cosine, 2);
  if (cosine < least_normal_z || variance > most_normal_variance) return none;
  return {static_cast<float>(own + solution[0]), static_cast<float>(slope.x()), static_cast<float>(slope.y()),
          static_cast<float>(variance), State::fitted};
}

const MapSurface::Plane* MapSurface::plane(CellIndex cell) {
  if (!geometry_.contains(cell)) return nullptr;
  Plane& result = planes_[geometry_.index(cell)];
  if (result.state == State::unasked) result = fitted(cell);
  return result.state == State::fitted ? &result : nullptr;
}

std::optional<PointOnPlane> MapSurface::under(const Eigen::Vector3d& point) {
  const Eigen::Vector3d p = point + origin_;
  const auto cell = geometry_.find(p.x(), p.y());
  if (!cell || plane(*cell) == nullptr) return std::nullopt;
  const double x = (p.x() - geometry_.x(cell->x)) / geometry_.cell();
  const double y = (p.y() - geometry_.y(cell->y)) / geometry_.cell();
  const int to_x = x < 0 ? -1 : 1;
  const int to_y = y < 0 ? -1 : 1;
  double total = 0;
  double height = 0;
  double variance = 0;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  for (const int ix : {0, 1})
    for (const int iy : {0, 1}) {
      const CellIndex at{cell->x + ix * to_x, cell->y + iy * to_y};
      const Plane* of_cell = plane(at);
      if (of_cell == nullptr) continue;
      const double weight =
          (ix == 0 ? 1 - std::abs(x) : std::abs(x)) * (iy == 0 ? 1 - std::abs(y) : std::abs(y));
      const Eigen::Vector2d gradient(of_cell->slope_x, of_cell->slope_y);
      const Eigen::Vector2d away(p.x() - geometry_.x(at.x), p.y() - geometry_.y(at.y));
      total += weight;
      height += weight * (static_cast<double>(of_cell->height) + gradient.dot(away));
      slope += weight * gradient;
      variance += weight * static_cast<double>(of_cell->normal_variance);
    }
  slope /= total;
  const Eigen::Vector3d normal = Eigen::Vector3d(-slope.x(), -slope.y(), 1).normalized();
  return PointOnPlane{point, normal, normal.z() * (p.z() - height / total), variance / total};
}

std::vector<PointOnPlane> MapSurface::pairs(const std::vector<Eigen::Vector3d>& points, double max_distance) {
  std::vector<PointOnPlane> result;
  result.reserve(points.size());
  for (const Eigen::Vector3d& point : points)
    if (const auto pair = under(point); pair && std::abs(pair->residual) <= max_distance)
      result.push_back(*pair);
  return result;
}

std::vector<Eigen::Vector3d> MapSurface::cells_around(const std::vector<Eigen::Vector3d>& points,
                                                      double margin) const {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector3d& point : points) box.extend((point + origin_).head<2>());
  const Eigen::Vector2d reach_out(margin, margin);
  box = Eigen::AlignedBox2d(box.min() - reach_out, box.max() + reach_out);
  std::vector<Eigen::Vector3d> cells;
  for (int iy = 0; iy < geometry_.ny(); ++iy)
    for (int ix = 0; ix < geometry_.nx(); ++ix) {
      const double height = static_cast<double>(elevation_[geometry_.index(ix, iy)]);
      const Eigen::Vector2d at(geometry_.x(ix), geometry_.y(iy));
      if (std::isfinite(height) && box.contains(at))
        cells.push_back(Eigen::Vector3d(at.x(), at.y(), height) - origin_);
    }
  return cells;
}

}  // namespace aeolian
