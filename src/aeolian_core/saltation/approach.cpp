#include "aeolian_core/saltation/approach.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace aeolian {
namespace {

constexpr double cut_off_allowed = 1e-4;  ///< at the fast end, relative to the largest
constexpr double counted = 1e-3;  ///< parts of a spectrum from here on must settle, relative to the largest
constexpr int memory = 5;

/// Change of ln(surface wind) for the logarithm of the replacement: more grains leave than land, so more of
/// them slow the wind.
constexpr double gain = 0.4;
constexpr double longest_step = 0.3;
/// In what is to be small: of ln(surface wind), and of parts of the spectrum over the largest. Fewest steps
/// from neighbouring winds, over 6230 states.
constexpr double surface_weight = 3;
constexpr double spectrum_weight = 0.5;
constexpr double furthest = 2;  ///< from a state, over the way to it that tells the direction

/// How much the wind at the surface weakens for one that is free and grows stronger, nearly, whatever the
/// splash. A third of surface over free wind in strong winds.
double slackening(const SteadyState& state) {
  return std::min(0.1, state.surface_friction_velocity / state.friction_velocity / 3);
}

}  // namespace

Approach::Approach(const SaltatingBed& bed, const SplashKernel& splash, const FlyingGrains& grains,
                   double flight_tolerance)
    : bed_(bed),
      grains_(grains),
      flight_tolerance_(flight_tolerance),
      splash_(splash.clone()),
      mixing_(memory),
      spectrum_(splash_->first_spectrum()),
      share_(WindProfile::levels),
      next_share_(WindProfile::levels),
      wind_(bed.roughness_length()),
      next_wind_(wind_) {}

void Approach::set_winds(double free, double surface) {
  free_ = free;
  surface_ = surface;
}

void Approach::begin_at(const SteadyState& other, double free) {
  const double usual = slackening(other);
  set_winds(free, other.surface_friction_velocity - usual * (free - other.friction_velocity));
  std::vector<double> first = splash_->first_spectrum();
  while (first.size() < other.spectrum.size())
    if (!splash_->extend(first)) return;
  if (first.size() != other.spectrum.size() || !(other.grain_stress[0] > 0)) return;
  spectrum_ = other.spectrum;
  for (std::size_t i = 0; i < share_.size(); ++i) share_[i] = other.grain_stress[i] / other.grain_stress[0];
  begin_ = {other.friction_velocity, other.surface_friction_velocity, spectrum_, share_};
  if (!other.past) return;
  mixing_ = other.past->mixing;
  if (other.past->begin) go_on_from(*other.past->begin, usual);
}

void Approach::go_on_from(const Past::Begin& before, double usual) {
  const double way = begin_->free - before.free;
  if (way == 0 || before.spectrum.size() != spectrum_.size()) return;
  const double part = std::clamp((free_ - begin_->free) / way, -furthest, furthest);
  surface_ += part * (begin_->surface - before.surface + usual * way);
  for (std::size_t i = 0; i < share_.size(); ++i) share_[i] += part * (share_[i] - before.share[i]);
  for (std::size_t i = 0; i < spectrum_.size(); ++i)
    spectrum_[i] = std::max(0.0, spectrum_[i] + part * (spectrum_[i] - before.spectrum[i]));
  const double grains = splash_->number(spectrum_);
  for (double& p : spectrum_) p /= grains;
}

void Approach::step() {
  ++steps_;
  extended_ = false;
  wind_.set(free_, surface_, share_);
  splash_->launch(spectrum_, launches_);
  landings_.resize(launches_.size());
  stress_.assign(WindProfile::levels, 0);
  grains_.fly(launches_, wind_, bed_.atmosphere.gravity, flight_tolerance_, landings_, stress_);
  splash_->splash(launches_, grains_.negligible(), landings_, next_spectrum_);
  replacement_ = splash_->number(next_spectrum_);

  spectrum_change_ = 0;
  if (replacement_ > 0) {
    for (double& p : next_spectrum_) p /= replacement_;
    const double largest = *std::max_element(next_spectrum_.begin(), next_spectrum_.end());
    for (std::size_t i = 0; i < spectrum_.size(); ++i)
      if (next_spectrum_[i] > counted * largest)
        spectrum_change_ =
            std::max(spectrum_change_, std::abs(next_spectrum_[i] - spectrum_[i]) / next_spectrum_[i]);
  } else {
    next_spectrum_ = spectrum_;
  }

  // Grains that push the wind on the whole came to be in too slow a wind: less of them.
  for (std::size_t i = 0; i < share_.size(); ++i)
    next_share_[i] = stress_[0] > 0 ? stress_[i] / stress_[0] : 0.5 * share_[i];
  next_wind_.set(free_, surface_, next_share_);
  wind_change_ = 0;
  for (std::size_t i = WindProfile::levels_per_octave; i < WindProfile::levels; ++i)
    wind_change_ = std::max(wind_change_, std::abs(next_wind_.speed_at_level(i) - wind_.speed_at_level(i)) /
                                              std::abs(wind_.speed_at_level(i)));
}

void Approach::accept() {
  spectrum_ = next_spectrum_;
  share_ = next_share_;
}

void Approach::mix(double most) {
  if (extended_) return;  // and accepted: its residual would say that nothing is left to change
  const auto n = static_cast<Eigen::Index>(spectrum_.size());
  const auto m = static_cast<Eigen::Index>(share_.size());
  const double asked = std::clamp(-gain * std::log(replacement_), -longest_step, longest_step);
  const double largest = *std::max_element(next_spectrum_.begin(), next_spectrum_.end());
  Eigen::VectorXd x(1 + n + m), g(1 + n + m), weight(1 + n + m);
  x << std::log(surface_), Eigen::VectorXd::Map(spectrum_.data(), n), Eigen::VectorXd::Map(share_.data(), m);
  g << std::log(surface_) + asked, Eigen::VectorXd::Map(next_spectrum_.data(), n),
      Eigen::VectorXd::Map(next_share_.data(), m);
  weight << surface_weight, Eigen::VectorXd::Constant(n, spectrum_weight / largest), Eigen::VectorXd::Ones(m);

  const Eigen::VectorXd mixed = mixing_.next(x, g, weight);
  surface_ = std::min(most, surface_ * std::exp(std::clamp(mixed[0] - x[0], -longest_step, longest_step)));
  Eigen::VectorXd::Map(share_.data(), m) = mixed.tail(m);
  Eigen::VectorXd::Map(spectrum_.data(), n) = mixed.segment(1, n).cwiseMax(0);
  const double grains = splash_->number(spectrum_);
  for (double& p : spectrum_) p /= grains;
}

bool Approach::extend_if_cut_off() {
  while (splash_->cut_off(next_spectrum_) > cut_off_allowed) {
    if (!splash_->extend(next_spectrum_)) return false;
    accept();
    mixing_ = AndersonMixing(memory);
    extended_ = true;
  }
  return true;
}

bool Approach::same_spectrum(double tolerance) const {
  return stress_[0] > 0 && !extended_ && spectrum_change_ < tolerance && wind_change_ < tolerance;
}

bool Approach::settled(double tolerance) const {
  return same_spectrum(tolerance) && std::abs(replacement_ - 1) < tolerance;
}

double Approach::flux_over_stress() const {
  double length = 0;
  for (std::size_t k = 0; k < launches_.size(); ++k)
    if (launches_.number[k] > grains_.negligible()) length += launches_.number[k] * landings_.length[k];
  return length / stress_[0];
}

SteadyState Approach::state() const {
  SteadyState s(wind_);
  s.friction_velocity = free_;
  s.surface_friction_velocity = surface_;
  s.launches = launches_;
  s.landings = landings_;
  s.spectrum = next_spectrum_;
  Past past{mixing_, begin_};
  past.mixing.begin_anew();
  s.past = std::make_shared<const Past>(std::move(past));
  s.grain_mass = bed_.grain.mass();
  const double borne = bed_.atmosphere.density * (free_ * free_ - surface_ * surface_);
  s.grain_stress = next_share_;
  for (double& stress : s.grain_stress) stress *= borne;
  const double rate = borne / (s.grain_mass * stress_[0]);
  for (double& number : s.launches.number) number = number > grains_.negligible() ? number * rate : 0;
  s.iterations = steps_;
  s.replacement = replacement_;
  s.spectrum_change = spectrum_change_;
  s.wind_change = wind_change_;
  return s;
}

}  // namespace aeolian
