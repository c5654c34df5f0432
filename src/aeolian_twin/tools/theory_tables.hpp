#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "aeolian_core/surface/csv.hpp"
#include "aeolian_twin/photo/plot_panel.hpp"

namespace aeolian {

/// Columns that are filled row by row.
inline Table table_of(const std::vector<std::string>& names, const std::vector<std::vector<double>>& rows) {
  Table table{names, std::vector<std::vector<double>>(names.size())};
  for (const std::vector<double>& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) table.columns[i].push_back(row[i]);
  return table;
}

/// A gnuplot data block of a table; its columns are numbered from 1 there.
inline void write_block(std::ostream& out, const std::string& name, const Table& table) {
  out << '$' << name << " << EOD\n";
  for (std::size_t row = 0; row < table.rows(); ++row)
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      out << table.columns[i][row] << (i + 1 < table.columns.size() ? ' ' : '\n');
  out << "EOD\n";
}

inline std::string title(const std::string& text) {
  return "set label 1 " + quoted(text) + " at graph 0, graph 1.05 left textcolor rgb measured\n";
}

}  // namespace aeolian
