#include "aeolian_core/slide/surrogate/pile_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr std::array<const char*, 11> names{"run",         "panel_length_m", "panel_height_m", "tilt_deg",
                                            "thickness_m", "event",          "cell_m",         "height_m",
                                            "length_m",    "head_m",         "tail_m"};

std::array<double, names.size()> numbers_of(const PileRecord& r) {
  const PileQuery& q = r.query;
  return {static_cast<double>(r.run),
          q.panel_length,
          q.panel_height,
          q.tilt / degree,
          q.thickness,
          static_cast<double>(q.event),
          r.cell,
          r.height,
          r.length,
          r.head,
          r.tail};
}

bool same_panel(const PileQuery& a, const PileQuery& b) {
  return a.panel_length == b.panel_length && a.panel_height == b.panel_height && a.tilt == b.tilt &&
         a.thickness == b.thickness;
}

void check_columns(const Table& table, const std::string& file) {
  for (const std::string& name : table.names)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw Error(fmt::format("{}: column '{}' is not one of a table of piles: {}", file, name,
                              fmt::join(names, ", ")));
  for (const char* name : names)
    if (!table.has(name)) throw Error(fmt::format("{}: there is no column '{}'", file, name));
  if (table.rows() == 0) throw Error(file + ": there are 0 piles, must be at least 1");
}

}  // namespace

SlideScene scene_for(const PileQuery& query, const SlideScene& base, double cells_per_thickness) {
  SlideScene scene = base;
  scene.panel_length = query.panel_length;
  scene.panel_height = query.panel_height;
  scene.height_of = SlideScene::HeightOf::lower_edge;
  scene.tilt = query.tilt;
  scene.slab_thickness = query.thickness;
  scene.cell = query.thickness / cells_per_thickness;
  return scene;
}

PileTable read_pile_table(const std::string& file) {
  const Table table = read_csv(file);
  check_columns(table, file);
  PileTable piles;
  std::map<int, PileQuery> panels;
  std::set<std::pair<int, int>> seen;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    std::array<double, names.size()> v{};
    for (std::size_t k = 0; k < names.size(); ++k) {
      v[k] = table.column(names[k])[row];
      const auto refuse = [&](const char* rule) {
        throw Error(fmt::format("{}: row {}: {} is {}, must be {}", file, row + 1, names[k], v[k], rule));
      };
      if (!std::isfinite(v[k])) refuse("finite");
      const bool counted = k == 0 || k == 5;
      if (counted && (v[k] != std::floor(v[k]) || v[k] < (k == 0 ? 0 : 1) || v[k] > 1e6))
        refuse(k == 0 ? "a whole number, at least 0" : "a whole number, at least 1");
      if (!counted && k < 9 && !(v[k] > 0)) refuse("positive");
    }
    PileRecord r;
    r.run = static_cast<int>(v[0]);
    r.query = {v[1], v[2], v[3] * degree, v[4], static_cast<int>(v[5])};
    r.cell = v[6];
    r.height = v[7];
    r.length = v[8];
    r.head = v[9];
    r.tail = v[10];
    const auto [first, fresh] = panels.emplace(r.run, r.query);
    if (!fresh && !same_panel(first->second, r.query))
      throw Error(fmt::format("{}: row {}: run {} has another panel than before", file, row + 1, r.run));
    if (!seen.insert({r.run, r.query.event}).second)
      throw Error(fmt::format("{}: row {}: run {} has event {} twice", file, row + 1, r.run, r.query.event));
    piles.push_back(r);
  }
  return piles;
}

void write_pile_table(const PileTable& table, const std::string& file, const std::string& comment) {
  Table csv;
  csv.names.assign(names.begin(), names.end());
  csv.columns.resize(names.size());
  for (const PileRecord& record : table) {
    const auto numbers = numbers_of(record);
    for (std::size_t k = 0; k < numbers.size(); ++k) csv.columns[k].push_back(numbers[k]);
  }
  write_csv(csv, file, comment);
}

}  // namespace aeolian
