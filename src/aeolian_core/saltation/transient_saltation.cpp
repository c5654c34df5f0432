#include "aeolian_core/saltation/transient_saltation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr double remembered = 4;  ///< longest flight that is told from longer ones [s]
constexpr double calmest = 0.02;  ///< surface over free wind, where the grains would take more than there is
constexpr double flight_tolerance = 3e-4;
constexpr double negligible = 1e-6;
constexpr double wind_part = 0.5;  ///< of a new wind that is taken in one step

}  // namespace

TransientSaltation::TransientSaltation(const SaltatingBed& bed, const SplashKernel& splash,
                                       const Entrainment& entrainment, double step)
    : bed_((check(bed), bed)),
      splash_(splash.clone()),
      drag_(bed.drag_law, bed.grain, bed.atmosphere, bed.drag_scale),
      entrained_(entrainment.coefficient),
      fluid_threshold_(entrainment.threshold > 0 ? entrainment.threshold : bed.fluid_threshold()),
      step_(step),
      wind_(bed.roughness_length()),
      share_(WindProfile::levels) {
  if (!(step > 0 && step <= 0.1))
    throw Error("transient saltation: the step is " + std::to_string(step) + " s, must be above 0 to 0.1");
  if (!(entrainment.coefficient >= 0 && std::isfinite(entrainment.coefficient)))
    throw Error("transient saltation: the entrainment is " + std::to_string(entrainment.coefficient) +
                " per newton and second, must be zero or more");
  spectrum_ = splash_->first_spectrum();
  set_classes();
}

void TransientSaltation::set_classes() {
  splash_->launch(spectrum_, launches_);
  landings_.resize(launches_.size());
  landed_.assign(launches_.size(), 0);
  history_.assign(static_cast<std::size_t>(remembered / step_) + 2, landed_);

  // Flights of all classes, for their times, in a wind that may come.
  wind_.set_logarithmic(fluid_threshold_);
  std::fill(launches_.number.begin(), launches_.number.end(), 1.0);
  stress_.assign(WindProfile::levels, 0);
  fly(launches_, 0, {wind_, drag_, bed_.atmosphere.gravity, flight_tolerance}, landings_, stress_);

  const double rise = std::sqrt(2 * bed_.atmosphere.gravity * bed_.grain.diameter);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < launches_.size(); ++k) {
    const double distance = std::hypot(launches_.vx[k], launches_.vy[k] - rise);
    if (distance >= nearest) continue;
    nearest = distance;
    entrained_class_ = k;
  }
}

void TransientSaltation::begin(const SteadyState& state) {
  while (launches_.size() < state.launches.size() && splash_->extend(spectrum_)) set_classes();
  if (state.launches.size() != launches_.size())
    throw Error("transient saltation: the state has " + std::to_string(state.launches.size()) +
                " classes of launches, the splash has " + std::to_string(launches_.size()));
  launches_ = state.launches;
  wind_ = state.wind;
  surface_ = state.surface_friction_velocity;
  for (std::size_t i = 0; i < share_.size(); ++i)
    share_[i] = state.grain_stress[0] > 0 ? state.grain_stress[i] / state.grain_stress[0] : 0;
  for (std::size_t k = 0; k < landed_.size(); ++k) {
    const double rate = state.launches.number[k];
    if (rate > 0) {
      landings_.duration[k] = state.landings.duration[k];
      landings_.length[k] = state.landings.length[k];
    }
    const double first = static_cast<double>(history_.size() - 1) * step_;
    for (std::size_t n = 0; n < history_.size(); ++n)
      history_[n][k] = rate * (first - static_cast<double>(n) * step_);
    landed_[k] = rate * (first - landings_.duration[k]);
  }
}

double TransientSaltation::launched(std::size_t k, double ago) const {
  const double at = std::clamp(ago / step_, 0.0, static_cast<double>(history_.size() - 1));
  const auto n = std::min(static_cast<std::size_t>(at), history_.size() - 2);
  const double part = at - static_cast<double>(n);
  return history_[n][k] + part * (history_[n + 1][k] - history_[n][k]);
}

void TransientSaltation::advance(double duration, double friction_velocity) {
  if (!(friction_velocity >= 0 && friction_velocity <= 10))
    throw Error("transient saltation: friction velocity is " + std::to_string(friction_velocity) +
                " m/s, must be 0 to 10");
  if (!(duration >= 0 && std::isfinite(duration)))
    throw Error("transient saltation: the duration is " + std::to_string(duration) +
                " s, must be zero or more");
  const double end = time_ + duration - 0.5 * step_;
  while (time_ < end) step(friction_velocity);
}

void TransientSaltation::step(double free) {
  // A class in the air counts as so many grains passing per time.
  double rate = 0;
  for (std::size_t k = 0; k < launches_.size(); ++k) {
    launches_.number[k] = std::max(0.0, history_.front()[k] - landed_[k]) / landings_.duration[k];
    rate += launches_.number[k];
  }
  const double least = negligible * rate;
  stress_.assign(WindProfile::levels, 0);
  fly(launches_, least, {wind_, drag_, bed_.atmosphere.gravity, flight_tolerance}, landings_, stress_);
  impact_rate_ = rate;
  mass_flux_ = bed_.grain.mass() * std::inner_product(launches_.number.begin(), launches_.number.end(),
                                                      landings_.length.begin(), 0.0);

  const double borne = bed_.grain.mass() * stress_[0] / bed_.atmosphere.density;
  const double left = std::max(free * free - std::max(0.0, borne), calmest * calmest * free * free);
  surface_ += wind_part * (std::min(std::sqrt(left), free) - surface_);
  if (stress_[0] > 0)
    for (std::size_t i = 0; i < share_.size(); ++i)
      share_[i] += wind_part * (stress_[i] / stress_[0] - share_[i]);
  wind_.set(free, std::min(surface_, free), share_);

  for (std::size_t k = 0; k < launches_.size(); ++k) {
    const double due = launched(k, landings_.duration[k] - step_);
    launches_.number[k] = std::max(0.0, due - landed_[k]);
    landed_[k] += launches_.number[k];
  }
  splash_->splash(launches_, 0, landings_, spectrum_);
  history_.push_front(history_.front());
  history_.pop_back();
  splash_->launch(spectrum_, launches_);
  for (std::size_t k = 0; k < launches_.size(); ++k) history_.front()[k] += launches_.number[k];
  const double excess = bed_.atmosphere.density * (surface_ * surface_ - fluid_threshold_ * fluid_threshold_);
  history_.front()[entrained_class_] += std::max(0.0, entrained_ * excess * step_);
  time_ += step_;
}

}  // namespace aeolian
