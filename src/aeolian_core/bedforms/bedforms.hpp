#pragma once

/// The room `bedforms`: how impacts reshape the bed.
///
/// Ripples after Werner (1987), ch. V-VI and later theory, behind one interface, `BedModel`:
/// - height_map/: `RippleModel`, fast enough to forecast a live plot;
/// - sorting/: `SortedRippleModel`, the same for sand of two sizes, with strata; roughness below the grid;
/// - lattice/: beds of single grains, the truth to test against, and Haff's bed of height bins;
/// - erosion/: `ParticleErosion`, sand or snow blown in parcels over hard ground;
/// - theory/: ripples that collide and merge.

#include "aeolian_core/bedforms/bed_model.hpp"
#include "aeolian_core/bedforms/erosion/drift_laws.hpp"
#include "aeolian_core/bedforms/erosion/hop_table.hpp"
#include "aeolian_core/bedforms/erosion/particle_erosion.hpp"
#include "aeolian_core/bedforms/erosion/snow_cover.hpp"
#include "aeolian_core/bedforms/height_map/avalanche.hpp"
#include "aeolian_core/bedforms/height_map/exposure.hpp"
#include "aeolian_core/bedforms/height_map/ripple_growth.hpp"
#include "aeolian_core/bedforms/height_map/ripple_model.hpp"
#include "aeolian_core/bedforms/height_map/wavelength_law.hpp"
#include "aeolian_core/bedforms/lattice/haff_bed.hpp"
#include "aeolian_core/bedforms/lattice/haff_model.hpp"
#include "aeolian_core/bedforms/lattice/lattice_bed.hpp"
#include "aeolian_core/bedforms/lattice/lattice_model.hpp"
#include "aeolian_core/bedforms/lattice/lattice_slice.hpp"
#include "aeolian_core/bedforms/sorting/sorted_growth.hpp"
#include "aeolian_core/bedforms/sorting/sorted_ripple_model.hpp"
#include "aeolian_core/bedforms/sorting/sub_grid_roughness.hpp"
#include "aeolian_core/bedforms/theory/merger_theory.hpp"
#include "aeolian_core/bedforms/theory/periodic_profile.hpp"
#include "aeolian_core/bedforms/theory/ripple_collision.hpp"
#include "aeolian_core/bedforms/theory/ripple_kinematics.hpp"
#include "aeolian_core/bedforms/theory/triangular_ripple.hpp"
#include "aeolian_core/bedforms/theory/worm_model.hpp"
