#include <algorithm>
#include <cmath>

#include "aeolian_core/wind/sph/lattice.hpp"
#include "aeolian_core/wind/sph/sph_air.hpp"

namespace aeolian::sph {

void SphAir::move(double dx, double dy) {
  const BoxPlace& p = ground_.place();
  ground_.move(p.x + dx * p.spacing, p.y + dy * p.spacing);
  const double length_x = static_cast<double>(torus_.length_x);
  const double length_y = static_cast<double>(torus_.length_y);
  const auto shift_x = static_cast<float>(std::fmod(dx, length_x));
  const auto shift_y = static_cast<float>(std::fmod(dy, length_y));
  for (Four& at : place_) {
    at[0] = wrapped(at[0] - shift_x, torus_.length_x);
    at[1] = wrapped(at[1] - shift_y, torus_.length_y);
  }
  refill();
}

void SphAir::refill() {
  const std::vector<Four> sites = lattice(ground_);
  std::vector<Four> place, motion;
  for (std::size_t i = 0; i < size(); ++i) {
    if (place_[i][2] < ground_.height(place_[i][0], place_[i][1])) continue;
    place.push_back(place_[i]);
    motion.push_back(motion_[i]);
  }
  const std::size_t wanted = sites.size();
  if (place.size() == wanted && place.size() == size()) return;
  place_.swap(place);
  motion_.swap(motion);
  order();
  if (size() < wanted) {
    for (const std::size_t s : emptiest(cells_, place_, sites, wanted - size(), settings_.support)) {
      place_.push_back(sites[s]);
      motion_.push_back(given_wind(sites[s][2] - ground_.height(sites[s][0], sites[s][1])));
      ++guards_.refilled;
    }
  } else if (size() > wanted) {
    std::vector<std::size_t> out = fullest(cells_, place_, size() - wanted, settings_.support);
    std::sort(out.begin(), out.end());
    guards_.refilled += out.size();
    while (!out.empty()) {
      place_.erase(place_.begin() + static_cast<std::ptrdiff_t>(out.back()));
      motion_.erase(motion_.begin() + static_cast<std::ptrdiff_t>(out.back()));
      out.pop_back();
    }
  }
}

}  // namespace aeolian::sph
