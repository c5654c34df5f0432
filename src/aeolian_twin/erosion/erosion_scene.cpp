#include "aeolian_twin/erosion/erosion_scene.hpp"

#include <fmt/format.h>

#include "aeolian_core/bedforms/erosion/snow_cover.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/text.hpp"
#include "aeolian_core/surface/yaml_section.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_core/wind/log_law.hpp"
#include "aeolian_core/wind/terrain_wind.hpp"

namespace aeolian {
namespace {

constexpr double snow_roughness = 1e-4;  ///< [m]
constexpr double sand_diameter = 1.5e-4;

void read_number(YamlSection& section, const std::string& key, double low, double high, double scale,
                 double& value) {
  if (section.has(key)) value = scale * section.number(key, low, high);
}

}  // namespace

Grain ErosionScene::grain() const {
  if (snow) return drifting_snow();
  Grain sand;
  sand.diameter = sand_diameter;
  sand.angle_of_repose = 34 * M_PI / 180;
  return sand;
}

WindInput ErosionScene::wind_input() const {
  WindInput input;
  input.speed = wind_speed;
  input.height = wind_height;
  input.direction = direction;
  return input;
}

std::unique_ptr<WindModel> ErosionScene::wind_model() const {
  const double roughness =
      parameters.roughness > 0 ? parameters.roughness : grain_roughness(grain().diameter);
  if (!(terrain_wind > 0)) return std::make_unique<LogLawWind>(roughness);
  TerrainWindSettings settings;
  settings.relief.roughness = roughness;
  settings.relief.shortest_wavelength = 8 * cell;
  settings.backend = WindBackend::spectral;
  settings.relief.periodic = parameters.border == Border::periodic;
  return std::make_unique<TerrainWind>(settings);
}

WindField ErosionScene::wind() const {
  ErosionScene flat = *this;
  flat.terrain_wind = 0;
  return flat.wind_model()->solve(wind_input(), nullptr);
}

ErosionParameters ErosionScene::chosen_parameters(std::uint64_t seed) const {
  ErosionParameters p = parameters;
  if (model == "thesis_compatible") {
    p = thesis_erosion();
    p.air = parameters.air;
    p.roughness = parameters.roughness;
    p.snow = parameters.snow;
    p.border = parameters.border;
  }
  if (model == "hop_table") p.flight = FlightMode::hop_table;
  p.seed = seed;
  return p;
}

void set_material(ErosionScene& scene, const std::string& material) {
  if (material != "sand" && material != "snow")
    throw Error("material: '" + material + "', must be sand or snow");
  scene.snow = material == "snow";
  if (!scene.snow) {
    scene.parameters.snow.reset();
    return;
  }
  if (!scene.parameters.snow) scene.parameters.snow = SnowBonding{};
  scene.parameters.roughness = snow_roughness;
  scene.parameters.air = {1.3, 1.3e-5, 9.81};
}

void set_wind(ErosionScene& scene, const std::string& text) {
  const auto at = text.find('@');
  const auto speed = parse_number(text.substr(0, at));
  const auto height = at == std::string::npos ? std::nullopt : parse_number(text.substr(at + 1));
  if (!speed || !height || !(*speed >= 0 && *speed <= 100 && *height >= 0.05 && *height <= 1000))
    throw Error("--wind: '" + text +
                "' must be SPEED@HEIGHT in m/s and m, 0 to 100 and 0.05 to 1000, like 12@10");
  scene.wind_speed = *speed;
  scene.wind_height = *height;
}

ErosionScene read_erosion_scene(const std::string& path) {
  YamlSection root = YamlSection::load(path);
  ErosionScene s;
  set_material(s, root.text("material"));
  s.terrain = root.text("terrain");
  s.length = root.number("length_m", 0.01, 1e5);
  s.width = root.number("width_m", 0.01, 1e5);
  s.cell = root.number("cell_m", 1e-4, 100);
  if (s.length / s.cell * (s.width / s.cell) > 1e8 || s.length < 4 * s.cell || s.width < 4 * s.cell)
    throw Error(path + ": cell_m must make 4 cells or more each way and at most 1e8");
  s.cover.depth = root.number("loose_depth_mm", 0, 1e5) / 1000;
  read_number(root, "cover_share", 0.001, 1, 1, s.cover.share);
  read_number(root, "heap_radius_m", 0.001, 1e4, 1, s.cover.heap);
  set_wind(s, root.text("wind"));
  s.direction = degrees_to_radians(root.number("direction_deg", -360, 360));
  s.minutes = root.number("minutes", 1e-3, 1e6);
  read_number(root, "terrain_wind_s", 0, 1e6, 1, s.terrain_wind);
  if (root.has("model")) s.model = root.text("model");
  if (s.model != "particles" && s.model != "hop_table" && s.model != "thesis_compatible")
    root.refuse("model", "must be particles, hop_table or thesis_compatible");
  if (root.has("open_border") && root.flag("open_border")) s.parameters.border = Border::open;
  read_number(root, "inflow", 0, 10, 1, s.parameters.inflow);
  read_number(root, "parcel_mm", 0.001, 100, 1e-3, s.parameters.parcel_thickness);
  read_number(root, "acceleration", 1e-3, 1e5, 1, s.parameters.acceleration);
  if (root.has("push")) s.parameters.bounce.push = root.flag("push");
  if (root.has("bounce")) {
    const std::string law = root.text("bounce");
    if (law != "attenuated" && law != "measured") root.refuse("bounce", "must be attenuated or measured");
    s.parameters.bounce.law = law == "measured" ? BounceLaw::measured : BounceLaw::attenuated;
  }
  if (s.parameters.snow) {
    SnowBonding& snow = *s.parameters.snow;
    read_number(root, "temperature_c", -90, 50, 1, snow.temperature);
    read_number(root, "snow_age_h", 0, 1e5, 3600, snow.initial_age);
    read_number(root, "snowfall_mm_h", 0, 1e3, 1.0 / 3600, snow.snowfall);  // of water, 1 mm = 1 kg/m^2
    read_number(root, "bond_exponent", 1e-3, 10, 1, snow.exponent);
    read_number(root, "sintered_share", 0, 1, 1, snow.sintered_share);
  }
  if (root.has("expected")) s.expected = root.text("expected");
  root.finish();
  return s;
}

}  // namespace aeolian
