#pragma once

#include "aeolian_core/bedforms/height_map/ripple_model.hpp"
#include "aeolian_core/bedforms/sorting/sorted_forcing.hpp"

namespace aeolian {

/// What a grid does not resolve of a bed under impacts, as one rms height r per cell.
///
/// Mottling: each grain set moving leaves a pit and makes a bump of one effective diameter d at random, and
/// neighbours level them out until r is about d (an assumption; the bed of Werner 1987, ch. V, was mottled to
/// about a grain after 5 to 10 s, a few times d / K0): d(r^2)/dt = 2 K0 d (1 - r^2 / d^2).
///
/// Ripples, where cells are too wide for the fastest-growing ones: from mottling on they grow at that mode's
/// rate s by linear theory, until they are as high as an index allows: d(r^2)/dt gains 2 s r^2 (1 - r^2 /
/// r_m^2), and mottling goes on only below d. Logistic saturation and seeding by mottling are assumptions.
struct RoughnessLaw {
  double grain = 0;       ///< d [m]
  double mottling = 0;    ///< K0 d [m^2/s]
  double growth = 0;      ///< s [1/s]; zero where ripples are resolved or do not grow
  double ripples = 0;     ///< r_m [m]
  double wavelength = 0;  ///< of the fastest-growing ripples [m]

  /// r after `duration` [s] from `roughness` [m], exactly.
  double after(double roughness, double duration) const;
  /// r in the end [m].
  double steady() const;
};

struct RoughnessParameters {
  double index = 17;            ///< wavelength over height of mature ripples, 15 to 20 (Werner 1987, ch. I)
  double cells_per_ripple = 8;  ///< from which on a grid resolves ripples
};

/// The law in cells of so many metres, whose surface is coarse to this fraction; of the mixture's mean
/// diameter, erosion rate and flux.
RoughnessLaw roughness_law(const SortedForcing& forcing, double coarse_fraction, double cell,
                           const RippleParameters& ripples, const RoughnessParameters& parameters = {});

/// Moves the layer `roughness` of a map on, from a smooth bed where it is absent or unknown; unknown where
/// the elevation is. Composition is that of the layer `coarse_fraction`, without it all sand is fine. All
/// cells are taken to be as exposed as a flat bed. Throws Error for a roughness that is negative.
void advance_roughness(HeightMap& map, const SortedForcing& forcing, double duration,
                       const RippleParameters& ripples, const RoughnessParameters& parameters = {});

/// The aerodynamic roughness length [m] of a bed of rms roughness r: of its grains, r / 30 up to their height
/// (Nikuradse 1933: k_s / 30, with k_s of a mottled bed one grain, as SaltatingBed has it), and of ripples of
/// the variance beyond, of height H = sqrt(8 (r^2 - d^2)): 0.5 H^2 / wavelength (Lettau 1969: half the height
/// times frontal over plan area). That both add up is an assumption. For a wind without saltating grains, and
/// ridges apart enough not to shelter one another (H / wavelength below about 0.1).
double aerodynamic_roughness(double roughness, const RoughnessLaw& law);

/// The same for the layer `roughness` of a map as one number for the wind over all of it: the geometric mean
/// of the cells that have any (Taylor 1987: neutral surface layers average ln z0). Throws Error where none
/// has.
double aerodynamic_roughness(const HeightMap& map, const SortedForcing& forcing,
                             const RippleParameters& ripples, const RoughnessParameters& parameters = {});

}  // namespace aeolian
