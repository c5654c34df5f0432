#include "aeolian_core/twin/forecast_spread.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/bedforms/height_map/ripple_growth.hpp"
#include "aeolian_core/surface/resample.hpp"

namespace aeolian {
namespace {

constexpr double share_of_change = 0.7;  // see BorderError
constexpr double hops = 2;

/// Of the known cells [m].
double rms_change(const HeightMap& map) {
  const HeightMap::Layer& now = map.layer(layer::elevation);
  const HeightMap::Layer& then = map.layer(layer::initial);
  double square = 0;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (std::isfinite(now[i]))
      square += std::pow(static_cast<double>(now[i]) - static_cast<double>(then[i]), 2);
  return std::sqrt(square / static_cast<double>(std::max<std::size_t>(1, count_known(now))));
}

/// Of the members at each cell; unknown where one of them is.
HeightMap::Layer scatter(const std::vector<const HeightMap::Layer*>& members) {
  const auto count = static_cast<double>(members.size());
  HeightMap::Layer result(members.front()->size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double first = (*members.front())[i];
    double sum = 0;
    double square = 0;
    for (const HeightMap::Layer* member : members) {
      const double off = (*member)[i] - first;
      sum += off;
      square += off * off;
    }
    result[i] = static_cast<float>(std::max(0.0, square - sum * sum / count) / std::max(1.0, count - 1));
  }
  return result;
}

}  // namespace

double BorderError::at(const GridGeometry& g, double x, double y) const {
  if (!(error > 0)) return 0;
  // Upwind to the border along each axis.
  const double east = std::cos(direction);
  const double north = std::sin(direction);
  const double from_x = east > 0 ? x - g.origin_x() : g.origin_x() + g.length_x() - x;
  const double from_y = north > 0 ? y - g.origin_y() : g.origin_y() + g.length_y() - y;
  const double away = std::min(from_x / std::abs(east), from_y / std::abs(north)) / reach;
  return error * std::exp(-away * away);
}

BorderError border_error(const Forecast& forecast, const Forcing& forcing, double hop_shortening,
                         double slope_effect) {
  if (!(forecast.volume.moved > 0)) return {};
  const FastestGrowth growth = fastest_growth(forcing, hop_shortening, slope_effect);
  return {forcing.direction, hops * forcing.reptation_length + growth.speed * forecast.lead_time,
          share_of_change * rms_change(forecast.map)};
}

HeightMap::Layer spread_of(const std::vector<const HeightMap::Layer*>& members, const GridGeometry& geometry,
                           double model_error, const BorderError& border, const HeightMap& start) {
  HeightMap variance(geometry);
  HeightMap::Layer& coarse = variance.add(layer::variance, filled(geometry, scatter(members)));
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    const CellIndex cell = geometry.cell_at(i);
    const double at_border = border.at(geometry, geometry.x(cell.x), geometry.y(cell.y));
    coarse[i] += static_cast<float>(model_error * model_error + at_border * at_border);
  }
  if (geometry != start.geometry()) variance = resample(variance, start.geometry());
  HeightMap::Layer spread = variance.layer(layer::variance);
  const HeightMap::Layer& elevation = start.layer(layer::elevation);
  for (std::size_t i = 0; i < spread.size(); ++i)
    spread[i] = std::isfinite(elevation[i]) ? std::sqrt(spread[i]) : HeightMap::unknown;
  return spread;
}

}  // namespace aeolian
