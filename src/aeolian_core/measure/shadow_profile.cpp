#include "aeolian_core/measure/shadow_profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "aeolian_core/measure/continuous_part.hpp"
#include "aeolian_core/measure/edge_light.hpp"
#include "aeolian_core/measure/local_quadratic.hpp"
#include "aeolian_core/measure/photo_light.hpp"
#include "aeolian_core/measure/profile_uncertainty.hpp"
#include "aeolian_core/measure/second_border.hpp"
#include "aeolian_core/measure/setup_geometry.hpp"
#include "aeolian_core/measure/shadow_search.hpp"
#include "aeolian_core/measure/shadow_terminus.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/median.hpp"

namespace aeolian {
namespace {

constexpr std::size_t fewest_stations = 20;
constexpr double steepest_border = 3.5;   // of the terminus to the edge: slip faces in light of 15 degrees
constexpr double steepest_bed = 0.9;      // tan 42 degrees
constexpr double least_kept = 0.35;       // of the photo's width
constexpr double most_shaded = 0.2;       // of the casting edge
constexpr double most_doubled = 0.1;      // of the stations may have a second border
constexpr double post_clearance = 3e-3;   // beside a post and its shadow [m]
constexpr double sun_diameter = 0.0093;   // [rad]
constexpr double usual_grain = 0.5e-3;    // where none is given [m]
constexpr double grain_relief = 0.3;      // rms height of the grains about the bed, in diameters
constexpr double lens_px = 1.3;           // standard deviation of a usual point spread
constexpr double softest = 1.4;           // in expected standard deviations
constexpr double smoothing_stations = 5;  // half width of the regression along the profile

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double distance_to_segment(const Eigen::Vector2d& point, const Eigen::Vector2d& from,
                           const Eigen::Vector2d& to) {
  const Eigen::Vector2d way = to - from;
  const double length = way.squaredNorm();
  const double t = length > 0 ? std::clamp((point - from).dot(way) / length, 0.0, 1.0) : 0;
  return (point - from - t * way).norm();
}

/// The visible part of the casting edge on the photo, which a lens may bend.
std::vector<Eigen::Vector2d> edge_on_photo(const PhotoGeometry& geometry, const EdgeSpan& span) {
  constexpr int parts = 50;
  std::vector<Eigen::Vector2d> line;
  for (int i = 0; i <= parts; ++i)
    line.push_back(geometry.pixel(span.from + (span.to - span.from) * i / parts, 0));
  return line;
}

/// The outline of what was searched: along the edge, and back at the reach of the search.
std::vector<Eigen::Vector2d> band_on_photo(const PhotoGeometry& geometry, const RoughTerminus& rough) {
  std::vector<Eigen::Vector2d> outline;
  const std::size_t stride = std::max<std::size_t>(1, rough.reach.size() / 50);
  std::vector<Eigen::Vector2d> far;
  const std::size_t last = rough.reach.size() - 1;  // the search wants at least twenty columns
  for (std::size_t k = 0; k < last + stride; k += stride) {
    const std::size_t i = std::min(k, last);
    const double x = rough.start + static_cast<double>(i) * rough.step;
    outline.push_back(geometry.pixel(x, 0));
    far.push_back(geometry.pixel(x, rough.side * rough.reach[i]));
  }
  outline.insert(outline.end(), far.rbegin(), far.rend());
  return outline;
}

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
    const double pixel_size = 1 / frame_.geometry->pixels_along((span.from + span.to) / 2);
    const double spacing = std::max(setup_.grain_diameter.value_or(0), pixel_size);
    const Terminus terminus = without_jumps(locate_terminus(tone, *frame_.geometry, rough, spacing));
    std::vector<Eigen::Vector2d> pixels;
    for (const auto& station : terminus.stations) pixels.push_back(station.pixel);
    if (pixels.size() < fewest_stations) throw Error("no shadow with a clear border");
    PhotoLight source{rough.side, middle_px(), pixels};
    light_ = find_light(setup_, *frame_.geometry, source);

    const double half_width = smoothing_stations * spacing;
    Section raw = section_without_walls(pixels, half_width, spacing);
    if (std::holds_alternative<PhotoSetup::Post>(setup_.light)) {
      // The bed's height under the post's shadow, again, from what belongs to the bed.
      source.terminus.clear();
      for (std::size_t i = 0; i < pixels.size(); ++i)
        if (!std::isnan(raw.z[i])) source.terminus.push_back(pixels[i]);
      if (source.terminus.size() < fewest_stations) throw Error("no shadow with a clear border");
      light_ = find_light(setup_, *frame_.geometry, source);
      raw = section_without_walls(pixels, half_width, spacing);
    }
    const LocalQuadratic smooth = local_quadratic(raw.x, raw.z, half_width);
    const std::vector<double> scatter = scatter_sigma(raw.z, smooth, half_width, spacing);

    ShadowProfile profile;
    profile.mode = mode_;
    profile.inclination = setup_.inclination;
    profile.grain_diameter = setup_.grain_diameter.value_or(0);
    profile.scale = {1 / pixel_size, frame_.scale_sigma / pixel_size};
    profile.mark_px = frame_.mark_px;
    profile.edge_px = edge_on_photo(*frame_.geometry, span);
    profile.band_px = band_on_photo(*frame_.geometry, rough);
    profile.remarks = frame_.remarks;
    std::vector<double> slope;
    for (std::size_t i = 0; i < raw.x.size(); ++i) {
      if (std::isnan(smooth.fit[i]) || std::isnan(scatter[i])) continue;
      profile.x.push_back(raw.x[i]);
      profile.y.push_back(raw.y[i]);
      profile.z.push_back(smooth.fit[i]);
      profile.sigma_z.push_back(scatter[i]);
      profile.terminus_px.push_back(pixels[i]);
      slope.push_back(smooth.slope[i]);
      const auto& station = terminus.stations[i];
      profile.spread.push_back(std::abs(frame_.geometry->bed_point(station.upper, light_).z() -
                                        frame_.geometry->bed_point(station.lower, light_).z()));
    }
    const double kept = static_cast<double>(profile.x.size()) * spacing / (span.to - span.from);
    if (profile.x.size() < fewest_stations || kept < least_kept)
      throw Error(fmt::format(
          "no shadow with a clear border: one line of it is found in {:.0f} % of the photo's width",
          100 * kept));
    // The span may reach beyond the straightedge's ends: only where its shadow was found is looked.
    const double shaded =
        shaded_share_of_edge(tone, *frame_.geometry, {profile.x.front(), profile.x.back()}, rough.side);
    if (shaded > most_shaded)
      throw Error(fmt::format("another shadow lies over {:.0f} % of the casting edge", 100 * shaded));
    const SharedError shared =
        shared_error(setup_, frame_, source, light_, profile.terminus_px, slope, !setup_.height.has_value());
    for (std::size_t i = 0; i < profile.x.size(); ++i)
      profile.sigma_z[i] = std::hypot(profile.sigma_z[i], shared.sigma[i]);
    profile.elevation = {light_.elevation, shared.elevation};
    profile.azimuth = {light_.azimuth, shared.azimuth};
    profile.relative_sigma = std::hypot(2 * shared.elevation / std::sin(2 * light_.elevation),
                                        std::tan(light_.azimuth) * shared.azimuth, frame_.scale_sigma);
    finish(profile);
    profile.downwind = downwind();
    require_sharp(profile, terminus);
    const double gap = (2.5 * terminus.width_px + 1) * terminus.pixel_size;
    if (share_with_second_border(tone, *frame_.geometry, profile.terminus_px, rough.side, gap,
                                 terminus.pixel_size) > most_doubled)
      throw Error(
          "two shadows: a second border runs along that of the straightedge's shadow, as of two lights");
    return profile;
  }

 private:
  /// The stations whose places on the plane of the top face form one line, without those that a post touches.
  Terminus without_jumps(const Terminus& terminus) const {
    const std::vector<bool> beside = beside_post(terminus);
    std::vector<double> x;
    std::vector<double> y;
    for (std::size_t i = 0; i < terminus.stations.size(); ++i) {
      const Eigen::Vector2d plan = frame_.geometry->top_face(terminus.stations[i].pixel);
      x.push_back(plan.x());
      y.push_back(beside[i] ? std::numeric_limits<double>::quiet_NaN() : plan.y());
    }
    const std::vector<bool> part = continuous_part(x, y, steepest_border, 4 * terminus.pixel_size);
    Terminus result = terminus;
    result.stations.clear();
    for (std::size_t i = 0; i < part.size(); ++i)
      if (part[i]) result.stations.push_back(terminus.stations[i]);
    return result;
  }

  /// The bed, without (as NaN) what no bed of grains can be: slopes well over the angle of repose, as at the
  /// end of the straightedge's shadow or where something else casts it.
  Section section_without_walls(const std::vector<Eigen::Vector2d>& pixels, double half_width,
                                double spacing) const {
    Section section = section_of(pixels, *frame_.geometry, light_);
    const LocalQuadratic smooth = local_quadratic(section.x, section.z, half_width);
    std::vector<double> z = smooth.fit;
    for (std::size_t i = 0; i < z.size(); ++i)
      if (!(std::abs(smooth.slope[i]) < steepest_bed)) z[i] = std::numeric_limits<double>::quiet_NaN();
    const std::vector<bool> part = continuous_part(section.x, z, steepest_bed, 2 * spacing);
    for (std::size_t i = 0; i < z.size(); ++i)
      if (!part[i]) section.z[i] = std::numeric_limits<double>::quiet_NaN();
    return section;
  }

  /// Which stations the post or its shadow touches. Seen from above both start at the post's foot; for the
  /// shadow the bed is taken to be level at its mean depth, for which a first light will do.
  std::vector<bool> beside_post(const Terminus& terminus) const {
    std::vector<bool> beside(terminus.stations.size(), false);
    const auto* post = std::get_if<PhotoSetup::Post>(&setup_.light);
    if (post == nullptr) return beside;
    const PhotoGeometry& geometry = *frame_.geometry;
    std::vector<double> displacement;
    for (const auto& station : terminus.stations)
      displacement.push_back(std::abs(geometry.top_face(station.pixel).y()));
    const double shadow = median(displacement);
    const double way = std::abs(geometry.top_face(post->tip_px).y()) - shadow;
    const double depth = way > 0 ? shadow * post->height / way : 0;

    const double foot = geometry.top_face(post->base_px).x();
    const Eigen::Vector2d top =
        geometry.top_face(frame_.pose ? frame_.pose->pixel({foot, 0, post->height}) : post->base_px);
    const Eigen::Vector2d tip = geometry.at_level(post->tip_px, -depth).head<2>();
    const double clear = post_clearance + setup_.grain_diameter.value_or(0);
    for (std::size_t i = 0; i < beside.size(); ++i) {
      const Eigen::Vector2d& pixel = terminus.stations[i].pixel;
      beside[i] = distance_to_segment(geometry.top_face(pixel), {foot, 0}, top) < clear ||
                  distance_to_segment(geometry.at_level(pixel, -depth).head<2>(), {foot, 0}, tip) < clear;
    }
    return beside;
  }

  /// A border much softer than the sun's disc, the grains and a lens make it is not the straightedge's, or
  /// not in focus.
  static void require_sharp(const ShadowProfile& profile, const Terminus& terminus) {
    const double sine = std::sin(profile.elevation.value);
    const double grain = profile.grain_diameter > 0 ? profile.grain_diameter : usual_grain;
    const double penumbra =
        profile.drop * sun_diameter / (sine * sine) / 4;  // of a disc: a quarter of its width
    const double grains = grain_relief * grain / std::tan(profile.elevation.value);
    const double expected = std::hypot(std::hypot(penumbra, grains) / terminus.pixel_size, lens_px);
    if (terminus.width_px > softest * expected)
      throw Error(fmt::format(
          "blurred, or not the straightedge's shadow alone: its border rises over {:.1f} px, where the "
          "sun's disc, grains and lens make {:.1f} px (standard deviations)",
          terminus.width_px, expected));
  }

  Eigen::Vector2d middle_px() const { return {(photo_.width_px - 1) / 2.0, (photo_.height_px - 1) / 2.0}; }

  /// +1 when the wind blows to larger x, -1 to smaller, nothing when it blows across or is not given.
  std::optional<double> downwind() const {
    if (!setup_.wind_px) return {};
    const Eigen::Vector2d step = setup_.wind_px->normalized();
    const Eigen::Vector2d way =
        frame_.geometry->top_face(middle_px() + step) - frame_.geometry->top_face(middle_px() - step);
    if (std::abs(way.x()) < 0.2 * way.norm()) return {};
    return way.x() > 0 ? 1 : -1;
  }

  /// Heights from where they are reported.
  void finish(ShadowProfile& profile) const {
    const double rise = std::sin(setup_.inclination);
    std::vector<double> drop;
    for (std::size_t i = 0; i < profile.x.size(); ++i) drop.push_back(profile.x[i] * rise - profile.z[i]);
    profile.drop = mean(drop);
    const double base = setup_.height ? -*setup_.height : mean(profile.z);
    for (double& z : profile.z) z -= base;
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
