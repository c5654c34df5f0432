#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace aeolian {

/// How a bed moves between clouds: its height changes at a rate that wanders about zero with standard
/// deviation `rate_sigma` and keeps its sign for about `rate_time` (an integrated Ornstein-Uhlenbeck process,
/// the damped "Singer" model of tracking: R. A. Singer 1970, IEEE Trans. Aerosp. Electron. Syst. 6, 473-483).
struct HeightChange {
  double rate_sigma = 5.6e-5;  ///< [m/s]
  double rate_time = 67;       ///< [s]

  /// Of ripples of a wavelength [m] and height (crest to trough) [m] that migrate at a celerity [m/s]. A
  /// point of the bed then rises and sinks at the angular frequency w = 2 pi celerity / wavelength, so that
  /// rate_sigma = w height / sqrt(8). rate_time = 2.1 / w is where the stated variance of a tracked sinusoid
  /// equals its mean square error (lag plus noise) at the gains of one to ten readings a cell and second.
  static HeightChange of_ripples(double celerity, double wavelength, double height);
};

/// The step of that process over a time.
struct HeightStep {
  double height_per_rate = 0;  ///< expected change of height for a unit of rate [s]
  double rate_kept = 1;        ///< expected rate for a unit of rate
  double height_variance = 0;  ///< added by the process [m^2]
  double covariance = 0;       ///< [m^2/s]
  double rate_variance = 0;    ///< [m^2/s^2]
};

HeightStep height_step(const HeightChange& change, double seconds);

/// The same in single precision, a row of eight numbers for the filters.
struct alignas(32) FilterStep {
  FilterStep() = default;
  explicit FilterStep(const HeightStep& step)
      : height_per_rate(static_cast<float>(step.height_per_rate)),
        rate_kept(static_cast<float>(step.rate_kept)),
        height_variance(static_cast<float>(step.height_variance)),
        covariance(static_cast<float>(step.covariance)),
        rate_variance(static_cast<float>(step.rate_variance)) {}
  float height_per_rate = 0, rate_kept = 1, height_variance = 0, covariance = 0, rate_variance = 0;
  std::array<float, 3> unused{};
};

/// The steps of the times that clouds lie apart, in whole milliseconds: a few, asked for very often.
class HeightSteps {
 public:
  explicit HeightSteps(const HeightChange& change) : change_(change), steps_(slots) {}

  FilterStep after(std::uint32_t milliseconds) {
    Slot& slot = steps_[(milliseconds * 2654435769U) >> (32 - bits)];
    if (!slot.used || slot.milliseconds != milliseconds)
      slot = {FilterStep(height_step(change_, 1e-3 * milliseconds)), milliseconds, true};
    return slot.step;
  }

 private:
  static constexpr int bits = 6;
  static constexpr std::size_t slots = std::size_t{1} << bits;
  struct Slot {
    FilterStep step;
    std::uint32_t milliseconds = 0;
    bool used = false;
  };
  HeightChange change_;
  std::vector<Slot> steps_;
};

}  // namespace aeolian
