#pragma once

#include "aeolian_core/grains/impacts/bed_packing.hpp"

namespace aeolian {

/// Soft discs of the thesis' size and density: a contact takes ten times as long as there.
inline GrainWorld<2> soft_discs() {
  GrainWorld<2> world;
  world.law = ContactLaw::spring(6e4, 0.85, 0.5 * 2000 * M_PI * 1e-6, 0.5);
  world.steps_per_contact = 24;
  return world;
}

inline GrainWorld<3> soft_spheres() {
  GrainWorld<3> world;
  world.law = ContactLaw::spring(6e4, 0.85, 0.5 * 2000 * 4. / 3 * M_PI * 1e-6, 0.5);
  world.steps_per_contact = 24;
  return world;
}

/// Eight layers of twenty grains.
inline BedRecipe small_recipe(BedRecipe::Packing packing = BedRecipe::Packing::loose) {
  BedRecipe recipe;
  recipe.packing = packing;
  recipe.grains = 160;
  recipe.length = 0.42;
  recipe.calm = 1e-5;
  return recipe;
}

}  // namespace aeolian
