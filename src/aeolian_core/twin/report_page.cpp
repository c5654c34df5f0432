#include "aeolian_core/twin/report_page.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "aeolian_core/twin/report_style.hpp"
#include "aeolian_core/twin/report_text.hpp"
#include "aeolian_core/wind/direction.hpp"

namespace aeolian {
namespace {

std::string card(const std::string& value, const std::string& meaning) {
  const bool text = !value.empty() && value.find_first_of("0123456789") == std::string::npos;
  return "<div class=\"card\"><b" + std::string(text ? " class=\"text\"" : "") + ">" + value + "</b><span>" +
         meaning + "</span></div>\n";
}

std::string figure(const Picture& picture, const std::string& look = "") {
  return "<figure" + (look.empty() ? "" : " class=\"" + look + "\"") + "><h3>" + escape_html(picture.title) +
         "</h3><img src=\"" + picture.file + "\" alt=\"" + escape_html(picture.title) + "\"><figcaption>" +
         escape_html(picture.caption) + "</figcaption></figure>\n";
}

std::string pair_text(double measured, double predicted) {
  if (std::isnan(measured) && std::isnan(predicted)) return number_text(NAN);
  const Unit unit = length_unit(std::isnan(measured) ? predicted : measured);
  const std::string first = std::isnan(measured) ? "none" : number_text(measured * unit.factor);
  const std::string second = std::isnan(predicted) ? "none" : number_text(predicted * unit.factor);
  return first + " / " + second + " " + unit.name;
}

void write_cards(std::ostream& out, const LeadSummary& lead) {
  const std::string ahead = duration_text(lead.lead_time) + " ahead";
  const auto median = [&](double Comparison::*number) { return lead.spread(number).median; };
  out << "<div class=\"cards\">\n"
      << card(length_text(median(&Comparison::rmse)), "error of the forecast (RMSE), " + ahead)
      << card(skill_text(median(&Comparison::skill_persistence)),
              "skill against “nothing changes”: 1 is perfect, 0 no better")
      << card(pair_text(median(&Comparison::wavelength_measured), median(&Comparison::wavelength_predicted)),
              "ripple wavelength, measured / forecast")
      << card(pair_text(median(&Comparison::height_measured), median(&Comparison::height_predicted)),
              "ripple height, measured / forecast")
      << card(pair_text(median(&Comparison::displacement_measured),
                        median(&Comparison::displacement_predicted)),
              "crests moved, measured / forecast")
      << "</div>\n";
}

/// One line of the table of scores: a number of every lead time in one unit.
void write_row(std::ostream& out, const std::vector<LeadSummary>& leads, double Comparison::*number,
               const std::string& name, const std::string& meaning, Unit (*unit_for)(double)) {
  double largest = 0;
  for (const LeadSummary& lead : leads) {
    const double median = std::abs(lead.spread(number).median);
    if (std::isfinite(median)) largest = std::max(largest, median);
  }
  const Unit unit = unit_for != nullptr ? unit_for(largest) : Unit{1, ""};
  out << "<tr><td>" << name << (unit.name.empty() ? "" : " [" + unit.name + "]") << "<small>" << meaning
      << "</small></td>";
  for (const LeadSummary& lead : leads) {
    const double median = lead.spread(number).median;
    out << "<td>" << (unit_for != nullptr ? number_text(median * unit.factor) : skill_text(median))
        << "</td>";
  }
  out << "</tr>\n";
}

void write_scores(std::ostream& out, const std::vector<LeadSummary>& leads) {
  const auto group = [&](const char* name) {
    out << "<tr class=\"group\"><th colspan=\"" << leads.size() + 1 << "\">" << name << "</th></tr>\n";
  };
  const auto row = [&](double Comparison::*number, const char* name, const char* meaning,
                       Unit (*unit)(double)) { write_row(out, leads, number, name, meaning, unit); };
  out << "<div class=\"table\"><table>\n<thead><tr><th>Lead time of the forecast</th>";
  for (const LeadSummary& lead : leads) out << "<th>" << duration_text(lead.lead_time) << "</th>";
  out << "</tr></thead>\n<tbody>\n<tr><td>Forecasts scored</td>";
  for (const LeadSummary& lead : leads) out << "<td>" << lead.scores.size() << "</td>";
  out << "</tr>\n";
  group("Error of the surface");
  row(&Comparison::rmse, "Forecast", "root mean square of forecast minus measurement", length_unit);
  row(&Comparison::rmse_persistence, "Nothing changes", "the same error if the surface had stayed as it was",
      length_unit);
  row(&Comparison::rmse_translation, "Pure translation",
      "the same error if the surface had moved downwind as a whole; the shift is chosen with hindsight",
      length_unit);
  row(&Comparison::bias, "Mean difference", "positive: the forecast is too high", length_unit);
  row(&Comparison::nmad, "NMAD", "spread of the differences that outliers do not sway", length_unit);
  group("Skill: 1 perfect, 0 as good as the baseline, negative worse");
  row(&Comparison::skill_persistence, "Against nothing changes",
      "share of the squared change that is explained", nullptr);
  row(&Comparison::skill_translation, "Against pure translation",
      "a hard test: that baseline knows the outcome", nullptr);
  group("Ripples");
  row(&Comparison::wavelength_measured, "Wavelength, measured", "crest to crest along the wind", length_unit);
  row(&Comparison::wavelength_predicted, "Wavelength, forecast", "", length_unit);
  row(&Comparison::height_measured, "Height, measured", "trough to crest", length_unit);
  row(&Comparison::height_predicted, "Height, forecast", "", length_unit);
  row(&Comparison::displacement_measured, "Displacement, measured",
      "of the crests downwind since the start; beyond half a wavelength the pattern meets itself again",
      length_unit);
  row(&Comparison::displacement_predicted, "Displacement, forecast", "", length_unit);
  group("Sand gained by the plot since the start of the forecast");
  row(&Comparison::volume_change_measured, "Volume, measured", "", volume_unit);
  row(&Comparison::volume_change_predicted, "Volume, forecast", "", volume_unit);
  out << "</tbody></table></div>\n";
}

void write_truth(std::ostream& out, const TruthStatistics& truth) {
  const double largest = std::max(truth.measured.rmse, truth.forecast ? truth.forecast->rmse : 0.0);
  const Unit unit = length_unit(largest);
  const auto row = [&](const char* name, double DifferenceStatistics::*number) {
    out << "<tr><td>" << name << " [" << unit.name << "]</td><td>"
        << number_text(truth.measured.*number * unit.factor) << "</td>";
    if (truth.forecast) out << "<td>" << number_text((*truth.forecast).*number * unit.factor) << "</td>";
    out << "</tr>\n";
  };
  out << "<h2>How good is the measured map itself?</h2>\n<p>The true surface of this run is known. Forecasts "
         "are scored against the measured map, so what separates that map from the truth is part of their "
         "errors.</p>\n"
      << "<div class=\"maps\">\n"
      << figure(truth.picture)
      << "<div class=\"table beside\"><table>\n<thead><tr><th>Against the true surface</th><th>measured "
         "map</th>"
      << (truth.forecast ? "<th>forecast</th>" : "") << "</tr></thead>\n<tbody>\n";
  row("Error, RMSE", &DifferenceStatistics::rmse);
  row("Mean difference", &DifferenceStatistics::bias);
  row("NMAD", &DifferenceStatistics::nmad);
  out << "<tr><td>Cells compared</td><td>" << truth.measured.cells << "</td>";
  if (truth.forecast) out << "<td>" << truth.forecast->cells << "</td>";
  out << "</tr>\n</tbody></table></div>\n</div>\n";
}

std::string wind_text(double direction) {
  if (std::isnan(direction)) return number_text(direction);
  // An arrow that points to where the wind blows, north up.
  std::ostringstream out;
  out << "<svg width=\"22\" height=\"22\" viewBox=\"-12 -12 24 24\" style=\"vertical-align:-4px\"><g "
         "transform=\"rotate("
      << -radians_to_degrees(direction)
      << ")\" stroke=\"#c2571a\" stroke-width=\"2.4\" fill=\"none\"><path d=\"M-10 0H9M3 -6L9 0L3 "
         "6\"/></g></svg> from "
      << std::lround(meteorological_from_direction(direction)) % 360 << "°";
  return out.str();
}

void write_figures_of_the_run(std::ostream& out, const Run& run) {
  double first = INFINITY;
  double last = -INFINITY;
  std::vector<double> known;
  std::vector<double> winds;
  for (const Run::State& state : run.states) {
    first = std::min(first, state.time);
    last = std::max(last, state.time);
    known.push_back(state.known_share);
    winds.push_back(state.friction_velocity);
  }
  const GridGeometry& grid = run.measured.geometry();
  const Unit extent = length_unit(std::max(grid.length_x(), grid.length_y()));
  const auto row = [&](const char* name, const std::string& value) {
    out << "<tr><td>" << name << "</td><td>" << value << "</td></tr>\n";
  };
  out << "<h2>The run</h2>\n<div class=\"table\"><table><tbody>\n";
  row("Time from the first to the last map",
      run.states.empty() ? number_text(NAN) : duration_text(last - first));
  row("Measured maps", std::to_string(run.states.size()));
  row("Plot, west to east × south to north", number_text(grid.length_x() * extent.factor) + " × " +
                                                 number_text(grid.length_y() * extent.factor) + " " +
                                                 extent.name);
  row("Cells",
      std::to_string(grid.nx()) + " × " + std::to_string(grid.ny()) + " of " + length_text(grid.cell()));
  const double share = spread_of(known).median;
  row("Share of the cells that a map knows, median",
      std::isnan(share) ? number_text(share) : number_text(100 * share) + " %");
  row("Wind direction, mean", wind_text(run.wind_direction));
  row("Friction velocity, median", quantity_text(spread_of(winds).median, {1, "m/s"}));
  row("Forecasts made / scored", std::to_string(run.forecasts) + " / " + std::to_string(run.scores.size()));
  out << "</tbody></table></div>\n";
}

}  // namespace

std::string report_page(const PageContents& contents) {
  const Run& run = contents.run;
  std::ostringstream out;
  out << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      << "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>"
      << escape_html(run.title) << "</title>\n<style>" << report_style
      << "</style>\n</head>\n<body>\n<main>\n<header>\n<h1>" << escape_html(run.title) << "</h1>\n";
  if (!run.source.empty()) out << "<p class=\"source\">From " << escape_html(run.source) << "</p>\n";
  out << "<p class=\"verdict\">" << escape_html(verdict(run, contents.leads));
  if (contents.truth)
    out << " The measured map itself is off the true surface by "
        << length_text(contents.truth->measured.rmse) << ".";
  out << "</p>\n</header>\n";
  if (!contents.leads.empty()) write_cards(out, contents.leads.back());

  out << "<h2>The surface, measured and forecast</h2>\n<p>North is up. Light falls from the north-west. "
         "Hatched grey "
         "cells were not seen by the sensor.</p>\n<div class=\"maps\">\n";
  for (const Picture& map : contents.maps) out << figure(map);
  out << "</div>\n";

  out << "<h2>Growth of the ripples</h2>\n";
  if (contents.growth)
    out << figure(*contents.growth, "wide");
  else
    out << "<p class=\"none\">The run holds no measured map, so there is no growth to show.</p>\n";

  out << "<h2>How good is the forecast?</h2>\n";
  if (contents.skill) {
    out << figure(*contents.skill, "wide")
        << "<p style=\"margin-top:26px\">Every score by lead time. Each number is the median over the "
           "forecasts of that "
           "lead time.</p>\n";
    write_scores(out, contents.leads);
  } else {
    out << "<p class=\"none\">" << escape_html(verdict(run, {})) << "</p>\n";
  }
  if (contents.truth) write_truth(out, *contents.truth);
  write_figures_of_the_run(out, run);

  out << "<footer>Numbers behind this page:";
  for (const std::string& table : contents.tables)
    out << (table == contents.tables.front() ? " " : ", ") << "<a href=\"" << table << "\">" << table
        << "</a>";
  out << ". Columns carry their units in their names.</footer>\n</main>\n</body>\n</html>\n";
  return out.str();
}

}  // namespace aeolian
