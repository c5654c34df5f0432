#pragma once

#include "shadow_scene.hpp"
#include <opencv2/core.hpp>

namespace aeolian {

/// From linear light to 8-bit sRGB values: point spread, vignetting, noise, clipping (no JPEG yet).
/// `light`: CV_32F, 1 is white; used up.
cv::Mat expose(const ShadowScene& scene, cv::Mat light);
/// What a grey JPEG file of that quality keeps of the values.
cv::Mat through_jpeg(const cv::Mat& values, int quality);
/// The values as a sandy colour picture whose luma they are.
cv::Mat sand_coloured(const cv::Mat& values);

}  // namespace aeolian
