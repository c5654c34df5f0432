#include "aeolian_core/bedforms/erosion/launcher.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/bedforms/erosion/drift_laws.hpp"
#include "aeolian_core/bedforms/erosion/surface_patch.hpp"

namespace aeolian {
namespace {

constexpr float most_exposed_by_rays = 3;
constexpr int tile_cells = TileMask::tile_cells;

float uniform(std::uint32_t bits) { return (static_cast<float>(bits >> 8) + 0.5F) * 0x1p-24F; }

}  // namespace

Launcher::Launcher(const ErosionParameters& parameters, const Grain& grain, const ErodibleBed& bed,
                   const Drift& drift, const SnowCover* snow)
    : p_(parameters),
      grain_(grain),
      bed_(bed),
      drift_(drift),
      snow_(snow),
      random_(parameters.seed),
      fall_(static_cast<float>(bed.geometry().cell() * std::tan(parameters.shelter_angle))),
      tan_repose_(static_cast<float>(std::tan(grain.angle_of_repose))),
      most_exposed_(parameters.shelter == Shelter::ray ? most_exposed_by_rays : 1) {
  const double bare = lifting_threshold(grain, parameters.air, 0);
  const double sticky = lifting_threshold(grain, parameters.air, parameters.cohesion);
  weight_ = static_cast<float>(bare * bare);
  sticks_ = static_cast<float>(sticky * sticky - bare * bare);
}

/// Whether the bed upwind hides the cell from rays that fall at the shelter angle.
bool Launcher::in_shadow(CellIndex c, const Drift::Cell& wind) const {
  const float highest = bed_.highest();
  float ray = bed_.height(c.x, c.y) + fall_;
  const int most = bed_.geometry().nx() + bed_.geometry().ny();
  for (int n = 1; n < most && ray < highest; ++n, ray += fall_) {
    const int dx = -static_cast<int>(std::lround(static_cast<float>(n) * wind.east));
    const int dy = -static_cast<int>(std::lround(static_cast<float>(n) * wind.north));
    if (!bed_.periodic() && !bed_.geometry().contains({c.x + dx, c.y + dy})) return false;
    if (height_beside(bed_, c, dx, dy) > ray) return true;
  }
  return false;
}

/// Whether the cell stands above the one upwind of it by an edge.
bool Launcher::at_edge(CellIndex c, const Drift::Cell& wind) const {
  const int dx = -static_cast<int>(std::lround(wind.east));
  const int dy = -static_cast<int>(std::lround(wind.north));
  return bed_.height(c.x, c.y) - height_beside(bed_, c, dx, dy) >=
         static_cast<float>(p_.snow->edge * bed_.parcel());
}

float Launcher::friction_threshold(std::size_t cell, float slope_along) const {
  float cohesion = 1;
  if (snow_)
    cohesion = static_cast<float>(bed_.loose(cell) >= ErodibleBed::parcel_units ? snow_->cohesion(cell)
                                                                                : p_.snow->bonded_cohesion);
  float square = weight_ + sticks_ * cohesion;
  if (p_.slope_threshold)
    square *= std::max(0.0F, (1 + slope_along / tan_repose_) / std::sqrt(1 + slope_along * slope_along));
  const bool loose = bed_.loose(cell) >= ErodibleBed::parcel_units;
  return std::sqrt(square) * (impacts_ && loose ? static_cast<float>(p_.impact_threshold) : 1);
}

float Launcher::chance(CellIndex c) const {
  const std::size_t cell = bed_.geometry().index(c);
  if (!bed_.covered(cell)) return 0;
  const Drift::Cell& wind = drift_.at(cell);
  const Eigen::Vector2f rise = slope_at(bed_, c);
  const float along = rise.x() * wind.east + rise.y() * wind.north;
  float share = 1;
  if (p_.shelter == Shelter::slope) {
    if (along < 0) return 0;
  } else {
    const float exposure = 1 + along * static_cast<float>(bed_.geometry().cell()) / fall_;
    if (exposure <= 0) return 0;
    share = std::min(exposure, most_exposed_) / most_exposed_;
  }
  if (!(wind.friction_velocity > friction_threshold(cell, along))) return 0;
  if (bed_.loose(cell) < ErodibleBed::parcel_units) {
    if (!at_edge(c, wind)) return 0;
    share *= static_cast<float>(p_.snow->sintered_share);
  }
  if (p_.shelter == Shelter::ray && in_shadow(c, wind)) return 0;
  if (!drift_.uniform())
    share *= static_cast<float>(drift_.launches(wind.friction_velocity) / drift_.most_launches());
  return share;
}

bool Launcher::anything_lifts_in(const CellRange& r) const {
  for (int y = r.y0; y < r.y1; ++y)
    for (int x = r.x0; x < r.x1; ++x)
      if (chance({x, y}) > 0) return true;
  return false;
}

void Launcher::find_awake() {
  awake_.clear();
  if (!drift_.blows()) return;
  const TileMask tiles(bed_.geometry());
  const int count = tiles.tiles_x() * tiles.tiles_y();
  for (int t = 0; t < count; ++t) {
    if (bed_.covered_in_tile(static_cast<std::size_t>(t)) == 0) continue;
    // Only bonds and a weaker wind can hold all of a covered tile.
    const CellRange range = tiles.range(t % tiles.tiles_x(), t / tiles.tiles_x());
    if ((!snow_ && drift_.uniform()) || anything_lifts_in(range)) awake_.push_back(t);
  }
}

double Launcher::attempts() const {
  return static_cast<double>(awake_.size()) * tile_cells * tile_cells * drift_.most_launches() *
         static_cast<double>(most_exposed_);
}

std::optional<Launch> Launcher::attempt(std::uint64_t number) const {
  const Philox::Block bits = random_(0, number);
  const auto place = static_cast<std::size_t>((std::uint64_t{bits[0]} * (awake_.size() * 1024)) >> 32);
  const int tile = awake_[place / 1024];
  const auto within = static_cast<int>(place % 1024);
  const int tiles_x = (bed_.geometry().nx() + tile_cells - 1) / tile_cells;
  const CellIndex c{tile % tiles_x * tile_cells + within % tile_cells,
                    tile / tiles_x * tile_cells + within / tile_cells};
  if (!bed_.geometry().contains(c)) return std::nullopt;
  if (!(uniform(bits[1]) < chance(c))) return std::nullopt;
  const std::size_t cell = bed_.geometry().index(c);
  return Launch{cell, static_cast<float>(c.x) + uniform(bits[2]) - 0.5F,
                static_cast<float>(c.y) + uniform(bits[3]) - 0.5F, lift_off(number, cell)};
}

Eigen::Vector3f Launcher::lift_off(std::uint64_t number, std::size_t cell) const {
  const Philox::Block bits = random_(1, number);
  const LiftOff& l = p_.lift_off;
  const auto between = [](double low, double high, float share) {
    return static_cast<float>(low) + static_cast<float>(high - low) * share;
  };
  const Drift::Cell& wind = drift_.at(cell);
  const float up = wind.friction_velocity * between(l.least_factor, l.most_factor, uniform(bits[0]));
  const float on = up / std::tan(between(l.least_angle, l.most_angle, uniform(bits[1])));
  float turn = 0;
  if (l.lateral_spread > 0)
    turn = static_cast<float>(l.lateral_spread) * std::sqrt(-2 * std::log(uniform(bits[2]))) *
           std::cos(static_cast<float>(2 * M_PI) * uniform(bits[3]));
  const float c = std::cos(turn);
  const float s = std::sin(turn);
  return {on * (c * wind.east - s * wind.north), on * (s * wind.east + c * wind.north), up};
}

}  // namespace aeolian
