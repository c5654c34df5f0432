#include "aeolian_core/slide/surrogate/pile_design.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

/// 0 to runs - 1 in an order of its own for each dimension.
std::vector<int> shuffled(int runs, RandomStream& random) {
  std::vector<int> order(static_cast<std::size_t>(runs));
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t k = order.size(); k > 1; --k) {
    const auto other = static_cast<std::size_t>(random.uniform() * static_cast<double>(k));
    std::swap(order[k - 1], order[other]);
  }
  return order;
}

double between(const Range& range, double share) { return range.low + share * (range.high - range.low); }

}  // namespace

std::vector<PileQuery> panels_of(const PileDesign& design) {
  struct Dimension {
    Range range;
    double PileQuery::*number;
    const char* name;
  };
  const std::array<Dimension, 4> all{Dimension{design.panel_length, &PileQuery::panel_length, "panel length"},
                                     Dimension{design.panel_height, &PileQuery::panel_height, "panel height"},
                                     Dimension{design.tilt, &PileQuery::tilt, "tilt"},
                                     Dimension{design.thickness, &PileQuery::thickness, "thickness"}};
  PileQuery middle;
  std::vector<Dimension> varied;
  for (const Dimension& d : all) {
    if (!(d.range.low > 0 && d.range.high >= d.range.low && std::isfinite(d.range.high)))
      throw Error(fmt::format("table of piles: {} is from {:g} to {:g}, must rise from above 0", d.name,
                              d.range.low, d.range.high));
    middle.*d.number = d.range.low;
    if (d.range.high > d.range.low) varied.push_back(d);
  }
  const int corners = 1 << varied.size();
  if (design.runs < corners)
    throw Error(fmt::format("table of piles: runs is {}, must be at least {}: the corners of the ranges",
                            design.runs, corners));
  std::vector<PileQuery> panels(static_cast<std::size_t>(design.runs), middle);
  const int rest = design.runs - corners;
  for (std::size_t d = 0; d < varied.size(); ++d) {
    const Dimension& dimension = varied[d];
    const auto put = [&](std::size_t run, double share) {
      const bool logarithmic = dimension.number == &PileQuery::panel_length;
      const Range& r = dimension.range;
      // Ends as they are, not as logarithms bring them back.
      panels[run].*dimension.number =
          share == 0   ? r.low
          : share == 1 ? r.high
                       : (logarithmic ? std::exp(between({std::log(r.low), std::log(r.high)}, share))
                                      : between(r, share));
    };
    for (int corner = 0; corner < corners; ++corner)
      put(static_cast<std::size_t>(corner), (corner >> d & 1) != 0 ? 1 : 0);
    RandomStream random(design.seed, d);
    const std::vector<int> order = shuffled(rest, random);
    for (int k = 0; k < rest; ++k)
      put(static_cast<std::size_t>(corners + k),
          (order[static_cast<std::size_t>(k)] + random.uniform()) / rest);
  }
  return panels;
}

}  // namespace aeolian
