#pragma once

#include <cstddef>
#include <vector>

#include "aeolian_core/bedforms/height_map/frame_field.hpp"

namespace aeolian {

/// What lies buried in each cell: strata of one thickness, the newest on top, and how much of each is coarse.
/// A fixed number is remembered one by one; what is older is one well-mixed deposit beneath them, and below
/// that lies sand of the bulk composition without end. Nothing is lost: what is buried comes back.
class Strata {
 public:
  Strata() = default;
  /// `thickness` [m], `bulk`: volume fraction of coarse grains.
  Strata(std::size_t cells, int remembered, double thickness, double bulk);

  int remembered() const { return remembered_; }
  double thickness() const { return thickness_; }
  double bulk() const { return bulk_; }

  /// Lays a full stratum with so much coarse sand [m] on a cell.
  void bury(std::size_t cell, float coarse);
  /// Takes the uppermost stratum of a cell away; its coarse sand [m].
  double unearth(std::size_t cell);
  /// Has the memory of a cell fetched that is soon to be buried or unearthed: cells lie far apart.
  void fetch(std::size_t cell) const {
    __builtin_prefetch(&columns_[cell], 1);
    __builtin_prefetch(&coarse_[cell * static_cast<std::size_t>(remembered_)], 1);
  }
  /// Fraction of coarse grains in the stratum that is k-th from above.
  double fraction(std::size_t cell, int k) const;

  /// Coarse sand [m] by which all that was ever buried here and is still there exceeds the bulk's.
  double excess(std::size_t cell) const;

 private:
  /// What is not in a cell's ring.
  struct Column {
    double deep = 0, deep_coarse = 0;  ///< the mixed deposit beneath [m]
    int newest = 0;                    ///< place in the ring
    int many = 0;                      ///< strata in it
  };
  std::size_t slot(std::size_t cell, int k) const {
    const int ahead = columns_[cell].newest - k;
    return cell * static_cast<std::size_t>(remembered_) +
           static_cast<std::size_t>(ahead < 0 ? ahead + remembered_ : ahead);
  }

  int remembered_ = 0;
  double thickness_ = 0;
  double bulk_ = 0;
  std::vector<float, LargePages<float>> coarse_;  ///< [m], a ring for each cell
  std::vector<Column, LargePages<Column>> columns_;
};

}  // namespace aeolian
