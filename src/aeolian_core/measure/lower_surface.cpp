#include "aeolian_core/measure/lower_surface.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {
namespace {

constexpr double least_support = 0.3;  // of the fullest window
constexpr int most_rounds = 10;

/// The samples from `first` on within twice the gate's reach above it.
const Sample* end_of_window(const Sample* first, const Sample* from, const Sample* end,
                            const SurfaceGate& gate) {
  const double reach = 2 * std::sqrt(gate.squared_reach(first->weight())) * fixed::steps_per_metre;
  const auto top = static_cast<std::int64_t>(first->height()) + static_cast<std::int64_t>(reach);
  const Sample* last = std::max(from, first + 1);
  while (last != end && last->height() <= top) ++last;
  return last;
}

}  // namespace

SurfaceSum whole_surface(const Sample* begin, const Sample* end) {
  SurfaceSum sum;
  sum.datum = begin->height();
  std::for_each(begin, end, [&](Sample sample) { sum.add(sample); });
  return sum;
}

SurfaceSum lower_surface(const Sample* begin, const Sample* end, const SurfaceGate& gate) {
  std::ptrdiff_t fullest = 0;
  const Sample* last = begin;
  for (const Sample* first = begin; first != end; ++first) {
    last = end_of_window(first, last, end, gate);
    fullest = std::max(fullest, last - first);
  }
  const Sample* first = begin;
  const Sample* window = begin;
  const auto is_supported = [&] {
    window = end_of_window(first, window, end, gate);
    return static_cast<double>(window - first) >= least_support * static_cast<double>(fullest);
  };
  while (!is_supported()) ++first;

  SurfaceSum sum = whole_surface(first, window);
  for (int round = 0; round < most_rounds; ++round) {
    const double centre = sum.height();
    SurfaceSum next;
    next.datum = first->height();
    std::for_each(first, end, [&](Sample sample) {
      const double distance = fixed::metres(sample.height()) - centre;
      if (distance * distance <= gate.squared_reach(sample.weight())) next.add(sample);
    });
    if (next.count == sum.count || next.count == 0) break;
    sum = next;
  }
  return sum;
}

}  // namespace aeolian
