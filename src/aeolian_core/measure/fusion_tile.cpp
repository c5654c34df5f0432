#include "aeolian_core/measure/fusion_tile.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {
namespace {

// When a tile is taken to be still. `rate` is the mean of rate^2 / variance over its n cells: up to 1/4 on a
// still bed (the noise's share of the tracking filter's variance), more than 1 where ripples pass. `drift` is
// the mean of (tracked - still height)^2 / tracked variance: about 3/4 on a still bed. Both scatter as
// 1 / sqrt(n); noise that is 15 % more than the sensor's model says looks like motion.
constexpr std::int64_t least_cells = 64;
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

}  // namespace

void FusionTile::prefetch(const TileLayers& layers) {
  constexpr std::size_t floats_per_line = 16;
  for (float* const layer : {layers.elevation, layers.variance, layers.rate, layers.rate_variance})
    for (std::size_t row = 0; row < layers.window.rows; ++row)
      for (std::size_t column = 0; column < layers.window.columns; column += floats_per_line)
        __builtin_prefetch(layer + row * layers.window.stride + column, 1);
}

void FusionTile::open(std::uint32_t scan, std::uint32_t time, const FusionRules& rules, HeightSteps& steps) {
  if (scan == scan_) return;
  take_set_aside(rules);
  judge_motion(
      close_scan(filter_, still_, static_cast<float>(rules.gate.weight_scale), rules.known_rate_variance));
  if (time > time_) {
    predict(filter_, steps.after(time - time_));
    time_ = time;
  }
  scan_ = scan;
}

std::size_t FusionTile::add(const Sample* samples, std::size_t count, const FusionRules& rules) {
  const std::size_t set_aside = set_aside_.size();
  const double squared_gate = rules.gate.squared_gate;
  const double gate_scale = squared_gate * rules.gate.weight_scale;
  const double squared_relief = rules.gate.relief * rules.gate.relief;
  for (std::size_t i = 0; i < count; ++i) {
    const Sample sample = samples[i];
    const std::uint32_t at = sample.cell();
    const auto steps = static_cast<double>(std::int64_t{sample.height()} - filter_.height[at]);
    const auto variance = static_cast<double>(filter_.height_variance[at]);
    const double distance = fixed::step * steps;
    const double own = squared_gate * variance + squared_relief;
    const bool agrees = !rules.robust || (distance * distance - own) * sample.weight() <= gate_scale;
    if (agrees && variance > 0) {
      filter_.weight[at] += sample.weight();
      filter_.moment[at] += sample.weight() * steps;
      ++count_[at];
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
  still_ = still_ ? !looks_moving(rate, drift, scatter) : looks_still(rate, scatter);
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
  if (filter_.weight[cell] >= sum.weight) return Verdict::agrees;
  const double drop = fixed::metres(filter_.height[cell]) - sum.height();
  const bool under_a_grain = drop > 0 && drop < highest_flight && sum.count >= count_[cell];
  const bool persists = refusals_in_row(cell, sum, rules) > rules.patience;
  return persists || under_a_grain ? Verdict::begins : Verdict::refused;
}

void FusionTile::take_set_aside(const FusionRules& rules) {
  if (any_refusals_) forget_refusals();
  for_each_surface(set_aside_, rules, [&](std::size_t at, const SurfaceSum& sum) {
    const Verdict verdict = judge(at, sum, rules);
    if (verdict == Verdict::begins) {
      begin_cell(at, {sum.height(), variance_of(sum, rules), 0, rules.first_rate_variance});
      count_[at] = sum.count;
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
    if (refusals_[i] != 0 && filter_.weight[i] > 0 && !has_set_aside(i)) refusals_[i] = 0;
    any_refusals_ |= refusals_[i] != 0;
  }
}

void FusionTile::sort_set_aside() {
  const auto middle = set_aside_.begin() + static_cast<std::ptrdiff_t>(sorted_);
  std::sort(middle, set_aside_.end());
  std::inplace_merge(set_aside_.begin(), middle, set_aside_.end());
  sorted_ = set_aside_.size();
}

FusionTile::Result FusionTile::publish(const FusionRules& rules, const TileLayers& layers) {
  TileEstimate estimates;
  estimate(filter_, still_, static_cast<float>(rules.gate.weight_scale), estimates);
  write_touched(estimates, estimates.height, layers.elevation, layers.window);
  write_touched(estimates, estimates.variance, layers.variance, layers.window);
  write_touched(estimates, estimates.rate, layers.rate, layers.window);
  write_touched(estimates, estimates.rate_variance, layers.rate_variance, layers.window);
  Result result;
  if (set_aside_.empty()) return result;

  const auto write = [&](std::size_t at, float height, float variance, float rate, float rate_variance) {
    const std::size_t to = at / side * layers.window.stride + at % side;
    layers.elevation[to] = height;
    layers.variance[to] = variance;
    layers.rate[to] = rate;
    layers.rate_variance[to] = rate_variance;
  };
  sort_set_aside();
  for_each_surface(set_aside_, rules, [&](std::size_t at, const SurfaceSum& sum) {
    const Verdict verdict = judge(at, sum, rules);
    if (verdict == Verdict::begins) {
      ++result.new_cells;
      write(at, static_cast<float>(sum.height()), static_cast<float>(variance_of(sum, rules)), 0,
            static_cast<float>(rules.first_rate_variance));
    } else if (verdict == Verdict::refused) {
      ++result.outlier_cells;
      result.outliers += sum.count;
      write(at, estimates.height[at], estimates.variance[at], estimates.rate[at],
            estimates.rate_variance[at]);
    }
  });
  return result;
}

void FusionTile::begin_cell(std::size_t at, const CellEstimate& known) {
  filter_.height[at] = fixed::steps(known.height);
  filter_.rate[at] = static_cast<float>(known.rate);
  filter_.height_variance[at] = static_cast<float>(known.variance);
  filter_.covariance[at] = 0;
  filter_.rate_variance[at] = static_cast<float>(known.rate_variance);
  filter_.still_offset[at] = static_cast<float>(known.height - fixed::metres(filter_.height[at]));
  filter_.still_variance[at] = filter_.height_variance[at];
  filter_.weight[at] = 0;
  filter_.moment[at] = 0;
  count_[at] = 1;
  refusals_[at] = 0;
}

void FusionTile::forget_cell(std::size_t at) {
  begin_cell(at, {0, 0, 0, 0});
  count_[at] = 0;
}

void FusionTile::restart_clock(std::uint32_t end, const FusionRules& rules, HeightSteps& steps) {
  open(scan_ + 1, end, rules, steps);
  scan_ = 0;
  time_ = 0;
}

void FusionTile::write_counts(const FusionRules& rules, float* counts, std::size_t stride) const {
  const auto write = [&](std::size_t at, std::uint32_t count) {
    counts[at / side * stride + at % side] = static_cast<float>(count);
  };
  for (std::size_t at = 0; at < cell_count; ++at)
    if (known(at)) write(at, count_[at]);
  for_each_surface(set_aside_, rules, [&](std::size_t at, const SurfaceSum& sum) {
    if (judge(at, sum, rules) == Verdict::begins) write(at, sum.count);
  });
}

}  // namespace aeolian
