#include "aeolian_core/measure/virtual_camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "aeolian_core/measure/surface_rays.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

// Linear tones, as shares of full scale.
constexpr double lit_sand = 0.55;   // level, in the open light
constexpr double sky_share = 0.25;  // of the light: what is left in full shadow
constexpr double straightedge = 0.93;
constexpr double nothing = 0.05;  // beside the map
constexpr double grain_contrast = 0.15;

/// The curve by which cameras write light, 0 to 1 (IEC 61966-2-1).
double srgb(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

double squared(double v) { return v * v; }

/// Share of a disc on the positive side of a straight line that passes its centre at `offset` radii on the
/// negative side.
double disc_share(double offset) {
  const double q = std::clamp(offset, -1.0, 1.0);
  return 0.5 + (q * std::sqrt(1 - q * q) + std::asin(q)) / M_PI;
}

/// The top face of the straightedge: a rectangle from the casting edge towards the light.
class TopFace {
 public:
  TopFace(const Straightedge& edge, const Eigen::Vector3d& light)
      : start_(edge.start), end_(edge.end), to_light_(-light) {
    along_ = edge.end - edge.start;
    length_ = along_.norm();
    if (!(length_ > 0)) throw Error("camera: the straightedge has no length");
    if (!(edge.width > 0))
      throw Error("camera: the straightedge's width is " + std::to_string(edge.width) +
                  " m, must be positive");
    along_ /= length_;
    across_ = Eigen::Vector3d::UnitZ().cross(along_);
    if (!(across_.norm() > 1e-6)) throw Error("camera: the straightedge is vertical");
    across_.normalize();
    if (across_.dot(to_light_) < 0) across_ = -across_;
    width_ = edge.width;
    normal_ = along_.cross(across_);
  }

  /// How much of a pixel's ray the face covers, 0 to 1; its rims are as soft as the pixel is large.
  double coverage(const Eigen::Vector3d& eye, const Eigen::Vector3d& ray, double pixel_angle) const {
    const double distance = normal_.dot(start_ - eye) / normal_.dot(ray);
    if (!(distance > 0)) return 0;
    const Eigen::Vector3d at = eye + distance * ray - start_;
    const double x = at.dot(along_);
    const double y = at.dot(across_);
    const double inside = std::min({x, length_ - x, y, width_ - y});
    return std::clamp(inside / (pixel_angle * distance * ray.norm()) + 0.5, 0.0, 1.0);
  }

  /// Share of the sun's disc that a point of the bed sees past the face.
  double sunlight(const Eigen::Vector3d& point, double sun_radius) const {
    const Eigen::Vector3d a = start_ - point;
    const Eigen::Vector3d b = end_ - point;
    double hidden = beyond(along_, a, across_, sun_radius);
    if (hidden > 0) hidden *= beyond(along_, a + width_ * across_, -across_, sun_radius);
    if (hidden > 0)
      hidden *= beyond(across_, a, along_, sun_radius) * beyond(across_, b, -along_, sun_radius);
    return 1 - hidden;
  }

 private:
  /// Share of the sun's disc on the side `towards` of the plane through the point and a line (`offset` from
  /// it).
  double beyond(const Eigen::Vector3d& line, const Eigen::Vector3d& offset, const Eigen::Vector3d& towards,
                double sun_radius) const {
    Eigen::Vector3d normal = line.cross(offset).normalized();
    if (normal.dot(towards) < 0) normal = -normal;
    return disc_share(std::asin(std::clamp(normal.dot(to_light_), -1.0, 1.0)) / sun_radius);
  }

  Eigen::Vector3d start_;
  Eigen::Vector3d end_;
  Eigen::Vector3d to_light_;
  Eigen::Vector3d along_;
  Eigen::Vector3d across_;
  Eigen::Vector3d normal_;
  double length_ = 0;
  double width_ = 0;
};

/// Two independent standard normal numbers of one place.
std::array<double, 2> normals(const Philox& random, std::uint64_t counter, std::uint64_t stream) {
  const auto bits = random(counter, stream);
  const auto uniform = [](std::uint32_t word) { return (static_cast<double>(word) + 0.5) * 0x1p-32; };
  const double radius = std::sqrt(-2 * std::log(uniform(bits[0])));
  const double angle = 2 * M_PI * uniform(bits[1]);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace

std::vector<std::uint8_t> VirtualCamera::photograph(const HeightMap& bed, const Straightedge& edge,
                                                    const Eigen::Vector3d& light, double grain_diameter,
                                                    std::uint64_t seed) const {
  if (width_px < 1 || height_px < 1 || !(focal_px > 0))
    throw Error("camera: picture size and focal length must be positive");
  if (!(light.norm() > 0 && light.z() < 0)) throw Error("camera: the light must travel downwards");
  if (!(sun_diameter > 0))
    throw Error("camera: sun_diameter is " + std::to_string(sun_diameter) + " rad, must be positive");
  if (!(noise >= 0)) throw Error("camera: noise is " + std::to_string(noise) + ", must not be negative");
  if (!(grain_diameter > 0))
    throw Error("camera: grain_diameter is " + std::to_string(grain_diameter) + " m, must be positive");

  const SurfaceRays surface(bed.geometry(), bed.layer(layer::elevation));
  const Eigen::Vector3d travel = light.normalized();
  const TopFace face(edge, travel);
  const Philox random(seed);
  const Eigen::Vector3d eye = pose.translation();
  const double pixel_angle = 1 / focal_px;

  const auto sand = [&](const Eigen::Vector3d& ray) {
    const auto hit = surface.first_hit(eye, ray);
    if (!hit) return nothing;
    const Eigen::Vector3d point = eye + hit->distance * ray;
    const double lambert =
        std::max(0.0, (travel.x() * hit->slope_x + travel.y() * hit->slope_y - travel.z()) /
                          std::sqrt(1 + squared(hit->slope_x) + squared(hit->slope_y)));
    const double direct = (1 - sky_share) * lambert / -travel.z() * face.sunlight(point, 0.5 * sun_diameter);
    const auto grain_index = [&](double v) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(v / grain_diameter)));
    };
    // A pixel that sees many grains sees their mean.
    const double grains_across = std::max(1.0, hit->distance * ray.norm() * pixel_angle / grain_diameter);
    const double grain = normals(random, grain_index(point.x()), grain_index(point.y()))[0];
    const double albedo = std::max(0.1, 1 + grain_contrast / grains_across * grain);
    return lit_sand * albedo * (sky_share + direct);
  };

  std::vector<std::uint8_t> picture;
  picture.reserve(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
  for (int row = 0; row < height_px; ++row)
    for (int column = 0; column < width_px; ++column) {
      const Eigen::Vector3d ray =
          pose.linear() * Eigen::Vector3d((column + 0.5 - 0.5 * width_px) / focal_px,
                                          (row + 0.5 - 0.5 * height_px) / focal_px, 1);
      const double covered = face.coverage(eye, ray, pixel_angle);
      double light_seen = covered * straightedge;
      if (covered < 1) light_seen += (1 - covered) * sand(ray);
      // One draw serves two neighbours; its stream is not one of the grains'.
      const std::size_t pixel = picture.size();
      const auto pair = normals(random, pixel / 2, std::uint64_t{1} << 63);
      const double tone = srgb(light_seen) + noise * pair[pixel % 2];
      picture.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(tone, 0.0, 1.0))));
    }
  return picture;
}

}  // namespace aeolian
