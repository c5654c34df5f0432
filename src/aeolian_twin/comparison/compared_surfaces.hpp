#pragma once

#include <optional>
#include <string>
#include <vector>

#include "aeolian_core/twin/co_registration.hpp"
#include "aeolian_core/twin/surface_comparison.hpp"

namespace aeolian {

/// Two surfaces from files on one grid, compared: what is written and drawn.
struct ComparedSurfaces {
  std::string name_a, name_b;
  std::string name_start;  ///< empty: none
  HeightMap a, b;          ///< `a` as co-registered
  bool profile = false;
  double direction = 0;                    ///< the wind blows to [rad]
  std::string projection;                  ///< for maps written
  std::string method = "none";             ///< of the co-registration
  std::optional<CoRegistered> registered;  ///< its map is `a`
  bool stable_ground = false;              ///< whether a mask was given
  std::vector<std::string> remarks;        ///< what was done to the surfaces, one line each
  SurfaceComparison comparison;
};

/// Writes comparison.yaml (all figures with their units and standard errors), difference.tif (layers
/// difference, lod95, displacement; of profiles difference.csv), coherence.csv and scales.csv into a folder.
void write_comparison(const ComparedSurfaces& compared, const std::string& folder);

/// What is found, in two lines.
std::string summary(const ComparedSurfaces& compared);

/// A picture with the words below it.
struct ComparisonPicture {
  std::string file;  ///< in the folder
  std::string title;
  std::string caption;
  bool wide = false;
};

/// Draws maps (PNG; of profiles a plot), histogram, coherence and length scales (SVG).
std::vector<ComparisonPicture> draw_comparison(const ComparedSurfaces& compared, const std::string& folder);

/// Writes index.html: figures and pictures, self-contained.
void write_comparison_page(const ComparedSurfaces& compared, const std::vector<ComparisonPicture>& pictures,
                           const std::string& folder);

}  // namespace aeolian
