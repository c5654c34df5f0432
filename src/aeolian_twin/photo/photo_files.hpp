#pragma once

#include <string>
#include <vector>

namespace aeolian {

/// Photographs to be measured, as a command line names them.
struct PhotoFiles {
  std::string folder;              ///< that they are all photos of; empty for a single photo
  std::vector<std::string> files;  ///< in order of their names
};

/// The photos of each argument: a file, or a folder with JPEG, PNG and TIFF files (overlays of earlier runs
/// are none). Throws Error for a folder without any, and when two would write the same files: those beside
/// the photo, or in `out` when it is not empty, start with the photo's name without its extension.
std::vector<PhotoFiles> list_photos(const std::vector<std::string>& arguments, const std::string& out);

/// Where the files about a photo go, up to the underscore.
std::string output_stem(const std::string& photo, const std::string& out);

}  // namespace aeolian
