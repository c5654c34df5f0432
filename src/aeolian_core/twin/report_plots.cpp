#include "aeolian_core/twin/report_plots.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/report_text.hpp"

namespace aeolian {
namespace {

const char* const plot_style = R"(
set border 3 lc rgb '#8a7f76'
set tics nomirror out scale 0.5 textcolor rgb '#4a413b'
set grid y lc rgb '#e6dfd6' lw 1
set key textcolor rgb '#4a413b'
set datafile missing 'nan'
measured = '#2e2723'
forecast = '#c2571a'
baseline = '#8a8f98'
second = '#3c6e9f'
)";

/// One curve, with quartiles or without.
struct Curve {
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> lower;
  std::vector<double> upper;
};

/// Writes the columns where gnuplot reads them; infinities are left blank like NaN.
void write_data(std::ostream& out, const std::string& name, const Curve& curve) {
  out << "$" << name << " << EOD\n";
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    out << curve.x[i];
    for (const auto* column : {&curve.y, &curve.lower, &curve.upper}) {
      if (column->empty()) continue;
      if (std::isfinite((*column)[i]))
        out << ' ' << (*column)[i];
      else
        out << " nan";
    }
    out << '\n';
  }
  out << "EOD\n";
}

bool has_value(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

/// Largest finite value, 0 without any.
double largest(const std::vector<double>& values) {
  double result = 0;
  for (const double v : values)
    if (std::isfinite(v)) result = std::max(result, v);
  return result;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& v : values) v *= factor;
  return values;
}

/// The round step that divides a range into about four.
double tic_step(double range) {
  const double rough = range / 4;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  const double first = rough / power;
  return power * (first < 1.5 ? 1 : first < 3.5 ? 2 : first < 7.5 ? 5 : 10);
}

/// One of the panels that share the axis of time.
struct Panel {
  std::string title;
  std::string unit;
  Curve measured;
  Curve forecast;
  const char* nothing;  // said when there is no value
};

void write_panel(std::ostream& out, const Panel& panel, int number, double top, double bottom) {
  const std::string id = std::to_string(number);
  write_data(out, "measured" + id, panel.measured);
  write_data(out, "forecast" + id, panel.forecast);
  out << "set tmargin at screen " << top << "\nset bmargin at screen " << bottom << "\nset ylabel '"
      << panel.unit << "'\nset label 1 '" << panel.title
      << "' at graph 0.0, graph 1.1 left textcolor rgb measured\n";
  const bool measured = has_value(panel.measured.y);
  const bool forecast = has_value(panel.forecast.y);
  if (!measured && !forecast) {
    out << "set label 2 '" << panel.nothing << "' at graph 0.5, graph 0.5 center textcolor rgb baseline\n"
        << "set yrange [0:1]\nset format y ''\nplot $measured" << id << " using 1:(-1) notitle with lines\n"
        << "unset label 2\nset format y\n";
    return;
  }
  const double top_value = std::max(largest(panel.measured.y), largest(panel.forecast.y));
  out << "set yrange [0:" << (top_value > 0 ? 1.15 * top_value : 1) << "]\nset ytics "
      << tic_step(top_value > 0 ? top_value : 1) << "\nplot ";
  if (measured)
    out << "$measured" << id << " using 1:2 title 'measured' with linespoints lw 1.2 pt 7 ps "
        << (panel.measured.x.size() > 60 ? 0.25 : 0.5) << " lc rgb measured";
  if (measured && forecast) out << ", ";
  if (forecast)
    out << "$forecast" << id << " using 1:2 title 'forecast' with points pt 6 ps 0.8 lw 1.6 lc rgb forecast";
  out << "\n";
}

}  // namespace

void plot_growth(const Run& run, const std::vector<LeadSummary>& leads, const std::string& path) {
  Curve wavelength;
  Curve height;
  Curve wind;
  double end = 0;
  for (const Run::State& state : run.states) {
    end = std::max(end, state.time);
    for (Curve* curve : {&wavelength, &height, &wind}) curve->x.push_back(state.time);
    wavelength.y.push_back(state.wavelength);
    height.y.push_back(state.height);
    wind.y.push_back(state.friction_velocity);
  }
  Curve forecast_wavelength;
  Curve forecast_height;
  for (const Run::Score& score : run.scores) {
    if (leads.empty() || score.lead_time < leads.back().lead_time * 0.98 - 0.5) continue;
    for (Curve* curve : {&forecast_wavelength, &forecast_height}) curve->x.push_back(score.time);
    forecast_wavelength.y.push_back(score.comparison.wavelength_predicted);
    forecast_height.y.push_back(score.comparison.height_predicted);
    end = std::max(end, score.time);
  }
  const Unit time = time_unit(end);
  const auto in_units = [&](Curve curve, const Unit& unit) {
    curve.x = scaled(curve.x, time.factor);
    curve.y = scaled(curve.y, unit.factor);
    return curve;
  };
  const Unit long_unit = length_unit(largest(wavelength.y));
  const Unit high_unit = length_unit(largest(height.y));
  const Unit speed_unit{1, "m/s"};

  std::ostringstream script;
  script << plot_style << "set multiplot\nset lmargin at screen 0.09\nset rmargin at screen 0.97\n"
         << "set xrange [0:" << (end > 0 ? end * time.factor : 1)
         << "]\nset key at graph 1.0, graph 1.2 right "
         << "horizontal samplen 2\nset format x ''\n";
  write_panel(script,
              {"Ripple wavelength", long_unit.name, in_units(wavelength, long_unit),
               in_units(forecast_wavelength, long_unit), "no ripples were found"},
              0, 0.94, 0.70);
  write_panel(script,
              {"Ripple height, trough to crest", high_unit.name, in_units(height, high_unit),
               in_units(forecast_height, high_unit), "no ripples were found"},
              1, 0.62, 0.38);
  script << "set format x '%g'\nset xlabel 'time since the start of the run [" << time.name
         << "]'\nunset key\n";
  write_panel(script,
              {"Friction velocity of the wind",
               speed_unit.name,
               in_units(wind, speed_unit),
               {},
               "the wind is not known"},
              2, 0.30, 0.11);
  script << "unset multiplot\n";
  plot_svg(script.str(), 1000, 640, path);
}

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
    largest_error = std::max(largest_error, largest(curve_of(number, 1).upper));
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
