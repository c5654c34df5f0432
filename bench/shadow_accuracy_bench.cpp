// The accuracy of shadow profiles as a Markdown page: docs/accuracy/shadow.md is what this prints.
//
//     ./twin bench shadow_accuracy

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <string>
#include <thread>

#include "rendering/shadow_score.hpp"
#include <fmt/format.h>

#include "aeolian_core/surface/degree.hpp"

namespace aeolian {
namespace {

using Members = std::vector<const EnsembleMember*>;
using Grouping = std::function<std::string(const EnsembleMember&)>;

std::string light_of(const EnsembleMember& m) {
  switch (m.set_up.setup.light.index()) {
    case 1:
      return "light: angles";
    case 2:
      return "light: post";
    default:
      return "light: sun";
  }
}

std::string row(const std::string& name, const Members& members) {
  std::vector<double> rmse, share, wavelength, milliseconds;
  double covered = 0, stations = 0, bias = 0, heights = 0;
  for (const EnsembleMember* m : members) {
    rmse.push_back(1e3 * m->score.rmse);
    share.push_back(m->score.rmse / m->score.bar);
    if (!std::isnan(m->wavelength.error)) wavelength.push_back(100 * std::abs(m->wavelength.error));
    milliseconds.push_back(1e3 * m->seconds);
    covered += static_cast<double>(m->score.covered);
    stations += static_cast<double>(m->score.stations);
    if (m->score.bias) bias += 1e3 * *m->score.bias, ++heights;
  }
  return fmt::format(
      "| {} | {} | {:.3f} | {:.3f} | {:.2f} | {:.2f} | {} | {:.2f} | {:.2f} | {:.1f} | {:.0f} |\n", name,
      members.size(), quantile(rmse, 0.5), quantile(rmse, 0.95), quantile(share, 0.95), quantile(share, 1),
      heights > 0 ? fmt::format("{:+.3f}", bias / heights) : "-", quantile(wavelength, 0.5),
      quantile(wavelength, 0.95), 100 * covered / stations, quantile(milliseconds, 0.5));
}

void table(const std::vector<EnsembleMember>& all, const std::vector<Grouping>& groupings) {
  fmt::print(
      "| set-ups | n | RMSE median [mm] | 95 % | RMSE over bar 95 % | worst | mean bias [mm] | wavelength "
      "error "
      "median [%] | 95 % | covered by the 95 % intervals [%] | time [ms] |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Grouping& grouping : groupings) {
    std::map<std::string, Members> groups;
    for (const EnsembleMember& m : all)
      if (m.refusal.empty()) groups[grouping(m)].push_back(&m);
    for (const auto& [name, members] : groups) fmt::print("{}", row(name, members));
  }
}

std::string binned(const std::string& what, double value, const std::vector<double>& borders,
                   const char* unit) {
  const auto above = std::upper_bound(borders.begin(), borders.end(), value);
  const std::size_t i = static_cast<std::size_t>(above - borders.begin());
  return fmt::format("{} {:g} to {:g} {}", what, borders[i - 1], borders[i], unit);
}

void write_page() {
  fmt::print(
      "# Accuracy of profiles from shadow photographs\n\n"
      "Printed by `./twin bench shadow_accuracy`: 200 random set-ups (seeds 1 to 200) drawn by the ray "
      "caster of "
      "`test/rendering`, measured in full mode and held against the drawn bed. Bar: RMSE about the mean not "
      "over a "
      "quarter grain or 0.1 mm, whichever is larger. Bias: where the setup gives the height. Given angles of "
      "light are "
      "wrong by 0.1 degrees (standard deviation), a drawn north by 0.5 degrees, a post's pixels by 0.3 px, "
      "marks by "
      "0.1 px. Set-ups with a post stand on beds that are level along the crests to 0.3 degrees, with crests "
      "square "
      "to the edge to 2 degrees; the others to 3 and 10 degrees. Time: one core, from pixels to "
      "profile.\n\n");
  const unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  const auto ensemble = measure_ensemble(1, 200, 1.1, threads);
  const auto refused =
      std::count_if(ensemble.begin(), ensemble.end(), [](const auto& m) { return !m.refusal.empty(); });
  fmt::print("Refused: {} of {}.\n\n", refused, ensemble.size());
  table(ensemble,
        {[](const EnsembleMember&) { return std::string("all"); }, light_of,
         [](const EnsembleMember& m) {
           return std::string(m.set_up.setup.markers ? "markers" : "two rows of marks");
         },
         [](const EnsembleMember& m) {
           return std::string(m.set_up.setup.camera ? "calibrated camera" : "uncalibrated camera");
         },
         [](const EnsembleMember& m) {
           return binned("grain", 1e3 * m.set_up.scene.grain_diameter, {0.1, 0.2, 0.4, 0.7, 1.1}, "mm");
         },
         [](const EnsembleMember& m) {
           return binned("scale", m.profile.scale.value / 1e3, {2, 5, 8, 12, 40}, "px/mm");
         },
         [](const EnsembleMember& m) {
           return binned("light at", m.set_up.scene.elevation / degree, {10, 25, 35, 45, 60}, "degrees");
         }});
  fmt::print(
      "\n## Error against run time\n\nThe same twelve set-ups (seeds 301 to 312) drawn with more and more "
      "pixels.\n\n");
  for (const double megapixels : {0.5, 1.0, 3.0, 12.0}) {
    fmt::print("{:g} megapixels\n\n", megapixels);
    table(measure_ensemble(301, 12, megapixels, threads),
          {[](const EnsembleMember&) { return std::string("all"); }});
    fmt::print("\n");
  }
}

}  // namespace
}  // namespace aeolian

int main() { aeolian::write_page(); }
