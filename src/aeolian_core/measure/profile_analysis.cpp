#include "aeolian_core/measure/profile_analysis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "aeolian_core/measure/length_scales.hpp"
#include "aeolian_core/measure/none.hpp"
#include "aeolian_core/measure/power_spectrum.hpp"
#include "aeolian_core/measure/profile_noise.hpp"
#include "aeolian_core/measure/profile_ripples.hpp"
#include "aeolian_core/measure/wave_train.hpp"
#include "aeolian_core/surface/median.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

/// Relief below a micrometre is rounding.
constexpr double least_relief = 1e-6;

/// The figures that every ripple has and of which the profile has the mean.
struct RippleFigure {
  Figure ProfileRipple::*of_ripple;
  Figure ProfileAnalysis::*mean;
};
constexpr std::array<RippleFigure, 8> ripple_figures{{
    {&ProfileRipple::wavelength, &ProfileAnalysis::wavelength},
    {&ProfileRipple::height, &ProfileAnalysis::height},
    {&ProfileRipple::index, &ProfileAnalysis::index},
    {&ProfileRipple::stoss_mean, &ProfileAnalysis::stoss_mean},
    {&ProfileRipple::stoss_max, &ProfileAnalysis::stoss_max},
    {&ProfileRipple::lee_mean, &ProfileAnalysis::lee_mean},
    {&ProfileRipple::lee_max, &ProfileAnalysis::lee_max},
    {&ProfileRipple::apparent_dip, &ProfileAnalysis::apparent_dip},
}};
using RippleValues = std::array<double, ripple_figures.size()>;

/// In the order of `ripple_figures`.
RippleValues values_of(const RippleShape& shape, double downwind) {
  const bool right = downwind > 0;
  return {shape.wavelength,
          shape.height,
          shape.wavelength / shape.height,
          right ? shape.left_mean : shape.right_mean,
          right ? shape.left_max : shape.right_max,
          right ? shape.right_mean : shape.left_mean,
          right ? shape.right_max : shape.left_max,
          -downwind * shape.tangent_slope};
}

double rms(const std::vector<double>& values) {
  const double squares = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
  return std::sqrt(squares / static_cast<double>(values.size()));
}

/// The mean over up to `reach` samples to both sides.
std::vector<double> running_mean(const std::vector<double>& values, std::size_t reach) {
  std::vector<double> sum(values.size() + 1, 0.0);
  std::partial_sum(values.begin(), values.end(), sum.begin() + 1);
  std::vector<double> result(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t near = std::min({reach, i, values.size() - 1 - i});
    result[i] = (sum[i + near + 1] - sum[i - near]) / static_cast<double>(2 * near + 1);
  }
  return result;
}

/// Height of a ripple of a given length, whatever undulates the bed at greater lengths: from the differences
/// of heights half that length apart, which for a sinusoid have an rms of its height over sqrt(2).
double typical_height(const std::vector<double>& z, std::size_t half_length) {
  if (half_length == 0 || half_length >= z.size()) return 0;
  double squares = 0;
  for (std::size_t i = half_length; i < z.size(); ++i)
    squares += (z[i] - z[i - half_length]) * (z[i] - z[i - half_length]);
  return std::sqrt(2 * squares / static_cast<double>(z.size() - half_length));
}

/// Mean and scatter of numbers, NaN left out.
class Scatter {
 public:
  void add(double value) {
    if (!std::isfinite(value)) return;
    ++count_;
    const double step = value - mean_;
    mean_ += step / count_;
    squares_ += step * (value - mean_);
  }
  double mean() const { return count_ > 1 ? mean_ : none; }
  double sigma() const { return count_ > 1 ? std::sqrt(squares_ / (count_ - 1)) : none; }

 private:
  double count_ = 0;
  double mean_ = 0;
  double squares_ = 0;
};

/// One profile on its way through the analysis: what is decided once (smoothing, crests, wind), and what is
/// measured again on every copy.
class Analyser {
 public:
  explicit Analyser(const ShadowProfile& profile);
  ProfileAnalysis run();

 private:
  struct CrestRange {
    std::size_t first;
    std::size_t crest;
    std::size_t last;
  };
  /// Lengths that are found once and followed in the copies; 0 when there is none.
  struct Lengths {
    double dominant = 0;    ///< [samples]
    double wavenumber = 0;  ///< [1/m]
  };

  void find_lengths(ProfileAnalysis& result);
  void choose_smoothing();
  void find_ripples(ProfileAnalysis& result);
  void find_wind(ProfileAnalysis& result, const std::vector<RippleShape>& shapes);
  std::vector<double> smoothed(const std::vector<double>& z) const;
  std::vector<double> measured(const std::vector<double>& z, double step) const;
  std::array<double, 2> lengths_of(const std::vector<double>& z, double step);
  void add_uncertainty(ProfileAnalysis& result);

  const ShadowProfile& profile_;
  EvenProfile raw_;
  std::vector<double> smooth_;
  double noise_ = 0;  ///< standard error of a height, typically [m]
  double alike_ = 0;  ///< sigma of eq. 5.2 [m]
  double filter_sigma_ = 0;
  int filter_reach_ = 5;
  Lengths lengths_;
  PowerSpectrum spectrum_;
  std::vector<CrestRange> ranges_;
  double downwind_ = 1;
};

EvenProfile on_grains(const ShadowProfile& profile) {
  std::vector<double> spacing;
  for (std::size_t i = 1; i < profile.x.size(); ++i)
    if (const double d = profile.x[i] - profile.x[i - 1]; d > 0) spacing.push_back(d);
  const double station = spacing.empty() ? 0 : median(spacing) * std::cos(profile.inclination);
  const double step = std::max(profile.grain_diameter, station);
  // Over more than ten steps nobody knows what the bed does.
  return step > 0 ? resample(profile, step, 10 * step) : resample(profile, 1, 1);
}

Analyser::Analyser(const ShadowProfile& profile)
    : profile_(profile), raw_(on_grains(profile)), spectrum_(raw_.z.size(), raw_.step) {
  const double roughness = neighbour_noise(raw_.z);
  for (double& sigma : raw_.sigma_z) sigma = std::max(sigma, roughness);
  noise_ = median(raw_.sigma_z);
}

std::vector<double> Analyser::smoothed(const std::vector<double>& z) const {
  // The slope is taken out for the filter, which averages over like heights.
  const EvenProfile even{raw_.start, raw_.step, z, {}};
  std::vector<double> level = detrended(even);
  const std::vector<double> filtered = value_weighted_smoothing(level, filter_sigma_, filter_reach_);
  for (std::size_t i = 0; i < z.size(); ++i) level[i] = z[i] + filtered[i] - level[i];
  return level;
}

void Analyser::find_lengths(ProfileAnalysis& result) {
  const std::vector<double> level = detrended(raw_);
  const std::size_t lags = 5 * level.size() / 9;
  result.wavenumber = spectrum_.wavenumber();
  result.power = spectrum_.density(level);
  for (std::size_t lag = 1; lag <= lags; ++lag) result.lag.push_back(raw_.step * static_cast<double>(lag));
  if (rms(level) < least_relief) {
    result.length_scale.assign(lags, 1);
    return;
  }
  // Heights within the noise are alike. Of a few ripples that differ, a sharper distribution than half the
  // roughness shows splinters only.
  alike_ = std::max(1.5 * noise_, 0.5 * rms(level));
  const LengthScales scales(level, alike_);
  result.length_scale = scales.distribution(lags);
  lengths_.dominant = scales.dominant(result.length_scale).value_or(0);
  // Longer than two thirds of the profile is trend, not wave.
  const double longest = 1.5 / (raw_.step * static_cast<double>(level.size()));
  lengths_.wavenumber = spectrum_.peak(result.power, longest, INFINITY).value_or(0);
}

void Analyser::choose_smoothing() {
  filter_sigma_ = profile_.grain_diameter > 0 ? profile_.grain_diameter : 2 * neighbour_noise(raw_.z);
  if (lengths_.dominant > 0) filter_reach_ = std::clamp(static_cast<int>(lengths_.dominant / 30), 1, 5);
  smooth_ = smoothed(raw_.z);
}

void Analyser::find_ripples(ProfileAnalysis& result) {
  const EvenProfile even{raw_.start, raw_.step, smooth_, {}};
  const std::vector<double> level = detrended(even);
  const double relief = typical_height(level, static_cast<std::size_t>(lengths_.dominant / 2));
  const double prominence = std::max({3 * noise_, profile_.grain_diameter, 0.15 * relief, least_relief});
  const auto crests =
      prominent_crests(running_mean(level, static_cast<std::size_t>(filter_reach_)), prominence);
  std::vector<RippleShape> shapes;
  for (std::size_t i = 0; i < crests.size(); ++i) {
    result.crests.push_back(raw_.start + raw_.step * static_cast<double>(crests[i]));
    const bool leftmost = i == 0;
    const bool rightmost = i + 1 == crests.size();
    const CrestRange range{leftmost ? 0 : crests[i - 1], crests[i],
                           rightmost ? smooth_.size() - 1 : crests[i + 1]};
    const auto shape = measure_ripple(smooth_, raw_.step, range.first, range.crest, range.last, noise_);
    if (!shape || shape->height < prominence) continue;
    const double whole = std::max(3 * noise_, least_relief);
    if ((leftmost && shape->left_rise < whole) || (rightmost && shape->right_rise < whole)) continue;
    ranges_.push_back(range);
    shapes.push_back(*shape);
  }
  find_wind(result, shapes);
  for (const RippleShape& shape : shapes) {
    ProfileRipple ripple;
    ripple.start = raw_.start + raw_.step * shape.start;
    ripple.crest = raw_.start + raw_.step * shape.crest;
    ripple.end = raw_.start + raw_.step * shape.end;
    result.ripples.push_back(ripple);
  }
}

void Analyser::find_wind(ProfileAnalysis& result, const std::vector<RippleShape>& shapes) {
  result.downwind_known = profile_.downwind.has_value();
  if (profile_.downwind) {
    downwind_ = *profile_.downwind < 0 ? -1 : 1;
  } else if (!shapes.empty()) {
    std::vector<double> skew;
    skew.reserve(shapes.size());
    for (const RippleShape& shape : shapes) skew.push_back(shape.right_mean - shape.left_mean);
    downwind_ = median(skew) < 0 ? -1 : 1;
  }
  result.downwind = downwind_;
}

/// All figures of ripples in one smoothed profile, then their means and the roughness. NaN where a copy has
/// lost one.
std::vector<double> Analyser::measured(const std::vector<double>& z, double step) const {
  std::vector<double> values;
  RippleValues mean{};
  for (const CrestRange& range : ranges_) {
    RippleValues ripple;
    ripple.fill(none);
    if (const auto shape = measure_ripple(z, step, range.first, range.crest, range.last, noise_))
      ripple = values_of(*shape, downwind_);
    values.insert(values.end(), ripple.begin(), ripple.end());
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += ripple[k] / static_cast<double>(ranges_.size());
  }
  if (ranges_.empty()) mean.fill(none);
  values.insert(values.end(), mean.begin(), mean.end());

  values.push_back(rms(detrended({0, step, z, {}})));
  return values;
}

/// The dominant length and the spectral wavelength [m] of one smoothed profile, near those found; NaN where a
/// copy has lost one.
std::array<double, 2> Analyser::lengths_of(const std::vector<double>& z, double step) {
  std::array<double, 2> result{none, none};
  const std::vector<double> level = detrended({0, step, z, {}});
  if (lengths_.dominant > 0) {
    const auto near = static_cast<std::size_t>(std::lround(lengths_.dominant));
    if (const auto lag = LengthScales(level, alike_).maximum_near(near)) result[0] = *lag * step;
  }
  if (lengths_.wavenumber > 0) {
    const auto peak =
        spectrum_.peak(spectrum_.density(level), 0.8 * lengths_.wavenumber, 1.25 * lengths_.wavenumber);
    if (peak) result[1] = step / raw_.step / *peak;
  }
  return result;
}

void Analyser::add_uncertainty(ProfileAnalysis& result) {
  constexpr std::uint64_t pairs = 64;
  const std::size_t n = smooth_.size();
  const double grain = profile_.grain_diameter;
  const auto correlated = grain > 0 ? static_cast<std::size_t>(std::lround(2 * grain / raw_.step)) : 2;
  const ProfileNoise noise(raw_.sigma_z, correlated);
  const double scale_error = profile_.scale.value > 0 ? profile_.scale.sigma / profile_.scale.value : 0;
  // The errors that heights share scale the distance to the edge, so they leave the edge's own slope alone.
  const double edge = std::tan(profile_.inclination) * raw_.step;
  const double level = std::accumulate(smooth_.begin(), smooth_.end(), 0.0) / static_cast<double>(n);

  const std::vector<double> found = measured(smooth_, raw_.step);
  // The copies start from a bed without the noise that is left, whose peaks would hide the effect of more.
  const auto calm = static_cast<std::size_t>(std::max(lengths_.dominant / 20, 1.0));
  const std::vector<double> model = running_mean(running_mean(smooth_, calm), calm);
  const std::vector<double> expected = measured(model, raw_.step);
  const std::array<double, 2> lengths = lengths_of(smooth_, raw_.step);
  std::vector<Scatter> scatter(found.size());
  std::array<Scatter, 2> length_scatter;
  std::vector<Scatter> at(n);
  RandomStream common(1987, pairs);
  for (std::uint64_t pair = 0; pair < pairs; ++pair) {
    const std::vector<double> deviation = noise.draw(pair);
    const double height_error = profile_.relative_sigma * common.normal();
    const double length_error = scale_error * common.normal();
    // In pairs of opposite noise, so that what is linear in it cancels from the means.
    for (const double sign : {1.0, -1.0}) {
      std::vector<double> copy(n);
      for (std::size_t i = 0; i < n; ++i) copy[i] = model[i] + sign * deviation[i];
      copy = smoothed(copy);
      for (std::size_t i = 0; i < n; ++i) {
        at[i].add(copy[i]);
        const double beside = edge * (static_cast<double>(i) - 0.5 * static_cast<double>(n - 1));
        copy[i] += sign * height_error * (copy[i] - level - beside);
      }
      const double step = raw_.step * (1 + sign * length_error);
      const auto values = measured(copy, step);
      for (std::size_t k = 0; k < values.size(); ++k) scatter[k].add(values[k]);
      if (sign < 0) continue;  // the lengths of the whole bed are linear in the noise: the twin tells nothing
      const auto copied = lengths_of(copy, step);
      for (std::size_t k = 0; k < copied.size(); ++k) length_scatter[k].add(copied[k]);
    }
  }
  for (std::size_t i = 0; i < n; ++i) result.even.sigma_z.push_back(at[i].sigma());

  std::size_t next = 0;
  const auto figure = [&] {
    const double bias = scatter[next].mean() - expected[next];
    const Figure f{found[next] - bias, scatter[next].sigma()};
    ++next;
    return f;
  };
  for (ProfileRipple& ripple : result.ripples)
    for (const RippleFigure& f : ripple_figures) ripple.*f.of_ripple = figure();
  for (const RippleFigure& f : ripple_figures) result.*f.mean = figure();
  result.roughness = figure();
  result.dominant_length = {lengths[0], length_scatter[0].sigma()};
  result.spectral_wavelength = {lengths[1], length_scatter[1].sigma()};
  const double mean_wavelength = result.wavelength.value;  // NaN without a whole ripple: then no train either
  result.train_wavelength = train_wavelength(raw_, 0.75 * mean_wavelength, mean_wavelength / 0.75);
  result.train_wavelength.sigma =
      std::hypot(result.train_wavelength.sigma, scale_error * result.train_wavelength.value);
}

ProfileAnalysis Analyser::run() {
  ProfileAnalysis result;
  find_lengths(result);
  choose_smoothing();
  result.even = EvenProfile{raw_.start, raw_.step, smooth_, {}};
  find_ripples(result);
  add_uncertainty(result);
  return result;
}

}  // namespace

ProfileAnalysis analyse(const ShadowProfile& profile) { return Analyser(profile).run(); }

}  // namespace aeolian
