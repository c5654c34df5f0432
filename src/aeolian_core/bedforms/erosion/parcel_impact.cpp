#include "aeolian_core/bedforms/erosion/parcel_impact.hpp"

#include "aeolian_core/grains/mean_splash.hpp"

namespace aeolian {
namespace {

constexpr std::uint64_t first_impact = 2;  ///< counters below are those of the lift-off
constexpr float most_pushed = 30;          ///< parcels by one

/// Downslope bias of what is pushed, as in RippleParameters::slope_effect and doubling_slope.
constexpr float slope_effect = 0.4F;
constexpr float doubling_slope = 0.07F;
constexpr float most_downhill = 10;

std::int32_t units_of(float grains) {
  return static_cast<std::int32_t>(std::min(grains, most_pushed) * ErodibleBed::parcel_units);
}

}  // namespace

ParcelImpacts::ParcelImpacts(const ErosionParameters& parameters, const Grain& grain, const ErodibleBed& bed)
    : bounce_(parameters.bounce),
      stirs_(parameters.snow.has_value()),
      bed_(bed),
      random_(parameters.seed),
      unit_(static_cast<float>(std::sqrt(parameters.air.gravity * grain.diameter))),
      reptation_(static_cast<float>(MeanSplash{}.reptation_length(grain) / bed.geometry().cell())) {}

bool ParcelImpacts::rebounds(float x, float y, std::uint64_t name, std::uint32_t hop,
                             Eigen::Vector3f& velocity, Transfers& transfers) const {
  const Philox::Block bits = random_(first_impact + hop, name);
  const auto uniform = [](std::uint32_t b) { return (static_cast<float>(b >> 8) + 0.5F) * 0x1p-24F; };
  const std::int64_t from = cell_near(bed_, x, y);
  Eigen::Vector2f slope(0, 0);
  if (from >= 0) slope = slope_at(bed_, bed_.geometry().cell_at(static_cast<std::size_t>(from)));
  const BounceResult result = bounced(bounce_, velocity, slope.x(), slope.y(), unit_, uniform(bits[0]));
  if (result.pushed > 0 && stirs_)
    transfers.push_back({x, y, x, y, units_of(result.pushed), Transfer::Kind::stirred, false});
  if (result.pushed > 0 && bounce_.push)
    push(x, y, slope, result.pushed, velocity, uniform(bits[1]), transfers);
  velocity = result.velocity;
  return !result.captured;
}

void ParcelImpacts::push(float x, float y, const Eigen::Vector2f& slope, float grains,
                         const Eigen::Vector3f& velocity, float drawn, Transfers& transfers) const {
  const float speed = std::hypot(velocity.x(), velocity.y());
  const std::int32_t units = units_of(grains);
  if (!(speed > 0) || units == 0) return;
  const float steepness = slope.squaredNorm() / (doubling_slope * doubling_slope);
  const float downhill = std::min(slope_effect * (1 + steepness), most_downhill);
  const float length = -reptation_ * std::log(drawn);
  Transfer t{x,
             y,
             x + length * velocity.x() / speed - reptation_ * downhill * slope.x(),
             y + length * velocity.y() / speed - reptation_ * downhill * slope.y(),
             units,
             Transfer::Kind::pushed,
             false};
  if (bed_.periodic()) {
    t.to_x = on_ring(t.to_x, bed_.geometry().nx());
    t.to_y = on_ring(t.to_y, bed_.geometry().ny());
  }
  t.outside = cell_near(bed_, t.to_x, t.to_y) < 0;
  transfers.push_back(t);
}

}  // namespace aeolian
