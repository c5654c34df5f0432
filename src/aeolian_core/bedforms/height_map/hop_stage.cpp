#include "aeolian_core/bedforms/height_map/hop_stage.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {
namespace {

using Memory = HopStage::Memory;
using Stations = HopStage::Stations;
using Ground = HopStage::Ground;

/// Sand that is deep everywhere.
struct DeepSand {
  AEOLIAN_INLINE double eroded(double struck, std::ptrdiff_t) const { return struck; }
  AEOLIAN_INLINE double carried(const HopLaw& law, std::ptrdiff_t) const { return law.carried; }
  AEOLIAN_INLINE double leaves(double raw, double, double, std::ptrdiff_t) const { return raw; }
};

struct HardGroundLines {
  const double* __restrict movable;
  const double* __restrict open1;
  const double* __restrict open2;

  AEOLIAN_INLINE double eroded(double struck, std::ptrdiff_t i) const {
    return struck < movable[i] ? struck : movable[i];
  }
  AEOLIAN_INLINE double carried(const HopLaw& law, std::ptrdiff_t i) const {
    return 1 - open1[i] * (1 - law.carried);
  }
  /// No more than comes in and is let go, and all that comes in where nothing can rest.
  AEOLIAN_INLINE double leaves(double raw, double enters, double lost, std::ptrdiff_t i) const {
    const double most = enters + lost;
    const double positive = raw > 0 ? raw : 0;
    const double limited = positive < most ? positive : most;
    return open2[i] > 0 ? limited : enters;
  }
};

/// Twice the exposure of either half of a stretch between two stations.
struct Halves {
  double before, behind;
};

/// Both halves have the same share of what a stretch is exposed to...
template <int angles>
AEOLIAN_INLINE Halves exposed(const HopLaw& law, Memory& m, double height, double, const DeepSand&,
                              std::ptrdiff_t i) {
  double sum = 0;
  for (int n = 0; n < angles; ++n) {
    const double fallen = m.envelope[n][i] - law.drop[n];
    const double top = fallen > height ? fallen : height;
    m.envelope[n][i] = top;
    const double part = (top - fallen) * law.exposed_per_height[n];
    sum = n == 0 ? part : sum + part;
  }
  return {sum, sum};
}

/// ... unless a wall of rock may stand over a pit of sand: then each has what strikes it.
template <int angles>
AEOLIAN_INLINE Halves exposed(const HopLaw& law, Memory& m, double height, double height_1,
                              const HardGroundLines&, std::ptrdiff_t i) {
  const double middle = 0.5 * (height + height_1);
  Halves sum{0, 0};
  for (int n = 0; n < angles; ++n) {
    const double fallen_half = m.envelope[n][i] - 0.5 * law.drop[n];
    const double half_top = fallen_half > middle ? fallen_half : middle;
    const double fallen = half_top - 0.5 * law.drop[n];
    const double top = fallen > height ? fallen : height;
    m.envelope[n][i] = top;
    sum.before += 2 * (half_top - fallen_half) * law.exposed_per_height[n];
    sum.behind += 2 * (top - fallen) * law.exposed_per_height[n];
  }
  return sum;
}

/// `now` is which of two in turn is written.
template <int angles, int now, class Bed>
AEOLIAN_INLINE void sweep_lines(const HopLaw& given, std::ptrdiff_t begin, std::ptrdiff_t end,
                                Memory& __restrict m, const Stations& at, const Bed& bed) {
  const HopLaw law = given;
  const double* __restrict const h = at.height;
  const double* __restrict const h1 = at.height_1;
  const double* __restrict const h2 = at.height_2;
  double* __restrict const erosion = at.erosion_1;
  const double* __restrict const erosion2 = at.erosion_2;
  double* __restrict const deposition = at.deposition_2;
#pragma GCC ivdep
  for (std::ptrdiff_t i = begin; i < end; ++i) {
    // Exposure of the stretch that ends here.
    const Halves here = exposed<angles>(law, m, h[i], h1[i], bed, i);
    // Station k - 1: erosion, and the flux behind it.
    const double e = bed.eroded(0.5 * (m.exposure[i] + here.before), i);
    m.exposure[i] = here.behind;
    const double launched = law.launched * e;
    const double carried = bed.carried(law, i);
    const double f = carried * m.grains[i] + launched;
    const double g = carried * m.heights[i] + launched * ((h[i] + h2[i] + 4 * h1[i]) * (1.0 / 6));
    m.grains[i] = f;
    m.heights[i] = g;
    const double through =
        shifted(f, law.shortening * (g - (law.height_before * h1[i] + law.height_behind * h[i]) * f));
    // Station k - 2: what comes in, goes out and stays.
    const double raw =
        law.flux_here * m.flux[1 - now][i] + law.flux_downwind * through + law.flux_upwind * m.flux[now][i];
    m.flux[now][i] = through;
    const double enters = m.out[1 - now][i];
    const double lost = erosion2[i];
    const double leaves = bed.leaves(raw, enters, lost, i);
    m.out[now][i] = leaves;
    erosion[i] = e;
    deposition[i] = lost + (enters - leaves);
  }
}

template <int angles, class Bed>
AEOLIAN_INLINE void sweep_in_turn(const HopLaw& law, int now, std::ptrdiff_t begin, std::ptrdiff_t end,
                                  Memory& m, const Stations& at, const Bed& bed) {
  if (now == 0)
    sweep_lines<angles, 0>(law, begin, end, m, at, bed);
  else
    sweep_lines<angles, 1>(law, begin, end, m, at, bed);
}

AEOLIAN_WIDE_KERNEL void sweep_sand(const HopLaw& law, int now, std::ptrdiff_t begin, std::ptrdiff_t end,
                                    Memory& m, const Stations& at) {
  sweep_in_turn<1>(law, now, begin, end, m, at, DeepSand{});
}

AEOLIAN_WIDE_KERNEL void sweep_sand_by_angles(const HopLaw& law, int now, std::ptrdiff_t begin,
                                              std::ptrdiff_t end, Memory& m, const Stations& at) {
  sweep_in_turn<ImpactAngles::most>(law, now, begin, end, m, at, DeepSand{});
}

AEOLIAN_WIDE_KERNEL void sweep_ground(const HopLaw& law, int now, std::ptrdiff_t begin, std::ptrdiff_t end,
                                      Memory& m, const Stations& at, const Ground& ground) {
  sweep_in_turn<1>(law, now, begin, end, m, at,
                   HardGroundLines{ground.movable_1, ground.open_1, ground.open_2});
}

AEOLIAN_WIDE_KERNEL void sweep_ground_by_angles(const HopLaw& law, int now, std::ptrdiff_t begin,
                                                std::ptrdiff_t end, Memory& m, const Stations& at,
                                                const Ground& ground) {
  sweep_in_turn<ImpactAngles::most>(law, now, begin, end, m, at,
                                    HardGroundLines{ground.movable_1, ground.open_1, ground.open_2});
}

AEOLIAN_WIDE_KERNEL void lower_envelope(std::ptrdiff_t count, double drop, const double* __restrict h,
                                        double* __restrict envelope) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double fallen = envelope[i] - drop;
    envelope[i] = fallen > h[i] ? fallen : h[i];
  }
}

}  // namespace

HopLaw::HopLaw(double step, const ImpactAngles& impacts, double hop, double shortening_, double blur)
    : angles(impacts.count()),
      drop{},
      exposed_per_height{},
      carried(std::exp(-step / hop)),
      launched(-std::expm1(-step / hop) * hop / step),
      flat_flux(hop / step),
      shortening(shortening_ / hop) {
  for (int i = 0; i < angles; ++i) {
    const auto n = static_cast<std::size_t>(i);
    drop[n] = step * impacts.tangent(i);
    exposed_per_height[n] = impacts.weight(i) / drop[n];
  }
  // A wave of phase theta per station loses theta^2 / 6 of its slope between stations on both sides, and the
  // flux that uniform cells launch lags by theta step / (12 hop).
  const double lag = std::min(step / hop, 1.0) / 12;
  const double sharpening = 1.0 / 6 + blur;
  flux_upwind = -sharpening - lag / 2;
  flux_here = 1 + 2 * sharpening;
  flux_downwind = -sharpening + lag / 2;
  height_before = 0.5 + lag;
  height_behind = 0.5 - lag;
}

double HopLaw::least_drop() const { return *std::min_element(drop.begin(), drop.begin() + angles); }

void HopStage::sweep(const HopLaw& law, int begin, int end, const Stations& at) {
  now_ = 1 - now_;
  (law.angles == 1 ? sweep_sand : sweep_sand_by_angles)(law, now_, begin, end, memory_, at);
}

void HopStage::sweep(const HopLaw& law, int begin, int end, const Stations& at, const Ground& ground) {
  now_ = 1 - now_;
  (law.angles == 1 ? sweep_ground : sweep_ground_by_angles)(law, now_, begin, end, memory_, at, ground);
}

void HopStage::pass_over(const HopLaw& law, int begin, int end, const double* height) {
  for (int n = 0; n < law.angles; ++n)
    lower_envelope(end - begin, law.drop[static_cast<std::size_t>(n)], height + begin,
                   memory_.envelope[n] + begin);
  std::fill(memory_.exposure + begin, memory_.exposure + end, 0.0);
}

bool HopStage::is_struck(const HopLaw& law, int begin, int end, const double* height) const {
  for (int n = 0; n < law.angles; ++n)
    for (int i = begin; i < end; ++i)
      if (memory_.envelope[n][i] - law.drop[static_cast<std::size_t>(n)] < height[i]) return true;
  return false;
}

bool HopStage::was_struck(int begin, int end) const {
  return std::any_of(memory_.exposure + begin, memory_.exposure + end, [](double e) { return e > 0; });
}

void HopStage::forget_shadows() {
  for (auto& envelope : memory_.envelope) std::fill_n(envelope, most_lines, -1e300);
}

void HopStage::put_down(int begin, int end, double* deposition_2) {
  for (int i = begin; i < end; ++i) {
    deposition_2[i] += memory_.out[now_][i];
    memory_.grains[i] = memory_.heights[i] = memory_.out[now_][i] = 0;
    memory_.flux[0][i] = memory_.flux[1][i] = 0;
  }
}

double HopStage::strongest_flux(int begin, int end) const {
  double strongest = 0;
  for (const double* flux : {memory_.grains, memory_.flux[0], memory_.flux[1], memory_.out[now_]})
    for (int i = begin; i < end; ++i) strongest = std::max(strongest, std::abs(flux[i]));
  return strongest;
}

void HopStage::begin(const HopLaw& law, int line, double height, double share) {
  const double flux = share * law.flat_flux;
  for (auto& envelope : memory_.envelope) envelope[line] = height;
  memory_.exposure[line] = 1;
  memory_.grains[line] = flux;
  memory_.heights[line] = flux * height;
  for (auto& through : memory_.flux) through[line] = flux;
  memory_.out[now_][line] = flux;
}

void HopStage::shade(int line, double height) {
  for (auto& envelope : memory_.envelope) {
    if (height > envelope[line]) memory_.exposure[line] = 0;
    envelope[line] = std::max(envelope[line], height);
  }
}

}  // namespace aeolian
