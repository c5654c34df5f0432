#include "lens.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace aeolian {

namespace {

constexpr int node_spacing = 16;  // px; the cubic between nodes is then good to 1e-7 px

}  // namespace

Eigen::Vector2d Lens::distort(const Eigen::Vector2d& p) const {
  const auto& k = camera_.distortion;
  const double r2 = p.squaredNorm();
  const double radial =
      (1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]))) / (1 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])));
  const double xy = p.x() * p.y();
  return {p.x() * radial + 2 * k[2] * xy + k[3] * (r2 + 2 * p.x() * p.x()),
          p.y() * radial + 2 * k[3] * xy + k[2] * (r2 + 2 * p.y() * p.y())};
}

Eigen::Matrix2d Lens::slope(const Eigen::Vector2d& p) const {
  const auto& k = camera_.distortion;
  const double r2 = p.squaredNorm();
  const double above = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const double below = 1 + r2 * (k[5] + r2 * (k[6] + r2 * k[7]));
  const double above_slope = k[0] + r2 * (2 * k[1] + r2 * 3 * k[4]);
  const double below_slope = k[5] + r2 * (2 * k[6] + r2 * 3 * k[7]);
  const double radial = above / below;
  const double radial_slope = (above_slope - radial * below_slope) / below;
  Eigen::Matrix2d j = radial * Eigen::Matrix2d::Identity() + 2 * radial_slope * p * p.transpose();
  j(0, 0) += 2 * k[2] * p.y() + 6 * k[3] * p.x();
  j(0, 1) += 2 * k[2] * p.x() + 2 * k[3] * p.y();
  j(1, 0) += 2 * k[3] * p.y() + 2 * k[2] * p.x();
  j(1, 1) += 2 * k[3] * p.x() + 6 * k[2] * p.y();
  return j;
}

Eigen::Vector2d Lens::pixel(const Eigen::Vector2d& direction) const {
  const Eigen::Vector2d p = distort(direction);
  return {camera_.fx * p.x() + camera_.cx, camera_.fy * p.y() + camera_.cy};
}

Eigen::Vector2d Lens::direction(const Eigen::Vector2d& pixel, const Eigen::Vector2d& guess) const {
  const Eigen::Vector2d seen{(pixel.x() - camera_.cx) / camera_.fx, (pixel.y() - camera_.cy) / camera_.fy};
  Eigen::Vector2d p = guess;
  for (int round = 0; round < 30; ++round) {
    const Eigen::Vector2d step = slope(p).inverse() * (seen - distort(p));
    p += step;
    if (step.squaredNorm() < 1e-24) break;
  }
  return p;
}

Eigen::Vector2d Lens::direction(const Eigen::Vector2d& pixel) const {
  return direction(pixel, {(pixel.x() - camera_.cx) / camera_.fx, (pixel.y() - camera_.cy) / camera_.fy});
}

std::vector<Eigen::Vector2d> Lens::row(double y) const {
  const int nodes = camera_.width_px / node_spacing + 5;
  std::vector<Eigen::Vector2d> at_node;
  const auto node_x = [](int node) { return static_cast<double>((node - 2) * node_spacing); };
  for (int node = 0; node < nodes; ++node) {
    const Eigen::Vector2d pixel{node_x(node), y};
    at_node.push_back(node == 0 ? direction(pixel) : direction(pixel, at_node.back()));
  }
  std::vector<Eigen::Vector2d> directions(static_cast<std::size_t>(camera_.width_px) + 2);
  for (int x = -1; x <= camera_.width_px; ++x) {
    const int node = (x + 2 * node_spacing) / node_spacing;  // the last one at or before x
    const double t = (x - node_x(node)) / node_spacing;
    const Eigen::Vector2d* d = at_node.data() + node;
    directions[static_cast<std::size_t>(x + 1)] =
        -t * (t - 1) * (t - 2) / 6 * d[-1] + (t + 1) * (t - 1) * (t - 2) / 2 * d[0] -
        (t + 1) * t * (t - 2) / 2 * d[1] + (t + 1) * t * (t - 1) / 6 * d[2];
  }
  return directions;
}

double Lens::least_slope() const {
  double least = 1;
  const double corner = std::hypot(std::max(camera_.cx, camera_.width_px - camera_.cx) / camera_.fx,
                                   std::max(camera_.cy, camera_.height_px - camera_.cy) / camera_.fy);
  Eigen::Vector2d p = Eigen::Vector2d::Zero();
  for (int i = 0; i < 400 && distort(p).norm() < 1.03 * corner; ++i) {
    p += Eigen::Vector2d(0.006, 0.006);
    least = std::min(least, Eigen::Vector2d(slope(p) * Eigen::Vector2d(1, 1) / 2).sum());
    if (least < 0) break;
  }
  return least;
}

}  // namespace aeolian
