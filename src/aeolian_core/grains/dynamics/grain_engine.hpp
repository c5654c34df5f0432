#pragma once

#include <vector>

#include "aeolian_core/grains/dynamics/contact_list.hpp"
#include "aeolian_core/grains/dynamics/crew.hpp"
#include "aeolian_core/grains/dynamics/grain_dynamics.hpp"
#include "aeolian_core/grains/dynamics/near_list.hpp"
#include "aeolian_core/grains/dynamics/pair_forces.hpp"
#include "aeolian_core/grains/dynamics/resting_pairs.hpp"
#include "aeolian_core/grains/dynamics/time_step.hpp"
#include "aeolian_core/grains/dynamics/wall_contact.hpp"

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
  void set_threads(int threads);

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
  std::size_t awake() const;
  std::vector<int> moving() const;
  std::size_t grain_steps() const { return grain_steps_; }

 private:
  using Record = GrainRecord<Dim>;
  using Load = GrainLoad<Dim>;

  /// What a grain that sleeps remembers.
  struct Sleeper {
    Load expected;  ///< from neighbours that are awake, when it fell asleep
    Load owed;      ///< the impulses since then beyond that, which it has not answered yet
  };

  std::size_t slot_of(int grain) const;
  double radius(int grain) const { return record(grain).value[Record::radius]; }
  void set_mass(Record& record) const;

  void make_step(double dt);
  bool move(double dt);
  void find_forces(double dt);
  void add_wall_forces(int begin, int end, double dt, Squeeze& squeeze);
  void kick(double dt);
  double natural_step() const;
  void refuse_squeezed() const;

  bool sleeps(int slot) const { return asleep_[static_cast<std::size_t>(slot)] != 0; }
  void watch(int chunk, double dt, std::vector<int>& restless);
  void wake(const std::vector<int>& slots);
  void wake_all();
  void change_expected(const NearPair<Dim>& pair, double times);
  void lull();
  void find_awake();
  void divide_work();

  void measure();
  void drop_removed();
  void sort();
  void list(const std::vector<int>& slots, std::vector<NearPair<Dim>> pairs, double dt);
  void list_walls(const std::vector<int>& slots);
  void list_moved(double dt, bool moved);
  std::vector<NearPair<Dim>> all_pairs() const;
  std::vector<NearPair<Dim>> pairs_of(int slot) const;

  GrainWorld<Dim> world_;
  LawConstants law_;
  Crew crew_;
  double time_ = 0;
  std::size_t grain_steps_ = 0;
  bool ready_ = false;

  std::vector<Record> records_{1};
  std::vector<int> number_{-1};  // of the grain in each slot, -1: none
  std::vector<int> slot_;        // of each number, -1: removed
  std::vector<int> numbers_;
  std::vector<char> asleep_{0};       // by slot, apart from what sleepers remember: it is asked of every pair
  std::vector<Sleeper> sleepers_{1};  // by slot
  std::vector<double> rest_{0};       // how long each slot has been slow [s]
  int steps_since_lull_ = 0;

  NearList<Dim> near_;
  ContactList<Dim> contacts_;
  RestingPairs<Dim> resting_;
  std::vector<WallContact<Dim>> wall_contacts_;  // by ascending slots and walls
  std::vector<double> wall_way_, wall_skin_;     // how far each has gone since it was listed, and may go [m]
  std::vector<int> unlisted_, removed_;          // slots
  bool sort_again_ = false, list_walls_again_ = true;
  std::size_t listed_since_sort_ = 0;

  // Slots that are awake, and that sleep beside one that is, ascending; and where chunks of them begin.
  std::vector<int> awake_, border_, awake_begin_{0}, border_begin_{0}, wall_begin_{0};
  std::vector<Load> loads_;  // zero between steps
  Squeeze squeeze_;
  StepInputs inputs_;
};

}  // namespace aeolian
