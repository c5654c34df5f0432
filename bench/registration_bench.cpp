// Laying a depth image of 307 200 points onto a map of 1000 x 1000 cells of 2 mm with winding ripples of 10
// cm, both with 1 mm of noise per point, from 8 mm and half a degree beside. The argument is how many of the
// points are used.
//
// `shift_um`, `lift_um`, `turn_mdeg`: what is left of the misalignment in the middle, sideways and upwards,
// and of the turn, root mean square over five images. `best_shift_um`: the least that the noise of so many
// points allows sideways on a perfect map (Cramer and Rao); the map's own noise comes on top.

#include <cmath>

#include <Eigen/Cholesky>
#include <benchmark/benchmark.h>

#include "aeolian_core/measure/registration.hpp"
#include "aeolian_core/surface/random.hpp"

namespace {

using aeolian::HeightMap;
using aeolian::PointCloud;
using aeolian::RegistrationMethod;

constexpr double noise = 0.001;
constexpr double height_of_sensor = 1.2;
constexpr int images = 5;

/// Height, and its gradient.
Eigen::Vector3d bed(double x, double y) {
  constexpr double amplitude = 0.004;
  const double k = 2 * M_PI / 0.1;
  const double l = 2 * M_PI / 0.3;
  const double phase = k * x + 1.5 * std::sin(l * y);
  return {amplitude * std::sin(phase), amplitude * k * std::cos(phase),
          amplitude * std::cos(phase) * 1.5 * l * std::cos(l * y)};
}

/// As if each cell had seen four points.
HeightMap noisy_map() {
  HeightMap map(aeolian::GridGeometry(-1, -1, 0.002, 1000, 1000));
  HeightMap::Layer& elevation = map.add(aeolian::layer::elevation);
  aeolian::RandomStream random(1, 0);
  for (std::size_t i = 0; i < elevation.size(); ++i) {
    const auto c = map.geometry().cell_at(i);
    elevation[i] = static_cast<float>(bed(map.geometry().x(c.x), map.geometry().y(c.y))[0] +
                                      noise / 2 * random.normal());
  }
  return map;
}

Eigen::Isometry3d sensor() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().z() = height_of_sensor;
  pose.linear() = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
  return pose;
}

PointCloud depth_image(std::uint64_t number) {
  aeolian::RandomStream random(2, number);
  const Eigen::Isometry3d to_sensor = sensor().inverse();
  PointCloud cloud;
  for (int v = 0; v < 480; ++v)
    for (int u = 0; u < 640; ++u) {
      const double x = 1.6 * ((u + random.uniform()) / 640 - 0.5);
      const double y = 1.2 * ((v + random.uniform()) / 480 - 0.5);
      const Eigen::Vector3f p =
          (to_sensor * Eigen::Vector3d(x, y, bed(x, y)[0] + noise * random.normal())).cast<float>();
      cloud.push_back(p.x(), p.y(), p.z());
    }
  return cloud;
}

double best_shift(std::int64_t points) {
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  aeolian::RandomStream random(3, 0);
  constexpr int samples = 20000;
  for (int i = 0; i < samples; ++i) {
    const double x = 1.6 * (random.uniform() - 0.5);
    const double y = 1.2 * (random.uniform() - 0.5);
    const Eigen::Vector3d h = bed(x, y);
    const Eigen::Vector3d upward(-h[1], -h[2], 1);
    Eigen::Matrix<double, 6, 1> row;
    row << upward, Eigen::Vector3d(x, y, h[0]).cross(upward);
    information += static_cast<double>(points) / samples / (noise * noise) * row * row.transpose();
  }
  const Eigen::Matrix<double, 6, 6> covariance = information.inverse();
  return std::sqrt(covariance(0, 0) + covariance(1, 1));
}

void lay_onto_map(benchmark::State& state, RegistrationMethod method) {
  const HeightMap map = noisy_map();
  std::vector<PointCloud> clouds;
  for (std::uint64_t i = 0; i < images; ++i) clouds.push_back(depth_image(i));
  aeolian::RegistrationParameters parameters;
  parameters.method = method;
  parameters.max_points = static_cast<std::size_t>(state.range(0));
  const Eigen::Isometry3d beside =
      Eigen::Translation3d(0.005, -0.004, 0.005) *
      Eigen::AngleAxisd(0.5 * M_PI / 180, Eigen::Vector3d(1, -1, 1).normalized()) * sensor();
  double shift = 0;
  double lift = 0;
  double turn = 0;
  int accepted = 0;
  for (const PointCloud& cloud : clouds) {
    const auto result = aeolian::register_cloud(cloud, beside, map, parameters);
    const Eigen::Isometry3d rest = result.pose * sensor().inverse();
    shift += rest.translation().head<2>().squaredNorm() / images;
    lift += std::pow(rest.translation().z(), 2) / images;
    turn += std::pow(Eigen::AngleAxisd(rest.linear()).angle(), 2) / images;
    accepted += result.accepted ? 1 : 0;
  }
  std::size_t number = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(aeolian::register_cloud(clouds[number++ % images], beside, map, parameters));
  state.counters["accepted_of_5"] = accepted;
  state.counters["shift_um"] = 1e6 * std::sqrt(shift);
  state.counters["best_shift_um"] = 1e6 * best_shift(state.range(0));
  state.counters["lift_um"] = 1e6 * std::sqrt(lift);
  state.counters["turn_mdeg"] = 1e3 * 180 / M_PI * std::sqrt(turn);
}

void BM_Icp(benchmark::State& state) { lay_onto_map(state, RegistrationMethod::icp); }
void BM_Ndt(benchmark::State& state) { lay_onto_map(state, RegistrationMethod::ndt); }
BENCHMARK(BM_Icp)->Arg(1000)->Arg(5000)->Arg(20000)->Arg(80000)->Arg(307200)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Ndt)->Arg(1000)->Arg(5000)->Arg(20000)->Unit(benchmark::kMillisecond);

}  // namespace
