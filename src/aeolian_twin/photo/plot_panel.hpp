#pragma once

#include <string>
#include <vector>

namespace aeolian {

/// A range of an axis with some air at both ends.
struct PlotRange {
  double low = 0;
  double high = 1;
  double width() const { return high - low; }
};

/// The range of the finite values, widened by a share of itself on each side; never empty.
PlotRange range_of(const std::vector<double>& values, double air);

/// Text between gnuplot's single quotes.
std::string quoted(const std::string& text);

/// gnuplot's "set tmargin ..." for a panel between two heights and two sides of the picture (shares of it).
std::string panel_place(double left, double right, double top, double bottom);

}  // namespace aeolian
