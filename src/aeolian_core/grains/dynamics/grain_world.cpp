#include "aeolian_core/grains/dynamics/grain_world.hpp"

#include <cmath>
#include <string>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/text.hpp"

namespace aeolian {
namespace {

/// With fewer, a grain between many others becomes unstable.
constexpr double least_steps_per_contact = 8;
/// Two grains must not meet across both sides of a period.
constexpr double least_period_in_radii = 8;

std::string text_of(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

template <int Rows>
std::string text_of(const Eigen::Matrix<double, Rows, 1>& values) {
  std::string text = "(";
  for (int d = 0; d < Rows; ++d) text += (d ? ", " : "") + text_of(values[d]);
  return text + ")";
}

void demand(bool allowed, const std::string& what, const std::string& value, const char* range) {
  if (!allowed) throw Error("grain dynamics: " + what + " is " + value + ", must be " + range);
}

void demand_number(double value, const std::string& what, bool allowed, const char* range) {
  demand(std::isfinite(value) && allowed, what, text_of(value), range);
}

void check_shape(const Wall<2>& wall, const std::string& name) {
  demand(wall.from.allFinite(), name + ": from", text_of<2>(wall.from), "finite");
  demand(wall.to.allFinite(), name + ": to", text_of<2>(wall.to), "finite");
  demand(wall.to != wall.from, name + ": to", text_of<2>(wall.to), "another place than from");
}

void check_shape(const Wall<3>& wall, const std::string& name) {
  demand(wall.point.allFinite(), name + ": point", text_of<3>(wall.point), "finite");
  demand(std::abs(wall.normal.norm() - 1) < 1e-9, name + ": normal", text_of<3>(wall.normal),
         "of unit length");
}

}  // namespace

template <int Dim>
void require_valid(const GrainWorld<Dim>& world) {
  world.law.require_valid();
  demand_number(world.density, "density", world.density > 0, "positive");
  if (Dim == 2) demand_number(world.thickness, "thickness", world.thickness > 0, "positive");
  demand(world.acceleration.allFinite(), "acceleration", text_of<Dim>(world.acceleration), "finite");
  for (std::size_t w = 0; w < world.walls.size(); ++w) {
    const std::string name = "wall " + std::to_string(w);
    check_shape(world.walls[w], name);
    demand(world.walls[w].velocity.allFinite(), name + ": velocity", text_of<Dim>(world.walls[w].velocity),
           "finite");
  }
  demand(world.period.allFinite() && (world.period.array() >= 0).all(), "period", text_of<Dim>(world.period),
         "zero or positive");
  demand_number(world.steps_per_contact, "steps per contact",
                world.steps_per_contact >= least_steps_per_contact, "8 or more");
  demand_number(world.drag, "drag", world.drag >= 0, "zero or positive");
  demand_number(world.sleep.speed, "sleep speed", world.sleep.speed >= 0, "zero or positive");
  demand_number(world.sleep.patience, "sleep patience",
                world.sleep.patience > 0 || (world.sleep.speed == 0 && world.sleep.patience == 0),
                "positive where grains may sleep");
}

template <int Dim>
void require_valid_grain(const GrainWorld<Dim>& world, const Vector<Dim>& position, double radius,
                         const Vector<Dim>& velocity, const Spin<Dim>& spin) {
  demand_number(radius, "radius of a grain", radius > 0, "positive");
  demand(position.allFinite(), "place of a grain", text_of<Dim>(position), "finite");
  demand(velocity.allFinite(), "velocity of a grain", text_of<Dim>(velocity), "finite");
  demand(spin.allFinite(), "spin of a grain", text_of<Spin<Dim>::RowsAtCompileTime>(spin), "finite");
  for (int d = 0; d < Dim; ++d) {
    const double period = world.period[d];
    if (period == 0) continue;
    demand(position[d] >= 0 && position[d] <= period, "place of a grain", text_of<Dim>(position),
           ("between 0 and the period, " + text_of(period)).c_str());
    demand(least_period_in_radii * radius <= period, "radius of a grain", text_of(radius),
           ("at most an eighth of the period, " + text_of(period)).c_str());
  }
}

template void require_valid(const GrainWorld<2>&);
template void require_valid(const GrainWorld<3>&);
template void require_valid_grain(const GrainWorld<2>&, const Vector<2>&, double, const Vector<2>&,
                                  const Spin<2>&);
template void require_valid_grain(const GrainWorld<3>&, const Vector<3>&, double, const Vector<3>&,
                                  const Spin<3>&);

}  // namespace aeolian
