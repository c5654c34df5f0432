#include "aeolian_twin/nodes/sensor_file.hpp"

#include "aeolian_core/surface/yaml_section.hpp"

namespace aeolian {

SensorFile read_sensor_file(const std::string& path) {
  YamlSection file = YamlSection::load(path);
  SensorFile sensor;
  sensor.name = file.text("name");
  sensor.noise.range_sigma = file.positive("range_sigma_m");
  sensor.noise.range_sigma_per_metre = file.number("range_sigma_per_m", -1, 1);
  sensor.noise.range_sigma_per_square_metre = file.number("range_sigma_per_m2", 0, 1);
  sensor.noise.angular_sigma = file.number("angular_sigma_deg", 0, 10) * M_PI / 180;
  sensor.noise.incidence_growth = file.number("incidence_growth", 0, 10);
  sensor.noise.range_bias = file.number("range_bias_m", -10, 10);
  sensor.noise.min_range = file.number("min_range_m", 0, 1e6);
  sensor.noise.max_range = file.positive("max_range_m");
  file.finish();
  if (sensor.noise.max_range <= sensor.noise.min_range)
    file.refuse("max_range_m", "must be greater than min_range_m");
  try {
    sensor.noise.require_valid();
  } catch (const Error& error) {
    throw Error(path + ": " + error.what());
  }
  return sensor;
}

}  // namespace aeolian
