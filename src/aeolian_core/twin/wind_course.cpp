#include "aeolian_core/twin/wind_course.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr Require require{"wind"};
constexpr double shortest_stand = 1e-3;  // of a sample that shares its time with another [s]

/// A spell that holds to `until`, after or before what it is copied from.
WindSpell lasting(WindSpell spell, double until) {
  spell.until = until;
  return spell;
}

}  // namespace

double seconds_between(double from, double to) {
  const auto microseconds = std::llround((to - from) * 1e6);
  return static_cast<double>(microseconds / 1000000) +
         1e-9 * static_cast<double>(microseconds % 1000000 * 1000);
}

WindCourse::WindCourse(const Settings& settings) : settings_(settings) {
  const auto positive = [](double value, const char* name) {
    require(value > 0 && std::isfinite(value), name, value, "positive and finite");
  };
  positive(settings.window, "window");
  positive(settings.max_gap, "longest gap");
  positive(settings.max_friction_velocity, "greatest friction velocity");
  positive(settings.spell, "spell");
}

void WindCourse::check(const WindSample& sample) const {
  require(std::isfinite(sample.time), "time of a sample", sample.time, "finite");
  const std::string at = " at " + std::to_string(sample.time) + " s";
  const double most = settings_.max_friction_velocity;
  require(sample.friction_velocity >= 0 && sample.friction_velocity <= most, "friction velocity" + at,
          sample.friction_velocity, "0 to " + std::to_string(most) + " m/s; it is left out");
  require(std::isfinite(sample.direction), "direction" + at, sample.direction, "finite; it is left out");
  require(sample.air_density > 0 && std::isfinite(sample.air_density), "air density" + at, sample.air_density,
          "positive and finite; it is left out");
}

void WindCourse::add(const WindSample& sample) {
  check(sample);
  if (!past_.empty() && sample.time < past_.back().time) past_.clear();
  past_.push_back(sample);
  // Maps may be older than the newest wind, so twice the window is kept.
  while (sample.time - past_.front().time > 2 * settings_.window) past_.pop_front();
}

void WindCourse::give_ahead(std::vector<WindSample> samples) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    check(samples[i]);
    require(i == 0 || samples[i].time > samples[i - 1].time, "time of a sample given ahead", samples[i].time,
            "later than that of the one before");
  }
  ahead_ = std::move(samples);
}

/// The mean over the window that ends at a time, each sample with the time for which it stands. What is
/// missing is bridged with what is there.
std::optional<WindSpell> WindCourse::before(double time) const {
  WindSpell spell;
  double last_age = 0;
  for (auto sample = past_.rbegin(); sample != past_.rend(); ++sample) {
    const double age = seconds_between(sample->time, time);
    if (age < 0) continue;
    if (last_age < settings_.window) spell.longest_gap = std::max(spell.longest_gap, age - last_age);
    const double stands_for = age - last_age;
    last_age = age;
    if (age > settings_.window) break;
    spell.samples.push_back(*sample);
    spell.weights.push_back(std::min(settings_.max_gap, std::max(stands_for, shortest_stand)));
  }
  if (spell.samples.empty()) return std::nullopt;
  return spell;
}

double WindCourse::end_of_ahead(std::size_t sample) const {
  if (sample + 1 < ahead_.size()) return ahead_[sample + 1].time;
  if (sample == 0) return ahead_[0].time + settings_.window;
  return 2 * ahead_[sample].time - ahead_[sample - 1].time;
}

std::optional<double> WindCourse::ahead_until() const {
  if (ahead_.empty()) return std::nullopt;
  return end_of_ahead(ahead_.size() - 1);
}

/// The part of the wind given ahead that lies within a forecast, in spells without a hole between them.
std::vector<WindSpell> WindCourse::given(double time, double horizon) const {
  std::vector<WindSpell> result;
  for (std::size_t i = 0; i < ahead_.size(); ++i) {
    double from = std::max(0.0, seconds_between(time, ahead_[i].time));
    const double to = std::min(horizon, seconds_between(time, end_of_ahead(i)));
    while (from < to) {
      const double spell_end = settings_.spell * (std::floor(from / settings_.spell) + 1);
      const double until = std::min(to, spell_end);
      const bool joins = !result.empty() && std::fmod(from, settings_.spell) > 0;
      if (!joins) result.push_back({until, {}, {}, 0, true});
      result.back().until = until;
      result.back().samples.push_back(ahead_[i]);
      result.back().weights.push_back(until - from);
      from = until;
    }
  }
  return result;
}

std::vector<WindSpell> WindCourse::spells(double time, double horizon) const {
  const std::optional<WindSpell> goes_on = before(time);
  std::vector<WindSpell> ahead = given(time, horizon);
  if (ahead.empty()) {
    if (!goes_on) return {};
    return {lasting(*goes_on, horizon)};
  }
  const double begin = std::max(0.0, seconds_between(time, ahead_.front().time));
  std::vector<WindSpell> result;
  if (begin > 0) result.push_back(lasting(goes_on ? *goes_on : ahead.front(), begin));
  result.insert(result.end(), ahead.begin(), ahead.end());
  const double end = result.back().until;
  if (end < horizon) result.push_back(lasting(goes_on ? *goes_on : ahead.back(), horizon));
  return result;
}

}  // namespace aeolian
