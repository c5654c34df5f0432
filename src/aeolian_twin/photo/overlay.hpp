#pragma once

#include <opencv2/core.hpp>

#include "aeolian_twin/photo/measured_photo.hpp"

namespace aeolian {

/// The photograph (8-bit BGR) with what was found on it: casting edge, band that was searched, the shadow's
/// end with its 95 % interval, crests and troughs, marks, and the main figures in words. At most
/// `widest` pixels wide.
cv::Mat draw_overlay(const cv::Mat& picture, const MeasuredPhoto& photo, int widest = 2400);

}  // namespace aeolian
