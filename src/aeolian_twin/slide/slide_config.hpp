#pragma once

#include <string>

#include "aeolian_core/slide/piles/slide_scene.hpp"

namespace aeolian {

/// A file of config/slide in numbers.
struct SlideConfig {
  std::string name;
  SlideScene scene;
  int events = 5;
};

/// Reads a scene; its optional key `ground` is a GeoTIFF with a band elevation, beside the file. Throws Error
/// naming file, line, key, value and what is allowed.
SlideConfig read_slide_config(const std::string& file);

}  // namespace aeolian
