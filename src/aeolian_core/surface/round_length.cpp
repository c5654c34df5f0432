#include "aeolian_core/surface/round_length.hpp"

#include <cmath>
#include <cstdio>

namespace aeolian {

double round_below(double limit) {
  const double power = std::pow(10, std::floor(std::log10(limit) + 1e-9));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= limit * (1 + 1e-9)) return digit * power;
  return power;
}

std::string round_length_text(double metres) {
  char text[64];
  if (metres >= 1000)
    std::snprintf(text, sizeof(text), "%.3g km", metres / 1000);
  else if (metres >= 1)
    std::snprintf(text, sizeof(text), "%.3g m", metres);
  else if (metres >= 0.01)
    std::snprintf(text, sizeof(text), "%.3g cm", metres * 100);
  else
    std::snprintf(text, sizeof(text), "%.3g mm", metres * 1000);
  return text;
}

}  // namespace aeolian
