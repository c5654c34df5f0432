#pragma once

#include <optional>
#include <string>
#include <vector>

#include "aeolian_core/measure/shadow_profile.hpp"

namespace aeolian {

/// A profile sampled at a constant step along the horizontal, for the analysis.
struct EvenProfile {
  double start = 0;             ///< position of the first sample [m]
  double step = 0;              ///< [m]
  std::vector<double> z;        ///< [m]
  std::vector<double> sigma_z;  ///< [m]
};

/// Tombrello's value-weighted filter (Werner 1987, eq. 5.1): each value becomes the mean of its neighbours
/// up to `reach` samples away, weighted by exp(-(difference)^2 / 2 sigma^2). Keeps breaks of many sigma. Near
/// the ends the reach shrinks to what both sides have, so that a slope stays. Sigma 0 changes nothing. Throws
/// Error when sigma or reach is negative.
std::vector<double> value_weighted_smoothing(const std::vector<double>& values, double sigma, int reach = 5);

/// The profile on an even grid of the given step by four-point Lagrange interpolation, the longest stretch
/// without a gap wider than `max_gap`; distances are horizontal (the straightedge's inclination is taken
/// out). Throws Error when nothing of at least eight samples is left.
EvenProfile resample(const ShadowProfile& profile, double step, double max_gap);

/// The line of best fit taken out; its slope goes to `slope` when asked.
std::vector<double> detrended(const EvenProfile& profile, double* slope = nullptr);

/// One ripple, between the two troughs that its common tangent touches; measured from that tangent.
struct ProfileRipple {
  double start = 0;  ///< positions of its troughs and of its crest along the profile [m]
  double crest = 0;
  double end = 0;
  Figure wavelength;  ///< along the tangent [m]
  Figure height;      ///< of the crest over the tangent, normal to it [m]
  Figure index;       ///< wavelength / height
  Figure stoss_mean;  ///< slopes to the tangent, positive [rad]: mean from trough to crest ...
  Figure stoss_max;   ///< ... and the steepest over a stretch of a tenth of the wavelength
  Figure lee_mean;
  Figure lee_max;
  Figure apparent_dip;  ///< of the tangent against the horizontal, positive downslope along the wind [rad]
};

/// Everything that is reported of one profile.
struct ProfileAnalysis {
  EvenProfile even;  ///< smoothed as the thesis does for still beds
  std::vector<ProfileRipple> ripples;
  std::vector<double> crests;   ///< all that stand out, also of ripples cut off by the profile's ends [m]
  bool downwind_known = false;  ///< otherwise the steeper flank is taken as the lee
  double downwind = 1;          ///< +1: the wind blows to larger x
  Figure wavelength;            ///< means over the ripples, NaN when there are none
  Figure height;
  Figure index;
  Figure stoss_mean, stoss_max, lee_mean, lee_max;
  Figure apparent_dip;
  Figure roughness;                  ///< rms of the detrended heights [m]
  std::vector<double> lag;           ///< [m]
  std::vector<double> length_scale;  ///< distribution over `lag` (eq. 5.2), mean 1
  Figure dominant_length;  ///< first maximum of it after its first minimum [m], NaN when there is none
  std::vector<double> wavenumber;  ///< cycles [1/m]
  std::vector<double> power;       ///< one-sided density [m^3]; its integral is the variance
  Figure spectral_wavelength;      ///< at the highest peak [m]
  Figure train_wavelength;  ///< of the regular train that fits best, along the bed [m]; NaN without a whole
                            ///< ripple; see wave_train.hpp
};

/// Analyses a profile as the thesis does (sections 2.3 and 2.4 of Werner 1987, ch. V), in this order:
/// resampling to a grain (or the spacing of the stations where that is wider), value-weighted smoothing with
/// sigma = one grain (twice the noise where the grain is not known) and a reach of five samples (less than a
/// thirtieth of the dominant length), crests, a common tangent for each ripple. A crest counts when it stands
/// out by three standard errors of the heights, by one grain, and by 15 % of the typical relief. Ripples cut
/// off by the ends are left out.
///
/// Standard errors are those of the measurement: the scatter of the figures over 64 copies of the profile
/// with new noise (sigma_z or the roughness seen between neighbours, whichever is larger, correlated over two
/// grains) and new common errors of heights and lengths. What the procedure does to the copies in the mean
/// (smoothing lowers crests, noise steepens slopes) is taken off the figures of ripples and the roughness.
/// The scatter from ripple to ripple is no error and is not in it. Not covered: a sharp edge (brink or
/// V-shaped trough) comes out rounded by up to half a grain, and the crest of a ripple whose top is flat on
/// one side only is found up to three standard errors of height below the edge, on the flat side.
///
/// A bed without ripples has NaN figures. Throws Error when fewer than eight samples are left.
ProfileAnalysis analyse(const ShadowProfile& profile);

/// The heights of one ripple over its tangent, from trough to trough along it; start is 0.
EvenProfile ripple_outline(const EvenProfile& profile, const ProfileRipple& ripple);

/// How alike ripples are.
struct ProfileRepeatability {
  EvenProfile mean;       ///< outline of the mean wavelength; sigma_z is the standard deviation at each place
  double wavelength = 0;  ///< mean [m]
  double deviation = 0;   ///< rms over the places of the standard deviation [m]
};

/// Lays outlines (of ripples, or of one ripple measured repeatedly) over each other, each scaled in length
/// and height alike to the mean wavelength, and takes mean and standard deviation at 101 places (Werner 1987,
/// ch. V). Throws Error for fewer than two.
ProfileRepeatability profile_repeatability(const std::vector<EvenProfile>& outlines);

/// What a series of profiles of one section says, photographs in time order.
struct ProfileSeries {
  struct Step {
    double time = 0;   ///< middle of the two photographs [s, from the first]
    Figure migration;  ///< downwind speed of the pattern [m/s]
    Figure growth;     ///< of the ripple height [m/s]
  };
  struct Event {
    enum class Kind { merger, split, birth, loss } kind;
    double time = 0;      ///< [s]
    double position = 0;  ///< of the crest [m]
  };
  std::vector<Step> steps;
  std::vector<Event> events;
  Figure migration;  ///< over the whole series [m/s]
  Figure growth;     ///< [m/s]
};

/// Migration is the shift of the highest correlation between detrended profiles, within half a wavelength of
/// where the last speed leads; over the whole series each profile is held against the earliest one that still
/// resembles it, so that errors do not add up. Its standard error comes from how unlike the profiles are once
/// shifted: noise and change of shape. An error of place that a whole photograph has is not in it. Growth is
/// that of the mean ripple height, over the whole series the weighted line through all. Figures that cannot
/// be had are NaN.
///
/// Crests are followed with the migration. Two that come within half a wavelength and become one are a
/// merger, the reverse a split; a crest that goes or comes alone is a loss or a birth, unless it is within
/// half a wavelength of the ends. A crest missing on one photograph only, or seen on one only between others,
/// counts for nothing.
///
/// Throws Error for fewer than two profiles, another number of times, times that do not rise, and sections
/// that do not overlap.
ProfileSeries analyse_series(const std::vector<ProfileAnalysis>& analyses, const std::vector<double>& times);

}  // namespace aeolian
