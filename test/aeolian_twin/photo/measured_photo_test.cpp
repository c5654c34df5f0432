#include "aeolian_twin/photo/measured_photo.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "aeolian_twin/photo/figure_text.hpp"
#include "aeolian_twin/photo/overlay.hpp"
#include "aeolian_twin/photo/series.hpp"

namespace aeolian {
namespace {

/// Ripples of 40 mm and 3 mm on a photo of 10 px/mm, the edge along row 100, its shadow below.
MeasuredPhoto rippled(double offset, std::optional<double> time) {
  MeasuredPhoto photo{"ripples.jpg", time, {}, {}};
  ShadowProfile& profile = photo.profile;
  for (double x = 0; x < 0.2; x += 0.0003) {
    const double z = 0.0015 * std::sin(2 * M_PI * (x - offset) / 0.04);
    profile.x.push_back(x);
    profile.z.push_back(z);
    profile.sigma_z.push_back(2e-5);
    profile.y.push_back(0.02 - z);
    profile.spread.push_back(1e-4);
    profile.terminus_px.emplace_back(1e4 * x, 100 + 1e4 * (0.02 - z));
  }
  profile.edge_px = {{0, 100}, {2000, 100}};
  profile.elevation = {M_PI / 4, 0.002};
  profile.scale = {1e4, 10};
  profile.drop = 0.02;
  profile.downwind = 1;
  photo.analysis = analyse(profile);
  return photo;
}

TEST(FigureText, DigitsFollowTheError) {
  EXPECT_EQ(stated({0.0727123, 0.000412}, 1e3), "72.7 +- 0.4");
  EXPECT_EQ(stated({0.0727123, 0.000112}, 1e3), "72.71 +- 0.11");
  EXPECT_EQ(stated({0.0727123, 0.000098}, 1e3), "72.71 +- 0.10");
  EXPECT_EQ(stated({14.82, 3.2}, 1), "15 +- 3");
  EXPECT_EQ(stated({1482, 32}, 1), "1482 +- 32");
  EXPECT_EQ(stated({-0.5, 0.03}, 1, "±"), "-0.50 ± 0.03");
  EXPECT_EQ(stated({0.25, 0}, 1), "0.25");
  EXPECT_EQ(stated({0.25, NAN}, 1), "0.25");
}

TEST(MeasuredPhoto, PlacesAlongTheHorizontalOfAnInclinedStraightedge) {
  // A level bed 50 mm under the origin of an edge inclined by 10 degrees: bed points square below it.
  const double inclination = 10 * M_PI / 180;
  ShadowProfile profile;
  profile.inclination = inclination;
  double edge = 0;
  for (const double across : {0.0, 0.1, 0.2, 0.3}) {
    // The point (across, -0.05) of the level frame, in that of the edge.
    profile.x.push_back(across * std::cos(inclination) - 0.05 * std::sin(inclination));
    profile.y.push_back(-0.03);
    profile.z.push_back(0);
    edge += profile.x.back() * std::sin(inclination) / 4;
  }
  profile.drop = edge + 0.05;
  const std::vector<double> places = horizontal_places(profile);
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_NEAR(places[i], 0.1 * static_cast<double>(i), 1e-12);
}

TEST(MeasuredPhoto, HeightsBetweenTheSamples) {
  const EvenProfile even{0.1, 0.01, {1, 2, 4}, {}};
  EXPECT_NEAR(height_at(even, 0.1), 1, 1e-9);
  EXPECT_NEAR(height_at(even, 0.115), 3, 1e-9);
  EXPECT_NEAR(height_at(even, 0.12), 4, 1e-9);
  EXPECT_NEAR(height_at(even, 0.5), 4, 1e-9);
}

TEST(Overlay, DrawsTheShadowsEndWhereItWasFound) {
  const cv::Mat sand(1200, 2000, CV_8UC3, cv::Scalar(120, 150, 170));
  const MeasuredPhoto photo = rippled(0, {});
  const cv::Mat overlay = draw_overlay(sand, photo);
  EXPECT_EQ(overlay.size(), sand.size());
  int drawn = 0;
  for (const Eigen::Vector2d& point : photo.profile.terminus_px) {
    const auto& pixel =
        overlay.at<cv::Vec3b>(static_cast<int>(point.y() + 0.5), static_cast<int>(point.x() + 0.5));
    drawn += pixel[2] > 200 && pixel[1] < 110 ? 1 : 0;
  }
  EXPECT_GT(drawn, 0.8 * static_cast<double>(photo.profile.terminus_px.size()));  // crest marks lie over some
  const cv::Vec3b untouched = overlay.at<cv::Vec3b>(700, 1900);
  EXPECT_EQ(untouched, (cv::Vec3b{120, 150, 170}));
}

TEST(Overlay, LargePhotosAreMadeSmaller) {
  const cv::Mat sand(3000, 5000, CV_8UC3, cv::Scalar(120, 150, 170));
  EXPECT_EQ(draw_overlay(sand, rippled(0, {})).size(), cv::Size(2400, 1440));
}

TEST(Series, IsOrderedByTimeAndLeavesPhotosWithoutOneOut) {
  const MeasuredSeries series =
      make_series({rippled(0.004, 1060.0), rippled(0.2, {}), rippled(0.002, 1030.0), rippled(0.000, 1000.0)});
  ASSERT_EQ(series.photos.size(), 3U);
  EXPECT_EQ(series.photos[0].time.value(), 1000);
  EXPECT_EQ(series.photos[2].time.value(), 1060);
  EXPECT_EQ(series.remark, "1 photo without a camera time left out");
  ASSERT_TRUE(series.change);
  EXPECT_NEAR(series.change->migration.value, 0.004 / 60, 0.004 / 60 * 0.02);
}

TEST(Series, PhotosOfOneSecondHaveNoRates) {
  const MeasuredSeries series = make_series({rippled(0, 1000.0), rippled(0.002, 1000.0)});
  EXPECT_FALSE(series.change);
  EXPECT_EQ(series.remark.find("no rates: "), 0U) << series.remark;
  EXPECT_EQ(series.photos.size(), 2U);
}

}  // namespace
}  // namespace aeolian
