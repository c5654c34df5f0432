#include "aeolian_core/wind/inner_layer.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/wind/bessel_k.hpp"

namespace aeolian {
namespace {

/// The root x > 1 of x ln(x)^power = right > 0.
double root_of_log(double right, double power) {
  double x = 1 + right;
  for (int n = 0; n < 100; ++n) {
    const double log = std::log(x);
    const double value = x * std::pow(log, power) - right;
    const double slope = std::pow(log, power) + power * std::pow(log, power - 1);
    const double next = std::max(x - value / slope, 1 + 0.1 * (x - 1));
    if (std::abs(next - x) <= 1e-14 * x) return next;
    x = next;
  }
  return x;
}

}  // namespace

double inner_depth(double length, double roughness) {
  return roughness * root_of_log(2 * von_karman * von_karman * length / roughness, 1);
}

double inner_depth_over(const GridGeometry& map, double roughness) {
  const double side = map.size() > 0 ? std::min(map.length_x(), map.length_y()) : 0;
  return inner_depth(std::max(0.25 * side, 10 * roughness), roughness);
}

double middle_height(double length, double roughness) {
  return roughness * root_of_log(length / roughness, 0.5);
}

ReliefWave::ReliefWave(const UpwindProfile& upwind, double wave_number, double cosine, double sine)
    : upwind_(upwind), k_(wave_number), cosine_(cosine), sine_(sine) {
  if (!upwind.sheared()) return;
  const double z0 = upwind.roughness();
  inner_ = inner_depth(1 / k_, z0);
  middle_ = std::max(middle_height(1 / k_, z0), inner_);
  log_inner_ = std::log(inner_ / z0);
  gain_ = std::pow(std::log(middle_ / z0) / log_inner_, 2);
  // A wave square to the wind has no shear of its own to speak of, but s must not vanish.
  const double along = std::copysign(std::max(std::abs(cosine_), 1e-9), cosine_);
  friction_ = std::complex<double>(0, along * z0 / (4 * inner_));
}

WaveResponse ReliefWave::stress() const {
  const auto sheared = [](std::complex<double> s) {
    const BesselK k = bessel_k(2.0 * s);
    return s * k.k1 / k.k0;
  };
  const double c2 = cosine_ * cosine_;
  const double scale = 2 * gain_ * k_;
  return {scale * (-c2 + (2 * log_inner_ * c2 + 1) * sheared(std::sqrt(friction_))),
          scale * cosine_ * sine_ * (log_inner_ * sheared(std::sqrt(2.0 * friction_)) - 0.5)};
}

WaveResponse ReliefWave::velocity(double height) const {
  const double decay = std::exp(-k_ * height);
  const double c2 = cosine_ * cosine_;
  if (!upwind_.sheared()) return {k_ * c2 * decay, k_ * cosine_ * sine_ * decay};
  const double z0 = upwind_.roughness();
  if (height <= z0) return {};
  // Pressure over the speed that it acts upon, U(h_m)^2/U(z): within the inner layer the first terms of its
  // expansion about l, which are what Weng's stress is the shear of.
  const double delta = 1 / log_inner_;
  const double at_inner = upwind_.speed(inner_);
  const double log_ratio = std::log(std::min(height, middle_) / inner_);
  const double advected = height < inner_ ? 1 - delta * log_ratio : 1 / (1 + delta * log_ratio);
  const double fades = 1 / (1 + std::pow((height - z0) / inner_, 2));
  const double extra = delta * fades;  // times k^2/k_x^2
  const auto damping = [&](double viscosity) {
    return bessel_k(2.0 * std::sqrt(viscosity * friction_ * (height / z0))).k0 /
           bessel_k(2.0 * std::sqrt(viscosity * friction_)).k0;
  };
  const std::complex<double> slow = damping(1);
  const double scale = at_inner * gain_ * k_ * decay;
  const double ground = 2;  // the value of 1 - delta ln(z/l) at z0
  std::complex<double> along = scale * (c2 * (advected - ground * slow) + extra - delta * slow);
  // Streamlines that follow the ground below and are level aloft bring their speed along.
  const double lifted = (1 - decay) * (1 - fades);
  along += lifted / (von_karman * height);
  return {along, scale * cosine_ * sine_ * (advected - damping(2) * ground)};
}

}  // namespace aeolian
