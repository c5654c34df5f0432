#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace aeolian {

/// Maxima that stand out: the curve falls by at least `prominence` on both sides of each before it rises
/// higher. Sample numbers, rising.
std::vector<std::size_t> prominent_crests(const std::vector<double>& curve, double prominence);

/// A ripple over the common tangent of the two troughs beside its crest (Werner 1987, ch. V), lengths along
/// and square to the tangent, slopes against it. Left is towards smaller x.
struct RippleShape {
  double start = 0;  ///< troughs and crest, in samples
  double crest = 0;
  double end = 0;
  double wavelength = 0;  ///< [m]
  double height = 0;      ///< [m]
  double left_mean = 0;   ///< slopes of the flanks, positive towards the crest [rad]
  double left_max = 0;
  double right_mean = 0;
  double right_max = 0;
  double tangent_slope = 0;  ///< of the tangent against the horizontal, rising with x positive [rad]
  /// How far the bed comes back up over the tangent within the range to the left of the start, and to the
  /// right of the end [m]: small values tell a range that stops before the trough does.
  double left_rise = 0;
  double right_rise = 0;
};

/// The ripple with a known crest in the samples first..last, which reach over the troughs on both sides at
/// most up to the neighbouring crests. Within `noise` [m] three times over, samples cannot be told from a
/// trough's bottom or a crest's top: a cubic through them is taken instead. Nothing when no tangent spans the
/// crest.
std::optional<RippleShape> measure_ripple(const std::vector<double>& z, double step, std::size_t first,
                                          std::size_t crest, std::size_t last, double noise);

}  // namespace aeolian
