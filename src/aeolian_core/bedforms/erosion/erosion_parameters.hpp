#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "aeolian_core/bedforms/height_map/ripple_model.hpp"
#include "aeolian_core/saltation/atmosphere.hpp"

namespace aeolian {

/// How parcels get from where they leave the bed to where they come down.
enum class FlightMode {
  integrated,  ///< step by step through the wind over the surface
  hop_table,   ///< looked up for the wind of their cell; the terrain is walked along the arc
};

/// Where the wind lifts.
enum class Shelter {
  ray,    ///< where rays fall that come down at the shelter angle, as many as fall there
  slope,  ///< evenly wherever the bed does not fall downwind, however little (Szabo 2019, sec. 3.1)
};

/// What becomes of a parcel that hits the bed.
enum class BounceLaw {
  measured,    ///< restitution of Beladjine et al. (2007), capture of Anderson & Haff (1991)
  attenuated,  ///< fixed parts of normal and tangential velocity, capture below a speed (Szabo 2019, 3.9)
};

/// How grains leave the bed (specification sec. 2.3): vertical speed B u*, at an angle phi above the ground.
struct LiftOff {
  double least_factor = 0.8;  ///< of B, uniform
  double most_factor = 2.0;
  double least_angle = 21 * M_PI / 180;  ///< of phi, uniform [rad]
  double most_angle = 89 * M_PI / 180;
  double lateral_spread = 3 * M_PI / 180;  ///< standard deviation about the wind's direction [rad]
};

/// Constants of both bounce laws (specification sec. 2.5). Parcels that lose fixed parts stop within a few
/// hops, which makes ripples; as measured they go on for some twenty.
struct Bounce {
  BounceLaw law = BounceLaw::attenuated;
  double normal_kept = 0.3;      ///< f_atten of the attenuated law
  double tangential_kept = 0.6;  ///< f_frac
  double capture_speed = 0.3;    ///< slower parcels stay, in both laws [m/s]
  double rebound_share = 0.95;   ///< of fast impacts that rebound; share (1 - exp(-v / rebound_speed))
  double rebound_speed = 0.5;    ///< [m/s]
  /// Whether impacts push others: N_e = 13 (1 - e^2) (v / (40 sqrt(g d)) - 1) grains for each, one mean
  /// reptation length on (the successive saltation of Wang & Hu 2012).
  bool push = false;
};

/// Snow bonds with age: what is not moved sinters and needs more wind (specification sec. 3.5).
struct SnowBonding {
  double temperature = -12;          ///< of the snow [deg C]; at melting the pattern freezes for good
  double bonding_time = 24 * 3600;   ///< t_b, to full bonds at the reference temperature and colder [s]
  double reference = -20;            ///< [deg C]
  double activation_energy = 60000;  ///< of the Arrhenius law by which warmer snow bonds faster [J/mol]
  /// degree = (age / t_b)^exponent: what a bond holds goes with its area, twice the exponent 0.18 by which
  /// the ratio of bond to grain grows (van Herwijnen & Miller 2013).
  double exponent = 0.36;
  double fresh_cohesion = 4;     ///< gamma of fresh snow over that of sand
  double bonded_cohesion = 32;   ///< and of fully bonded snow
  double skin = 4;               ///< thickness whose mean age is that of the surface [parcels]
  double edge = 2;               ///< least height of an exposed edge of sintered snow [parcels]
  double sintered_share = 0.05;  ///< of the lift-off from loose snow, at an edge above its threshold
  double initial_age = 0;        ///< of the loose snow of a new map [s]
  double snowfall = 0;           ///< [kg m^-2 s^-1]
};

/// All of it in SI units and radians.
struct ErosionParameters {
  FlightMode flight = FlightMode::integrated;
  Border border = Border::periodic;
  double inflow = 0;  ///< over open borders from upwind, in parts of the saturated flux
  Shelter shelter = Shelter::ray;
  double shelter_angle = 12 * M_PI / 180;
  bool slope_threshold = true;  ///< whether the threshold rises upslope and falls downslope
  /// Threshold of loose grains where others hit them, over that of the wind alone (Bagnold 1941: 0.8; Schmidt
  /// 1980 for snow). It holds while anything comes down.
  double impact_threshold = 0.8;
  LiftOff lift_off;
  Bounce bounce;
  Atmosphere air{1.225, 1.5e-5, 9.81};
  double cohesion = 3.0e-4;  ///< gamma of the threshold by Shao & Lu [kg/s^2]
  double roughness = 0;      ///< z0 of the bed at rest [m]; zero: a thirtieth of a grain
  /// Whether grains in the air make the wind's roughness at least 0.02 u*^2 / (2 g) (specification, trap 9).
  bool saltation_roughness = false;

  double parcel_thickness = 0;  ///< q, of a cell that a parcel takes away [m]; zero: a grain's diameter
  /// Whether a parcel leaves and joins the four cells about its place, with bilinear weights; else the
  /// nearest.
  bool spread = true;
  double acceleration = 50;  ///< time of the bed over that of the flights: what one parcel stands for
  double step = 1e-3;        ///< of the flight [s]; divided where cells or hops ask for it
  int slide_every = 10;      ///< steps between sweeps of avalanches
  int slide_sweeps = 4;      ///< at most, each time
  /// If set, so many parcels per cell exist, every idle one tries each step with this chance to leave, and
  /// time is what the transported volume takes at the saturated flux (Szabo's loop); `acceleration` is
  /// then not used.
  struct Pool {
    double parcels_per_cell = 200000.0 / 65536;
    double chance = 0.004;
  };
  std::optional<Pool> pool;

  std::optional<SnowBonding> snow;  ///< none: sand
  std::uint64_t seed = 1;
};

/// Throws Error naming the parameter that is not allowed.
void check(const ErosionParameters& parameters);

/// The literal model of Szabo (2019) with its mistakes of units corrected: shelter by the slope alone,
/// bounces that lose fixed parts, no push, no spread, 200 000 parcels on 256 x 256 cells, a third of them in
/// the air.
ErosionParameters thesis_erosion();

}  // namespace aeolian
