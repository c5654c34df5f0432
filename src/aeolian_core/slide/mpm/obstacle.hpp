#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

template <int Dim>
using Point = Eigen::Matrix<double, Dim, 1>;

/// Where a point lies against a body.
template <int Dim>
struct Nearness {
  double distance;    ///< [m], negative inside
  Point<Dim> normal;  ///< unit vector out of the body
};

/// A body as a level set. The last axis is upwards.
template <int Dim>
class Shape {
 public:
  virtual ~Shape() = default;
  virtual Nearness<Dim> at(const Point<Dim>& point) const = 0;
  /// Whether a ball may touch the body: false only where it cannot.
  virtual bool may_touch(const Point<Dim>& centre, double radius) const {
    return at(centre).distance <= radius;
  }
};

/// All on the other side of a plane through a point.
template <int Dim>
class HalfSpace : public Shape<Dim> {
 public:
  /// Throws Error for a normal without a direction.
  HalfSpace(const Point<Dim>& point, const Point<Dim>& normal);
  Nearness<Dim> at(const Point<Dim>& point) const override;

 private:
  Point<Dim> point_;
  Point<Dim> normal_;
};

/// A plate: a panel, a wall. What is inside leaves by the nearer of the two broad faces, across the last
/// axis: were it pushed out by the narrow ones, they would hold back what slides along the plate.
template <int Dim>
class Plate : public Shape<Dim> {
 public:
  using Axes = Eigen::Matrix<double, Dim, Dim>;
  /// `axes` are orthonormal columns. Throws Error for a half size that is not positive.
  Plate(const Point<Dim>& centre, const Axes& axes, const Point<Dim>& half_size);
  Nearness<Dim> at(const Point<Dim>& point) const override;

 private:
  Point<Dim> centre_;
  Axes axes_;
  Point<Dim> half_;
};

/// Ground of any form: in two dimensions the section of a map along x at y = 0, in three the map. Between
/// cell centres it is bilinear, outside it goes on level.
template <int Dim>
class Terrain : public Shape<Dim> {
 public:
  /// Takes the layer `elevation`. Throws Error naming the cell whose height is not known.
  explicit Terrain(const HeightMap& map);
  Nearness<Dim> at(const Point<Dim>& point) const override;
  bool may_touch(const Point<Dim>& centre, double radius) const override;
  double height(const Point<Dim>& point) const;

 private:
  GridGeometry geometry_;
  std::vector<float> elevation_;
  double highest_;
};

/// What happens to snow that meets a body (Frischholz 1.2.27-30).
enum class Contact {
  sticky,    ///< takes the body's velocity
  slip,      ///< slides with friction, never leaves
  separate,  ///< slides with friction while it is pressed on
};

template <int Dim>
struct Obstacle {
  std::shared_ptr<const Shape<Dim>> shape;
  Contact contact = Contact::separate;
  double friction = 0;                       ///< Coulomb's, of the compressive impulse
  Point<Dim> velocity = Point<Dim>::Zero();  ///< of the surface [m/s]
};

/// Velocity of a node that is inside a body, after contact.
template <int Dim>
Point<Dim> after_contact(const Point<Dim>& velocity, const Point<Dim>& normal, const Obstacle<Dim>& obstacle);

extern template class HalfSpace<2>;
extern template class HalfSpace<3>;
extern template class Plate<2>;
extern template class Plate<3>;
extern template class Terrain<2>;
extern template class Terrain<3>;

}  // namespace aeolian
