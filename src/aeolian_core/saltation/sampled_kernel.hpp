#pragma once

#include <cstdint>
#include <memory>

#include "aeolian_core/grains/grain.hpp"
#include "aeolian_core/grains/splash/splash.hpp"
#include "aeolian_core/saltation/splash_kernel.hpp"

namespace aeolian {

/// How finely a splash function is drawn.
struct SplashSampling {
  int events = 600;           ///< at each of the knots of impact speed and angle
  int speeds_per_octave = 4;  ///< bins of launch speed
  int elevations = 24;        ///< bins of launch elevation from 0 to pi, 180 degrees
  std::uint64_t seed = 1;
  /// Grains that rise slower than this, over sqrt(g d), stay in their pocket of the bed. 1.41: they do not
  /// rise by their own diameter.
  double slowest = 0.14;
};

/// Any splash function in two components of velocity: its mean numbers in bins of launch speed and elevation,
/// drawn by seed at knots of impact speed and angle, and interpolated linearly between them (four-index table
/// S of Werner 1987, sec. 4.3, case 7). The same seed gives the same kernel.
class SampledKernel : public SplashKernel {
 public:
  /// Throws Error for a sampling that is not possible and what `splash` throws.
  SampledKernel(std::shared_ptr<const Splash> splash, std::string name, const Grain& grain,
                const Atmosphere& atmosphere, const SplashSampling& sampling = {});

  std::unique_ptr<SplashKernel> clone() const override { return std::make_unique<SampledKernel>(*this); }
  std::string name() const override { return name_; }
  std::vector<double> first_spectrum() const override;
  void launch(const std::vector<double>& spectrum, Launches& launches) const override;
  void splash(const Launches& launches, double least, const Landings& landings,
              std::vector<double>& spectrum) const override;
  double number(const std::vector<double>& spectrum) const override;
  double cut_off(const std::vector<double>& spectrum) const override;
  bool extend(std::vector<double>& spectrum) override;

 private:
  void draw();

  std::shared_ptr<const Splash> splash_;
  std::string name_;
  SplashSampling sampling_;
  double slowest_;  ///< [m/s]
  std::size_t speeds_;
  std::size_t elevations_;
  std::size_t knots_ = 0;                             ///< of impact speed
  std::shared_ptr<const std::vector<double>> table_;  ///< a spectrum for each knot of speed and angle
  Launches classes_;
};

}  // namespace aeolian
