#include "aeolian_core/grains/dynamics/contact_list.hpp"

#include <algorithm>

#include "aeolian_core/surface/lanes.hpp"

namespace aeolian {

template <int Dim>
void ContactList<Dim>::assign(const std::vector<NearPair<Dim>>& pairs, int slots) {
  now_.resize(0);
  begin_.assign(1, 0);
  insert(pairs, slots);
}

template <int Dim>
void ContactList<Dim>::insert(const std::vector<NearPair<Dim>>& others, int slots) {
  const int chunks = chunk_of(slots - 1) + 1;
  std::swap(now_, before_);
  const Columns& old = before_;
  now_.resize(old.first.size() + others.size() + static_cast<std::size_t>(chunks) * (lane_count - 1));
  begin_.assign(1, 0);
  fetches_.clear();
  loads_ = slots;

  std::size_t size = 0;
  const auto push = [&](int chunk, int first, int second) {
    int target = second;
    if (chunk_of(second) != chunk) {
      target = loads_++;
      fetches_.push_back({second, target});
    }
    now_.first[size] = first;
    now_.second[size] = second;
    now_.target[size] = target;
  };
  std::size_t at = 0;
  auto other = others.begin();
  for (int chunk = 0; chunk < chunks; ++chunk) {
    const int end = (chunk + 1) * slots_per_chunk;
    for (;;) {
      while (at < old.first.size() && old.second[at] == 0) ++at;
      const bool has_old = at < old.first.size() && old.first[at] < end;
      const bool has_other = other != others.end() && other->first < end;
      if (!has_old && !has_other) break;
      if (has_old && !(has_other && *other < NearPair<Dim>{old.first[at], old.second[at]})) {
        push(chunk, old.first[at], old.second[at]);
        for (int d = 0; d < slip_size<Dim>; ++d) now_.slip[d][size] = old.slip[d][at];
        ++at;
      } else {
        push(chunk, other->first, other->second);
        for (int d = 0; d < slip_size<Dim>; ++d) now_.slip[d][size] = other->slip[d];
        ++other;
      }
      ++size;
    }
    for (; size % lane_count != 0; ++size) {
      now_.first[size] = now_.target[size] = now_.first[size - 1];
      now_.second[size] = 0;
      for (auto& axis : now_.slip) axis[size] = 0;
    }
    begin_.push_back(static_cast<int>(size));
  }
  now_.resize(size);
  sort_fetches(chunks);
}

/// By the chunk that fetches them; within it the order is kept.
template <int Dim>
void ContactList<Dim>::sort_fetches(int chunks) {
  std::stable_sort(fetches_.begin(), fetches_.end(),
                   [](const Fetch& a, const Fetch& b) { return chunk_of(a.slot) < chunk_of(b.slot); });
  fetch_begin_.assign(static_cast<std::size_t>(chunks) + 1, 0);
  for (const Fetch& fetch : fetches_) ++fetch_begin_[static_cast<std::size_t>(chunk_of(fetch.slot)) + 1];
  for (std::size_t c = 1; c < fetch_begin_.size(); ++c) fetch_begin_[c] += fetch_begin_[c - 1];
}

template <int Dim>
void ContactList<Dim>::Columns::resize(std::size_t size) {
  for (auto* column : {&first, &second, &target}) column->resize(size);
  for (auto& axis : slip) axis.resize(size);
}

template <int Dim>
NearPair<Dim> ContactList<Dim>::pair(std::size_t at) const {
  NearPair<Dim> pair{now_.first[at], now_.second[at]};
  for (int d = 0; d < slip_size<Dim>; ++d) pair.slip[d] = now_.slip[d][at];
  return pair;
}

template <int Dim>
std::vector<NearPair<Dim>> ContactList<Dim>::pairs() const {
  std::vector<NearPair<Dim>> pairs;
  pairs.reserve(now_.first.size());
  for (std::size_t at = 0; at < now_.first.size(); ++at)
    if (now_.second[at] != 0) pairs.push_back(pair(at));
  return pairs;
}

template <int Dim>
void ContactList<Dim>::copy(int slot, std::vector<NearPair<Dim>>& pairs) const {
  for (std::size_t at = 0; at < now_.first.size(); ++at)
    if ((now_.first[at] == slot && now_.second[at] != 0) || now_.second[at] == slot)
      pairs.push_back(pair(at));
}

template class ContactList<2>;
template class ContactList<3>;

}  // namespace aeolian
