#pragma once

#include <string>

#include "aeolian_twin/photo/measured_photo.hpp"

namespace aeolian {

/// Writes the stations: columns x_mm, z_mm, sigma_z_mm, y_mm, terminus_x_px, terminus_y_px, spread_mm.
void write_profile_csv(const ShadowProfile& profile, const std::string& path);

/// Writes the distribution of length scales (eq. 5.2): columns lag_mm, length_scale.
void write_length_scales_csv(const ProfileAnalysis& analysis, const std::string& path);

/// Writes the power spectrum: columns wavenumber_per_mm (cycles), power_mm3.
void write_spectrum_csv(const ProfileAnalysis& analysis, const std::string& path);

/// Writes every figure with its unit in the key, and its standard error under the same key with sigma_ before
/// it.
void write_summary(const MeasuredPhoto& photo, const std::string& setup, const std::string& path);

}  // namespace aeolian
