#pragma once

#include "aeolian_core/grains/splash/distribution_splash.hpp"
#include "aeolian_core/saltation/splash_kernel.hpp"

namespace aeolian {

/// DistributionSplash (Werner 1987, eq. 4.34, as printed) in bins of vertical launch speed, by exact
/// integrals over each. With c6 > 0 a bin carries the mean v_ox of the impacts that feed it.
class DistributionKernel : public SplashKernel {
 public:
  /// Bins of `width` from zero to `top` [m/s]; launches below `slowest` [m/s] stay in their pocket. Throws
  /// Error naming a parameter that is not physical.
  explicit DistributionKernel(const DistributionSplash::Parameters& parameters, double width = 0.05,
                              double top = 3, double slowest = 0);

  std::unique_ptr<SplashKernel> clone() const override { return std::make_unique<DistributionKernel>(*this); }
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

  DistributionSplash::Parameters p_;
  double width_;
  double slowest_;
  std::size_t bins_ = 0;
  std::vector<double> ejecta_;  ///< of each bin for one (m/s)^2 of impact
};

}  // namespace aeolian
