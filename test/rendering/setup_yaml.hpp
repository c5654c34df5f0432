#pragma once

#include <string>

#include "aeolian_core/measure/photo_setup.hpp"

namespace aeolian {

/// A setup as the text of a setup file: lengths in millimetres, angles in degrees.
std::string setup_yaml(const PhotoSetup& setup);

}  // namespace aeolian
