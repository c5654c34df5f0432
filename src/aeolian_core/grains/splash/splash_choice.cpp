#include "aeolian_core/grains/splash/splash_choice.hpp"

#include "aeolian_core/grains/splash/anderson_haff.hpp"
#include "aeolian_core/grains/splash/beladjine.hpp"
#include "aeolian_core/grains/splash/coarse_sand.hpp"
#include "aeolian_core/grains/splash/composed_splash.hpp"
#include "aeolian_core/grains/splash/distribution_splash.hpp"
#include "aeolian_core/grains/splash/kok_renno.hpp"
#include "aeolian_core/grains/splash/ungar_haff.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

[[noreturn]] void refuse(const char* what, const std::string& name, const std::vector<std::string>& allowed) {
  std::string list;
  for (const std::string& one : allowed) list += (list.empty() ? "" : ", ") + one;
  throw Error(std::string(what) + " is '" + name + "', must be one of " + list);
}

SplashMaterial sand(const char* name, double diameter) {
  SplashMaterial material;
  material.name = name;
  material.grain.diameter = diameter;
  material.rebound.restitution = 0.85;
  material.rebound.friction_restitution = 0;
  material.rebound.mass = 2;
  material.restitution = {0.7, -0.15};
  material.beladjine_amplitude = 4.3;
  material.source =
      "rebound: Werner (1987), table 3.10, case 2, as spheres, effective mass of table 3.3; restitutions: "
      "Laemmel et al. (2017); amplitude: Beladjine et al. (2007) scaled to Werner's coarse sand";
  return material;
}

template <typename R, typename E>
std::shared_ptr<const Splash> composed(R rebound, E ejection) {
  return std::make_shared<ComposedSplash>(std::make_shared<R>(std::move(rebound)),
                                          std::make_shared<E>(std::move(ejection)));
}

}  // namespace

const std::vector<std::string>& splash_material_names() {
  static const std::vector<std::string> names{"fine_sand", "coarse_sand", "snow"};
  return names;
}

SplashMaterial splash_material(const std::string& name) {
  if (name == "fine_sand") return sand("fine_sand", 0.00025);
  if (name == "coarse_sand") return sand("coarse_sand", coarse_sand_diameter);
  if (name != "snow") refuse("splash material", name, splash_material_names());
  SplashMaterial snow = sand("snow", 0.0002);
  snow.grain.density = 910;
  snow.source =
      "all numbers of sand: a loose snow surface answers impacts much as sand does, with vertical "
      "restitutions of 1.5 to 2.3 at friction velocities of 0.15 to 0.39 m/s (Nishimura, Sugiura and Maeno, "
      "velocity and angle distributions of drifting snow particles near the loose snow surface, abstract); "
      "without cohesion";
  return snow;
}

const std::vector<std::string>& splash_names() {
  static const std::vector<std::string> names{
      "werner",         "coarse_sand",    "kok_renno",      "anderson_haff",  "beladjine",
      "laemmel",        "ungar_haff",     "distribution_1", "distribution_2", "distribution_3",
      "distribution_4", "distribution_5", "distribution_6"};
  return names;
}

std::shared_ptr<const Splash> splash_of(const std::string& name, const SplashMaterial& material) {
  const Grain& grain = material.grain;
  if (name == "werner") return composed(ReboundModel(material.rebound), CoarseSandEjection(grain));
  if (name == "coarse_sand") return composed(CoarseSandRebound(grain), CoarseSandEjection(grain));
  if (name == "kok_renno") return composed(KokRennoRebound(), KokRennoEjection(grain));
  if (name == "anderson_haff") return composed(AndersonHaffRebound(), AndersonHaffEjection());
  if (name == "beladjine")
    return composed(BeladjineRebound(), BeladjineEjection(grain, material.beladjine_amplitude));
  if (name == "laemmel")
    return composed(LaemmelRebound(material.restitution), LaemmelEjection(grain, material.restitution));
  if (name == "ungar_haff") return composed(NoRebound(), UngarHaffEjection(grain));
  const std::string distribution = "distribution_";
  if (name.size() == distribution.size() + 1 && name.compare(0, distribution.size(), distribution) == 0 &&
      name.back() >= '1' && name.back() <= '6')
    return std::make_shared<DistributionSplash>(DistributionSplash::thesis_case(name.back() - '0'));
  refuse("splash", name, splash_names());
}

std::shared_ptr<const Splash> splash_of(const std::string& name, const std::string& material) {
  return splash_of(name, splash_material(material));
}

}  // namespace aeolian
