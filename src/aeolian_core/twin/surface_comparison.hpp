#pragma once

#include <optional>
#include <string>

#include "aeolian_core/measure/shadow_profile.hpp"
#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/twin/coherence.hpp"
#include "aeolian_core/twin/crest_displacement.hpp"
#include "aeolian_core/twin/difference_figures.hpp"
#include "aeolian_core/twin/line_scales.hpp"
#include "aeolian_core/twin/volume_change.hpp"

namespace aeolian {

/// What is known beside the surfaces.
struct ComparisonSettings {
  double direction = 0;  ///< the wind blows to, counter-clockwise from east [rad]
  /// Standard deviation of the heights [m] of a surface that has no layer `variance`.
  std::optional<double> sigma_a, sigma_b;
  /// Ground that did not change: cells above 0.5 of a layer of the same grid; null: not known.
  const HeightMap::Layer* stable = nullptr;
  double common_sigma = 0;  ///< of a height error that all cells share, as co-registration leaves it [m]
};

/// The pattern of a surface along the wind; NaN where no ripples can be told from noise.
struct PatternFigures {
  Figure wavelength;    ///< as ripple_statistics has it [m]
  Figure height;        ///< 2 sqrt(2) standard deviations of the detrended surface [m]
  Figure index;         ///< wavelength / height
  Figure crest_normal;  ///< counter-clockwise from east, about where the wind blows to [rad]
  LineScales scales;    ///< eq. 5.2
};

/// The first surface as a forecast of the second, from the one in which it started.
struct ForecastSkill {
  Figure migration_a;           ///< of the patterns since the start, downwind [m]
  Figure migration_b;           ///< [m]
  double rmse_persistence = 0;  ///< error of "nothing changes" [m]
  double rmse_translation = 0;  ///< of the best pure translation, with hindsight [m]
  Figure persistence;           ///< 1 - rmse^2 / rmse_persistence^2
  Figure translation;
};

/// How a surface a differs from a surface b; differences are a minus b. Every figure with its standard error,
/// NaN where it cannot be had.
struct SurfaceComparison {
  HeightMap map;  ///< layers difference, lod95, displacement [m]
  DifferenceFigures difference;
  std::string detection;        ///< what lod95 rests on
  double correlation_area = 1;  ///< how many cells err as one
  std::string correlation;      ///< where that was seen
  VolumeChange volume;
  double significant_share = 0;  ///< of the known cells
  PatternFigures a, b;
  Figure offset;             ///< of a's pattern from b's, downwind positive, within half a wavelength [m]
  CrestDisplacement crests;  ///< the same place by place
  Coherence coherence;
  std::optional<ForecastSkill> skill;
};

/// Compares two elevations of the same grid, over the cells known in both (and in the start). A surface
/// against itself gives differences, volumes and displacements of exactly zero and a coherence of exactly 1.
/// Throws Error for another grid, fewer than 16 common cells, a direction or sigma that cannot be.
SurfaceComparison compare_surfaces(const HeightMap& a, const HeightMap& b, const HeightMap* start,
                                   const ComparisonSettings& settings);

}  // namespace aeolian
