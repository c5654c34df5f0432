#include "aeolian_twin/replay/replay_summary.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/twin/report_style.hpp"
#include "aeolian_core/twin/report_text.hpp"

namespace aeolian {
namespace {

constexpr char separator = '\t';

std::string in_quotes(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string(2, c) : std::string(1, c);
  return result + "\"";
}

void write_table(const std::vector<ReplayedBag>& bags, const std::string& path) {
  std::string text = "bag,refused";
  for (const ReplayFigure& figure : replay_figures) text += fmt::format(",{}", figure.name);
  for (const ReplayedBag& bag : bags) {
    text += fmt::format("\n{},{}", in_quotes(bag.name), in_quotes(bag.refused));
    for (const ReplayFigure& figure : replay_figures)
      text += bag.refused.empty() ? fmt::format(",{}", bag.figures.*figure.value) : ",nan";
  }
  write_text_atomically(path, text + "\n");
}

std::string cells(const ReplayedBag& bag) {
  const std::string name = escape_html(bag.name);
  if (!bag.refused.empty())
    return fmt::format("<td>{}</td><td colspan=\"7\" style=\"text-align: left\">{}</td>", name,
                       escape_html(bag.refused));
  const ReplayFigures& f = bag.figures;
  std::string row = fmt::format("<td><a href=\"{0}/report/index.html\">{0}</a></td>", name);
  for (const std::string& cell :
       {duration_text(f.duration), fmt::format("{:.0f}", f.maps),
        fmt::format("{:.0f} / {:.0f}", f.forecasts, f.scored),
        std::isfinite(f.lead_time) ? duration_text(f.lead_time) : number_text(NAN), length_text(f.rmse),
        skill_text(f.skill_persistence), skill_text(f.skill_translation)})
    row += fmt::format("<td>{}</td>", escape_html(cell));
  return row;
}

}  // namespace

std::string to_line(const ReplayedBag& bag) {
  std::string line = bag.name + separator + bag.refused;
  for (const ReplayFigure& figure : replay_figures)
    line += fmt::format("{}{}", separator, bag.figures.*figure.value);
  return line;
}

ReplayedBag from_line(const std::string& line) {
  std::istringstream in(line);
  ReplayedBag bag;
  std::getline(in, bag.name, separator);
  std::getline(in, bag.refused, separator);
  for (const ReplayFigure& figure : replay_figures) {
    std::string number;
    std::getline(in, number, separator);
    bag.figures.*figure.value = std::stod(number);
  }
  return bag;
}

void write_replay_summary(const std::vector<ReplayedBag>& bags, const std::string& directory) {
  write_table(bags, directory + "/summary.csv");
  const auto replayed =
      std::count_if(bags.begin(), bags.end(), [](const ReplayedBag& bag) { return bag.refused.empty(); });
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>The twin on several "
      "bags</title>\n<style>{}</style>\n</head>\n<body>\n<main>\n<header>\n<h1>The twin on several "
      "bags</h1>\n<p class=\"verdict\">{} of {} bags were replayed.</p>\n</header>\n"
      "<p style=\"margin-top: 26px\">Error and skills are medians over the forecasts of the longest lead "
      "time "
      "that was scored. A skill of 1 is a perfect forecast, one of 0 is no better than what it is held "
      "against.</p>\n"
      "<div class=\"table\"><table><thead><tr><th>Bag</th><th>Time</th><th>Maps</th><th>Forecasts made / "
      "scored</th><th>Longest lead</th><th>RMSE</th><th>Skill: persistence</th><th>Skill: "
      "translation</th></tr></thead>\n<tbody>\n",
      report_style, replayed, bags.size());
  for (const ReplayedBag& bag : bags) page += fmt::format("<tr>{}</tr>\n", cells(bag));
  page +=
      "</tbody></table></div>\n<footer>Numbers behind this page: <a href=\"summary.csv\">summary.csv</a>."
      "</footer>\n</main>\n</body>\n</html>\n";
  write_text_atomically(directory + "/index.html", page);
}

}  // namespace aeolian
