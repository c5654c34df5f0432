#include "aeolian_core/grains/dynamics/grain_engine.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>

#include "aeolian_core/grains/dynamics/grain_world.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

template <int Dim>
std::array<double, Dim> infinite_where_none(const Vector<Dim>& period) {
  std::array<double, Dim> out;
  for (int d = 0; d < Dim; ++d)
    out[static_cast<std::size_t>(d)] = period[d] > 0 ? period[d] : std::numeric_limits<double>::infinity();
  return out;
}

template <int Dim>
const GrainWorld<Dim>& valid(const GrainWorld<Dim>& world) {
  require_valid(world);
  return world;
}

double mass_of(double radius, const GrainWorld<2>& world) {
  return M_PI * radius * radius * world.density * world.thickness;
}
double mass_of(double radius, const GrainWorld<3>& world) {
  return 4.0 / 3 * M_PI * radius * radius * radius * world.density;
}

template <int Dim>
void set_values(GrainRecord<Dim>& record, int at, const Vector<Dim>& values) {
  std::copy_n(values.data(), Dim, record.value + at);
}

}  // namespace

template <int Dim>
GrainDynamics<Dim>::Engine::Engine(const GrainWorld<Dim>& world)
    : world_(valid(world)), law_(world.law), near_(infinite_where_none<Dim>(world.period)) {
  records_[0].value[Record::inverse_mass] = 1;
  records_[0].value[Record::place] = 1e150;
}

template <int Dim>
void GrainDynamics<Dim>::Engine::set_world(const GrainWorld<Dim>& world) {
  require_valid(world);
  for (const int grain : numbers_)
    require_valid_grain<Dim>(world, position(grain), radius(grain), Vector<Dim>::Zero(), Spin<Dim>::Zero());
  if (world.walls.size() != world_.walls.size()) wall_contacts_.clear();
  if (world.period != world_.period) {
    near_ = NearList<Dim>(infinite_where_none<Dim>(world.period));
    sort_again_ = true;
  }
  world_ = world;
  law_ = LawConstants(world.law);
  for (const int grain : numbers_) set_mass(records_[slot_of(grain)]);
  list_walls_again_ = true;
  wake_all();
  ready_ = false;
}

template <int Dim>
void GrainDynamics<Dim>::Engine::set_threads(int threads) {
  if (threads < 0)
    throw Error("grain dynamics: threads are " + std::to_string(threads) + ", must be zero or positive");
  crew_.set_threads(threads);
}

template <int Dim>
void GrainDynamics<Dim>::Engine::set_mass(Record& record) const {
  const double radius = record.value[Record::radius];
  const double mass = mass_of(radius, world_);
  record.value[Record::inverse_mass] = 1 / mass;
  record.value[Record::inverse_inertia] = 1 / ((Dim == 2 ? 0.5 : 0.4) * mass * radius * radius);
}

template <int Dim>
int GrainDynamics<Dim>::Engine::add(const Vector<Dim>& position, double radius, const Vector<Dim>& velocity,
                                    const Spin<Dim>& spin) {
  require_valid_grain<Dim>(world_, position, radius, velocity, spin);
  Record record;
  set_values<Dim>(record, Record::place, position);
  set_values<Dim>(record, Record::velocity, velocity);
  std::copy_n(spin.data(), Record::turns, record.value + Record::spin);
  record.value[Record::radius] = radius;
  set_mass(record);
  const int number = static_cast<int>(slot_.size());
  const int slot = static_cast<int>(records_.size());
  slot_.push_back(slot);
  records_.push_back(record);
  number_.push_back(number);
  asleep_.push_back(0);
  sleepers_.emplace_back();
  rest_.push_back(0);
  numbers_.push_back(number);
  unlisted_.push_back(slot);
  ready_ = false;
  return number;
}

template <int Dim>
void GrainDynamics<Dim>::Engine::remove(int grain) {
  const std::size_t slot = slot_of(grain);
  number_[slot] = -1;
  slot_[static_cast<std::size_t>(grain)] = -1;
  numbers_.erase(std::lower_bound(numbers_.begin(), numbers_.end(), grain));
  removed_.push_back(static_cast<int>(slot));
  ready_ = false;
}

template <int Dim>
void GrainDynamics<Dim>::Engine::set_motion(int grain, const Vector<Dim>& velocity, const Spin<Dim>& spin) {
  const std::size_t slot = slot_of(grain);
  Record& record = records_[slot];
  require_valid_grain<Dim>(world_, position(grain), radius(grain), velocity, spin);
  if (asleep_[slot]) wake({static_cast<int>(slot)});
  set_values<Dim>(record, Record::velocity, velocity);
  std::copy_n(spin.data(), Record::turns, record.value + Record::spin);
  ready_ = false;
}

template <int Dim>
bool GrainDynamics<Dim>::Engine::holds(int grain) const {
  return grain >= 0 && static_cast<std::size_t>(grain) < slot_.size() &&
         slot_[static_cast<std::size_t>(grain)] >= 0;
}

template <int Dim>
std::size_t GrainDynamics<Dim>::Engine::slot_of(int grain) const {
  if (!holds(grain)) throw Error("grain dynamics: there is no grain " + std::to_string(grain));
  return static_cast<std::size_t>(slot_[static_cast<std::size_t>(grain)]);
}

template <int Dim>
Vector<Dim> GrainDynamics<Dim>::Engine::position(int grain) const {
  Vector<Dim> place = Eigen::Map<const Vector<Dim>>(record(grain).value + Record::place);
  for (int d = 0; d < Dim; ++d) {
    const double period = world_.period[d];
    if (period > 0) place[d] = std::clamp(place[d] - period * std::floor(place[d] / period), 0.0, period);
  }
  return place;
}

template <int Dim>
double GrainDynamics<Dim>::Engine::step(double most) {
  prepare();
  refuse_squeezed();
  if (numbers_.empty() && std::isinf(most)) return 0;
  const double dt = std::min(most, natural_step());
  if (!(dt > 0)) return 0;
  if (time_ + dt == time_)
    throw Error("grain dynamics: a grain moves at " + std::to_string(inputs_.speed) +
                " m/s, too fast for any step");
  make_step(dt);
  return dt;
}

template <int Dim>
void GrainDynamics<Dim>::Engine::advance(double duration) {
  if (!(duration >= 0 && std::isfinite(duration)))
    throw Error("grain dynamics: duration is " + std::to_string(duration) + ", must be zero or positive");
  prepare();
  for (double left = duration; left > 0;) {
    // Equal steps, instead of long ones and a short last one.
    const double dt = left / std::max(1.0, std::ceil(left / natural_step()));
    left -= step(dt);
  }
}

template <int Dim>
void GrainDynamics<Dim>::Engine::make_step(double dt) {
  for (Wall<Dim>& wall : world_.walls) aeolian::move(wall, dt);
  const bool moved = move(dt);
  time_ += dt;
  grain_steps_ += awake_.size();
  list_moved(dt, moved);
  find_forces(dt);
  kick(dt);
  lull();
}

template <int Dim>
double GrainDynamics<Dim>::Engine::natural_step() const {
  return time_step(world_.law, world_.steps_per_contact, world_.drag, inputs_);
}

/// Whether a grain has used up its skin.
template <int Dim>
bool GrainDynamics<Dim>::Engine::move(double dt) {
  std::atomic<bool> moved = false;
  crew_.share(contacts_.chunks(), [&](int chunk) {
    const auto c = static_cast<std::size_t>(chunk);
    if (move_grains(records_.data(), near_.anchors(), awake_.data() + awake_begin_[c],
                    awake_begin_[c + 1] - awake_begin_[c], dt))
      moved = true;
  });
  return moved;
}

template <int Dim>
void GrainDynamics<Dim>::Engine::find_forces(double dt) {
  PairWork<Dim> work{
      law_, {},           dt, records_.data(), contacts_.first(), contacts_.second(), contacts_.target(),
      {},   loads_.data()};
  std::copy_n(near_.period().begin(), Dim, work.period);
  for (int d = 0; d < slip_size<Dim>; ++d) work.slip[d] = contacts_.slip(d);
  std::vector<Squeeze> squeezes(static_cast<std::size_t>(contacts_.chunks()));
  crew_.share(contacts_.chunks(), [&](int chunk) {
    const auto c = static_cast<std::size_t>(chunk);
    add_pair_forces(work, contacts_.begin(chunk), contacts_.end(chunk), squeezes[c]);
    add_wall_forces(wall_begin_[c], wall_begin_[c + 1], dt, squeezes[c]);
  });
  squeeze_ = {};
  for (const Squeeze& squeeze : squeezes) {
    squeeze_.overlap = std::max(squeeze_.overlap, squeeze.overlap);
    squeeze_.excess = std::max(squeeze_.excess, squeeze.excess);
  }
}

template <int Dim>
void GrainDynamics<Dim>::Engine::add_wall_forces(int begin, int end, double dt, Squeeze& squeeze) {
  for (int at = begin; at < end; ++at) {
    WallContact<Dim>& contact = wall_contacts_[static_cast<std::size_t>(at)];
    if (sleeps(contact.grain)) continue;
    const auto slot = static_cast<std::size_t>(contact.grain);
    const WallForce<Dim> force = wall_force(law_, dt, world_.walls[static_cast<std::size_t>(contact.wall)],
                                            records_[slot], contact.slip);
    if (!force.touching) continue;
    for (int k = 0; k < 4 * Load::packs; ++k) loads_[slot].value[k] += force.load.value[k];
    squeeze.overlap = std::max(squeeze.overlap, force.overlap);
    squeeze.excess = std::max(squeeze.excess, force.overlap - records_[slot].value[Record::radius]);
  }
}

template <int Dim>
void GrainDynamics<Dim>::Engine::kick(double dt) {
  KickWork<Dim> work{records_.data(), loads_.data(), rest_.data(), dt, {}, world_.drag, world_.sleep.speed};
  std::copy_n(world_.acceleration.data(), Dim, work.gravity);
  const auto chunks = static_cast<std::size_t>(contacts_.chunks());
  std::vector<Liveliest> liveliest(chunks);
  std::vector<std::vector<int>> restless(chunks);
  crew_.share(contacts_.chunks(), [&](int chunk) {
    for (auto fetch = contacts_.fetch_begin(chunk); fetch != contacts_.fetch_end(chunk); ++fetch) {
      Load& from = loads_[static_cast<std::size_t>(fetch->load)];
      Load& to = loads_[static_cast<std::size_t>(fetch->slot)];
      for (int k = 0; k < 4 * Load::packs; ++k) to.value[k] += from.value[k];
      from = Load();
    }
    const auto c = static_cast<std::size_t>(chunk);
    kick_grains(work, awake_.data() + awake_begin_[c], awake_begin_[c + 1] - awake_begin_[c], liveliest[c]);
    watch(chunk, dt, restless[c]);
  });

  double speeds = 0, accelerations = 0;
  for (const Liveliest& of_chunk : liveliest) {
    speeds = std::max(speeds, of_chunk.speed);
    accelerations = std::max(accelerations, of_chunk.acceleration);
  }
  for (const Wall<Dim>& wall : world_.walls) speeds = std::max(speeds, wall.velocity.squaredNorm());
  inputs_.speed = std::sqrt(speeds);
  inputs_.acceleration = std::sqrt(accelerations);
  inputs_.overlap = squeeze_.overlap;

  std::vector<int> woken;
  for (const std::vector<int>& of_chunk : restless)
    woken.insert(woken.end(), of_chunk.begin(), of_chunk.end());
  if (!woken.empty()) wake(woken);
}

template class GrainDynamics<2>::Engine;
template class GrainDynamics<3>::Engine;

}  // namespace aeolian
