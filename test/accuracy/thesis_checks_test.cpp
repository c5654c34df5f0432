// Werner's own checks of the method (1987, ch. V) on rendered photographs: known objects, one ripple in
// several lights and from several places, the dynamic rig, the post, the two extremes of the terminus.
#include <algorithm>
#include <cmath>

#include "../rendering/laboratory.hpp"
#include "../rendering/ripple_bed.hpp"
#include "../rendering/shadow_score.hpp"
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

constexpr double half_grain = 0.136e-3;

ShadowProfile measured(const SetUp& set_up, ProfileMode mode = ProfileMode::full) {
  return measure_shadow(photograph(set_up.scene), set_up.setup, mode);
}

double interpolated(const ShadowProfile& profile, double x) {
  const auto after = std::lower_bound(profile.x.begin(), profile.x.end(), x);
  if (after == profile.x.begin() || after == profile.x.end()) return NAN;
  const auto i = static_cast<std::size_t>(after - profile.x.begin());
  const double share = (x - profile.x[i - 1]) / (profile.x[i] - profile.x[i - 1]);
  return (1 - share) * profile.z[i - 1] + share * profile.z[i];
}

/// Rms about the mean of the difference of two profiles where both are.
double difference(const ShadowProfile& a, const ShadowProfile& b) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < a.x.size(); ++i) {
    const double other = interpolated(b, a.x[i]);
    if (!std::isnan(other)) differences.push_back(a.z[i] - other);
  }
  double sum = 0;
  double squares = 0;
  for (const double d : differences) sum += d, squares += d * d;
  const auto n = static_cast<double>(differences.size());
  EXPECT_GT(n, 100);
  return std::sqrt(squares / n - sum * sum / n / n);
}

double standard_deviation(const std::vector<double>& values) {
  double sum = 0;
  double squares = 0;
  for (const double v : values) sum += v, squares += v * v;
  const auto n = static_cast<double>(values.size());
  return std::sqrt(squares / n - sum * sum / n / n);
}

/// The slab of stone: ripples of 4 cm, 3 mm high.
Laboratory stone_ripples() {
  RippleBed bed;
  bed.height = -0.008;
  bed.wavelength = 0.04;
  bed.relief = 0.003;
  bed.phase = 1;
  Laboratory laboratory;
  laboratory.bed = bed;
  return laboratory;
}

// Row 1. The cylinder lies under 1 mm of clearance; its flanks are compared to 30 degrees of slope.
TEST(ThesisChecks, HalfCylinder) {
  constexpr double radius = 0.01;
  Laboratory laboratory;
  laboratory.bed = [](double x, double) {
    return -0.011 + std::sqrt(std::max(0.0, radius * radius - x * x));
  };
  laboratory.pixels_per_metre = 45e3;
  laboratory.elevation = 45 * degree;
  std::vector<double> places;
  for (double x = -0.5 * radius; x <= 0.5 * radius; x += 0.2e-3) places.push_back(x);
  std::vector<double> mean(places.size(), 0.0);
  constexpr int renders = 20;
  for (int i = 0; i < renders; ++i) {
    laboratory.seed = static_cast<std::uint64_t>(i + 1);
    const ShadowProfile profile = measured(set_up_of(laboratory));
    std::vector<double> errors;
    for (std::size_t k = 0; k < places.size(); ++k) {
      errors.push_back(interpolated(profile, places[k]) - laboratory.bed(places[k], 0));
      mean[k] += errors.back() / renders;
    }
    EXPECT_LT(standard_deviation(errors), half_grain) << "render " << i;
  }
  EXPECT_LT(standard_deviation(mean), half_grain / 2);
}

TEST(ThesisChecks, StoneRipples) {
  const auto set_up = set_up_of(stone_ripples());
  EXPECT_LT(score(set_up, measured(set_up)).rmse, half_grain);
}

// Row 2.
TEST(ThesisChecks, LightFrom26To53Degrees) {
  std::vector<ShadowProfile> profiles;
  for (const double elevation : {26.0, 40.0, 53.0}) {
    Laboratory laboratory = stone_ripples();
    laboratory.elevation = elevation * degree;
    laboratory.seed = profiles.size() + 1;
    profiles.push_back(measured(set_up_of(laboratory)));
  }
  EXPECT_LT(difference(profiles[0], profiles[1]), half_grain);
  EXPECT_LT(difference(profiles[0], profiles[2]), half_grain);
  EXPECT_LT(difference(profiles[1], profiles[2]), half_grain);
}

struct Place {
  double azimuth, inclination, off_nadir, distance;  // [degrees], [m]
};
class FromAnyPlace : public testing::TestWithParam<Place> {};

// Row 3. The bed is parallel to the straightedge, as on a dune's flank.
TEST_P(FromAnyPlace, TheProfileIsTheSame) {
  const Place place = GetParam();
  Laboratory laboratory = stone_ripples();
  laboratory.azimuth = place.azimuth * degree;
  laboratory.inclination = place.inclination * degree;
  laboratory.off_nadir = place.off_nadir * degree;
  laboratory.camera_distance = place.distance;
  laboratory.bed = [flat = laboratory.bed, rise = std::tan(laboratory.inclination)](double x, double y) {
    return flat(x, y) + rise * x;
  };
  const auto set_up = set_up_of(laboratory);
  const ShadowProfile profile = measured(set_up);
  EXPECT_LT(score(set_up, profile).rmse, half_grain);
  // Trough to trough, horizontally; the analysis measures along the slope.
  const auto analysis = analyse(profile);
  ASSERT_GE(analysis.ripples.size(), 1u);
  const double along = 0.04 / std::cos(laboratory.inclination);
  EXPECT_NEAR(analysis.wavelength.value / along, 1, std::max(0.003, 3 * analysis.wavelength.sigma / along));
}
INSTANTIATE_TEST_SUITE_P(Thesis, FromAnyPlace,
                         testing::Values(Place{0, 0, 0, 1}, Place{20, 0, 0, 1}, Place{40, 0, 0, 1},
                                         Place{-40, 0, 0, 1}, Place{0, 10, 0, 1}, Place{0, -10, 0, 1},
                                         Place{0, 0, 25, 1}, Place{0, 0, -25, 1}, Place{0, 0, 0, 0.6},
                                         Place{0, 0, 0, 2}, Place{40, 10, 25, 0.6}, Place{-40, -10, 25, 2}));

/// The edge 10 cm over low ripples, its camera straight above it.
Laboratory dynamic_rig(double camera_height) {
  RippleBed bed;
  bed.height = -0.1;
  bed.wavelength = 0.06;
  bed.relief = 0.004;
  Laboratory laboratory;
  laboratory.bed = bed;
  laboratory.elevation = 50 * degree;
  laboratory.camera_distance = camera_height;
  laboratory.pixels_per_metre = 4500;
  return laboratory;
}

/// Grains in flight: bright streaks along the wind.
void add_streaks(Photo* photo) {
  cv::Mat picture(photo->height_px, photo->width_px, CV_8U, photo->values8.data());
  RandomStream random(5, 0);
  for (int i = 0; i < 400; ++i) {
    const cv::Point2d from(random.uniform() * picture.cols, random.uniform() * picture.rows);
    const cv::Point2d to = from + cv::Point2d(10 + 40 * random.uniform(), 6 * random.normal());
    cv::line(picture, from, to, 150 + 80 * random.uniform(), 1, cv::LINE_AA);
  }
}

class DynamicRig : public testing::TestWithParam<double> {};

// Row 4: half a millimetre under streaks and a penumbra of 2 mm.
TEST_P(DynamicRig, FullModeIsGoodToHalfAMillimetre) {
  const auto set_up = set_up_of(dynamic_rig(GetParam()));
  Photo photo = photograph(set_up.scene);
  add_streaks(&photo);
  EXPECT_LT(score(set_up, measure_shadow(photo, set_up.setup, ProfileMode::full)).rmse, 0.5e-3);
}

// Row 4 and the table of section 2.2: what a plan view leaves out makes ripples 1/(1 + drop/height) as long
// and the square of that as high.
TEST_P(DynamicRig, OverheadModeFailsAsPredicted) {
  const auto set_up = set_up_of(dynamic_rig(GetParam()));
  const Photo photo = photograph(set_up.scene);
  const PhotoSetup& setup = set_up.setup;
  const auto full = analyse(measure_shadow(photo, setup, ProfileMode::full));
  const auto overhead = analyse(measure_shadow(photo, setup, ProfileMode::overhead));
  const double shrink = 1 / (1 + 0.1 / GetParam());
  // The table is for a camera straight above the edge; this one stands beside it, over the picture's middle.
  const double camera_y = set_up.scene.level_to_camera.inverse().translation().y();
  const double beside = 1 + camera_y * std::tan(set_up.scene.elevation) / GetParam();
  EXPECT_NEAR(overhead.spectral_wavelength.value / full.spectral_wavelength.value, shrink, 0.01);
  EXPECT_NEAR(overhead.roughness.value / full.roughness.value, shrink * shrink * beside, 0.01);
}
INSTANTIATE_TEST_SUITE_P(Thesis, DynamicRig, testing::Values(0.6, 1.0, 2.0));

// Row 5, the post turned out of the light so that its shadow does not cover the bed whose height counts.
TEST(ThesisChecks, APostTellsTheLight) {
  for (const std::uint64_t seed : {1, 2, 4, 5}) {
    Laboratory laboratory = stone_ripples();
    laboratory.seed = seed;
    laboratory.azimuth = (static_cast<double>(seed) - 3) * 8 * degree;
    auto set_up = set_up_of(laboratory);
    ShadowScene& scene = set_up.scene;
    scene.post_height = 0.03;
    scene.post_x = 0.01 * (static_cast<double>(seed) - 3);
    RandomStream random(seed, 1);
    const auto read = [&random](Eigen::Vector2d pixel) {  // as a careful person does
      pixel.x() += 0.3 * random.normal();
      pixel.y() += 0.3 * random.normal();
      return pixel;
    };
    set_up.setup.light = PhotoSetup::Post{0.03, read(true_pixel(scene, {scene.post_x, 0, 0})),
                                          read(true_pixel(scene, true_tip_shadow(scene)))};
    const ShadowProfile profile = measured(set_up);
    EXPECT_NEAR(profile.elevation.value, scene.elevation, 0.1 * degree) << "seed " << seed;
    EXPECT_NEAR(profile.azimuth.value, scene.azimuth, 0.2 * degree) << "seed " << seed;
  }
}

// Row 6.
TEST(ThesisChecks, UpperAndLowerTerminusAreHalfAGrainApart) {
  const ShadowProfile profile = measured(set_up_of(stone_ripples()));
  const double spread = quantile(profile.spread, 0.5);
  EXPECT_GT(spread, 0);
  EXPECT_LE(spread, half_grain);
}

}  // namespace
}  // namespace aeolian
