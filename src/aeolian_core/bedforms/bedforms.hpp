#pragma once

/// The room `bedforms`: how impacts reshape the bed.
///
/// Ripples after Werner (1987), ch. V-VI and later theory: a height-map model that is fast enough to forecast
/// a live plot, and a bed of single grains on a lattice that is the truth to test against. Both stand behind
/// `BedModel`. Beside them stand Haff's bed of height bins and the theory of ripples that collide and merge.
/// Sand of two sizes has a model of its own, made of the same pieces: `SortedRippleModel`.

#include "aeolian_core/bedforms/avalanche.hpp"
#include "aeolian_core/bedforms/bed_model.hpp"
#include "aeolian_core/bedforms/exposure.hpp"
#include "aeolian_core/bedforms/haff_bed.hpp"
#include "aeolian_core/bedforms/haff_model.hpp"
#include "aeolian_core/bedforms/lattice_bed.hpp"
#include "aeolian_core/bedforms/lattice_model.hpp"
#include "aeolian_core/bedforms/lattice_slice.hpp"
#include "aeolian_core/bedforms/merger_theory.hpp"
#include "aeolian_core/bedforms/periodic_profile.hpp"
#include "aeolian_core/bedforms/ripple_collision.hpp"
#include "aeolian_core/bedforms/ripple_growth.hpp"
#include "aeolian_core/bedforms/ripple_kinematics.hpp"
#include "aeolian_core/bedforms/ripple_model.hpp"
#include "aeolian_core/bedforms/sorted_growth.hpp"
#include "aeolian_core/bedforms/sorted_ripple_model.hpp"
#include "aeolian_core/bedforms/sub_grid_roughness.hpp"
#include "aeolian_core/bedforms/triangular_ripple.hpp"
#include "aeolian_core/bedforms/wavelength_law.hpp"
#include "aeolian_core/bedforms/worm_model.hpp"
