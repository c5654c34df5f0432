#include "aeolian_core/measure/ripple_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "aeolian_core/measure/none.hpp"
#include "aeolian_core/surface/median.hpp"

namespace aeolian {
namespace {

/// Values of sections, of which as many are independent as `per_section` of them all.
Figure mean_of(const std::vector<double>& values, double per_section) {
  if (values.empty()) return {none, none};
  const auto n = static_cast<double>(values.size());
  double sum = 0;
  for (const double v : values) sum += v;
  double squares = 0;
  for (const double v : values) squares += (v - sum / n) * (v - sum / n);
  return {sum / n, std::sqrt(squares / n / std::max(1.0, n * per_section))};
}

/// The standard error is that of a median of normal values whose spread is the quartiles'.
Figure median_of(std::vector<double> values, double per_section) {
  if (values.empty()) return {none, none};
  const auto n = static_cast<double>(values.size());
  const double middle = median(values);
  for (double& v : values) v = std::abs(v - middle);
  return {middle,
          1.2533 * sigma_per_median * median(std::move(values)) / std::sqrt(std::max(1.0, n * per_section))};
}

}  // namespace

RippleField ripple_field(const RippleCrests& found) {
  RippleField field;
  std::vector<const CrestSection*> sections;
  double length = 0;
  for (const CrestLine& crest : found.crests) {
    length += crest.length;
    for (const CrestSection& section : crest.sections) sections.push_back(&section);
  }
  const auto count = static_cast<double>(sections.size());
  const double per_section = sections.empty() ? 0 : length / found.relief.pattern.wavelength / count;
  const auto values = [&](const auto& value) {
    std::vector<double> result;
    for (const CrestSection* section : sections) {
      const auto v = static_cast<double>(value(*section));
      if (std::isfinite(v)) result.push_back(v);
    }
    return result;
  };
  field.wavelength = mean_of(values([](const CrestSection& s) { return s.spacing; }), per_section);
  const auto typical = [&](const auto& value) { return median_of(values(value), per_section); };
  field.height = typical([](const CrestSection& s) { return s.height; });
  field.index = typical([](const CrestSection& s) { return s.spacing / s.height; });
  field.stoss_mean = typical([](const CrestSection& s) { return s.stoss_mean; });
  field.stoss_max = typical([](const CrestSection& s) { return s.stoss_max; });
  field.lee_mean = typical([](const CrestSection& s) { return s.lee_mean; });
  field.lee_max = typical([](const CrestSection& s) { return s.lee_max; });
  field.asymmetry = typical([](const CrestSection& s) { return s.stoss_length / s.lee_length; });

  // Crests have a direction but no sense, so angles are doubled; sections weigh by their length of crest.
  std::complex<double> sum = 0;
  double weight = 0;
  for (const CrestSection* section : sections) {
    const auto turn = static_cast<double>(section->turn);
    sum += std::polar(1 / std::cos(turn), 2 * turn);
    weight += 1 / std::cos(turn);
  }
  field.concentration = weight > 0 ? std::abs(sum) / weight : none;
  const double mean_turn = 0.5 * std::arg(sum);
  const double spread = mean_of(values([](const CrestSection& s) { return s.turn; }), per_section).sigma;
  field.orientation =
      weight > 0 ? Figure{std::remainder(found.relief.pattern.normal + mean_turn + M_PI / 2, M_PI), spread}
                 : Figure{none, none};

  field.crests = static_cast<int>(found.crests.size());
  field.crest_length = field.crests > 0 ? length / field.crests : none;
  for (const RippleDefect& defect : found.defects)
    ++(defect.kind == CrestEnd::junction ? field.junctions : field.terminations);
  const auto defects = static_cast<double>(found.defects.size());
  field.defect_density =
      found.searched_area > 0
          ? Figure{defects / found.searched_area, std::sqrt(std::max(1.0, defects)) / found.searched_area}
          : Figure{none, none};
  field.defects_per_square_wavelength =
      field.defect_density.value * field.wavelength.value * field.wavelength.value;
  return field;
}

std::optional<double> likely_wind(const GridGeometry& g, const HeightMap::Layer& elevation) {
  std::optional<double> best;
  double longest = 0;
  // Three directions, as each sees crests that are within 60 degrees of square to it.
  for (const double direction : {0.0, M_PI / 3, 2 * M_PI / 3}) {
    const RippleCrests found = find_crests(g, elevation, direction);
    const RippleField field = ripple_field(found);
    const double length = field.crests > 0 ? field.crests * field.crest_length * field.concentration : 0;
    if (!(length > longest)) continue;
    longest = length;
    best = std::remainder(found.relief.pattern.normal + (field.asymmetry.value < 1 ? M_PI : 0), 2 * M_PI);
  }
  return best;
}

}  // namespace aeolian
