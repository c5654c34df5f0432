#pragma once

#include <array>
#include <vector>

#include "aeolian_core/bedforms/height_map/hop_stage.hpp"

namespace aeolian {

/// One size of grains in a rain of impacts.
struct SizeLaw {
  HopLaw hop;
  double mobility;         ///< depth set moving on a bed of this size alone, over that of the fine one
  bool coarse;             ///< which part of the surface it takes: the coarse fraction, or what it leaves
  double largest = 1e300;  ///< exposure beyond which no more is set moving

  /// Depth set moving at an exposure of one, where so much of the surface is coarse.
  double share(double fraction) const { return mobility * (coarse ? fraction : 1 - fraction); }
};

/// HopStage for grains of two sizes, fine and coarse: one envelope of the impacts, and the flux of each size
/// from the part of the surface that it takes. Grains of a size come down no faster than they arrive or are
/// let go, so that what falls on a station is never negative.
class SortedHopStage {
 public:
  static constexpr int sizes = 2;

  explicit SortedHopStage(int lines);

  /// Sweeps lines [begin, end) to station k: takes their heights at k, k - 1, k - 2, coarse fractions at the
  /// latter two and exposure at k - 2; gives exposure at k - 1 and what comes down of each size at k - 2.
  void sweep(const std::array<SizeLaw, sizes>& law, int begin, int end, const double* height,
             const double* height_1, const double* height_2, const double* fraction_1,
             const double* fraction_2, const double* exposure_2, double* exposure_1,
             const std::array<double*, sizes>& deposition);

  /// As HopStage::begin, on a surface of this coarse fraction.
  void begin(const std::array<SizeLaw, sizes>& law, int line, double height, double fraction, double supply);

  /// As in HopStage, of one size.
  /// @{
  double flux_out(int size, int line) const { return flux_of(size).out[static_cast<std::size_t>(line)]; }
  double flux_in(int size, int line) const { return flux_of(size).in[static_cast<std::size_t>(line)]; }
  /// @}

 private:
  struct Flux {
    std::vector<double> grains, heights, flux, flux_before, in, out;
  };
  const Flux& flux_of(int size) const { return flux_[static_cast<std::size_t>(size)]; }

  std::array<std::vector<double>, ImpactAngles::most> envelope_;
  std::vector<double> stretch_, here_;  ///< exposure of the last stretch and of this one
  std::array<Flux, sizes> flux_;
};

}  // namespace aeolian
