#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "aeolian_core/bedforms/erosion/erodible_bed.hpp"
#include "aeolian_core/bedforms/erosion/launcher.hpp"
#include "aeolian_core/bedforms/erosion/parcel_flight.hpp"
#include "aeolian_core/bedforms/erosion/parcel_impact.hpp"
#include "aeolian_core/bedforms/erosion/particle_erosion.hpp"
#include "aeolian_core/bedforms/erosion/transfers.hpp"

namespace aeolian {

/// A bed with what is in the air above it, moved forward in one wind after the other.
class ErosionRun {
 public:
  ErosionRun(const HeightMap& map, const Grain& grain, const ErosionParameters& parameters);
  ~ErosionRun();

  /// Throws Error for a wind that is not physical.
  void set_wind(const WindField& wind);
  /// Moves forward by a time of the bed [s], or by steps. Returns the time [s].
  double advance(double duration);
  double iterate(std::int64_t steps);

  void store(HeightMap& map) const;
  ErodibleBed& bed() { return bed_; }
  const ErodibleBed& bed() const { return bed_; }
  std::size_t airborne() const { return parcels_.size(); }
  const ErosionCounts& counts() const { return counts_; }

  /// Since the beginning, in units of the bed.
  struct Balance {
    std::int64_t moved = 0, inflow = 0, outflow = 0;
  };
  const Balance& balance() const { return balance_; }
  std::int64_t units() const;  ///< on the bed and in the air

 private:
  struct Batch;
  static constexpr std::uint64_t first_entry = std::uint64_t{1} << 62;  ///< numbers of parcels from outside

  /// Where a parcel begins to fly; floats far above the datum are coarse.
  static float just_above(float ground) { return ground + std::max(2e-6F, 3e-7F * std::abs(ground)); }
  double interval(double left);
  void set_pace(double seconds);
  void let_snow_lie(double time, bool at_once);
  void settle_slopes(int sweeps);
  double fly_step();
  void launch(double attempts);
  void enter(double seconds);
  void take_off(const Launch& launch, std::uint64_t number);
  void fly_batch(std::size_t begin, std::size_t end, Batch& batch);
  void fly_all();
  void hop_round(double attempts, double seconds);
  void hop_batch(std::uint64_t first, std::uint64_t last, bool inflow, Batch& batch) const;
  void stir(const Transfer& transfer);
  void carry_out(const Transfers& transfers);
  void give(const Transfer& transfer, std::int32_t units);
  Launch entry(std::uint64_t number) const;
  double entries_per_second() const;
  void sort_parcels();

  ErosionParameters p_;
  Grain grain_;
  ErodibleBed bed_;
  std::unique_ptr<SnowCover> snow_;
  ParcelImpacts impacts_;
  std::optional<WindField> wind_;
  std::unique_ptr<Drift> drift_;
  std::unique_ptr<Launcher> launcher_;
  ParcelStep step_{};
  double step_time_ = 0;  ///< of the flight [s]
  Parcels parcels_;
  std::vector<Batch> batches_;
  std::uint64_t attempts_ = 0, entries_ = 0;                     ///< so far
  double owed_attempts_ = 0, owed_entries_ = 0, owed_time_ = 0;  ///< parts of one, of one, of a step
  /// Time of the bed over what launches on a flat one would make of it, from what was carried lately over
  /// what the saturated flux would have carried [m^4].
  double pace_ = 1, carried_ = 0, due_ = 0, counted_ = 0;
  double lying_ = 0;     ///< time that the snow has not been told of [s]
  bool hopped_ = false;  ///< whether anything came down in the last round
  int since_slides_ = 0;
  std::int64_t since_awake_ = 0;  ///< was last looked at: intervals
  ErosionCounts counts_;
  Balance balance_;
};

}  // namespace aeolian
