#pragma once

#include <optional>
#include <string>
#include <vector>

#include "aeolian_twin/photo/measured_photo.hpp"

namespace aeolian {

/// Photographs of one section, in order of time when it is known, with what they say together.
struct MeasuredSeries {
  std::vector<MeasuredPhoto> photos;
  std::optional<ProfileSeries> change;  ///< rates and events; needs times
  std::string remark;                   ///< why there is no `change`, or which photos were left out
};

/// Puts the photos in order: by time where two or more have one (the others are left out), else as they come.
/// Fewer than two photos, or sections that do not overlap, leave `change` empty and say so.
MeasuredSeries make_series(std::vector<MeasuredPhoto> photos);

/// Writes a line per photo with its figures, and the rates since the photo before.
void write_series_csv(const MeasuredSeries& series, const std::string& path);

/// Writes the rates over the whole series and its events.
void write_series_summary(const MeasuredSeries& series, const std::string& path);

/// Draws the profiles one over the other, the first at the bottom, and the migration speed below, into an SVG
/// file.
void plot_series(const MeasuredSeries& series, const std::string& path);

/// "downwind", or what stands for it when the wind is not known.
std::string migration_direction(const MeasuredSeries& series);

/// The series in one line: "12 photos, migration 0.31 +- 0.02 mm/s downwind, growth ..., 2 mergers".
std::string in_one_line(const MeasuredSeries& series);

}  // namespace aeolian
