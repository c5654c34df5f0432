#include "aeolian_core/measure/ripple_relief.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "aeolian_core/measure/directional_lines.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// Widths of the kernels in wavelengths; across the crests as noise asks for.
/// @{
constexpr double least_across = 1.0 / 40;
constexpr double most_across = 1.0 / 14;
constexpr double along_share = 1.0 / 5;
/// @}
constexpr double least_width = 0.7;  ///< of a kernel [cells]

/// A layer less its plane of best fit, unknown cells filled.
HeightMap::Layer levelled(const GridGeometry& g, const HeightMap::Layer& elevation) {
  const Plane plane = fit_plane(g, elevation);
  HeightMap::Layer level(elevation.size());
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x) {
      const std::size_t i = g.index(x, y);
      level[i] = static_cast<float>(
          static_cast<double>(elevation[i]) -
          (plane.a + plane.b * (x - 0.5 * (g.nx() - 1)) + plane.c * (y - 0.5 * (g.ny() - 1))));
    }
  return filled(g, level);
}

/// Rows of an image smoothed by local straight lines under a Gaussian, which keep a slope up to the border.
cv::Mat_<float> smoothed_rows(const cv::Mat_<float>& image, double width) {
  const int reach = static_cast<int>(std::ceil(3 * width));
  cv::Mat_<float> result(image.size());
  std::vector<float> weights;
  for (int i = 0; i < image.cols; ++i) {
    const int first = std::max(0, i - reach);
    const int last = std::min(image.cols - 1, i + reach);
    const auto gauss = [&](int j) { return std::exp(-0.5 * (j - i) * (j - i) / (width * width)); };
    double sum = 0;
    double moment = 0;
    double second = 0;
    for (int j = first; j <= last; ++j) {
      sum += gauss(j);
      moment += (j - i) * gauss(j);
      second += (j - i) * (j - i) * gauss(j);
    }
    weights.clear();
    for (int j = first; j <= last; ++j)
      weights.push_back(static_cast<float>(
          first == last ? 1 : gauss(j) * (second - moment * (j - i)) / (sum * second - moment * moment)));
    for (int row = 0; row < image.rows; ++row)
      result(row, i) = std::inner_product(weights.begin(), weights.end(), image[row] + first, 0.0F);
  }
  return result;
}

/// Smoothed over many cells, on an image reduced to what that needs.
cv::Mat smoothed_far(const cv::Mat& image, double width_x, double width_y) {
  const auto reduced = [](int cells, double width) {
    return std::max(1, static_cast<int>(cells / std::max(1.0, width / 6)));
  };
  const cv::Size size(reduced(image.cols, width_x), reduced(image.rows, width_y));
  cv::Mat_<float> small;
  cv::resize(image, small, size, 0, 0, cv::INTER_AREA);
  small = smoothed_rows(small, width_x * size.width / image.cols);
  cv::transpose(small, small);
  small = smoothed_rows(small, width_y * size.height / image.rows);
  cv::transpose(small, small);
  cv::Mat result;
  cv::resize(small, result, image.size(), 0, 0, cv::INTER_CUBIC);
  return result;
}

/// Gaussian of a width in cells, sum 1; of fourth order: without the second moment, so that parabolas stay.
cv::Mat kernel(double width, bool fourth_order) {
  const int reach = static_cast<int>(std::ceil((fourth_order ? 4 : 3) * width));
  cv::Mat_<float> k(2 * reach + 1, 1);
  double sum = 0;
  double second = 0;
  double fourth = 0;
  const auto gauss = [&](int i) { return std::exp(-0.5 * i * i / (width * width)); };
  for (int i = -reach; i <= reach; ++i) {
    sum += gauss(i);
    second += i * i * gauss(i);
    fourth += std::pow(i, 4) * gauss(i);
  }
  for (int i = -reach; i <= reach; ++i)
    k(i + reach) = static_cast<float>(
        gauss(i) * (fourth_order ? (fourth - second * i * i) / (sum * fourth - second * second) : 1 / sum));
  return k;
}

/// Places of the rows about the middle of the map.
void lay_rows(const GridGeometry& g, RippleRelief& relief) {
  const auto snapped = [](double v) { return std::abs(v) < 1e-9 ? 0 : v; };
  const double c = snapped(std::cos(relief.pattern.normal));
  const double s = snapped(std::sin(relief.pattern.normal));
  relief.cell = g.cell();
  relief.along = {c, s};
  relief.left = {-s, c};
  relief.length = std::max(1, static_cast<int>(std::abs(c) * g.nx() + std::abs(s) * g.ny() + 1e-6));
  relief.rows = std::max(1, static_cast<int>(std::abs(s) * g.nx() + std::abs(c) * g.ny() + 1e-6));
  const Eigen::Vector2d middle(g.origin_x() + 0.5 * g.length_x(), g.origin_y() + 0.5 * g.length_y());
  relief.origin =
      middle - 0.5 * g.cell() * ((relief.length - 1) * relief.along + (relief.rows - 1) * relief.left);
}

/// A layer's image along the rows.
cv::Mat turned(const GridGeometry& g, const RippleRelief& relief, const cv::Mat& image, int border) {
  const Eigen::Vector2d start = (relief.origin - Eigen::Vector2d(g.x(0), g.y(0))) / g.cell();
  const cv::Matx23d transform(relief.along.x(), relief.left.x(), start.x(), relief.along.y(), relief.left.y(),
                              start.y());
  cv::Mat result;
  cv::warpAffine(image, result, transform, {relief.length, relief.rows},
                 cv::INTER_CUBIC | cv::WARP_INVERSE_MAP, border, 0);
  return result;
}

}  // namespace

double RippleRelief::clearance_at(const Eigen::Vector2d& p) const {
  const Eigen::Vector2d from = (p - origin) / cell;
  const long sample = std::lround(from.dot(along));
  const long row = std::lround(from.dot(left));
  if (sample < 0 || row < 0 || sample >= length || row >= rows) return 0;
  return static_cast<double>(clearance[index(static_cast<int>(row), static_cast<int>(sample))]);
}

std::optional<RippleRelief> ripple_relief(const GridGeometry& g, const HeightMap::Layer& elevation,
                                          double direction) {
  constexpr double least_known = 0.3;  // share of a kernel's weight
  if (elevation.size() != g.size())
    throw Error("ripple crests: " + std::to_string(elevation.size()) + " heights for " +
                std::to_string(g.size()) + " cells");
  if (!std::isfinite(direction)) throw Error("ripple crests: the direction is not finite");
  const std::size_t known = count_known(elevation);
  const double noise = cell_noise(g, elevation);
  if (known == 0) return std::nullopt;
  HeightMap::Layer level = levelled(g, elevation);
  cv::Mat image(g.ny(), g.nx(), CV_32F, level.data());
  // What is longer than waves that could be told is taken off first: its ends would be seen in every wave.
  image -= smoothed_far(image, g.nx() / 8.0, g.ny() / 8.0);
  const auto pattern = find_pattern(g, level, direction, std::isfinite(noise) ? noise : 0);
  if (!pattern) return std::nullopt;

  RippleRelief relief;
  relief.pattern = *pattern;
  lay_rows(g, relief);
  const double wavelength = pattern->wavelength / g.cell();
  image -= smoothed_far(image, wavelength, wavelength);
  cv::Mat seen(g.ny(), g.nx(), CV_32F);
  std::transform(elevation.begin(), elevation.end(), seen.begin<float>(),
                 [](float h) { return std::isfinite(h) ? 1.0F : 0.0F; });

  const double deviation = cv::norm(image) / std::sqrt(static_cast<double>(g.size()));
  const double noisiness = std::isfinite(noise) && deviation > 0 ? noise / deviation : 0;
  const double across =
      std::max(least_width, std::clamp(noisiness / 2, least_across, most_across) * wavelength);
  const double down = std::max(least_width, along_share * wavelength);
  const cv::Mat sharp = kernel(across, true);
  const cv::Mat wide = kernel(down, false);
  relief.height.resize(static_cast<std::size_t>(relief.rows) * static_cast<std::size_t>(relief.length));
  relief.clearance.resize(relief.height.size());
  cv::Mat height(relief.rows, relief.length, CV_32F, relief.height.data());
  cv::Mat clearance(relief.rows, relief.length, CV_32F, relief.clearance.data());
  cv::sepFilter2D(turned(g, relief, image, cv::BORDER_REPLICATE), height, CV_32F, sharp, wide, {-1, -1}, 0,
                  cv::BORDER_REPLICATE);

  cv::Mat share = turned(g, relief, seen, cv::BORDER_CONSTANT);
  cv::sepFilter2D(share, share, CV_32F, kernel(across, false), wide, {-1, -1}, 0, cv::BORDER_CONSTANT);
  const cv::Mat inside = turned(g, relief, cv::Mat(seen.size(), CV_32F, cv::Scalar(1)), cv::BORDER_CONSTANT);
  // A frame of unseen samples, so that the border counts as such.
  cv::Mat mask;
  cv::copyMakeBorder((share >= least_known) & (inside > 0.5), mask, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  cv::Mat distance;
  cv::distanceTransform(mask, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  clearance = distance(cv::Rect(1, 1, relief.length, relief.rows)) * g.cell();

  const double gain = cv::norm(sharp) * cv::norm(wide);
  const double thinned = std::sqrt(static_cast<double>(g.size()) / static_cast<double>(known));
  relief.noise = std::isfinite(noise) ? noise * gain * thinned : 0;
  return relief;
}

}  // namespace aeolian
