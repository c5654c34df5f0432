#pragma once

#include <memory>
#include <string>
#include <vector>

#include "aeolian_core/grains/grain.hpp"
#include "aeolian_core/grains/splash/laemmel.hpp"
#include "aeolian_core/grains/splash/rebound_model.hpp"
#include "aeolian_core/grains/splash/splash.hpp"

namespace aeolian {

/// What the splash functions must know of a bed. Rebound and ejecta have their own parameters.
struct SplashMaterial {
  std::string name;
  Grain grain;
  ReboundModel::Parameters rebound;  ///< of "werner"
  LaemmelParameters restitution;     ///< of "laemmel"
  double beladjine_amplitude = 13;   ///< of "beladjine"
  std::string source;                ///< of the numbers
};

/// "fine_sand" of 0.25 mm, "coarse_sand" of 0.78 mm, "snow" of 0.2 mm. Throws Error listing them for another
/// name.
SplashMaterial splash_material(const std::string& name);
const std::vector<std::string>& splash_material_names();

/// The splash function of this name for a bed of this material:
///
/// | name | rebound | ejecta |
/// |---|---|---|
/// | werner | ReboundModel | CoarseSandEjection |
/// | coarse_sand | CoarseSandRebound | CoarseSandEjection |
/// | kok_renno | KokRennoRebound | KokRennoEjection |
/// | anderson_haff | AndersonHaffRebound | AndersonHaffEjection |
/// | beladjine | BeladjineRebound | BeladjineEjection |
/// | laemmel | LaemmelRebound | LaemmelEjection |
/// | ungar_haff | none | UngarHaffEjection |
/// | distribution_1 to distribution_6 | DistributionSplash | DistributionSplash |
///
/// Throws Error listing the names for another.
std::shared_ptr<const Splash> splash_of(const std::string& name, const SplashMaterial& material);
std::shared_ptr<const Splash> splash_of(const std::string& name, const std::string& material);
const std::vector<std::string>& splash_names();

}  // namespace aeolian
