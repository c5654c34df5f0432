#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "aeolian_core/grains/impacts/impact_study.hpp"

namespace aeolian {

/// Beds of one recipe.
struct BedKind {
  BedRecipe recipe;
  int number = 8;
};

/// What a study does: a file of config/splash in numbers. Made like this, CASE A of Werner (1987), ch. III.
struct StudySettings {
  std::string name = "CASE A";    ///< what the pictures call it
  std::string thesis_case = "A";  ///< A to I, whose numbers stand beside the study's; empty: none
  int dimensions = 2;             ///< 2: discs, 3: spheres
  double diameter = 0.02;         ///< of the bed's grains [m]
  double density = 2000;          ///< [kg/m^3]
  ContactLaw law;
  double steps_per_contact = 36;
  std::vector<BedKind> beds{{}};
  std::vector<double> speeds{30};         ///< [m/s]
  std::vector<double> angles{M_PI / 12};  ///< [rad]
  std::vector<double> size_ratios{1};     ///< grain that is fired over those of the bed
  int impacts = 80;                       ///< of each speed, angle, size ratio and kind of bed
  ImpactRules rules;
  std::uint64_t seed = 1;
  bool calibrated = false;  ///< number of ejecta of the table: that of the coarse-sand experiment
  int filmed = 0;           ///< number of the impact that the pictures show

  /// The grains' world, without walls.
  template <int Dim>
  GrainWorld<Dim> world() const {
    GrainWorld<Dim> result;
    result.law = law;
    result.density = density;
    result.thickness = 0.5 * diameter;  // as the thesis': 1 cm for grains of radius 1 cm
    result.steps_per_contact = steps_per_contact;
    return result;
  }
};

/// Reads a study, e.g. config/splash/werner_case_a.yaml. Throws Error naming file, line, key, value and what
/// is allowed.
StudySettings read_study(const std::string& file);

}  // namespace aeolian
