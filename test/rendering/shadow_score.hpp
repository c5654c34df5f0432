#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "shadow_scene.hpp"

#include "aeolian_core/measure/profile_analysis.hpp"
#include "aeolian_core/measure/shadow_profile.hpp"

namespace aeolian {

/// A measured profile held against the scene that it shows.
struct ShadowScore {
  double rmse = 0;             ///< about the mean difference [m]
  double bar = 0;              ///< a quarter of a grain, at least 0.1 mm [m]
  std::optional<double> bias;  ///< mean difference, where the setup gives the height [m]
  std::size_t stations = 0;
  std::size_t covered = 0;  ///< stations whose stated 95 % interval holds the truth
};

ShadowScore score(const SetUp& set_up, const ShadowProfile& profile);

/// Wavelength of the train that fits best over the true one.
struct WavelengthScore {
  double error = 0;  ///< relative
  double sigma = 0;  ///< as stated, relative
  std::size_t ripples = 0;
};

WavelengthScore score_wavelength(const SetUp& set_up, const ProfileAnalysis& analysis);

/// One random set-up, photographed and measured in full mode.
struct EnsembleMember {
  std::uint64_t seed = 0;
  SetUp set_up;
  std::string refusal;  ///< what the Error said, empty when measured
  ShadowProfile profile;
  ShadowScore score;
  WavelengthScore wavelength;
  double seconds = 0;  ///< of one processor, from pixels to profile
};

/// Seeds `first` to `first + count - 1`, on as many threads as asked; the result does not depend on them.
std::vector<EnsembleMember> measure_ensemble(std::uint64_t first, std::size_t count, double megapixels,
                                             unsigned threads);

/// The value below which a share of the values lies; NaN for none.
double quantile(std::vector<double> values, double share);

}  // namespace aeolian
