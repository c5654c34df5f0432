#include "aeolian_core/wind/wind_volume.hpp"

#include <algorithm>

namespace aeolian {

FaceFlows::FaceFlows(int nx, int ny, int nz)
    : nx_(nx),
      ny_(ny),
      nz_(nz),
      x_(up(nx + 1) * up(ny) * up(nz)),
      y_(up(nx) * up(ny + 1) * up(nz)),
      z_(up(nx) * up(ny) * up(nz + 1)) {}

FaceFlows::Balance FaceFlows::balance(const BoxRange& box) const {
  Balance sum;
  const auto leaves = [&](double flow) {
    sum.net += flow;
    sum.inflow += std::max(0.0, -flow);
  };
  for (int iz = box.z0; iz < box.z1; ++iz) {
    for (int iy = box.y0; iy < box.y1; ++iy) {
      leaves(-x(box.x0, iy, iz));
      leaves(x(box.x1, iy, iz));
    }
    for (int ix = box.x0; ix < box.x1; ++ix) {
      leaves(-y(ix, box.y0, iz));
      leaves(y(ix, box.y1, iz));
    }
  }
  for (int iy = box.y0; iy < box.y1; ++iy)
    for (int ix = box.x0; ix < box.x1; ++ix) {
      leaves(-z(ix, iy, box.z0));
      leaves(z(ix, iy, box.z1));
    }
  return sum;
}

}  // namespace aeolian
