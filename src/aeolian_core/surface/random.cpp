#include "aeolian_core/surface/random.hpp"

#include <cmath>

namespace aeolian {

double RandomStream::exponential() { return -std::log(uniform()); }

double RandomStream::normal() {
  const double radius = std::sqrt(-2 * std::log(uniform()));
  return radius * std::cos(2 * M_PI * uniform());
}

}  // namespace aeolian
