#pragma once

#include <cstddef>
#include <vector>

namespace aeolian {

/// Points as floats about a double origin: the true coordinate is origin + (x, y, z) [m]. Large coordinates
/// (UTM) never meet a float. Points that are not finite are allowed and mean "nothing seen".
struct PointCloud {
  double origin_x = 0;
  double origin_y = 0;
  double origin_z = 0;
  std::vector<float> x;
  std::vector<float> y;
  std::vector<float> z;

  std::size_t size() const { return x.size(); }
  /// No points about zero; the memory stays.
  void clear() {
    origin_x = origin_y = origin_z = 0;
    x.clear();
    y.clear();
    z.clear();
  }
  void reserve(std::size_t count) {
    x.reserve(count);
    y.reserve(count);
    z.reserve(count);
  }
  /// Adds a point given in coordinates relative to the origin.
  void push_back(float px, float py, float pz) {
    x.push_back(px);
    y.push_back(py);
    z.push_back(pz);
  }
};

}  // namespace aeolian
