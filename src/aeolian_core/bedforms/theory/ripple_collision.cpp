#include "aeolian_core/bedforms/theory/ripple_collision.hpp"

#include <algorithm>
#include <string>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// Sand leaves each lit stoss in a strip and comes down on the lee behind it: a crest shifts by the area over
/// the height of the face. Target ejection frees as much on every stoss, brink ejection less the longer it
/// is.
struct Motion {
  EjectionLaw ejection;

  RipplePair rates(const RipplePair& p) const {
    const double first = p.upstream - p.overlap;     // relief of the first lee
    const double second = p.downstream - p.overlap;  // relief of the second stoss
    const double from_first = ejection == EjectionLaw::target ? 1 : 1 / p.upstream;
    const double from_second = ejection == EjectionLaw::target ? 1 : 1 / second;
    return {from_first * (1 / first - 1 / p.upstream), from_second * (1 / p.downstream - 1 / second),
            from_first / first - from_second / second};
  }

  static RipplePair along(const RipplePair& p, const RipplePair& rate, double time) {
    return {p.upstream + time * rate.upstream, p.downstream + time * rate.downstream,
            p.overlap + time * rate.overlap};
  }

  /// Runge-Kutta of fourth order.
  RipplePair step(const RipplePair& p, double time) const {
    const RipplePair a = rates(p);
    const RipplePair b = rates(along(p, a, time / 2));
    const RipplePair c = rates(along(p, b, time / 2));
    const RipplePair d = rates(along(p, c, time));
    const RipplePair mean{(a.upstream + 2 * b.upstream + 2 * c.upstream + d.upstream) / 6,
                          (a.downstream + 2 * b.downstream + 2 * c.downstream + d.downstream) / 6,
                          (a.overlap + 2 * b.overlap + 2 * c.overlap + d.overlap) / 6};
    return along(p, mean, time);
  }

  /// In which both reliefs change by no more than a small part of themselves.
  double time_step(const RipplePair& p) const {
    constexpr double part = 0.004;
    const double first = p.upstream - p.overlap;
    const double second = p.downstream - p.overlap;
    const double least = std::min(first * first, second * second);
    return part * (ejection == EjectionLaw::target ? least : least * std::min(p.upstream, second));
  }

  /// The last part of a step that would end with an overlap below zero.
  RipplePair step_to_touching(const RipplePair& p, double time) const {
    double short_of = 0;
    double beyond = time;
    for (int i = 0; i < 50; ++i) {
      const double middle = (short_of + beyond) / 2;
      (step(p, middle).overlap > 0 ? short_of : beyond) = middle;
    }
    return step(p, beyond);
  }
};

}  // namespace

double Collision::least_effective_height() const {
  double least = before().effective_height();
  for (const RipplePair& p : course) least = std::min(least, p.effective_height());
  return least / before().upstream;
}

Collision collide(double ratio, EjectionLaw ejection) {
  if (!(ratio >= 0.05 && ratio < 1))
    throw Error("collision of ripples: upstream over downstream height is " + std::to_string(ratio) +
                ", must be from 0.05 to below 1");
  const Motion motion{ejection};
  Collision result;
  result.course.push_back({ratio, 1, 0});
  while (true) {
    const RipplePair& now = result.course.back();
    const double time = motion.time_step(now);
    const RipplePair next = motion.step(now, time);
    if (next.overlap <= 0) {
      result.course.push_back(motion.step_to_touching(now, time));
      return result;
    }
    result.course.push_back(next);
  }
}

}  // namespace aeolian
