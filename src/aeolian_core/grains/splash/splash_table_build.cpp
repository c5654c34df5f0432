#include <cmath>
#include <string>

#include "aeolian_core/grains/splash/bed_view.hpp"
#include "aeolian_core/grains/splash/splash_table.hpp"
#include "aeolian_core/grains/splash/splash_table_nodes.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// Four decimals, towards zero: a rounded velocity has never more energy. What is just short of a decimal by
/// the rounding of its computing is that decimal.
double cut(double value) { return std::trunc(value * 1e4 + std::copysign(1e-6, value)) / 1e4; }
float short_cut(double value) { return static_cast<float>(cut(value)); }

}  // namespace

SplashTable SplashTable::build(const std::vector<SplashCase>& cases, double diameter,
                               const SplashTableSource& source, std::uint64_t seed) {
  if (!(diameter > 0) || !std::isfinite(diameter))
    throw Error("splash table: diameter is " + std::to_string(diameter) + " m, must be positive and finite");
  if (!(source.ejecta_kept > 0 && source.ejecta_kept <= 1))
    throw Error("splash table: share of ejecta kept is " + std::to_string(source.ejecta_kept) +
                ", must be above 0, to 1");
  for (const std::string* text : {&source.command, &source.material})
    if (text->find_first_of("\r\n") != std::string::npos)
      throw Error("splash table: '" + *text + "' in its head, must be one line");
  const double unit = std::sqrt(gravity * diameter);
  RandomStream random(seed, 0);
  std::vector<Gathered> nodes;
  for (const SplashCase& one : cases) {
    check(one.impact);
    const BedView bed(one.impact);
    Gathered& node = nodes.emplace_back();
    node.place = {one.impact.speed / unit, bed.angle(), one.impact.size_ratio, one.impact.roughness};
    for (const SplashEvent& event : one.events) {
      StoredEvent stored{true, 0, 0, 0, node.ejecta.size()};
      if (event.rebound) {
        const Eigen::Vector3d velocity = bed.on_bed(event.rebound->velocity) / one.impact.speed;
        if (!(velocity.squaredNorm() <= 1))
          throw Error("splash table: a grain that hits at " + std::to_string(one.impact.speed) +
                      " m/s rebounds at " + std::to_string(event.rebound->velocity.norm()) +
                      " m/s, must not be faster");
        stored = {false, cut(velocity.x()), cut(velocity.y()), cut(velocity.z()), stored.first};
      }
      for (const LeavingGrain& grain : event.ejecta) {
        if (source.ejecta_kept < 1 && random.uniform() >= source.ejecta_kept) continue;
        const Eigen::Vector3d velocity = bed.on_bed(grain.velocity) / unit;
        node.ejecta.push_back({short_cut(velocity.x()), short_cut(velocity.y()), short_cut(velocity.z()),
                               static_cast<float>(grain.size_ratio),
                               short_cut(bed.along(grain.distance) / diameter), grain.origin});
      }
      node.events.push_back(stored);
    }
  }
  return of(nodes, source, "splash table");
}

}  // namespace aeolian
