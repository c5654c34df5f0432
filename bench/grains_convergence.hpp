#pragma once

#include <algorithm>
#include <cmath>
#include <ctime>
#include <set>
#include <utility>
#include <vector>

#include "aeolian_core/grains/dynamics/grain_dynamics.hpp"
#include "aeolian_core/surface/median.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {

constexpr double disc_radius = 0.01;  ///< of the benchmarks' grains, those of the thesis [m]

inline double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

inline double bed_width(int columns) { return 2.02 * (columns + 0.5) * disc_radius; }

/// A dense bed of discs at rest, of sizes that differ by 3 %.
inline GrainDynamics<2> settled_bed(int columns, int rows, double time) {
  GrainWorld<2> world;
  const double width = bed_width(columns);
  world.walls = {{{-1, 0}, {1 + width, 0}}, {{0, 0}, {0, 9}}, {{width, 0}, {width, 9}}};
  world.drag = 100;
  GrainDynamics<2> grains(world);
  RandomStream random(5, 0);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      grains.add({(2.02 * i + 1.01 * (1 + j % 2)) * disc_radius, (1.74 * j + 1) * disc_radius},
                 disc_radius * (1 - 0.03 * random.uniform()));
  grains.advance(time);
  world.drag = 0;
  grains.set_world(world);
  return grains;
}

/// The largest relative change of the energy of 100 discs without losses, in a periodic square at up to 14
/// m/s, while they meet 1e5 times.
inline double energy_drift(double steps_per_contact) {
  constexpr int side = 10;
  GrainWorld<2> world;
  world.steps_per_contact = steps_per_contact;
  world.law.damping = world.law.shear_damping = world.law.friction = 0;
  world.acceleration.setZero();
  world.period.setConstant(2.1 * side * disc_radius);
  GrainDynamics<2> grains(world);
  RandomStream random(3, 0);
  for (int i = 0; i < side * side; ++i)
    grains.add(2.1 * disc_radius * Vector<2>(i % side + 0.5, i / side + 0.5), disc_radius,
               {20 * random.uniform() - 10, 20 * random.uniform() - 10});
  const double energy = grains.kinetic_energy();
  double worst = 0;
  std::set<std::pair<int, int>> touching;
  for (int begun = 0; begun < 100000;) {
    grains.advance(5e-5);  // less than a contact
    std::set<std::pair<int, int>> now;
    for (const auto& contact : grains.contacts()) {
      now.insert({contact.first, contact.second});
      begun += touching.count({contact.first, contact.second}) == 0 ? 1 : 0;
    }
    touching.swap(now);
    worst = std::max(worst, std::abs((grains.kinetic_energy() + grains.potential_energy()) / energy - 1));
  }
  return worst;
}

/// Relative error of a restitution, over when within a step the contact begins.
struct StepError {
  double root_mean_square = 0, median = 0;
};

/// Of the restitution of table 2.1 with so many steps in a contact.
inline StepError error_of_step(double steps_per_contact) {
  GrainWorld<2> world;
  world.law.stiffness = world.law.shear_stiffness = 5e4;
  world.law.damping = world.law.shear_damping = 1000;
  world.acceleration.setZero();
  world.steps_per_contact = steps_per_contact;
  double squares = 0;
  std::vector<double> errors;
  const int starts = 1024;
  for (int k = 0; k < starts; ++k) {
    GrainDynamics<2> grains(world);
    grains.add({0, 0}, disc_radius, {1, 0});
    grains.add({2 * disc_radius + 1e-4 * (1 + 0.7 * k / starts), 0}, disc_radius);
    const double exact = restitution(5e4, 1000, grains.mass(0) / 2);
    grains.advance(1.1e-3);
    errors.push_back(std::abs((grains.velocity(1) - grains.velocity(0)).x() / exact - 1));
    squares += errors.back() * errors.back();
  }
  return {std::sqrt(squares / starts), median(errors)};
}

/// Mean rebound over the impact, and its standard error.
struct Rebound {
  double along = 0, up = 0;
  double along_error = 0, up_error = 0;
  double seconds = 0;  ///< processor time of the impacts
};

/// What softer grains change: impacts of 30 m/s at 15 degrees on 240 discs of this stiffness [N/m].
inline Rebound rebound_of_stiffness(double stiffness, int impacts) {
  const int columns = 30;
  GrainDynamics<2> bed = settled_bed(columns, 8, 0.12);
  GrainWorld<2> world = bed.world();
  world.law = ContactLaw::spring(stiffness, 0.85, bed.mass(0) / 2, 0.5);
  world.drag = 100;
  bed.set_world(world);
  bed.advance(0.05);
  world.drag = 0;
  bed.set_world(world);
  double top = 0;
  for (const int grain : bed.numbers()) top = std::max(top, bed.position(grain).y());
  const double angle = 15 * M_PI / 180;
  const Vector<2> fired = 30 * Vector<2>(std::cos(angle), -std::sin(angle));
  Rebound r;
  double along_squares = 0, up_squares = 0;
  const double begin = processor_time();
  for (int k = 0; k < impacts; ++k) {
    GrainDynamics<2> grains = bed;
    const double place = bed_width(columns) / 2 - 0.05 + 0.1 * k / impacts;
    const int grain = grains.add({place, top + 2.1 * disc_radius}, disc_radius, fired);
    grains.advance(0.005);
    const double along = grains.velocity(grain).x() / fired.x();
    const double up = grains.velocity(grain).y() / -fired.y();
    r.along += along / impacts;
    r.up += up / impacts;
    along_squares += along * along / impacts;
    up_squares += up * up / impacts;
  }
  r.seconds = processor_time() - begin;
  r.along_error = std::sqrt((along_squares - r.along * r.along) / impacts);
  r.up_error = std::sqrt((up_squares - r.up * r.up) / impacts);
  return r;
}

}  // namespace aeolian
