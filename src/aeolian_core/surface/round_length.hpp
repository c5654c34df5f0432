#pragma once

#include <string>

namespace aeolian {

/// For scale bars and ticks: 1, 2 or 5 times a power of ten, at most `limit`, which is positive.
double round_below(double limit);

/// A length [m] of a scale bar, three digits and the unit that suits it: "20 cm".
std::string round_length_text(double metres);

}  // namespace aeolian
