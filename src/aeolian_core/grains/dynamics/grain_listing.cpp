#include <algorithm>
#include <cmath>

#include "aeolian_core/grains/dynamics/grain_engine.hpp"

namespace aeolian {
namespace {

/// A grain's skin lasts so many steps at its present speed.
constexpr double steps_per_skin = 30;
/// With one grain that has used up its skin, all that have used so much of theirs are looked at.
constexpr double used_up = 0.6;

}  // namespace

template <int Dim>
void GrainDynamics<Dim>::Engine::prepare() {
  if (ready_) return;
  measure();
  if (!removed_.empty()) drop_removed();
  if (sort_again_ || unlisted_.size() * 8 > records_.size() || listed_since_sort_ > 4 * records_.size())
    sort();
  if (!unlisted_.empty() || list_walls_again_) {
    std::sort(unlisted_.begin(), unlisted_.end());
    list(unlisted_, contacts_.pairs(), std::min(natural_step(), 1.0));
    unlisted_.clear();
  }
  find_forces(0);
  kick(0);
  ready_ = true;
}

template <int Dim>
void GrainDynamics<Dim>::Engine::measure() {
  inputs_ = {};
  inputs_.gravity = world_.acceleration.norm();
  double heaviest = 0, speeds = 0;
  inputs_.least_radius = std::numeric_limits<double>::infinity();
  for (const int grain : numbers_) {
    const Record& record = this->record(grain);
    heaviest = std::max(heaviest, record.value[Record::inverse_mass]);
    inputs_.least_radius = std::min(inputs_.least_radius, record.value[Record::radius]);
    speeds = std::max(speeds, Eigen::Map<const Vector<Dim>>(record.value + Record::velocity).squaredNorm());
  }
  for (const Wall<Dim>& wall : world_.walls) speeds = std::max(speeds, wall.velocity.squaredNorm());
  inputs_.least_mass = heaviest > 0 ? 1 / heaviest : 0;
  inputs_.speed = std::sqrt(speeds);
}

/// Slots by cell, without those of removed grains; every grain is unlisted then.
template <int Dim>
void GrainDynamics<Dim>::Engine::sort() {
  near_.restart(records_);
  std::vector<int> fresh(records_.size(), 0);
  std::vector<Record> records(1, records_[0]);
  std::vector<int> numbers(1, -1);
  std::vector<char> asleep(1, 0);
  std::vector<Sleeper> sleepers(1);
  std::vector<double> rest(1, 0);
  for (const int slot : near_.order(records_)) {
    const auto s = static_cast<std::size_t>(slot);
    if (number_[s] < 0) continue;
    const int place = static_cast<int>(records.size());
    fresh[s] = place;
    slot_[static_cast<std::size_t>(number_[s])] = place;
    records.push_back(records_[s]);
    numbers.push_back(number_[s]);
    asleep.push_back(asleep_[s]);
    sleepers.push_back(sleepers_[s]);
    rest.push_back(rest_[s]);
  }
  records_.swap(records);
  number_.swap(numbers);
  asleep_.swap(asleep);
  sleepers_.swap(sleepers);
  rest_.swap(rest);

  std::vector<NearPair<Dim>> pairs;
  for (NearPair<Dim> pair : all_pairs()) {
    pair.first = fresh[static_cast<std::size_t>(pair.first)];
    pair.second = fresh[static_cast<std::size_t>(pair.second)];
    if (pair.first == 0 || pair.second == 0) continue;
    if (pair.first > pair.second) {
      std::swap(pair.first, pair.second);
      // A displacement of the first relative to the second; along the tangent of discs it keeps its sign.
      if (Dim == 3)
        for (double& slip : pair.slip) slip = -slip;
    }
    pairs.push_back(pair);
  }
  std::sort(pairs.begin(), pairs.end());
  contacts_.assign(pairs, static_cast<int>(records_.size()));
  resting_.clear();

  std::vector<WallContact<Dim>> wall_contacts;
  for (WallContact<Dim> contact : wall_contacts_) {
    contact.grain = fresh[static_cast<std::size_t>(contact.grain)];
    if (contact.grain != 0) wall_contacts.push_back(contact);
  }
  std::sort(wall_contacts.begin(), wall_contacts.end());
  wall_contacts_.swap(wall_contacts);

  near_.restart(records_);
  unlisted_.clear();
  for (std::size_t slot = 1; slot < records_.size(); ++slot) unlisted_.push_back(static_cast<int>(slot));
  removed_.clear();
  listed_since_sort_ = 0;
  sort_again_ = false;
  loads_.assign(records_.size(), {});
}

/// New anchors and all pairs of some slots, ascending; `pairs` are those that were listed.
template <int Dim>
void GrainDynamics<Dim>::Engine::list(const std::vector<int>& slots, std::vector<NearPair<Dim>> pairs,
                                      double dt) {
  std::vector<double> skins;
  skins.reserve(slots.size());
  for (const int slot : slots) {
    Record& record = records_[static_cast<std::size_t>(slot)];
    for (int d = 0; d < Dim; ++d) {
      double& x = record.value[Record::place + d];
      const double period = world_.period[d];
      if (period > 0 && (x < 0 || x >= period)) x -= period * std::floor(x / period);
    }
    const double speed = Eigen::Map<const Vector<Dim>>(record.value + Record::velocity).norm();
    skins.push_back(near_.skin(record.value[Record::radius], speed, steps_per_skin * dt));
  }
  near_.look_at(slots, skins, records_, pairs);
  // After a sort the list is a whole one, with the pairs that sleep.
  const auto asleep = std::stable_partition(pairs.begin(), pairs.end(), [this](const auto& pair) {
    return !sleeps(pair.first) || !sleeps(pair.second);
  });
  std::for_each(asleep, pairs.end(), [this](const auto& pair) { resting_.add(pair); });
  pairs.erase(asleep, pairs.end());
  contacts_.assign(pairs, static_cast<int>(records_.size()));
  listed_since_sort_ += slots.size();
  if (list_walls_again_) {
    wall_way_.assign(world_.walls.size(), 0);
    wall_skin_.clear();
    for (const Wall<Dim>& wall : world_.walls)
      wall_skin_.push_back(near_.skin(inputs_.least_radius, wall.velocity.norm(), steps_per_skin * dt));
    std::vector<int> all;
    for (std::size_t slot = 1; slot < records_.size(); ++slot)
      if (number_[slot] >= 0) all.push_back(static_cast<int>(slot));
    list_walls(all);
    list_walls_again_ = false;
  } else {
    list_walls(slots);
  }
  find_awake();
}

/// Takes removed grains out of the lists and wakes those that slept on them.
template <int Dim>
void GrainDynamics<Dim>::Engine::drop_removed() {
  const auto gone = [this](int slot) { return number_[static_cast<std::size_t>(slot)] < 0; };
  const auto pair_gone = [&](const NearPair<Dim>& pair) { return gone(pair.first) || gone(pair.second); };
  std::vector<NearPair<Dim>> lost;
  for (const int slot : removed_) resting_.take(slot, lost);
  std::vector<int> left;
  for (const NearPair<Dim>& pair : lost)
    for (const int slot : {pair.first, pair.second})
      if (!gone(slot)) left.push_back(slot);
  std::vector<NearPair<Dim>> pairs = contacts_.pairs();
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), pair_gone), pairs.end());
  contacts_.assign(pairs, static_cast<int>(records_.size()));
  wall_contacts_.erase(std::remove_if(wall_contacts_.begin(), wall_contacts_.end(),
                                      [&](const auto& contact) { return gone(contact.grain); }),
                       wall_contacts_.end());
  for (const int slot : removed_) near_.forget(slot);
  removed_.clear();
  std::sort(left.begin(), left.end());
  left.erase(std::unique(left.begin(), left.end()), left.end());
  wake(left);
  find_awake();
}

template <int Dim>
std::vector<NearPair<Dim>> GrainDynamics<Dim>::Engine::all_pairs() const {
  std::vector<NearPair<Dim>> pairs = contacts_.pairs();
  resting_.copy(pairs);
  return pairs;
}

template <int Dim>
std::vector<NearPair<Dim>> GrainDynamics<Dim>::Engine::pairs_of(int slot) const {
  std::vector<NearPair<Dim>> pairs;
  contacts_.copy(slot, pairs);
  resting_.copy(slot, pairs);
  return pairs;
}

template <int Dim>
void GrainDynamics<Dim>::Engine::list_walls(const std::vector<int>& slots) {
  std::vector<WallContact<Dim>> found;
  for (const int slot : slots) {
    const auto& anchor = near_.anchor(slot);
    const Vector<Dim> place = Eigen::Map<const Vector<Dim>>(anchor.place);
    const double reach = records_[static_cast<std::size_t>(slot)].value[Record::radius] + anchor.skin;
    for (std::size_t w = 0; w < world_.walls.size(); ++w)
      if (nearest(world_.walls[w], place).distance < reach + wall_skin_[w])
        found.push_back({slot, static_cast<int>(w)});
  }
  std::vector<WallContact<Dim>> merged;
  auto old = wall_contacts_.begin();
  const auto stale = [&](const WallContact<Dim>& contact) {
    return std::binary_search(slots.begin(), slots.end(), contact.grain);
  };
  for (WallContact<Dim>& contact : found) {
    for (; old != wall_contacts_.end() && *old < contact; ++old)
      if (!stale(*old)) merged.push_back(*old);
    if (old != wall_contacts_.end() && !(contact < *old))
      std::copy_n((old++)->slip, slip_size<Dim>, contact.slip);
    merged.push_back(contact);
  }
  for (; old != wall_contacts_.end(); ++old)
    if (!stale(*old)) merged.push_back(*old);
  wall_contacts_.swap(merged);
}

/// Looks again at the grains that have used up their skins, if any.
template <int Dim>
void GrainDynamics<Dim>::Engine::list_moved(double dt, bool moved) {
  const auto way_squared = [this](int slot) {
    const auto& anchor = near_.anchor(slot);
    const double* const place = records_[static_cast<std::size_t>(slot)].value + Record::place;
    double sum = 0;
    for (int d = 0; d < Dim; ++d) sum += (place[d] - anchor.place[d]) * (place[d] - anchor.place[d]);
    return sum / (anchor.skin * anchor.skin);
  };
  bool walls_moved = false;
  for (std::size_t w = 0; w < world_.walls.size(); ++w) {
    wall_way_[w] += dt * world_.walls[w].velocity.norm();
    walls_moved = walls_moved || wall_way_[w] > wall_skin_[w];
  }
  if (!moved && !walls_moved) return;
  list_walls_again_ = list_walls_again_ || walls_moved;
  if (moved && listed_since_sort_ > 4 * records_.size()) {
    sort();
    list(std::vector<int>(unlisted_), contacts_.pairs(), dt);
    unlisted_.clear();
    return;
  }
  std::vector<int> slots;
  if (moved)
    for (const int slot : awake_)
      if (way_squared(slot) > used_up * used_up) slots.push_back(slot);
  list(slots, contacts_.pairs(), dt);
}

template class GrainDynamics<2>::Engine;
template class GrainDynamics<3>::Engine;

}  // namespace aeolian
