#include "aeolian_core/saltation/flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "aeolian_core/saltation/hermite.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

constexpr int lanes = 8;
constexpr int most_steps = 100000;
using Lane = std::array<double, lanes>;

/// Flights side by side: where each is, its trial step and where that leads.
struct Abreast {
  Lane y, x, vx, vy, ax, ay;  ///< at the begin of the step
  Lane step, inverse_scale;
  Lane y1, x1, vx1, vy1, ax1, ay1;
  Lane error;  ///< of the step over what is allowed, squared
};

struct Field {
  WindProfile::Table::View wind;
  OctaveTable<5>::View drag;
  double inverse_roughness;
  double gravity;

  AEOLIAN_INLINE void accelerate(double y, double vx, double vy, double& ax, double& ay) const {
    const double height = std::min(std::max(y * inverse_roughness, 1.0), WindProfile::top);
    const double rx = vx - wind(height);
    const double rate = drag(std::min(std::max(rx * rx + vy * vy, Drag::least), Drag::most));
    ax = -rate * rx;
    ay = -rate * vy - gravity;
  }
};

/// Bogacki & Shampine (1989).
AEOLIAN_KERNEL void try_step(Abreast& s, const Field& field) {
#pragma GCC ivdep
  for (int i = 0; i < lanes; ++i) {
    const double h = s.step[i];
    double ax2 = 0, ay2 = 0, ax3 = 0, ay3 = 0, ax4 = 0, ay4 = 0;
    const double vx2 = s.vx[i] + 0.5 * h * s.ax[i];
    const double vy2 = s.vy[i] + 0.5 * h * s.ay[i];
    field.accelerate(s.y[i] + 0.5 * h * s.vy[i], vx2, vy2, ax2, ay2);
    const double vx3 = s.vx[i] + 0.75 * h * ax2;
    const double vy3 = s.vy[i] + 0.75 * h * ay2;
    field.accelerate(s.y[i] + 0.75 * h * vy2, vx3, vy3, ax3, ay3);
    const double w1 = h * (2.0 / 9), w2 = h * (1.0 / 3), w3 = h * (4.0 / 9);
    const double vx4 = s.vx[i] + w1 * s.ax[i] + w2 * ax2 + w3 * ax3;
    const double vy4 = s.vy[i] + w1 * s.ay[i] + w2 * ay2 + w3 * ay3;
    const double y4 = s.y[i] + w1 * s.vy[i] + w2 * vy2 + w3 * vy3;
    field.accelerate(y4, vx4, vy4, ax4, ay4);
    s.x1[i] = s.x[i] + w1 * s.vx[i] + w2 * vx2 + w3 * vx3;
    s.y1[i] = y4;
    s.vx1[i] = vx4;
    s.vy1[i] = vy4;
    s.ax1[i] = ax4;
    s.ay1[i] = ay4;
    const double e = h * s.inverse_scale[i];
    const double ex = e * ((-5.0 / 72) * s.ax[i] + (1.0 / 12) * ax2 + (1.0 / 9) * ax3 - (1.0 / 8) * ax4);
    const double ey = e * ((-5.0 / 72) * s.ay[i] + (1.0 / 12) * ay2 + (1.0 / 9) * ay3 - (1.0 / 8) * ay4);
    s.error[i] = ex * ex + ey * ey;
  }
}

/// The height within a step as a parabola through its ends, and a velocity along the wind to match.
struct Parabola {
  double y0, vy0, bend, vx0, ax0, turn;

  explicit Parabola(const FlightStep& s)
      : y0(s.y0),
        vy0(s.vy0),
        bend(2 * (s.y1 - s.y0 - s.vy0 * s.duration) / (s.duration * s.duration)),
        vx0(s.vx0),
        ax0(s.ax0),
        turn((s.vx1 - s.vx0 - s.ax0 * s.duration) / (s.duration * s.duration)) {}

  bool has_apex(double duration) const { return vy0 > 0 && vy0 + bend * duration < 0; }
  double apex() const { return y0 - 0.5 * vy0 * vy0 / bend; }
  AEOLIAN_INLINE double root(double y) const {
    return std::sqrt(std::max(0.0, vy0 * vy0 + 2 * bend * (y - y0)));
  }
  AEOLIAN_INLINE double vx(double time) const { return vx0 + time * (ax0 + time * turn); }
};

/// Adds weight x velocity along the wind where a path crosses `count` heights.
/// @{
AEOLIAN_KERNEL void add_rising(const Parabola& path, const double* height, std::ptrdiff_t count,
                               double weight, double* sum) {
  const Parabola p = path;
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i)
    sum[i] += weight * p.vx(2 * (height[i] - p.y0) / (p.vy0 + p.root(height[i])));
}
AEOLIAN_KERNEL void add_falling(const Parabola& path, const double* height, std::ptrdiff_t count,
                                double weight, double* sum) {
  const Parabola p = path;
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i)
    sum[i] += weight * p.vx(2 * (p.y0 - height[i]) / (p.root(height[i]) - p.vy0));
}
AEOLIAN_KERNEL void add_falling_past_apex(const Parabola& path, const double* height, std::ptrdiff_t count,
                                          double weight, double* sum) {
  const Parabola p = path;
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) sum[i] += weight * p.vx((p.vy0 + p.root(height[i])) / -p.bend);
}
/// @}

/// x^(-1/6) to 6 %, from the number's bits; large for zero.
double inverse_sixth_root(double x) {
  const auto single = static_cast<float>(x);
  std::uint32_t bits = 0;
  std::memcpy(&bits, &single, sizeof bits);
  bits = 0x4a11c000U - bits / 6;
  float root = 0;
  std::memcpy(&root, &bits, sizeof root);
  return static_cast<double>(root);
}

/// Ends a step that goes through the ground, at the ground.
FlightStep cut_at(double ground, const FlightStep& s) {
  double low = 0;
  double high = 1;
  const double h = s.duration;
  // The height may rise first, so from its apex on, where it falls all the way.
  if (s.vy0 > 0) low = std::min(1.0, -s.vy0 / std::min(s.ay0 * h, -1e-300));
  double part = low + (high - low) * 0.5;
  for (int n = 0; n < 60 && high - low > 1e-15; ++n) {
    const double y = hermite(part, h, s.y0, s.vy0, s.y1, s.vy1) - ground;
    (y > 0 ? low : high) = part;
    const double slope = h * hermite(part, h, s.vy0, s.ay0, s.vy1, s.ay1);
    const double newton = part - y / slope;
    if (newton == part) break;
    part = newton > low && newton < high ? newton : 0.5 * (low + high);
  }
  FlightStep cut = s;
  cut.duration = part * h;
  cut.x1 = hermite(part, h, s.x0, s.vx0, s.x1, s.vx1);
  cut.y1 = ground;
  cut.vx1 = hermite(part, h, s.vx0, s.ax0, s.vx1, s.ax1);
  cut.vy1 = std::min(hermite(part, h, s.vy0, s.ay0, s.vy1, s.ay1), -1e-12);
  return cut;
}

/// Flies one class after the other in eight lanes, refilled as flights end. A recorder gets begin(class),
/// each step as step(lane, class, FlightStep) and end(lane, class, FlightStep last).
template <class Recorder>
void fly_all(const Launches& launches, double least, const FlightConditions& c, Recorder& recorder) {
  const Field field{c.wind.view(), c.drag.view(), 1 / c.wind.roughness(), c.gravity};
  const double ground = c.wind.roughness();
  const double slow = 20 * std::sqrt(c.gravity * ground);
  Abreast s{};
  std::array<std::ptrdiff_t, lanes> flying;
  std::array<int, lanes> steps{};
  std::size_t next = 0;
  int busy = 0;

  const auto fill = [&](std::size_t lane) {
    while (next < launches.size() && !(launches.number[next] > least)) ++next;
    const bool more = next < launches.size();
    const double vx = more ? launches.vx[next] : 0;
    const double vy = more ? launches.vy[next] : 1;
    s.x[lane] = 0;
    s.y[lane] = ground;
    s.vx[lane] = vx;
    s.vy[lane] = vy;
    field.accelerate(ground, vx, vy, s.ax[lane], s.ay[lane]);
    s.step[lane] = more ? 0.02 * vy / c.gravity : 0;
    s.inverse_scale[lane] = 1 / (c.tolerance * std::max(std::hypot(vx, vy), slow));
    steps[lane] = 0;
    flying[lane] = more ? static_cast<std::ptrdiff_t>(next) : -1;
    if (more) {
      recorder.begin(lane, next++);
      ++busy;
    }
  };
  for (std::size_t lane = 0; lane < lanes; ++lane) fill(lane);

  while (busy > 0) {
    try_step(s, field);
    for (std::size_t i = 0; i < lanes; ++i) {
      if (flying[i] < 0) continue;
      if (++steps[i] > most_steps)
        throw Error("flight: a grain launched at " +
                    std::to_string(launches.vy[static_cast<std::size_t>(flying[i])]) +
                    " m/s does not come down within " + std::to_string(most_steps) + " steps");
      const double step = s.step[i];
      s.step[i] = step * std::min(5.0, std::max(0.2, 0.9 * inverse_sixth_root(s.error[i])));
      if (!(s.error[i] <= 1)) continue;
      const FlightStep done{step,    s.x[i],  s.y[i],   s.vx[i],  s.vy[i],  s.ax[i], s.ay[i],
                            s.x1[i], s.y1[i], s.vx1[i], s.vy1[i], s.ax1[i], s.ay1[i]};
      if (s.y1[i] <= ground && s.vy1[i] < 0) {
        const FlightStep last = cut_at(ground, done);
        if (last.duration < 0.9 * step) {  // once more, to the ground only: the wind is steepest there
          s.step[i] = 1.001 * last.duration;
          continue;
        }
        recorder.end(i, static_cast<std::size_t>(flying[i]), last);
        --busy;
        fill(i);
        continue;
      }
      recorder.step(i, static_cast<std::size_t>(flying[i]), done);
      s.x[i] = s.x1[i];
      s.y[i] = s.y1[i];
      s.vx[i] = s.vx1[i];
      s.vy[i] = s.vy1[i];
      s.ax[i] = s.ax1[i];
      s.ay[i] = s.ay1[i];
    }
  }
}

/// Landings, and the stress at the levels that flights cross.
class StressRecorder {
 public:
  StressRecorder(const Launches& launches, const WindProfile& wind, Landings& landings,
                 std::vector<double>& stress)
      : launches_(launches), wind_(wind), landings_(landings), stress_(stress) {}

  void begin(std::size_t lane, std::size_t k) {
    level_[lane] = 0;
    landings_.duration[k] = landings_.apex[k] = 0;
  }

  void step(std::size_t lane, std::size_t k, const FlightStep& s) {
    landings_.duration[k] += s.duration;
    cross(lane, k, s);
  }

  void end(std::size_t lane, std::size_t k, const FlightStep& s) {
    step(lane, k, s);
    landings_.vx[k] = s.vx1;
    landings_.vy[k] = -s.vy1;
    landings_.length[k] = s.x1;
    stress_[0] += launches_.number[k] * (s.vx1 - launches_.vx[k]);
  }

 private:
  /// `level_` is the highest level that the grain is above of or at.
  void cross(std::size_t lane, std::size_t k, const FlightStep& s) {
    const Parabola path(s);
    const bool over_apex = path.has_apex(s.duration);
    const double highest = over_apex ? path.apex() : std::max(s.y0, s.y1);
    const double number = launches_.number[k];
    std::size_t level = level_[lane];
    const std::size_t top = std::max(level, wind_.level_below(highest));
    const std::size_t end = std::min(top, wind_.level_below(s.y1));
    if (top > level)
      add_rising(path, wind_.heights() + level + 1, static_cast<std::ptrdiff_t>(top - level), -number,
                 &stress_[level + 1]);
    if (top > end)
      (path.vy0 > 0 ? add_falling_past_apex : add_falling)(
          path, wind_.heights() + end + 1, static_cast<std::ptrdiff_t>(top - end), number, &stress_[end + 1]);
    level_[lane] = end;
    landings_.apex[k] = std::max(landings_.apex[k], highest - wind_.roughness());
  }

  const Launches& launches_;
  const WindProfile& wind_;
  Landings& landings_;
  std::vector<double>& stress_;
  std::array<std::size_t, lanes> level_{};
};

struct TraceRecorder {
  std::vector<FlightStep> steps;
  void begin(std::size_t, std::size_t) {}
  void step(std::size_t, std::size_t, const FlightStep& s) { steps.push_back(s); }
  void end(std::size_t, std::size_t, const FlightStep& s) { steps.push_back(s); }
};

}  // namespace

void Launches::resize(std::size_t classes) {
  for (auto* column : {&vx, &vy, &number}) column->resize(classes);
}

void Landings::resize(std::size_t classes) {
  for (auto* column : {&vx, &vy, &duration, &length, &apex}) column->resize(classes);
}

void fly(const Launches& launches, double least, const FlightConditions& conditions, Landings& landings,
         std::vector<double>& stress) {
  StressRecorder recorder(launches, conditions.wind, landings, stress);
  fly_all(launches, least, conditions, recorder);
}

std::vector<FlightStep> trace(double vx, double vy, const FlightConditions& conditions) {
  TraceRecorder recorder;
  fly_all(Launches{{vx}, {vy}, {1}}, 0, conditions, recorder);
  return std::move(recorder.steps);
}

}  // namespace aeolian
