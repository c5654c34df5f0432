#include "aeolian_core/measure/fusion_tile.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {
namespace {

// When a tile is taken to be still. `rate` is the mean of rate^2 / variance over its n cells: up to 1/4 on a
// still bed (the noise's share of the tracking filter's variance), more than 1 where ripples pass. `drift` is
// the mean of (tracked - still height)^2 / tracked variance: about 3/4 on a still bed. Both scatter as
// 1 / sqrt(n); noise that is 15 % more than the sensor's model says looks like motion.
constexpr std::int64_t least_cells = 16;
bool looks_still(double rate, double scatter) { return rate < 0.25 + 0.7 * scatter; }
bool looks_moving(double rate, double drift, double scatter) {
  return rate > 0.30 + scatter || drift > 0.82 + 3.4 * scatter;
}

constexpr double highest_flight = 0.5;  // of grains over the bed [m]

SurfaceSum surface(const Sample* begin, const Sample* end, const FusionRules& rules) {
  return rules.robust ? lower_surface(begin, end, rules.gate) : whole_surface(begin, end);
}

/// Calls `visit(cell, surface of its samples)` for each cell.
template <class Visit>
void for_each_surface(const std::vector<Sample>& samples, const FusionRules& rules, Visit&& visit) {
  const Sample* const end = samples.data() + samples.size();
  for (const Sample* first = samples.data(); first != end;) {
    const Sample* last = first;
    while (last != end && last->cell() == first->cell()) ++last;
    visit(first->cell(), surface(first, last, rules));
    first = last;
  }
}

double variance_of(const SurfaceSum& sum, const FusionRules& rules) {
  return rules.gate.weight_scale / sum.weight;
}

void prefetch(const void* memory, std::size_t bytes) {
  constexpr std::size_t line = 64;
  for (std::size_t i = 0; i < bytes; i += line) __builtin_prefetch(static_cast<const char*>(memory) + i, 1);
}

void prefetch(const RowLayers& row, std::size_t columns) {
  for (float* const layer : {row.elevation, row.variance, row.rate, row.rate_variance})
    prefetch(layer, columns * sizeof(float));
}

/// Calls `visit(row)` for each row of a set.
template <class Visit>
void for_each_row(FusionTile::Rows rows, Visit&& visit) {
  for (; rows != 0; rows &= rows - 1) visit(static_cast<std::size_t>(__builtin_ctz(rows)));
}

}  // namespace

FusionTile::Rows FusionTile::rows_of(const Sample* samples, std::size_t count) {
  Rows rows = 0;
  for (std::size_t i = 0; i < count; ++i) rows |= Rows{1} << (samples[i].cell() / side);
  return rows;
}

void FusionTile::open(std::uint32_t scan, std::uint32_t time, Rows rows, const FusionRules& rules,
                      HeightSteps& steps, const TileLayers& layers) {
  if (scan != scan_) {
    gathers_ = gathers_on(time, rules);
    if (!gathers_) close(time, rows, rules, steps, layers);
    scan_ = scan;
    time_ = time;
  }
  open_rows(rows, steps);
}

void FusionTile::open_rows(Rows rows, HeightSteps& steps) {
  for_each_row(rows & ~open_, [&](std::size_t y) {
    const bool restart_still = still_ && row_time_[y] < still_since_;
    predict(rows_[y], steps.after(time_ - row_time_[y]), restart_still);
    row_time_[y] = time_;
  });
  open_ |= rows;
}

/// Points that were set aside wait for the next scan, which says more of them.
bool FusionTile::gathers_on(std::uint32_t time, const FusionRules& rules) const {
  return still_ && open_ != 0 && set_aside_.empty() && !any_refusals_ &&
         time - gathering_since_ < rules.gathering_time;
}

/// Takes the open scan in, and lets those of `rows` that had points in it go on.
void FusionTile::close(std::uint32_t time, Rows rows, const FusionRules& rules, HeightSteps& steps,
                       const TileLayers& layers) {
  take_set_aside(rules);
  TileMotion motion;
  for_each_row(open_, [&](std::size_t y) {
    prefetch(&rows_[y] + 1, sizeof(FilterRow));
    if (y < layers.rows) prefetch(layers.row(y), layers.columns);
    const bool goes_on = (rows >> y & 1U) != 0;
    const HeightStep step = goes_on ? steps.after(time - row_time_[y]) : HeightStep();
    motion.add(close_scan(rows_[y], still_, rules.scale, rules.known_rate_variance, step));
    if (goes_on) row_time_[y] = time;
  });
  judge_motion(motion);
  open_ &= rows;
  gathering_since_ = time;
}

std::size_t FusionTile::add(const Sample* samples, std::size_t count, const FusionRules& rules) {
  const std::size_t set_aside = set_aside_.size();
  const double squared_gate = rules.gate.squared_gate;
  const double gate_scale = squared_gate * rules.gate.weight_scale;
  const double squared_relief = rules.gate.relief * rules.gate.relief;
  for (std::size_t i = 0; i < count; ++i) {
    const Sample sample = samples[i];
    FilterRow& row = rows_[sample.cell() / side];
    const std::size_t at = sample.cell() % side;
    const auto steps = static_cast<double>(std::int64_t{sample.height()} - row.height[at]);
    const auto variance = static_cast<double>(row.height_variance[at]);
    const double distance = fixed::step * steps;
    const double own = squared_gate * variance + squared_relief;
    const bool agrees = !rules.robust || (distance * distance - own) * sample.weight() <= gate_scale;
    if (agrees && variance > 0) {
      row.weight[at] += sample.weight();
      row.moment[at] += sample.weight() * steps;
      ++row.count[at];
    } else {
      set_aside_.push_back(sample);
    }
  }
  return count - (set_aside_.size() - set_aside);
}

void FusionTile::judge_motion(const TileMotion& motion) {
  if (motion.cells < least_cells) return;
  const double scale = 1 / (TileMotion::unit * static_cast<double>(motion.cells));
  const double rate = scale * static_cast<double>(motion.rate);
  const double drift = scale * static_cast<double>(motion.drift);
  const double scatter = 1 / std::sqrt(static_cast<double>(motion.cells));
  const bool was_still = still_;
  still_ = still_ ? !looks_moving(rate, drift, scatter) : looks_still(rate, scatter);
  if (still_ && !was_still) still_since_ = time_;
}

int FusionTile::refusals_in_row(std::size_t cell, const SurfaceSum& sum, const FusionRules& rules) const {
  if (refusals_[cell] == 0) return 1;
  const double distance = sum.height() - fixed::metres(rival_[cell]);
  const double reach =
      2 * rules.gate.squared_gate * variance_of(sum, rules) + rules.gate.relief * rules.gate.relief;
  return distance * distance <= reach ? refusals_[cell] + 1 : 1;
}

// A known cell stays with its points that agree, unless the points that disagree weigh more: then it begins
// anew when they did so alike often enough, or at once when they lie lower and the cell itself rests on no
// more points than they are (what it took for the bed was a grain in flight).
FusionTile::Verdict FusionTile::judge(std::size_t cell, const SurfaceSum& sum,
                                      const FusionRules& rules) const {
  if (!known(cell)) return Verdict::begins;
  if (row(cell).weight[cell % side] >= sum.weight) return Verdict::agrees;
  const double drop = fixed::metres(row(cell).height[cell % side]) - sum.height();
  const bool under_a_grain = drop > 0 && drop < highest_flight && sum.count >= row(cell).count[cell % side];
  const bool persists = refusals_in_row(cell, sum, rules) > rules.patience;
  return persists || under_a_grain ? Verdict::begins : Verdict::refused;
}

void FusionTile::take_set_aside(const FusionRules& rules) {
  if (any_refusals_) forget_refusals();
  for_each_surface(set_aside_, rules, [&](std::size_t at, const SurfaceSum& sum) {
    const Verdict verdict = judge(at, sum, rules);
    if (verdict == Verdict::begins) {
      begin_cell(at, {sum.height(), variance_of(sum, rules), 0, rules.first_rate_variance});
      row(at).count[at % side] = sum.count;
    } else if (verdict == Verdict::refused) {
      refusals_[at] = static_cast<std::uint8_t>(refusals_in_row(at, sum, rules));
      rival_[at] = fixed::steps(sum.height());
      any_refusals_ = true;
    }
  });
  set_aside_.clear();
  sorted_ = 0;
}

/// Of cells with points that agree.
void FusionTile::forget_refusals() {
  const auto has_set_aside = [&](std::size_t cell) {
    return std::binary_search(set_aside_.begin(), set_aside_.end(),
                              Sample(static_cast<std::uint32_t>(cell), 0, 0),
                              [](Sample a, Sample b) { return a.cell() < b.cell(); });
  };
  any_refusals_ = false;
  for (std::size_t i = 0; i < cell_count; ++i) {
    if (refusals_[i] != 0 && row(i).weight[i % side] > 0 && !has_set_aside(i)) refusals_[i] = 0;
    any_refusals_ |= refusals_[i] != 0;
  }
}

void FusionTile::sort_set_aside() {
  const auto middle = set_aside_.begin() + static_cast<std::ptrdiff_t>(sorted_);
  std::sort(middle, set_aside_.end());
  std::inplace_merge(set_aside_.begin(), middle, set_aside_.end());
  sorted_ = set_aside_.size();
}

FusionTile::Result FusionTile::publish(Rows rows, const FusionRules& rules, const TileLayers& layers) {
  Result result;
  result.written = !gathers_;
  if (!gathers_)
    for_each_row(rows, [&](std::size_t y) {
      write_estimates(rows_[y], still_, rules.scale, layers.row(y), layers.columns);
    });
  if (set_aside_.empty()) return result;

  const auto write = [&](std::size_t at, const CellEstimate& estimate) {
    const RowLayers to = layers.row(at / side);
    to.elevation[at % side] = static_cast<float>(estimate.height);
    to.variance[at % side] = static_cast<float>(estimate.variance);
    to.rate[at % side] = static_cast<float>(estimate.rate);
    to.rate_variance[at % side] = static_cast<float>(estimate.rate_variance);
  };
  sort_set_aside();
  for_each_surface(set_aside_, rules, [&](std::size_t at, const SurfaceSum& sum) {
    const Verdict verdict = judge(at, sum, rules);
    if (verdict == Verdict::begins) {
      ++result.new_cells;
      write(at, {sum.height(), variance_of(sum, rules), 0, rules.first_rate_variance});
    } else if (verdict == Verdict::refused) {
      ++result.outlier_cells;
      result.outliers += sum.count;
      write(at, estimate(row(at), at % side, still_, rules.scale));
    } else if (gathers_) {
      result.written = true;
      write(at, estimate(row(at), at % side, still_, rules.scale));
    }
  });
  return result;
}

void FusionTile::begin_cell(std::size_t cell, const CellEstimate& known) {
  FilterRow& to = row(cell);
  const std::size_t at = cell % side;
  to.height[at] = fixed::steps(known.height);
  to.rate[at] = static_cast<float>(known.rate);
  to.height_variance[at] = static_cast<float>(known.variance);
  to.covariance[at] = 0;
  to.rate_variance[at] = static_cast<float>(known.rate_variance);
  to.still_offset[at] = static_cast<float>(known.height - fixed::metres(to.height[at]));
  to.still_variance[at] = to.height_variance[at];
  to.count[at] = 1;
  to.weight[at] = 0;
  to.moment[at] = 0;
  refusals_[cell] = 0;
}

void FusionTile::forget_cell(std::size_t cell) {
  begin_cell(cell, {0, 0, 0, 0});
  row(cell).count[cell % side] = 0;
}

void FusionTile::restart_clock(std::uint32_t end, const FusionRules& rules, HeightSteps& steps) {
  close(end, ~Rows{0}, rules, steps, {});
  time_ = end;
  open_rows(~Rows{0}, steps);
  open_ = 0;
  row_time_.fill(0);
  gathering_since_ = 0;
  still_since_ = 0;
  scan_ = 0;
  time_ = 0;
}

void FusionTile::write_counts(const FusionRules& rules, float* counts, std::size_t stride) const {
  const auto write = [&](std::size_t at, std::uint32_t count) {
    counts[at / side * stride + at % side] = static_cast<float>(count);
  };
  for (std::size_t at = 0; at < cell_count; ++at)
    if (known(at)) write(at, row(at).count[at % side]);
  for_each_surface(set_aside_, rules, [&](std::size_t at, const SurfaceSum& sum) {
    if (judge(at, sum, rules) == Verdict::begins) write(at, sum.count);
  });
}

}  // namespace aeolian
