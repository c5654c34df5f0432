#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "aeolian_core/surface/pcl_file.hpp"

namespace aeolian {

/// Points in lines of text: columns apart by comma, semicolon or blanks; "#" or "//" starts a comment.
/// The first line may name the columns, also behind a comment sign; x, y, z, x_m, easting, elevation and the
/// like are understood in any order and case. Without names the first three columns count. Empty fields are
/// NaN. Throws Error naming file, line and field.
Coordinates read_cloud_text(const std::string& path);

/// Which columns hold x, y and z, from 0.
using CloudColumns = std::array<std::size_t, 3>;

/// The same from byte `start` of a file whose columns are known.
Coordinates read_cloud_columns(const std::string& path, std::size_t start, const CloudColumns& columns);

}  // namespace aeolian
