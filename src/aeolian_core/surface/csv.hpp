#pragma once

#include <string>
#include <vector>

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// Columns of numbers with a name each.
struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;

  bool has(const std::string& name) const;
  /// Throws Error naming the column when it is absent.
  const std::vector<double>& column(const std::string& name) const;
  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
};

/// Reads a table whose first line names the columns; "#" starts a comment, empty fields and "nan" are NaN.
/// Throws Error naming file, line and field for anything that is not a number, and for rows of another
/// length.
Table read_csv(const std::string& path);
/// Writes a table, atomically, with the digits that read back to the same double; above it the comment, a
/// line, unless it is empty.
void write_csv(const Table& table, const std::string& path, const std::string& comment = "");

/// Writes a map as columns x_m,y_m and one column for each layer, known cells only, atomically.
void write_map_csv(const HeightMap& map, const std::string& path);

}  // namespace aeolian
