#include "aeolian_core/saltation/conveyor.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr Require require{"conveyor"};

void check(const Belt& belt) {
  require(belt.power > 0 && std::isfinite(belt.power), "power", belt.power, "positive");
  require(belt.friction >= 0 && std::isfinite(belt.friction), "friction", belt.friction, "zero or more");
  require(belt.restitution > 0 && belt.restitution < 1, "restitution", belt.restitution, "between 0 and 1");
}

/// Where a function that rises crosses zero, from zero upwards, to rounding.
double rising_root(const std::function<double(double)>& f) {
  double low = 0;
  double high = 1;
  while (f(high) < 0 && high < 1e100) high *= 2;
  for (int n = 0; n < 200 && high - low > 1e-15 * high; ++n) {
    const double middle = 0.5 * (low + high);
    (f(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

DeltaConveyor::DeltaConveyor(const Belt& belt, std::function<double(double)> conversion, double girl)
    : belt_(belt), conversion_(std::move(conversion)), girl_(girl) {
  check(belt);
  require(girl > 0 && std::isfinite(girl), "v_girl", girl, "positive");
}

double DeltaConveyor::belt_speed(const State& s) const {
  require(s.flux > 0 || belt_.friction > 0, "flux", s.flux, "positive without friction");
  return rising_root([&](double vc) {
    return vc * vc * (s.flux * s.speed / (vc + s.speed) + belt_.friction) - belt_.power;
  });
}

DeltaConveyor::State DeltaConveyor::next(const State& s) const {
  const double vc = belt_speed(s);
  const double eps = belt_.restitution;
  const double along = vc * s.speed / (vc + s.speed);
  const double number = along * along / (girl_ * girl_);
  return {(eps * eps * s.speed + conversion_(along) * along) / std::sqrt(number), s.flux * number};
}

DeltaConveyor::Fixed DeltaConveyor::fixed_point() const {
  const double lost = 1 - belt_.restitution * belt_.restitution;
  const double f = conversion_(girl_);
  require(f > lost, "f", f, ("above 1 - eps^2 = " + std::to_string(lost) + " for a steady state").c_str());
  Fixed fixed{};
  fixed.impact_x = girl_;
  fixed.state.speed = f * girl_ / lost;
  fixed.impact_y = -belt_.restitution * fixed.state.speed;
  fixed.belt_speed = girl_ / (1 - lost / f);
  const double spare = belt_.power / (fixed.belt_speed * fixed.belt_speed) - belt_.friction;
  fixed.state.flux = std::max(0.0, spare / (1 - lost / f));
  return fixed;
}

std::array<double, 2> DeltaConveyor::eigenvalues(const State& at) const {
  const double dv = 1e-6 * at.speed;
  const double df = 1e-6 * at.flux;
  const State v1 = next({at.speed + dv, at.flux}), v0 = next({at.speed - dv, at.flux});
  const State f1 = next({at.speed, at.flux + df}), f0 = next({at.speed, at.flux - df});
  const double a = (v1.speed - v0.speed) / (2 * dv), b = (f1.speed - f0.speed) / (2 * df);
  const double c = (v1.flux - v0.flux) / (2 * dv), d = (f1.flux - f0.flux) / (2 * df);
  const double half = 0.5 * (a + d);
  const double root = std::sqrt(std::max(0.0, half * half - (a * d - b * c)));
  return {half + root, half - root};
}

ConveyorResponse linear_response(const DeltaConveyor::Fixed& at, const Belt& belt, double f, double gap) {
  require(gap > 0, "gap", gap, "positive");
  const double v = at.state.speed;
  const double vc = at.belt_speed;
  const double eps = belt.restitution;
  const double time = (1 + eps) * gap;
  const double sum = (vc + v) * (vc + v);
  return {{{{-eps * f * v * v * vc / (time * sum), 0}, {0, 0}}},
          {{{eps * f * v * v * v / (time * sum), -0.5 * eps * v * v / time},
            {0, eps * v * at.state.flux / time}}}};
}

SpectrumConveyor::SpectrumConveyor(const Belt& belt, const ConveyorSplash& splash, int bins, double width)
    : belt_(belt), splash_(splash), bins_(bins), width_(width) {
  check(belt);
  require(bins >= 2 && bins <= 10000, "number of bins", bins, "2 to 10000");
  require(width > 0, "bin width", width, "positive");
  require(splash.conversion >= 0, "f", splash.conversion, "zero or more");
  require(splash.alpha >= 0, "alpha", splash.alpha, "zero or more");
  require(splash.beta > 0, "beta", splash.beta, "positive");
  require(splash.gamma >= 0, "gamma", splash.gamma, "zero or more");
  require(splash.delta > 0, "delta", splash.delta, "positive");
  require(splash.saturation > 0, "e", splash.saturation, "positive");
}

std::vector<double> SpectrumConveyor::column(double speed, double vc) const {
  const double along = vc * speed / (vc + speed);
  const double peak = splash_.conversion * along + belt_.restitution * belt_.restitution * speed;
  const double rebounds = splash_.alpha * along / (along + splash_.saturation);
  const double ejecta = splash_.gamma * along * along;
  std::vector<double> result;
  for (int i = 0; i < bins_; ++i) {
    const double v = launch_speed(i);
    result.push_back(rebounds * std::exp(-(v - peak) * (v - peak) / splash_.beta) +
                     ejecta * std::exp(-v / splash_.delta));
  }
  return result;
}

std::vector<double> SpectrumConveyor::image(const std::vector<double>& flux, double vc) const {
  std::vector<double> result(flux.size());
  for (int j = 0; j < bins_; ++j) {
    const double landing = flux[static_cast<std::size_t>(j)] * width_;
    if (landing == 0) continue;
    const std::vector<double> leaving = column(launch_speed(j), vc);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] += landing * leaving[i];
  }
  return result;
}

double SpectrumConveyor::belt_speed(const std::vector<double>& flux) const {
  return rising_root([&](double vc) {
    double drag = belt_.friction;
    for (int i = 0; i < bins_; ++i)
      drag += flux[static_cast<std::size_t>(i)] * launch_speed(i) / (launch_speed(i) + vc);
    return vc * vc * drag - belt_.power;
  });
}

std::vector<double> SpectrumConveyor::next(const std::vector<double>& flux) const {
  return image(flux, belt_speed(flux));
}

SpectrumConveyor::Steady SpectrumConveyor::iterate(std::vector<double> flux, double tolerance) const {
  require(flux.size() == static_cast<std::size_t>(bins_), "number of fluxes",
          static_cast<double>(flux.size()), "one for each bin");
  for (int n = 1; n <= 10000; ++n) {
    const std::vector<double> after = next(flux);
    double change = 0;
    for (std::size_t i = 0; i < flux.size(); ++i)
      if (after[i] > 0) change = std::max(change, std::abs(after[i] - flux[i]) / after[i]);
    flux = after;
    if (change <= tolerance) return {belt_speed(flux), flux, n};
  }
  throw Error("conveyor: no steady state within 10000 steps");
}

double SpectrumConveyor::reproduction(double vc, std::vector<double>& spectrum) const {
  double grains = 0;
  for (int n = 0; n < 2000; ++n) {
    std::vector<double> after = image(spectrum, vc);
    grains = std::accumulate(after.begin(), after.end(), 0.0);
    if (!(grains > 0)) return 0;
    double change = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
      after[i] /= grains;
      change = std::max(change, std::abs(after[i] - spectrum[i]));
    }
    spectrum = after;
    if (change < 1e-15) break;
  }
  return grains;
}

SpectrumConveyor::Steady SpectrumConveyor::solve() const {
  std::vector<double> spectrum(static_cast<std::size_t>(bins_), 1.0 / bins_);
  // Upwards from slow belts: on fast ones grains leave the bins for good.
  double high = 0.5 * width_;
  if (reproduction(high, spectrum) > 1)
    throw Error("conveyor: more than one grain leaves for each that lands, however slow the belt");
  while (reproduction(high, spectrum) < 1) {
    high *= 2;
    if (high > 1e3 * width_ * bins_)
      throw Error("conveyor: less than one grain leaves for each that lands, however fast the belt");
    spectrum.assign(spectrum.size(), 1.0 / bins_);
  }
  double low = 0.5 * high;
  int steps = 0;
  spectrum.assign(spectrum.size(), 1.0 / bins_);
  for (; high - low > 1e-13 * high && steps < 200; ++steps) {
    const double middle = 0.5 * (low + high);
    (reproduction(middle, spectrum) < 1 ? low : high) = middle;
  }
  const double vc = 0.5 * (low + high);
  double drag = 0;
  for (int i = 0; i < bins_; ++i)
    drag += spectrum[static_cast<std::size_t>(i)] * launch_speed(i) / (launch_speed(i) + vc);
  const double flux = std::max(0.0, belt_.power / (vc * vc) - belt_.friction) / drag;
  for (double& f : spectrum) f *= flux;
  return {vc, spectrum, steps};
}

}  // namespace aeolian
