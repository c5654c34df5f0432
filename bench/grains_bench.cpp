// Grain dynamics: grains moved a second, beside the granular package of LAMMPS on the same bed where that is
// installed (Debian: lammps), with threads, asleep, and against the error of a collision.
//
// Processor time is compared, so that a busy machine does not decide.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "grains_convergence.hpp"
#include <benchmark/benchmark.h>
#include <sys/resource.h>
#include <unistd.h>

#include "aeolian_core/grains/dynamics/grain_dynamics.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

double processor_time_of_children() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

const GrainDynamics<2>& bed_of_3000() {
  static const GrainDynamics<2> bed = settled_bed(75, 40, 0.12);
  return bed;
}

double coordination(const GrainDynamics<2>& grains) {
  double ends = 0;
  for (const auto& contact : grains.contacts()) ends += contact.second < 0 ? 0 : 2;
  return ends / static_cast<double>(grains.size());
}

double mean_height(const GrainDynamics<2>& grains) {
  double sum = 0;
  for (const int grain : grains.numbers()) sum += grains.position(grain).y();
  return sum / static_cast<double>(grains.size());
}

/// Grains moved a second of processor time (of all threads' wall time with more than one).
template <int Dim>
void count_grain_steps(benchmark::State& state, GrainDynamics<Dim>& grains, int steps) {
  const std::size_t before = grains.grain_steps();
  for (auto _ : state)
    for (int k = 0; k < steps; ++k) grains.step();
  const double moved = static_cast<double>(grains.grain_steps() - before);
  state.counters["grain_steps_per_s"] = benchmark::Counter(moved, benchmark::Counter::kIsRate);
}

void dense_bed(benchmark::State& state) {
  GrainDynamics<2> grains = bed_of_3000();
  count_grain_steps(state, grains, 200);
  state.counters["contacts_per_grain"] = coordination(grains) / 2;
}
BENCHMARK(dense_bed)->Unit(benchmark::kMillisecond);

void dense_bed_on_threads(benchmark::State& state) {
  static const GrainDynamics<2> bed = settled_bed(200, 100, 0.01);
  GrainDynamics<2> grains = bed;
  grains.set_threads(static_cast<int>(state.range(0)));
  count_grain_steps(state, grains, 50);
}
BENCHMARK(dense_bed_on_threads)
    ->Arg(1)
    ->Arg(2)
    ->Arg(4)
    ->Arg(8)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void million_grains(benchmark::State& state) {
  GrainDynamics<2> grains = settled_bed(1000, 1000, 0);
  grains.step();
  count_grain_steps(state, grains, 5);
}
BENCHMARK(million_grains)->Unit(benchmark::kMillisecond)->Iterations(4);

void dense_spheres(benchmark::State& state) {
  GrainWorld<3> world;
  world.law = ContactLaw::spring(6e5, 0.7, 0.004, 0.5);
  world.period = {0.24, 0.24, 0};
  world.walls = {{Vector<3>::Zero(), Vector<3>::UnitZ()}};
  world.drag = 100;
  GrainDynamics<3> grains(world);
  RandomStream random(5, 0);
  for (int i = 0; i < 12 * 12 * 15; ++i)
    grains.add({0.02 * (i % 12 + 0.45 + 0.1 * random.uniform()),
                0.02 * (i / 12 % 12 + 0.45 + 0.1 * random.uniform()), 0.02 * (i / 144) + 0.01},
               disc_radius * (1 - 0.05 * random.uniform()));
  grains.advance(0.1);
  count_grain_steps(state, grains, 100);
  state.counters["contacts_per_grain"] =
      static_cast<double>(grains.contacts().size()) / static_cast<double>(grains.size());
}
BENCHMARK(dense_spheres)->Unit(benchmark::kMillisecond);

/// The bed as LAMMPS reads it: the same grains without shear springs, and the same law.
void write_lammps_input(const GrainDynamics<2>& grains, const std::string& folder, double dt, int steps) {
  const double width = bed_width(75);
  std::ofstream data(folder + "/bed.data");
  data.precision(17);
  data << "bed\n\n"
       << grains.size() << " atoms\n1 atom types\n-0.1 " << width + 0.1
       << " xlo xhi\n-0.1 2 ylo yhi\n-0.05 0.05 zlo zhi\n\nAtoms # sphere\n\n";
  for (const int grain : grains.numbers())
    data << grain + 1 << " 1 " << 2 * grains.radius(grain) << " 1 " << grains.position(grain).x() << " "
         << grains.position(grain).y() << " 0\n";
  const ContactLaw& law = grains.world().law;
  std::ofstream input(folder + "/bed.in");
  input.precision(17);
  input << "units si\ndimension 2\nboundary f f p\natom_style sphere\nnewton off\ncomm_modify vel yes\n"
           "read_data bed.data\nset group all density/disc "
        << grains.world().density * grains.world().thickness << "\n";
  const auto constants = [&] {
    input << law.stiffness << " " << law.shear_stiffness << " " << law.damping << " " << law.shear_damping
          << " " << law.friction << " 1";
  };
  input << "pair_style gran/hooke/history ";
  constants();
  input
      << "\npair_coeff * *\nneighbor 0.0016 bin\nneigh_modify delay 0 every 1 check yes\ntimestep " << dt
      << "\nfix move all nve/sphere disc\nfix fall all gravity 9.81 vector 0 -1 0\nfix plane all enforce2d\n"
         "fix floor all wall/gran hooke/history ";
  constants();
  input << " yplane 0 NULL\nfix sides all wall/gran hooke/history ";
  constants();
  input << " xplane 0 " << width
        << "\ncompute touching all contact/atom\ncompute ends all reduce sum c_touching\nvariable y atom y\n"
           "compute height all reduce ave v_y\nthermo_style custom step ke c_ends c_height\n"
           "thermo_modify norm no format float %.12g\nthermo 100000000\nrun "
        << steps << "\n";
}

/// The state that LAMMPS ends with, from its log's last row of numbers before "Loop time".
bool read_lammps_log(const std::string& path, double& energy, double& ends, double& height) {
  std::ifstream log(path);
  bool found = false;
  double step = 0;
  for (std::string line; std::getline(log, line);)
    found |= std::sscanf(line.c_str(), " %lf %lf %lf %lf", &step, &energy, &ends, &height) == 4;
  return found;
}

/// One second of processor time here moves so many times the grains that LAMMPS moves.
void against_lammps(benchmark::State& state) {
  if (std::system("command -v lmp > /dev/null 2>&1") != 0) {
    state.SkipWithError("lmp is not installed (Debian: apt install lammps)");
    return;
  }
  const int steps = 20000;
  const std::string folder =
      (std::filesystem::temp_directory_path() / ("grains_bench_" + std::to_string(getpid()))).string();
  std::filesystem::create_directories(folder);
  GrainDynamics<2> ours(bed_of_3000().world());
  for (const int grain : bed_of_3000().numbers())
    ours.add(bed_of_3000().position(grain), bed_of_3000().radius(grain));
  const GrainDynamics<2> start = ours;
  const double dt = ours.step();
  const std::string command =
      "cd '" + folder + "' && OMP_NUM_THREADS=1 lmp -in bed.in -log bed.log > bed.out 2>&1";
  double theirs[2];
  for (const bool moving : {false, true}) {
    write_lammps_input(start, folder, dt, moving ? steps : 0);
    const double before = processor_time_of_children();
    if (std::system(command.c_str()) != 0) {
      state.SkipWithError(("lmp failed, see " + folder + "/bed.out").c_str());
      return;
    }
    theirs[moving] = processor_time_of_children() - before;
  }
  double energy = 0, ends = 0, height = 0;
  read_lammps_log(folder + "/bed.log", energy, ends, height);
  std::filesystem::remove_all(folder);

  double spent = 0;
  for (auto _ : state) {
    ours = start;
    const double before = processor_time();
    for (int k = 0; k < steps; ++k) ours.step(dt);
    spent += processor_time() - before;
  }
  spent /= static_cast<double>(state.iterations());
  const double grains = static_cast<double>(ours.size());
  state.counters["times_lammps"] = (theirs[1] - theirs[0]) / spent;
  state.counters["lammps_grain_steps_per_s"] = grains * steps / (theirs[1] - theirs[0]);
  state.counters["our_grain_steps_per_s"] = grains * steps / spent;
  state.counters["coordination"] = coordination(ours);
  state.counters["lammps_coordination"] = ends / grains;
  state.counters["height_mm"] = 1000 * mean_height(ours);
  state.counters["lammps_height_mm"] = 1000 * height;
  state.counters["energy_J"] = ours.kinetic_energy();
  state.counters["lammps_energy_J"] = energy;
}
BENCHMARK(against_lammps)->Unit(benchmark::kMillisecond)->Iterations(1);

/// An impact of 10 m/s at 15 degrees on 5000 discs, followed for 0.07 s; the argument is the speed of the
/// rule of sleep in mm/s, zero: none sleeps.
void impact(benchmark::State& state) {
  static const GrainDynamics<2> settled = settled_bed(125, 40, 0.12);
  GrainDynamics<2> bed = settled;
  GrainWorld<2> world = bed.world();
  if (state.range(0) > 0) world.sleep = {1e-3 * static_cast<double>(state.range(0)), 3e-4};
  bed.set_world(world);
  bed.advance(2e-3);
  double top = 0;
  for (const int grain : bed.numbers()) top = std::max(top, bed.position(grain).y());
  Vector<2> rebound = Vector<2>::Zero();
  double steps = 0;
  for (auto _ : state) {
    GrainDynamics<2> grains = bed;
    const std::size_t before = grains.grain_steps();
    const double angle = 15 * M_PI / 180;
    const int grain = grains.add({bed_width(125) / 2, top + 2.5 * disc_radius}, disc_radius,
                                 10 * Vector<2>(std::cos(angle), -std::sin(angle)));
    grains.advance(0.07);
    rebound = grains.velocity(grain);
    steps = static_cast<double>(grains.grain_steps() - before);
  }
  state.counters["million_grain_steps"] = steps * 1e-6;
  state.counters["rebound_x"] = rebound.x();
  state.counters["rebound_y"] = rebound.y();
}
BENCHMARK(impact)->Arg(0)->Arg(30)->Arg(100)->Arg(300)->Unit(benchmark::kMillisecond)->Iterations(1);

/// Over the steps in a contact.
void restitution_of_step(benchmark::State& state) {
  StepError error;
  for (auto _ : state) error = error_of_step(static_cast<double>(state.range(0)));
  state.counters["error"] = error.root_mean_square;
  state.counters["median_error"] = error.median;
}
BENCHMARK(restitution_of_step)
    ->Arg(9)
    ->Arg(18)
    ->Arg(36)
    ->Arg(72)
    ->Arg(144)
    ->Arg(288)
    ->Arg(1152)
    ->Unit(benchmark::kMillisecond);

/// Over 1e5 contacts without losses, over the steps in a contact.
void energy_of_step(benchmark::State& state) {
  double drift = 0;
  for (auto _ : state) drift = energy_drift(static_cast<double>(state.range(0)));
  state.counters["drift"] = drift;
}
BENCHMARK(energy_of_step)
    ->Arg(18)
    ->Arg(36)
    ->Arg(72)
    ->Arg(110)
    ->Arg(150)
    ->Arg(300)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

/// Over the stiffness [N/m].
void rebound(benchmark::State& state) {
  Rebound mean;
  for (auto _ : state) mean = rebound_of_stiffness(static_cast<double>(state.range(0)), 40);
  state.counters["restitution_x"] = mean.along;
  state.counters["error_of_mean_x"] = mean.along_error;
  state.counters["restitution_y"] = mean.up;
  state.counters["error_of_mean_y"] = mean.up_error;
}
BENCHMARK(rebound)
    ->Arg(60000)
    ->Arg(600000)
    ->Arg(6000000)
    ->Arg(60000000)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

}  // namespace
}  // namespace aeolian
