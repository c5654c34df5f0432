#include "aeolian_core/grains/grain_engine.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "aeolian_core/grains/grain_world.hpp"
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
}

template <int Dim>
void GrainDynamics<Dim>::Engine::set_world(const GrainWorld<Dim>& world) {
  require_valid(world);
  for (const int grain : numbers_)
    require_valid_grain<Dim>(world, position(grain), radius(grain), Vector<Dim>::Zero(), Spin<Dim>::Zero());
  if (world.period != world_.period || world.density != world_.density || world.thickness != world_.thickness)
    sort_again_ = true;
  if (world.walls.size() != world_.walls.size()) wall_contacts_.clear();
  if (world.period != world_.period) near_ = NearList<Dim>(infinite_where_none<Dim>(world.period));
  world_ = world;
  law_ = LawConstants(world.law);
  for (const int grain : numbers_) set_mass(records_[slot_of(grain)]);
  list_walls_again_ = true;
  ready_ = false;
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
  Record& record = records_[slot_of(grain)];
  require_valid_grain<Dim>(world_, position(grain), radius(grain), velocity, spin);
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
  move(dt);
  time_ += dt;
  grain_steps_ += awake_.size();
  list_moved(dt);
  find_forces(dt);
  kick(dt);
}

template <int Dim>
double GrainDynamics<Dim>::Engine::natural_step() const {
  return time_step(world_.law, world_.steps_per_contact, world_.drag, inputs_);
}

template <int Dim>
void GrainDynamics<Dim>::Engine::move(double dt) {
  for (const int slot : awake_) {
    double* const value = records_[static_cast<std::size_t>(slot)].value;
    for (int d = 0; d < Dim; ++d) {
      value[Record::velocity + d] += dt / 2 * value[Record::acceleration + d];
      value[Record::place + d] += dt * value[Record::velocity + d];
    }
    for (int d = 0; d < Record::turns; ++d) value[Record::spin + d] += dt / 2 * value[Record::turning + d];
  }
}

template <int Dim>
void GrainDynamics<Dim>::Engine::find_forces(double dt) {
  squeeze_ = {};
  if (loads_.size() < static_cast<std::size_t>(contacts_.loads()))
    loads_.resize(static_cast<std::size_t>(contacts_.loads()));
  PairWork<Dim> work{
      law_, {},           dt, records_.data(), contacts_.first(), contacts_.second(), contacts_.target(),
      {},   loads_.data()};
  const auto period = infinite_where_none<Dim>(world_.period);
  std::copy(period.begin(), period.end(), work.period);
  for (int d = 0; d < slip_size<Dim>; ++d) work.slip[d] = contacts_.slip(d);
  for (int chunk = 0; chunk < contacts_.chunks(); ++chunk)
    add_pair_forces(work, contacts_.begin(chunk), contacts_.end(chunk), squeeze_);

  for (WallContact<Dim>& contact : wall_contacts_) {
    const auto slot = static_cast<std::size_t>(contact.grain);
    const WallForce<Dim> force = wall_force(law_, dt, world_.walls[static_cast<std::size_t>(contact.wall)],
                                            records_[slot], contact.slip);
    if (!force.touching) continue;
    for (int k = 0; k < 4 * Load::packs; ++k) loads_[slot].value[k] += force.load.value[k];
    squeeze_.overlap = std::max(squeeze_.overlap, force.overlap);
    squeeze_.excess = std::max(squeeze_.excess, force.overlap - records_[slot].value[Record::radius]);
  }
}

template <int Dim>
void GrainDynamics<Dim>::Engine::kick(double dt) {
  for (int chunk = 0; chunk < contacts_.chunks(); ++chunk)
    for (auto fetch = contacts_.fetch_begin(chunk); fetch != contacts_.fetch_end(chunk); ++fetch) {
      Load& from = loads_[static_cast<std::size_t>(fetch->load)];
      Load& to = loads_[static_cast<std::size_t>(fetch->slot)];
      for (int k = 0; k < 4 * Load::packs; ++k) to.value[k] += from.value[k];
      from = Load();
    }
  double speeds = 0, accelerations = 0;  // largest, squared
  for (const int slot : awake_) {
    double* const value = records_[static_cast<std::size_t>(slot)].value;
    Load& load = loads_[static_cast<std::size_t>(slot)];
    double speed = 0, acceleration = 0;
    const auto push = [&](int velocity, int rate, double pushed) {
      const double predicted = value[velocity] + dt / 2 * value[rate];
      value[rate] = pushed - world_.drag * predicted;
      value[velocity] += dt / 2 * value[rate];
    };
    for (int d = 0; d < Dim; ++d) {
      push(Record::velocity + d, Record::acceleration + d,
           load.value[d] * value[Record::inverse_mass] + world_.acceleration[d]);
      speed += value[Record::velocity + d] * value[Record::velocity + d];
      acceleration += value[Record::acceleration + d] * value[Record::acceleration + d];
    }
    for (int d = 0; d < Record::turns; ++d)
      push(Record::spin + d, Record::turning + d,
           load.value[Load::torque + d] * value[Record::inverse_inertia]);
    speeds = std::max(speeds, speed);
    accelerations = std::max(accelerations, acceleration);
    load = Load();
  }
  for (const Wall<Dim>& wall : world_.walls) speeds = std::max(speeds, wall.velocity.squaredNorm());
  inputs_.speed = std::sqrt(speeds);
  inputs_.acceleration = std::sqrt(accelerations);
  inputs_.overlap = squeeze_.overlap;
}

template class GrainDynamics<2>::Engine;
template class GrainDynamics<3>::Engine;

}  // namespace aeolian
