#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "aeolian_core/grains/impacts/impact.hpp"

namespace aeolian {

/// Many impacts of one kind.
struct ImpactSeries {
  double speed = 30;        ///< [m/s]
  double angle = 0.261799;  ///< [rad]
  double size_ratio = 1;
  int impacts = 40;    ///< spread evenly over the beds
  double spread = 10;  ///< of the points of impact around the middle of a bed, in radii to each side
  std::uint64_t seed = 1;
};

using ImpactDone = std::function<void(const ImpactOutcome& outcome, int over)>;

/// Fires independent impacts at copies of the beds, on all threads; in the order of their numbers. The n-th
/// impact hits bed n modulo their number at a place that depends on seed and n only, so that the result does
/// not depend on threads, and a longer series begins with the shorter one. `done` is told of each impact and
/// how many are over with it, one call at a time. When `stop` becomes true, those under way are finished, no
/// other is begun, and the result has what there is. `known` are outcomes of the same series: they are taken
/// over. Throws Error for a shot that is not valid and for a series without beds.
template <int Dim>
std::vector<ImpactOutcome> fire_series(const std::vector<Bed<Dim>>& beds, const ImpactSeries& series,
                                       const ImpactRules& rules, const ImpactDone& done = {},
                                       const std::atomic<bool>* stop = nullptr,
                                       const std::vector<ImpactOutcome>& known = {});

/// The n-th shot of a series at a bed.
template <int Dim>
Shot series_shot(const Bed<Dim>& bed, const ImpactSeries& series, int number);

extern template std::vector<ImpactOutcome> fire_series(const std::vector<Bed<2>>&, const ImpactSeries&,
                                                       const ImpactRules&, const ImpactDone&,
                                                       const std::atomic<bool>*,
                                                       const std::vector<ImpactOutcome>&);
extern template std::vector<ImpactOutcome> fire_series(const std::vector<Bed<3>>&, const ImpactSeries&,
                                                       const ImpactRules&, const ImpactDone&,
                                                       const std::atomic<bool>*,
                                                       const std::vector<ImpactOutcome>&);
extern template Shot series_shot(const Bed<2>&, const ImpactSeries&, int);
extern template Shot series_shot(const Bed<3>&, const ImpactSeries&, int);

}  // namespace aeolian
