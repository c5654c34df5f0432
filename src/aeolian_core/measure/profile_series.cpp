#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "aeolian_core/measure/crest_tracks.hpp"
#include "aeolian_core/measure/none.hpp"
#include "aeolian_core/measure/profile_analysis.hpp"
#include "aeolian_core/measure/profile_shift.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

double length_of(const EvenProfile& profile) {
  return profile.step * static_cast<double>(profile.z.size() - 1);
}

/// The length on which a bed repeats; of one without ripples half the section, over which it can still be
/// recognised.
double pattern_length(const ProfileAnalysis& analysis) {
  for (const Figure* figure : {&analysis.wavelength, &analysis.dominant_length})
    if (std::isfinite(figure->value)) return figure->value;
  return 0.5 * length_of(analysis.even);
}

/// +1 when the wind blows to larger x: as known on a photograph, else as most photographs suggest.
double common_downwind(const std::vector<ProfileAnalysis>& analyses) {
  double sum = 0;
  for (const ProfileAnalysis& analysis : analyses) {
    if (analysis.downwind_known) return analysis.downwind;
    if (!analysis.ripples.empty()) sum += analysis.downwind;
  }
  return sum < 0 ? -1 : 1;
}

void check(const std::vector<ProfileAnalysis>& analyses, const std::vector<double>& times) {
  if (analyses.size() < 2)
    throw Error("profile series: " + std::to_string(analyses.size()) + " profiles, at least two are needed");
  if (times.size() != analyses.size())
    throw Error("profile series: " + std::to_string(times.size()) + " times for " +
                std::to_string(analyses.size()) + " profiles");
  for (std::size_t i = 1; i < times.size(); ++i)
    if (!(times[i] > times[i - 1]))
      throw Error("profile series: time " + std::to_string(i + 1) + " (" + std::to_string(times[i]) +
                  " s) is not later than the one before (" + std::to_string(times[i - 1]) + " s)");
}

using Shifts = std::vector<std::optional<ProfileShift>>;

/// The shift of each profile since the one before, at the index of the later; looked for where the last speed
/// leads.
Shifts successive_shifts(const std::vector<ProfileAnalysis>& analyses, const std::vector<double>& times) {
  Shifts shifts(1);
  double speed = 0;
  for (std::size_t i = 1; i < analyses.size(); ++i) {
    const double dt = times[i] - times[i - 1];
    shifts.push_back(profile_shift(analyses[i - 1].even, analyses[i].even, speed * dt,
                                   0.5 * pattern_length(analyses[i - 1])));
    if (shifts.back()) speed = shifts.back()->shift.value / dt;
  }
  return shifts;
}

/// Speed over the series: hops from each profile to the latest that still resembles it, so that the error of
/// a profile counts at the ends of a hop only.
Figure mean_speed(const std::vector<ProfileAnalysis>& analyses, const std::vector<double>& times,
                  const Shifts& shifts) {
  constexpr double alike = 0.8;
  double shift = 0;
  double variance = 0;
  double duration = 0;
  std::size_t anchor = 0;
  std::optional<ProfileShift> hop;
  const auto land = [&](std::size_t at) {
    if (hop) {
      shift += hop->shift.value;
      variance += hop->shift.sigma * hop->shift.sigma;
      duration += times[at] - times[anchor];
    }
    anchor = at;
    hop.reset();
  };
  for (std::size_t i = 1; i < analyses.size(); ++i) {
    std::optional<ProfileShift> longer;
    if (hop && shifts[i]) {
      const double range = 0.5 * pattern_length(analyses[anchor]);
      longer = profile_shift(analyses[anchor].even, analyses[i].even,
                             hop->shift.value + shifts[i]->shift.value, range);
      if (longer && (longer->correlation < alike || std::abs(longer->shift.value) > range)) longer.reset();
    }
    if (!longer) {
      land(i - 1);
      longer = shifts[i];
    }
    hop = longer;
  }
  land(analyses.size() - 1);
  return duration > 0 ? Figure{shift / duration, std::sqrt(variance) / duration} : Figure{none, none};
}

/// Slope of the line of weighted least squares; its standard error grows with the scatter about the line
/// where that exceeds the errors.
Figure weighted_slope(const std::vector<double>& times, const std::vector<Figure>& values) {
  double w = 0;
  double wt = 0;
  double wv = 0;
  std::vector<std::size_t> known;
  const auto weight = [&](std::size_t i) {
    constexpr double least = 1e-9;  // a nanometre: figures without any error weigh alike
    return 1 / (values[i].sigma * values[i].sigma + least * least);
  };
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i].value) || !std::isfinite(values[i].sigma)) continue;
    known.push_back(i);
    w += weight(i);
    wt += weight(i) * times[i];
    wv += weight(i) * values[i].value;
  }
  if (known.size() < 2) return {none, none};
  const double t0 = wt / w;
  const double v0 = wv / w;
  double tt = 0;
  double tv = 0;
  for (const std::size_t i : known) {
    tt += weight(i) * (times[i] - t0) * (times[i] - t0);
    tv += weight(i) * (times[i] - t0) * (values[i].value - v0);
  }
  const double slope = tv / tt;
  double chi = 0;
  for (const std::size_t i : known) {
    const double off = values[i].value - v0 - slope * (times[i] - t0);
    chi += weight(i) * off * off;
  }
  const double excess = known.size() > 2 ? chi / static_cast<double>(known.size() - 2) : 1;
  return {slope, std::sqrt(std::max(1.0, excess) / tt)};
}

std::vector<CrestFrame> crest_frames(const std::vector<ProfileAnalysis>& analyses,
                                     const std::vector<double>& times, const Shifts& shifts) {
  std::vector<CrestFrame> frames;
  for (std::size_t i = 0; i < analyses.size(); ++i) {
    const EvenProfile& even = analyses[i].even;
    frames.push_back({analyses[i].crests,
                      times[i] - times[0],
                      shifts[i] ? shifts[i]->shift.value : 0,
                      pattern_length(analyses[i]),
                      even.start,
                      even.start + length_of(even),
                      {}});
  }
  return frames;
}

}  // namespace

ProfileSeries analyse_series(const std::vector<ProfileAnalysis>& analyses, const std::vector<double>& times) {
  check(analyses, times);
  const Shifts shifts = successive_shifts(analyses, times);
  const double downwind = common_downwind(analyses);
  ProfileSeries series;
  std::vector<Figure> heights{analyses.front().height};
  for (std::size_t i = 1; i < analyses.size(); ++i) {
    const double dt = times[i] - times[i - 1];
    const Figure& before = analyses[i - 1].height;
    const Figure& after = analyses[i].height;
    heights.push_back(after);
    ProfileSeries::Step step;
    step.time = 0.5 * (times[i - 1] + times[i]) - times[0];
    step.migration = shifts[i] ? Figure{downwind * shifts[i]->shift.value / dt, shifts[i]->shift.sigma / dt}
                               : Figure{none, none};
    step.growth = {(after.value - before.value) / dt, std::hypot(after.sigma, before.sigma) / dt};
    series.steps.push_back(step);
  }
  series.migration = mean_speed(analyses, times, shifts);
  series.migration.value *= downwind;
  series.growth = weighted_slope(times, heights);
  series.events = crest_events(crest_frames(analyses, times, shifts));
  return series;
}

}  // namespace aeolian
