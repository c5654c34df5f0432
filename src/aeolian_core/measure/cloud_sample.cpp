#include "aeolian_core/measure/cloud_sample.hpp"

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {

void require_usable(const PointCloud& cloud, const Eigen::Isometry3d& pose, const std::string& what) {
  if (cloud.y.size() != cloud.size() || cloud.z.size() != cloud.size())
    throw Error(what + ": the cloud has " + std::to_string(cloud.x.size()) + " x, " +
                std::to_string(cloud.y.size()) + " y and " + std::to_string(cloud.z.size()) +
                " z, must be as many of each");
  if (!pose.matrix().allFinite()) throw Error(what + ": the pose of the sensor is not finite");
}

std::vector<Eigen::Vector3d> sample_of(const PointCloud& cloud, const Eigen::Isometry3d& pose,
                                       std::size_t most, const std::string& what,
                                       const std::function<bool(const Eigen::Vector3d&)>& wanted) {
  require_usable(cloud, pose, what);
  const auto point = [&](std::size_t i) -> Eigen::Vector3d { return pose * true_point(cloud, i); };
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = point(i);
    if (p.allFinite() && wanted(p)) found.push_back(i);
  }
  const std::size_t run = (found.size() + most - 1) / most;
  const Philox random(0);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t start = 0; start < found.size(); start += run) {
    const std::size_t length = std::min(run, found.size() - start);
    points.push_back(point(found[start + random(start)[0] % length]));
  }
  return points;
}

Eigen::Vector3d centred(std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) mean += point / static_cast<double>(points.size());
  for (Eigen::Vector3d& point : points) point -= mean;
  return mean;
}

}  // namespace aeolian
