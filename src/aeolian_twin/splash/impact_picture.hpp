#pragma once

#include <string>

#include <opencv2/core.hpp>

#include "aeolian_twin/splash/impact_film.hpp"

namespace aeolian {

/// Draws frames of a film: grains coloured by speed, the incident one marked and with its path behind it, a
/// scale bar and the time.
class ImpactPicture {
 public:
  /// Frames of this width [px]; their height follows from the film.
  ImpactPicture(const Film& film, std::string title, int width);

  /// 8-bit BGRX.
  cv::Mat draw(std::size_t frame) const;

 private:
  class Drawing;

  const Film& film_;
  std::string title_;
  int width_;
  int height_;
  double scale_;                ///< [px/m]
  double left_, top_, bottom_;  ///< of what is seen [m]
};

/// Writes impact.webp, which moves, impact_00.png and so on, frames at the times of Werner's (1987) fig. 3.1
/// in terms of sqrt(r / g), and impact.png with all of those.
template <int Dim>
void write_impact_pictures(const Bed<Dim>& bed, const Shot& shot, const ImpactRules& rules,
                           const std::string& title, const std::string& folder);

extern template void write_impact_pictures(const Bed<2>&, const Shot&, const ImpactRules&, const std::string&,
                                           const std::string&);
extern template void write_impact_pictures(const Bed<3>&, const Shot&, const ImpactRules&, const std::string&,
                                           const std::string&);

}  // namespace aeolian
