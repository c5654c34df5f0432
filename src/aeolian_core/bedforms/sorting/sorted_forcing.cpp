#include "aeolian_core/bedforms/sorting/sorted_forcing.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

void require_order(double fine, double coarse) {
  if (coarse >= fine && std::isfinite(coarse)) return;
  std::ostringstream text;
  text << "sorted forcing: the coarse diameter is " << 1e3 * coarse
       << " mm, must be finite and not below the fine one, " << 1e3 * fine << " mm";
  throw Error(text.str());
}

}  // namespace

void check(const SortedForcing& forcing, double duration) {
  check(forcing.fine, duration);
  check(forcing.coarse, duration);
  require_order(forcing.fine.grain.diameter, forcing.coarse.grain.diameter);
  if (forcing.fine.direction != forcing.coarse.direction ||
      forcing.fine.impact_angle != forcing.coarse.impact_angle ||
      forcing.fine.impact_angle_spread != forcing.coarse.impact_angle_spread)
    throw Error("sorted forcing: direction and impact angles of both sizes must be those of one wind");
}

SortedForcing sorted_forcing(const Forcing& fine, double coarse_diameter) {
  require_order(fine.grain.diameter, coarse_diameter);
  SortedForcing result{fine, fine};
  const double ratio = fine.grain.diameter / coarse_diameter;
  result.coarse.grain.diameter = coarse_diameter;
  result.coarse.ejection_rate *= ratio * ratio;
  result.coarse.reptation_length =
      std::min(fine.reptation_length, std::max(fine.reptation_length * ratio * ratio, coarse_diameter));
  return result;
}

SortedForcing sorted_forcing(double friction_velocity, double direction, const Grain& fine,
                             double coarse_diameter, const MeanSplash& splash) {
  return sorted_forcing(make_forcing(steady_saltation(friction_velocity, fine), direction, fine, splash),
                        coarse_diameter);
}

}  // namespace aeolian
