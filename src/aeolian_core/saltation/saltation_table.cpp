#include "aeolian_core/saltation/saltation_table.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr double kept_tolerance = 1e-4;  ///< what is kept has time to be solved well

void require_ascending(const char* what, const std::vector<double>& values, double least) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(values[i] > (i == 0 ? least : values[i - 1]) && std::isfinite(values[i])))
      throw Error("saltation table: " + std::string(what) + " " + std::to_string(i) + " is " +
                  std::to_string(values[i]) + ", must be above " +
                  std::to_string(i == 0 ? least : values[i - 1]));
  if (values.size() < 2)
    throw Error("saltation table: there is no second " + std::string(what) + ", must be two or more");
}

SteadyState solved(const SaltationSolver& solver, double friction_velocity, const SteadyState* begin) {
  SteadyState state = solver.solve(friction_velocity, begin);
  if (!state.steady())
    throw Error("saltation table: no steady state at friction velocity " + std::to_string(friction_velocity) +
                " m/s, diameter " + std::to_string(solver.bed().grain.diameter) + " m: " + state.reason);
  return state;
}

double threshold_of(const SaltationSolver& solver) {
  std::string why;
  const auto threshold = solver.impact_threshold(&why);
  if (!threshold)
    throw Error("saltation table: no impact threshold at diameter " +
                std::to_string(solver.bed().grain.diameter) + " m: " + why);
  return *threshold;
}

/// A column of the file and the number of a state that it holds.
struct Column {
  const char* name;
  double SaltationState::*value;
  double unit;
  bool needed = true;  ///< a file without it is read as zeros
};
constexpr Column columns[] = {
    {"friction_velocity_m_s", &SaltationState::friction_velocity, 1},
    {"impact_threshold_m_s", &SaltationState::impact_threshold, 1},
    {"mass_flux_kg_m_s", &SaltationState::mass_flux, 1},
    {"impact_rate_m2_s", &SaltationState::impact_rate, 1},
    {"impact_speed_m_s", &SaltationState::impact_speed, 1},
    {"impact_angle_deg", &SaltationState::impact_angle, degree},
    {"hop_length_m", &SaltationState::hop_length, 1},
    {"surface_friction_velocity_m_s", &SaltationState::surface_friction_velocity, 1},
    {"hop_height_m", &SaltationState::hop_height, 1},
    {"flight_time_s", &SaltationState::flight_time, 1},
    {"apparent_roughness_m", &SaltationState::apparent_roughness, 1},
    {"impact_angle_spread_deg", &SaltationState::impact_angle_spread, degree, false},
};

}  // namespace

SaltationState summary(const SteadyState& s, double impact_threshold) {
  SaltationState state;
  state.friction_velocity = s.friction_velocity;
  state.impact_threshold = impact_threshold;
  state.surface_friction_velocity = s.surface_friction_velocity;
  state.apparent_roughness = s.wind.apparent_roughness();
  if (!s.steady()) return state;
  std::vector<double> speed(s.landings.vx.size()), angle(speed.size());
  for (std::size_t k = 0; k < speed.size(); ++k) {
    speed[k] = std::hypot(s.landings.vx[k], s.landings.vy[k]);
    angle[k] = std::atan2(s.landings.vy[k], s.landings.vx[k]);
  }
  state.mass_flux = s.mass_flux();
  state.impact_rate = s.impact_rate();
  state.impact_speed = s.mean(speed);
  state.impact_angle = s.mean(angle);
  state.impact_angle_spread = s.spread(angle);
  state.hop_length = s.mean(s.landings.length);
  state.hop_height = s.mean(s.landings.apex);
  state.flight_time = s.mean(s.landings.duration);
  return state;
}

std::vector<double> SaltationTable::usual_diameters() {
  return {0.0001, 0.000125, 0.00016, 0.0002, 0.00025, 0.000315, 0.0004, 0.0005, 0.00063, 0.0008, 0.001};
}

std::vector<double> SaltationTable::usual_ratios() {
  return {1.02, 1.1, 1.25, 1.5, 1.8, 2.2, 2.7, 3.3, 4.1, 5};
}

SaltationTable SaltationTable::build(const SaltatingBed& bed, const Kernels& kernels,
                                     const std::vector<double>& diameters,
                                     const std::vector<double>& ratios) {
  require_ascending("diameter", diameters, 0);
  require_ascending("ratio", ratios, 1);
  SaltationTable table;
  table.diameters_ = diameters;
  table.ratios_ = ratios;
  table.grain_density_ = bed.grain.density;
  table.air_density_ = bed.atmosphere.density;
  table.gravity_ = bed.atmosphere.gravity;
  const auto solver_of = [&](double diameter) {
    SaltatingBed one = bed;
    one.grain.diameter = diameter;
    return SaltationSolver(one, *kernels(one), {kept_tolerance});
  };
  for (const double diameter : diameters) {
    const SaltationSolver solver = solver_of(diameter);
    const double threshold = threshold_of(solver);
    std::unique_ptr<SteadyState> last;
    for (const double ratio : ratios) {
      last = std::make_unique<SteadyState>(solved(solver, ratio * threshold, last.get()));
      table.states_.push_back(summary(*last, threshold));
    }
  }
  table.prepare();
  for (std::size_t i = 0; i + 1 < diameters.size(); ++i) {
    const double diameter = std::sqrt(diameters[i] * diameters[i + 1]);
    const SaltationSolver solver = solver_of(diameter);
    const double threshold = threshold_of(solver);
    for (std::size_t j = 0; j + 1 < ratios.size(); ++j) {
      const double u = 0.5 * (ratios[j] + ratios[j + 1]) * threshold;
      const double flux = solved(solver, u, nullptr).mass_flux();
      table.error_ = std::max(table.error_, std::abs(table.state(u, diameter).mass_flux / flux - 1));
    }
  }
  return table;
}

SaltationTable::Scaled SaltationTable::scaled(const SaltationState& s, double diameter) const {
  const double speed = std::sqrt(gravity_ * diameter);
  const double u = s.friction_velocity;
  const double threshold = s.impact_threshold;
  return {s.mass_flux / (threshold * (u * u - threshold * threshold)),
          s.surface_friction_velocity / threshold,
          s.impact_speed / speed,
          s.impact_angle,
          s.impact_angle_spread,
          s.hop_length / diameter,
          s.hop_height / diameter,
          s.flight_time * speed / diameter,
          std::log(s.apparent_roughness / diameter)};
}

void SaltationTable::prepare() {
  for (std::size_t i = 0; i < diameters_.size(); ++i) {
    log_diameter_.push_back(std::log(diameters_[i]));
    const SaltationState* row = &states_[i * ratios_.size()];
    threshold_.push_back(row->impact_threshold / std::sqrt(gravity_ * diameters_[i]));
    std::vector<double> u, flux;
    for (std::size_t j = 0; j < ratios_.size(); ++j) {
      scaled_.push_back(scaled(row[j], diameters_[i]));
      u.push_back(row[j].friction_velocity);
      flux.push_back(row[j].mass_flux);
    }
    laws_.push_back(FluxLaw::fit(row->impact_threshold, u, flux));
  }
}

SaltationTable::Place SaltationTable::diameter_place(double diameter) const {
  if (!(diameter >= diameters_.front() && diameter <= diameters_.back()))
    throw Error("saltation table: the grain's diameter is " + std::to_string(diameter) + " m, must be " +
                std::to_string(diameters_.front()) + " to " + std::to_string(diameters_.back()));
  const double x = std::log(diameter);
  const auto above = std::upper_bound(log_diameter_.begin() + 1, log_diameter_.end() - 1, x);
  const auto i = static_cast<std::size_t>(above - log_diameter_.begin()) - 1;
  return {i, std::clamp((x - log_diameter_[i]) / (log_diameter_[i + 1] - log_diameter_[i]), 0.0, 1.0)};
}

FluxLaw SaltationTable::law(double diameter) const {
  const Place d = diameter_place(diameter);
  const FluxLaw& low = laws_[d.index];
  const FluxLaw& high = laws_[d.index + 1];
  const auto mix = [&](double a, double b) { return a + d.part * (b - a); };
  const double threshold = mix(threshold_[d.index], threshold_[d.index + 1]) * std::sqrt(gravity_ * diameter);
  return {threshold, mix(low.amplitude / low.threshold, high.amplitude / high.threshold) * threshold,
          mix(low.correction, high.correction)};
}

SaltationState SaltationTable::state(double u, double diameter) const {
  if (!(u >= 0) || !std::isfinite(u))
    throw Error("saltation table: friction velocity is " + std::to_string(u) +
                " m/s, must be zero or more and finite");
  const Place d = diameter_place(diameter);
  const double speed = std::sqrt(gravity_ * diameter);
  SaltationState s;
  s.friction_velocity = u;
  s.impact_threshold =
      speed * (threshold_[d.index] + d.part * (threshold_[d.index + 1] - threshold_[d.index]));
  const double threshold = s.impact_threshold;
  const double ratio = std::clamp(u / threshold, ratios_.front(), ratios_.back());
  const auto above = std::upper_bound(ratios_.begin() + 1, ratios_.end() - 1, ratio);
  const auto r = static_cast<std::size_t>(above - ratios_.begin()) - 1;
  const double part = (ratio - ratios_[r]) / (ratios_[r + 1] - ratios_[r]);

  const Scaled* low = &scaled_[d.index * ratios_.size() + r];
  const Scaled* high = low + ratios_.size();
  const auto mix = [&](double Scaled::*value) {
    const double a = low[0].*value + part * (low[1].*value - low[0].*value);
    const double b = high[0].*value + part * (high[1].*value - high[0].*value);
    return a + d.part * (b - a);
  };
  s.impact_speed = mix(&Scaled::speed) * speed;
  s.impact_angle = mix(&Scaled::angle);
  s.impact_angle_spread = mix(&Scaled::spread);
  s.hop_length = mix(&Scaled::length) * diameter;
  s.hop_height = mix(&Scaled::height) * diameter;
  s.flight_time = mix(&Scaled::time) * diameter / speed;
  if (!(u > threshold)) {
    s.surface_friction_velocity = u;
    return s;
  }
  s.surface_friction_velocity = ratio > ratios_.front()
                                    ? mix(&Scaled::surface) * threshold
                                    : threshold + (u - threshold) / (ratio - 1) * (mix(&Scaled::surface) - 1);
  s.apparent_roughness = std::exp(mix(&Scaled::log_roughness)) * diameter;
  s.mass_flux = mix(&Scaled::flux) * threshold * (u * u - threshold * threshold);
  const double volume = M_PI / 6 * diameter * diameter * diameter;
  s.impact_rate = s.mass_flux / (grain_density_ * volume * s.hop_length);
  return s;
}

void SaltationTable::write(const std::string& path, const std::string& command) const {
  Table file;
  const auto add = [&](const std::string& name, const auto& value) {
    file.names.push_back(name);
    auto& column = file.columns.emplace_back();
    for (std::size_t i = 0; i < states_.size(); ++i) column.push_back(value(i));
  };
  add("diameter_m", [&](std::size_t i) { return diameters_[i / ratios_.size()]; });
  add("ratio", [&](std::size_t i) { return ratios_[i % ratios_.size()]; });
  for (const Column& column : columns)
    add(column.name, [&](std::size_t i) { return states_[i].*column.value / column.unit; });
  add("grain_density_kg_m3", [&](std::size_t) { return grain_density_; });
  add("air_density_kg_m3", [&](std::size_t) { return air_density_; });
  add("gravity_m_s2", [&](std::size_t) { return gravity_; });
  add("flux_error", [&](std::size_t) { return error_; });
  write_csv(file, path, command);
}

SaltationTable SaltationTable::read(const std::string& path) {
  const Table file = read_csv(path);
  const auto fail = [&](const std::string& reason) -> void { throw Error(path + ": " + reason); };
  const auto column = [&](const std::string& name) -> const std::vector<double>& {
    if (!file.has(name)) fail("there is no column '" + name + "'");
    const std::vector<double>& values = file.column(name);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!(values[i] >= 0 && std::isfinite(values[i])))
        fail("row " + std::to_string(i + 1) + ": " + name + " is " + std::to_string(values[i]) +
             ", must be zero or more");
    return values;
  };
  SaltationTable table;
  const std::vector<double>& diameter = column("diameter_m");
  const std::vector<double>& ratio = column("ratio");
  for (std::size_t i = 0; i < diameter.size() && diameter[i] == diameter[0]; ++i)
    table.ratios_.push_back(ratio[i]);
  const std::size_t n = table.ratios_.size();
  for (std::size_t i = 0; i < diameter.size(); ++i) {
    if (i % n == 0) table.diameters_.push_back(diameter[i]);
    if (diameter[i] != table.diameters_.back() || ratio[i] != table.ratios_[i % n])
      fail("row " + std::to_string(i + 1) + ": diameter and ratio are not on the grid of the rows before");
  }
  if (n == 0 || diameter.size() % n != 0) fail("the last diameter has not all ratios");
  require_ascending("diameter", table.diameters_, 0);
  require_ascending("ratio", table.ratios_, 1);
  table.states_.resize(diameter.size());
  for (const Column& one : columns) {
    if (!one.needed && !file.has(one.name)) continue;
    const std::vector<double>& values = column(one.name);
    for (std::size_t i = 0; i < values.size(); ++i) table.states_[i].*one.value = values[i] * one.unit;
  }
  for (std::size_t i = 0; i < table.states_.size(); ++i) {
    const SaltationState& s = table.states_[i];
    if (!(s.impact_threshold > 0 && s.friction_velocity > s.impact_threshold && s.mass_flux > 0 &&
          s.apparent_roughness > 0 && s.hop_length > 0))
      fail("row " + std::to_string(i + 1) + ": not a state above its threshold");
  }
  table.grain_density_ = column("grain_density_kg_m3")[0];
  table.air_density_ = column("air_density_kg_m3")[0];
  table.gravity_ = column("gravity_m_s2")[0];
  table.error_ = column("flux_error")[0];
  if (!(table.grain_density_ > 0 && table.gravity_ > 0)) fail("row 1: density and gravity must be positive");
  table.prepare();
  return table;
}

}  // namespace aeolian
