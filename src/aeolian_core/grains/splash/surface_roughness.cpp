#include "aeolian_core/grains/splash/surface_roughness.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {

SurfaceRoughness::SurfaceRoughness(double length, double brinks) : length_(length), brinks_(brinks) {
  if (!(length > 0) || !std::isfinite(length))
    throw Error("surface roughness: length is " + std::to_string(length) +
                " diameters, must be positive and finite");
  if (!(brinks >= 0 && brinks <= most))
    throw Error("surface roughness: brinks are " + std::to_string(brinks) +
                " per diameter, must be 0 to 0.5");
}

void SurfaceRoughness::ejected(const SplashEvent& event) {
  double steps = 0;
  for (const LeavingGrain& grain : event.ejecta) {
    if (grain.origin == Origin::target) steps += 1;
    if (grain.origin == Origin::brink || grain.origin == Origin::anti_brink) steps -= 1;
  }
  add(steps);
}

void SurfaceRoughness::came_to_rest(double grains) {
  if (!(grains >= 0))
    throw Error("surface roughness: grains at rest are " + std::to_string(grains) + ", must not be negative");
  brinks_ *= std::exp(-grains / length_);
}

void SurfaceRoughness::add(double steps) { brinks_ = std::clamp(brinks_ + steps / length_, 0.0, most); }

}  // namespace aeolian
