#include "aeolian_core/bedforms/sorting/sorted_hop_stage.hpp"

#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

/// Adds what impacts of one angle expose of the stretch that ends here.
AEOLIAN_KERNEL void expose(std::ptrdiff_t count, double drop, double per_height, const double* __restrict h,
                           double* __restrict envelope, double* __restrict here) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double fallen = envelope[i] - drop;
    const double top = fallen > h[i] ? fallen : h[i];
    envelope[i] = top;
    here[i] += (top - fallen) * per_height;
  }
}

/// Exposure of station k - 1: the mean of the stretches before and behind it.
AEOLIAN_KERNEL void average(std::ptrdiff_t count, double* __restrict here, double* __restrict stretch,
                            double* __restrict exposure) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    exposure[i] = 0.5 * (stretch[i] + here[i]);
    stretch[i] = here[i];
    here[i] = 0;
  }
}

struct Part {
  double whole, per_fraction;
};

/// The flux of one size; see sweep_lines() of hop_stage.cpp.
AEOLIAN_KERNEL void carry(const HopLaw& given, Part given_part, double largest, std::ptrdiff_t count,
                          const double* __restrict h, const double* __restrict h1,
                          const double* __restrict h2, const double* __restrict exposure1,
                          const double* __restrict exposure2, const double* __restrict fraction1,
                          const double* __restrict fraction2, double* __restrict grains,
                          double* __restrict heights, const double* __restrict flux,
                          double* __restrict flux_before, double* __restrict in, double* __restrict out,
                          double* __restrict deposition) {
  const HopLaw law = given;
  const Part part = given_part;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double struck1 = exposure1[i] < largest ? exposure1[i] : largest;
    const double launched = law.launched * (struck1 * (part.whole + part.per_fraction * fraction1[i]));
    const double f = law.carried * grains[i] + launched;
    const double g = law.carried * heights[i] + launched * ((h[i] + h2[i] + 4 * h1[i]) * (1.0 / 6));
    grains[i] = f;
    heights[i] = g;
    const double through =
        shifted(f, law.shortening * (g - (law.height_before * h1[i] + law.height_behind * h[i]) * f));
    const double raw =
        law.flux_here * flux[i] + law.flux_downwind * through + law.flux_upwind * flux_before[i];
    flux_before[i] = through;
    const double enters = out[i];
    const double struck2 = exposure2[i] < largest ? exposure2[i] : largest;
    const double lost = struck2 * (part.whole + part.per_fraction * fraction2[i]);
    const double most = enters + lost;
    const double positive = raw > 0 ? raw : 0;
    const double leaves = positive < most ? positive : most;
    in[i] = enters;
    out[i] = leaves;
    deposition[i] = most - leaves;
  }
}

}  // namespace

SortedHopStage::SortedHopStage(int lines) {
  const auto count = static_cast<std::size_t>(lines);
  for (std::vector<double>& envelope : envelope_) envelope.assign(count, 0.0);
  stretch_.assign(count, 0.0);
  here_.assign(count, 0.0);
  for (Flux& f : flux_)
    for (std::vector<double>* memory : {&f.grains, &f.heights, &f.flux, &f.flux_before, &f.in, &f.out})
      memory->assign(count, 0.0);
}

void SortedHopStage::sweep(const std::array<SizeLaw, sizes>& law, int begin, int end, const double* height,
                           const double* height_1, const double* height_2, const double* fraction_1,
                           const double* fraction_2, const double* exposure_2, double* exposure_1,
                           const std::array<double*, sizes>& deposition) {
  const int count = end - begin;
  const HopLaw& impacts = law[0].hop;
  for (std::size_t n = 0; n < static_cast<std::size_t>(impacts.angles); ++n)
    expose(count, impacts.drop[n], impacts.exposed_per_height[n], height + begin, envelope_[n].data() + begin,
           here_.data() + begin);
  average(count, here_.data() + begin, stretch_.data() + begin, exposure_1 + begin);
  for (std::size_t s = 0; s < sizes; ++s) {
    Flux& f = flux_[s];
    const Part part{law[s].share(0), law[s].share(1) - law[s].share(0)};
    carry(law[s].hop, part, law[s].largest, count, height + begin, height_1 + begin, height_2 + begin,
          exposure_1 + begin, exposure_2 + begin, fraction_1 + begin, fraction_2 + begin,
          f.grains.data() + begin, f.heights.data() + begin, f.flux.data() + begin,
          f.flux_before.data() + begin, f.in.data() + begin, f.out.data() + begin, deposition[s] + begin);
    f.flux.swap(f.flux_before);
  }
}

void SortedHopStage::begin(const std::array<SizeLaw, sizes>& law, int line, double height, double fraction,
                           double supply) {
  const auto at = static_cast<std::size_t>(line);
  for (std::vector<double>& envelope : envelope_) envelope[at] = height;
  stretch_[at] = 1;
  for (std::size_t s = 0; s < sizes; ++s) {
    Flux& f = flux_[s];
    const double flux = supply * law[s].share(fraction) * law[s].hop.flat_flux;
    f.grains[at] = flux;
    f.heights[at] = flux * height;
    f.flux[at] = flux;
    f.flux_before[at] = flux;
    f.out[at] = flux;
  }
}

}  // namespace aeolian
