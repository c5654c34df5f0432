#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "aeolian_core/saltation/flight.hpp"

namespace aeolian {

/// A splash function as the steady state needs it: linear, from grains that land to the mean number that
/// leaves in each class (Werner 1987, eq. 4.6).
///
/// What leaves is a spectrum: numbers whose meaning is the kernel's own, of which the first `classes_counted`
/// add up to the number of grains. Spectra may be added and multiplied by numbers.
class SplashKernel {
 public:
  virtual ~SplashKernel() = default;
  virtual std::unique_ptr<SplashKernel> clone() const = 0;
  virtual std::string name() const = 0;

  /// A spectrum to begin with, of one grain in all.
  virtual std::vector<double> first_spectrum() const = 0;
  /// The grains that a spectrum stands for, in classes.
  virtual void launch(const std::vector<double>& spectrum, Launches& launches) const = 0;
  /// The spectrum that leaves when the grains of `launches` above `least` land; writes all of `spectrum`.
  virtual void splash(const Launches& launches, double least, const Landings& landings,
                      std::vector<double>& spectrum) const = 0;
  /// Grains that a spectrum stands for.
  virtual double number(const std::vector<double>& spectrum) const = 0;
  /// The part of a spectrum that is at its fast end, relative to its largest: above 1e-4 the end cuts off
  /// grains that matter.
  virtual double cut_off(const std::vector<double>& spectrum) const = 0;
  /// Moves the fast end outwards by half and makes the spectrum one of the longer kind. False where
  /// velocities would become absurd.
  virtual bool extend(std::vector<double>& spectrum) = 0;

 protected:
  /// A spectrum of the same shape that is one grain in all.
  std::vector<double> of_one_grain(std::vector<double> spectrum) const {
    const double sum = number(spectrum);
    for (double& p : spectrum) p /= sum;
    return spectrum;
  }
};

}  // namespace aeolian
