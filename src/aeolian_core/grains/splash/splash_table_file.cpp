#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "aeolian_core/grains/splash/splash_table.hpp"
#include "aeolian_core/grains/splash/splash_table_nodes.hpp"
#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/text.hpp"

namespace aeolian {
namespace {

constexpr const char* title = "# aeolian splash table 1";

constexpr const char* legend =
    "# node,speed_over_sqrt_gd,angle_to_bed_deg,size_ratio,brinks_per_diameter,events: what follows, to the\n"
    "#   next node, are its events\n"
    "# rebound,along,across,away: an event; velocity relative to the bed, over the speed of the impact\n"
    "# captured: an event whose grain stayed\n"
    "# target|brink|anti_brink|other,along,across,away,size_ratio,distance: a grain that the event ejected;\n"
    "#   velocity over sqrt(g d), distance along the bed in grain diameters\n";

/// The lines of a table's file, of which it tells where they stand.
class Lines {
 public:
  Lines(const std::string& path, std::string_view text) : path_(path), rest_(text) {}

  /// False at the end. Leaves out what is blank and comments but for the first line.
  bool next() {
    while (!rest_.empty()) {
      line_ = trimmed(take_line(rest_));
      ++number_;
      if (!line_.empty() && (line_.front() != '#' || number_ == 1)) return true;
    }
    line_ = {};
    return false;
  }
  std::string_view line() const { return line_; }

  /// The fields between commas; throws unless there are so many.
  std::vector<std::string_view> fields(std::size_t count) const {
    std::vector<std::string_view> all;
    std::string_view rest = line_;
    for (std::size_t comma = 0; (comma = rest.find(',')) != std::string_view::npos;
         rest.remove_prefix(comma + 1))
      all.push_back(trimmed(rest.substr(0, comma)));
    all.push_back(trimmed(rest));
    if (all.size() != count)
      fail("has " + std::to_string(all.size()) + " fields, must be " + std::to_string(count));
    return all;
  }

  double number(std::string_view field, const char* what, double low, double high) const {
    const auto value = parse_number(field);
    if (!value || !(*value >= low && *value <= high)) {
      std::string range;
      append_number(range, low);
      range += " to ";
      append_number(range, high);
      fail(std::string(what) + " is '" + std::string(field) + "', must be " + range);
    }
    return *value;
  }
  std::size_t count(std::string_view field, const char* what) const {
    const double value = number(field, what, 0, 1e12);
    if (value != std::floor(value))
      fail(std::string(what) + " is '" + std::string(field) + "', must be a whole number");
    return static_cast<std::size_t>(value);
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(path_ + ":" + std::to_string(number_) + ": " + what);
  }

 private:
  const std::string& path_;
  std::string_view rest_, line_;
  int number_ = 0;
};

struct Head {
  SplashTableSource source;
  std::size_t nodes = 0, events = 0, ejecta = 0;
};

/// Stands on the first row afterwards.
Head read_head(Lines& lines) {
  if (!lines.next() || lines.line() != title)
    lines.fail("is '" + std::string(lines.line().substr(0, 60)) + "', must be '" + title + "'");
  std::map<std::string, std::string> values;
  while (lines.next()) {
    const std::size_t colon = lines.line().find(": ");
    const std::string key(lines.line().substr(0, colon));
    if (key != "command" && key != "material" && key != "ejecta_kept" && key != "nodes" && key != "events" &&
        key != "ejecta")
      break;
    values[key] = colon == std::string_view::npos ? "" : std::string(trimmed(lines.line().substr(colon + 2)));
  }
  for (const char* key : {"command", "material", "ejecta_kept", "nodes", "events", "ejecta"})
    if (values.count(key) == 0) lines.fail("the head has no '" + std::string(key) + ": ', must have it");
  Head head;
  head.source = {values["command"], values["material"],
                 lines.number(values["ejecta_kept"], "ejecta_kept", 1e-6, 1)};
  head.nodes = lines.count(values["nodes"], "nodes");
  head.events = lines.count(values["events"], "events");
  head.ejecta = lines.count(values["ejecta"], "ejecta");
  return head;
}

void append_row(std::string& text, const std::string& kind, std::initializer_list<double> values) {
  text += kind;
  for (const double value : values) {
    text += ',';
    append_number(text, value);
  }
  text += '\n';
}

void append_row(std::string& text, const SplashTable::Ejectum& grain) {
  text += name_of(grain.origin);
  for (const float value : {grain.along, grain.across, grain.away, grain.size_ratio, grain.distance}) {
    text += ',';
    append_number(text, value);
  }
  text += '\n';
}

}  // namespace

void SplashTable::write(const std::string& path) const {
  std::string text = std::string(title) + "\n";
  text += "command: " + source_.command + "\nmaterial: " + source_.material + "\nejecta_kept: ";
  append_number(text, source_.ejecta_kept);
  text += "\nnodes: " + std::to_string(nodes_.size()) + "\nevents: " + std::to_string(events_.size()) +
          "\nejecta: " + std::to_string(ejecta_.size()) + "\n" + legend;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    std::array<double, 4> place;
    std::size_t rest = i;
    for (std::size_t k = 4; k-- > 0; rest /= axes_[k].size()) place[k] = axes_[k][rest % axes_[k].size()];
    append_row(text, "node",
               {place[speed], place[angle] / degree, place[size_ratio], place[roughness],
                static_cast<double>(nodes_[i].count)});
    for (std::size_t e = nodes_[i].first; e < nodes_[i].first + nodes_[i].count; ++e) {
      const StoredEvent& event = events_[e];
      if (event.captured)
        text += "captured\n";
      else
        append_row(text, "rebound", {event.along, event.across, event.away});
      const std::size_t end = e + 1 < events_.size() ? events_[e + 1].first : ejecta_.size();
      for (std::size_t g = event.first; g < end; ++g) append_row(text, ejecta_[g]);
    }
  }
  write_text_atomically(path, text);
}

SplashTable SplashTable::read(const std::string& path) {
  const std::string text = read_text(path, "splash table");
  Lines lines(path, text);
  const Head head = read_head(lines);
  constexpr double far = 1e4;  // more than any velocity or distance in these units
  std::vector<Gathered> nodes;
  std::size_t expected = 0, events = 0, ejecta = 0;
  const auto node_is_whole = [&] {
    if (!nodes.empty() && nodes.back().events.size() != expected)
      lines.fail("the node before has " + std::to_string(nodes.back().events.size()) + " events, must be " +
                 std::to_string(expected));
  };
  for (bool more = !lines.line().empty(); more; more = lines.next()) {
    const std::string kind(lines.line().substr(0, lines.line().find(',')));
    if (kind == "node") {
      node_is_whole();
      const auto f = lines.fields(6);
      nodes.push_back(
          {{lines.number(f[1], "speed", 1e-6, 1e6), degree * lines.number(f[2], "angle", 1e-6, 90),
            lines.number(f[3], "size ratio", 1e-3, 1e3), lines.number(f[4], "roughness", 0, 1)},
           {},
           {}});
      expected = lines.count(f[5], "number of events");
      continue;
    }
    if (nodes.empty()) lines.fail("'" + kind + "' before the first node, must be 'node'");
    Gathered& node = nodes.back();
    if (kind == "captured" || kind == "rebound") {
      StoredEvent event{true, 0, 0, 0, node.ejecta.size()};
      if (kind == "rebound") {
        const auto f = lines.fields(4);
        event = {false, lines.number(f[1], "velocity along", -1, 1),
                 lines.number(f[2], "velocity across", -1, 1), lines.number(f[3], "velocity away", -1, 1),
                 event.first};
        if (event.along * event.along + event.across * event.across + event.away * event.away > 1 + 1e-9)
          lines.fail("the rebound is faster than the impact, must not be");
      } else {
        lines.fields(1);
      }
      node.events.push_back(event);
      ++events;
      continue;
    }
    const auto* const origin = std::find_if(std::begin(ejecta_origins), std::end(ejecta_origins),
                                            [&kind](Origin one) { return kind == name_of(one); });
    if (origin == std::end(ejecta_origins))
      lines.fail("row begins with '" + kind +
                 "', must be node, rebound, captured, target, brink, anti_brink or other");
    if (node.events.empty()) lines.fail("'" + kind + "' before the node's first event");
    const auto f = lines.fields(6);
    const auto value = [&](std::size_t i, const char* what, double low, double high) {
      return static_cast<float>(lines.number(f[i], what, low, high));
    };
    node.ejecta.push_back({value(1, "velocity along", -far, far), value(2, "velocity across", -far, far),
                           value(3, "velocity away", -far, far), value(4, "size ratio", 1e-3, 1e3),
                           value(5, "distance", -far, far), *origin});
    ++ejecta;
  }
  node_is_whole();
  if (nodes.size() != head.nodes || events != head.events || ejecta != head.ejecta)
    lines.fail("there are " + std::to_string(nodes.size()) + " nodes, " + std::to_string(events) +
               " events and " + std::to_string(ejecta) + " ejecta, must be " + std::to_string(head.nodes) +
               ", " + std::to_string(head.events) + " and " + std::to_string(head.ejecta) +
               " as the head says");
  return of(nodes, head.source, path);
}

}  // namespace aeolian
