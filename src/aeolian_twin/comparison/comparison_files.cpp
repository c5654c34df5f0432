#include <cmath>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/surface/geotiff.hpp"
#include "aeolian_core/twin/difference.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/comparison/compared_surfaces.hpp"
#include "aeolian_twin/comparison/figure_words.hpp"
#include "aeolian_twin/photo/yaml_figures.hpp"

namespace aeolian {
namespace {

void put_lengths(YAML::Emitter& out, const std::string& name, const Figure& figure) {
  put_figure(out, name, "m", figure, 1);
}

void put_angle(YAML::Emitter& out, const std::string& name, const Figure& figure) {
  put_figure(out, name, "deg", figure, radians_to_degrees(1));
}

void begin(YAML::Emitter& out, const std::string& name) {
  out << YAML::Key << name << YAML::Value << YAML::BeginMap;
}

void put_difference(YAML::Emitter& out, const ComparedSurfaces& compared) {
  const SurfaceComparison& c = compared.comparison;
  begin(out, "difference");
  put(out, "sign", "first minus second");
  put(out, "cells", c.difference.cells);
  put_lengths(out, "bias", c.difference.bias);
  put_lengths(out, "rmse", c.difference.rmse);
  put_lengths(out, "nmad", c.difference.nmad);
  put_lengths(out, "le90", c.difference.le90);
  out << YAML::EndMap;
  begin(out, "change");
  put(out, "lod95_from", c.detection);
  put(out, "significant_share", c.significant_share);
  put(out, "significant_cells", c.volume.significant_cells);
  put(out, "cells_that_err_as_one", c.correlation_area);
  put(out, "cells_that_err_as_one_from", c.correlation);
  const char* unit = compared.profile ? "m2" : "m3";  // of a profile for each metre across
  const double factor = compared.profile ? 1 / compared.b.geometry().cell() : 1;
  const std::string what = compared.profile ? "area_" : "volume_";
  put_figure(out, what + "gain", unit, c.volume.gain, factor);
  put_figure(out, what + "loss", unit, c.volume.loss, factor);
  put_figure(out, what + "net", unit, c.volume.net, factor);
  out << YAML::EndMap;
}

void put_pattern(YAML::Emitter& out, const std::string& name, const PatternFigures& pattern) {
  begin(out, name);
  put_lengths(out, "wavelength", pattern.wavelength);
  put_lengths(out, "height", pattern.height);
  put_figure(out, "index", "", pattern.index, 1);
  put_angle(out, "crest_normal", pattern.crest_normal);
  put_lengths(out, "dominant_length", pattern.scales.dominant);
  out << YAML::EndMap;
}

void put_registration(YAML::Emitter& out, const ComparedSurfaces& compared) {
  begin(out, "co_registration");
  put(out, "method", compared.method);
  if (const auto& r = compared.registered) {
    put(out, "stable_ground", compared.stable_ground);
    put(out, "cells", r->cells);
    put(out, "directions_held", r->held);
    put_lengths(out, "moved_east", r->east);
    put_lengths(out, "moved_north", r->north);
    put_lengths(out, "moved_up", r->up);
    put_figure(out, "tilted_east", "mm_per_m", r->tilt_east, 1000);
    put_figure(out, "tilted_north", "mm_per_m", r->tilt_north, 1000);
    put_angle(out, "turned", r->turn);
    put(out, "nmad_before_m", r->nmad_before);
    put(out, "nmad_after_m", r->nmad_after);
  }
  out << YAML::EndMap;
}

void put_migration(YAML::Emitter& out, const ComparedSurfaces& compared) {
  const SurfaceComparison& c = compared.comparison;
  begin(out, "displacement");
  put_lengths(out, "first_from_second", c.offset);
  put(out, "local_median_m", c.crests.median);
  put(out, "local_spread_m", c.crests.spread);
  put(out, "windows", c.crests.displacement.size());
  if (c.skill) {
    put_lengths(out, "first_since_initial", c.skill->migration_a);
    put_lengths(out, "second_since_initial", c.skill->migration_b);
  }
  out << YAML::EndMap;
  if (!c.skill) return;
  begin(out, "skill");
  put(out, "rmse_persistence_m", c.skill->rmse_persistence);
  put(out, "rmse_best_translation_m", c.skill->rmse_translation);
  put_figure(out, "against_persistence", "", c.skill->persistence, 1);
  put_figure(out, "against_best_translation", "", c.skill->translation, 1);
  out << YAML::EndMap;
}

}  // namespace

void write_comparison(const ComparedSurfaces& compared, const std::string& folder) {
  const SurfaceComparison& c = compared.comparison;
  const GridGeometry& grid = compared.b.geometry();
  YAML::Emitter out;
  out.SetDoublePrecision(summary_digits);
  out << YAML::BeginMap;
  put(out, "first", compared.name_a);
  put(out, "second", compared.name_b);
  if (!compared.name_start.empty()) put(out, "initial", compared.name_start);
  put(out, "cell_m", grid.cell());
  out << YAML::Key << "cells" << YAML::Value << YAML::Flow << std::vector<int>{grid.nx(), grid.ny()};
  put(out, "wind_direction_to_deg", radians_to_degrees(compared.direction));
  put(out, "wind_direction_from_deg", meteorological_from_direction(compared.direction));
  out << YAML::Key << "remarks" << YAML::Value << compared.remarks;
  put_registration(out, compared);
  put_difference(out, compared);
  put_pattern(out, "first_pattern", c.a);
  put_pattern(out, "second_pattern", c.b);
  put_migration(out, compared);
  out << YAML::EndMap;
  write_text_atomically(folder + "/comparison.yaml", std::string(out.c_str()) + "\n");

  if (compared.profile)
    write_map_csv(c.map, folder + "/difference.csv");
  else
    write_geotiff(c.map, folder + "/difference.tif", compared.projection);
  write_csv({{"wavelength_m", "coherence", "sigma", "level95"},
             {c.coherence.wavelength, c.coherence.squared, c.coherence.sigma, c.coherence.level95}},
            folder + "/coherence.csv");
  const std::vector<double>& lag = c.b.scales.lag.empty() ? c.a.scales.lag : c.b.scales.lag;
  const auto column = [&](const LineScales& scales) {
    std::vector<double> values = scales.distribution;
    values.resize(lag.size(), NAN);
    return values;
  };
  write_csv({{"lag_m", "first", "second"}, {lag, column(c.a.scales), column(c.b.scales)}},
            folder + "/scales.csv");
}

std::string summary(const ComparedSurfaces& compared) {
  const SurfaceComparison& c = compared.comparison;
  std::string text = fmt::format(
      "bias {}, RMSE {}, NMAD {}, LE90 {}; {:.1f} % of {} cells changed beyond LoD95\n",
      length_words(c.difference.bias), length_words(c.difference.rmse), length_words(c.difference.nmad),
      length_words(c.difference.le90), 100 * c.significant_share, c.difference.cells);
  if (std::isnan(c.a.wavelength.value) && std::isnan(c.b.wavelength.value))
    return text + "no ripples can be told from noise in either\n";
  text += fmt::format("wavelength {} / {}, height {} / {}, pattern of the first {} downwind of the second",
                      length_words(c.a.wavelength), length_words(c.b.wavelength), length_words(c.a.height),
                      length_words(c.b.height), length_words(c.offset));
  if (c.skill)
    text += fmt::format("; skill {} against persistence, {} against best translation",
                        skill_text(c.skill->persistence.value), skill_text(c.skill->translation.value));
  return text + "\n";
}

}  // namespace aeolian
