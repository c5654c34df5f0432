#include <algorithm>
#include <cmath>
#include <sstream>

#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"
#include "aeolian_core/twin/report_plots.hpp"
#include "aeolian_core/twin/report_text.hpp"

namespace aeolian {

void plot_skill(const std::vector<LeadSummary>& leads, const std::string& path) {
  const Unit time = time_unit(leads.back().lead_time);
  const auto curve_of = [&](double Comparison::*number, double factor) {
    Curve curve;
    for (const LeadSummary& lead : leads) {
      const Spread spread = lead.spread(number);
      curve.x.push_back(lead.lead_time * time.factor);
      curve.y.push_back(spread.median * factor);
      curve.lower.push_back(spread.lower * factor);
      curve.upper.push_back(spread.upper * factor);
    }
    return curve;
  };
  double largest_error = 0;
  for (const auto number : {&Comparison::rmse, &Comparison::rmse_persistence, &Comparison::rmse_translation})
    for (const double v : curve_of(number, 1).upper)
      if (std::isfinite(v)) largest_error = std::max(largest_error, v);
  const Unit unit = length_unit(largest_error);
  const Curve skill_persistence = curve_of(&Comparison::skill_persistence, 1);
  const Curve skill_translation = curve_of(&Comparison::skill_translation, 1);
  // Medians are always in sight; a quartile far below would flatten all else.
  double least_skill = 0;
  for (const Curve* curve : {&skill_persistence, &skill_translation})
    for (std::size_t i = 0; i < curve->x.size(); ++i) {
      if (std::isfinite(curve->y[i])) least_skill = std::min(least_skill, curve->y[i]);
      if (std::isfinite(curve->lower[i]))
        least_skill = std::min(least_skill, std::max(curve->lower[i], -1.0));
    }

  std::ostringstream script;
  script << plot_style;
  write_data(script, "error_forecast", curve_of(&Comparison::rmse, unit.factor));
  write_data(script, "error_persistence", curve_of(&Comparison::rmse_persistence, unit.factor));
  write_data(script, "error_translation", curve_of(&Comparison::rmse_translation, unit.factor));
  write_data(script, "skill_persistence", skill_persistence);
  write_data(script, "skill_translation", skill_translation);
  const auto line = [](const std::string& data, const char* title, const char* colour, int point) {
    const std::string look = " lw 2 pt " + std::to_string(point) + " ps 0.7 lc rgb " + colour;
    return "$" + data + " using 1:2:3:4 notitle with yerrorbars lw 1 ps 0 lc rgb " + colour + ", $" + data +
           " using 1:2 title '" + title + "' with linespoints" + look;
  };
  script << "set multiplot layout 1,2\nset xrange [0:" << 1.08 * leads.back().lead_time * time.factor
         << "]\nset xlabel 'lead time of the forecast [" << time.name << "]'\n"
         << "set tmargin 4\nset key at graph 1.0, graph 1.16 right horizontal samplen 1.5 width -2\n"
         << "set ylabel 'error of the surface, RMSE [" << unit.name
         << "]'\nset yrange [0:" << (largest_error > 0 ? 1.1 * largest_error * unit.factor : 1) << "]\nplot "
         << line("error_persistence", "nothing changes", "baseline", 7) << ", "
         << line("error_translation", "pure translation", "second", 5) << ", "
         << line("error_forecast", "forecast", "forecast", 7) << "\n"
         << "set ylabel 'skill: 1 perfect, 0 as good as the baseline'\nset yrange ["
         << 1.1 * least_skill - 0.1
         << ":1]\nset arrow 1 from graph 0, first 0 to graph 1, first 0 nohead lw 1.5 lc rgb measured\nplot "
         << line("skill_persistence", "against nothing changes", "forecast", 7) << ", "
         << line("skill_translation", "against translation", "second", 5) << "\nunset multiplot\n";
  plot_svg(script.str(), 1000, 400, path);
}

}  // namespace aeolian
