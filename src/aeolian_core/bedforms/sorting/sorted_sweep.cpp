#include "aeolian_core/bedforms/sorting/sorted_sweep.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "aeolian_core/bedforms/wrapped.hpp"
#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

constexpr int bundle_lines = 128;  ///< lines that are swept together: what they remember fits a first cache
constexpr int lag = 2;             ///< stations by which a stage's result is behind what it reads
constexpr int stages = 3;
constexpr std::array<double, stages> stage_weight{1.0 / 6, 1.0 / 6, 2.0 / 3};
constexpr int ring = 8;  ///< stations that stages remember

AEOLIAN_KERNEL void gather(std::ptrdiff_t count, double upper, const double* __restrict bed,
                           const double* __restrict dune, double* __restrict height) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double low = bed[i - 1] - dune[i - 1];
    const double high = bed[i] - dune[i];
    height[i] = low + upper * (high - low);
  }
}

AEOLIAN_KERNEL void blend(std::ptrdiff_t count, double upper, const double* __restrict rows,
                          double* __restrict lines) {
  for (std::ptrdiff_t i = 0; i < count; ++i) lines[i] = rows[i - 1] + upper * (rows[i] - rows[i - 1]);
}

/// What a bed gains, as a depth per depth.
struct Rate {
  const double* exposure;
  const double* fine;
  const double* coarse;
};
struct Mobility {
  double fine_largest, coarse_largest, coarse;
};

AEOLIAN_INLINE double net(const Mobility& m, const Rate& rate, double fraction, std::ptrdiff_t i) {
  const double e = rate.exposure[i];
  const double fine = e < m.fine_largest ? e : m.fine_largest;
  const double coarse = e < m.coarse_largest ? e : m.coarse_largest;
  return (rate.fine[i] + rate.coarse[i]) - (fine * (1 - fraction) + m.coarse * coarse * fraction);
}

/// Heights for the next stage: after a step at the rate of the first, or half a step at the mean of two.
AEOLIAN_KERNEL void predict(std::ptrdiff_t count, double depth, const Mobility& given,
                            const double* __restrict height, const double* __restrict fraction, Rate rate,
                            double* __restrict next) {
  const Mobility m = given;
  for (std::ptrdiff_t i = 0; i < count; ++i) next[i] = height[i] + depth * net(m, rate, fraction[i], i);
}

AEOLIAN_KERNEL void predict_half(std::ptrdiff_t count, double depth, const Mobility& given,
                                 const double* __restrict height, const double* __restrict fraction,
                                 Rate rate, Rate second, double* __restrict next) {
  const Mobility m = given;
  const double quarter = 0.25 * depth;
  for (std::ptrdiff_t i = 0; i < count; ++i)
    next[i] = height[i] + quarter * (net(m, rate, fraction[i], i) + net(m, second, fraction[i], i));
}

AEOLIAN_KERNEL void average(std::ptrdiff_t count, double largest, const double* __restrict a,
                            const double* __restrict b, const double* __restrict c, double* __restrict mean) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double x = a[i] < largest ? a[i] : largest;
    const double y = b[i] < largest ? b[i] : largest;
    const double z = c[i] < largest ? c[i] : largest;
    mean[i] = (1.0 / 6) * (x + y + 4 * z);
  }
}

/// Widens the range [low, high] of each row by a station's heights above the dune.
AEOLIAN_KERNEL void widen(std::ptrdiff_t count, const double* __restrict bed, const double* __restrict dune,
                          double* __restrict low, double* __restrict high) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double h = bed[i] - dune[i];
    low[i] = h < low[i] ? h : low[i];
    high[i] = h > high[i] ? h : high[i];
  }
}

}  // namespace

SizeLaw size_law(const WindFrame& frame, const ImpactAngles& angles, double hop, double shortening,
                 double mobility, bool coarse) {
  const double tangent = frame.drift();
  const double across = tangent / (1 + tangent * tangent);
  return {HopLaw(frame.step(), angles, hop, shortening, frame.blur() * across * across), mobility, coarse};
}

SortedSweep::SortedSweep(const WindFrame& frame, const std::array<SizeLaw, sizes>& law, double supply)
    : frame_(frame), law_(law), supply_(supply) {
  for (Fields* fields : {&struck_, &deposition_})
    for (FrameField& field : *fields) field = FrameField(frame.stations(), frame.rows());
}

/// Some lines beside one another, swept from the first station to the last; as ImpactSweep does it.
class SortedSweep::Bundle {
 public:
  Bundle(SortedSweep& sweep, const Task& task, int begin, int end)
      : sweep_(sweep),
        frame_(sweep.frame_),
        law_(sweep.law_),
        task_(task),
        begin_(begin),
        end_(end),
        mobility_{law_[0].largest, law_[1].largest, law_[1].mobility},
        stage_{SortedHopStage(end - begin), SortedHopStage(end - begin), SortedHopStage(end - begin)} {
    const auto lines = static_cast<std::size_t>(end - begin);
    for (auto* rings : {&height_, &exposure_, &fine_, &coarse_})
      for (auto& stations : *rings)
        for (auto& line : stations) line.assign(lines, 0.0);
    for (auto& line : fraction_) line.assign(lines, 0.0);
  }

  Balance run(int first) {
    for (int station = first; station < frame_.stations() + stages * lag; ++station) {
      if (!set_live(station)) continue;
      read(station);
      run_stage(0, station, first);
      const int begin = live_.begin;
      const int count = live_.end - live_.begin;
      if (const int k = station - lag; k >= first) {
        predict(count, task_.depth, mobility_, height(0, k) + begin, fraction(k) + begin, rate(0, k),
                height(1, k) + begin);
        run_stage(1, k, first);
      }
      if (const int k = station - 2 * lag; k >= first) {
        predict_half(count, task_.depth, mobility_, height(0, k) + begin, fraction(k) + begin, rate(0, k),
                     rate(1, k), height(2, k) + begin);
        run_stage(2, k, first);
      }
      const int done = station - stages * lag;
      if (done >= 0 && done < frame_.stations()) write(done);
    }
    return balance_;
  }

 private:
  using Rings = std::array<std::array<std::vector<double>, ring>, stages>;
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  static double* of(Rings& rings, int stage, int station) {
    return rings[at(stage)][at(station & (ring - 1))].data();
  }
  double* height(int stage, int station) { return of(height_, stage, station); }
  double* exposure(int stage, int station) { return of(exposure_, stage, station); }
  double* fine(int stage, int station) { return of(fine_, stage, station); }
  double* coarse(int stage, int station) { return of(coarse_, stage, station); }
  double* fraction(int station) { return fraction_[at(station & (2 * ring - 1))].data(); }
  Rate rate(int stage, int station) {
    return {exposure(stage, station) + live_.begin, fine(stage, station) + live_.begin,
            coarse(stage, station) + live_.begin};
  }

  /// Picks this bundle's lines, counted from its first, that are on the grid at any of the stations in work.
  bool set_live(int station) {
    live_ = {0, end_ - begin_};
    if (!frame_.periodic()) {
      const WindFrame::LineRange now = frame_.lines_at(station);
      const WindFrame::LineRange last = frame_.lines_at(station - stages * lag);
      live_.begin = std::max(live_.begin, std::min(now.begin, last.begin) - begin_);
      live_.end = std::min(live_.end, std::max(now.end, last.end) - begin_);
    }
    return live_.begin < live_.end;
  }

  /// WindFrame's, of lines counted from this bundle's first.
  template <class Work>
  void for_stretches(int station, int begin, int end, Work&& work) const {
    frame_.for_stretches(station, {begin_ + begin, begin_ + end},
                         [&](int from, int to, int q) { work(from - begin_, to - begin_, q); });
  }

  /// Heights and fractions of the lines at a station. Beyond an open grid the bed goes on as it ends.
  void read(int station) {
    double* const h = height(0, station);
    double* const f = fraction(station);
    if (!frame_.periodic() && station >= frame_.stations()) {
      for (int line = live_.begin; line < live_.end; ++line) {
        h[line] = 2 * height(0, station - 1)[line] - height(0, station - 2)[line];
        f[line] = fraction(station - 1)[line];
      }
      return;
    }
    const double upper = frame_.place(station).upper;
    const int where = wrapped(station, frame_.stations());
    for_stretches(station, live_.begin, live_.end, [&](int begin, int end, int q) {
      gather(end - begin, upper, task_.bed.at(where) + q, task_.dune.at(where) + q, h + begin);
      blend(end - begin, upper, task_.fraction.at(where) + q, f + begin);
    });
  }

  void run_stage(int s, int station, int first) {
    stage_[at(s)].sweep(law_, live_.begin, live_.end, height(s, station), height(s, station - 1),
                        height(s, station - 2), fraction(station - 1), fraction(station - 2),
                        exposure(s, station - 2), exposure(s, station - 1),
                        {fine(s, station - lag), coarse(s, station - lag)});
    if (station == first) {
      for (int line = live_.begin; line < live_.end; ++line) start(s, station, line);
    } else if (!frame_.periodic() && station < frame_.stations()) {
      for_difference(station, station - 1, [&](int line) { start(s, station, line); });
    }
    account(s, station - lag);
  }

  void start(int s, int station, int line) {
    height(s, station - 1)[line] = height(s, station)[line];
    // Before it lies a flat bed of the same composition.
    fraction(station - 1)[line] = fraction(station)[line];
    exposure(s, station - 1)[line] = 1;
    stage_[at(s)].begin(law_, line, height(s, station)[line], fraction(station)[line],
                        frame_.periodic() ? 1 : sweep_.supply_);
  }

  /// Visits this bundle's lines that are on an open grid at one station and not at the other.
  template <class Visit>
  void for_difference(int station, int other, Visit&& visit) const {
    frame_.for_difference(station, other, {begin_, end_}, [&](int line) { visit(line - begin_); });
  }
  template <class Visit>
  void for_all(int station, Visit&& visit) const {
    const WindFrame::LineRange with = frame_.lines_at(station);
    for (int line = std::max(with.begin, begin_); line < std::min(with.end, end_); ++line)
      visit(line - begin_);
  }

  /// Books the flux at the ends of lines, by the weight of each stage.
  void account(int s, int station) {
    const SortedHopStage& stage = stage_[at(s)];
    const int last = frame_.stations() - 1;
    if (station != 0 && station != last && (frame_.periodic() || frame_.drift() == 0)) return;
    if (station < 0 || station > last) return;
    for (int size = 0; size < sizes; ++size) {
      const auto book = [&](std::array<double, sizes>& sums, double flux) {
        sums[at(size)] += stage_weight[at(s)] * flux;
      };
      const auto comes = [&](int line) { book(balance_.inflow, stage.flux_in(size, line)); };
      const auto goes = [&](int line) { book(balance_.outflow, stage.flux_out(size, line)); };
      if (frame_.periodic()) {
        for (int line = 0; line < end_ - begin_; ++line) {
          const auto seam = [&](int offset) { return at(wrapped(begin_ + line + offset, frame_.rows())); };
          if (station == 0)
            sweep_.seam_in_[at(size)][seam(frame_.place(0).offset)] +=
                stage_weight[at(s)] * stage.flux_in(size, line);
          if (station == last)
            sweep_.seam_out_[at(size)][seam(frame_.place(last + 1).offset)] +=
                stage_weight[at(s)] * stage.flux_out(size, line);
        }
        continue;
      }
      if (station == 0)
        for_all(station, comes);
      else
        for_difference(station, station - 1, comes);
      if (station == last)
        for_all(station, goes);
      else
        for_difference(station, station + 1, goes);
    }
  }

  void write(int station) {
    int begin = live_.begin;
    int end = live_.end;
    if (!frame_.periodic()) {
      const WindFrame::LineRange now = frame_.lines_at(station);
      begin = std::max(now.begin - begin_, 0);
      end = std::min(now.end - begin_, end_ - begin_);
    }
    if (begin >= end) return;
    for_stretches(station, begin, end, [&](int from, int to, int q) {
      const auto mean = [&](Rings& rings, double largest, FrameField& field) {
        average(to - from, largest, of(rings, 0, station) + from, of(rings, 1, station) + from,
                of(rings, 2, station) + from, field.at(station) + q);
      };
      for (std::size_t s = 0; s < sizes; ++s) mean(exposure_, law_[s].largest, sweep_.struck_[s]);
      mean(fine_, 1e300, sweep_.deposition_[0]);
      mean(coarse_, 1e300, sweep_.deposition_[1]);
    });
  }

  SortedSweep& sweep_;
  const WindFrame& frame_;
  const std::array<SizeLaw, sizes>& law_;
  const Task& task_;
  int begin_, end_;
  Mobility mobility_;
  WindFrame::LineRange live_{};
  Balance balance_;
  std::array<SortedHopStage, stages> stage_;
  /// What the stages work with, at the last stations.
  Rings height_, exposure_, fine_, coarse_;
  std::array<std::vector<double>, std::size_t{2} * ring> fraction_;
};

/// As ImpactSweep does, for each size.
void SortedSweep::close_period() {
  const int last = frame_.stations() - 1;
  const int moved = frame_.place(last + 1).offset - frame_.place(last).offset;
  for (std::size_t s = 0; s < sizes; ++s) {
    for (int q = 0; q < frame_.rows(); ++q) {
      const auto i = static_cast<std::size_t>(q);
      deposition_[s].at(last)[wrapped(q - moved, frame_.rows())] += seam_out_[s][i] - seam_in_[s][i];
    }
    for (int station = 0; station <= last; ++station)
      for (FrameField* field : {&struck_[s], &deposition_[s]})
        field->at(station)[frame_.rows()] = field->at(station)[0];
  }
}

void SortedSweep::run(const FrameField& bed, const FrameField& dune, const FrameField& fraction, double depth,
                      double layer) {
  for (SizeLaw& law : law_) law.largest = layer / (law.mobility * depth);
  const int lines = frame_.end_line() - frame_.first_line();
  const int bundles = (lines + bundle_lines - 1) / bundle_lines;
  const int each = (lines + bundles - 1) / bundles;
  int first = 0;
  if (frame_.periodic()) {
    // A periodic bed is swept some way before the first station, for the envelope and the flux that come
    // round.
    const auto rows = static_cast<std::size_t>(frame_.rows());
    std::vector<double> low(rows, 1e300);
    std::vector<double> high(rows, -1e300);
    for (int i = 0; i < frame_.stations(); ++i)
      widen(frame_.rows(), bed.at(i), dune.at(i), low.data(), high.data());
    const double relief =
        *std::max_element(high.begin(), high.end()) - *std::min_element(low.begin(), low.end());
    const double shadow =
        std::min<double>(frame_.longest_way(), std::ceil(relief / law_[0].hop.least_drop()));
    const double carried = std::max(law_[0].hop.carried, law_[1].hop.carried);
    first = -static_cast<int>(shadow + std::ceil(24 / -std::log(carried))) - stages * lag;
  }
  for (auto* seam : {&seam_in_, &seam_out_})
    for (auto& sums : *seam) sums.assign(static_cast<std::size_t>(frame_.rows()), 0.0);
  const Task task{bed, dune, fraction, depth};
  std::vector<Balance> balances(static_cast<std::size_t>(bundles));
  tbb::parallel_for(0, bundles, [&](int i) {
    const int begin = frame_.first_line() + i * each;
    const int end = std::min(begin + each, frame_.end_line());
    if (begin < end) balances[static_cast<std::size_t>(i)] = Bundle(*this, task, begin, end).run(first);
  });
  inflow_ = outflow_ = {};
  for (const Balance& balance : balances)
    for (std::size_t s = 0; s < sizes; ++s) {
      inflow_[s] += balance.inflow[s];
      outflow_[s] += balance.outflow[s];
    }
  if (frame_.periodic()) close_period();
}

}  // namespace aeolian
