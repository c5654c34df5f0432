#pragma once

#include <cstddef>
#include <vector>

namespace aeolian {

/// Of the air at a point, in units of the upwind profile: times the friction velocity of the surroundings
/// where that is a log law, times their speed where it is uniform.
struct AirVelocity {
  double east = 0;
  double north = 0;
  double up = 0;
};

/// Boxes of a grid, half open.
struct BoxRange {
  int x0, x1, y0, y1, z0, z1;
};

/// What flows through the faces of a grid of boxes [m^3/s in the volume's unit], eastwards, northwards,
/// upwards.
class FaceFlows {
 public:
  FaceFlows() = default;
  FaceFlows(int nx, int ny, int nz);

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  int nz() const { return nz_; }
  /// Through the western, southern, lower face of box (x, y, z); x, y or z one beyond the last gives the
  /// opposite one of the last.
  double& x(int ix, int iy, int iz) { return x_[(at(ix, iy, nx_ + 1)) * height() + up(iz)]; }
  double x(int ix, int iy, int iz) const { return x_[(at(ix, iy, nx_ + 1)) * height() + up(iz)]; }
  double& y(int ix, int iy, int iz) { return y_[(at(ix, iy, nx_)) * height() + up(iz)]; }
  double y(int ix, int iy, int iz) const { return y_[(at(ix, iy, nx_)) * height() + up(iz)]; }
  double& z(int ix, int iy, int iz) { return z_[(at(ix, iy, nx_)) * (height() + 1) + up(iz)]; }
  double z(int ix, int iy, int iz) const { return z_[(at(ix, iy, nx_)) * (height() + 1) + up(iz)]; }

  /// What leaves a range of boxes less what enters it, and what enters it.
  struct Balance {
    double net = 0;
    double inflow = 0;
  };
  Balance balance(const BoxRange& box) const;

 private:
  static std::size_t up(int i) { return static_cast<std::size_t>(i); }
  static std::size_t at(int ix, int iy, int row) { return up(iy) * up(row) + up(ix); }
  std::size_t height() const { return up(nz_); }

  int nx_ = 0, ny_ = 0, nz_ = 0;
  std::vector<double> x_, y_, z_;
};

/// The wind in the air over a map.
class WindVolume {
 public:
  virtual ~WindVolume() = default;
  /// At a point of the map [m] and a height over its ground [m]. Not a number beside the map or above top();
  /// zero in the ground, and in separated air, whose mean wind no model here knows.
  virtual AirVelocity velocity(double x, double y, double height) const = 0;
  /// Up to where it reaches over the ground [m].
  virtual double top() const = 0;
  virtual const FaceFlows& flows() const = 0;
};

}  // namespace aeolian
