#include "aeolian_twin/erosion/erosion_files.hpp"

#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"
#include "aeolian_core/wind/direction.hpp"

namespace aeolian {

void write_erosion_history(const ErosionHistory& run, const std::string& folder) {
  Table table{{"t_s", "deviation_m", "wavelength_m", "speed_m_s", "bare_share", "sintered_share",
               "airborne_m3", "volume_error"},
              std::vector<std::vector<double>>(8)};
  for (const ErosionMoment& m : run.moments) {
    const double row[] = {m.time, m.deviation, m.wavelength, m.speed,
                          m.bare, m.sintered,  m.airborne,   m.error};
    for (std::size_t i = 0; i < table.columns.size(); ++i) table.columns[i].push_back(row[i]);
  }
  write_csv(table, folder + "/erosion.csv");
}

void plot_erosion_history(const ErosionHistory& run, const std::string& folder) {
  Curve deviation, wavelength, speed, bare;
  for (const ErosionMoment& m : run.moments) {
    for (Curve* curve : {&deviation, &wavelength, &speed, &bare}) curve->x.push_back(m.time / 60);
    deviation.y.push_back(1000 * m.deviation);
    wavelength.y.push_back(100 * m.wavelength);
    speed.y.push_back(6000 * m.speed);
    bare.y.push_back(100 * m.bare);
  }
  struct Panel {
    const char* name;
    const Curve& curve;
    const char* label;
  };
  const Panel panels[] = {{"deviation", deviation, "std. deviation of the depth [mm]"},
                          {"wavelength", wavelength, "wavelength [cm]"},
                          {"speed", speed, "speed [cm/min]"},
                          {"bare", bare, "bare ground [%]"}};
  std::ostringstream script;
  script << plot_style << "set multiplot layout 4,1\nunset key\nset lmargin 12\n"
         << fmt::format("set xrange [0:{:g}]\n", run.moments.back().time / 60);
  for (const Panel& panel : panels) {
    write_data(script, panel.name, panel.curve);
    script << "set ylabel '" << panel.label << "'\nset yrange [" << (&panel == &panels[2] ? "*:*" : "0:*")
           << "]\n"
           << (&panel == &panels[3] ? "set xlabel 'time [min]'\n" : "unset xlabel\n");
    if (panel.curve.has_value() && (panel.curve.largest() > 0 || &panel == &panels[2]))
      script << "plot $" << panel.name << " using 1:2 with linespoints pt 7 ps 0.4 lw 1.5 lc rgb forecast\n";
    else
      script
          << "set label 1 'none' at graph 0.5, graph 0.5 center\nset yrange [0:1]\nplot 2\nunset label 1\n";
  }
  script << "unset multiplot\n";
  plot_svg(script.str(), 900, 900, folder + "/erosion.svg");
}

void write_erosion_summary(const ErosionHistory& run, const ErosionScene& scene, std::uint64_t seed,
                           const std::string& command, const std::string& folder) {
  const ErosionMoment& last = run.moments.back();
  YAML::Emitter out;
  out << YAML::BeginMap;
  const auto put = [&](const char* key, const auto& value) {
    out << YAML::Key << key << YAML::Value << value;
  };
  put("command", command);
  put("material", scene.snow ? "snow" : "sand");
  put("terrain", scene.terrain);
  put("model", scene.model);
  put("seed", seed);
  put("wind_m_s", scene.wind_speed);
  put("wind_height_m", scene.wind_height);
  put("wind_to_deg_from_east", radians_to_degrees(scene.direction));
  put("wind_from_deg_from_north", meteorological_from_direction(scene.direction));
  put("friction_velocity_m_s", scene.wind().friction_velocity);
  if (scene.snow) put("temperature_c", scene.parameters.snow->temperature);
  put("minutes", scene.minutes);
  if (!scene.expected.empty()) put("expected", scene.expected);
  put("deviation_mm", 1000 * last.deviation);
  put("wavelength_cm", 100 * last.wavelength);
  put("speed_mm_s", 1000 * last.speed);
  put("bare_share", last.bare);
  put("sintered_share", last.sintered);
  put("moved_m3", run.volume.moved);
  put("inflow_m3", run.volume.inflow);
  put("outflow_m3", run.volume.outflow);
  put("airborne_m3", last.airborne);
  put("volume_error", run.volume.error());
  put("parcels_launched", run.counts.launches);
  put("parcel_updates", run.counts.updates);
  put("hops", run.counts.hops);
  put("computing_time_s", run.computing_time);
  out << YAML::EndMap;
  write_text_atomically(folder + "/summary.yaml", std::string(out.c_str()) + "\n");
}

}  // namespace aeolian
