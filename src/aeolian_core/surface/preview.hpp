#pragma once

#include <string>

#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/shading.hpp"

namespace aeolian {

struct PreviewOptions {
  std::string layer = layer::elevation;
  std::string title;  ///< drawn above the map when not empty
  Palette palette = Palette::sand;
  ValueRange range;         ///< low == high: display_range of the layer
  bool relief = true;       ///< hill shading by the layer itself
  double exaggeration = 2;  ///< of the heights, for the shading
  int width_px = 900;       ///< of the map in the picture; small maps are enlarged by whole factors
};

/// Draws a layer, north up, with hill shading, a scale bar of a round length, and a colour bar with its
/// values in millimetres, metres or the plain unit as fits, and writes it as PNG, atomically. Unknown cells
/// are hatched grey. Throws Error naming the layer or the file.
void write_preview(const HeightMap& map, const std::string& path, const PreviewOptions& options = {});

}  // namespace aeolian
