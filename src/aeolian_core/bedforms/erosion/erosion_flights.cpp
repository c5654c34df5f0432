#include <algorithm>
#include <numeric>

#include <tbb/parallel_for.h>

#include "aeolian_core/bedforms/erosion/erosion_batch.hpp"
#include "aeolian_core/bedforms/erosion/hop_walk.hpp"

namespace aeolian {
namespace {

constexpr std::size_t parcels_each = 4096;
constexpr std::uint64_t attempts_each = 2048;
constexpr std::uint32_t most_hops = 10000;

/// Sum of a velocity's component over parcels, in four interleaved sums.
double sum_along(const float* u, const float* v, std::size_t count, float east, float north) {
  float sums[4] = {0, 0, 0, 0};
  for (std::size_t i = 0; i < count; ++i) sums[i % 4] += u[i] * east + v[i] * north;
  return double{sums[0]} + double{sums[1]} + double{sums[2]} + double{sums[3]};
}

}  // namespace

/// What the parcels [begin, end) do in a step.
void ErosionRun::fly_batch(std::size_t begin, std::size_t end, Batch& batch) {
  batch.clear();
  Parcels& p = parcels_;
  fly(p, begin, end, step_);
  const Drift::Cell& wind = drift_->at(0);
  batch.way = step_time_ * sum_along(&p.vx[begin], &p.vy[begin], end - begin, wind.east, wind.north);
  const auto nx = static_cast<float>(bed_.geometry().nx());
  const auto ny = static_cast<float>(bed_.geometry().ny());
  const bool open = !bed_.periodic();
  const auto is_outside = [&](float x, float y) {
    return !(x >= -0.5F && y >= -0.5F && x < nx - 0.5F && y < ny - 0.5F);
  };
  const auto end_flight = [&](std::size_t i, float x, float y, bool outside) {
    batch.transfers.push_back({0, 0, x, y, ErodibleBed::parcel_units, Transfer::Kind::settled, outside});
    batch.ended.push_back(i);
  };
  for (std::size_t i = begin; i < end; ++i) {
    if (open && is_outside(p.x[i], p.y[i])) {
      end_flight(i, 0, 0, true);
      continue;
    }
    if (p.clearance[i] > 0) continue;
    // Back along the path to where it met the surface.
    Eigen::Vector3f v(p.vx[i], p.vy[i], p.vz[i]);
    const SurfacePatch below = patch_at(bed_, p.x[i], p.y[i]);
    const float closing = v.x() * below.slope_x + v.y() * below.slope_y - v.z();
    const float back = closing > 0 ? std::min(-p.clearance[i] / closing, static_cast<float>(step_time_)) : 0;
    float x = p.x[i] - back * v.x() * step_.per_cell;
    float y = p.y[i] - back * v.y() * step_.per_cell;
    if (!open) {
      x = on_ring(x, bed_.geometry().nx());
      y = on_ring(y, bed_.geometry().ny());
    }
    const SurfacePatch patch = patch_at(bed_, x, y);
    ++batch.hops;
    if (!impacts_.rebounds(x, y, p.name[i], p.hop[i], v, batch.transfers) || p.hop[i] >= most_hops) {
      end_flight(i, x, y, cell_near(bed_, x, y) < 0);
      continue;
    }
    ++p.hop[i];
    p.x[i] = x;
    p.y[i] = y;
    p.z[i] = just_above(patch.height);
    p.vx[i] = v.x();
    p.vy[i] = v.y();
    p.vz[i] = v.z();
  }
}

void ErosionRun::fly_all() {
  const std::size_t count = parcels_.size();
  if (count == 0) return;
  const std::size_t batches = (count + parcels_each - 1) / parcels_each;
  if (batches_.size() < batches) batches_.resize(batches);
  tbb::parallel_for(std::size_t{0}, batches, [&](std::size_t n) {
    fly_batch(n * parcels_each, std::min(count, (n + 1) * parcels_each), batches_[n]);
  });
  for (std::size_t n = 0; n < batches; ++n) {
    carry_out(batches_[n].transfers);
    counts_.hops += batches_[n].hops;
    counts_.transported += batches_[n].way * bed_.parcel_volume();
  }
  // From the last one: what takes a place stays in the air.
  for (std::size_t n = batches; n-- > 0;)
    for (auto i = batches_[n].ended.rbegin(); i != batches_[n].ended.rend(); ++i) parcels_.remove(*i);
  counts_.updates += static_cast<std::int64_t>(count);
}

/// Follows what leaves in the attempts [first, last) from hop to hop until it stays.
void ErosionRun::hop_batch(std::uint64_t first, std::uint64_t last, bool inflow, Batch& batch) const {
  batch.clear();
  const double cell = bed_.geometry().cell();
  for (std::uint64_t number = first; number < last; ++number) {
    std::optional<Launch> launch;
    if (inflow)
      launch = entry(number);
    else
      launch = launcher_->attempt(number);
    if (!launch) continue;
    const std::size_t lead = batch.transfers.size();
    float x = bed_.periodic() ? on_ring(launch->x, bed_.geometry().nx()) : launch->x;
    float y = bed_.periodic() ? on_ring(launch->y, bed_.geometry().ny()) : launch->y;
    batch.transfers.push_back({x, y, 0, 0, ErodibleBed::parcel_units,
                               inflow ? Transfer::Kind::settled : Transfer::Kind::lifted, true});
    Eigen::Vector3f v = launch->velocity;
    std::size_t over = launch->cell;
    for (std::uint32_t hop = 0;; ++hop) {
      const Drift::Cell& wind = drift_->at(over);
      const HopEnd end = walk_hop(bed_, drift_->hops(wind.friction_velocity), wind, x, y, v);
      batch.way += cell * end.way;
      if (end.outside) break;
      ++batch.hops;
      v = end.velocity;
      const std::int64_t near = cell_near(bed_, end.x, end.y);
      if (near < 0) break;
      if (!impacts_.rebounds(end.x, end.y, number, hop, v, batch.transfers) || hop >= most_hops) {
        Transfer& whole = batch.transfers[lead];
        whole.to_x = end.x;
        whole.to_y = end.y;
        whole.outside = false;
        break;
      }
      x = end.x;
      y = end.y;
      over = static_cast<std::size_t>(near);
    }
  }
}

void ErosionRun::hop_round(double attempts, double seconds) {
  const std::int64_t hops = counts_.hops;
  const auto follow_all = [&](std::uint64_t first, std::uint64_t count, bool inflow) {
    const auto batches = static_cast<std::size_t>((count + attempts_each - 1) / attempts_each);
    if (batches_.size() < batches) batches_.resize(batches);
    tbb::parallel_for(std::size_t{0}, batches, [&](std::size_t n) {
      const std::uint64_t begin = first + n * attempts_each;
      hop_batch(begin, std::min(begin + attempts_each, first + count), inflow, batches_[n]);
    });
    for (std::size_t n = 0; n < batches; ++n) {
      carry_out(batches_[n].transfers);
      counts_.hops += batches_[n].hops;
      counts_.transported += batches_[n].way * bed_.parcel_volume();
    }
  };
  if (launcher_->anything_awake()) {
    owed_attempts_ += attempts;
    const auto whole = static_cast<std::uint64_t>(owed_attempts_);
    owed_attempts_ -= static_cast<double>(whole);
    follow_all(attempts_, whole, false);
    attempts_ += whole;
  }
  if (p_.inflow > 0 && p_.border == Border::open) {
    owed_entries_ += seconds * entries_per_second();
    const auto whole = static_cast<std::uint64_t>(owed_entries_);
    owed_entries_ -= static_cast<double>(whole);
    follow_all(first_entry + entries_, whole, true);
    entries_ += whole;
    balance_.inflow += static_cast<std::int64_t>(whole) * ErodibleBed::parcel_units;
  }
  hopped_ = counts_.hops > hops;
  ++counts_.steps;
}

/// Into the order of the tiles that they are over, so that a tile's surface stays in the cache.
void ErosionRun::sort_parcels() {
  const int tiles_x = (bed_.geometry().nx() + TileMask::tile_cells) / TileMask::tile_cells + 1;
  std::vector<std::uint32_t> tile(parcels_.size());
  std::uint32_t most = 0;
  for (std::size_t i = 0; i < tile.size(); ++i) {
    const int tx = static_cast<int>(std::max(parcels_.x[i], 0.0F)) / TileMask::tile_cells;
    const int ty = static_cast<int>(std::max(parcels_.y[i], 0.0F)) / TileMask::tile_cells;
    tile[i] = static_cast<std::uint32_t>(ty * tiles_x + tx);
    most = std::max(most, tile[i]);
  }
  std::vector<std::size_t> place(std::size_t{most} + 2, 0);
  for (const std::uint32_t t : tile) ++place[t + 1];
  std::partial_sum(place.begin(), place.end(), place.begin());
  std::vector<std::size_t> order(tile.size());
  for (std::size_t i = 0; i < tile.size(); ++i) order[place[tile[i]]++] = i;
  const auto arrange = [&](auto& values) {
    auto old = values;
    for (std::size_t i = 0; i < order.size(); ++i) values[i] = old[order[i]];
  };
  for (std::vector<float>* values :
       {&parcels_.x, &parcels_.y, &parcels_.z, &parcels_.vx, &parcels_.vy, &parcels_.vz, &parcels_.clearance})
    arrange(*values);
  arrange(parcels_.name);
  arrange(parcels_.hop);
}

}  // namespace aeolian
