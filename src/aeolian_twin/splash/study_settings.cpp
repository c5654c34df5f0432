#include "aeolian_twin/splash/study_settings.hpp"

#include <cmath>

#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/yaml_section.hpp"

namespace aeolian {
namespace {

/// One of some words; throws Error naming them all.
std::string word(YamlSection& section, const std::string& key, const std::vector<std::string>& allowed) {
  const std::string text = section.text(key);
  for (const std::string& one : allowed)
    if (text == one) return text;
  section.refuse(key, fmt::format("must be one of {}", fmt::join(allowed, ", ")));
}

/// A list of numbers within limits; at least one.
std::vector<double> list(YamlSection& section, const std::string& key, double low, double high) {
  const std::vector<double> values = section.numbers(key);
  if (values.empty()) section.refuse(key, "must have at least one number");
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] >= low && values[i] <= high))
      section.refuse_element(key, i, fmt::format("must be from {:g} to {:g}", low, high));
    if (i > 0 && !(values[i] > values[i - 1]))
      section.refuse_element(key, i, "must be more than the one before");
  }
  return values;
}

void read_grains(YamlSection section, StudySettings& study, double& size_spread) {
  study.diameter = 1e-3 * section.number("diameter_mm", 0.01, 1000);
  study.density = section.number("density_kg_m3", 1, 30000);
  size_spread = section.has("size_spread") ? section.number("size_spread", 0, 0.5) : 0;
  section.finish();
}

/// Mass of one of the bed's grains [kg].
double grain_mass(const StudySettings& study) {
  const double r = 0.5 * study.diameter;
  return study.dimensions == 2 ? study.density * M_PI * r * r * r : study.density * 4. / 3 * M_PI * r * r * r;
}

void read_contact(YamlSection section, StudySettings& study) {
  const std::string law = word(section, "law", {"spring", "hertz_mindlin"});
  const double restitution = section.number("restitution", 0.01, 1);
  const double friction = section.number("friction", 0, 10);
  if (law == "spring") {
    study.law = ContactLaw::spring(section.number("stiffness_n_m", 1e-6, 1e12), restitution,
                                   0.5 * grain_mass(study), friction);
  } else {
    study.law.kind = ContactLaw::Kind::hertz_mindlin;
    study.law.restitution = restitution;
    study.law.friction = friction;
    study.law.youngs_modulus = section.number("youngs_modulus_pa", 1, 1e13);
    study.law.poisson_ratio = section.number("poisson_ratio", 0, 0.5);
  }
  study.steps_per_contact = section.number("steps_per_contact", 10, 10000);
  section.finish();
}

BedKind read_bed(YamlSection section, const StudySettings& study, double size_spread) {
  BedKind kind;
  BedRecipe& recipe = kind.recipe;
  const bool discs = study.dimensions == 2;
  const std::string packing = discs ? word(section, "packing", {"loose", "dense", "poured", "struck"})
                                    : word(section, "packing", {"poured", "struck"});
  recipe.packing = packing == "loose"    ? BedRecipe::Packing::loose
                   : packing == "dense"  ? BedRecipe::Packing::dense
                   : packing == "poured" ? BedRecipe::Packing::poured
                                         : BedRecipe::Packing::struck;
  recipe.radius = 0.5 * study.diameter;
  recipe.size_spread = size_spread;
  recipe.grains = section.integer("grains", 1, 1000000);
  recipe.length = study.diameter * section.number("length_diameters", 4, 10000);
  if (!discs) recipe.width = study.diameter * section.number("width_diameters", 4, 10000);
  if (section.has("pits")) recipe.pits = section.number("pits", 0, 0.5);
  if (section.has("calm_mgd")) recipe.calm = section.number("calm_mgd", 1e-12, 1);
  kind.number = section.integer("beds", 1, 1000);
  section.finish();
  return kind;
}

void read_sleep(YamlSection section, StudySettings& study) {
  const double speed = std::sqrt(gravity * study.diameter);
  const double contact = contact_time(study.law, 0.5 * grain_mass(study), 0.25 * study.diameter, speed);
  study.rules.sleep.speed = speed * section.number("speed_sqrt_gd", 0, 1);
  study.rules.sleep.patience = contact * section.number("patience_contacts", 1, 1e6);
  section.finish();
}

void read_impacts(YamlSection section, const std::string& file, StudySettings& study) {
  const double unit = std::sqrt(gravity * study.diameter);
  if (section.has("speeds_m_s") == section.has("speeds_sqrt_gd"))
    throw Error(file + ": impacts must have either speeds_m_s or speeds_sqrt_gd");
  if (section.has("speeds_m_s")) {
    study.speeds = list(section, "speeds_m_s", 1e-3, 1000);
  } else {
    study.speeds = list(section, "speeds_sqrt_gd", 0.1, 10000);
    for (double& speed : study.speeds) speed *= unit;
  }
  study.angles = list(section, "angles_deg", 1, 90);
  for (double& angle : study.angles) angle *= degree;
  study.size_ratios = list(section, "size_ratios", 0.1, 10);
  study.impacts = section.integer("number", 1, 1000000);
  study.rules.follow = section.number("follow_sqrt_r_g", 0.01, 1000);
  section.finish();
}

}  // namespace

StudySettings read_study(const std::string& file) {
  YamlSection root = YamlSection::load(file);
  StudySettings study;
  study.thesis_case.clear();
  study.beds.clear();
  study.name = root.text("name");
  study.dimensions = word(root, "shape", {"discs", "spheres"}) == "discs" ? 2 : 3;
  double size_spread = 0;
  read_grains(root.section("grains"), study, size_spread);
  read_contact(root.section("contact"), study);
  for (YamlSection& bed : root.sections("beds")) study.beds.push_back(read_bed(bed, study, size_spread));
  read_impacts(root.section("impacts"), file, study);
  if (root.has("sleep")) read_sleep(root.section("sleep"), study);
  if (root.has("thesis_case"))
    study.thesis_case = word(root, "thesis_case", {"A", "B", "C", "D", "E", "F", "G", "H", "I"});
  if (root.has("ejecta_number"))
    study.calibrated =
        word(root, "ejecta_number", {"as_simulated", "coarse_sand_experiment"}) != "as_simulated";
  if (root.has("filmed_impact")) study.filmed = root.integer("filmed_impact", 0, study.impacts - 1);
  root.finish();
  return study;
}

}  // namespace aeolian
