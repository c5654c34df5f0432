#include "aeolian_core/measure/crest_links.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace aeolian {
namespace {

constexpr double steepest_crest = 1.75;  ///< samples from row to row: 60 degrees

/// A line that may go on.
struct OpenLine {
  std::size_t line = 0;
  int row = 0;
  double place = 0;
  double drift = 0;  ///< per row, as of late
  double expected(int at) const { return place + drift * (at - row); }
};

/// Number of the value nearest to one, of rising values.
std::optional<std::size_t> nearest(const std::vector<double>& values, double to) {
  if (values.empty()) return std::nullopt;
  const auto above = std::lower_bound(values.begin(), values.end(), to);
  if (above == values.begin()) return 0;
  const auto at = static_cast<std::size_t>(above - values.begin());
  if (above == values.end() || to - values[at - 1] <= *above - to) return at - 1;
  return at;
}

}  // namespace

std::vector<std::vector<RowPlace>> link_rows(const std::vector<std::vector<RowCrest>>& rows,
                                             double wavelength, int gap) {
  const double memory = std::max(2.0, wavelength / 8);  // rows over which a line's drift is averaged
  std::vector<std::vector<RowPlace>> lines;
  std::vector<OpenLine> open;
  for (int row = 0; row < static_cast<int>(rows.size()); ++row) {
    const std::vector<RowCrest>& crests = rows[static_cast<std::size_t>(row)];
    open.erase(std::remove_if(open.begin(), open.end(),
                              [&](const OpenLine& line) { return row - line.row > gap + 1; }),
               open.end());
    std::sort(open.begin(), open.end(),
              [&](const OpenLine& a, const OpenLine& b) { return a.expected(row) < b.expected(row); });
    std::vector<double> expected;
    expected.reserve(open.size());
    for (const OpenLine& line : open) expected.push_back(line.expected(row));
    std::vector<double> places;
    places.reserve(crests.size());
    for (const RowCrest& crest : crests) places.push_back(static_cast<double>(crest.place));

    for (std::size_t c = 0; c < crests.size(); ++c) {
      const auto line = nearest(expected, places[c]);
      const double reach = line ? std::clamp(1 + steepest_crest * (row - open[*line].row), 0.15 * wavelength,
                                             std::max(0.25 * wavelength, 1.0))
                                : 0;
      const RowPlace here{row, static_cast<int>(c)};
      if (line && nearest(places, expected[*line]) == c && std::abs(expected[*line] - places[c]) <= reach) {
        OpenLine& on = open[*line];
        const double drift =
            std::clamp((places[c] - on.place) / (row - on.row), -steepest_crest, steepest_crest);
        on.drift += (drift - on.drift) / memory;
        on.place = places[c];
        on.row = row;
        lines[on.line].push_back(here);
      } else {
        open.push_back({lines.size(), row, places[c], 0});
        lines.push_back({here});
      }
    }
  }
  return lines;
}

std::vector<std::vector<RowPlace>> join_facing(const std::vector<std::vector<RowCrest>>& rows,
                                               const std::vector<std::vector<RowPlace>>& lines,
                                               double distance) {
  constexpr auto nobody = std::numeric_limits<std::size_t>::max();
  const auto x = [&](RowPlace p) {
    return static_cast<double>(
        rows[static_cast<std::size_t>(p.row)][static_cast<std::size_t>(p.crest)].place);
  };
  const auto apart = [&](std::size_t a, std::size_t b) {
    const RowPlace end = lines[a].back();
    const RowPlace start = lines[b].front();
    // A line that begins beside the other's middle is a neighbour.
    if (a == b || start.row <= lines[a].front().row || end.row >= lines[b].back().row) return distance;
    // Sideways counts twice: what goes on beside an end is another crest.
    return std::hypot(2 * (x(end) - x(start)), end.row - start.row);
  };
  std::vector<std::size_t> next(lines.size(), nobody);
  std::vector<std::size_t> before(lines.size(), nobody);
  for (std::size_t a = 0; a < lines.size(); ++a) {
    double least = distance;
    for (std::size_t b = 0; b < lines.size(); ++b)
      if (apart(a, b) < least) {
        least = apart(a, b);
        next[a] = b;
      }
  }
  for (std::size_t b = 0; b < lines.size(); ++b) {
    double least = distance;
    for (std::size_t a = 0; a < lines.size(); ++a)
      if (apart(a, b) < least) {
        least = apart(a, b);
        before[b] = a;
      }
  }
  std::vector<std::vector<RowPlace>> joined;
  for (std::size_t start = 0; start < lines.size(); ++start) {
    const std::size_t earlier = before[start];
    if (earlier != nobody && next[earlier] == start) continue;
    joined.push_back(lines[start]);
    for (std::size_t at = start; next[at] != nobody && before[next[at]] == at;) {
      at = next[at];
      const int last = joined.back().back().row;
      for (const RowPlace& p : lines[at])
        if (p.row > last) joined.back().push_back(p);
    }
  }
  return joined;
}

}  // namespace aeolian
