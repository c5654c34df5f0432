#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "aeolian_core/wind/wind_probe.hpp"
#include "aeolian_twin/nodes/wind_reader.hpp"

namespace aeolian {

/// The wind at points of the air, for the last field of a WindReader. What is solved for it holds for every
/// speed and the field's sector of directions, and is kept as long as the field's own solution.
class WindProber {
 public:
  /// `reader` must outlive this.
  explicit WindProber(WindReader& reader) : reader_(reader) {}

  /// At points in the frame of the maps [m]; not a number for one beside the map (over relief), or not over
  /// the ground's roughness. Throws Error as long as there is no field.
  std::vector<ProbeReading> at(const std::vector<Eigen::Vector3d>& points);
  /// Gusts at points and their readings; without samples where the mean wind is not known. Point i has `seed`
  /// + i. Throws Error for what synthetic_gusts() does not allow.
  std::vector<Gusts> gusts(const std::vector<Eigen::Vector3d>& points,
                           const std::vector<ProbeReading>& readings, double step, std::size_t samples,
                           std::uint64_t seed) const;

 private:
  std::vector<double> heights_of(const std::vector<Eigen::Vector3d>& points) const;
  void solve(double top);

  WindReader& reader_;
  std::unique_ptr<WindProbe> probe_;  ///< for a friction velocity of the surroundings of one
  double direction_ = 0;              ///< that it was made for [rad]
  double top_ = 0;                    ///< that it reaches over the ground [m]
  int solutions_ = -1;                ///< of the reader's model
};

}  // namespace aeolian
