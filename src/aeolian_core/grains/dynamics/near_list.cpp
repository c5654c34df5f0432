#include "aeolian_core/grains/dynamics/near_list.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace aeolian {
namespace {

constexpr double least_skin = 0.08;  // in radii: rarely used up in a bed at rest, few pairs that do not touch
constexpr double cell_in_radii = 2.2;

template <int Dim>
std::array<double, Dim> place_of(const GrainRecord<Dim>& grain) {
  std::array<double, Dim> place;
  std::copy_n(grain.value + GrainRecord<Dim>::place, Dim, place.begin());
  return place;
}

}  // namespace

template <int Dim>
void NearList<Dim>::restart(const std::vector<GrainRecord<Dim>>& grains) {
  Place low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  double sum = 0;
  largest_radius_ = largest_skin_ = 0;
  for (std::size_t slot = 1; slot < grains.size(); ++slot) {
    const double radius = grains[slot].value[GrainRecord<Dim>::radius];
    sum += radius;
    largest_radius_ = std::max(largest_radius_, radius);
    const Place place = place_of(grains[slot]);
    for (std::size_t d = 0; d < Dim; ++d) {
      low[d] = std::min(low[d], place[d]);
      high[d] = std::max(high[d], place[d]);
    }
  }
  if (grains.size() < 2) low.fill(0), high.fill(0), sum = 1;
  const double mean = sum / static_cast<double>(std::max<std::size_t>(grains.size() - 1, 1));
  cells_.cover(low, high, period_, cell_in_radii * mean, grains.size());
  anchors_.assign(grains.size(), {});
  looked_at_.assign(grains.size(), 0);
}

template <int Dim>
std::vector<int> NearList<Dim>::order(const std::vector<GrainRecord<Dim>>& grains) const {
  std::vector<std::pair<long, int>> by_rank;
  by_rank.reserve(grains.size());
  for (std::size_t slot = 1; slot < grains.size(); ++slot)
    by_rank.emplace_back(cells_.rank_of(place_of(grains[slot])), static_cast<int>(slot));
  std::sort(by_rank.begin(), by_rank.end());
  std::vector<int> slots;
  slots.reserve(by_rank.size());
  for (const auto& [rank, slot] : by_rank) slots.push_back(slot);
  return slots;
}

template <int Dim>
double NearList<Dim>::skin(double radius, double speed, double horizon) const {
  // A periodic world must not show a grain twice, hence the upper limit.
  return std::clamp(speed * horizon, least_skin * radius, std::max(least_skin * radius, largest_radius_));
}

template <int Dim>
bool NearList<Dim>::near(int slot, int other, const std::vector<GrainRecord<Dim>>& grains) const {
  const Anchor& a = anchor(slot);
  const Anchor& b = anchor(other);
  double squares = 0;
  for (std::size_t d = 0; d < Dim; ++d) {
    double apart = std::abs(a.place[d] - b.place[d]);
    if (apart > period_[d] / 2) apart -= period_[d];
    squares += apart * apart;
  }
  const double reach = grains[static_cast<std::size_t>(slot)].value[GrainRecord<Dim>::radius] +
                       grains[static_cast<std::size_t>(other)].value[GrainRecord<Dim>::radius] + a.skin +
                       b.skin;
  return squares < reach * reach;
}

template <int Dim>
void NearList<Dim>::look_at(const std::vector<int>& slots, const std::vector<double>& skins,
                            const std::vector<GrainRecord<Dim>>& grains, std::vector<NearPair<Dim>>& pairs) {
  anchors_.resize(grains.size());
  looked_at_.resize(grains.size(), 0);
  for (std::size_t k = 0; k < slots.size(); ++k) {
    const auto slot = static_cast<std::size_t>(slots[k]);
    const GrainRecord<Dim>& grain = grains[slot];
    if (cells_.contains(slots[k])) cells_.erase(slots[k]);
    Anchor& anchor = anchors_[slot];
    const Place place = place_of(grain);
    std::copy(place.begin(), place.end(), anchor.place);
    anchor.skin = skins[k];
    cells_.insert(slots[k], place);
    looked_at_[slot] = 1;
    largest_skin_ = std::max(largest_skin_, anchor.skin);
    largest_radius_ = std::max(largest_radius_, grain.value[GrainRecord<Dim>::radius]);
  }

  std::vector<NearPair<Dim>> found;
  for (const int slot : slots) {
    const Anchor& anchor = this->anchor(slot);
    const double reach = grains[static_cast<std::size_t>(slot)].value[GrainRecord<Dim>::radius] +
                         largest_radius_ + anchor.skin + largest_skin_;
    const std::size_t before = found.size();
    cells_.visit(place_of(grains[static_cast<std::size_t>(slot)]), reach, [&](int other) {
      if (other == slot || (looked_at_[static_cast<std::size_t>(other)] && other < slot)) return;
      if (near(slot, other, grains)) found.push_back({std::min(slot, other), std::max(slot, other)});
    });
    std::sort(found.begin() + static_cast<std::ptrdiff_t>(before), found.end());
  }
  if (!std::is_sorted(found.begin(), found.end())) std::sort(found.begin(), found.end());

  const auto stale = [this](const NearPair<Dim>& pair) {
    return looked_at_[static_cast<std::size_t>(pair.first)] ||
           looked_at_[static_cast<std::size_t>(pair.second)];
  };
  std::vector<NearPair<Dim>> merged;
  merged.reserve(pairs.size() + found.size());
  auto old = pairs.begin();
  for (NearPair<Dim>& pair : found) {
    for (; old != pairs.end() && *old < pair; ++old)
      if (!stale(*old)) merged.push_back(*old);
    if (old != pairs.end() && !(pair < *old)) std::copy_n((old++)->slip, slip_size<Dim>, pair.slip);
    merged.push_back(pair);
  }
  for (; old != pairs.end(); ++old)
    if (!stale(*old)) merged.push_back(*old);
  pairs.swap(merged);
  for (const int slot : slots) looked_at_[static_cast<std::size_t>(slot)] = 0;
}

template <int Dim>
void NearList<Dim>::forget(int slot) {
  if (cells_.contains(slot)) cells_.erase(slot);
  if (static_cast<std::size_t>(slot) < anchors_.size()) anchors_[static_cast<std::size_t>(slot)].skin = -1;
}

template class NearList<2>;
template class NearList<3>;

}  // namespace aeolian
