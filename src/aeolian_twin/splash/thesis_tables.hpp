#pragma once

#include <optional>
#include <string>

namespace aeolian {

/// A number of a table of Werner (1987), ch. III, and the half-width of its distribution.
struct PrintedValue {
  double mean;
  double half_width;
};

/// Tables 3.2, 3.3, 3.4, 3.5 and 3.9 for a case, A to I, by the names of summary.csv: SI units and degrees.
/// None where the thesis has no number.
std::optional<PrintedValue> printed_value(const std::string& thesis_case, const std::string& quantity);

}  // namespace aeolian
