#pragma once

#include <string>

#include "aeolian_twin/erosion/erosion_history.hpp"
#include "aeolian_twin/erosion/erosion_scene.hpp"

namespace aeolian {

/// Draws a picture of a surface from above, shaded: bare hard ground grey, loose sand ochre or loose snow
/// white, sintered snow blue, with contour lines of the height. PNG, at least 600 pixels wide.
void draw_surface(const HeightMap& map, const Grain& grain, bool snow, const std::string& title,
                  const std::string& path);

/// Writes erosion.csv, one row a moment.
void write_erosion_history(const ErosionHistory& run, const std::string& folder);
/// Draws erosion.svg: standard deviation, wavelength, speed, bare share against time.
void plot_erosion_history(const ErosionHistory& run, const std::string& folder);
/// Writes summary.yaml: the scene, the model and what came out.
void write_erosion_summary(const ErosionHistory& run, const ErosionScene& scene, std::uint64_t seed,
                           const std::string& command, const std::string& folder);

}  // namespace aeolian
