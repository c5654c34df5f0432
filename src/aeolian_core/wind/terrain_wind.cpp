#include "aeolian_core/wind/terrain_wind.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"
#include "aeolian_core/wind/direction.hpp"

namespace aeolian {
namespace {

constexpr Require require("wind over terrain");
constexpr double level_slope = 0.01;
constexpr double gentle_slope = 0.3;
constexpr double gentle_slope_for_stress = 0.4;
constexpr int direction_tries = 4;  ///< until the wind of an anemometer and its sector agree

/// The sum of squared slopes.
double energy(const WindRelief& relief) {
  double sum = 0;
  for (int y = 0; y < relief.geometry.ny(); ++y)
    for (int x = 0; x < relief.geometry.nx(); ++x) {
      const Slope s = slope_at(relief, x, y);
      sum += s.x * s.x + s.y * s.y;
    }
  return sum;
}

void require_physical(const WindInput& input) {
  require(std::isfinite(input.direction), "direction", input.direction, "finite [rad]");
  require(input.air_density > 0 && std::isfinite(input.air_density), "air density", input.air_density,
          "positive [kg/m^3]");
}

}  // namespace

std::string name_of(WindBackend backend) {
  switch (backend) {
    case WindBackend::log_law:
      return "log law";
    case WindBackend::spectral:
      return "spectral";
    case WindBackend::sph:
      return "SPH";
    case WindBackend::thesis_compatible:
      return "thesis compatible";
    default:
      return "mass consistent";
  }
}

std::optional<WindBackend> backend_of(const std::string& word) {
  if (word == "log") return WindBackend::log_law;
  if (word == "spectral") return WindBackend::spectral;
  if (word == "mass_consistent") return WindBackend::mass_consistent;
  if (word == "sph") return WindBackend::sph;
  if (word == "thesis_compatible") return WindBackend::thesis_compatible;
  return std::nullopt;
}

WindBackend choose_backend(const WindRelief& relief, double direction, const ReliefSettings& settings,
                           WindQuestion question) {
  const double steep = steepness(relief);
  if (steep < level_slope) return WindBackend::log_law;
  const double gentle = question == WindQuestion::velocities ? gentle_slope : gentle_slope_for_stress;
  const bool suits =
      steep <= gentle || steepness(sheltered(relief, direction, settings.bubble).relief) <= gentle;
  return suits ? WindBackend::spectral : WindBackend::mass_consistent;
}

struct TerrainWind::Solution {
  double direction = 0;  ///< [rad]
  WindBackend backend = WindBackend::log_law;
  TerrainResponse response;
  struct Placed {
    MapPoint place;
    double height;
    AirVelocity wind;
  };
  std::vector<Placed> anemometers;
};

TerrainWind::TerrainWind(const TerrainWindSettings& settings) : settings_(settings) {
  SpectralWind checked(settings.relief);
  require(settings.sector >= 0 && settings.sector <= M_PI / 2, "sector", settings.sector, "0 to pi/2 [rad]");
  require(settings.change >= 0 && settings.change < 1, "change", settings.change, "0 to below 1");
}
TerrainWind::~TerrainWind() = default;

void TerrainWind::watch(const HeightMap& surface, double time) {
  const HeightMap::Layer& elevation = surface.layer(layer::elevation);
  const bool same_grid = surface.geometry() == relief_.geometry && !elevation_.empty();
  if (same_grid && std::memcmp(elevation.data(), elevation_.data(), sizeof(float) * elevation.size()) == 0)
    return;
  WindRelief relief = wind_relief(surface, settings_.relief.shortest(), settings_.relief.periodic);
  bool changed = !same_grid;
  if (same_grid) {
    WindRelief difference = relief;
    for (std::size_t i = 0; i < difference.height.size(); ++i) {
      difference.height[i] -= relief_.height[i];
      changed = changed || std::isfinite(elevation[i]) != std::isfinite(elevation_[i]);
    }
    changed = changed || energy(difference) > settings_.change * energy(relief_);
  }
  elevation_ = elevation;
  if (!changed) return;
  relief_ = std::move(relief);
  since_ = time;
  solved_.clear();
}

TerrainWind::Solution& TerrainWind::solution(const HeightMap& surface, double direction) {
  const double middle = settings_.sector > 0
                            ? wrap_angle(settings_.sector * std::round(direction / settings_.sector))
                            : direction;
  for (const auto& known : solved_)
    if (std::abs(wrap_angle(known->direction - middle)) < 1e-9) return *known;
  const ReliefSettings& relief = settings_.relief;
  auto made = std::make_unique<Solution>();
  made->direction = middle;
  made->backend =
      settings_.backend.value_or(choose_backend(relief_, middle, relief, WindQuestion::surface_stress));
  if (made->backend == WindBackend::spectral) made->response = SpectralWind(relief).solve(surface, middle);
  if (made->backend == WindBackend::mass_consistent)
    made->response = mass_consistent_response(surface, middle, relief, settings_.volume);
  if (made->backend == WindBackend::sph)
    made->response = sph_response(surface, middle, relief, settings_.sph);
  if (made->backend == WindBackend::thesis_compatible)
    made->response = thesis_response(surface, middle, relief, settings_.thesis);
  ++solutions_;
  if (settings_.sector == 0) solved_.clear();
  solved_.push_back(std::move(made));
  return *solved_.back();
}

std::unique_ptr<WindVolume> TerrainWind::volume(const HeightMap& surface, double direction,
                                                double top) const {
  const ReliefSettings& settings = settings_.relief;
  const WindRelief relief = wind_relief(surface, settings.shortest(), settings.periodic);
  const UpwindProfile upwind = UpwindProfile::log_law(settings.roughness);
  switch (settings_.backend.value_or(choose_backend(relief, direction, settings, WindQuestion::velocities))) {
    case WindBackend::spectral:
      return std::make_unique<SpectralVolume>(relief, direction, upwind, settings.bubble, top);
    case WindBackend::mass_consistent:
      return std::make_unique<MassConsistentVolume>(relief, direction, upwind, settings_.volume);
    case WindBackend::sph:
      return std::make_unique<SphVolume>(relief, direction, upwind, settings_.sph);
    case WindBackend::thesis_compatible:
      return std::make_unique<ThesisVolume>(relief, direction, upwind, settings_.thesis);
    default:
      return nullptr;
  }
}

const AirVelocity& TerrainWind::at_anemometer(Solution& solution, const HeightMap& surface,
                                              const WindInput& input) {
  for (const Solution::Placed& known : solution.anemometers)
    if (known.place == *input.place && known.height == input.height) return known.wind;
  const std::string here = fmt::format("anemometer at ({:g}, {:g}) m", input.place->x, input.place->y);
  const auto cell = surface.geometry().find(input.place->x, input.place->y);
  if (!cell) throw Error(here + ": it stands beside the map");
  const std::size_t i = surface.geometry().index(*cell);
  if (solution.backend != WindBackend::log_law) {
    if (!std::isfinite(solution.response.friction[i])) throw Error(here + ": the ground is not known there");
    if (solution.response.separated[i] > 0)
      throw Error(here +
                  ": it stands in the air that separates behind a lee, whose wind does not tell that of the "
                  "surroundings");
    if (!(solution.response.friction[i] > 0))
      throw Error(here +
                  ": the relief holds the air still there, its wind does not tell that of the surroundings");
  }
  AirVelocity wind;
  if (solution.backend == WindBackend::log_law) {
    const double speed = log_law_speed(1, input.height, settings_.relief.roughness);
    wind = {speed * std::cos(solution.direction), speed * std::sin(solution.direction), 0};
  } else {
    TerrainWindSettings same = settings_;
    same.backend = solution.backend;
    const auto air = TerrainWind(same).volume(surface, solution.direction, 1.5 * input.height);
    wind = air->velocity(input.place->x, input.place->y, input.height);
    if (!(std::hypot(wind.east, wind.north) > 0))
      throw Error(
          here + fmt::format(": at {:g} m it is within separated air or above what is solved", input.height));
  }
  solution.anemometers.push_back({*input.place, input.height, wind});
  return solution.anemometers.back().wind;
}

TerrainWind::Surroundings TerrainWind::surroundings(const WindInput& input, const HeightMap* surface) {
  require_physical(input);
  const double level = friction_velocity(input.speed, input.height, settings_.relief.roughness);
  if (surface == nullptr || !input.place) return {level, wrap_angle(input.direction)};
  double direction = input.direction;
  double speed = 1;
  for (int n = 0; n < direction_tries; ++n) {
    Solution& known = solution(*surface, direction);
    const AirVelocity& wind = at_anemometer(known, *surface, input);
    speed = std::hypot(wind.east, wind.north);
    const double turned = wrap_angle(std::atan2(wind.north, wind.east) - known.direction);
    const double before = direction;
    direction = wrap_angle(input.direction - turned);
    if (std::abs(wrap_angle(direction - before)) < 1e-3) break;
  }
  return {input.speed / speed, direction};
}

WindField TerrainWind::solve(const WindInput& input, const HeightMap* surface) {
  return solve(std::vector<WindInput>{input}, surface);
}

WindField TerrainWind::solve(const std::vector<WindInput>& inputs, const HeightMap* surface) {
  if (inputs.empty()) throw Error("wind over terrain: there is no reading of an anemometer");
  const double time = inputs.back().time;
  if (surface != nullptr) watch(*surface, time);
  double east = 0;
  double north = 0;
  WindField field;
  field.air_density = 0;
  for (const WindInput& input : inputs) {
    const Surroundings one = surroundings(input, surface);
    const double part = 1.0 / static_cast<double>(inputs.size());
    east += part * one.friction_velocity * std::cos(one.direction);
    north += part * one.friction_velocity * std::sin(one.direction);
    field.air_density += part * input.air_density;
    field.friction_velocity = one.friction_velocity;
    field.direction = one.direction;
  }
  if (inputs.size() > 1) {
    field.friction_velocity = std::hypot(east, north);
    field.direction = std::atan2(north, east);
  }
  field.model = name_of(WindBackend::log_law);
  if (surface == nullptr) return field;
  const Solution& known = solution(*surface, field.direction);
  field.model = name_of(known.backend);
  field.age = std::max(0.0, time - since_);
  if (known.backend == WindBackend::log_law) return field;
  const std::size_t n = surface->geometry().size();
  HeightMap::Layer friction(n);
  HeightMap::Layer direction(n);
  const auto scale = static_cast<float>(field.friction_velocity);
  const auto main = static_cast<float>(field.direction);
  constexpr auto pi = static_cast<float>(M_PI);
  for (std::size_t i = 0; i < n; ++i) friction[i] = scale * known.response.friction[i];
  for (std::size_t i = 0; i < n; ++i) {
    const float turned = main + known.response.deflection[i];
    direction[i] = turned > pi ? turned - 2 * pi : turned <= -pi ? turned + 2 * pi : turned;
  }
  field.cells = HeightMap(surface->geometry());
  field.cells.add("friction_velocity", std::move(friction));
  field.cells.add("direction", std::move(direction));
  field.cells.add("separated", known.response.separated);
  return field;
}

}  // namespace aeolian
