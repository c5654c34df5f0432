#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "aeolian_core/bedforms/lattice/step_ring.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {

/// Lengths along the bed are in half-spacings: columns of grains stand one half-spacing, sqrt(3)/2 of a grain
/// diameter, apart, as the rows of a close packing stretched to a steepest face of 30 degrees do.
struct SliceParameters {
  int columns = 4096;                         ///< a multiple of 64, at most a million
  double impact_angle = 0.17453292519943295;  ///< [rad]
  int forward = 8;                            ///< reptation length of grains struck on their upstream side
  int backward = 8;        ///< and of those struck on their downstream side, against the wind
  double brink_share = 0;  ///< of impacts that eject a grain at a brink, not the one struck
  int brink_range = 32;    ///< how far from the grain struck a brink is looked for
  int hits_per_point = 1;  ///< grains shot in from each random point, one after the other
};

struct SliceCounts {
  std::int64_t impacts = 0;
  std::int64_t backward = 0;  ///< of the impacts, those on the downstream side of a grain
  std::int64_t refused = 0;   ///< of the impacts, those that found no brink
  std::int64_t ejections() const { return impacts - refused; }
};

/// The lattice bed of Werner (1987, ch. VI; specification sec. 5.2): a vertical slice, one grain thick and
/// along the wind, of circular grains of equal size; periodic. In each column the topmost grain is one layer,
/// half a diameter, above or below those of the columns beside it: it touches them.
///
/// Grains of the same size fly in straight from random places. The one that such a grain touches first
/// reptates a fixed length, downwind if it is touched on its upstream side, else upwind; where it bears
/// others, the free grain at the top of that slope goes in its stead. Or (brink ejection) the last grain of
/// a row does, the first one downwind of the contact; upwind if touched on its downstream side. What comes
/// down moves on, the way it went, to the next pocket. Grains are never made or lost.
class LatticeSlice {
 public:
  /// Height of a layer in half-spacings: tan(30 degrees).
  static constexpr double layer = 0.57735026918962576;

  /// A flat bed, or one of the given heights of its columns in layers: even in even columns, odd in odd
  /// ones, neighbours one apart. Beds of one seed and different streams are independent. Throws Error naming
  /// the parameter or the column that is not allowed.
  LatticeSlice(const SliceParameters& parameters, std::uint64_t seed, std::uint64_t stream = 0);
  LatticeSlice(const SliceParameters& parameters, const std::vector<int>& heights, std::uint64_t seed,
               std::uint64_t stream = 0);

  /// Shoots from so many random points. Throws Error for a negative number.
  void shoot(std::int64_t points);

  std::vector<int> heights() const;       ///< of the columns [layers]
  std::vector<double> elevation() const;  ///< of the columns [half-spacings]
  const SliceCounts& counts() const { return counts_; }
  /// The thesis' clock. A row has a grain every other column.
  double ejections_per_surface_grain() const;

 private:
  /// Where a falling grain touches the bed.
  struct Contact {
    int column;
    int ray;        ///< intercept of the grain's path, in that period of the bed
    bool upstream;  ///< side of the grain touched
  };

  int fall_to(int column) const;
  void find_starts();
  void advance_starts(int column);
  void advance_starts_around(int column);
  void draw_points();
  void shoot_from(const int* point, const int* end);
  Contact first_contact(int ray) const;
  int ejected(const Contact& contact);
  bool disturbed(const Contact& contact, int summit, int pocket) const;
  void take(int summit);
  void put(int pocket);

  SliceParameters parameters_;
  Philox philox_;  ///< of the points
  std::uint64_t stream_;
  RandomStream random_;  ///< of the choices
  StepRing steps_;
  SliceCounts counts_;

  // The falling grain's path is told by its intercept: how high above column 0 it would cross. A grain is
  // touched if the intercept is below the height of the grain plus what the path falls from column 0 to it.
  int datum_ = 0;           ///< intercepts are above this layer
  int unit_ = 1 << 20;      ///< and in whole parts of a layer: so many
  std::uint64_t drop_ = 0;  ///< of the path from column to column [2^-32 units]
  int period_ = 0;          ///< and over the whole bed [units]
  int over_top_ = 0;        ///< by which the downstream side of a summit reaches above the upstream one
  std::vector<int> reach_;  ///< up to which intercept each column is touched; some more that always are
  static constexpr std::size_t batch = 64;
  std::array<int, batch + 1> points_{};  ///< intercepts drawn ahead, and one to look at beyond them
  std::size_t next_ = batch;
  std::uint64_t drawn_ = 0;  ///< blocks of random words
  int bucket_bits_ = 0;      ///< intercepts of one bucket agree but for so many bits
  std::vector<int> start_;   ///< per bucket: no column before this one is touched; columns go on below 0
  int since_starts_ = 0;     ///< were found: points shot from
};

}  // namespace aeolian
