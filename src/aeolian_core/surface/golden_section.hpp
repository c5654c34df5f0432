#pragma once

namespace aeolian {

/// Where a function with one minimum between `low` and `high` has it: golden section (Kiefer 1953), each step
/// with one more value of the function, until the bracket is no wider than `enough`.
template <class Function>
double minimum_between(double low, double high, double enough, Function&& value) {
  constexpr double golden = 0.6180339887498949;
  double a = high - golden * (high - low);
  double b = low + golden * (high - low);
  double at_a = value(a);
  double at_b = value(b);
  while (high - low > enough) {
    if (at_a < at_b) {
      high = b;
      b = a;
      at_b = at_a;
      at_a = value(a = high - golden * (high - low));
    } else {
      low = a;
      a = b;
      at_a = at_b;
      at_b = value(b = low + golden * (high - low));
    }
  }
  return (low + high) / 2;
}

}  // namespace aeolian
