#include "aeolian_core/saltation/flying_grains.hpp"

#include <algorithm>
#include <utility>

namespace aeolian {
namespace {

constexpr double negligible_part = 1e-6;

std::vector<double> part(const std::vector<double>& all, std::size_t size, std::size_t sizes) {
  const auto count = static_cast<std::ptrdiff_t>(all.size() / sizes);
  const auto begin = all.begin() + static_cast<std::ptrdiff_t>(size) * count;
  return {begin, begin + count};
}

}  // namespace

FlyingGrains::FlyingGrains(std::vector<Drag> drag, std::vector<double> mass, double rarest)
    : drag_(std::move(drag)), mass_(std::move(mass)), negligible_(negligible_part * rarest) {}

void FlyingGrains::fly(const Launches& launches, const WindProfile& wind, double acceleration,
                       double tolerance, Landings& landings, std::vector<double>& stress) const {
  const std::size_t sizes = drag_.size();
  if (sizes == 1) {
    aeolian::fly(launches, negligible_, {wind, drag_[0], acceleration, tolerance}, landings, stress);
    return;
  }
  std::vector<double> own_stress;
  for (std::size_t s = 0; s < sizes; ++s) {
    const Launches own = part_of(launches, s, sizes);
    Landings landed = part_of(landings, s, sizes);
    own_stress.assign(stress.size(), 0);
    aeolian::fly(own, negligible_, {wind, drag_[s], acceleration, tolerance}, landed, own_stress);
    for (std::size_t i = 0; i < stress.size(); ++i) stress[i] += mass_[s] * own_stress[i];
    const auto first = static_cast<std::ptrdiff_t>(s * own.size());
    for (const auto column :
         {&Landings::vx, &Landings::vy, &Landings::duration, &Landings::length, &Landings::apex})
      std::copy((landed.*column).begin(), (landed.*column).end(), (landings.*column).begin() + first);
  }
}

Launches part_of(const Launches& all, std::size_t size, std::size_t sizes) {
  return {part(all.vx, size, sizes), part(all.vy, size, sizes), part(all.number, size, sizes)};
}

Landings part_of(const Landings& all, std::size_t size, std::size_t sizes) {
  return {part(all.vx, size, sizes), part(all.vy, size, sizes), part(all.duration, size, sizes),
          part(all.length, size, sizes), part(all.apex, size, sizes)};
}

}  // namespace aeolian
