#include "aeolian_twin/photo/profile_files.hpp"

#include <cmath>
#include <numeric>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/csv.hpp"
#include "aeolian_twin/photo/figure_units.hpp"
#include "aeolian_twin/photo/yaml_figures.hpp"

namespace aeolian {
namespace {

/// In another unit, rounded far below any error, so that files are not full of digits.
std::vector<double> column(const std::vector<double>& values, double factor) {
  constexpr double steps = 1e5;
  std::vector<double> result;
  result.reserve(values.size());
  for (const double v : values) result.push_back(std::round(v * factor * steps) / steps);
  return result;
}

std::vector<double> pixels(const std::vector<Eigen::Vector2d>& points, Eigen::Index axis) {
  std::vector<double> result;
  result.reserve(points.size());
  for (const Eigen::Vector2d& point : points) result.push_back(point[axis]);
  return column(result, 1);
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The figures that a single ripple and the mean over all have alike.
template <class Figures>
void put_shape(YAML::Emitter& out, const Figures& ripple) {
  put_figure(out, "wavelength", "mm", ripple.wavelength, to_mm);
  put_figure(out, "height", "mm", ripple.height, to_mm);
  put_figure(out, "index", "", ripple.index, 1);
  put_figure(out, "stoss_mean", "deg", ripple.stoss_mean, to_degrees);
  put_figure(out, "stoss_max", "deg", ripple.stoss_max, to_degrees);
  put_figure(out, "lee_mean", "deg", ripple.lee_mean, to_degrees);
  put_figure(out, "lee_max", "deg", ripple.lee_max, to_degrees);
  put_figure(out, "apparent_dip", "deg", ripple.apparent_dip, to_degrees);
}

void put_profile(YAML::Emitter& out, const ShadowProfile& profile) {
  put(out, "points", profile.x.size());
  put(out, "from_x_mm", to_mm * profile.x.front());
  put(out, "to_x_mm", to_mm * profile.x.back());
  put(out, "mean_sigma_z_mm", to_mm * mean(profile.sigma_z));
  put(out, "common_relative_sigma", profile.relative_sigma);
  put(out, "mean_spread_mm", to_mm * mean(profile.spread));
  put(out, "mean_depth_under_edge_mm", to_mm * profile.drop);
  if (profile.grain_diameter > 0) put(out, "grain_diameter_mm", to_mm * profile.grain_diameter);
}

void put_geometry(YAML::Emitter& out, const ShadowProfile& profile) {
  out << YAML::Key << "light" << YAML::Value << YAML::BeginMap;
  put_figure(out, "elevation", "deg", profile.elevation, to_degrees);
  put_figure(out, "azimuth", "deg", profile.azimuth, to_degrees);
  out << YAML::EndMap << YAML::Key << "camera" << YAML::Value << YAML::BeginMap;
  put_figure(out, "scale", "px_per_mm", profile.scale, 1 / to_mm);
  if (profile.pose_rms_px) put(out, "pose_rms_px", *profile.pose_rms_px);
  if (profile.camera_distance) put(out, "distance_mm", to_mm * *profile.camera_distance);
  out << YAML::EndMap;
  put(out, "straightedge_inclination_deg", to_degrees * profile.inclination);
}

void put_ripples(YAML::Emitter& out, const ProfileAnalysis& analysis) {
  out << YAML::Key << "ripples" << YAML::Value << YAML::BeginMap;
  put(out, "count", analysis.ripples.size());
  if (!analysis.ripples.empty()) {
    const std::string side = analysis.downwind > 0 ? "larger x" : "smaller x";
    put(out, "lee_side",
        side + (analysis.downwind_known ? ", as the wind was given" : ", the steeper flanks"));
    put_shape(out, analysis);
  }
  out << YAML::EndMap;
  if (analysis.ripples.empty()) return;
  out << YAML::Key << "each_ripple" << YAML::Value << YAML::BeginSeq;
  for (const ProfileRipple& ripple : analysis.ripples) {
    out << YAML::BeginMap;
    put(out, "start_mm", to_mm * ripple.start);
    put(out, "crest_mm", to_mm * ripple.crest);
    put(out, "end_mm", to_mm * ripple.end);
    put_shape(out, ripple);
    out << YAML::EndMap;
  }
  out << YAML::EndSeq;
}

}  // namespace

void write_profile_csv(const ShadowProfile& profile, const std::string& path) {
  write_csv({{"x_mm", "z_mm", "sigma_z_mm", "y_mm", "terminus_x_px", "terminus_y_px", "spread_mm"},
             {column(profile.x, to_mm), column(profile.z, to_mm), column(profile.sigma_z, to_mm),
              column(profile.y, to_mm), pixels(profile.terminus_px, 0), pixels(profile.terminus_px, 1),
              column(profile.spread, to_mm)}},
            path);
}

void write_length_scales_csv(const ProfileAnalysis& analysis, const std::string& path) {
  write_csv({{"lag_mm", "length_scale"}, {column(analysis.lag, to_mm), column(analysis.length_scale, 1)}},
            path);
}

void write_spectrum_csv(const ProfileAnalysis& analysis, const std::string& path) {
  std::vector<double> wavenumber = analysis.wavenumber;
  std::vector<double> power = analysis.power;
  for (double& k : wavenumber) k /= to_mm;
  for (double& p : power) p *= to_mm * to_mm * to_mm;
  write_csv({{"wavenumber_per_mm", "power_mm3"}, {wavenumber, power}}, path);
}

void write_summary(const MeasuredPhoto& photo, const std::string& setup, const std::string& path) {
  YAML::Emitter out;
  out.SetDoublePrecision(summary_digits);
  out << YAML::BeginMap;
  put(out, "photo", photo.name);
  put(out, "setup", setup);
  put(out, "version", AEOLIAN_VERSION);
  if (photo.time) put(out, "camera_time", utc_text(*photo.time));
  put(out, "mode", photo.profile.mode == ProfileMode::full ? "full" : "overhead");
  put_profile(out, photo.profile);
  put_geometry(out, photo.profile);
  put_figure(out, "roughness", "mm", photo.analysis.roughness, to_mm);
  put_figure(out, "dominant_length", "mm", photo.analysis.dominant_length, to_mm);
  put_figure(out, "spectral_wavelength", "mm", photo.analysis.spectral_wavelength, to_mm);
  put_figure(out, "train_wavelength", "mm", photo.analysis.train_wavelength, to_mm);
  put_ripples(out, photo.analysis);
  put(out, "remarks", photo.profile.remarks);
  out << YAML::EndMap;
  write_text_atomically(path, std::string(out.c_str()) + "\n");
}

}  // namespace aeolian
