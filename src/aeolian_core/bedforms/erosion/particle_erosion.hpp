#pragma once

#include <cstdint>
#include <memory>

#include "aeolian_core/bedforms/bed_model.hpp"
#include "aeolian_core/bedforms/erosion/erosion_parameters.hpp"
#include "aeolian_core/wind/wind_model.hpp"

namespace aeolian {

class ErosionRun;

/// What a model has done so far.
struct ErosionCounts {
  std::int64_t steps = 0;     ///< of the flight, or rounds of hops
  std::int64_t updates = 0;   ///< of a parcel by a step
  std::int64_t hops = 0;      ///< that ended on the bed
  std::int64_t launches = 0;  ///< parcels that left the bed
  double transported = 0;     ///< volume times way along the wind [m^4]
  double slid = 0;            ///< volume [m^3]
};

/// Grains lifted, carried, bounced and dropped over a loose layer on hard ground, in parcels (specification
/// szabo-snow-erosion, after Szabo 2019 and Wang & Hu 2012).
///
/// A parcel is the grains of one cell to a thickness q; it flies as one of them. The layer `ground`, where it
/// is known, is never dug into. With parameters for snow the layer `sintered`, depth of bonded snow on the
/// ground [m], is read at the beginning, and `sintered` and `age` [s] are written. Nothing is lost: what is
/// on the bed, in the air and beyond the borders adds up exactly.
///
/// The model goes on from where it was for as long as the map is what it left there; any other map begins
/// anew, with nothing in the air. Results depend on the inputs and the seed, not on the number of threads.
class ParticleErosion : public BedModel {
 public:
  /// Throws Error naming the parameter that is not allowed.
  explicit ParticleErosion(const ErosionParameters& parameters);
  ~ParticleErosion() override;

  /// The forcing tells wind and grain; nothing moves up to the threshold of the grain itself, whatever the
  /// forcing's ejection rate. In the volume's balance the change is that of bed and air together.
  BedChange advance(HeightMap& map, const Forcing& forcing, double duration) override;
  /// The same in the wind of each cell. Throws Error for a wind that is not physical.
  BedChange advance(HeightMap& map, const WindField& wind, const Grain& grain, double duration);
  /// So many steps of the flight, whatever time they are; with a pool of parcels, Szabo's iterations.
  BedChange iterate(HeightMap& map, const WindField& wind, const Grain& grain, std::int64_t steps);

  const ErosionCounts& counts() const { return counts_; }
  std::size_t airborne() const;          ///< parcels in the air
  double airborne_volume() const;        ///< [m^3]
  double time() const { return time_; }  ///< that the bed was moved forward [s]

 private:
  ErosionRun& run_of(const HeightMap& map, const Grain& grain);
  template <class Advance>
  BedChange change(HeightMap& map, const WindField& wind, const Grain& grain, Advance&& advance);

  ErosionParameters parameters_;
  std::unique_ptr<ErosionRun> run_;
  Grain grain_;
  GridGeometry geometry_;
  HeightMap::Layer left_;  ///< the elevation as the model left it
  ErosionCounts counts_;
  double time_ = 0;
};

}  // namespace aeolian
