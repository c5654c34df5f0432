#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include <aeolian_msgs/AnemometerStatistics.h>
#include <aeolian_msgs/Comparison.h>
#include <aeolian_msgs/GustRecord.h>
#include <aeolian_msgs/LearnedParameters.h>
#include <aeolian_msgs/Profile.h>
#include <aeolian_msgs/WindAhead.h>
#include <aeolian_msgs/WindAtPoints.h>
#include <aeolian_msgs/WindStatistics.h>
#include <grid_map_msgs/GridMap.h>
#include <opencv2/core.hpp>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>

#include "aeolian_core/measure/photo.hpp"
#include "aeolian_core/measure/profile_analysis.hpp"
#include "aeolian_core/measure/shadow_profile.hpp"
#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/point_cloud.hpp"
#include "aeolian_core/twin/comparison.hpp"
#include "aeolian_core/twin/parameter_learner.hpp"
#include "aeolian_core/twin/wind_course.hpp"
#include "aeolian_core/wind/wind_model.hpp"
#include "aeolian_core/wind/wind_probe.hpp"
#include "aeolian_twin/nodes/wind_window.hpp"

/// Between messages and core types: the only place where the two meet. What a message gets wrong is an Error
/// that names the field, its value and what is allowed.
namespace aeolian {

/// A stamp as the core has it, and back.
inline std::chrono::nanoseconds to_stamp(const ros::Time& time) {
  return std::chrono::nanoseconds(static_cast<std::int64_t>(time.toNSec()));
}
inline ros::Time to_time(std::chrono::nanoseconds stamp) {
  return ros::Time().fromNSec(static_cast<std::uint64_t>(stamp.count()));
}

/// The map of all layers. Ours runs from the south-west corner, x fastest; a GridMap from the north-east one,
/// rows (x) fastest: each layer is the other's in reverse. `elevation` is the basic layer when there is one.
grid_map_msgs::GridMap to_message(const HeightMap& map, const std_msgs::Header& header);

/// Only some layers of those that are there, unless none are named. Start indices (of a map that moves with a
/// robot) and both storage orders are honoured. Throws Error for a resolution or length that is not positive
/// and finite, a rotated pose, or a layer that does not fit the map.
HeightMap to_height_map(const grid_map_msgs::GridMap& message, const std::vector<std::string>& only = {});

/// Any order of fields, float32 or float64, either byte order, padded rows. Points that are not finite are
/// kept. The origin is the first finite point in whole metres when a coordinate exceeds 1000 m, else zero.
/// Throws Error for a field x, y or z that is missing or of another type, and for data whose size does not
/// fit. `reused`: a cloud that is no longer needed, whose memory serves for the new one.
PointCloud to_point_cloud(const sensor_msgs::PointCloud2& message, PointCloud reused = {});
/// The same of a message whose data, `size` bytes, stand elsewhere.
PointCloud to_point_cloud(const sensor_msgs::PointCloud2& message, const std::uint8_t* data, std::size_t size,
                          PointCloud reused = {});
/// x, y, z as floats about the cloud's origin, in the cloud's order, in rows of `width` points (0: one row).
/// The header is the caller's.
sensor_msgs::PointCloud2 to_message(const PointCloud& cloud, std::size_t width = 0);

/// The wind at the surface as a map: that of the cells, or a single cell over `extent` when it is the same
/// everywhere. Layers friction_velocity [m/s], direction [rad], air_density [kg/m^3]; of one that varies also
/// those of its cells and speed_up: what the friction velocity has gained over that of the surroundings.
grid_map_msgs::GridMap to_message(const WindField& wind, const GridGeometry& extent,
                                  const std_msgs::Header& header);

/// The mean of the cells outside of separated air, for what takes the wind to be the same everywhere
/// (forecasts, comparisons): friction velocity, direction of the mean vector, air density (1.225 when the
/// layer is absent). `cells` holds the map unless it is a single cell. Throws Error when no cell is known.
WindField to_wind_field(const grid_map_msgs::GridMap& message);

/// What a field is made of, without the anemometers.
aeolian_msgs::WindStatistics to_message(const WindField& wind, const std_msgs::Header& header);
/// What an anemometer says, but for who it is.
aeolian_msgs::AnemometerStatistics to_message(const GustStatistics& statistics);
/// The wind at points, one reading for each.
aeolian_msgs::WindAtPoints to_message(const std::vector<ProbeReading>& readings,
                                      const std::vector<Eigen::Vector3d>& points,
                                      const std_msgs::Header& header);
/// The record and its spectra.
aeolian_msgs::GustRecord to_message(const Gusts& gusts);

/// The wind to come over a bed of that roughness length [m]. Throws Error for lists of different lengths and
/// for what log_law.hpp does not allow.
std::vector<WindSample> to_wind_samples(const aeolian_msgs::WindAhead& message, double roughness);

/// `in_use`: whether forecasts are made with what was learned.
aeolian_msgs::LearnedParameters to_message(const LearnedState& state, const ParameterLearner::Update& update,
                                           bool in_use, const std_msgs::Header& header);

aeolian_msgs::Comparison to_message(const Comparison& comparison, const std_msgs::Header& header,
                                    const ros::Time& issued);
Comparison to_comparison(const aeolian_msgs::Comparison& message);

/// A photograph in grey. Encodings mono8, mono16, bgr8, rgb8, bgra8, rgba8 (alpha is ignored), either byte
/// order, padded rows. Throws Error for another encoding, an image without pixels, and for data whose size
/// does not fit.
Photo to_photo(const sensor_msgs::Image& message);
/// The same image as 8-bit BGR, to be drawn on.
cv::Mat to_picture(const sensor_msgs::Image& message);
/// An 8-bit BGR picture.
sensor_msgs::Image to_message(const cv::Mat& picture, const std_msgs::Header& header);

/// The camera of unrectified images (K and D). Throws Error for one that is not calibrated, has a skew,
/// another model than plumb_bob or rational_polynomial, binning or a region of interest.
CameraModel to_camera_model(const sensor_msgs::CameraInfo& message);

/// `points`: the bed points in the header's frame, or none when the straightedge's pose is not known.
aeolian_msgs::Profile to_message(const ShadowProfile& profile, const ProfileAnalysis& analysis,
                                 const std::vector<Eigen::Vector3d>& points, const std_msgs::Header& header);
/// A point (x, y, z, sigma_z as floats) for each station: z's standard error is a field of its own. Few and
/// near the frame's origin, so that floats hold them.
sensor_msgs::PointCloud2 to_cloud(const std::vector<Eigen::Vector3d>& points,
                                  const std::vector<double>& sigma_z, const std_msgs::Header& header);

}  // namespace aeolian
