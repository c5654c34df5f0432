// splash_study: what one grain does to a bed of grains, a thousand times.

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/splash/impact_picture.hpp"
#include "aeolian_twin/splash/study_files.hpp"
#include "aeolian_twin/splash/study_plots.hpp"
#include "aeolian_twin/splash/study_table.hpp"
#include "aeolian_twin/tools/program.hpp"
#include "aeolian_twin/tools/progress_bar.hpp"

namespace aeolian {
namespace {

constexpr int stopped_code = 130;  // as a shell has it for a program that Ctrl-C has ended

std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal's handler sets it");

std::string in_words(const StudySettings& study, const StudyPoint& point) {
  std::string text =
      fmt::format("{}: {:.3g} m/s, {:.3g}° below the horizontal, on {} of {:.3g} mm", study.name, point.speed,
                  point.angle / degree, study.dimensions == 2 ? "discs" : "spheres", 1e3 * study.diameter);
  if (point.size_ratio != 1) text += fmt::format(", {:.3g} times their size", point.size_ratio);
  return text;
}

void print_point(const StudyPoint& point) {
  const ImpactStatistics& s = point.statistics;
  fmt::print(
      "{:.3g} m/s, {:.3g}°, size {:.3g}, roughness {:.3g}: {} impacts, rebound {:.3f} of the speed ({:.3f} "
      "along, {:.3f} "
      "up), {:.2f} ± {:.2f} ejecta at {:.3g} m/s\n",
      point.speed, point.angle / degree, point.size_ratio, point.roughness, s.impacts, s.speed.mean,
      s.along.mean, s.up.mean, s.number.mean, s.number.error, s.ejecta_speed.mean);
}

template <int Dim>
void write_pictures(const StudySettings& study, const StudyBeds<Dim>& beds,
                    const std::vector<StudyPoint>& points, const std::string& out) {
  const StudyPoint& first = points.front();
  if (points.size() == 1)
    plot_histograms(first, study.diameter, in_words(study, first), out + "/histograms.svg");
  else
    plot_trends(points, study.diameter, study.name, out + "/trends.svg");
  if (stop) return;
  // The fastest of those at the first angle.
  const StudyPoint& shown = points[std::min(study.speeds.size(), points.size()) - 1];
  const auto& of_kind = beds.kinds[shown.kind];
  for (const ImpactOutcome& outcome : shown.outcomes) {
    if (outcome.number != study.filmed || !outcome.contact) continue;
    const Bed<Dim>& bed = of_kind[static_cast<std::size_t>(outcome.number) % of_kind.size()];
    write_impact_pictures<Dim>(bed, outcome.shot, study.rules, in_words(study, shown), out);
  }
}

template <int Dim>
int run_study(const StudySettings& study, StudyJournal journal, const std::string& command,
              const std::string& out) {
  const std::size_t all = study.beds.size() * study.speeds.size() * study.angles.size() *
                          study.size_ratios.size() * static_cast<std::size_t>(study.impacts);
  if (journal.count() > 0) fmt::print("goes on after {} of {} impacts\n", journal.count(), all);
  StudyBeds<Dim> beds;
  std::vector<StudyPoint> points;
  {
    ProgressBar bar;
    const auto progress = [&](double share, const std::string& task) { bar.at(share, task); };
    beds = lay_beds<Dim>(study, progress, stop);
    points = fire_all<Dim>(study, beds, journal, progress, stop);
  }
  std::size_t done = 0;
  for (const StudyPoint& point : points) done += point.outcomes.size();
  if (done == 0) {
    fmt::print(stderr, "splash_study: stopped before the first impact was over, nothing is written\n");
    return stopped_code;
  }
  write_beds_csv(beds, out + "/beds.csv");
  write_events_csv(points, out + "/events.csv");
  write_ejecta_csv(points, out + "/ejecta.csv");
  write_summary_csv(study, points, out + "/summary.csv");
  for (const StudyPoint& point : points) print_point(point);
  if (done == all) study_table(study, points, command).write(out + "/splash_table.csv");
  write_pictures(study, beds, points, out);
  if (done < all || stop) {
    fmt::print(
        stderr,
        "splash_study: stopped; {} of {} impacts are done and written to {}; the same command goes on\n",
        done, all, out);
    return stopped_code;
  }
  journal.finish();
  fmt::print("{} impacts -> {}\n", done, out);
  return 0;
}

/// All that decides the impacts, in words.
std::string settings_of(const std::string& config, const StudySettings& study) {
  return fmt::format("{}\nspeeds: [{}]\nangles: [{}]\nnumber: {}\nseed: {}\n",
                     config.empty() ? study.name : YAML::Dump(YAML::LoadFile(config)),
                     fmt::join(study.speeds, ", "), fmt::join(study.angles, ", "), study.impacts, study.seed);
}

constexpr const char* description =
    R"(Fires grains at beds of grains and tells what leaves: rebound, ejecta, momentum (Werner 1987, ch. II and III).

    splash_study [--config config/splash/werner_case_a.yaml] [--speed M_S] [--angle DEG] [--impacts N] [--seed S] --out DIR

Written to DIR: summary.csv (means, half-widths, standard errors, beside the thesis' numbers), events.csv (a row an
impact), ejecta.csv (a row a grain), beds.csv, splash_table.csv (for the saltation model), histograms.svg (or trends.svg
for a grid of speeds and angles), and one impact to look at: impact.webp moves, impact.png has its frames. Without --config it is the thesis' CASE A.
Ctrl-C keeps what is done, and the same command goes on from there, whatever has ended it; --fresh begins anew. docs/splash_study.md explains configs and results.)";

int run(int argc, char** argv) {
  CLI::App app(description);
  std::string config;
  std::string out;
  double speed = 0;
  double angle = 0;
  int impacts = 0;
  std::uint64_t seed = 1;
  bool fresh = false;
  app.add_option("--config", config, "YAML file of the study, see config/splash");
  const auto* speed_option = app.add_option("--speed", speed, "of impact [m/s], instead of the config's")
                                 ->check(CLI::Range(1e-3, 1000.));
  const auto* angle_option =
      app.add_option("--angle", angle, "of impact below the horizontal [degrees], instead of the config's")
          ->check(CLI::Range(1., 90.));
  const auto* impacts_option = app.add_option("--impacts", impacts, "of each kind, instead of the config's")
                                   ->check(CLI::Range(1, 1000000));
  app.add_option("--seed", seed, "decides everything random, default 1");
  app.add_flag("--fresh", fresh, "begin anew where --out holds an unfinished study");
  app.add_option("--out", out, "folder for the results, created when it does not exist")->required();
  if (const auto code = parse(app, argc, argv)) return *code;

  StudySettings study = config.empty() ? StudySettings{} : read_study(config);
  if (speed_option->count() > 0) study.speeds = {speed};
  if (angle_option->count() > 0) study.angles = {angle * degree};
  if (speed_option->count() + angle_option->count() > 0) study.thesis_case.clear();
  if (impacts_option->count() > 0) study.impacts = impacts;
  study.filmed = std::min(study.filmed, study.impacts - 1);
  study.seed = seed;
  const std::string command = typed_command("splash_study", argc, argv);
  std::signal(SIGINT, [](int) { stop = true; });
  std::signal(SIGTERM, [](int) { stop = true; });
  make_directory(out);
  StudyJournal journal(out, settings_of(config, study), fresh);
  return study.dimensions == 2 ? run_study<2>(study, std::move(journal), command, out)
                               : run_study<3>(study, std::move(journal), command, out);
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::run_program("splash_study", [&] { return aeolian::run(argc, argv); });
}
