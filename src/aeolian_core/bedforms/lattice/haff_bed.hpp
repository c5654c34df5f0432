#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {

/// Lengths are in effective grain diameters d, angles in radians.
struct HaffParameters {
  int bins = 1000;
  double bin_length = 4;
  double reptation_length = 40;  ///< of every grain; taken to the nearest whole number of bins
  double impact_angle = 0.17453292519943295;
  double angle_of_repose = 0.5235987755982988;
  /// No grain is taken where the bed rises downwind of it more steeply than this, as its loss would steepen
  /// that rise; without it a stoss climbs to repose.
  std::optional<double> steepest_stoss;
};

/// Haff's bed of height bins (Werner 1987, ch. VI; specification sec. 5.1): a slice of sand one grain thick
/// and along the wind, periodic. Grains are shot in at a fixed angle from random places; each sets one grain
/// of the bin that it strikes down a fixed distance downwind and is gone; what is steeper than repose slides.
/// Ripples collide and merge without end. Grains are whole and never made or lost, so volume is exact.
class HaffBed {
 public:
  /// A flat bed. Beds of one seed and different streams are independent. Throws Error naming the parameter
  /// that is not allowed.
  HaffBed(const HaffParameters& parameters, std::uint64_t seed, std::uint64_t stream = 0);
  /// A bed with so many grains above (or below) an even bed in each bin. What is steeper than repose slides.
  HaffBed(const HaffParameters& parameters, std::vector<int> grains, std::uint64_t seed,
          std::uint64_t stream);

  /// Shoots so many grains per d of bed. Throws Error for a negative or infinite number.
  void advance(double impacts_per_diameter);

  std::int64_t impacts() const { return impacts_; }
  std::int64_t moved() const { return moved_; }  ///< grains that impacts set down elsewhere
  double length() const { return parameters_.bin_length * parameters_.bins; }  ///< of the bed [d]
  const std::vector<int>& grains() const { return grains_; }  ///< of each bin, above the flat bed
  std::vector<double> heights() const;                        ///< of each bin [d], above the flat bed

 private:
  int wrapped(int bin) const;
  int struck();
  bool may_leave(int bin) const;
  void move(int from, int to);
  void relax(int bin);

  HaffParameters parameters_;
  RandomStream random_;
  double layer_;     ///< by which a grain raises a bin [d]
  double drop_;      ///< of a falling grain over a bin, in layers
  int hop_;          ///< in bins
  int steepest_;     ///< difference of neighbours at repose, in whole layers
  double rise_;      ///< of neighbours at the steepest stoss, in layers
  int highest_ = 0;  ///< no bin is higher
  std::int64_t impacts_ = 0;
  std::int64_t moved_ = 0;
  double owed_ = 0;  ///< part of an impact not yet shot
  std::vector<int> grains_;
  std::vector<int> unstable_;
};

}  // namespace aeolian
