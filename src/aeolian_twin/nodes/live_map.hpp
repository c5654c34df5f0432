#pragma once

#include <optional>
#include <string>

#include <ros/time.h>
#include <std_msgs/Header.h>

#include "aeolian_core/measure/fusion.hpp"
#include "aeolian_twin/nodes/map_file.hpp"

namespace aeolian {

/// The map that height_mapper keeps, on ROS' clock: a fusion that begins with the first cloud unless the grid
/// is given, or goes on with a map from a file.
class LiveMap {
 public:
  struct Settings {
    FusionParameters fusion;
    std::string frame = "map";
    double cell_size = 0.002;              ///< of a grid that the first cloud tells [m]
    double max_cells = 25e6;               ///< of any grid
    std::optional<GridGeometry> geometry;  ///< nothing: the grid covers the first cloud
  };

  /// Throws Error for parameters that the fusion refuses and for a grid of too many cells.
  explicit LiveMap(const Settings& settings);

  bool begun() const { return fusion_.has_value(); }
  /// All throw Error unless the map has begun. Of a map of which only some tiles are up to date, see
  /// HeightFusion.
  const HeightMap& map() const;
  const HeightMap& map(const TileMask& up_to_date) const;
  StoredMap stored() const;
  const std::string& frame() const { return settings_.frame; }
  /// Of the newest cloud or the file; zero: none yet.
  ros::Time stamp() const { return stamp_; }
  /// Of messages about the map as it is.
  std_msgs::Header header() const;

  /// Throws Error for a stamp of zero, a first cloud without a usable point, and as HeightFusion::add does.
  FusionResult fuse(const PointCloud& cloud, const Eigen::Isometry3d& pose, const ros::Time& stamp,
                    const SensorNoise& sensor);
  /// Goes on with a map from elsewhere, on its grid. Throws Error for one in another frame or of too many
  /// cells; the map then stays.
  void load(const StoredMap& stored);
  /// Replaces the cells that a map of any grid covers and whose layer `mask` is not NaN there (without such a
  /// layer: whose elevation is known), each by the nearest of its cells. Returns the tiles that have such
  /// cells. Throws Error for a map without elevation or in another frame.
  TileMask replace(const HeightMap& cells, const std::string& frame);
  /// Puts what a model says of a change that has happened into the map: replaces cells as replace() does,
  /// with the patch's variance, so that the next scan of a better sensor soon outweighs it. Throws Error,
  /// too, for a patch without variance or with one that is not positive where its elevation is known.
  TileMask patch(const HeightMap& cells, const std::string& frame);
  void clear();

 private:
  void begin(const GridGeometry& geometry);
  void require_size(const GridGeometry& geometry) const;
  void require_frame(const std::string& frame) const;
  GridGeometry covering(const PointCloud& cloud, const Eigen::Isometry3d& pose,
                        const SensorNoise& sensor) const;
  double seconds(const ros::Time& stamp) const { return (stamp - first_stamp_).toSec(); }
  const HeightFusion& fusion() const;

  Settings settings_;
  std::optional<HeightFusion> fusion_;
  ros::Time first_stamp_;  ///< seconds are doubles only relative to this
  ros::Time stamp_;
};

}  // namespace aeolian
