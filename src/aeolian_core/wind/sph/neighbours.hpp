#pragma once

#include "aeolian_core/wind/sph/cell_order.hpp"
#include "aeolian_core/wind/sph/wendland.hpp"

namespace aeolian::sph {

/// What a particle sees of a neighbour: V grad W in the first three places, and in the fourth the weight of
/// the neighbour in the Laplacian, 2 V (-W'/r).
///
/// Each particle has a row of neighbours and, near the ground or the lid, of their images in the plane that
/// touches the wall nearest to it: the image of j, seen from i, is |r_i - r_j|^2 + 4 d_i d_j away (d:
/// distance from the wall), which is the same seen from j. So the wall needs no particles of its own, no air
/// leaves through it, and the sums near it are as complete as far from it.
struct NeighbourRows {
  std::vector<std::size_t> begin, images, end;
  std::vector<std::uint32_t> who;
  std::vector<float> weight;  ///< the fourth number alone, for the pressure
  std::vector<Four> gradient;
};

/// Of each particle, summed while its neighbours are found.
struct NeighbourSums {
  /// Columns of the inverse of sum V (r_j - r_i) grad W, which makes gradients exact for linear fields (Bonet
  /// & Lok 1999).
  std::vector<Four> correction[3];
  /// The same without images, of particles near a wall.
  std::vector<Four> beside[3];
  std::vector<Four> crowding;   ///< sum V grad W: towards where the particles are too many
  std::vector<float> diagonal;  ///< of the Laplacian
};

class NeighbourFinder {
 public:
  NeighbourFinder(const Torus& torus, float support);

  /// `place`: of particles in the order of `cells`, the distance from the nearest wall in the fourth place;
  /// `normal` of that wall.
  void find(const CellOrder& cells, const std::vector<Four>& place, const std::vector<Four>& normal);

  const NeighbourRows& rows() const { return rows_; }
  const NeighbourSums& sums() const { return sums_; }
  const Wendland& kernel() const { return kernel_; }
  float volume() const { return volume_; }
  /// Rows whose particles are spread too badly for the correction: they do without.
  std::size_t uncorrected() const { return uncorrected_; }

 private:
  struct Candidates;
  bool fill_row(const CellOrder& cells, int y, int z, const std::vector<Four>& place,
                const std::vector<Four>& normal, Candidates& near);

  Torus torus_;
  Wendland kernel_;
  float volume_;
  std::size_t most_;  ///< entries that a row may have, on average over a row of cells
  NeighbourRows rows_;
  NeighbourSums sums_;
  std::size_t uncorrected_ = 0;
};

}  // namespace aeolian::sph
