#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "aeolian_core/bedforms/height_map/ripple_model.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

const GridGeometry plot(0, 0, 0.002, 150, 40);

Forcing blown() {
  Grain grain;
  grain.diameter = 0.0004;
  return make_forcing(steady_saltation(0.45, grain), 0.3, grain, MeanSplash{});
}

RippleParameters periodic(double step, double error_bound) {
  RippleParameters p;
  p.border = Border::periodic;
  p.step = step;
  p.error_bound = error_bound;
  return p;
}

std::vector<double> ripples() {
  RandomStream random(1, 0);
  std::vector<double> h(plot.size());
  for (double& z : h) z = 3e-4 * random.normal();
  RippleModel(periodic(0.5, 0)).advance(plot, h, blown(), 1200);
  return h;
}

double rms_between(const std::vector<double>& a, const std::vector<double>& b) {
  double square = 0;
  for (std::size_t i = 0; i < a.size(); ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(square / static_cast<double>(a.size()));
}

TEST(RippleStepsTest, error_of_a_minute_stays_below_its_bound) {
  const std::vector<double> start = ripples();
  std::vector<double> truth = start;
  RippleModel(periodic(1.0 / 32, 0)).advance(plot, truth, blown(), 60);
  double before = 1;
  for (const double bound : {1e-4, 3e-5, 1e-5}) {
    std::vector<double> h = start;
    const BedChange change = RippleModel(periodic(1, bound / 60)).advance(plot, h, blown(), 60);
    const double error = rms_between(h, truth);
    EXPECT_LT(error, bound);
    EXPECT_LT(error, before);
    EXPECT_NEAR(change.volume.error(), 0, 1e-12);
    before = error;
  }
}

TEST(RippleStepsTest, a_loose_bound_takes_the_longest_steps) {
  std::vector<double> fixed = ripples();
  std::vector<double> bound = fixed;
  RippleModel(periodic(1, 0)).advance(plot, fixed, blown(), 120);
  RippleModel(periodic(1, 1)).advance(plot, bound, blown(), 120);
  // But for the steps in two halves that tell the error.
  EXPECT_LT(rms_between(fixed, bound), 1e-4);
}

TEST(RippleStepsTest, bounds_hold_on_hard_ground) {
  HeightMap map(plot);
  const std::vector<double> h = ripples();
  map.add(layer::elevation, HeightMap::Layer(h.begin(), h.end()));
  HeightMap::Layer& ground = map.add(layer::ground, -0.002F);
  const HeightMap::Layer floor = ground;
  for (std::size_t i = 0; i < floor.size(); ++i)
    map.layer(layer::elevation)[i] = std::max(map.layer(layer::elevation)[i], floor[i]);
  RippleParameters p;
  p.error_bound = 1e-6;
  EXPECT_NEAR(RippleModel(p).advance(map, blown(), 60).volume.error(), 0, 1e-12);
  for (std::size_t i = 0; i < floor.size(); ++i) ASSERT_GE(map.layer(layer::elevation)[i], floor[i] - 1e-8F);
}

TEST(RippleStepsTest, refuses_bounds_that_are_none) {
  for (const double bound : {-1.0, std::nan("")}) EXPECT_THROW(RippleModel{periodic(1, bound)}, Error);
}

}  // namespace
}  // namespace aeolian
