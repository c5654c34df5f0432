#include "aeolian_twin/nodes/wind_window.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {
namespace {

constexpr double gust_duration = 3;  ///< of the World Meteorological Organization [s]

}  // namespace

void WindWindow::add(double time, const Eigen::Vector2d& velocity) {
  if (!readings_.empty() && time < last()) readings_.clear();
  readings_.push_back({time, velocity});
  while (time - readings_.front().time > length_) readings_.pop_front();
}

Eigen::Vector2d WindWindow::mean(double duration) const {
  Eigen::Vector2d sum = readings_.back().velocity;
  std::size_t count = 1;
  for (auto reading = readings_.rbegin() + 1; reading != readings_.rend(); ++reading) {
    if (last() - reading->time >= duration) break;
    sum += reading->velocity;
    ++count;
  }
  return sum / static_cast<double>(count);
}

GustStatistics WindWindow::statistics() const {
  GustStatistics result;
  result.readings = readings_.size();
  if (readings_.empty()) return result;
  result.duration = last() - readings_.front().time;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Reading& reading : readings_) mean += reading.velocity;
  const auto n = static_cast<double>(readings_.size());
  mean /= n;
  result.speed = mean.norm();
  result.gust = greatest_gust();
  if (!(result.speed > 0)) return result;
  result.direction = std::atan2(mean.y(), mean.x());
  result.gust_ratio = result.gust / result.speed;
  if (readings_.size() < 2) return result;
  const Eigen::Vector2d along = mean / result.speed;
  const Eigen::Vector2d across(-along.y(), along.x());
  Eigen::Vector2d squares = Eigen::Vector2d::Zero();
  for (const Reading& reading : readings_) {
    const Eigen::Vector2d off = reading.velocity - mean;
    squares += Eigen::Vector2d(off.dot(along), off.dot(across)).cwiseAbs2();
  }
  result.deviation_along = std::sqrt(squares.x() / (n - 1));
  result.deviation_across = std::sqrt(squares.y() / (n - 1));
  result.turbulence_intensity = result.deviation_along / result.speed;
  return result;
}

double WindWindow::greatest_gust() const {
  double greatest = 0;
  double sum = 0;
  auto first = readings_.begin();
  for (auto reading = readings_.begin(); reading != readings_.end(); ++reading) {
    sum += reading->velocity.norm();
    for (; reading->time - first->time >= gust_duration; ++first) sum -= first->velocity.norm();
    // Until the first reading is left behind the mean is one of a shorter time, which is more gusty.
    if (first != readings_.begin())
      greatest = std::max(greatest, sum / static_cast<double>(reading - first + 1));
  }
  return first != readings_.begin() ? greatest : sum / static_cast<double>(readings_.size());
}

}  // namespace aeolian
