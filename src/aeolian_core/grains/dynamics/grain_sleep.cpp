#include <algorithm>
#include <cmath>

#include "aeolian_core/grains/dynamics/grain_engine.hpp"
#include "aeolian_core/grains/dynamics/pair_meeting.hpp"

namespace aeolian {
namespace {

constexpr int steps_between_lulls = 64;

/// What the second grain of a pair does to the first, and the other way round, as they are now.
template <int Dim>
bool loads_of(const LawConstants& law, const double* period, const GrainRecord<Dim>& first,
              const GrainRecord<Dim>& second, NearPair<Dim> pair, GrainLoad<Dim>& on_first,
              GrainLoad<Dim>& on_second) {
  PairMeeting<Dim, double> meeting;
  meeting.place(first.value, second.value, period);
  if (!(meeting.meeting.overlap > 0)) return false;
  meeting.move(first.value, second.value, 0);
  Answer<Dim, double> force;
  law.hertz ? answer<true>(law, 0, meeting.meeting, pair.slip, force)
            : answer<false>(law, 0, meeting.meeting, pair.slip, force);
  double torque[GrainRecord<Dim>::turns];
  twist<Dim>(meeting.meeting.normal, force.shear, torque);
  for (int d = 0; d < Dim; ++d) {
    on_first.value[d] = force.normal * meeting.meeting.normal[d] + force.shear[d];
    on_second.value[d] = -on_first.value[d];
  }
  for (int d = 0; d < GrainRecord<Dim>::turns; ++d) {
    on_first.value[GrainLoad<Dim>::torque + d] = torque[d] * meeting.arm_first;
    on_second.value[GrainLoad<Dim>::torque + d] = torque[d] * meeting.arm_second;
  }
  return true;
}

template <int Dim>
void add_load(GrainLoad<Dim>& to, const GrainLoad<Dim>& load, double times) {
  for (int k = 0; k < 4 * GrainLoad<Dim>::packs; ++k) to.value[k] += times * load.value[k];
}

/// `others` ascend; what is there already stays once.
void merge(std::vector<int>& slots, const std::vector<int>& others) {
  const auto middle = static_cast<std::ptrdiff_t>(slots.size());
  slots.insert(slots.end(), others.begin(), others.end());
  std::inplace_merge(slots.begin(), slots.begin() + middle, slots.end());
  slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
}

template <int Dim>
double squares(const double* from, int count) {
  double sum = 0;
  for (int k = 0; k < count; ++k) sum += from[k] * from[k];
  return sum;
}

}  // namespace

/// Counts what the awake neighbours of sleepers in one chunk have pushed them beyond what they felt when they
/// fell asleep; those that it would have set in motion are to be woken.
template <int Dim>
void GrainDynamics<Dim>::Engine::watch(int chunk, double dt, std::vector<int>& restless) {
  const double slow = world_.sleep.speed * world_.sleep.speed;
  for (int at = border_begin_[static_cast<std::size_t>(chunk)];
       at < border_begin_[static_cast<std::size_t>(chunk) + 1]; ++at) {
    const auto slot = static_cast<std::size_t>(border_[static_cast<std::size_t>(at)]);
    Load& load = loads_[slot];
    Load& owed = sleepers_[slot].owed;
    add_load<Dim>(owed, load, dt);
    add_load<Dim>(owed, sleepers_[slot].expected, -dt);
    load = Load();
    const double* const value = records_[slot].value;
    const double speed = squares<Dim>(owed.value, Dim) * std::pow(value[Record::inverse_mass], 2);
    const double surface = squares<Dim>(owed.value + Load::torque, Record::turns) *
                           std::pow(value[Record::inverse_inertia] * value[Record::radius], 2);
    if (speed > slow || surface > slow) restless.push_back(static_cast<int>(slot));
  }
}

/// `slots` sleep and ascend.
template <int Dim>
void GrainDynamics<Dim>::Engine::wake(const std::vector<int>& slots) {
  std::vector<NearPair<Dim>> pairs;
  for (const int slot : slots) {
    asleep_[static_cast<std::size_t>(slot)] = 0;
    rest_[static_cast<std::size_t>(slot)] = 0;
    resting_.take(slot, pairs);
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<int> beside;
  for (const NearPair<Dim>& pair : pairs) {
    change_expected(pair, 1);
    if (sleeps(pair.first)) beside.push_back(pair.first);
    if (sleeps(pair.second)) beside.push_back(pair.second);
  }
  // They start from rest: what has pushed them was thrown back with all its energy.
  for (const int slot : slots) {
    Sleeper& sleeper = sleepers_[static_cast<std::size_t>(slot)];
    sleeper.owed = sleeper.expected = Load();
  }
  contacts_.insert(pairs, static_cast<int>(records_.size()));

  merge(awake_, slots);
  border_.erase(std::remove_if(border_.begin(), border_.end(), [this](int slot) { return !sleeps(slot); }),
                border_.end());
  std::sort(beside.begin(), beside.end());
  merge(border_, beside);
  divide_work();
}

template <int Dim>
void GrainDynamics<Dim>::Engine::wake_all() {
  std::vector<int> slots;
  for (std::size_t slot = 1; slot < records_.size(); ++slot)
    if (asleep_[slot]) slots.push_back(static_cast<int>(slot));
  if (!slots.empty()) wake(slots);
}

/// The load of an awake grain on a sleeper belongs to what the sleeper expects.
template <int Dim>
void GrainDynamics<Dim>::Engine::change_expected(const NearPair<Dim>& pair, double times) {
  const auto first = static_cast<std::size_t>(pair.first), second = static_cast<std::size_t>(pair.second);
  if (!asleep_[first] && !asleep_[second]) return;
  Load on_first, on_second;
  if (!loads_of<Dim>(law_, near_.period().data(), records_[first], records_[second], pair, on_first,
                     on_second))
    return;
  if (asleep_[first]) add_load<Dim>(sleepers_[first].expected, on_first, times);
  if (asleep_[second]) add_load<Dim>(sleepers_[second].expected, on_second, times);
}

/// Now and then puts to sleep the grains that have been slow for long enough and rest on something.
template <int Dim>
void GrainDynamics<Dim>::Engine::lull() {
  if (world_.sleep.speed == 0 || ++steps_since_lull_ < steps_between_lulls) return;
  steps_since_lull_ = 0;
  if (std::none_of(awake_.begin(), awake_.end(), [this](int slot) {
        return rest_[static_cast<std::size_t>(slot)] > world_.sleep.patience;
      }))
    return;

  std::vector<NearPair<Dim>> pairs = contacts_.pairs();
  std::vector<char> supported(records_.size(), world_.acceleration.isZero());
  std::vector<char> shaken(records_.size(), 0);
  for (const NearPair<Dim>& pair : pairs) {
    PairMeeting<Dim, double> meeting;
    const auto first = static_cast<std::size_t>(pair.first), second = static_cast<std::size_t>(pair.second);
    meeting.place(records_[first].value, records_[second].value, near_.period().data());
    if (meeting.meeting.overlap > 0) supported[first] = supported[second] = 1;
  }
  for (WallContact<Dim> contact : wall_contacts_) {
    const auto slot = static_cast<std::size_t>(contact.grain);
    const Wall<Dim>& wall = world_.walls[static_cast<std::size_t>(contact.wall)];
    if (!wall.velocity.isZero()) shaken[slot] = 1;
    if (wall_force(law_, 0, wall, records_[slot], contact.slip).touching) supported[slot] = 1;
  }

  std::vector<char> tired(records_.size(), 0);
  for (const int slot : awake_) {
    const auto s = static_cast<std::size_t>(slot);
    if (!(rest_[s] > world_.sleep.patience) || !supported[s] || shaken[s]) continue;
    tired[s] = 1;
    sleepers_[s].expected = sleepers_[s].owed = Load();
    double* const value = records_[s].value;
    std::fill_n(value + Record::velocity, Dim, 0.0);
    std::fill_n(value + Record::acceleration, Dim, 0.0);
    std::fill_n(value + Record::spin, Record::turns, 0.0);
    std::fill_n(value + Record::turning, Record::turns, 0.0);
  }
  // A sleeper no longer feels a neighbour that falls asleep, too; one that falls asleep is used to what its
  // awake neighbours do.
  for (const NearPair<Dim>& pair : pairs) {
    const auto first = static_cast<std::size_t>(pair.first), second = static_cast<std::size_t>(pair.second);
    if (tired[first] && tired[second]) continue;
    if ((tired[first] && asleep_[second]) || (tired[second] && asleep_[first])) change_expected(pair, -1);
  }
  for (const int slot : awake_)
    if (tired[static_cast<std::size_t>(slot)]) asleep_[static_cast<std::size_t>(slot)] = 1;
  const auto asleep = std::stable_partition(pairs.begin(), pairs.end(), [this](const auto& pair) {
    return !sleeps(pair.first) || !sleeps(pair.second);
  });
  for (auto pair = pairs.begin(); pair != asleep; ++pair) {
    const bool new_sleeper =
        tired[static_cast<std::size_t>(pair->first)] || tired[static_cast<std::size_t>(pair->second)];
    if (new_sleeper) change_expected(*pair, 1);
  }
  std::for_each(asleep, pairs.end(), [this](const auto& pair) { resting_.add(pair); });
  pairs.erase(asleep, pairs.end());
  contacts_.assign(pairs, static_cast<int>(records_.size()));
  find_awake();
}

/// Who is awake, and who sleeps beside somebody awake.
template <int Dim>
void GrainDynamics<Dim>::Engine::find_awake() {
  std::vector<char> beside(records_.size(), 0);
  const int* const first = contacts_.first();
  const int* const second = contacts_.second();
  for (int at = 0; at < contacts_.end(contacts_.chunks() - 1); ++at) {
    beside[static_cast<std::size_t>(first[at])] = 1;
    beside[static_cast<std::size_t>(second[at])] = 1;
  }
  awake_.clear();
  border_.clear();
  for (std::size_t slot = 1; slot < records_.size(); ++slot) {
    if (number_[slot] < 0) continue;
    if (!asleep_[slot])
      awake_.push_back(static_cast<int>(slot));
    else if (beside[slot])
      border_.push_back(static_cast<int>(slot));
  }
  divide_work();
}

/// Where the chunks begin.
template <int Dim>
void GrainDynamics<Dim>::Engine::divide_work() {
  awake_begin_.assign(1, 0);
  border_begin_.assign(1, 0);
  wall_begin_.assign(1, 0);
  std::size_t awake = 0, border = 0, wall = 0;
  for (int chunk = 0; chunk < contacts_.chunks(); ++chunk) {
    const int end = (chunk + 1) * slots_per_chunk;
    while (awake < awake_.size() && awake_[awake] < end) ++awake;
    while (border < border_.size() && border_[border] < end) ++border;
    while (wall < wall_contacts_.size() && wall_contacts_[wall].grain < end) ++wall;
    awake_begin_.push_back(static_cast<int>(awake));
    border_begin_.push_back(static_cast<int>(border));
    wall_begin_.push_back(static_cast<int>(wall));
  }
  if (loads_.size() < static_cast<std::size_t>(contacts_.loads()))
    loads_.resize(static_cast<std::size_t>(contacts_.loads()));
}

template class GrainDynamics<2>::Engine;
template class GrainDynamics<3>::Engine;

}  // namespace aeolian
