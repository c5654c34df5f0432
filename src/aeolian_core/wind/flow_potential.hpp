#pragma once

#include <vector>

namespace aeolian {

/// Coefficients of a symmetric seven-point equation on a grid of columns: what leaves each box, the sum over
/// its faces of coefficient times difference of potential, is given; beyond the grid the potential is zero.
///
/// Faces are numbered as in FaceFlows, z fastest.
struct PotentialEquation {
  int nx = 0, ny = 0, nz = 0;
  std::vector<double> x;  ///< (nx + 1) ny nz western faces
  std::vector<double> y;  ///< nx (ny + 1) nz southern faces
  std::vector<double> z;  ///< nx ny (nz + 1) lower faces
};

/// Solves such an equation: conjugate gradients, preconditioned by multigrid over the columns, whose smoother
/// solves whole columns exactly, so that flat and tall boxes alike do no harm.
class FlowPotential {
 public:
  /// `lengths_x`, `lengths_y` of the boxes [m].
  FlowPotential(PotentialEquation equation, const std::vector<double>& lengths_x,
                const std::vector<double>& lengths_y);

  /// Gives the potential of each box, nx ny nz, z fastest. The sum of all boxes' errors is at most
  /// `allowed`, or as small as rounding leaves it.
  std::vector<double> solve(const std::vector<double>& right, double allowed);
  int iterations() const { return iterations_; }

 private:
  struct Level {
    PotentialEquation a;
    std::vector<double> lengths_x, lengths_y;
    std::vector<double> inverse_pivot;  ///< of each box in its column's factors; zero in the ground
    std::vector<double> diagonal;
    std::vector<double> right, potential;
    std::size_t size() const { return diagonal.size(); }
  };
  static Level coarser(const Level& fine);
  static void factor(Level& level);
  static void smooth(Level& level, bool forward);
  static double neighbours(const Level& level, const std::vector<double>& p, int ix, int iy, int iz);
  static void multiply(const Level& level, const std::vector<double>& p, std::vector<double>& result);
  void cycle(std::size_t level);

  std::vector<Level> levels_;
  int iterations_ = 0;
};

}  // namespace aeolian
