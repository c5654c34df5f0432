#pragma once

#include <string>
#include <vector>

namespace aeolian {

/// A recorded wind at one height.
struct WindRecord {
  std::vector<double> time;       ///< [s], increasing
  std::vector<double> speed;      ///< [m/s]
  std::vector<double> direction;  ///< where it blows to, counter-clockwise from east [rad]

  struct Gap {
    double start;  ///< last time before the gap [s]
    double end;    ///< first time after it [s]
  };
  /// Intervals between neighbouring samples longer than `longest` [s].
  std::vector<Gap> gaps(double longest) const;
};

/// Reads columns t_s, speed_m_s and direction_deg (where it blows to, counter-clockwise from east) or
/// from_deg (meteorological) from a CSV file. Rows whose speed or direction is NaN are gaps and left out.
/// Throws Error naming file, row and value for missing columns, negative speeds and times that do not
/// increase.
WindRecord read_wind_record(const std::string& path);

}  // namespace aeolian
