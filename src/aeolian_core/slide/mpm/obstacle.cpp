#include "aeolian_core/slide/mpm/obstacle.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {

template <int Dim>
HalfSpace<Dim>::HalfSpace(const Point<Dim>& point, const Point<Dim>& normal)
    : point_(point), normal_(normal.normalized()) {
  constexpr Require require{"half-space"};
  require(normal.norm() > 0 && normal.allFinite() && point.allFinite(), "length of the normal", normal.norm(),
          "positive");
}

template <int Dim>
Nearness<Dim> HalfSpace<Dim>::at(const Point<Dim>& point) const {
  return {normal_.dot(point - point_), normal_};
}

template <int Dim>
Plate<Dim>::Plate(const Point<Dim>& centre, const Axes& axes, const Point<Dim>& half_size)
    : centre_(centre), axes_(axes), half_(half_size) {
  constexpr Require require{"plate"};
  require(half_size.minCoeff() > 0 && half_size.allFinite(), "half size", half_size.minCoeff(), "positive");
}

template <int Dim>
Nearness<Dim> Plate<Dim>::at(const Point<Dim>& point) const {
  const Point<Dim> local = axes_.transpose() * (point - centre_);
  const Point<Dim> beyond = local.cwiseAbs() - half_;
  const Point<Dim> outside = beyond.cwiseMax(0);
  const double distance = outside.norm();
  Point<Dim> normal = Point<Dim>::Zero();
  if (distance > 0) {
    for (int d = 0; d < Dim; ++d) normal[d] = std::copysign(outside[d] / distance, local[d]);
    return {distance, axes_ * normal};
  }
  normal[Dim - 1] = local[Dim - 1] < 0 ? -1 : 1;
  return {beyond[Dim - 1], axes_ * normal};
}

template <int Dim>
Terrain<Dim>::Terrain(const HeightMap& map)
    : geometry_(map.geometry()), elevation_(map.layer(layer::elevation)) {
  for (std::size_t k = 0; k < elevation_.size(); ++k)
    if (!std::isfinite(elevation_[k])) {
      const CellIndex cell = geometry_.cell_at(k);
      throw Error("ground: elevation of cell (" + std::to_string(cell.x) + ", " + std::to_string(cell.y) +
                  ") is not known, must be finite everywhere");
    }
  if (elevation_.empty()) throw Error("ground: the map has 0 cells, must have at least 1");
  highest_ = *std::max_element(elevation_.begin(), elevation_.end());
}

namespace {

/// Two neighbours along an axis and how far from the first to the second.
struct Between {
  int first, second;
  double share;
};

Between between(double cells, int count) {
  const double held = std::clamp(cells - 0.5, 0.0, static_cast<double>(count - 1));
  const int first = std::min(static_cast<int>(held), std::max(count - 2, 0));
  return {first, std::min(first + 1, count - 1), held - first};
}

}  // namespace

template <int Dim>
Nearness<Dim> Terrain<Dim>::at(const Point<Dim>& point) const {
  const double cell = geometry_.cell();
  const Between x = between((point[0] - geometry_.origin_x()) / cell, geometry_.nx());
  const Between y = between(((Dim == 3 ? point[1] : 0) - geometry_.origin_y()) / cell, geometry_.ny());
  const auto h = [&](int ix, int iy) { return static_cast<double>(elevation_[geometry_.index(ix, iy)]); };
  const double a = h(x.first, y.first), b = h(x.second, y.first);
  const double c = h(x.first, y.second), d = h(x.second, y.second);
  const double near_row = a + x.share * (b - a);
  const double far_row = c + x.share * (d - c);
  const double height = near_row + y.share * (far_row - near_row);
  Point<Dim> normal;
  normal[0] = -((1 - y.share) * (b - a) + y.share * (d - c)) / cell;
  if constexpr (Dim == 3) normal[1] = -(far_row - near_row) / cell;
  normal[Dim - 1] = 1;
  const double steepness = normal.norm();
  return {(point[Dim - 1] - height) / steepness, normal / steepness};
}

template <int Dim>
bool Terrain<Dim>::may_touch(const Point<Dim>& centre, double radius) const {
  return centre[Dim - 1] - radius <= highest_;
}

template <int Dim>
double Terrain<Dim>::height(const Point<Dim>& point) const {
  const Nearness<Dim> near = at(point);
  return point[Dim - 1] - near.distance / near.normal[Dim - 1];
}

template <int Dim>
Point<Dim> after_contact(const Point<Dim>& velocity, const Point<Dim>& normal,
                         const Obstacle<Dim>& obstacle) {
  if (obstacle.contact == Contact::sticky) return obstacle.velocity;
  const Point<Dim> relative = velocity - obstacle.velocity;
  const double along_normal = relative.dot(normal);
  if (along_normal > 0)
    return obstacle.contact == Contact::separate ? velocity : velocity - along_normal * normal;
  const Point<Dim> tangential = relative - along_normal * normal;
  const double speed = tangential.norm();
  const double left = speed + obstacle.friction * along_normal;
  if (left <= 0) return obstacle.velocity;
  return obstacle.velocity + (left / speed) * tangential;
}

template class HalfSpace<2>;
template class HalfSpace<3>;
template class Plate<2>;
template class Plate<3>;
template class Terrain<2>;
template class Terrain<3>;
template Point<2> after_contact(const Point<2>&, const Point<2>&, const Obstacle<2>&);
template Point<3> after_contact(const Point<3>&, const Point<3>&, const Obstacle<3>&);

}  // namespace aeolian
