#include "aeolian_core/grains/impacts/bed_packing.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "aeolian_core/grains/impacts/bed_state.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

using Packing = BedRecipe::Packing;

constexpr Require require{"bed"};

void require_valid(const BedRecipe& recipe, int dimensions) {
  require(recipe.radius > 0 && std::isfinite(recipe.radius), "radius", recipe.radius, "positive");
  require(recipe.size_spread >= 0 && recipe.size_spread <= 0.5, "size_spread", recipe.size_spread,
          "0 to 0.5");
  require(recipe.grains >= 1 && recipe.grains <= 10000000, "grains", recipe.grains, "1 to 10000000");
  require(recipe.length >= 8 * recipe.radius, "length", recipe.length, "at least 4 diameters");
  require(recipe.pits >= 0 && recipe.pits <= 0.5, "pits", recipe.pits, "0 to 0.5");
  require(recipe.calm > 0, "calm", recipe.calm, "positive");
  if (dimensions == 3)
    require(recipe.width >= 8 * recipe.radius, "width", recipe.width, "at least 4 diameters");
  if (dimensions == 3 && (recipe.packing == Packing::loose || recipe.packing == Packing::dense))
    throw Error("bed: packing of spheres is loose or dense, must be poured or struck");
}

/// Radii and places of a bed, one grain after the other.
template <int Dim>
class Bricklayer {
 public:
  Bricklayer(const BedRecipe& recipe, const GrainWorld<Dim>& world, std::uint64_t seed)
      : recipe_(recipe), random_(seed, 0), grains_(world) {}

  GrainDynamics<Dim> lay() {
    if constexpr (Dim == 2) {
      if (recipe_.packing == Packing::loose) return lay_lattice();
      if (recipe_.packing == Packing::dense) return lay_hexagons();
    }
    return rain();
  }

 private:
  double radius() {
    const double spread = recipe_.size_spread;
    if (spread == 0) return recipe_.radius;
    const double log_spread = std::sqrt(std::log1p(spread * spread));
    double deviate = 0;
    do {
      deviate = random_.normal();
    } while (std::abs(deviate) > 2);
    return recipe_.radius * std::exp(log_spread * deviate - 0.5 * log_spread * log_spread);
  }
  double jitter(double size) { return size * (2 * random_.uniform() - 1); }

  /// 32 columns in the thesis' box of 67.3 radii, which 12 rows fill to its rim.
  GrainDynamics<Dim> lay_lattice() {
    const double r = recipe_.radius;
    const int columns = static_cast<int>(recipe_.length / (2.1 * r));
    const double pitch = recipe_.length / columns;
    const double sideways = std::min(0.04 * r, 0.49 * (pitch - 2 * r));
    for (int i = 0; i < recipe_.grains; ++i) {
      const int row = i / columns;
      grains_.add({(i % columns + 0.5) * pitch + jitter(sideways), (2 * row + 1) * 1.004 * r}, radius());
    }
    return std::move(grains_);
  }

  /// Rows of 33 in the thesis' box; what is left lies on top as a plateau that begins 20 radii before the
  /// middle.
  GrainDynamics<Dim> lay_hexagons() {
    const double r = recipe_.radius;
    const double pitch = 2 * r * (1 + 1e-9);
    const int columns = static_cast<int>((recipe_.length - r) / pitch);
    const int rows = recipe_.grains / columns;
    const double left = 0.5 * (recipe_.length - (columns + 0.5) * pitch);
    const int plateau = std::max(0, static_cast<int>((0.5 * recipe_.length - 20 * r - left) / pitch));
    for (int i = 0; i < recipe_.grains; ++i) {
      const int row = i / columns;
      int column = i % columns;
      if (row == rows) column += std::min(plateau, columns - recipe_.grains % columns);
      grains_.add({left + (column + 0.5 + 0.5 * (row % 2)) * pitch, r + row * std::sqrt(3.) * r}, radius());
    }
    return std::move(grains_);
  }

  /// Sparse layers, shuffled by their speed.
  GrainDynamics<Dim> rain() {
    const double cell = 2 * recipe_.radius * (1.15 + 2 * recipe_.size_spread);
    const int columns = static_cast<int>(recipe_.length / cell);
    const int lines = Dim == 3 ? static_cast<int>(recipe_.width / cell) : 1;
    const double speed = std::sqrt(2 * recipe_.radius * gravity);
    for (int i = 0; i < recipe_.grains; ++i) {
      const double r = radius();
      const double free = std::max(0.0, 0.5 * cell - r);
      Vector<Dim> place;
      Vector<Dim> velocity;
      place.x() = (i % columns + 0.5) * recipe_.length / columns + jitter(free);
      if constexpr (Dim == 3) place.y() = (i / columns % lines + 0.5) * recipe_.width / lines + jitter(free);
      const int level = i / (columns * lines);
      place[Dim - 1] = (level + 0.5) * cell + jitter(free);
      for (int k = 0; k < Dim; ++k) velocity[k] = jitter(speed);
      grains_.add(place, r, velocity);
    }
    return std::move(grains_);
  }

  BedRecipe recipe_;
  RandomStream random_;
  GrainDynamics<Dim> grains_;
};

/// Between a floor and walls so high [m], or where the bed begins anew.
template <int Dim>
void enclose(GrainWorld<Dim>& world, const BedRecipe& recipe, double left_high, double right_high) {
  world.period = Vector<Dim>::Zero();
  if constexpr (Dim == 2) {
    const Vector<2> left(0, 0);
    const Vector<2> right(recipe.length, 0);
    world.walls = {{left, right}, {left, {0, left_high}}, {right, {recipe.length, right_high}}};
  } else {
    world.walls = {{Vector<3>::Zero(), Vector<3>::UnitZ()}};
    world.period = {recipe.length, recipe.width, 0};
  }
}

/// Of the highest grain that is nearer to a wall than its own radius and a half.
template <int Dim>
double height_beside(const GrainDynamics<Dim>& grains, double wall) {
  double height = 0;
  for (const int grain : grains.numbers())
    if (std::abs(grains.position(grain).x() - wall) < 1.5 * grains.radius(grain))
      height = std::max(height, grains.position(grain)[Dim - 1]);
  return height;
}

/// Lets all come to rest under a drag that leaves a fall its speed at first and ends a creep.
template <int Dim>
void settle(GrainDynamics<Dim>& grains, GrainWorld<Dim> world, const BedRecipe& recipe, double drag) {
  const double time = std::sqrt(2 * recipe.radius / world.acceleration.norm());
  world.drag = drag / time;
  world.sleep = {};
  grains.set_world(world);
  double mass = 0;
  for (const int grain : grains.numbers()) mass += grains.mass(grain);
  const double calm = recipe.calm * mass * world.acceleration.norm() * 2 * recipe.radius;
  constexpr int longest = 4000;
  for (int i = 0; i < longest; ++i) {
    grains.advance(0.25 * time);
    if (grains.kinetic_energy() < calm) return;
  }
  throw Error(fmt::format("bed: {} grains have not come to rest within {:g} s", grains.size(),
                          0.25 * time * longest));
}

/// The same law with contacts `times` as long: stiffness over the square of that.
ContactLaw softened(ContactLaw law, double times) {
  law.stiffness /= times * times;
  law.shear_stiffness /= times * times;
  law.damping /= times;
  law.shear_damping /= times;
  law.youngs_modulus /= times * times;
  return law;
}

/// Removes the grains that rise above a level two diameters below the mean surface.
template <int Dim>
void strike_off(GrainDynamics<Dim>& grains, const BedRecipe& recipe) {
  const BedSurface surface(grains, recipe.radius, recipe.length, recipe.width);
  const double level = surface.mean_height() - 2 * recipe.radius;
  const std::vector<int> numbers = grains.numbers();
  for (const int grain : numbers)
    if (grains.position(grain)[Dim - 1] > level) grains.remove(grain);
}

/// Makes holes as impacts do: each has a brink and an anti-brink.
template <int Dim>
void take_out(GrainDynamics<Dim>& grains, const BedRecipe& recipe, std::uint64_t seed) {
  const BedSurface surface(grains, recipe.radius, recipe.length, recipe.width);
  RandomStream random(seed, 1);
  const std::vector<int> numbers = grains.numbers();
  for (const int grain : numbers)
    if (surface.layer(grain) == 1 && random.uniform() < recipe.pits) grains.remove(grain);
}

}  // namespace

template <int Dim>
Bed<Dim> settled_bed(GrainDynamics<Dim> grains, const BedRecipe& recipe) {
  const BedSurface surface(grains, recipe.radius, recipe.length, recipe.width);
  const BedState state = bed_state(grains, surface, recipe.radius, recipe.length, recipe.width);
  return {std::move(grains), recipe.radius, recipe.length, recipe.width, surface, state};
}

template <int Dim>
Bed<Dim> make_bed(const BedRecipe& recipe, const GrainWorld<Dim>& bed_world, std::uint64_t seed) {
  require_valid(recipe, Dim);
  GrainWorld<Dim> world = bed_world;
  enclose(world, recipe, 1000 * recipe.length, 1000 * recipe.length);
  GrainDynamics<Dim> grains = Bricklayer<Dim>(recipe, world, seed).lay();
  GrainWorld<Dim> soft = world;
  soft.law = softened(world.law, 5);
  settle(grains, soft, recipe, 1);
  if (recipe.packing == Packing::struck) {
    strike_off(grains, recipe);
    settle(grains, soft, recipe, 1);
  }
  if (recipe.pits > 0) {
    take_out(grains, recipe, seed);
    settle(grains, soft, recipe, 1);
  }
  settle(grains, world, recipe, 4);
  // The box is open: its walls end where the bed does, and nothing that flies away meets them.
  enclose(world, recipe, height_beside(grains, 0), height_beside(grains, recipe.length));
  grains.set_world(world);
  return settled_bed(std::move(grains), recipe);
}

template Bed<2> make_bed(const BedRecipe&, const GrainWorld<2>&, std::uint64_t);
template Bed<3> make_bed(const BedRecipe&, const GrainWorld<3>&, std::uint64_t);
template Bed<2> settled_bed(GrainDynamics<2>, const BedRecipe&);
template Bed<3> settled_bed(GrainDynamics<3>, const BedRecipe&);

}  // namespace aeolian
