#include "aeolian_twin/slide/slide_files.hpp"

#include <cmath>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/surface/geotiff.hpp"

namespace aeolian {
namespace {

struct Figure {
  const char* name;
  double value;
};

template <int Dim>
std::vector<Figure> figures(const KeptEvent<Dim>& kept) {
  const SlideEvent<Dim>& e = kept.event;
  return {{"event", static_cast<double>(e.number)},
          {"height_m", e.pile.height},
          {"length_m", e.pile.length},
          {"height_over_length", e.pile.shape()},
          {"head_m", e.pile.head},
          {"tail_m", e.pile.tail},
          {"raw_length_m", e.pile.raw_length},
          {Dim == 2 ? "mass_kg_m" : "mass_kg", e.mass},
          {Dim == 2 ? "left_on_panel_kg_m" : "left_on_panel_kg", e.left_behind},
          {"density_kg_m3", e.density},
          {"fastest_m_s", e.fastest},
          {"duration_s", e.duration},
          {"at_rest", e.still ? 1. : 0.},
          {"steps", static_cast<double>(e.work.steps)},
          {"particle_steps", static_cast<double>(e.work.particle_steps)}};
}

std::string comment_of(const std::string& command) {
  return "slide_snow of aeolian_twin " AEOLIAN_VERSION ": " + command;
}

}  // namespace

template <int Dim>
void write_events(const SlideConfig& config, const std::vector<KeptEvent<Dim>>& events,
                  const std::string& command, const std::string& folder) {
  Table table;
  YAML::Emitter yaml;
  const SlideScene& s = config.scene;
  yaml << YAML::Comment(comment_of(command)) << YAML::BeginMap << YAML::Key << "name" << YAML::Value
       << config.name << YAML::Key << "dimensions" << YAML::Value << Dim << YAML::Key << "seed" << YAML::Value
       << s.seed << YAML::Key << "cell_m" << YAML::Value << s.cell << YAML::Key << "tilt_deg" << YAML::Value
       << s.tilt * 180 / M_PI << YAML::Key << "panel_friction" << YAML::Value << s.panel_friction << YAML::Key
       << "invariants" << YAML::Value << "q = sqrt(3/2 s:s), p = -tr(tau)/d" << YAML::Key << "events"
       << YAML::Value << YAML::BeginSeq;
  for (const KeptEvent<Dim>& event : events) {
    yaml << YAML::Flow << YAML::BeginMap;
    const auto row = figures(event);
    if (table.names.empty())
      for (const Figure& figure : row) {
        table.names.emplace_back(figure.name);
        table.columns.emplace_back();
      }
    for (std::size_t k = 0; k < row.size(); ++k) {
      table.columns[k].push_back(row[k].value);
      yaml << YAML::Key << row[k].name << YAML::Value << row[k].value;
    }
    yaml << YAML::EndMap;
  }
  yaml << YAML::EndSeq << YAML::EndMap;
  write_csv(table, folder + "/events.csv", comment_of(command));
  write_text_atomically(folder + "/events.yaml", std::string(yaml.c_str()) + "\n");
}

template <int Dim>
void write_snow(const SlideConfig& config, const SlideEvent<Dim>& event, const std::string& folder) {
  Table table;
  table.names =
      Dim == 2 ? std::vector<std::string>{"x_m", "z_m"} : std::vector<std::string>{"x_m", "y_m", "z_m"};
  for (const char* name : {"p0_pa", "mass_kg"}) table.names.emplace_back(name);
  table.columns.resize(table.names.size());
  for (const auto& p : event.snow) {
    for (int d = 0; d < Dim; ++d) table.columns[static_cast<std::size_t>(d)].push_back(p.place[d]);
    table.columns[Dim].push_back(config.scene.snow.consolidation_at(p.alpha));
    table.columns[Dim + 1].push_back(p.mass);
  }
  write_csv(table, fmt::format("{}/particles_{:02}.csv", folder, event.number));
  const HeightMap map = pile_map<Dim>(config.scene, event.snow, config.scene.cell);
  if constexpr (Dim == 3)
    write_geotiff(map, fmt::format("{}/pile_{:02}.tif", folder, event.number));
  else
    write_map_csv(map, fmt::format("{}/pile_{:02}.csv", folder, event.number));
}

template void write_events(const SlideConfig&, const std::vector<KeptEvent<2>>&, const std::string&,
                           const std::string&);
template void write_events(const SlideConfig&, const std::vector<KeptEvent<3>>&, const std::string&,
                           const std::string&);
template void write_snow(const SlideConfig&, const SlideEvent<2>&, const std::string&);
template void write_snow(const SlideConfig&, const SlideEvent<3>&, const std::string&);

}  // namespace aeolian
