#include "aeolian_core/bedforms/impact_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

constexpr int bundle_lines = 128;  ///< lines that are swept together: what they remember fits a first cache
constexpr int lag = 2;             ///< stations by which a stage's result is behind what it reads
constexpr int stages = 3;

AEOLIAN_KERNEL void gather(std::ptrdiff_t count, double upper, const double* __restrict bed,
                           const double* __restrict dune, double* __restrict height) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double low = bed[i - 1] - dune[i - 1];
    const double high = bed[i] - dune[i];
    height[i] = low + upper * (high - low);
  }
}

/// Heights for the next stage: after a step at the rate of the first, or half a step at the mean of two.
AEOLIAN_KERNEL void predict(std::ptrdiff_t count, double depth, const double* __restrict height,
                            const double* __restrict erosion, const double* __restrict deposition,
                            double* __restrict next) {
  for (std::ptrdiff_t i = 0; i < count; ++i) next[i] = height[i] + depth * (deposition[i] - erosion[i]);
}

AEOLIAN_KERNEL void predict_half(std::ptrdiff_t count, double depth, const double* __restrict height,
                                 const double* __restrict erosion, const double* __restrict deposition,
                                 const double* __restrict erosion_1, const double* __restrict deposition_1,
                                 double* __restrict next) {
  const double quarter = 0.25 * depth;
  for (std::ptrdiff_t i = 0; i < count; ++i)
    next[i] = height[i] + quarter * ((deposition[i] - erosion[i]) + (deposition_1[i] - erosion_1[i]));
}

AEOLIAN_KERNEL void average(std::ptrdiff_t count, const double* __restrict a, const double* __restrict b,
                            const double* __restrict c, double* __restrict mean) {
  for (std::ptrdiff_t i = 0; i < count; ++i) mean[i] = (1.0 / 6) * (a[i] + b[i] + 4 * c[i]);
}

/// What can be eroded where each line lies: no more than what lies on either of its rows. `high` is 0 where
/// lines lie on rows.
AEOLIAN_KERNEL void gather_ground(std::ptrdiff_t count, std::ptrdiff_t high, double per_depth,
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

/// Widens the range [low, high] by a station's heights above the dune.
AEOLIAN_KERNEL void relief(std::ptrdiff_t count, const double* __restrict bed, const double* __restrict dune,
                           double& low, double& high) {
  constexpr int lanes = 8;
  double least[lanes];
  double most[lanes];
  std::fill_n(least, lanes, low);
  std::fill_n(most, lanes, high);
  const std::ptrdiff_t whole = count / lanes * lanes;
  for (std::ptrdiff_t i = 0; i < whole; i += lanes)
    for (int k = 0; k < lanes; ++k) {
      const double h = bed[i + k] - dune[i + k];
      least[k] = h < least[k] ? h : least[k];
      most[k] = h > most[k] ? h : most[k];
    }
  for (std::ptrdiff_t i = whole; i < count; ++i) {
    const double h = bed[i] - dune[i];
    least[0] = std::min(least[0], h);
    most[0] = std::max(most[0], h);
  }
  low = *std::min_element(least, least + lanes);
  high = *std::max_element(most, most + lanes);
}

constexpr int settle = stages * lag + 2;  ///< stations after which nothing of what was is in work
constexpr double least_flux = 1e-14;      ///< of a flat bed's, that is still followed over bare ground

constexpr std::array<double, stages> stage_weight{1.0 / 6, 1.0 / 6, 2.0 / 3};

int modulo(int i, int n) { return (i % n + n) % n; }

double blur_along(const WindFrame& frame) {
  const double tangent = frame.drift();
  const double across = tangent / (1 + tangent * tangent);
  return frame.blur() * across * across;
}

}  // namespace

ImpactSweep::ImpactSweep(const WindFrame& frame, double tan_impact_angle, double hop, double shortening)
    : frame_(frame),
      law_(frame.step(), tan_impact_angle, hop, shortening, blur_along(frame)),
      erosion_(frame.stations(), frame.rows()),
      deposition_(frame.stations(), frame.rows()),
      seam_in_(static_cast<std::size_t>(frame.rows()) + 1),
      seam_out_(static_cast<std::size_t>(frame.rows()) + 1) {}

/// Lines on an open grid at a station.
ImpactSweep::Stretch ImpactSweep::on_grid(int station) const {
  const int offset = frame_.place(std::clamp(station, 0, frame_.stations() - 1)).offset;
  return {-offset, frame_.rows() + 1 - offset, offset};
}

/// In stations, at most all.
int ImpactSweep::longest_shadow(const FrameField& bed, const FrameField& dune) const {
  double low = bed.at(0)[0] - dune.at(0)[0];
  double high = low;
  for (int i = 0; i < frame_.stations(); ++i) relief(frame_.rows(), bed.at(i), dune.at(i), low, high);
  return static_cast<int>(std::min<double>(frame_.stations(), std::ceil((high - low) / law_.drop)));
}

/// Some lines beside one another, swept from the first station to the last.
class ImpactSweep::Bundle {
 public:
  Bundle(ImpactSweep& sweep, const Task& task, int begin, int end, std::vector<Touched>& touched)
      : sweep_(sweep),
        frame_(sweep.frame_),
        law_(sweep.law_),
        task_(task),
        touched_(touched),
        begin_(begin),
        end_(end),
        stage_{HopStage(end - begin), HopStage(end - begin), HopStage(end - begin)} {
    const auto lines = static_cast<std::size_t>(end - begin);
    for (auto* rings : {&height_, &erosion_, &deposition_})
      for (auto& ring : *rings)
        for (auto& line : ring) line.assign(lines, 0.0);
    for (auto* ring : {&movable_, &passable_})
      for (auto& line : *ring) line.assign(task.ground ? lines : 0, 0.0);
  }

  Balance run(int first) {
    int last_sandy = frame_.stations();
    if (task_.ground && !frame_.periodic() && task_.shade < frame_.stations()) {
      // Only what lies before sand, as far as its shadow may reach, matters, and where grains go from there.
      int first_sandy = frame_.stations();
      last_sandy = -1;
      for (int station = 0; station < frame_.stations(); ++station) {
        if (!any_sand(station)) continue;
        first_sandy = std::min(first_sandy, station);
        last_sandy = station;
      }
      if (last_sandy < 0) return balance_;
      first = std::max(0, first_sandy - task_.shade - settle);
    }
    for (int station = first; station < frame_.stations() + stages * lag; ++station) {
      if (!set_live(station)) continue;
      read(station);
      if (task_.ground && is_quiet(station)) {
        if (station > last_sandy + settle) break;
        for (int s = 0; s < stages; ++s)
          if (station - s * lag >= first)
            stage_[at(s)].pass_over(law_, live_.begin, live_.end, height(0, station - s * lag));
        continue;
      }
      run_stage(0, station, first);
      const int begin = live_.begin;
      const int count = live_.end - live_.begin;
      if (const int k = station - lag; k >= first) {
        predict(count, task_.depth, height(0, k) + begin, erosion(0, k) + begin, deposition(0, k) + begin,
                height(1, k) + begin);
        run_stage(1, k, first);
      }
      if (const int k = station - 2 * lag; k >= first) {
        predict_half(count, task_.depth, height(0, k) + begin, erosion(0, k) + begin,
                     deposition(0, k) + begin, erosion(1, k) + begin, deposition(1, k) + begin,
                     height(2, k) + begin);
        run_stage(2, k, first);
      }
      const int done = station - stages * lag;
      if (done >= 0 && done < frame_.stations()) write(done);
    }
    return balance_;
  }

 private:
  double* height(int stage, int station) { return height_[at(stage)][at(station & 7)].data(); }
  double* movable(int station) { return movable_[at(station & 15)].data(); }
  double* passable(int station) { return passable_[at(station & 15)].data(); }
  double* erosion(int stage, int station) { return erosion_[at(stage)][at(station & 7)].data(); }
  double* deposition(int stage, int station) { return deposition_[at(stage)][at(station & 7)].data(); }
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  /// Picks this bundle's lines, counted from its first, that are on the grid at any of the stations in work.
  bool set_live(int station) {
    live_ = {0, end_ - begin_, 0};
    if (!frame_.periodic()) {
      const Stretch now = sweep_.on_grid(station);
      const Stretch last = sweep_.on_grid(station - stages * lag);
      live_.begin = std::max(live_.begin, std::min(now.begin, last.begin) - begin_);
      live_.end = std::min(live_.end, std::max(now.end, last.end) - begin_);
    }
    return live_.begin < live_.end;
  }
  /// Calls work(begin, end, q of the line `begin`) for the stretches of given lines that lie side by side.
  template <class Work>
  void for_stretches(int station, int begin, int end, Work&& work) const {
    const int offset = frame_.place(station).offset;
    if (!frame_.periodic()) {
      work(begin, end, begin_ + begin + offset);
      return;
    }
    const int rows = frame_.rows();
    while (begin < end) {
      const int q = modulo(begin_ + begin + offset, rows);
      const int count = std::min(end - begin, rows - q);
      work(begin, begin + count, q);
      begin += count;
    }
  }

  /// Heights of the lines at a station. Beyond an open grid the bed goes on as it ends.
  void read(int station) {
    double* const h = height(0, station);
    if (!frame_.periodic() && station >= frame_.stations()) {
      const double* const before = height(0, station - 1);
      const double* const before_that = height(0, station - 2);
      for (int line = live_.begin; line < live_.end; ++line) {
        h[line] = 2 * before[line] - before_that[line];
        if (!task_.ground) continue;
        movable(station)[line] = movable(station - 1)[line];
        passable(station)[line] = passable(station - 1)[line];
      }
      return;
    }
    const double upper = frame_.place(station).upper;
    const int where = modulo(station, frame_.stations());
    for_stretches(station, live_.begin, live_.end, [&](int begin, int end, int q) {
      gather(end - begin, upper, task_.bed.at(where) + q, task_.dune.at(where) + q, h + begin);
      if (task_.ground)
        gather_ground(end - begin, upper > 0 ? 1 : 0, 1 / task_.depth, task_.bed.at(where) + q,
                      task_.ground->floor.at(where) + q, task_.ground->open.at(where) + q,
                      movable(station) + begin, passable(station) + begin);
    });
  }

  bool any_sand(int station) const {
    const int offset = frame_.place(station).offset;
    return task_.sandy->any(station, begin_ + offset - 3, end_ + offset + 3);
  }

  /// Whether nothing can move among this bundle's lines at the stations in work or next, and no grain is on
  /// its way. Lines that begin here bring sand.
  bool is_quiet(int station) {
    const int ahead = frame_.periodic() ? modulo(station + 2, frame_.stations())
                                        : std::clamp(station + 2, 0, frame_.stations() - 1);
    const int offset = frame_.place(station).offset;
    bool sandy = station < settle && !frame_.periodic();
    for_stretches(station, live_.begin, live_.end, [&](int begin, int end, int q) {
      sandy = sandy || task_.sandy->any(ahead, q - 3, q + end - begin + 3);
    });
    if (!frame_.periodic() && frame_.drift() != 0) {
      // The line that enters at the side.
      const int q = frame_.drift() > 0 ? 0 : frame_.rows();
      const int line = q - offset - begin_;
      sandy = sandy || (line >= live_.begin - 1 && line <= live_.end);
    }
    if (sandy) awake_until_ = station + 2 + settle;
    if (station <= awake_until_) return false;
    return std::all_of(stage_.begin(), stage_.end(), [&](const HopStage& stage) {
      return stage.strongest_flux(live_.begin, live_.end) < least_flux * law_.flat_flux;
    });
  }

  void run_stage(int s, int station, int first) {
    if (task_.ground)
      stage_[at(s)].sweep_hard(law_, live_.begin, live_.end, height(s, station), height(s, station - 1),
                               height(s, station - 2), movable(station - 1), passable(station - 1),
                               passable(station - 2), erosion(s, station - lag),
                               deposition(s, station - lag));
    else
      stage_[at(s)].sweep(law_, live_.begin, live_.end, height(s, station), height(s, station - 1),
                          height(s, station - 2), erosion(s, station - lag), deposition(s, station - lag));
    if (station == first) {
      for (int line = live_.begin; line < live_.end; ++line) start(s, station, line);
    } else if (!frame_.periodic() && station < frame_.stations()) {
      for_difference(station, station - 1, [&](int line) { start(s, station, line); });
    }
    account(s, station - lag);
  }

  /// Visits this bundle's lines that are on an open grid at one station and not at the other.
  template <class Visit>
  void for_difference(int station, int other, Visit&& visit) const {
    const Stretch with = sweep_.on_grid(station);
    const Stretch without = sweep_.on_grid(other);
    for (int line = std::max(with.begin, begin_); line < std::min({with.end, without.begin, end_}); ++line)
      visit(line - begin_);
    for (int line = std::max({with.begin, without.end, begin_}); line < std::min(with.end, end_); ++line)
      visit(line - begin_);
  }
  template <class Visit>
  void for_all(int station, Visit&& visit) const {
    const Stretch with = sweep_.on_grid(station);
    for (int line = std::max(with.begin, begin_); line < std::min(with.end, end_); ++line)
      visit(line - begin_);
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
          sweep_.seam_in_[at(modulo(q, frame_.rows()))] += stage_weight[at(s)] * stage.flux_in(line);
        if (station == last)
          sweep_.seam_out_[at(modulo(q, frame_.rows()))] += stage_weight[at(s)] * stage.flux_out(line);
      }
      return;
    }
    if (station < 0 || station > last) return;
    const auto comes = [&](int line) { balance_.inflow += stage_weight[at(s)] * stage.flux_in(line); };
    const auto goes = [&](int line) { balance_.outflow += stage_weight[at(s)] * stage.flux_out(line); };
    if (station == 0)
      for_all(station, comes);
    else
      for_difference(station, station - 1, comes);
    if (station == last)
      for_all(station, goes);
    else
      for_difference(station, station + 1, goes);
  }

  void start(int s, int station, int line) {
    height(s, station - 1)[line] = height(s, station)[line];
    // Bare ground at the border brings no sand; what is unknown there does.
    const bool bare = task_.ground && passable(station)[line] > 0;
    double share = bare ? std::min(1.0, movable(station)[line]) : 1.0;
    if (sweep_.supply_) share *= sweep_.supply_(station, begin_ + line + frame_.place(station).offset);
    stage_[at(s)].begin(law_, line, height(s, station)[line], share);
  }

  void write(int station) {
    int begin = live_.begin;
    int end = live_.end;
    if (!frame_.periodic()) {
      const Stretch now = sweep_.on_grid(station);
      begin = std::max(now.begin - begin_, 0);
      end = std::min(now.end - begin_, end_ - begin_);
    }
    if (begin >= end) return;
    for_stretches(station, begin, end, [&](int from, int to, int q) {
      average(to - from, erosion(0, station) + from, erosion(1, station) + from, erosion(2, station) + from,
              sweep_.erosion_.at(station) + q);
      average(to - from, deposition(0, station) + from, deposition(1, station) + from,
              deposition(2, station) + from, sweep_.deposition_.at(station) + q);
      if (task_.ground) touched_.push_back({station, q - 1, q + to - from});
    });
  }

  ImpactSweep& sweep_;
  const WindFrame& frame_;
  const HopLaw& law_;
  const Task& task_;
  std::vector<Touched>& touched_;
  int begin_, end_;
  int awake_until_ = 0;
  Stretch live_{};
  Balance balance_;
  std::array<HopStage, stages> stage_;
  /// What the stages work with, at the last eight stations.
  std::array<std::array<std::vector<double>, 8>, stages> height_, erosion_, deposition_;
  std::array<std::vector<double>, 16> movable_, passable_;
};

/// Puts right at the last station of a periodic bed what the first round left of the difference between what
/// goes out there and what comes in at the first, so that no sand is made or lost.
void ImpactSweep::close_period() {
  const int last = frame_.stations() - 1;
  const int moved = frame_.place(last + 1).offset - frame_.place(last).offset;
  for (int q = 0; q < frame_.rows(); ++q) {
    const auto i = static_cast<std::size_t>(q);
    deposition_.at(last)[modulo(q - moved, frame_.rows())] += seam_out_[i] - seam_in_[i];
  }
  for (int station = 0; station <= last; ++station) {
    erosion_.at(station)[frame_.rows()] = erosion_.at(station)[0];
    deposition_.at(station)[frame_.rows()] = deposition_.at(station)[0];
  }
}

void ImpactSweep::run(const FrameField& bed, const FrameField& dune, double depth) {
  run(Task{bed, dune, nullptr, nullptr, depth, frame_.stations()});
}

void ImpactSweep::run(const FrameField& bed, const FrameField& dune, const HardGround& ground,
                      const ActivePatches& sandy, double depth, ActivePatches& active) {
  for (int station = 0; station < frame_.stations(); ++station)
    active.for_runs(station, [&](int begin, int end) {
      std::fill(erosion_.at(station) + begin, erosion_.at(station) + end + 1, 0.0);
      std::fill(deposition_.at(station) + begin, deposition_.at(station) + end + 1, 0.0);
    });
  active.fill(false);
  const int shade = ground.holes ? frame_.stations() : longest_shadow(bed, dune);
  run(Task{bed, dune, &ground, &sandy, depth, shade});
  for (const auto& bundle : touched_)
    for (const Touched& touched : bundle) {
      active.activate_rows(touched.station, touched.begin, touched.end);
      if (frame_.periodic() && touched.begin < 0)
        active.activate_rows(touched.station, frame_.rows() - 1, frame_.rows());
    }
}

void ImpactSweep::run(const Task& task) {
  const int lines = frame_.end_line() - frame_.first_line();
  const int bundles = (lines + bundle_lines - 1) / bundle_lines;
  const int each = (lines + bundles - 1) / bundles;
  // A periodic bed is swept some way before the first station, for the envelope and the flux that come round.
  const int first = frame_.periodic()
                        ? -longest_shadow(task.bed, task.dune) -
                              static_cast<int>(std::ceil(24 / -std::log(law_.carried))) - stages * lag
                        : 0;
  std::fill(seam_in_.begin(), seam_in_.end(), 0.0);
  std::fill(seam_out_.begin(), seam_out_.end(), 0.0);
  std::vector<Balance> balances(static_cast<std::size_t>(bundles));
  touched_.assign(static_cast<std::size_t>(bundles), {});
  tbb::parallel_for(0, bundles, [&](int i) {
    const int begin = frame_.first_line() + i * each;
    const int end = std::min(begin + each, frame_.end_line());
    const auto at = static_cast<std::size_t>(i);
    if (begin < end) balances[at] = Bundle(*this, task, begin, end, touched_[at]).run(first);
  });
  inflow_ = outflow_ = 0;
  for (const Balance& balance : balances) {
    inflow_ += balance.inflow;
    outflow_ += balance.outflow;
  }
  if (frame_.periodic()) close_period();
}

}  // namespace aeolian
