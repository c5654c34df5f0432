// saltation: grains and wind in balance over a flat bed, with all profiles.

#include <algorithm>
#include <map>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "aeolian_core/saltation/flux_response.hpp"
#include "aeolian_core/saltation/saltation_table.hpp"
#include "aeolian_core/saltation/transient_saltation.hpp"
#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_core/wind/log_law.hpp"
#include "aeolian_core/wind/wind_record.hpp"
#include "aeolian_twin/saltation/mixture_files.hpp"
#include "aeolian_twin/saltation/saltation_plots.hpp"
#include "aeolian_twin/saltation/site.hpp"
#include "aeolian_twin/saltation/splash_choice.hpp"
#include "aeolian_twin/tools/program.hpp"

namespace aeolian {
namespace {

constexpr const char* description =
    R"(Saltation in balance with the wind over a flat bed: the flux of sand, the wind that it slows and all profiles.

Writes into the folder --out: summary.yaml, profiles.csv (by height), wind.csv, launches.csv (each class of grains that
leave, with its landing) and the pictures winds.svg, heights.svg and launches.svg, in which some weaker winds stand beside
the one that was asked for.

Splash functions: kok_renno (Kok & Renno 2009, for sand), werner (eq. 4.34 of Werner 1987, cases 1 to 6 by --case),
ungar_haff (one speed of launch), coarse_sand (Werner's experiment), table:FILE (a splash table).

With --gusts a recorded wind (columns t_s, speed_m_s, direction_deg or from_deg) drives the flux: gusts.csv and gusts.svg.
With --mixture (columns diameter_mm and share of the bed) grains of several sizes saltate in one wind, by kok_renno:
mixture.csv (each size) and mixture.yaml (all together). All else is that of the mean diameter alone, for comparison.
With --slope-deg, --cohesion or --fetch-m the flux at such a place: site.yaml. With --hard-ground-flux the grains that come
from upwind over ground that gives none (a road, ice, a crust): hard_ground.yaml.

With --write-table states over diameters of 0.1 to 1 mm and winds up to five times the threshold are kept in a file.)";

struct Options {
  double friction_velocity = 0;
  double diameter_mm = 0.25;
  double density = 2650;
  std::string splash = "kok_renno";
  int thesis_case = 2;
  Atmosphere atmosphere;
  DragLaw drag_law = DragLaw::sand;
  double drag_scale = 1;
  std::string mixture;
  std::string gusts;
  double anemometer_height = 1;
  bool in_time = false;
  std::optional<double> slope_deg;
  SiteConditions site;
  std::optional<double> hard_ground_flux;
  std::string table;
  std::string out;
};

SaltatingBed bed_of(const Options& o) {
  SaltatingBed bed;
  bed.grain.diameter = o.diameter_mm * 1e-3;
  bed.grain.density = o.density;
  bed.atmosphere = o.atmosphere;
  bed.drag_law = o.drag_law;
  bed.drag_scale = o.drag_scale;
  check(bed);
  return bed;
}

/// Weaker winds from near the threshold on, for comparison, and the one that was asked for.
std::vector<double> winds_of(double asked, const std::optional<double>& threshold) {
  std::vector<double> winds;
  if (threshold && asked > 1.2 * *threshold)
    for (const double part : {0.1, 0.4, 0.7}) winds.push_back(*threshold + part * (asked - *threshold));
  winds.push_back(asked);
  return winds;
}

SaltationRun solve(const Options& o, const SaltationSolver& solver) {
  SaltationRun run;
  run.bed = solver.bed();
  run.splash = o.splash == "werner" ? fmt::format("werner, case {}", o.thesis_case) : o.splash;
  run.impact_threshold = solver.impact_threshold(&run.no_threshold);
  std::vector<double> friction_velocity, flux;
  for (const double u : winds_of(o.friction_velocity, run.impact_threshold)) {
    const SteadyState* begin = run.winds.empty() ? nullptr : &run.winds.back().state;
    SteadyState state = solver.solve(u, begin);
    if (state.steady()) {
      friction_velocity.push_back(u);
      flux.push_back(state.mass_flux());
    }
    SaltationProfiles layers = profiles(state, run.bed);
    run.winds.push_back({std::move(state), std::move(layers)});
  }
  if (run.impact_threshold && flux.size() >= 3)
    run.law = FluxLaw::fit(*run.impact_threshold, friction_velocity, flux);
  return run;
}

GustRun blow(const Options& o, const SaltationRun& run, const SplashKernel& splash) {
  if (!run.law)
    throw Error(fmt::format(
        "--gusts: needs a flux law, but at --friction-velocity {:g} grains do not saltate well "
        "above the threshold{}",
        o.friction_velocity, run.impact_threshold ? fmt::format(", {:.3g} m/s", *run.impact_threshold) : ""));
  const WindRecord record = read_wind_record(o.gusts);
  if (record.time.size() < 2)
    throw Error(o.gusts + ": there are " + std::to_string(record.time.size()) +
                " samples, must be two or more");
  GustRun g;
  g.time = record.time;
  FluxResponse relaxed(*run.law, std::max(run.bed.fluid_threshold(), run.law->threshold));
  std::optional<TransientSaltation> in_time;
  if (o.in_time) in_time.emplace(run.bed, splash);
  for (std::size_t i = 0; i < record.time.size(); ++i) {
    const double u = friction_velocity(record.speed[i], o.anemometer_height, run.bed.roughness_length());
    const double duration = i > 0 ? record.time[i] - record.time[i - 1] : 0;
    g.friction_velocity.push_back(u);
    g.steady.push_back(run.law->flux(u));
    g.relaxed.push_back(relaxed.advance(duration, u));
    if (in_time) {
      in_time->advance(duration, u);
      g.in_time.push_back(in_time->mass_flux());
    }
  }
  return g;
}

MixtureRun mix(const SaltatingBed& bed, const GrainMixture& mixture, double friction_velocity) {
  const MixtureSolver solver(bed, mixture);
  MixtureRun run{mixture, solver.solve(friction_velocity), {}, {}};
  run.impact_threshold = solver.impact_threshold(&run.no_threshold);
  return run;
}

void tell(const MixtureRun& run) {
  const MixtureState& all = run.state;
  if (all.steady())
    fmt::print("mixture of {} sizes: flux {:.4g} kg/(m s), u* at the bed {:.3g} m/s; threshold {:.3g} m/s\n",
               all.sizes.size(), all.mass_flux(), all.sizes.front().surface_friction_velocity,
               run.impact_threshold.value_or(0));
  else
    fmt::print("mixture of {} sizes: no saltation: {}\n", all.sizes.size(), all.sizes.front().reason);
}

void tell(const SiteRun& run) {
  fmt::print("at the site: flux {:.4g} kg/(m s); threshold {:.3g} m/s, {:.3g} m/s to start\n", run.flux,
             run.impact_threshold, run.fluid_threshold);
}

void tell_hard_ground(const SteadyState& s) {
  if (s.steady())
    fmt::print("over hard ground: hops {:.3g} m high and {:.3g} m long, u* at the ground {:.3g} m/s\n",
               s.mean(s.landings.apex), s.mean(s.landings.length), s.surface_friction_velocity);
  else
    fmt::print("over hard ground: not steady: {}\n", s.reason);
}

void tell(const SaltationRun& run) {
  const SteadyState& s = run.asked().state;
  if (s.steady())
    fmt::print(
        "u* {:.3g} m/s: flux {:.4g} kg/(m s), {:.3g} impacts/(m^2 s), u* at the bed {:.3g} m/s; threshold "
        "{:.3g} "
        "m/s\n",
        s.friction_velocity, s.mass_flux(), s.impact_rate(), s.surface_friction_velocity,
        run.impact_threshold.value_or(0));
  else
    fmt::print("u* {:.3g} m/s: no saltation: {}\n", s.friction_velocity, s.reason);
}

int run(int argc, char** argv) {
  CLI::App app(description);
  Options o;
  app.add_option("--friction-velocity", o.friction_velocity, "u* of the free wind [m/s]")->required();
  CLI::Option* diameter = app.add_option("--grain-diameter-mm", o.diameter_mm, "[mm]")
                              ->check(CLI::Range(0.01, 10.0))
                              ->capture_default_str();
  app.add_option("--grain-density", o.density, "[kg/m^3]")
      ->check(CLI::Range(50.0, 20000.0))
      ->capture_default_str();
  app.add_option("--splash", o.splash, "werner, ungar_haff, kok_renno, coarse_sand or table:FILE")
      ->capture_default_str();
  app.add_option("--case", o.thesis_case, "of Werner's table 4.3, with --splash werner")
      ->check(CLI::Range(1, 6))
      ->capture_default_str();
  app.add_option("--air-density", o.atmosphere.density, "[kg/m^3]")
      ->check(CLI::Range(1e-3, 200.0))
      ->capture_default_str();
  app.add_option("--air-viscosity", o.atmosphere.viscosity, "kinematic [m^2/s]")
      ->check(CLI::Range(1e-8, 0.1))
      ->capture_default_str();
  app.add_option("--gravity", o.atmosphere.gravity, "[m/s^2]")
      ->check(CLI::Range(0.1, 100.0))
      ->capture_default_str();
  app.add_option("--drag", o.drag_law, "sand (Cheng 1997) or sphere (as the thesis)")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, DragLaw>{{"sand", DragLaw::sand}, {"sphere", DragLaw::sphere}}));
  app.add_option("--drag-scale", o.drag_scale, "multiplies the drag; 0.62 agrees with the thesis' figures")
      ->check(CLI::Range(0.01, 10.0))
      ->capture_default_str();
  app.add_option("--mixture", o.mixture, "CSV of the sizes in the bed, instead of one diameter")
      ->excludes(diameter);
  CLI::Option* gusts = app.add_option("--gusts", o.gusts, "CSV of a recorded wind");
  app.add_option("--anemometer-height", o.anemometer_height, "of the wind in --gusts [m]")
      ->capture_default_str()
      ->needs(gusts);
  app.add_flag("--in-time", o.in_time, "solve the gusts in time, too (a quarter of a second for one of wind)")
      ->needs(gusts);
  app.add_option("--slope-deg", o.slope_deg, "of the bed along the wind, positive where it rises downwind");
  app.add_option("--cohesion", o.site.cohesion, "of grains [N/m]: 1.5e-4 for dry sand, more where it is damp")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--fetch-m", o.site.fetch, "of sand upwind [m]")->check(CLI::Range(0.0, 1e6));
  app.add_option("--hard-ground-flux", o.hard_ground_flux, "[kg/(m s)] that comes from upwind")
      ->check(CLI::Range(1e-9, 1e3));
  app.add_option("--write-table", o.table, "CSV to keep states in");
  app.add_option("--out", o.out, "folder for the results")->required();
  if (const auto code = parse(app, argc, argv)) return *code;

  std::optional<GrainMixture> mixture;
  if (!o.mixture.empty()) {
    if (o.splash != "kok_renno")
      throw Error("--mixture: --splash is '" + o.splash +
                  "', must be kok_renno: no other knows several sizes");
    mixture = read_mixture(o.mixture);
    o.diameter_mm = 1e3 * mixture->mean_diameter();
  }
  const SaltatingBed bed = bed_of(o);
  const std::unique_ptr<SplashKernel> splash = splash_choice(o.splash, bed, o.thesis_case);
  if (!(o.friction_velocity >= 0 && o.friction_velocity <= 10))
    throw Error(fmt::format("--friction-velocity: {:g} m/s, must be 0 to 10", o.friction_velocity));
  const SaltationSolver solver(bed, *splash);
  const SaltationRun found = solve(o, solver);
  std::optional<GustRun> gust_run;
  if (!o.gusts.empty()) gust_run = blow(o, found, *splash);

  std::optional<SiteRun> site;
  if (o.slope_deg || o.site.cohesion || o.site.fetch) {
    o.site.slope = degrees_to_radians(o.slope_deg.value_or(0));
    site = at_site(found, o.site);
  }
  std::optional<SolvedWind> hard_ground;
  if (o.hard_ground_flux) hard_ground = over_hard_ground(bed, o.friction_velocity, *o.hard_ground_flux);

  std::optional<MixtureRun> mixed;
  if (mixture) mixed = mix(bed, *mixture, o.friction_velocity);

  make_directory(o.out);
  write_saltation_tables(found, o.out);
  plot_saltation(found, o.out);
  if (gust_run) {
    write_gusts(*gust_run, o.out);
    plot_gusts(*gust_run, o.out);
  }
  if (mixed) write_mixture(*mixed, o.out);
  if (site) write_site(*site, o.out);
  if (hard_ground) write_state(*hard_ground, o.out + "/hard_ground.yaml");
  write_saltation_summary(found, gust_run, o.out);
  if (!o.table.empty())
    SaltationTable::build(
        bed, [&](const SaltatingBed& one) { return splash_choice(o.splash, one, o.thesis_case); },
        SaltationTable::usual_diameters(), SaltationTable::usual_ratios())
        .write(o.table, typed_command("saltation", argc, argv));
  tell(found);
  if (mixed) tell(*mixed);
  if (site) tell(*site);
  if (hard_ground) tell_hard_ground(hard_ground->state);
  return 0;
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::run_program("saltation", [&] { return aeolian::run(argc, argv); });
}
