#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {

aeolian_msgs::Comparison to_message(const Comparison& c, const std_msgs::Header& header,
                                    const ros::Time& issued) {
  aeolian_msgs::Comparison m;
  m.header = header;
  m.issued = issued;
  m.lead_time = (header.stamp - issued).toSec();
  m.cells = static_cast<std::uint32_t>(c.cells);
  m.bias = c.bias;
  m.rmse = c.rmse;
  m.nmad = c.nmad;
  m.volume_change_measured = c.volume_change_measured;
  m.volume_change_predicted = c.volume_change_predicted;
  m.wavelength_measured = c.wavelength_measured;
  m.wavelength_predicted = c.wavelength_predicted;
  m.height_measured = c.height_measured;
  m.height_predicted = c.height_predicted;
  m.displacement_measured = c.displacement_measured;
  m.displacement_predicted = c.displacement_predicted;
  m.rmse_persistence = c.rmse_persistence;
  m.rmse_translation = c.rmse_translation;
  m.skill_persistence = c.skill_persistence;
  m.skill_translation = c.skill_translation;
  return m;
}

Comparison to_comparison(const aeolian_msgs::Comparison& m) {
  Comparison c;
  c.cells = m.cells;
  c.bias = m.bias;
  c.rmse = m.rmse;
  c.nmad = m.nmad;
  c.volume_change_measured = m.volume_change_measured;
  c.volume_change_predicted = m.volume_change_predicted;
  c.wavelength_measured = m.wavelength_measured;
  c.wavelength_predicted = m.wavelength_predicted;
  c.height_measured = m.height_measured;
  c.height_predicted = m.height_predicted;
  c.displacement_measured = m.displacement_measured;
  c.displacement_predicted = m.displacement_predicted;
  c.rmse_persistence = m.rmse_persistence;
  c.rmse_translation = m.rmse_translation;
  c.skill_persistence = m.skill_persistence;
  c.skill_translation = m.skill_translation;
  return c;
}

}  // namespace aeolian
