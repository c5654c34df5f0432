#include "aeolian_core/measure/fusion_tile.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace aeolian {
namespace {

// Whether a tile is still is decided by two sequential tests, one for each change of mind (Page 1954,
// Biometrika 41, 100-115): logarithms of likelihood ratios add up scan by scan until they are `certain`. On a
// still bed a tile is taken to move by chance once in more than exp(certain) = 5e8 scans (Lorden 1971, Ann.
// Math. Stat. 42, 1897-1908), or exp(certain / k) where the noise has k times the variance that the sensor's
// model says: 1e6 for 20 % more noise, 7e3 for 50 % more.
constexpr double certain = 20;
// Scans that it takes at least to recognise a rest: cells side by side that turn from rising to sinking at
// the same time are no independent witnesses.
constexpr double least_scans = 5;
// Evidence against a rest that has not been recognised yet, at which the still filters begin anew.
constexpr double doubtful = 3;
constexpr std::int64_t of_evidence(double logarithm) {
  return static_cast<std::int64_t>(logarithm * MotionEvidence::unit);
}

/// Stray points of a still tile: a grain or two in flight, the noise's tail.
constexpr std::size_t few_points = FusionTile::cell_count / 32;

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

/// Calls `visit(cell)` for each cell of a row's set.
template <class Visit>
void for_each_cell(std::size_t y, CellSet::Row row, Visit&& visit) {
  for (; row != 0; row &= row - 1) visit(y * CellSet::side + static_cast<std::size_t>(__builtin_ctz(row)));
}

// So far ahead cells come from the second to the first cache.
constexpr std::size_t listed_ahead = 32;
constexpr std::size_t samples_ahead = 16;
void bring(const FilterCell& cell) { __builtin_prefetch(&cell, 1); }

/// A row of a tile, whose first cell is at `first`.
void fetch(const TileLayers& layers, std::size_t first) {
  constexpr std::size_t cells_per_line = 64 / sizeof(float);
  for (float* const layer : {layers.elevation, layers.variance, layers.rate, layers.rate_variance})
    for (std::size_t i = 0; i < layers.width; i += cells_per_line) __builtin_prefetch(layer + first + i, 1);
}

}  // namespace

CellSet::Row CellMarks::take_row(std::size_t y) {
  constexpr std::size_t at_once = sizeof(std::uint64_t);
  constexpr std::uint64_t gathering_bits =
      0x0102040810204080U;  // lowest bits of eight bytes into the highest
  CellSet::Row row = 0;
  for (std::size_t x = 0; x < CellSet::side; x += at_once) {
    std::uint64_t bytes = 0;
    std::uint8_t* const marks = &marks_[y * CellSet::side + x];
    std::memcpy(&bytes, marks, at_once);
    if (bytes == 0) continue;
    std::memset(marks, 0, at_once);
    row |= static_cast<CellSet::Row>(bytes * gathering_bits >> 56) << x;
  }
  return row;
}

void CellMarks::take(MarkedCells& marked) {
  marked.list.count = 0;
  for (std::size_t y = 0; y < CellSet::side; ++y) {
    const CellSet::Row row = take_row(y);
    marked.set.row(y) = row;
    marked.list.add(y, row);
  }
}

CellsAhead FusionTile::prefetch(const CellList& list) const {
  constexpr std::size_t line = 64;
  const auto* const begin = reinterpret_cast<const char*>(this);
  const auto* const end = reinterpret_cast<const char*>(cells_.data());
  for (const char* at = begin; at < end; at += line) __builtin_prefetch(at, 1);
  return {cells_.data(), list};
}

void FusionTile::open(std::uint32_t scan, std::uint32_t time, const FusionRules& rules) {
  if (scan == scan_) return;
  gathers_ = gathers_on(time, rules);
  if (!gathers_) {
    take_set_aside(rules);
    judge_motion(time);
    open_.clear();
    gathering_since_ = time;
  }
  scan_ = scan;
  time_ = time;
}

/// Many points that were set aside wait for the next scan, which says more of them.
bool FusionTile::gathers_on(std::uint32_t time, const FusionRules& rules) const {
  return still_ && !open_.empty() && set_aside_.size() <= few_points &&
         time - gathering_since_ < rules.gathering_time;
}

void FusionTile::reach(const MarkedCells& marked, const FusionRules& rules, HeightSteps& steps,
                       CellsAhead& ahead) {
  if (open_.empty()) {
    move_on(marked.list, rules, steps, ahead);
  } else {
    CellList behind;
    for (std::size_t y = 0; y < side; ++y) behind.add(y, marked.set.row(y) & ~open_.row(y));
    move_on(behind, rules, steps, ahead);
  }
  open_.add(marked.set);
  unwritten_.add(marked.set);
}

/// Cells take the points of their last scan in and go on to the time of the open one.
void FusionTile::move_on(const CellList& list, const FusionRules& rules, HeightSteps& steps,
                         CellsAhead& ahead) {
  for (std::size_t first = 0; first < list.count; first += CellBatch::size) {
    CellBatch batch;
    CellSteps in;
    batch.count = std::min(CellBatch::size, list.count - first);
    for (std::size_t i = 0; i < batch.count; ++i) {
      ahead.fetch_one();
      if (first + i + listed_ahead < list.count) bring(cells_[list.cells[first + i + listed_ahead]]);
      FilterCell& cell = cells_[list.cells[first + i]];
      batch.cells[i] = &cell;
      in.steps[i] = steps.after(time_ - cell.time);
      in.still_share[i] = cell.time < still_since_ ? 0.0F : 1.0F;
      cell.time = time_;
    }
    news_.add(advance(batch, in, rules.scale));
  }
}

std::size_t FusionTile::add(const Sample* samples, std::size_t count, const FusionRules& rules,
                            CellsAhead& ahead) {
  const std::size_t set_aside = set_aside_.size();
  const double squared_gate = rules.gate.squared_gate;
  const double gate_scale = squared_gate * rules.gate.weight_scale;
  const double squared_relief = rules.gate.relief * rules.gate.relief;
  for (std::size_t i = 0; i < count; ++i) {
    ahead.fetch_one();
    if (i + samples_ahead < count) bring(cells_[samples[i + samples_ahead].cell()]);
    const Sample sample = samples[i];
    FilterCell& cell = cells_[sample.cell()];
    const auto steps = static_cast<double>(std::int64_t{sample.height()} - cell.height);
    const auto variance = static_cast<double>(cell.height_variance);
    const double distance = fixed::step * steps;
    const double own = squared_gate * variance + squared_relief;
    const bool agrees = !rules.robust || (distance * distance - own) * sample.weight() <= gate_scale;
    if (agrees && variance > 0) {
      cell.weight += sample.weight();
      cell.moment += sample.weight() * steps;
      ++cell.count;
    } else {
      set_aside_.push_back(sample);
    }
  }
  return count - (set_aside_.size() - set_aside);
}

/// Takes the evidence of the open scan into account before the one of `time`.
void FusionTile::judge_motion(std::uint32_t time) {
  evidence_ += still_ ? news_.drift : std::min(news_.rest, of_evidence(certain / least_scans));
  news_ = {};
  if (still_) evidence_ = std::max<std::int64_t>(evidence_, 0);
  const bool changes = evidence_ > of_evidence(certain);
  if (changes) {
    still_ = !still_;
    unwritten_.fill();
  }
  const bool never_was = !still_ && (changes || evidence_ < -of_evidence(doubtful));
  if (never_was) still_since_ = time;
  if (changes || never_was) evidence_ = 0;
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
  const FilterCell& known_cell = cells_[cell];
  if (known_cell.weight >= sum.weight) return Verdict::agrees;
  const double drop = fixed::metres(known_cell.height) - sum.height();
  const bool under_a_grain = drop > 0 && drop < highest_flight && sum.count >= known_cell.count;
  const bool persists = refusals_in_row(cell, sum, rules) > rules.patience;
  return persists || under_a_grain ? Verdict::begins : Verdict::refused;
}

void FusionTile::take_set_aside(const FusionRules& rules) {
  if (any_refusals_) forget_refusals();
  for_each_surface(set_aside_, rules, [&](std::size_t at, const SurfaceSum& sum) {
    const Verdict verdict = judge(at, sum, rules);
    if (verdict == Verdict::begins) {
      begin_cell(at, {sum.height(), variance_of(sum, rules), 0, rules.first_rate_variance});
      cells_[at].count = sum.count;
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
    if (refusals_[i] != 0 && open_.has(i) && cells_[i].weight > 0 && !has_set_aside(i)) refusals_[i] = 0;
    any_refusals_ |= refusals_[i] != 0;
  }
}

void FusionTile::sort_set_aside() {
  const auto middle = set_aside_.begin() + static_cast<std::ptrdiff_t>(sorted_);
  std::sort(middle, set_aside_.end());
  std::inplace_merge(set_aside_.begin(), middle, set_aside_.end());
  sorted_ = set_aside_.size();
}

FusionTile::Verdicts FusionTile::verdicts(const FusionRules& rules) {
  Verdicts result;
  sort_set_aside();
  for_each_surface(set_aside_, rules, [&](std::size_t at, const SurfaceSum& sum) {
    const Verdict verdict = judge(at, sum, rules);
    if (verdict == Verdict::begins) {
      ++result.new_cells;
    } else if (verdict == Verdict::refused) {
      ++result.outlier_cells;
      result.outliers += sum.count;
    }
  });
  return result;
}

void FusionTile::write(const FusionRules& rules, const TileLayers& layers) {
  constexpr std::size_t rows_ahead = 3;
  const auto place = [&](std::size_t cell) { return cell / side * layers.stride + cell % side; };
  CellBatch batch;
  std::array<std::size_t, CellBatch::size> places{};
  std::array<float, CellBatch::size> still_share{};
  const auto flush = [&] {
    const CellEstimates of_batch = estimates(batch, still_share, rules.scale);
    for (std::size_t i = 0; i < batch.count; ++i) {
      layers.elevation[places[i]] = of_batch.height[i];
      layers.variance[places[i]] = of_batch.variance[i];
      layers.rate[places[i]] = of_batch.rate[i];
      layers.rate_variance[places[i]] = of_batch.rate_variance[i];
    }
    batch.count = 0;
  };
  for (std::size_t y = 0; y < layers.rows; ++y) {
    if (y + rows_ahead < layers.rows && unwritten_.row(y + rows_ahead) != 0)
      fetch(layers, place((y + rows_ahead) * side));
    for_each_cell(y, unwritten_.row(y) & layers.columns(), [&](std::size_t cell) {
      batch.cells[batch.count] = &cells_[cell];
      places[batch.count] = place(cell);
      still_share[batch.count] = rests(cell) ? 1.0F : 0.0F;
      if (++batch.count == CellBatch::size) flush();
    });
  }
  flush();
  for_each_surface(set_aside_, rules, [&](std::size_t cell, const SurfaceSum& sum) {
    if (!unwritten_.has(cell) || judge(cell, sum, rules) != Verdict::begins) return;
    layers.elevation[place(cell)] = static_cast<float>(sum.height());
    layers.variance[place(cell)] = static_cast<float>(variance_of(sum, rules));
    layers.rate[place(cell)] = 0;
    layers.rate_variance[place(cell)] = static_cast<float>(rules.first_rate_variance);
  });
  unwritten_.clear();
}

void FusionTile::begin_cell(std::size_t cell, const CellEstimate& known) {
  FilterCell& to = cells_[cell];
  to = {};
  to.height = fixed::steps(known.height);
  to.rate = static_cast<float>(known.rate);
  to.height_variance = static_cast<float>(known.variance);
  to.rate_variance = static_cast<float>(known.rate_variance);
  to.still_offset = static_cast<float>(known.height - fixed::metres(to.height));
  to.still_variance = to.height_variance;
  to.count = 1;
  to.time = time_;
  refusals_[cell] = 0;
  unwritten_.add(cell);
}

void FusionTile::forget_cell(std::size_t cell) {
  begin_cell(cell, {0, 0, 0, 0});
  cells_[cell].count = 0;
}

void FusionTile::restart_clock(std::uint32_t end, const FusionRules& rules, HeightSteps& steps) {
  open(scan_ + 1, end, rules);
  time_ = end;
  CellList all;
  for (std::size_t y = 0; y < side; ++y) all.add(y, ~CellSet::Row{0});
  CellsAhead none;
  // Written estimates hold for the last points, which are gone from the cells thereafter.
  move_on(all, rules, steps, none);
  for (FilterCell& cell : cells_) cell.time = 0;
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
    if (known(at)) write(at, cells_[at].count);
  for_each_surface(set_aside_, rules, [&](std::size_t at, const SurfaceSum& sum) {
    if (judge(at, sum, rules) == Verdict::begins) write(at, sum.count);
  });
}

}  // namespace aeolian
