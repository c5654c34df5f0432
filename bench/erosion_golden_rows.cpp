#include "erosion_rows.hpp"
#include <fmt/format.h>

#include "aeolian_core/bedforms/erosion/drift_laws.hpp"
#include "aeolian_core/bedforms/erosion/hop_table.hpp"
#include "aeolian_core/saltation/drag.hpp"

namespace aeolian {
namespace {

const Atmosphere air{1.225, 1.5e-5, 9.81};

Grain grain_of(double diameter_mm, double density) {
  Grain grain;
  grain.diameter = diameter_mm / 1000;
  grain.density = density;
  return grain;
}

}  // namespace

void erosion_golden_rows(AccuracyTable& table) {
  table.section("Golden tables", "Specification secs. 2.2 and 2.4.");
  const double thresholds[][3] = {{0.10, 0.2371, 0.1979}, {0.15, 0.2434, 0.1834}, {0.20, 0.2594, 0.1820},
                                  {0.25, 0.2780, 0.1861}, {0.30, 0.2972, 0.1927}, {0.50, 0.3695, 0.2262}};
  for (const auto& t : thresholds) {
    table.relative_row(fmt::format("threshold, sand {} mm [m/s]", t[0]), t[1],
                       lifting_threshold(grain_of(t[0], 2650), air, 3e-4), 0.005);
    table.relative_row(fmt::format("threshold, ice {} mm [m/s]", t[0]), t[2],
                       lifting_threshold(grain_of(t[0], 917), air, 3e-4), 0.005);
  }
  const double falls[][3] = {{0.15, 1.00, 0.43}, {0.25, 1.83, 0.86}, {0.40, 2.93, 1.46}};
  for (const auto& f : falls) {
    table.relative_row(fmt::format("fall speed, sand {} mm [m/s]", f[0]), f[1],
                       terminal_speed(DragLaw::sphere, grain_of(f[0], 2650), air), 0.03);
    table.relative_row(fmt::format("fall speed, ice {} mm [m/s]", f[0]), f[2],
                       terminal_speed(DragLaw::sphere, grain_of(f[0], 917), air), 0.03);
  }
  const double hops[][3] = {{10, 0.141, 6.2}, {12, 0.226, 8.2}, {15, 0.392, 11.2}};
  for (const auto& h : hops) {
    const HopWind wind{friction_velocity(h[0], 10, 5e-6), 5e-6, grain_of(0.15, 2650), air};
    const double speed = 1.5 * wind.friction_velocity;
    const Hop hop = flown_hop(wind, speed, speed);
    table.relative_row(fmt::format("hop at {} m/s: range [m]", h[0]), h[1], hop.range, 0.03);
    table.relative_row(fmt::format("hop at {} m/s: apex [mm]", h[0]), h[2], 1000 * hop.apex, 0.03);
    double worst = 0;
    const HopTable looked_up(wind, 4, 1.5);
    RandomStream random(1, 0);
    for (int n = 0; n < 300; ++n) {
      const double along = 3.9 * random.uniform();
      const double up = 0.05 + 1.4 * random.uniform();
      const double exact = flown_hop(wind, along, up, 5e-5).range;
      worst = std::max(
          worst, std::abs(looked_up.at(static_cast<float>(along), static_cast<float>(up)).range / exact - 1));
    }
    table.range_row(fmt::format("hop table at {} m/s: worst error of the range [%]", h[0]), 0, 3,
                    100 * worst);
  }
}

}  // namespace aeolian
