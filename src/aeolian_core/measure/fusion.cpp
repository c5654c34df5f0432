#include "aeolian_core/measure/fusion.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "aeolian_core/measure/cloud_sample.hpp"
#include "aeolian_core/measure/point_locator.hpp"
#include "aeolian_core/measure/sample_buckets.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

/// Half the height that a bed spans within a cell at the angle of repose, 35 degrees, in cells.
constexpr double repose_relief = 0.35;
/// A cloud may be so much older than the newest before the clock is taken to have jumped back [s].
constexpr double greatest_delay = 10;
/// Milliseconds that the cells can count, less a reserve.
constexpr double longest_time = 4e9;
constexpr std::size_t points_at_once = 16384;
/// Of fewer points it costs more to wake another thread than it saves.
constexpr std::size_t points_for_threads = 65536;
bool for_one_thread(std::size_t points) { return points < points_for_threads; }
/// A still tile gathers scans for this part of the time for which a bed goes on rising or sinking.
constexpr double gathering_share = 1.0 / 64;

constexpr Require require{"fusion"};

/// What a reading at the least range says of a height, without the ray's slant [m^2].
double reference_variance(const FusionParameters& p) {
  const double sigma = p.sensor.along_ray(p.sensor.min_range, 1);
  return sigma * sigma;
}

PointLocator locator(const PointCloud& cloud, const Eigen::Isometry3d& pose, const GridGeometry& g,
                     const FusionParameters& p, const SensorNoise& sensor) {
  PointLocator l;
  const Eigen::Matrix3d rotation = pose.linear();
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(l.rotation.data()) = rotation;
  l.offset = {pose.translation().x() - g.origin_x(), pose.translation().y() - g.origin_y(),
              pose.translation().z()};
  l.origin = {cloud.origin_x, cloud.origin_y, cloud.origin_z};
  l.per_cell = 1 / g.cell();
  l.nx = g.nx();
  l.ny = g.ny();
  l.tiles_x = (g.nx() + TileMask::tile_cells - 1) / TileMask::tile_cells;
  l.nearest = sensor.min_range * sensor.min_range;
  l.farthest = sensor.max_range * sensor.max_range;
  l.noise = sensor;
  l.reference_variance = reference_variance(p);
  l.georeferenced = Eigen::Vector3d(cloud.origin_x, cloud.origin_y, cloud.origin_z).norm() > sensor.max_range;
  return l;
}

/// The cells of a map that others made: what it leaves out is filled in.
class KnownCells {
 public:
  KnownCells(const HeightMap& map, double variance, double rate_variance)
      : unknown_(map.geometry().size(), HeightMap::unknown),
        elevation_(map.layer(layer::elevation)),
        variance_(given(map, layer::variance)),
        rate_(given(map, layer::rate)),
        rate_variance_(given(map, layer::rate_variance)),
        fallback_{0, variance, 0, rate_variance} {}

  std::optional<CellEstimate> at(std::size_t i) const {
    const auto height = static_cast<double>(elevation_[i]);
    if (!(std::abs(height) <= fixed::greatest_height)) return std::nullopt;
    const auto positive_or = [](float value, double fallback) {
      return value > 0 && std::isfinite(value) ? static_cast<double>(value) : fallback;
    };
    return CellEstimate{height, positive_or(variance_[i], fallback_.variance),
                        std::isfinite(rate_[i]) ? static_cast<double>(rate_[i]) : 0,
                        positive_or(rate_variance_[i], fallback_.rate_variance)};
  }

 private:
  const HeightMap::Layer& given(const HeightMap& map, const std::string& name) const {
    return map.has(name) ? map.layer(name) : unknown_;
  }

  HeightMap::Layer unknown_;
  const HeightMap::Layer& elevation_;
  const HeightMap::Layer& variance_;
  const HeightMap::Layer& rate_;
  const HeightMap::Layer& rate_variance_;
  CellEstimate fallback_;
};

}  // namespace

void FusionParameters::require_valid() const {
  const auto finite = [](double v) { return std::isfinite(v); };
  sensor.require_valid();
  require(change.rate_sigma >= 0 && finite(change.rate_sigma), "rate_sigma", change.rate_sigma,
          "zero or positive");
  require(change.rate_time > 0 && finite(change.rate_time), "rate_time", change.rate_time, "positive");
  require(gate_sigma > 0 && finite(gate_sigma), "gate_sigma", gate_sigma, "positive");
  require(gate_patience >= 0 && gate_patience < 255, "gate_patience", gate_patience, "from 0 to 254");
}

/// What each thread keeps for itself.
struct HeightFusion::Workers {
  struct Worker {
    explicit Worker(const HeightChange& change) : steps(change) {}
    SampleBuckets buckets;
    PointCounts counts;
    CellMarks marks;
    std::array<MarkedCells, 2> marked;  ///< of a tile and of the next, in turn
    HeightSteps steps;
    std::size_t outlier_cells = 0;
    std::size_t outliers = 0;
  };

  explicit Workers(const HeightChange& change) : of_threads([change] { return Worker(change); }) {}
  tbb::enumerable_thread_specific<Worker> of_threads;

  void reset() {
    for (Worker& worker : of_threads) {
      worker.buckets.reset(0, 0);
      worker.counts = {};
      worker.outlier_cells = 0;
      worker.outliers = 0;
    }
  }

  void sort_into_tiles(const PointCloud& cloud, const PointLocator& locator, std::size_t tiles) {
    const std::size_t grain = for_one_thread(cloud.size()) ? cloud.size() + 1 : points_at_once;
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, cloud.size(), grain),
        [&](const tbb::blocked_range<std::size_t>& range) {
          Worker& worker = of_threads.local();
          if (worker.buckets.empty()) worker.buckets.reset(tiles, cloud.size());
          std::int32_t tile[PointLocator::batch];
          Sample sample[PointLocator::batch];
          for (std::size_t i = range.begin(); i < range.end(); i += PointLocator::batch) {
            const std::size_t count = std::min(PointLocator::batch, range.end() - i);
            worker.counts.add(locator.locate(&cloud.x[i], &cloud.y[i], &cloud.z[i], count, tile, sample));
            worker.buckets.add(tile, sample, count);
          }
        },
        tbb::simple_partitioner());
  }
};

HeightFusion::HeightFusion(const GridGeometry& geometry, const FusionParameters& parameters)
    : map_(geometry), parameters_(parameters) {
  parameters.require_valid();
  rules_.gate = {parameters.gate_sigma * parameters.gate_sigma, repose_relief * geometry.cell(),
                 fixed::reference_weight * reference_variance(parameters)};
  rules_.scale = PointScale(rules_.gate.weight_scale);
  rules_.robust = parameters.robust;
  rules_.patience = parameters.gate_patience;
  rules_.gathering_time =
      static_cast<std::uint32_t>(std::min(1e3 * parameters.change.rate_time * gathering_share, 1e5));
  rules_.first_rate_variance = parameters.change.rate_sigma * parameters.change.rate_sigma;
  workers_ = std::make_unique<Workers>(parameters.change);
  clear();
}

HeightFusion::HeightFusion(const HeightMap& map, const FusionParameters& parameters, double stamp)
    : HeightFusion(map.geometry(), parameters) {
  require(std::isfinite(stamp), "stamp", stamp, "finite");
  epoch_ = last_stamp_ = stamp;
  replace(map, map.layer(layer::elevation));
}

HeightFusion::~HeightFusion() = default;
HeightFusion::HeightFusion(HeightFusion&&) noexcept = default;
HeightFusion& HeightFusion::operator=(HeightFusion&&) noexcept = default;

FusionResult HeightFusion::add(const PointCloud& cloud, const Eigen::Isometry3d& pose, double stamp) {
  return add(cloud, pose, stamp, parameters_.sensor);
}

FusionResult HeightFusion::add(const PointCloud& cloud, const Eigen::Isometry3d& pose, double stamp,
                               const SensorNoise& sensor) {
  require_usable(cloud, pose, "fusion");
  require(std::isfinite(stamp), "stamp", stamp, "finite");
  sensor.require_valid();
  set_clock(stamp);
  is_written_ = false;

  FusionResult result;
  result.changed = TileMask(map_.geometry());
  workers_->reset();
  workers_->sort_into_tiles(cloud, locator(cloud, pose, map_.geometry(), parameters_, sensor), tiles_.size());
  work_on_tiles(cloud.size(), result);
  PointCounts counts;
  for (const Workers::Worker& worker : workers_->of_threads) {
    counts.add(worker.counts);
    result.outlier_cells += worker.outlier_cells;
    result.outliers += worker.outliers;
  }
  result.used = counts.used;
  result.not_finite = counts.not_finite;
  result.out_of_range = counts.out_of_range;
  result.outside = counts.outside;
  return result;
}

void HeightFusion::work_on_tiles(std::size_t points, FusionResult& result) {
  const bool is_read = std::exchange(is_read_, false);
  std::vector<std::size_t> active;
  for (std::size_t tile = 0; tile < tiles_.size(); ++tile)
    for (const Workers::Worker& worker : workers_->of_threads)
      if (worker.buckets.has(tile)) {
        active.push_back(tile);
        break;
      }
  const std::size_t grain = for_one_thread(points) ? active.size() + 1 : 1;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, active.size(), grain),
      [&](const tbb::blocked_range<std::size_t>& range) {
        Workers::Worker& own = workers_->of_threads.local();
        const auto for_each_block = [&](std::size_t i, auto&& visit) {
          for (const Workers::Worker& worker : workers_->of_threads)
            worker.buckets.for_each(active[i], visit);
        };
        const auto fetch_next = [&](std::size_t i) -> CellsAhead {
          if (i == range.end()) return {};
          for_each_block(i, [&](const Sample* samples, std::size_t count) { own.marks.add(samples, count); });
          own.marks.take(own.marked[i % 2]);
          auto& tile = tiles_[active[i]];
          if (!tile) tile = std::make_unique<FusionTile>();
          return tile->prefetch(own.marked[i % 2].list);
        };
        fetch_next(range.begin()).fetch_rest();
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          const std::size_t at = active[i];
          FusionTile& tile = *tiles_[at];
          std::size_t agreeing = 0;
          CellsAhead ahead = fetch_next(i + 1);
          tile.open(scan_, newest_, rules_);
          tile.reach(own.marked[i % 2], rules_, own.steps, ahead);
          for_each_block(i, [&](const Sample* samples, std::size_t count) {
            agreeing += tile.add(samples, count, rules_, ahead);
          });
          ahead.fetch_rest();
          const FusionTile::Verdicts verdicts = tile.verdicts(rules_);
          own.outlier_cells += verdicts.outlier_cells;
          own.outliers += verdicts.outliers;
          const bool tells = (agreeing > 0 && !tile.gathers()) || verdicts.new_cells > 0;
          if (tells && is_read)
            tile.write(rules_, layers_of_tile(at, result.changed));  // while it is at hand
          if (tells) {
            const int tiles_x = result.changed.tiles_x();
            result.changed.set_tile(static_cast<int>(at) % tiles_x, static_cast<int>(at) / tiles_x);
          }
        }
      });
}

const HeightMap& HeightFusion::map() const {
  if (!is_written_) map(TileMask(map_.geometry(), true));
  is_written_ = true;
  is_read_ = true;
  return map_;
}

const HeightMap& HeightFusion::map(const TileMask& tiles) const {
  is_read_ = true;
  const auto tiles_x = static_cast<std::size_t>(tiles.tiles_x());
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, tiles_.size()), [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
          if (tiles_[i] && tiles.tile(static_cast<int>(i % tiles_x), static_cast<int>(i / tiles_x)))
            tiles_[i]->write(rules_, layers_of_tile(i, tiles));
      });
  return map_;
}

TileLayers HeightFusion::layers_of_tile(std::size_t tile, const TileMask& tiling) const {
  const GridGeometry& g = map_.geometry();
  const auto at = static_cast<int>(tile);
  const CellRange range = tiling.range(at % tiling.tiles_x(), at / tiling.tiles_x());
  const std::size_t first = g.index(range.x0, range.y0);
  const auto data = [&](const std::string& name) { return map_.layer(name).data() + first; };
  return {data(layer::elevation),
          data(layer::variance),
          data(layer::rate),
          data(layer::rate_variance),
          static_cast<std::size_t>(range.y1 - range.y0),
          static_cast<std::size_t>(range.x1 - range.x0),
          static_cast<std::size_t>(g.nx())};
}

void HeightFusion::set_clock(double stamp) {
  if (scan_ != 0 && stamp == last_stamp_) return;
  const double newest_stamp = epoch_ + 1e-3 * newest_;
  const bool jumped = scan_ != 0 && (stamp < newest_stamp - greatest_delay || stamp < epoch_ ||
                                     stamp - epoch_ > 1e-3 * longest_time);
  if (jumped) {
    map();  // tiles forget the points of which their estimates are made
    const auto end = newest_ + static_cast<std::uint32_t>(std::clamp(stamp - newest_stamp, 0.0, 1e5) * 1e3);
    HeightSteps steps(parameters_.change);
    for (const auto& tile : tiles_)
      if (tile) tile->restart_clock(end, rules_, steps);
  }
  if (scan_ == 0 || jumped) {
    epoch_ = stamp;
    newest_ = 0;
  }
  newest_ = std::max(newest_, static_cast<std::uint32_t>(std::llround(1e3 * (stamp - epoch_))));
  last_stamp_ = stamp;
  ++scan_;
}

TileMask HeightFusion::replace(const HeightMap& known, const HeightMap::Layer& mask) {
  const GridGeometry& g = map_.geometry();
  if (known.geometry() != g || mask.size() != g.size())
    throw Error("fusion: cells of another grid cannot replace those of the map");
  const KnownCells cells(known, reference_variance(parameters_), rules_.first_rate_variance);
  TileMask changed(g);
  ++scan_;  // what came before is final
  is_written_ = false;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (std::isnan(mask[i])) continue;
    const CellIndex at = g.cell_at(i);
    constexpr auto side = FusionTile::side;
    const auto x = static_cast<std::size_t>(at.x);
    const auto y = static_cast<std::size_t>(at.y);
    const std::size_t tile_at = y / side * static_cast<std::size_t>(changed.tiles_x()) + x / side;
    auto& tile = tiles_[tile_at];
    const std::optional<CellEstimate> cell = cells.at(i);
    if (!tile && !cell) continue;
    if (!tile) tile = std::make_unique<FusionTile>();
    tile->open(scan_, newest_, rules_);
    const std::size_t in_tile = y % side * side + x % side;
    if (cell)
      tile->begin_cell(in_tile, *cell);
    else
      tile->forget_cell(in_tile);
    const auto write = [&](const std::string& name, double value) {
      map_.layer(name)[i] = cell ? static_cast<float>(value) : HeightMap::unknown;
    };
    const CellEstimate shown = cell.value_or(CellEstimate());
    write(layer::elevation, shown.height);
    write(layer::variance, shown.variance);
    write(layer::rate, shown.rate);
    write(layer::rate_variance, shown.rate_variance);
    tile->is_written(in_tile);
    changed.activate(at.x, at.y);
  }
  return changed;
}

HeightMap::Layer HeightFusion::counts() const {
  HeightMap::Layer counts(map_.geometry().size(), HeightMap::unknown);
  const GridGeometry& g = map_.geometry();
  const TileMask tiling(g);
  for (std::size_t tile = 0; tile < tiles_.size(); ++tile)
    if (tiles_[tile]) {
      const auto tiles_x = static_cast<std::size_t>(tiling.tiles_x());
      const CellRange range =
          tiling.range(static_cast<int>(tile % tiles_x), static_cast<int>(tile / tiles_x));
      tiles_[tile]->write_counts(rules_, counts.data() + g.index(range.x0, range.y0),
                                 static_cast<std::size_t>(g.nx()));
    }
  return counts;
}

void HeightFusion::clear() {
  for (const auto& name : {layer::elevation, layer::variance, layer::rate, layer::rate_variance})
    map_.add(name);
  const TileMask tiling(map_.geometry());
  tiles_.clear();
  tiles_.resize(static_cast<std::size_t>(tiling.tiles_x()) * static_cast<std::size_t>(tiling.tiles_y()));
  scan_ = 0;
}

}  // namespace aeolian
