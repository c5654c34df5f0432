#include "aeolian_core/bedforms/height_map/sweep_bundle.hpp"

#include <algorithm>
#include <array>

#include "aeolian_core/bedforms/wrapped.hpp"
#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

constexpr int lag = 2;  ///< stations by which a stage's result is behind what it reads
constexpr int stages = 3;
static_assert(stage_stations == stages * lag);
constexpr int most_lines = HopStage::most_lines;

/// Stations after which nothing of what was is in work.
constexpr int settle = stage_stations + 4;

constexpr std::array<double, stages> stage_weight{1.0 / 6, 1.0 / 6, 2.0 / 3};

AEOLIAN_WIDE_KERNEL void gather(std::ptrdiff_t count, double upper, const double* __restrict bed,
                                const double* __restrict dune, double* __restrict height) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double low = bed[i - 1] - dune[i - 1];
    const double high = bed[i] - dune[i];
    height[i] = low + upper * (high - low);
  }
}

/// Where lines lie on rows.
AEOLIAN_WIDE_KERNEL void gather_row(std::ptrdiff_t count, const double* __restrict bed,
                                    const double* __restrict dune, double* __restrict height) {
  for (std::ptrdiff_t i = 0; i < count; ++i) height[i] = bed[i - 1] - dune[i - 1];
}

/// What can be eroded where each line lies: no more than what lies on either of its rows. `high` is 0 where
/// lines lie on rows.
AEOLIAN_WIDE_KERNEL void gather_ground(std::ptrdiff_t count, std::ptrdiff_t high, double per_depth,
                                       const double* __restrict bed, const double* __restrict floor,
                                       const double* __restrict open, double* __restrict movable,
                                       double* __restrict passable) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double low_sand = (bed[i - 1] - floor[i - 1]) * open[i - 1];
    const double high_sand = (bed[i - 1 + high] - floor[i - 1 + high]) * open[i - 1 + high];
    const double least = low_sand < high_sand ? low_sand : high_sand;
    movable[i] = least > 0 ? least * per_depth : 0;
    passable[i] = open[i - 1] * open[i - 1 + high];
  }
}

/// Heights for the next stage: after a step at the rate of the first, or half a step at the mean of two.
AEOLIAN_WIDE_KERNEL void predict(std::ptrdiff_t count, double depth, const double* __restrict height,
                                 const double* __restrict erosion, const double* __restrict deposition,
                                 double* __restrict next) {
  for (std::ptrdiff_t i = 0; i < count; ++i) next[i] = height[i] + depth * (deposition[i] - erosion[i]);
}

AEOLIAN_WIDE_KERNEL void predict_half(std::ptrdiff_t count, double depth, const double* __restrict height,
                                      const double* __restrict erosion, const double* __restrict deposition,
                                      const double* __restrict erosion_1,
                                      const double* __restrict deposition_1, double* __restrict next) {
  const double quarter = 0.25 * depth;
  for (std::ptrdiff_t i = 0; i < count; ++i)
    next[i] = height[i] + quarter * ((deposition[i] - erosion[i]) + (deposition_1[i] - erosion_1[i]));
}

AEOLIAN_WIDE_KERNEL void average(std::ptrdiff_t count, const double* __restrict a, const double* __restrict b,
                                 const double* __restrict c, double* __restrict mean) {
  for (std::ptrdiff_t i = 0; i < count; ++i) mean[i] = (1.0 / 6) * (a[i] + b[i] + 4 * c[i]);
}

using LineRange = WindFrame::LineRange;

class Bundle {
 public:
  Bundle(const SweepTask& task, int begin, int end)
      : task_(task), frame_(task.frame), law_(task.law), begin_(begin), end_(end) {}

  SweptBundle run() {
    if (task_.ground) return run_on_ground();
    for (int station = task_.first; station < frame_.stations() + stage_stations; ++station) {
      if (!set_live(station)) continue;
      fetch_ahead(station);
      read(station);
      for (int s = 0; s < stages; ++s) run_stage(s, station - s * lag, task_.first);
      write(station - stage_stations);
    }
    return std::move(result_);
  }

 private:
  enum Kind { height_rows, erosion_rows, deposition_rows };
  /// A stage's values of the last stations, as many as are in work.
  double* row(Kind kind, int stage, int station) {
    constexpr int begin[3][stages] = {{0, 8, 12}, {16, 24, 28}, {32, 40, 44}};
    constexpr int count[3][stages] = {{8, 4, 4}, {8, 4, 4}, {8, 4, 4}};
    return rows_[begin[kind][stage] + (station & (count[kind][stage] - 1))];
  }
  double* height(int stage, int station) { return row(height_rows, stage, station); }
  double* erosion(int stage, int station) { return row(erosion_rows, stage, station); }
  double* deposition(int stage, int station) { return row(deposition_rows, stage, station); }
  double* movable(int station) { return movable_[station & 7]; }
  double* passable(int station) { return passable_[station & 7]; }

  SweptBundle run_on_ground() {
    const std::vector<char> busy = busy_stations();
    // Only what lies before sand, as far as its shadow may reach, matters, and where grains go from there.
    const int end = frame_.stations() + stage_stations;
    const int look_ahead = task_.shade + settle;
    const auto next_busy = [&](int station) {
      while (station < end && !busy[index(station)]) ++station;
      return station;
    };
    int origin = task_.first;
    int wake = next_busy(origin);
    int asleep_since = origin - settle;
    awake_.fill(false);
    for (int station = origin; station < end; ++station) {
      if (wake < station) wake = next_busy(station);
      const bool resting = station - asleep_since >= settle && wake > station + lag;
      if (resting && wake > station + look_ahead) {
        if (wake >= end) break;
        origin = station = wake - look_ahead;
        for (HopStage& stage : stage_) stage.forget_shadows();
      }
      if (!set_live(station)) continue;
      fetch_ahead(station);
      read(station);
      for (int s = 0; s < stages; ++s) {
        const int k = station - s * lag;
        if (k < origin) continue;
        const bool sandy = busy[index(k)] || busy[index(k - 1)];
        run_stage_on_ground(s, k, sandy, resting);
        if (!awake_[at(s)]) continue;
        asleep_since = station;
        if (!sandy || is_sheltered(s, k)) let_rest(s, k);
        account(s, k - lag);
      }
      if (!resting) write(station - stage_stations);
    }
    return std::move(result_);
  }

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  std::size_t index(int station) const { return at(std::max(station - task_.first, 0)); }

  /// Where sand lies that can move among this bundle's lines, or comes in from what is unknown.
  std::vector<char> busy_stations() {
    const int end = frame_.stations() + stage_stations;
    std::vector<char> busy(at(end - task_.first), 0);
    for (int station = task_.first; station < end; ++station) {
      if (!set_live(station)) continue;
      const int where = frame_.periodic() ? wrapped(station, frame_.stations())
                                          : std::clamp(station, 0, frame_.stations() - 1);
      char& any = busy[index(station)];
      for_stretches(station, live_.begin, live_.end, [&](int begin, int last, int q) {
        any |= static_cast<char>(task_.sandy->any(where, q - 3, q + last - begin + 3));
      });
      if (task_.ground->holes && !frame_.periodic())
        any |= static_cast<char>(station == task_.first || frame_.drift() != 0);
    }
    return busy;
  }

  /// Picks this bundle's lines, counted from its first, that are on the grid at any of the stations in work.
  bool set_live(int station) {
    live_ = {0, end_ - begin_};
    if (!frame_.periodic()) {
      const LineRange now = frame_.lines_at(station);
      const LineRange last = frame_.lines_at(station - stage_stations);
      live_.begin = std::max(live_.begin, std::min(now.begin, last.begin) - begin_);
      live_.end = std::min(live_.end, std::max(now.end, last.end) - begin_);
    }
    swept_ = {live_.begin & ~3, std::min(most_lines, (live_.end + 3) & ~3)};
    return live_.begin < live_.end;
  }
  /// WindFrame's, of lines counted from this bundle's first.
  template <class Work>
  void for_stretches(int station, int begin, int end, Work&& work) const {
    frame_.for_stretches(station, {begin_ + begin, begin_ + end},
                         [&](int from, int to, int q) { work(from - begin_, to - begin_, q); });
  }

  /// Asks for what a later station needs: stations lie too far apart for the memory to guess it.
  void fetch_ahead(int station) const {
    constexpr int ahead = 6;
    constexpr int line_of_cache = 8;
    const int where = station + ahead;
    if (where < 0 || where >= frame_.stations()) return;
    const int q = begin_ + live_.begin + frame_.place(where).offset;
    const int first = std::clamp(frame_.periodic() ? wrapped(q, frame_.rows()) : q, 0, frame_.rows());
    const int last = std::min(first + live_.end - live_.begin, frame_.rows());
    for (int at = first; at <= last; at += line_of_cache) {
      __builtin_prefetch(task_.bed.at(where) + at);
      __builtin_prefetch(task_.dune.at(where) + at);
      __builtin_prefetch(task_.erosion.at(where) + at, 1);
      __builtin_prefetch(task_.deposition.at(where) + at, 1);
      if (!task_.ground) continue;
      __builtin_prefetch(task_.ground->floor.at(where) + at);
      __builtin_prefetch(task_.ground->open.at(where) + at);
    }
  }

  /// Heights of the lines at a station. Beyond an open grid the bed goes on as it ends.
  void read(int station) {
    double* const h = height(0, station);
    if (!frame_.periodic() && station >= frame_.stations()) {
      const double* const before = height(0, station - 1);
      const double* const before_that = height(0, station - 2);
      for (int line = live_.begin; line < live_.end; ++line) h[line] = 2 * before[line] - before_that[line];
      if (!task_.ground) return;
      std::copy(movable(station - 1) + live_.begin, movable(station - 1) + live_.end,
                movable(station) + live_.begin);
      std::copy(passable(station - 1) + live_.begin, passable(station - 1) + live_.end,
                passable(station) + live_.begin);
      return;
    }
    const double upper = frame_.place(station).upper;
    const int where = wrapped(station, frame_.stations());
    for_stretches(station, live_.begin, live_.end, [&](int begin, int end, int q) {
      const double* const bed = task_.bed.at(where) + q;
      const double* const dune = task_.dune.at(where) + q;
      if (upper > 0)
        gather(end - begin, upper, bed, dune, h + begin);
      else
        gather_row(end - begin, bed, dune, h + begin);
      if (task_.ground)
        gather_ground(end - begin, upper > 0 ? 1 : 0, 1 / task_.depth, bed, task_.ground->floor.at(where) + q,
                      task_.ground->open.at(where) + q, movable(station) + begin, passable(station) + begin);
    });
  }

  HopStage::Stations stations(int s, int k) {
    return {height(s, k),      height(s, k - 1),  height(s, k - 2),
            erosion(s, k - 1), erosion(s, k - 2), deposition(s, k - lag)};
  }

  void predict_heights(int s, int k) {
    const int begin = swept_.begin;
    const int count = swept_.end - swept_.begin;
    if (s == 1)
      predict(count, task_.depth, height(0, k) + begin, erosion(0, k) + begin, deposition(0, k) + begin,
              height(1, k) + begin);
    if (s == 2)
      predict_half(count, task_.depth, height(0, k) + begin, erosion(0, k) + begin, deposition(0, k) + begin,
                   erosion(1, k) + begin, deposition(1, k) + begin, height(2, k) + begin);
  }

  void run_stage(int s, int k, int first) {
    if (k < first) return;
    predict_heights(s, k);
    stage_[at(s)].sweep(law_, swept_.begin, swept_.end, stations(s, k));
    start_lines(s, k, first);
    account(s, k - lag);
  }

  /// Where a stage is asleep nothing is eroded and no grain comes down: what lies there is bare, or in the
  /// shadow. The bed does not change where all have been for long: `resting`.
  void run_stage_on_ground(int s, int k, bool sandy, bool resting) {
    if (resting) {
      stage_[at(s)].pass_over(law_, live_.begin, live_.end, height(0, k));
      if (s > 0) std::copy_n(height(0, k), most_lines, height(s, k));
      start_lines(s, k, task_.first);
      return;
    }
    predict_heights(s, k);
    if (sandy && !awake_[at(s)])
      awake_[at(s)] = lines_begin(k) || stage_[at(s)].is_struck(law_, live_.begin, live_.end, height(s, k));
    if (awake_[at(s)]) {
      stage_[at(s)].sweep(law_, swept_.begin, swept_.end, stations(s, k),
                          {movable(k - 1), passable(k - 1), passable(k - 2)});
    } else {
      stage_[at(s)].pass_over(law_, live_.begin, live_.end, height(s, k));
      std::fill_n(erosion(s, k - 1), most_lines, 0.0);
      std::fill_n(deposition(s, k - lag), most_lines, 0.0);
    }
    start_lines(s, k, task_.first);
  }

  /// Whether no line is struck at the last two stations.
  bool is_sheltered(int s, int k) {
    const double* const eroded = erosion(s, k - 1);
    return !stage_[at(s)].was_struck(live_.begin, live_.end) &&
           std::all_of(eroded + live_.begin, eroded + live_.end, [](double e) { return e == 0; });
  }

  /// Puts a stage to sleep, and the last grains down, where these are few and may come to rest.
  void let_rest(int s, int k) {
    HopStage& stage = stage_[at(s)];
    if (stage.strongest_flux(live_.begin, live_.end) > least_flux * law_.flat_flux) return;
    if (task_.ground->holes)
      for (const int station : {k - 2, k - 1, k})
        if (*std::min_element(passable(station) + live_.begin, passable(station) + live_.end) == 0) return;
    stage.put_down(live_.begin, live_.end, deposition(s, k - lag));
    std::fill_n(erosion(s, k - 1), most_lines, 0.0);  // would come down behind
    awake_[at(s)] = false;
  }

  bool lines_begin(int k) const {
    bool any = k == task_.first;
    if (!frame_.periodic() && k < frame_.stations()) for_difference(k, k - 1, [&](int) { any = true; });
    return any;
  }

  void start_lines(int s, int k, int first) {
    if (k == first) {
      for (int line = live_.begin; line < live_.end; ++line) start(s, k, line);
    } else if (!frame_.periodic() && k < frame_.stations()) {
      for_difference(k, k - 1, [&](int line) { start(s, k, line); });
    }
  }

  void start(int s, int station, int line) {
    height(s, station - 1)[line] = height(s, station)[line];
    erosion(s, station - 1)[line] = 0;
    // Bare ground at the border brings no sand; what is unknown there does.
    double share = 1;
    if (task_.ground && !awake_[at(s)])
      share = 0;
    else if (task_.ground && passable(station)[line] > 0)
      share = std::min(1.0, movable(station)[line]);
    if (task_.supply && share > 0)
      share *= task_.supply(station, begin_ + line + frame_.place(station).offset);
    stage_[at(s)].begin(law_, line, height(s, station)[line], share);
    if (task_.ground && !frame_.periodic()) stage_[at(s)].shade(line, rock_beside(station, line));
  }

  /// The highest rock, above the dune, some rows to either side of a line on the grid: it is taken to stand
  /// before the border too, or a pit there would be struck however deep it is.
  double rock_beside(int station, int line) const {
    const double* const floor = task_.ground->floor.at(station);
    const double* const dune = task_.dune.at(station);
    const int q = begin_ + line + frame_.place(station).offset;
    double highest = HardGround::bottomless;
    for (int row = q - FrameField::pad; row < q + FrameField::pad; ++row)
      highest = std::max(highest, floor[row] - dune[row]);
    return highest;
  }

  /// Visits this bundle's lines that are on an open grid at one station and not at the other.
  template <class Visit>
  void for_difference(int station, int other, Visit&& visit) const {
    frame_.for_difference(station, other, {begin_, end_}, [&](int line) { visit(line - begin_); });
  }
  template <class Visit>
  void for_all(int station, Visit&& visit) const {
    const LineRange with = frame_.lines_at(station);
    for (int line = std::max(with.begin, begin_); line < std::min(with.end, end_); ++line)
      visit(line - begin_);
  }

  /// Whether no line of an open grid begins or ends at a station.
  bool is_amid(int station) const {
    return station > 0 && station < frame_.stations() - 1 &&
           frame_.place(station - 1).offset == frame_.place(station + 1).offset;
  }

  /// Books the flux at the ends of lines, by the weight of each stage.
  void account(int s, int station) {
    const HopStage& stage = stage_[at(s)];
    const int last = frame_.stations() - 1;
    if (frame_.periodic()) {
      if (station != 0 && station != last) return;
      for (int line = 0; line < end_ - begin_; ++line) {
        const int q = begin_ + line + frame_.place(station == 0 ? 0 : last + 1).offset;
        if (station == 0)
          task_.seam_in[at(wrapped(q, frame_.rows()))] += stage_weight[at(s)] * stage.flux_in(line);
        if (station == last)
          task_.seam_out[at(wrapped(q, frame_.rows()))] += stage_weight[at(s)] * stage.flux_out(line);
      }
      return;
    }
    if (station < 0 || station > last || is_amid(station)) return;
    const auto comes = [&](int line) { result_.inflow += stage_weight[at(s)] * stage.flux_in(line); };
    const auto goes = [&](int line) { result_.outflow += stage_weight[at(s)] * stage.flux_out(line); };
    if (station == 0)
      for_all(station, comes);
    else
      for_difference(station, station - 1, comes);
    if (station == last)
      for_all(station, goes);
    else
      for_difference(station, station + 1, goes);
  }

  void write(int station) {
    if (station < 0 || station >= frame_.stations()) return;
    int begin = live_.begin;
    int end = live_.end;
    if (!frame_.periodic()) {
      const LineRange now = frame_.lines_at(station);
      begin = std::max(now.begin - begin_, 0);
      end = std::min(now.end - begin_, end_ - begin_);
    }
    if (begin >= end) return;
    for_stretches(station, begin, end, [&](int from, int to, int q) {
      double* const lost = task_.erosion.at(station) + q;
      double* const gained = task_.deposition.at(station) + q;
      average(to - from, erosion(0, station) + from, erosion(1, station) + from, erosion(2, station) + from,
              lost);
      average(to - from, deposition(0, station) + from, deposition(1, station) + from,
              deposition(2, station) + from, gained);
      if (!task_.ground) return;
      int first = 0;
      int last = to - from;
      while (first < last && lost[first] == 0 && gained[first] == 0) ++first;
      while (first < last && lost[last - 1] == 0 && gained[last - 1] == 0) --last;
      if (first < last) result_.touched.push_back({station, q + first - 1, q + last});
    });
  }

  const SweepTask& task_;
  const WindFrame& frame_;
  const HopLaw& law_;
  int begin_, end_;
  LineRange live_{};
  LineRange swept_{};  ///< and some more beside them, so that they fill vectors
  SweptBundle result_;
  std::array<bool, stages> awake_{};
  alignas(64) double rows_[48][most_lines] = {};
  double movable_[8][most_lines] = {};
  double passable_[8][most_lines] = {};
  std::array<HopStage, stages> stage_;
};

}  // namespace

SweptBundle sweep_bundle(const SweepTask& task, int begin, int end) { return Bundle(task, begin, end).run(); }

}  // namespace aeolian
