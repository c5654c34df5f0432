#include "aeolian_core/grains/dynamics/contact_list.hpp"

#include <algorithm>

#include "aeolian_core/surface/lanes.hpp"

namespace aeolian {

template <int Dim>
void ContactList<Dim>::assign(const std::vector<NearPair<Dim>>& pairs, int slots) {
  const int chunks = chunk_of(slots - 1) + 1;
  resize(pairs.size() + static_cast<std::size_t>(chunks) * (lane_count - 1));
  begin_.assign(1, 0);
  fetches_.clear();
  loads_ = slots;

  std::size_t size = 0;
  const auto push = [&](const NearPair<Dim>& pair, int target) {
    first_[size] = pair.first;
    second_[size] = pair.second;
    target_[size] = target;
    for (int d = 0; d < slip_size<Dim>; ++d) slip_[d][size] = pair.slip[d];
    ++size;
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
    while (size % lane_count != 0) push({first_[size - 1], 0}, first_[size - 1]);
    begin_.push_back(static_cast<int>(size));
  }
  resize(size);

  std::stable_sort(fetches_.begin(), fetches_.end(),
                   [](const Fetch& a, const Fetch& b) { return chunk_of(a.slot) < chunk_of(b.slot); });
  fetch_begin_.assign(static_cast<std::size_t>(chunks) + 1, 0);
  for (const Fetch& fetch : fetches_) ++fetch_begin_[static_cast<std::size_t>(chunk_of(fetch.slot)) + 1];
  for (std::size_t c = 1; c < fetch_begin_.size(); ++c) fetch_begin_[c] += fetch_begin_[c - 1];
}

template <int Dim>
void ContactList<Dim>::resize(std::size_t size) {
  for (auto* column : {&first_, &second_, &target_}) column->resize(size);
  for (auto& axis : slip_) axis.resize(size);
}

template <int Dim>
std::vector<NearPair<Dim>> ContactList<Dim>::pairs() const {
  std::vector<NearPair<Dim>> pairs(first_.size());
  auto pair = pairs.begin();
  for (std::size_t at = 0; at < first_.size(); ++at) {
    if (second_[at] == 0) continue;
    pair->first = first_[at];
    pair->second = second_[at];
    for (int d = 0; d < slip_size<Dim>; ++d) pair->slip[d] = slip_[d][at];
    ++pair;
  }
  pairs.erase(pair, pairs.end());
  return pairs;
}

template class ContactList<2>;
template class ContactList<3>;

}  // namespace aeolian
