#include "aeolian_core/wind/wind_record.hpp"

#include <cmath>

#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/direction.hpp"

namespace aeolian {
namespace {

/// The one direction column of a table: ours, or the meteorological one turned into ours [rad].
std::vector<double> read_directions(const Table& table, const std::string& path) {
  const bool ours = table.has("direction_deg");
  if (ours == table.has("from_deg"))
    throw Error(
        "wind record " + path + ": has " + (ours ? "both" : "neither") +
        " of the columns direction_deg (where the wind blows to, counter-clockwise from east) and from_deg "
        "(meteorological), exactly one is needed");
  std::vector<double> directions = table.column(ours ? "direction_deg" : "from_deg");
  for (double& d : directions)
    d = ours ? wrap_angle(degrees_to_radians(d)) : direction_from_meteorological(d);
  return directions;
}

const std::vector<double>& require_column(const Table& table, const std::string& name,
                                          const std::string& path) {
  if (!table.has(name)) throw Error("wind record " + path + ": there is no column " + name);
  return table.column(name);
}

}  // namespace

std::vector<WindRecord::Gap> WindRecord::gaps(double longest) const {
  std::vector<Gap> result;
  for (std::size_t i = 1; i < time.size(); ++i)
    if (time[i] - time[i - 1] > longest) result.push_back({time[i - 1], time[i]});
  return result;
}

WindRecord read_wind_record(const std::string& path) {
  const Table table = read_csv(path);
  const std::vector<double>& times = require_column(table, "t_s", path);
  const std::vector<double>& speeds = require_column(table, "speed_m_s", path);
  const std::vector<double> directions = read_directions(table, path);
  const auto reject = [&](std::size_t row, const std::string& why) {
    throw Error("wind record " + path + ", row " + std::to_string(row + 1) + ": " + why);
  };
  WindRecord record;
  double last_time = -INFINITY;
  for (std::size_t row = 0; row < times.size(); ++row) {
    const double time = times[row];
    if (!std::isfinite(time)) reject(row, "t_s is missing or not finite");
    if (!(time > last_time))
      reject(row,
             "t_s is " + std::to_string(time) + " after " + std::to_string(last_time) + ", must increase");
    last_time = time;
    if (std::isnan(speeds[row]) || std::isnan(directions[row])) continue;
    if (!(speeds[row] >= 0) || !std::isfinite(speeds[row]))
      reject(row, "speed_m_s is " + std::to_string(speeds[row]) + ", must be zero or positive");
    record.time.push_back(time);
    record.speed.push_back(speeds[row]);
    record.direction.push_back(directions[row]);
  }
  return record;
}

}  // namespace aeolian
