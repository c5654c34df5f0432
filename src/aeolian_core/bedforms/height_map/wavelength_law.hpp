#pragma once

#include <memory>
#include <string>

#include "aeolian_core/bedforms/bed_model.hpp"

namespace aeolian {

/// The wavelength at which ripples stop growing. The literature disagrees on it, so it is a choice.
class WavelengthLaw {
 public:
  virtual ~WavelengthLaw() = default;
  /// [m]; zero or less where ripples do not outgrow their first wavelength.
  virtual double final_wavelength(const Forcing& forcing) const = 0;
};

/// A number of grain diameters whatever the wind: 200-300 (Werner 1987, ch. I); about 200 by the mechanics of
/// grain and bed (Nature Geoscience 2025).
class ConstantWavelength : public WavelengthLaw {
 public:
  /// Throws Error for a number that is not positive and finite.
  explicit ConstantWavelength(double diameters);
  double final_wavelength(const Forcing& forcing) const override;

 private:
  double diameters_;
};

/// Linear in the wind, zero at the impact threshold u*_it: n d (u* / u*_it - 1), as final wavelengths in a
/// tunnel and on dunes are linear (Andreotti, Claudin & Pouliquen 2006). n is the constant law's number at
/// twice the threshold. The slope is no measured one of final wavelengths: only initial ones were at hand,
/// from a secondary source (15, 45 and 85 mm at 0.35, 0.51 and 0.65 m/s).
class LinearWavelength : public WavelengthLaw {
 public:
  /// Throws Error for a number that is not positive and finite.
  explicit LinearWavelength(double diameters_at_twice_threshold);
  /// Throws Error for a forcing that does not tell its friction velocity.
  double final_wavelength(const Forcing& forcing) const override;

 private:
  double diameters_;
};

/// The law of a name: `none` (null: ripples grow without end), `constant` or `linear`. Throws Error for
/// another name.
std::shared_ptr<const WavelengthLaw> make_wavelength_law(const std::string& name, double diameters);

}  // namespace aeolian
