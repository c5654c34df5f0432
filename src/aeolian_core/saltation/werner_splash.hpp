#pragma once

#include "aeolian_core/saltation/splash_kernel.hpp"

namespace aeolian {

/// Constants of Werner's splash function (1987, eq. 4.34), v_i = (v_ix, -v_iy) the impact's velocity:
///
///     S = c1 / (c2 sqrt(2 pi)) v_ix / (v_ix + c5) exp(-(v_oy - f v_ix - eps v_iy)^2 / (2 c2^2))
///         + c3 (v_ix^2 + v_iy^2) exp(-v_oy / c4),  all with v_ox = c6 eps (1 - f) v_ix.
struct WernerSplashConstants {
  double c1 = 2;
  double c2 = 0.35;  ///< [m/s]
  double c3 = 0.2;   ///< [(m/s)^-3]
  double c4 = 0.4;   ///< [m/s]
  double c5 = 2.75;  ///< [m/s]
  double c6 = 0;
  double restitution = 0.7;  ///< eps
  double conversion = 0.1;   ///< f, of horizontal into vertical velocity

  /// Cases 1 to 6 of Werner's table 4.3. Throws Error for others.
  static WernerSplashConstants thesis_case(int number);
};

/// Eq. 4.34 in bins of vertical launch speed. With c6 > 0 a bin carries the mean v_ox of the impacts that
/// feed it.
class WernerSplash : public SplashKernel {
 public:
  /// Bins of `width` from zero to `top` [m/s]; launches below `slowest` [m/s] stay in their pocket. Throws
  /// Error naming a constant that is not physical.
  explicit WernerSplash(const WernerSplashConstants& constants, double width = 0.05, double top = 3,
                        double slowest = 0);

  std::unique_ptr<SplashKernel> clone() const override { return std::make_unique<WernerSplash>(*this); }
  std::string name() const override { return "werner"; }
  std::vector<double> first_spectrum() const override;
  void launch(const std::vector<double>& spectrum, Launches& launches) const override;
  void splash(const Launches& launches, double least, const Landings& landings,
              std::vector<double>& spectrum) const override;
  double number(const std::vector<double>& spectrum) const override;
  double cut_off(const std::vector<double>& spectrum) const override;
  bool extend(std::vector<double>& spectrum) override;

 private:
  void set_bins(std::size_t bins);

  WernerSplashConstants c_;
  double width_;
  double slowest_;
  std::size_t bins_ = 0;
  std::vector<double> ejecta_;  ///< of each bin for one (m/s)^2 of impact
};

}  // namespace aeolian
