#include "aeolian_core/measure/photo_light.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "aeolian_core/measure/sun_position.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr double degree = M_PI / 180;
constexpr double lowest = 3 * degree;
constexpr double highest = 85 * degree;

const Light& checked(const Light& light, const char* source) {
  if (!(light.elevation >= lowest && light.elevation <= highest))
    throw Error(fmt::format("light: {} gives an elevation of {:.1f} degrees, must be from 3 to 85", source,
                            light.elevation / degree));
  if (!(std::abs(light.azimuth) < 80 * degree))
    throw Error(fmt::format("light: {} gives an azimuth of {:.0f} degrees from the edge's normal towards the shadow, must be "
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

Light from_sun(const PhotoSetup::Sun& sun, const PhotoGeometry& geometry, int side,
               const std::vector<Eigen::Vector2d>& terminus) {
  const SunPosition position = sun_position(sun.unix_time, sun.latitude, sun.longitude);
  const Eigen::Vector2d here = terminus[terminus.size() / 2];
  const Eigen::Vector2d there = here + 50 * sun.north_px.normalized();
  const Eigen::Vector3d north = geometry.at_level(there, 0) - geometry.at_level(here, 0);
  // Clockwise from north is the negative sense of the level frame.
  const double travel = std::atan2(north.y(), north.x()) - (position.azimuth + M_PI);
  const double c = std::cos(position.elevation);
  return along({c * std::cos(travel), c * std::sin(travel), -std::sin(position.elevation)}, side);
}

/// Height of the bed at x [m] after the shadow's end, under a light.
double bed_height(const PhotoGeometry& geometry, const Light& light, const std::vector<Eigen::Vector2d>& terminus,
                  double x) {
  // The pixels stand in the order of x: the place is found by bisection, the height as a mean of its surroundings.
  std::size_t low = 0;
  std::size_t high = terminus.size();
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (geometry.bed_point(terminus[middle], light).x() > x ? high : low) = middle;
  }
  const std::size_t begin = low < 5 ? 0 : low - 5;
  const std::size_t end = std::min(terminus.size(), low + 6);
  std::vector<double> heights;
  for (std::size_t i = begin; i < end; ++i) heights.push_back(geometry.bed_point(terminus[i], light).z());
  std::nth_element(heights.begin(), heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2), heights.end());
  return heights[heights.size() / 2];
}

Light from_post(const PhotoSetup::Post& post, const PhotoGeometry& geometry, int side,
                const std::vector<Eigen::Vector2d>& terminus) {
  const double base = geometry.top_face(post.base_px).x();
  const Eigen::Vector3d square(-std::sin(geometry.inclination()), 0, std::cos(geometry.inclination()));
  const Eigen::Vector3d tip = base * geometry.edge() + post.height * square;
  // A higher bed at the tip's shadow means lower light, and lower light a higher bed: the height is where
  // the two agree, found by bisection between the tip and a bed as deep as ten posts.
  const auto light_at = [&](double z) {
    return along(geometry.at_level(post.tip_px, z) - tip, side);
  };
  const auto excess = [&](double z) {
    const Light light = light_at(z);
    return bed_height(geometry, light, terminus, geometry.at_level(post.tip_px, z).x()) - z;
  };
  double low = -10 * post.height;
  double high = std::min(0.0, base * std::sin(geometry.inclination()));
  if (!(excess(low) > 0 && excess(high) < 0))
    throw Error("light.post: the shadow of its tip does not lie beyond the straightedge's shadow, in its light");
  while (high - low > 1e-7) {
    const double middle = (low + high) / 2;
    (excess(middle) > 0 ? low : high) = middle;
  }
  return light_at((low + high) / 2);
}

}  // namespace

Light find_light(const PhotoSetup& setup, const PhotoGeometry& geometry, int side,
                 const std::vector<Eigen::Vector2d>& terminus) {
  if (const auto* angles = std::get_if<PhotoSetup::Angles>(&setup.light)) {
    Light light;
    light.elevation = angles->elevation;
    light.azimuth = angles->azimuth;
    light.side = side;
    return checked(light, "the setup");
  }
  if (const auto* post = std::get_if<PhotoSetup::Post>(&setup.light))
    return checked(from_post(*post, geometry, side, terminus), "the post");
  if (const auto* sun = std::get_if<PhotoSetup::Sun>(&setup.light))
    return checked(from_sun(*sun, geometry, side, terminus), "the sun's place and time");
  throw Error("light: its direction must be given, as elevation_deg and azimuth_deg, post or sun");
}

}  // namespace aeolian
