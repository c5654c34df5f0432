#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace aeolian {

/// The common look of the report's plots, and the names of its colours.
extern const char* const plot_style;

/// One curve, with quartiles or without.
struct Curve {
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> lower;
  std::vector<double> upper;

  bool has_value() const;  ///< whether any y is finite
  double largest() const;  ///< finite y, 0 without any
  Curve scaled(double factor_x, double factor_y) const;
};

/// Writes a curve's columns as the data block $name; infinities are left blank like NaN.
void write_data(std::ostream& out, const std::string& name, const Curve& curve);

/// The round step that divides a positive range into about four.
double tic_step(double range);

}  // namespace aeolian
