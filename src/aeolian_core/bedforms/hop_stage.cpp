#include "aeolian_core/bedforms/hop_stage.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

AEOLIAN_KERNEL void sweep_lines(const HopLaw& given, std::ptrdiff_t count, const double* __restrict h,
                                const double* __restrict h1, const double* __restrict h2,
                                double* __restrict envelope, double* __restrict exposure,
                                double* __restrict last_erosion, double* __restrict grains,
                                double* __restrict heights, const double* __restrict flux,
                                double* __restrict flux_before, double* __restrict in, double* __restrict out,
                                double* __restrict erosion, double* __restrict deposition) {
  const HopLaw law = given;
  const double per_drop = 1 / law.drop;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    // Exposure of the stretch that ends here.
    const double fallen = envelope[i] - law.drop;
    const double top = fallen > h[i] ? fallen : h[i];
    const double here = (top - fallen) * per_drop;
    envelope[i] = top;
    // Station k - 1: erosion, and the flux behind it.
    const double e = 0.5 * (exposure[i] + here);
    exposure[i] = here;
    const double launched = law.launched * e;
    const double f = law.carried * grains[i] + launched;
    const double g = law.carried * heights[i] + launched * ((h[i] + h2[i] + 4 * h1[i]) * (1.0 / 6));
    grains[i] = f;
    heights[i] = g;
    const double through =
        f + law.shortening * (g - (law.height_before * h1[i] + law.height_behind * h[i]) * f);
    // Station k - 2: what comes in, goes out and stays.
    const double leaves =
        law.flux_here * flux[i] + law.flux_downwind * through + law.flux_upwind * flux_before[i];
    flux_before[i] = through;
    const double enters = out[i];
    in[i] = enters;
    out[i] = leaves;
    const double lost = last_erosion[i];
    last_erosion[i] = e;
    erosion[i] = lost;
    deposition[i] = lost + (enters - leaves);
  }
}

AEOLIAN_KERNEL void sweep_hard_lines(const HopLaw& given, std::ptrdiff_t count, const double* __restrict h,
                                     const double* __restrict h1, const double* __restrict h2,
                                     const double* __restrict movable, const double* __restrict open1,
                                     const double* __restrict open2, double* __restrict envelope,
                                     double* __restrict exposure, double* __restrict last_erosion,
                                     double* __restrict grains, double* __restrict heights,
                                     const double* __restrict flux, double* __restrict flux_before,
                                     double* __restrict in, double* __restrict out,
                                     double* __restrict erosion, double* __restrict deposition) {
  const HopLaw law = given;
  const double per_drop = 1 / law.drop;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double fallen = envelope[i] - law.drop;
    const double top = fallen > h[i] ? fallen : h[i];
    const double here = (top - fallen) * per_drop;
    envelope[i] = top;
    const double struck = 0.5 * (exposure[i] + here);
    const double e = struck < movable[i] ? struck : movable[i];
    exposure[i] = here;
    const double launched = law.launched * e;
    const double carried = 1 - open1[i] * (1 - law.carried);
    const double f = carried * grains[i] + launched;
    const double g = carried * heights[i] + launched * ((h[i] + h2[i] + 4 * h1[i]) * (1.0 / 6));
    grains[i] = f;
    heights[i] = g;
    const double through =
        f + law.shortening * (g - (law.height_before * h1[i] + law.height_behind * h[i]) * f);
    const double raw =
        law.flux_here * flux[i] + law.flux_downwind * through + law.flux_upwind * flux_before[i];
    flux_before[i] = through;
    const double enters = out[i];
    const double lost = last_erosion[i];
    // No more leaves than comes in and is let go, and all that comes in where nothing can rest.
    const double most = enters + lost;
    const double positive = raw > 0 ? raw : 0;
    const double limited = positive < most ? positive : most;
    const double leaves = open2[i] > 0 ? limited : enters;
    in[i] = enters;
    out[i] = leaves;
    last_erosion[i] = e;
    erosion[i] = lost;
    deposition[i] = lost + (enters - leaves);
  }
}

AEOLIAN_KERNEL void lower_envelope(std::ptrdiff_t count, double drop, const double* __restrict h,
                                   double* __restrict envelope) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double fallen = envelope[i] - drop;
    envelope[i] = fallen > h[i] ? fallen : h[i];
  }
}

}  // namespace

HopLaw::HopLaw(double step, double tan_impact_angle, double hop, double shortening_, double blur)
    : drop(step * tan_impact_angle),
      carried(std::exp(-step / hop)),
      launched(-std::expm1(-step / hop) * hop / step),
      flat_flux(hop / step),
      shortening(shortening_ / hop) {
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

HopStage::HopStage(int lines) {
  for (std::vector<double>* memory :
       {&envelope_, &exposure_, &erosion_, &grains_, &heights_, &flux_, &flux_before_, &in_, &out_})
    memory->assign(static_cast<std::size_t>(lines), 0.0);
}

void HopStage::sweep(const HopLaw& law, int begin, int end, const double* height, const double* height_1,
                     const double* height_2, double* erosion, double* deposition) {
  sweep_lines(law, end - begin, height + begin, height_1 + begin, height_2 + begin, envelope_.data() + begin,
              exposure_.data() + begin, erosion_.data() + begin, grains_.data() + begin,
              heights_.data() + begin, flux_.data() + begin, flux_before_.data() + begin, in_.data() + begin,
              out_.data() + begin, erosion + begin, deposition + begin);
  flux_.swap(flux_before_);
}

void HopStage::sweep_hard(const HopLaw& law, int begin, int end, const double* height, const double* height_1,
                          const double* height_2, const double* movable_1, const double* open_1,
                          const double* open_2, double* erosion, double* deposition) {
  sweep_hard_lines(law, end - begin, height + begin, height_1 + begin, height_2 + begin, movable_1 + begin,
                   open_1 + begin, open_2 + begin, envelope_.data() + begin, exposure_.data() + begin,
                   erosion_.data() + begin, grains_.data() + begin, heights_.data() + begin,
                   flux_.data() + begin, flux_before_.data() + begin, in_.data() + begin, out_.data() + begin,
                   erosion + begin, deposition + begin);
  flux_.swap(flux_before_);
}

void HopStage::pass_over(const HopLaw& law, int begin, int end, const double* height) {
  lower_envelope(end - begin, law.drop, height + begin, envelope_.data() + begin);
}

double HopStage::strongest_flux(int begin, int end) const {
  return begin < end ? *std::max_element(grains_.begin() + begin, grains_.begin() + end) : 0;
}

void HopStage::begin(const HopLaw& law, int line, double height, double share) {
  const auto at = static_cast<std::size_t>(line);
  const double flux = share * law.flat_flux;
  envelope_[at] = height;
  exposure_[at] = 1;
  erosion_[at] = 0;
  grains_[at] = flux;
  heights_[at] = flux * height;
  flux_[at] = flux;
  flux_before_[at] = flux;
  out_[at] = flux;
}

}  // namespace aeolian
