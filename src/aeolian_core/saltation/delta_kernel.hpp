#pragma once

#include "aeolian_core/grains/grain.hpp"
#include "aeolian_core/saltation/splash_kernel.hpp"

namespace aeolian {

/// The splash of Ungar & Haff (1987) and UngarHaffEjection: all grains leave straight up at one speed, and
/// their number grows as the energy of the impact.
class DeltaKernel : public SplashKernel {
 public:
  /// `coefficient`: grains for (v / sqrt(g d))^2; `speed` over sqrt(g d). Throws Error where they are not
  /// positive and finite.
  DeltaKernel(const Grain& grain, const Atmosphere& atmosphere, double coefficient = 3.924e-4,
              double speed = 16.15);

  std::unique_ptr<SplashKernel> clone() const override { return std::make_unique<DeltaKernel>(*this); }
  std::string name() const override { return "ungar_haff"; }
  std::vector<double> first_spectrum() const override { return {1}; }
  void launch(const std::vector<double>& spectrum, Launches& launches) const override;
  void splash(const Launches& launches, double least, const Landings& landings,
              std::vector<double>& spectrum) const override;
  double number(const std::vector<double>& spectrum) const override { return spectrum[0]; }
  double cut_off(const std::vector<double>&) const override { return 0; }
  bool extend(std::vector<double>&) override { return false; }

 private:
  double scale_;  ///< sqrt(g d) [m/s]
  double coefficient_, speed_;
};

}  // namespace aeolian
