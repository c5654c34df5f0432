#include <algorithm>
#include <string>

#include "aeolian_core/grains/dynamics/grain_engine.hpp"
#include "aeolian_core/grains/dynamics/pair_meeting.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

template <int Dim, class Place>
bool meets(const GrainRecord<Dim>& first, const GrainRecord<Dim>& second, const Place& period,
           PairMeeting<Dim, double>& pair) {
  pair.place(first.value, second.value, period.data());
  if (!(pair.meeting.overlap > 0)) return false;
  pair.move(first.value, second.value, 0);
  return true;
}

/// Of the springs of one contact.
template <int Dim>
double spring_energy(const LawConstants& law, double overlap, double radius, const double* slip) {
  double slips = 0;
  for (int d = 0; d < slip_size<Dim>; ++d) slips += slip[d] * slip[d];
  if (!law.hertz) return 0.5 * (law.stiffness * overlap * overlap + law.shear_stiffness * slips);
  const double contact = std::sqrt(radius * overlap);
  return 0.4 * law.modulus * contact * overlap * overlap + 0.5 * law.shear_modulus * contact * slips;
}

}  // namespace

template <int Dim>
std::vector<GrainContact<Dim>> GrainDynamics<Dim>::Engine::contacts(int grain) const {
  std::vector<GrainContact<Dim>> out;
  const int only = grain < 0 ? -1 : static_cast<int>(slot_of(grain));
  for (NearPair<Dim> pair : only < 0 ? all_pairs() : pairs_of(only)) {
    const auto number = [this](int slot) { return number_[static_cast<std::size_t>(slot)]; };
    // By ascending numbers, whatever the slots.
    if (number(pair.first) > number(pair.second)) {
      std::swap(pair.first, pair.second);
      if (Dim == 3)
        for (double& slip : pair.slip) slip = -slip;
    }
    PairMeeting<Dim, double> meeting;
    if (!meets<Dim>(records_[static_cast<std::size_t>(pair.first)],
                    records_[static_cast<std::size_t>(pair.second)], near_.period(), meeting))
      continue;
    Answer<Dim, double> force;
    law_.hertz ? answer<true>(law_, 0, meeting.meeting, pair.slip, force)
               : answer<false>(law_, 0, meeting.meeting, pair.slip, force);
    out.push_back({number(pair.first), number(pair.second),
                   Eigen::Map<const Vector<Dim>>(meeting.meeting.normal), meeting.meeting.overlap,
                   force.normal, Eigen::Map<const Vector<Dim>>(force.shear).norm()});
  }
  for (WallContact<Dim> contact : wall_contacts_) {
    if (only >= 0 && contact.grain != only) continue;
    const auto slot = static_cast<std::size_t>(contact.grain);
    const WallForce<Dim> force = wall_force(law_, 0, world_.walls[static_cast<std::size_t>(contact.wall)],
                                            records_[slot], contact.slip);
    if (force.touching)
      out.push_back({number_[slot], -1 - contact.wall, force.normal, force.overlap, force.normal_force,
                     force.shear.norm()});
  }
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  });
  return out;
}

template <int Dim>
std::size_t GrainDynamics<Dim>::Engine::awake() const {
  return static_cast<std::size_t>(std::count_if(numbers_.begin(), numbers_.end(),
                                                [this](int grain) { return asleep_[slot_of(grain)] == 0; }));
}

template <int Dim>
std::vector<int> GrainDynamics<Dim>::Engine::moving() const {
  std::vector<int> grains;
  if (!ready_) {
    std::copy_if(numbers_.begin(), numbers_.end(), std::back_inserter(grains),
                 [this](int grain) { return asleep_[slot_of(grain)] == 0; });
    return grains;
  }
  grains.reserve(awake_.size());
  for (const int slot : awake_) grains.push_back(number_[static_cast<std::size_t>(slot)]);
  return grains;
}

template <int Dim>
double GrainDynamics<Dim>::Engine::kinetic_energy() const {
  double energy = 0;
  for (const int grain : numbers_) {
    const Record& record = this->record(grain);
    energy += Eigen::Map<const Vector<Dim>>(record.value + Record::velocity).squaredNorm() /
              record.value[Record::inverse_mass];
    energy += Eigen::Map<const Spin<Dim>>(record.value + Record::spin).squaredNorm() /
              record.value[Record::inverse_inertia];
  }
  return energy / 2;
}

template <int Dim>
double GrainDynamics<Dim>::Engine::potential_energy() const {
  double energy = 0;
  for (const int grain : numbers_)
    energy -= world_.acceleration.dot(position(grain)) / record(grain).value[Record::inverse_mass];
  for (const NearPair<Dim>& pair : all_pairs()) {
    PairMeeting<Dim, double> meeting;
    if (meets<Dim>(records_[static_cast<std::size_t>(pair.first)],
                   records_[static_cast<std::size_t>(pair.second)], near_.period(), meeting))
      energy += spring_energy<Dim>(law_, meeting.meeting.overlap, meeting.meeting.radius, pair.slip);
  }
  for (const WallContact<Dim>& contact : wall_contacts_) {
    const Record& record = records_[static_cast<std::size_t>(contact.grain)];
    const double overlap = record.value[Record::radius] -
                           nearest(world_.walls[static_cast<std::size_t>(contact.wall)],
                                   Vector<Dim>(Eigen::Map<const Vector<Dim>>(record.value + Record::place)))
                               .distance;
    if (overlap > 0) energy += spring_energy<Dim>(law_, overlap, record.value[Record::radius], contact.slip);
  }
  return energy;
}

/// Throws when a step cannot part what is pressed together.
template <int Dim>
void GrainDynamics<Dim>::Engine::refuse_squeezed() const {
  if (!(squeeze_.excess > 0)) return;
  for (const GrainContact<Dim>& contact : contacts(-1)) {
    const double least =
        contact.second < 0 ? radius(contact.first) : std::min(radius(contact.first), radius(contact.second));
    if (!(contact.overlap > least)) continue;
    const std::string other = contact.second < 0 ? "wall " + std::to_string(-1 - contact.second)
                                                 : "grain " + std::to_string(contact.second);
    throw Error("grain dynamics: grain " + std::to_string(contact.first) + " and " + other + " overlap by " +
                std::to_string(contact.overlap / least) + " of the smaller radius, must be at most 1");
  }
}

template class GrainDynamics<2>::Engine;
template class GrainDynamics<3>::Engine;

}  // namespace aeolian
