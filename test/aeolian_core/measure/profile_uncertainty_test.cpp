// Stated standard errors against errors made: over many synthetic profiles their ratio has an rms near 1.

#include <cmath>
#include <map>
#include <string>

#include "synthetic_profile.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

using namespace synthetic;

std::map<std::string, Figure> figures(const ProfileAnalysis& a) {
  return {{"wavelength", a.wavelength},
          {"height", a.height},
          {"index", a.index},
          {"mean stoss", a.stoss_mean},
          {"steepest stoss", a.stoss_max},
          {"mean lee", a.lee_mean},
          {"steepest lee", a.lee_max},
          {"dip", a.apparent_dip},
          {"roughness", a.roughness},
          {"dominant length", a.dominant_length},
          {"spectral wavelength", a.spectral_wavelength},
          {"wavelength of a ripple", a.ripples.at(1).wavelength},
          {"height of a ripple", a.ripples.at(1).height},
          {"steepest lee of a ripple", a.ripples.at(1).lee_max}};
}

/// Noise of the heights [m], common errors of heights and lengths as factors.
void check_errors(int profiles, double noise, double height_error, double length_error) {
  const Curve bed = [](double x) { return leaning(0.05, 0.003)(x) + 0.03 * x; };
  const double length = 0.22;
  ShadowProfile perfect = profile_of(bed, length, grain);
  perfect.downwind = 1;
  const auto truth = figures(analyse(perfect));

  std::map<std::string, double> squares;
  RandomStream random(3, 3);
  for (int i = 0; i < profiles; ++i) {
    ShadowProfile profile = perfect;
    const double higher = 1 + height_error * random.normal();
    const double longer = 1 + length_error * random.normal();
    for (double& z : profile.z) z *= higher;
    for (double& x : profile.x) x *= longer;
    add_noise(profile, noise, static_cast<std::uint64_t>(i));
    profile.grain_diameter = grain;
    profile.relative_sigma = height_error;
    profile.scale = {8000, 8000 * length_error};
    for (const auto& [name, figure] : figures(analyse(profile))) {
      const double error = (figure.value - truth.at(name).value) / figure.sigma;
      squares[name] += error * error / profiles;
    }
  }
  for (const auto& [name, square] : squares) {
    EXPECT_GT(std::sqrt(square), 0.8) << name;
    // Which of the many stretches of a straight flank is the steepest, noise decides: what it adds is taken
    // off only in part.
    EXPECT_LT(std::sqrt(square), name == "steepest stoss" ? 1.4 : 1.25) << name;
  }
}

TEST(ProfileUncertainty, OfNoiseIsRight) { check_errors(200, 0.1e-3, 0, 0); }
TEST(ProfileUncertainty, OfScaleAndLightIsRight) { check_errors(100, 0.05e-3, 0.03, 0.005); }

}  // namespace
}  // namespace aeolian
