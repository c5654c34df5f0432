#include "aeolian_core/measure/photo_light.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "aeolian_core/measure/sun_position.hpp"
#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr double lowest = 3 * degree;
constexpr double highest = 85 * degree;
constexpr double angle_sigma = 0.1 * degree;  // of given angles
constexpr double sun_sigma = 0.02 * degree;   // of the sun's elevation: refraction near the horizon
constexpr double north_sigma = 0.5 * degree;  // of a direction drawn on the photo
constexpr double pixel_sigma = 0.3;           // of a post's pixels
constexpr double section_reach = 8e-3;        // along the edge, for the bed's height at one place [m]
constexpr std::size_t fewest_points = 6;
constexpr double crest_turn = 2 * degree;  // of the crests against the normal of the edge, as the thesis asks
constexpr double cross_slope = 0.005;      // of the bed along the crests

const Light& checked(const Light& light, const char* source) {
  if (!(light.elevation >= lowest && light.elevation <= highest))
    throw Error(fmt::format("light: {} gives an elevation of {:.1f} degrees, must be from 3 to 85", source,
                            light.elevation / degree));
  if (!(std::abs(light.azimuth) < 80 * degree))
    throw Error(fmt::format(
        "light: {} gives an azimuth of {:.0f} degrees from the edge's normal towards the shadow, must be "
        "within 80",
        source, light.azimuth / degree));
  return light;
}

/// From a vector of travel.
Light along(const Eigen::Vector3d& travel, int side) {
  Light light;
  light.side = side;
  light.elevation = std::atan2(-travel.z(), travel.head<2>().norm());
  light.azimuth = std::atan2(travel.x(), side * travel.y());
  return light;
}

Light from_sun(const PhotoSetup::Sun& sun, const PhotoGeometry& geometry, const PhotoLight& source) {
  const SunPosition position = sun_position(sun.unix_time, sun.latitude, sun.longitude);
  const Eigen::Vector2d step = sun.north_px.normalized();
  const Eigen::Vector3d north =
      geometry.at_level(source.middle_px + step, 0) - geometry.at_level(source.middle_px - step, 0);
  // Clockwise from north is the negative sense of the level frame.
  const double travel = std::atan2(north.y(), north.x()) - (position.azimuth + M_PI);
  const double c = std::cos(position.elevation);
  return along({c * std::cos(travel), c * std::sin(travel), -std::sin(position.elevation)}, source.side);
}

/// Height of the bed at x [m] after the shadow's end, under a light.
double bed_height(const PhotoGeometry& geometry, const Light& light,
                  const std::vector<Eigen::Vector2d>& terminus, double x) {
  std::size_t low = 0;
  std::size_t high = terminus.size();
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (geometry.bed_point(terminus[middle], light).x() > x ? high : low) = middle;
  }
  // A parabola through the stations within reach: the post hides those about its own shadow.
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  Eigen::AlignedBox1d known;
  std::size_t used = 0;
  const auto add = [&](std::size_t i) {
    const Eigen::Vector3d point = geometry.bed_point(terminus[i], light);
    const double t = (point.x() - x) / section_reach;
    if (std::isnan(t) || (std::abs(t) > 1 && used >= fewest_points)) return false;
    const Eigen::Vector3d row(1, t, t * t);
    normal += row * row.transpose();
    right += row * point.z();
    known.extend(Eigen::AlignedBox1d::VectorType(t));
    ++used;
    return true;
  };
  std::size_t down = low + 1;
  while (down > 0 && add(down - 1)) --down;
  for (std::size_t i = low + 1; i < terminus.size() && add(i); ++i) continue;
  const Eigen::Vector3d parabola = normal.ldlt().solve(right);
  const double t = std::clamp(0.0, known.min()[0], known.max()[0]);
  return parabola.dot(Eigen::Vector3d(1, t, t * t));
}

Light from_post(const PhotoSetup::Post& post, const PhotoGeometry& geometry, const PhotoLight& source,
                const LightDoubt& doubt) {
  const double base = geometry.top_face(post.base_px + doubt.base_px).x();
  const Eigen::Vector2d tip_px = post.tip_px + doubt.tip_px;
  const Eigen::Vector3d square(-std::sin(geometry.inclination()), 0, std::cos(geometry.inclination()));
  const Eigen::Vector3d tip = base * geometry.edge() + post.height * square;
  // A higher bed at the tip's shadow means lower light, and lower light a higher bed: the height is where
  // the two agree, found by bisection after a walk down from the edge.
  const auto light_at = [&](double z) { return along(geometry.at_level(tip_px, z) - tip, source.side); };
  const auto excess = [&](double z) {
    return bed_height(geometry, light_at(z), source.terminus, geometry.at_level(tip_px, z).x()) +
           doubt.tip_height - z;
  };
  const double step = post.height / 50;
  const double deepest = tip.z() - 6 * post.height;
  double high = tip.z() - post.height;
  while (high > deepest && !(excess(high - step) > 0)) high -= step;
  double low = high - step;
  if (!(excess(low) > 0 && excess(high) <= 0))
    throw Error(
        "light.post: the shadow of its tip does not lie beyond the straightedge's shadow, in its light");
  while (high - low > 1e-7) {
    const double middle = (low + high) / 2;
    (excess(middle) > 0 ? low : high) = middle;
  }
  return light_at((low + high) / 2);
}

Light plain(const PhotoSetup::Angles& angles, int side) {
  Light light;
  light.elevation = angles.elevation;
  light.azimuth = angles.azimuth;
  light.side = side;
  return light;
}

/// How much the section's height varies where the shadow of a post's tip may belong.
double tip_height_sigma(const PhotoSetup::Post& post, const PhotoGeometry& geometry, const PhotoLight& source,
                        const Light& light) {
  const Eigen::Vector2d edge_shadow = geometry.top_face(source.terminus[source.terminus.size() / 2]);
  const Eigen::Vector2d tip = geometry.top_face(post.tip_px);
  const double way = std::max(0.0, std::abs(tip.y()) - std::abs(edge_shadow.y()));
  double sum = 0;
  double squares = 0;
  constexpr int samples = 21;
  for (int i = 0; i < samples; ++i) {
    const double z =
        bed_height(geometry, light, source.terminus, tip.x() + way * std::tan(crest_turn) * (i - 10) / 10);
    sum += z / samples;
    squares += z * z / samples;
  }
  return std::hypot(std::sqrt(std::max(0.0, squares - sum * sum)), cross_slope * way);
}

}  // namespace

Light find_light(const PhotoSetup& setup, const PhotoGeometry& geometry, const PhotoLight& source,
                 const LightDoubt& doubt) {
  Light light;
  const char* name = "the setup";
  if (const auto* angles = std::get_if<PhotoSetup::Angles>(&setup.light)) {
    light = plain(*angles, source.side);
  } else if (const auto* post = std::get_if<PhotoSetup::Post>(&setup.light)) {
    light = from_post(*post, geometry, source, doubt);
    name = "the post";
  } else if (const auto* sun = std::get_if<PhotoSetup::Sun>(&setup.light)) {
    light = from_sun(*sun, geometry, source);
    name = "the sun's place and time";
  } else {
    throw Error("light: its direction must be given, as elevation_deg and azimuth_deg, post or sun");
  }
  light.elevation += doubt.elevation;
  light.azimuth += doubt.azimuth;
  return checked(light, name);
}

std::vector<LightDoubt> light_doubts(const PhotoSetup& setup, const PhotoGeometry& geometry,
                                     const PhotoLight& source, const Light& light) {
  LightDoubt elevation;
  LightDoubt azimuth;
  if (const auto* post = std::get_if<PhotoSetup::Post>(&setup.light)) {
    std::vector<LightDoubt> doubts(4);
    doubts[0].base_px = {pixel_sigma, pixel_sigma};
    doubts[1].tip_px = {pixel_sigma, 0};
    doubts[2].tip_px = {0, pixel_sigma};
    doubts[3].tip_height = tip_height_sigma(*post, geometry, source, light);
    return doubts;
  }
  const bool sun = std::holds_alternative<PhotoSetup::Sun>(setup.light);
  elevation.elevation = sun ? sun_sigma : angle_sigma;
  azimuth.azimuth = sun ? north_sigma : angle_sigma;
  return {elevation, azimuth};
}

}  // namespace aeolian
