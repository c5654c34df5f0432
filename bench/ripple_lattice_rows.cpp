#include <algorithm>
#include <cmath>

#include "ripple_rows.hpp"

#include "aeolian_core/bedforms/lattice/lattice_slice.hpp"
#include "aeolian_core/bedforms/theory/independent_members.hpp"

namespace aeolian {
namespace {

constexpr std::uint64_t seed = 1;
constexpr int members = 8;

/// A mean over independent beds and its standard error.
struct Estimate {
  double mean = 0, error = 0;
};

Estimate estimate(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  Estimate result;
  for (const double v : values) result.mean += v / count;
  for (const double v : values) result.error += (v - result.mean) * (v - result.mean);
  result.error = std::sqrt(result.error / (count - 1) / count);
  return result;
}

std::vector<double> above_mean(std::vector<double> h) {
  double mean = 0;
  for (const double v : h) mean += v / static_cast<double>(h.size());
  for (double& v : h) v -= mean;
  return h;
}

/// Length of the bed per upward crossing of the mean height by the profile averaged over seven columns.
double crossing_wavelength(const std::vector<double>& profile) {
  const std::vector<double> h = above_mean(profile);
  const std::size_t n = h.size();
  std::vector<double> smooth(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 7; ++k) smooth[i] += h[(i + k) % n];
  int crossings = 0;
  for (std::size_t i = 0; i < n; ++i) crossings += smooth[i] < 0 && smooth[(i + 1) % n] >= 0 ? 1 : 0;
  return static_cast<double>(n) / crossings;
}

/// Where the autocorrelation, averaged over seven columns, first has a maximum beyond its first minimum.
double correlation_wavelength(const std::vector<double>& profile) {
  const std::vector<double> h = above_mean(profile);
  const std::size_t n = h.size();
  const auto correlation = [&](std::size_t lag) {
    double sum = 0;
    for (std::size_t l = lag; l < lag + 7; ++l)
      for (std::size_t i = 0; i < n; ++i) sum += h[i] * h[(i + l) % n];
    return sum;
  };
  std::size_t lag = 0;
  while (lag < n / 2 && correlation(lag + 1) <= correlation(lag)) ++lag;
  while (lag < n / 2 && correlation(lag + 1) > correlation(lag)) ++lag;
  return static_cast<double>(lag) + 3;
}

/// Of a sine of the same deviation.
double height(const std::vector<double>& profile) {
  double square = 0;
  for (const double v : above_mean(profile)) square += v * v;
  return 2 * std::sqrt(2 * square / static_cast<double>(profile.size()));
}

void shoot_until(LatticeSlice& bed, double ejections_per_surface_grain) {
  while (bed.ejections_per_surface_grain() < ejections_per_surface_grain) bed.shoot(64);
}

/// The same of independent beds after so many ejections per surface grain.
template <class Measure>
Estimate at(const SliceParameters& parameters, double ejections, const Measure& measure) {
  return estimate(run_members(members, [&](int member) {
    LatticeSlice bed(parameters, seed, static_cast<std::uint64_t>(member));
    shoot_until(bed, ejections);
    return measure(bed.elevation());
  }));
}

SliceParameters reptating(int forward, int backward) {
  SliceParameters parameters;
  parameters.forward = forward;
  parameters.backward = backward;
  return parameters;
}

void flat_bed(AccuracyTable& table) {
  SliceParameters parameters;
  parameters.brink_share = 1;
  const double angle = parameters.impact_angle;
  const std::vector<SliceCounts> counts = run_members(members, [&](int member) {
    LatticeSlice bed(parameters, seed, static_cast<std::uint64_t>(member));
    bed.shoot(100 * parameters.columns);
    return bed.counts();
  });
  std::vector<double> shares;
  std::int64_t impacts = 0, ejections = 0;
  for (const SliceCounts& c : counts) {
    shares.push_back(static_cast<double>(c.backward) / static_cast<double>(c.impacts));
    impacts += c.impacts;
    ejections += c.ejections();
  }
  const Estimate share = estimate(shares);
  table.relative_row("share struck backwards on a flat bed: seen of the grains' downstream sides",
                     (1 - std::cos(angle)) / (std::sqrt(3.0) * std::sin(angle)), share.mean, 0.01,
                     share.error);
  table.statement("25: brink ejection only, flat bed",
                  fmt::format("{} ejections in {} impacts", ejections, impacts), ejections == 0);
}

void brinks_only(AccuracyTable& table) {
  SliceParameters brinks;
  brinks.brink_share = 1;
  const std::vector<double> kept = run_members(members, [&](int member) {
    const auto stream = static_cast<std::uint64_t>(member);
    LatticeSlice rough(reptating(4, 4), seed, stream);
    shoot_until(rough, 20);
    LatticeSlice bed(brinks, rough.heights(), seed + 1, stream);
    bed.shoot(20 * brinks.columns);
    return height(bed.elevation()) / height(rough.elevation());
  });
  const Estimate mean = estimate(kept);
  table.range_row(
      "25: brink ejection only: rms height of rippled beds after 40 impacts per surface grain / before", 0,
      0.9, mean.mean, mean.error);
}

void target_only(AccuracyTable& table) {
  struct Case {
    int reptation;
    double low, high, told_20, told_40;
  };
  for (const Case& c : {Case{4, 40, 60, 45, 60}, Case{8, 50, 80, 55, 72}}) {
    const SliceParameters parameters = reptating(c.reptation, c.reptation);
    const std::vector<std::vector<double>> course = run_members(members, [&](int member) {
      LatticeSlice bed(parameters, seed, static_cast<std::uint64_t>(member));
      std::vector<double> wavelengths;
      for (int ejections = 20; ejections <= 40; ejections += 5) {
        shoot_until(bed, ejections);
        wavelengths.push_back(crossing_wavelength(bed.elevation()));
      }
      return wavelengths;
    });
    std::vector<double> first, mean, last;
    for (const std::vector<double>& w : course) {
      first.push_back(w.front());
      last.push_back(w.back());
      mean.push_back((w[0] + w[1] + w[2] + w[3] + w[4]) / 5);
    }
    const std::string name = fmt::format("target ejection only, reptation {}: wavelength", c.reptation);
    const Estimate e = estimate(mean);
    table.range_row("24: " + name + ", mean from 20 to 40 ejections", c.low, c.high, e.mean, e.error);
    table.remark("24: " + name + " after 20", c.told_20, estimate(first).mean, estimate(first).error);
    table.remark("24: " + name + " after 40", c.told_40, estimate(last).mean, estimate(last).error);
  }
}

void both(AccuracyTable& table) {
  for (const double share : {0.1, 0.3, 0.5}) {
    SliceParameters parameters = reptating(15, 5);
    parameters.brink_share = share;
    const std::string name =
        fmt::format("26: 15 forward, 5 backward, {:g} % brinks, 10 ejections: ", 100 * share);
    const Estimate wavelength = at(parameters, 10, crossing_wavelength);
    const Estimate apart = at(parameters, 10, correlation_wavelength);
    const Estimate high = at(parameters, 10, height);
    const Estimate index =
        at(parameters, 10, [](const auto& h) { return crossing_wavelength(h) / height(h); });
    table.remark(name + "wavelength (thesis ~200 spacings)", 400, wavelength.mean, wavelength.error);
    table.remark(name + "likest distance (specification 62 to 84)", 73, apart.mean, apart.error);
    table.remark(name + "height (thesis ~8 spacings)", 16, high.mean, high.error);
    table.range_row(name + "wavelength / height (thesis 25)", 10, 30, index.mean, index.error);
  }
}

void more_hits(AccuracyTable& table) {
  for (const int hits : {1, 2, 4}) {
    SliceParameters parameters = reptating(4, 4);
    parameters.hits_per_point = hits;
    const Estimate e = at(parameters, 20, crossing_wavelength);
    const char* told = hits == 1   ? "specification"
                       : hits == 2 ? "specification; thesis ~100"
                                   : "specification";
    table.remark(fmt::format("27: reptation 4, {} hits per point, 20 ejections: wavelength ({})", hits, told),
                 hits == 4 ? 48 : 45, e.mean, e.error);
  }
}

}  // namespace

void lattice_rows(AccuracyTable& table) {
  table.section(
      "Lattice bed (rows 24-27)",
      fmt::format(
          "The slice of circular grains of the thesis, {} columns, {} beds. Lengths in half-spacings (0.866 "
          "grain diameters), ejections per surface grain (every other column). A wavelength is the length of "
          "the bed per upward crossing of its mean height by the profile averaged over seven columns; a "
          "height is 2 sqrt 2 times the standard deviation. A bed under target ejection alone coarsens "
          "without end; the wavelength of two ejections at a time does not double.",
          SliceParameters{}.columns, members));
  flat_bed(table);
  target_only(table);
  brinks_only(table);
  both(table);
  more_hits(table);
}

}  // namespace aeolian
