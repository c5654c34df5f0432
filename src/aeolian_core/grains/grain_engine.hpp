#pragma once

#include <vector>

#include "aeolian_core/grains/contact_list.hpp"
#include "aeolian_core/grains/grain_dynamics.hpp"
#include "aeolian_core/grains/near_list.hpp"
#include "aeolian_core/grains/pair_forces.hpp"
#include "aeolian_core/grains/time_step.hpp"
#include "aeolian_core/grains/wall_contact.hpp"

namespace aeolian {

/// The machine behind GrainDynamics. Grains lie in slots, sorted by cell so that neighbours share cache
/// lines; slot 0 is no grain.
///
/// Velocity Verlet: between steps the records hold velocities of the instant of the positions, and the
/// accelerations there; within a step the velocities are those of its middle.
template <int Dim>
class GrainDynamics<Dim>::Engine {
 public:
  explicit Engine(const GrainWorld<Dim>& world);

  const GrainWorld<Dim>& world() const { return world_; }
  void set_world(const GrainWorld<Dim>& world);
  void set_threads(int threads) { threads_ = threads; }

  int add(const Vector<Dim>& position, double radius, const Vector<Dim>& velocity, const Spin<Dim>& spin);
  void remove(int grain);
  void set_motion(int grain, const Vector<Dim>& velocity, const Spin<Dim>& spin);

  const std::vector<int>& numbers() const { return numbers_; }
  bool holds(int grain) const;
  /// Throws Error when there is no such grain.
  const GrainRecord<Dim>& record(int grain) const { return records_[slot_of(grain)]; }
  Vector<Dim> position(int grain) const;

  double time() const { return time_; }
  double step(double most);
  void advance(double duration);

  bool ready() const { return ready_; }  ///< lists and accelerations belong to what is there
  void prepare();
  std::vector<GrainContact<Dim>> contacts(int grain) const;  ///< of all: -1; when ready
  double kinetic_energy() const;
  double potential_energy() const;  ///< when ready
  std::size_t awake() const { return awake_.size(); }
  std::size_t grain_steps() const { return grain_steps_; }

 private:
  using Record = GrainRecord<Dim>;
  using Load = GrainLoad<Dim>;

  std::size_t slot_of(int grain) const;
  double radius(int grain) const { return record(grain).value[Record::radius]; }
  void set_mass(Record& record) const;

  void make_step(double dt);
  void move(double dt);
  void find_forces(double dt);
  void kick(double dt);
  double natural_step() const;
  void refuse_squeezed() const;

  void measure();
  void sort();
  void list(const std::vector<int>& slots, std::vector<NearPair<Dim>> pairs, double dt);
  void list_walls(const std::vector<int>& slots);
  void list_moved(double dt);

  GrainWorld<Dim> world_;
  LawConstants law_;
  int threads_ = 1;
  double time_ = 0;
  std::size_t grain_steps_ = 0;
  bool ready_ = false;

  std::vector<Record> records_{1};
  std::vector<int> number_{-1};  // of the grain in each slot, -1: none
  std::vector<int> slot_;        // of each number, -1: removed
  std::vector<int> numbers_;
  std::vector<int> awake_;  // slots, ascending

  NearList<Dim> near_;
  ContactList<Dim> contacts_;
  std::vector<WallContact<Dim>> wall_contacts_;  // by ascending slots and walls
  std::vector<double> wall_way_, wall_skin_;     // how far each has gone since it was listed, and may go [m]
  std::vector<int> unlisted_, removed_;          // slots
  bool sort_again_ = false, list_walls_again_ = true;
  std::size_t listed_since_sort_ = 0;

  std::vector<Load> loads_;
  Squeeze squeeze_;
  StepInputs inputs_;
};

}  // namespace aeolian
