#include "aeolian_core/grains/dynamics/resting_pairs.hpp"

#include <algorithm>

namespace aeolian {

template <int Dim>
NearPair<Dim> RestingPairs<Dim>::pair_of(int slot, const Partner& partner) {
  NearPair<Dim> pair{std::min(slot, partner.slot), std::max(slot, partner.slot)};
  std::copy_n(partner.slip, slip_size<Dim>, pair.slip);
  return pair;
}

template <int Dim>
void RestingPairs<Dim>::add(const NearPair<Dim>& pair) {
  const auto first = static_cast<std::size_t>(pair.first), second = static_cast<std::size_t>(pair.second);
  if (partners_.size() <= second) partners_.resize(second + 1);
  Partner partner;
  std::copy_n(pair.slip, slip_size<Dim>, partner.slip);
  partner.slot = pair.second;
  partners_[first].push_back(partner);
  partner.slot = pair.first;
  partners_[second].push_back(partner);
}

template <int Dim>
void RestingPairs<Dim>::take(int slot, std::vector<NearPair<Dim>>& pairs) {
  if (static_cast<std::size_t>(slot) >= partners_.size()) return;
  std::vector<Partner>& own = partners_[static_cast<std::size_t>(slot)];
  for (const Partner& partner : own) {
    pairs.push_back(pair_of(slot, partner));
    std::vector<Partner>& others = partners_[static_cast<std::size_t>(partner.slot)];
    others.erase(std::find_if(others.begin(), others.end(),
                              [slot](const Partner& other) { return other.slot == slot; }));
  }
  own.clear();
}

template <int Dim>
void RestingPairs<Dim>::copy(int slot, std::vector<NearPair<Dim>>& pairs) const {
  if (static_cast<std::size_t>(slot) >= partners_.size()) return;
  for (const Partner& partner : partners_[static_cast<std::size_t>(slot)])
    pairs.push_back(pair_of(slot, partner));
}

template <int Dim>
void RestingPairs<Dim>::copy(std::vector<NearPair<Dim>>& pairs) const {
  for (std::size_t slot = 0; slot < partners_.size(); ++slot)
    for (const Partner& partner : partners_[slot])
      if (partner.slot > static_cast<int>(slot)) pairs.push_back(pair_of(static_cast<int>(slot), partner));
}

template class RestingPairs<2>;
template class RestingPairs<3>;

}  // namespace aeolian
