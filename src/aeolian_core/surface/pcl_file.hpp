#pragma once

#include <string>
#include <vector>

namespace aeolian {

/// Coordinates as a file has them, in double.
struct Coordinates {
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> z;
};

/// PCD and PLY through the Point Cloud Library, which nothing else of this room includes. Fields of every
/// number type are accepted and none is narrowed. Both throw Error naming the file and the reason.
Coordinates read_pcl_file(const std::string& path);
/// Binary, with double coordinates; not atomic.
void write_pcl_file(const Coordinates& points, const std::string& path);

}  // namespace aeolian
