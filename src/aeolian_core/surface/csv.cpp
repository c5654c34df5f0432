#include "aeolian_core/surface/csv.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/text.hpp"

namespace aeolian {
namespace {

/// Calls `visit(field)` for each comma-separated field of a line.
template <class Visit>
void for_each_field(std::string_view line, Visit&& visit) {
  for (;;) {
    const std::size_t comma = line.find(',');
    visit(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

bool Table::has(const std::string& name) const {
  return std::find(names.begin(), names.end(), name) != names.end();
}

const std::vector<double>& Table::column(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw Error("there is no column '" + name + "'");
  return columns[static_cast<std::size_t>(found - names.begin())];
}

Table read_csv(const std::string& path) {
  const std::string text = read_text(path, "table");
  Table table;
  std::string_view rest = text;
  for (int number = 1; !rest.empty(); ++number) {
    const std::string_view full = take_line(rest);
    const std::string_view line = trimmed(full.substr(0, full.find('#')));
    if (line.empty()) continue;
    const std::string where = "table '" + path + "', line " + std::to_string(number) + ": ";
    if (table.names.empty()) {
      for_each_field(line, [&](std::string_view name) { table.names.emplace_back(name); });
      table.columns.resize(table.names.size());
      continue;
    }
    std::size_t field_number = 0;
    for_each_field(line, [&](std::string_view field) {
      if (field_number < table.names.size()) {
        const auto value = field.empty() ? std::numeric_limits<double>::quiet_NaN() : parse_number(field);
        if (!value)
          throw Error(where + table.names[field_number] + " is '" + std::string(field) +
                      "', must be a number");
        table.columns[field_number].push_back(*value);
      }
      ++field_number;
    });
    if (field_number != table.names.size())
      throw Error(where + std::to_string(field_number) + " fields, must be " +
                  std::to_string(table.names.size()) + " as in the first line");
  }
  if (table.names.empty())
    throw Error("table '" + path + "': is empty, its first line must name the columns");
  return table;
}

void write_csv(const Table& table, const std::string& path, const std::string& comment) {
  std::string text = comment.empty() ? "" : "# " + comment + "\n";
  for (std::size_t c = 0; c < table.names.size(); ++c) {
    if (c > 0) text += ',';
    text += table.names[c];
  }
  text += '\n';
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      if (c > 0) text += ',';
      append_number(text, table.columns[c].at(row));
    }
    text += '\n';
  }
  write_text_atomically(path, text);
}

void write_map_csv(const HeightMap& map, const std::string& path) {
  const GridGeometry& geometry = map.geometry();
  std::string text = "x_m,y_m";
  std::vector<const HeightMap::Layer*> layers;
  for (const std::string& name : map.names()) {
    text += ',' + name;
    layers.push_back(&map.layer(name));
  }
  text += '\n';
  for (std::size_t i = 0; i < geometry.size(); ++i) {
    const auto known = [i](const HeightMap::Layer* values) { return std::isfinite((*values)[i]); };
    if (std::none_of(layers.begin(), layers.end(), known)) continue;
    const CellIndex cell = geometry.cell_at(i);
    append_number(text, geometry.x(cell.x));
    text += ',';
    append_number(text, geometry.y(cell.y));
    for (const HeightMap::Layer* values : layers) {
      text += ',';
      append_number(text, (*values)[i]);
    }
    text += '\n';
  }
  write_text_atomically(path, text);
}

}  // namespace aeolian
