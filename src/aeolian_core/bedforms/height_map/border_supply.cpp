#include "aeolian_core/bedforms/height_map/border_supply.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "aeolian_core/bedforms/bed_model.hpp"
#include "aeolian_core/bedforms/height_map/impact_angles.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

constexpr int waves = 8;
constexpr double modulation = 0.3;  ///< standard deviation of the flux of a bed with ripples, of its mean
constexpr double bandwidth = 0.3;   ///< standard deviation of the frequency, of its mean
constexpr double crest_length = 3;  ///< wavelengths over which crests turn

struct Wave {
  double along_border;  ///< wave number [1/m]
  double phase;
};

}  // namespace

ImpactSweep::Supply border_supply(Inflow inflow, double wavelength, double frequency, double cell,
                                  double time, std::uint64_t seed, double share) {
  if (inflow == Inflow::flat_bed) {
    if (share == 1) return nullptr;
    return [share](int, int) { return share; };
  }
  if (inflow == Inflow::none) return [](int, int) { return 0.0; };
  RandomStream random(seed, 0x626f72646572);
  std::array<Wave, waves> train{};
  for (Wave& wave : train) {
    wave.along_border = random.normal() / (crest_length * wavelength);
    wave.phase = 2 * M_PI * random.uniform() + frequency * (1 + bandwidth * random.normal()) * time;
  }
  return [train, cell, share](int station, int q) {
    double sum = 0;
    for (const Wave& wave : train) sum += std::cos(wave.phase + wave.along_border * cell * (station + q));
    return share * std::max(0.0, 1 + modulation * std::sqrt(2.0 / waves) * sum);
  };
}

double polluted_margin(const Forcing& forcing, double relief) {
  check(forcing, 0);
  if (!(relief >= 0) || !std::isfinite(relief))
    throw Error("polluted margin: relief is " + std::to_string(relief) + ", must be zero or more and finite");
  const ImpactAngles angles(forcing.impact_angle, forcing.impact_angle_spread);
  return std::max(relief / angles.least_tangent(), 5 * forcing.reptation_length);
}

}  // namespace aeolian
