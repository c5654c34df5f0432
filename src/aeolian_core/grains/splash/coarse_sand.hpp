#pragma once

#include <array>
#include <memory>

#include "aeolian_core/grains/grain.hpp"
#include "aeolian_core/grains/splash/draws.hpp"
#include "aeolian_core/grains/splash/splash.hpp"

namespace aeolian {

/// One setting of Werner's experiment with coarse sand of 0.78 mm (1987, tables 3.11 and 3.12; splash
/// specification, sec. 5.7). Means with their half-widths; what the scan left unreadable is as the
/// specification says. Angles of ejecta are from the vertical, forward positive.
struct CoarseSandRow {
  struct Spread {
    double mean, half_width;
  };
  double speed;  ///< [cm/s]
  double angle;  ///< [degrees]
  int events, ejecta;
  Spread along;         ///< eps_ix
  Spread upward;        ///< eps_iy
  Spread number;        ///< ejecta of an event
  Spread ejecta_up;     ///< their vertical speed [cm/s]
  Spread direction;     ///< their angle [degrees]
  double energy_ratio;  ///< kinetic energy that leaves over that of the impact
  double reptation;     ///< of one grain [cm]
};

/// The six settings at 15 to 16 degrees, by speed, and then those at 12, 10 and 21.
const std::array<CoarseSandRow, 9>& coarse_sand_rows();

constexpr double coarse_sand_diameter = 0.00078;  ///< [m]

/// Where an impact lies among the settings, as what one draw takes: settings are chosen at random with the
/// weights of linear interpolation in speed and angle, never averaged. Speeds are over sqrt(g d).
class CoarseSandSettings {
 public:
  struct Place {
    std::size_t node;
    double slope_factor;  ///< what eps_iy is multiplied with beyond the angles measured
  };
  struct Node {
    TruncatedNormal along, upward;
    CountDistribution number;
    LogNormal ejecta_up;        ///< over sqrt(g d)
    TruncatedNormal direction;  ///< [rad]
    double correlation;         ///< of the logarithm of the upward speed with the direction
    double mean_number;

    struct Ejectum {
      double away, direction;  ///< over sqrt(g d), [rad]
    };
    Ejectum draw_ejectum(RandomStream& random) const;
  };

  static const CoarseSandSettings& instance();

  Place choose(double speed, double angle, RandomStream& random) const;
  const Node& node(std::size_t index) const { return nodes_[index]; }
  double mean_number(double speed, double angle) const;
  /// What the number of ejecta is multiplied with beyond the speeds measured: as 0.0070 v - 2.4 [cm/s], which
  /// is zero below 39 sqrt(g d).
  double beyond(double speed) const;

 private:
  CoarseSandSettings();
  struct Interval {
    std::size_t low;
    double share;  ///< of the next
  };
  Interval speed_interval(double speed) const;
  Interval angle_interval(double angle) const;

  std::array<double, 6> speeds_;
  std::array<double, 5> angles_;
  std::array<Node, 24> nodes_;  ///< by angle (10, 12, 15 and 16, 21 degrees) and speed
};

/// Rebound of the experiment: normal eps_ix and eps_iy with the means and half-widths of each setting, cut
/// off so that no grain comes out faster than it went in or goes down. Beyond 10 and 21 degrees eps_iy goes
/// on as 0.266 / sin(angle) - 0.262. Backward rebounds exist. Measured on a rough, level bed in the plane of
/// the camera, at 650 to 1200 cm/s; other speeds and sizes take the nearest v / sqrt(g d).
class CoarseSandRebound : public Rebound {
 public:
  explicit CoarseSandRebound(const Grain& grain);
  std::optional<LeavingGrain> sample(const Impact& impact, RandomStream& random) const override;

 private:
  double unit_;
};

/// Ejecta of the experiment: number with mean and half-width of each setting; upward speeds log-normal with
/// theirs and hardly dependent on the impact's; normal angles, correlated with the speeds so that the mean
/// reptation of a grain is that of the setting (fast ejecta leave far forward). All in the plane of flight,
/// where they were measured. Speeds scale with sqrt(g d).
class CoarseSandEjection : public Ejection {
 public:
  explicit CoarseSandEjection(const Grain& grain);
  double mean_number(const Impact& impact) const override;
  void sample(const Impact& impact, RandomStream& random, std::vector<LeavingGrain>& ejecta) const override;

 private:
  double unit_;
};

}  // namespace aeolian
