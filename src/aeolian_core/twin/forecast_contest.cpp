#include "aeolian_core/twin/forecast_contest.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace aeolian {
namespace {

constexpr double square_side = 0.05;  // of a square [m]
constexpr double fewest_squares = 8;

constexpr double square(double value) { return value * value; }

struct Square {
  double difference = 0;  ///< of square errors [m^2]
  double known = 0;
  double cells = 0;
};

std::vector<Square> squares_of(const HeightMap& first, const HeightMap& second, const HeightMap& measured) {
  const GridGeometry& g = measured.geometry();
  const int cells = std::max(1, static_cast<int>(std::lround(square_side / g.cell())));
  const int across = (g.nx() + cells - 1) / cells;
  const int up = (g.ny() + cells - 1) / cells;
  std::vector<Square> squares(static_cast<std::size_t>(across) * static_cast<std::size_t>(up));
  const HeightMap::Layer& one = first.layer(layer::elevation);
  const HeightMap::Layer& other = second.layer(layer::elevation);
  const HeightMap::Layer& truth = measured.layer(layer::elevation);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const CellIndex cell = g.cell_at(i);
    Square& at = squares[static_cast<std::size_t>(cell.y / cells) * static_cast<std::size_t>(across) +
                         static_cast<std::size_t>(cell.x / cells)];
    ++at.cells;
    if (!std::isfinite(truth[i]) || !std::isfinite(one[i]) || !std::isfinite(other[i])) continue;
    const double z = truth[i];
    at.difference += square(static_cast<double>(other[i]) - z) - square(static_cast<double>(one[i]) - z);
    ++at.known;
  }
  return squares;
}

}  // namespace

double advantage(const HeightMap& first, const HeightMap& second, const HeightMap& measured) {
  if (first.geometry() != measured.geometry() || second.geometry() != measured.geometry()) return 0;
  double count = 0;
  double sum = 0;
  double squares = 0;
  for (const Square& each : squares_of(first, second, measured)) {
    if (2 * each.known < each.cells) continue;
    const double mean = each.difference / each.known;
    sum += mean;
    squares += mean * mean;
    ++count;
  }
  if (count < fewest_squares) return 0;
  const double variance = std::max(0.0, squares - sum * sum / count) / (count - 1);
  return variance > 0 ? sum / count / std::sqrt(variance / count) : 0;
}

}  // namespace aeolian
