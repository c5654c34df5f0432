#pragma once

#include <string>
#include <vector>

#include <std_msgs/Header.h>
#include <visualization_msgs/Marker.h>

#include "aeolian_twin/nodes/drawn_cells.hpp"

namespace aeolian {

/// What stands beside a drawn map. Sizes go with the map's.
struct MapLegend {
  const GridGeometry& geometry;
  const SurfaceLook& look;
  double lowest = 0;  ///< height at which the map is drawn [m]
  std::string title;
  std::string unit;  ///< of the values
  std_msgs::Header header;

  /// The title above the map; below it a bar of the palette with the values of its ends and middle.
  std::vector<visualization_msgs::Marker> markers() const;
  /// The title, and what takes away a bar that was drawn before.
  std::vector<visualization_msgs::Marker> only_title() const;

 private:
  visualization_msgs::Marker marker(const std::string& ns, int id, int type) const;
  visualization_msgs::Marker text(const std::string& ns, int id, const std::string& words, double east,
                                  double north) const;
  visualization_msgs::Marker bar() const;
  double line() const;
};

/// Values of a range's ends and middle as a person reads them: "-3.6 mm", "0 mm", "1.25 m"; of another unit
/// than metres "0.31 m/s".
std::string value_words(double value, const ValueRange& range, const std::string& unit = "m");

}  // namespace aeolian
