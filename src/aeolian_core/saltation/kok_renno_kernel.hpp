#pragma once

#include <cmath>

#include "aeolian_core/grains/grain.hpp"
#include "aeolian_core/saltation/splash_kernel.hpp"

namespace aeolian {

/// Constants of the splash of Kok & Renno (2009), COMSALT. Angles are above the horizontal, downwind.
struct KokRennoConstants {
  double rebound_probability = 0.96;  ///< of fast impacts; P = 0.96 (1 - exp(-v / v_r))
  double rebound_speed = 1;           ///< v_r [m/s]
  double energy_kept = 0.45;          ///< mean part of a rebound's kinetic energy
  double energy_spread = 0.22;        ///< its standard deviation
  double rebound_angle = 0.698;       ///< mean, exponential, 40 degrees [rad]
  double ejecta_coefficient = 0.02;   ///< a: N = a v / sqrt(g d)
  double ejecta_momentum = 0.141;     ///< b, of the impact's: mean speed b / a sqrt(g d); (1 - 0.648) / 2.5
  double ejecta_onset = 40;           ///< that mean times 1 - exp(-v / (40 sqrt(g d))); zero: always full
  double ejecta_angle = 0.873;        ///< mean, exponential, 50 degrees [rad]
  /// Angles end here [rad]. Up to pi, as COMSALT draws them, grains leave backwards, too, and impacts come at
  /// 17 rather than 14 degrees.
  double steepest = M_PI_2;
  double slowest = 0.14;  ///< launches are counted from this speed on, over sqrt(g d)
  /// D [m] of a bed of several sizes: ejecta follow sqrt(g D), from impacts by grains of the kernel's size
  /// onto the same. Zero: the grain's own.
  double bed_diameter = 0;
};

/// Kok & Renno's splash (KokRennoRebound, KokRennoEjection) without its rejection of single impacts that
/// break conservation: two spectra of speed, of rebounds and of ejecta, each with its distribution of angles.
/// The numbers that leave depend on the impact's speed alone.
class KokRennoKernel : public SplashKernel {
 public:
  /// `grain` and gravity set the scale sqrt(g d). Throws Error naming a constant that is not physical.
  KokRennoKernel(const Grain& grain, const Atmosphere& atmosphere, const KokRennoConstants& constants = {},
                 int speeds_per_octave = 4, int angles = 14);

  std::unique_ptr<SplashKernel> clone() const override { return std::make_unique<KokRennoKernel>(*this); }
  std::string name() const override { return "kok_renno"; }
  std::vector<double> first_spectrum() const override;
  void launch(const std::vector<double>& spectrum, Launches& launches) const override;
  void splash(const Launches& launches, double least, const Landings& landings,
              std::vector<double>& spectrum) const override;
  double number(const std::vector<double>& spectrum) const override;
  double cut_off(const std::vector<double>& spectrum) const override;
  bool extend(std::vector<double>& spectrum) override;

  /// Impacts by speed, at knots that are the same for all kernels: classes [first, last) whose number is
  /// above `least`, added up.
  static void count_impacts(const Launches& launches, std::size_t first, std::size_t last, double least,
                            const Landings& landings, std::vector<double>& impacts);
  static std::size_t knots();
  /// The spectrum of impacts counted so, of which some rebound and some throw up grains; writes all of it.
  void splash(const std::vector<double>& rebounding, const std::vector<double>& ejecting,
              std::vector<double>& spectrum) const;

  /// The part of a spectrum's grains that are rebounds.
  double rebound_share(const std::vector<double>& spectrum) const;

 private:
  void set_bins(std::size_t bins);

  KokRennoConstants c_;
  double scale_;    ///< sqrt(g d) [m/s], of ejecta
  double slowest_;  ///< vertical speed of a launch [m/s]
  int speeds_per_octave_;
  std::size_t angles_;
  std::size_t bins_ = 0;
  std::vector<double> edge_;                        ///< of the bins of speed [m/s]
  Launches classes_;                                ///< velocities of all
  std::vector<double> rebound_part_, ejecta_part_;  ///< of a bin in each angle, of those that escape
  std::vector<double> table_;                       ///< spectrum of one impact at each knot of speed
};

}  // namespace aeolian
