#include "image_formation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "grain_texture.hpp"
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace aeolian {

namespace {

constexpr double read_noise = 0.0015;  // of white

cv::Mat blurred(const cv::Mat& light, double sigma) {
  if (sigma <= 0) return light;
  cv::Mat result;
  cv::GaussianBlur(light, result, {}, sigma, sigma, cv::BORDER_REPLICATE);
  return result;
}

std::vector<std::uint8_t> srgb_table() {
  std::vector<std::uint8_t> table(65536);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double linear = static_cast<double>(i) / 65535;
    const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    table[i] = static_cast<std::uint8_t>(std::lround(255 * encoded));
  }
  return table;
}

}  // namespace

cv::Mat expose(const ShadowScene& scene, cv::Mat light) {
  static const std::vector<std::uint8_t> encode = srgb_table();
  const cv::Mat centre = blurred(light, scene.blur_px);
  const cv::Mat border =
      scene.blur_border_px == scene.blur_px ? centre : blurred(light, scene.blur_border_px);
  light.release();
  cv::Mat values(centre.size(), CV_8U);
  const double middle_x = (values.cols - 1) / 2.0;
  const double middle_y = (values.rows - 1) / 2.0;
  const double corner2 = middle_x * middle_x + middle_y * middle_y;
  const std::uint64_t seed = GrainTexture::mix(scene.seed ^ 0x6e6f697365ULL);
  cv::parallel_for_({0, values.rows}, [&](const cv::Range& rows) {
    for (int row = rows.start; row < rows.end; ++row) {
      const float* sharp = centre.ptr<float>(row);
      const float* soft = border.ptr<float>(row);
      std::uint8_t* out = values.ptr<std::uint8_t>(row);
      for (int column = 0; column < values.cols; ++column) {
        const double dx = column - middle_x;
        const double dy = row - middle_y;
        const double outwards = (dx * dx + dy * dy) / corner2;
        double value = (1 - outwards) * sharp[column] + outwards * soft[column];
        value *= 1 - scene.vignetting * outwards;
        if (scene.noise > 0) {
          const auto pixel = static_cast<std::uint64_t>(row) << 32U | static_cast<std::uint64_t>(column);
          value += std::sqrt(scene.noise * scene.noise * value + read_noise * read_noise) *
                   GrainTexture::normal(GrainTexture::mix(pixel ^ seed));
        }
        out[column] = encode[static_cast<std::size_t>(std::clamp(value, 0.0, 1.0) * 65535 + 0.5)];
      }
    }
  });
  return values;
}

cv::Mat through_jpeg(const cv::Mat& values, int quality) {
  std::vector<std::uint8_t> file;
  cv::imencode(".jpg", values, file, {cv::IMWRITE_JPEG_QUALITY, quality});
  return cv::imdecode(file, cv::IMREAD_GRAYSCALE);
}

cv::Mat sand_coloured(const cv::Mat& values) {
  // The colour fades towards white, where the largest channel would clip and change the luma.
  cv::Mat blue_share(1, 256, CV_8U);
  cv::Mat red_share(1, 256, CV_8U);
  for (int v = 0; v < 256; ++v) {
    const int colour = std::min(v, (255 - v) * 3);
    blue_share.at<std::uint8_t>(v) = static_cast<std::uint8_t>(128 - colour / 8);
    red_share.at<std::uint8_t>(v) = static_cast<std::uint8_t>(128 + colour / 16);
  }
  cv::Mat red;
  cv::Mat blue;
  cv::LUT(values, red_share, red);
  cv::LUT(values, blue_share, blue);
  cv::Mat picture;
  cv::merge(std::vector<cv::Mat>{values, red, blue}, picture);
  cv::cvtColor(picture, picture, cv::COLOR_YCrCb2BGR);
  return picture;
}

}  // namespace aeolian
