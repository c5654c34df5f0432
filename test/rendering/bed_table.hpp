#pragma once

#include <functional>
#include <vector>

#include <Eigen/Geometry>

namespace aeolian {

/// A bed's heights over a rectangle, tabulated so that a ray caster may ask for them millions of times: a
/// cubic convolution (Keys 1981) between the entries.
class BedTable {
 public:
  struct Surface {
    double height;
    double slope_x;
    double slope_y;
  };

  BedTable(const std::function<double(double, double)>& bed, const Eigen::AlignedBox2d& area, double spacing);
  /// Height and slopes; outside the rectangle those of its border.
  Surface at(double x, double y) const;

 private:
  Eigen::Vector2d origin_;
  double spacing_;
  int columns_;
  int rows_;
  std::vector<float> heights_;  // about middle_, so that a float is good to a nanometre
  double middle_;
};

}  // namespace aeolian
