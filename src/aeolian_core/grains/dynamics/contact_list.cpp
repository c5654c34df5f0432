#include "aeolian_core/grains/dynamics/contact_list.hpp"

#include <algorithm>

#include "aeolian_core/surface/lanes.hpp"

namespace aeolian {

template <int Dim>
void ContactList<Dim>::assign(const std::vector<NearPair<Dim>>& pairs, int slots) {
  const int chunks = chunk_of(slots - 1) + 1;
  first_.clear();
  second_.clear();
  target_.clear();
  for (auto& axis : slip_) axis.clear();
  begin_.assign(1, 0);
  fetches_.clear();
  loads_ = slots;

  const auto push = [this](const NearPair<Dim>& pair, int target) {
    first_.push_back(pair.first);
    second_.push_back(pair.second);
    target_.push_back(target);
    for (int d = 0; d < slip_size<Dim>; ++d) slip_[d].push_back(pair.slip[d]);
  };
  auto pair = pairs.begin();
  for (int chunk = 0; chunk < chunks; ++chunk) {
    for (; pair != pairs.end() && chunk_of(pair->first) == chunk; ++pair) {
      if (chunk_of(pair->second) == chunk) {
        push(*pair, pair->second);
      } else {
        fetches_.push_back({pair->second, loads_});
        push(*pair, loads_++);
      }
    }
    while (first_.size() % lane_count != 0) push({first_.back(), 0}, first_.back());
    begin_.push_back(static_cast<int>(first_.size()));
  }

  std::stable_sort(fetches_.begin(), fetches_.end(),
                   [](const Fetch& a, const Fetch& b) { return chunk_of(a.slot) < chunk_of(b.slot); });
  fetch_begin_.assign(static_cast<std::size_t>(chunks) + 1, 0);
  for (const Fetch& fetch : fetches_) ++fetch_begin_[static_cast<std::size_t>(chunk_of(fetch.slot)) + 1];
  for (std::size_t c = 1; c < fetch_begin_.size(); ++c) fetch_begin_[c] += fetch_begin_[c - 1];
}

template <int Dim>
std::vector<NearPair<Dim>> ContactList<Dim>::pairs() const {
  std::vector<NearPair<Dim>> pairs;
  pairs.reserve(first_.size());
  for (std::size_t at = 0; at < first_.size(); ++at) {
    if (second_[at] == 0) continue;
    NearPair<Dim> pair{first_[at], second_[at]};
    for (int d = 0; d < slip_size<Dim>; ++d) pair.slip[d] = slip_[d][at];
    pairs.push_back(pair);
  }
  return pairs;
}

template class ContactList<2>;
template class ContactList<3>;

}  // namespace aeolian
