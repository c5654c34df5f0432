#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/require.hpp"
#include "aeolian_core/wind/sph/lattice.hpp"
#include "aeolian_core/wind/sph/sph_air.hpp"

namespace aeolian::sph {
namespace {

constexpr Require require("box of air");
constexpr int settling_steps = 40;

}  // namespace

SphAir::SphAir(const AirGround& ground, const Upwind& upwind, const AirSettings& settings)
    : ground_(ground),
      upwind_(upwind),
      settings_(settings),
      torus_{static_cast<float>(ground.place().nx), static_cast<float>(ground.place().ny),
             static_cast<float>(ground.place().nz)},
      cells_(torus_, settings.support),
      finder_(torus_, settings.support) {
  require(settings.support >= 1.5F && settings.support <= 4, "support", static_cast<double>(settings.support),
          "1.5 to 4 spacings");
  require(settings.step > 0 && settings.step <= 0.25F, "step", static_cast<double>(settings.step),
          "positive and at most 0.25");
  require(torus_.height - ground.highest() > 2 * settings.support, "height of the lid over the ground",
          static_cast<double>(torus_.height - ground.highest()), "more than two supports");
  place_ = lattice(ground_);
  motion_.resize(place_.size());
  for (std::size_t i = 0; i < place_.size(); ++i)
    motion_[i] = given_wind(place_[i][2] - ground_.height(place_[i][0], place_[i][1]));
  order();
  if (ground_.highest() > 0) settle();
  start();
}

void SphAir::start() {
  // At rest the ground would push the wind aside at once: this push is no pressure of the wind's.
  dt_ = 1;
  see_walls();
  finder_.find(cells_, place_, normal_);
  differentiate();
  press();
  for (std::size_t i = 0; i < size(); ++i) {
    motion_[i] -= implicitness * force_[i];
    motion_[i][3] = 0;
    fastest_ = std::max(fastest_, std::sqrt(dot3(motion_[i], motion_[i])));
  }
}

void SphAir::settle() {
  for (int n = 0; n < settling_steps; ++n) {
    see_walls();
    finder_.find(cells_, place_, normal_);
    for_chunks(size(), [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        Four shift = -0.4F * finder_.sums().crowding[i];
        const float length = std::sqrt(dot3(shift, shift));
        if (length > far_shift) shift *= far_shift / length;
        Four p = place_[i] + shift;
        place_[i] = Four{wrapped(p[0], torus_.length_x), wrapped(p[1], torus_.length_y), p[2], 0};
      }
    });
    order();
  }
  for (std::size_t i = 0; i < size(); ++i)
    motion_[i] = given_wind(place_[i][2] - ground_.height(place_[i][0], place_[i][1]));
}

}  // namespace aeolian::sph
