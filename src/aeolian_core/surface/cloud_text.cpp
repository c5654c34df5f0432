#include "aeolian_core/surface/cloud_text.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/text.hpp"

namespace aeolian {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// The fields of a line, one after the other. A separator at its end is followed by an empty field.
class Fields {
 public:
  explicit Fields(std::string_view line) : rest_(line), more_(!line.empty()) {}

  bool more() const { return more_; }
  std::string_view take() {
    std::size_t end = 0;
    while (end < rest_.size() && !is_blank(rest_[end]) && rest_[end] != ',' && rest_[end] != ';') ++end;
    const std::string_view field = rest_.substr(0, end);
    while (end < rest_.size() && is_blank(rest_[end])) ++end;
    const bool separated = end < rest_.size() && (rest_[end] == ',' || rest_[end] == ';');
    if (separated) ++end;
    while (end < rest_.size() && is_blank(rest_[end])) ++end;
    rest_.remove_prefix(end);
    more_ = separated || !rest_.empty();
    return field;
  }

 private:
  std::string_view rest_;
  bool more_;
};

std::optional<std::size_t> axis_of(std::string_view name) {
  static const std::array<std::array<std::string_view, 4>, 3> known{{{"x", "x_m", "easting", "east"},
                                                                     {"y", "y_m", "northing", "north"},
                                                                     {"z", "z_m", "elevation", "height"}}};
  if (name.size() > 1 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
  const std::string lower = lower_case(name);
  for (std::size_t axis = 0; axis < known.size(); ++axis)
    if (std::find(known[axis].begin(), known[axis].end(), lower) != known[axis].end()) return axis;
  return std::nullopt;
}

/// The columns that a line of names gives; nothing when it does not name all three.
std::optional<CloudColumns> columns_named(std::string_view line) {
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  CloudColumns columns{none, none, none};
  Fields fields(line);
  for (std::size_t column = 0; fields.more(); ++column)
    if (const auto axis = axis_of(fields.take()); axis && columns[*axis] == none) columns[*axis] = column;
  if (std::find(columns.begin(), columns.end(), none) != columns.end()) return std::nullopt;
  return columns;
}

/// Reads the three columns of a line into `point`.
void parse_point(std::string_view line, const CloudColumns& columns, const std::string& path, int number,
                 std::array<double, 3>& point) {
  const std::size_t last = *std::max_element(columns.begin(), columns.end());
  const auto where = [&] { return "cloud '" + path + "', line " + std::to_string(number) + ": "; };
  Fields fields(line);
  for (std::size_t column = 0; column <= last; ++column) {
    if (!fields.more())
      throw Error(where() + "has " + std::to_string(column) + " fields, must have at least " +
                  std::to_string(last + 1));
    const std::string_view field = fields.take();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (columns[axis] != column) continue;
      const auto value = field.empty() ? std::numeric_limits<double>::quiet_NaN() : parse_number(field);
      if (!value) throw Error(where() + "'" + std::string(field) + "' is not a number");
      point[axis] = *value;
    }
  }
}

/// A line without blanks at its ends and without the sign of a comment, and whether it had one.
std::pair<std::string_view, bool> uncommented(std::string_view line) {
  line = trimmed(line);
  const bool comment = line.substr(0, 1) == "#" || line.substr(0, 2) == "//";
  if (comment) line.remove_prefix(std::min(line.find_first_not_of("#/"), line.size()));
  return {trimmed(line), comment};
}

Coordinates parse_points(std::string_view rest, int number, const CloudColumns& columns,
                         const std::string& path) {
  Coordinates points;
  std::array<double, 3> point{};
  for (; !rest.empty(); ++number) {
    const auto [line, comment] = uncommented(take_line(rest));
    if (comment || line.empty()) continue;
    parse_point(line, columns, path, number, point);
    points.x.push_back(point[0]);
    points.y.push_back(point[1]);
    points.z.push_back(point[2]);
  }
  return points;
}

}  // namespace

Coordinates read_cloud_text(const std::string& path) {
  const std::string text = read_text(path, "cloud");
  // Names of columns may stand in any line before the first with numbers.
  std::string_view rest = text;
  for (int number = 1; !rest.empty(); ++number) {
    const std::string_view from_here = rest;
    const auto [line, comment] = uncommented(take_line(rest));
    if (const auto named = columns_named(line)) return parse_points(rest, number + 1, *named, path);
    if (!comment && !line.empty()) return parse_points(from_here, number, {0, 1, 2}, path);
  }
  return {};
}

Coordinates read_cloud_columns(const std::string& path, std::size_t start, const CloudColumns& columns) {
  const std::string text = read_text(path, "cloud");
  const std::size_t body = std::min(start, text.size());
  const auto lines_before = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(body), '\n');
  return parse_points(std::string_view(text).substr(body), static_cast<int>(lines_before) + 1, columns, path);
}

}  // namespace aeolian
