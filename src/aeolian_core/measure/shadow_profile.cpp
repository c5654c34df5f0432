#include "aeolian_core/measure/shadow_profile.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "aeolian_core/measure/local_quadratic.hpp"
#include "aeolian_core/measure/photo_light.hpp"
#include "aeolian_core/measure/setup_geometry.hpp"
#include "aeolian_core/measure/shadow_search.hpp"
#include "aeolian_core/measure/shadow_terminus.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr double degree = M_PI / 180;
constexpr double angle_sigma = 0.1 * degree;     // of given angles of light
constexpr double sun_sigma = 0.02 * degree;      // of the sun's elevation: refraction near the horizon
constexpr double north_sigma = 0.5 * degree;     // of a direction drawn on the photo
constexpr double tip_sigma_px = 0.3;             // of a post's pixels
constexpr double smoothing_stations = 5;         // half width of the regression along the profile

/// Terminus pixels as points of the bed.
struct Section {
  std::vector<double> x;  // reading along the straightedge [m]
  std::vector<double> z;  // under the casting edge at x = 0 [m]
  std::vector<double> y;
};

Section section_of(const std::vector<Eigen::Vector2d>& pixels, const PhotoGeometry& geometry, const Light& light) {
  Section section;
  for (const auto& pixel : pixels) {
    const Eigen::Vector3d point = geometry.bed_point(pixel, light);
    section.x.push_back(geometry.reading(point));
    section.y.push_back(point.y());
    section.z.push_back(point.z());
  }
  return section;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// What the noise of the stations comes to: running root mean squares of what the regression leaves, and how
/// alike neighbours are.
struct Noise {
  std::vector<double> sigma;
  double neighbour_gain = 1;  // of the variance of a local mean by the likeness of neighbours
};

Noise noise_of(const std::vector<double>& z, const LocalQuadratic& smooth) {
  const std::size_t n = z.size();
  std::vector<double> left(n, 0);
  std::vector<double> good(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    if (std::isnan(smooth.fit[i]) || smooth.robust_weight[i] < 0.1) continue;
    // A fit follows its own value: the share it leaves is 1 - 2 leverage + gain^2 of the variance.
    const double kept = 1 - 2 * smooth.leverage[i] + smooth.noise_gain[i] * smooth.noise_gain[i];
    left[i] = (z[i] - smooth.fit[i]) / std::sqrt(std::max(0.1, kept));
    good[i] = 1;
  }
  Noise noise;
  noise.sigma.resize(n);
  const std::ptrdiff_t reach = 40;
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = static_cast<std::ptrdiff_t>(i);
    double squares = 0;
    double count = 0;
    for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, at - reach);
         k <= std::min(static_cast<std::ptrdiff_t>(n) - 1, at + reach); ++k) {
      squares += left[static_cast<std::size_t>(k)] * left[static_cast<std::size_t>(k)];
      count += good[static_cast<std::size_t>(k)];
    }
    noise.sigma[i] = count > 5 ? std::sqrt(squares / count) : std::numeric_limits<double>::quiet_NaN();
  }
  return noise;
}

/// One thing that is not known exactly: what a shift of one standard error does to the section.
using Doubt = std::function<Section(const std::vector<Eigen::Vector2d>&)>;

class Measurement {
 public:
  Measurement(const Photo& photo, const PhotoSetup& setup, ProfileMode mode,
              const std::optional<Eigen::Isometry3d>& known)
      : photo_(photo), setup_(setup), mode_(mode), frame_(setup_geometry(photo, setup, mode, known)) {}

  ShadowProfile run() {
    const Tone tone(photo_);
    const EdgeSpan span = visible_edge(*frame_.geometry, photo_.width_px, photo_.height_px, frame_.middle);
    const RoughTerminus rough =
        search_shadow(tone, photo_.width_px, photo_.height_px, *frame_.geometry, span, frame_.side);
    const double middle = (span.from + span.to) / 2;
    const double pixel_size =
        2e-5 / (frame_.geometry->pixel(middle + 1e-5, 0) - frame_.geometry->pixel(middle - 1e-5, 0)).norm();
    const double spacing = std::max(setup_.grain_diameter.value_or(0), pixel_size);
    const Terminus terminus = locate_terminus(tone, *frame_.geometry, rough, spacing);
    std::vector<Eigen::Vector2d> pixels;
    for (const auto& station : terminus.stations) pixels.push_back(station.pixel);
    if (pixels.size() < 20) throw Error("no shadow with a clear border");
    light_ = find_light(setup_, *frame_.geometry, rough.side, pixels);

    Section raw = section_of(pixels, *frame_.geometry, light_);
    const LocalQuadratic smooth = local_quadratic(raw.x, raw.z, smoothing_stations * spacing);
    const Noise noise = noise_of(raw.z, smooth);

    ShadowProfile profile;
    profile.mode = mode_;
    profile.inclination = setup_.inclination;
    profile.grain_diameter = setup_.grain_diameter.value_or(0);
    profile.scale = {1 / pixel_size, frame_.scale_sigma / pixel_size};
    profile.mark_px = frame_.mark_px;
    profile.remarks = frame_.remarks;
    std::vector<Eigen::Vector2d> kept;
    std::vector<double> slope;
    for (std::size_t i = 0; i < raw.x.size(); ++i) {
      if (std::isnan(smooth.fit[i]) || std::isnan(noise.sigma[i])) continue;
      profile.x.push_back(raw.x[i]);
      profile.y.push_back(raw.y[i]);
      profile.z.push_back(smooth.fit[i]);
      profile.sigma_z.push_back(noise.sigma[i] * smooth.noise_gain[i]);
      profile.terminus_px.push_back(pixels[i]);
      const auto& station = terminus.stations[i];
      profile.spread.push_back(std::abs(frame_.geometry->bed_point(station.upper, light_).z() -
                                        frame_.geometry->bed_point(station.lower, light_).z()));
    }
    finish(profile);
    return profile;
  }

 private:
  /// Heights from where they are reported.
  void finish(ShadowProfile& profile) const {
    const double rise = std::sin(setup_.inclination);
    std::vector<double> drop;
    for (std::size_t i = 0; i < profile.x.size(); ++i) drop.push_back(profile.x[i] * rise - profile.z[i]);
    profile.drop = mean(drop);
    const double base = setup_.height ? -*setup_.height : mean(profile.z);
    for (double& z : profile.z) z -= base;
    profile.elevation = {light_.elevation, angle_sigma};
    profile.azimuth = {light_.azimuth, angle_sigma};
    if (frame_.pose) {
      profile.pose_rms_px = frame_.pose->rms_px;
      profile.camera_distance = frame_.pose->to_camera.inverse().translation().norm();
    }
  }

  const Photo& photo_;
  const PhotoSetup& setup_;
  ProfileMode mode_;
  SetupGeometry frame_;
  Light light_;
};

}  // namespace

ShadowProfile measure_shadow(const Photo& photo, const PhotoSetup& setup, ProfileMode mode) {
  return Measurement(photo, setup, mode, {}).run();
}

ShadowProfile measure_shadow(const Photo& photo, const PhotoSetup& setup,
                             const Eigen::Isometry3d& straightedge_to_camera) {
  return Measurement(photo, setup, ProfileMode::full, straightedge_to_camera).run();
}

}  // namespace aeolian
