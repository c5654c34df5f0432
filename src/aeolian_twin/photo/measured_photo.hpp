#pragma once

#include <optional>
#include <string>
#include <vector>

#include "aeolian_core/measure/profile_analysis.hpp"
#include "aeolian_core/measure/shadow_profile.hpp"

namespace aeolian {

/// One photograph with all that was measured on it.
struct MeasuredPhoto {
  std::string name;            ///< of the file, without its folder
  std::optional<double> time;  ///< Unix time of the picture [s]
  ShadowProfile profile;
  ProfileAnalysis analysis;
};

/// The stations' places along the horizontal, where the analysis has its ripples [m]. A bed point x along the
/// straightedge and Z over its origin lies at (x - Z sin e) / cos e for an inclination e.
std::vector<double> horizontal_places(const ShadowProfile& profile);

/// The measured heights at a place along the horizontal, between the samples of the analysis [m].
double height_at(const EvenProfile& even, double place);

/// What was measured in one line: "13 ripples, wavelength 72.7 +- 0.4 mm, height 4.9 +- 0.1 mm, index 14.8 +-
/// 0.3", with another sign of the error if wanted.
std::string in_one_line(const ProfileAnalysis& analysis, const std::string& between = "+-");

}  // namespace aeolian
