#include <algorithm>
#include <cmath>

#include "aeolian_core/grains/splash/coarse_sand.hpp"
#include "aeolian_core/surface/degree.hpp"

namespace aeolian {
namespace {

constexpr std::size_t speeds = 6;

/// A direction is kept this near to the vertical: ejecta further over were seen as rebounds or not at all.
constexpr double widest_direction = 75 * degree;

/// sqrt(g d) of the experiment [cm/s].
double unit() { return 100 * std::sqrt(gravity * coarse_sand_diameter); }

/// Of eps_iy with the angle (specification, sec. 5.7).
double upward_fit(double angle) { return std::max(0.0, 0.266 / std::sin(angle) - 0.262); }

using Spread = CoarseSandRow::Spread;

Spread between(const Spread& a, const Spread& b, double share) {
  return {a.mean + share * (b.mean - a.mean), a.half_width + share * (b.half_width - a.half_width)};
}

/// `spread` of a setting at 15 degrees, changed as `there` differs from `here`, the settings of one speed at
/// another angle and at 15 degrees.
Spread changed(const Spread& spread, const Spread& here, const Spread& there) {
  return {spread.mean * there.mean / here.mean, spread.half_width * there.half_width / here.half_width};
}

/// The setting at 15 degrees at any speed within those measured.
CoarseSandRow at_fifteen(double speed) {
  const auto& rows = coarse_sand_rows();
  std::size_t i = 0;
  while (i + 2 < speeds && rows[i + 1].speed < speed) ++i;
  const double share = (speed - rows[i].speed) / (rows[i + 1].speed - rows[i].speed);
  CoarseSandRow row = rows[i];
  row.along = between(rows[i].along, rows[i + 1].along, share);
  row.upward = between(rows[i].upward, rows[i + 1].upward, share);
  row.number = between(rows[i].number, rows[i + 1].number, share);
  row.ejecta_up = between(rows[i].ejecta_up, rows[i + 1].ejecta_up, share);
  row.direction = between(rows[i].direction, rows[i + 1].direction, share);
  row.reptation += share * (rows[i + 1].reptation - rows[i].reptation);
  return row;
}

/// Mean of upward speed squared times the tangent of the direction, for this correlation of both: what the
/// reptation of a grain is proportional to. Over normal numbers in steps of 0.2.
double mean_hop(const LogNormal& up, const TruncatedNormal& direction, double correlation) {
  constexpr int steps = 20;  // to each side
  constexpr double step = 0.2;
  const double rest = std::sqrt(1 - correlation * correlation);
  double sum = 0, weights = 0;
  for (int i = -steps; i <= steps; ++i) {
    const double z = step * i;
    const double square = up.at(z) * up.at(z);
    for (int k = -steps; k <= steps; ++k) {
      const double y = step * k;
      const double angle = direction.middle() + direction.width() * (correlation * z + rest * y);
      if (std::abs(angle) > widest_direction) continue;
      const double weight = std::exp(-(z * z + y * y) / 2);
      weights += weight;
      sum += weight * square * std::tan(angle);
    }
  }
  return sum / weights;
}

/// The correlation that gives ejecta this mean reptation [cm]; the hop grows with it.
double correlation_for(const LogNormal& up, const TruncatedNormal& direction, double reptation) {
  const double wanted = reptation / (2 * coarse_sand_diameter * 100);
  double low = -0.95, high = 0.95;
  for (int i = 0; i < 12; ++i) {
    const double middle = (low + high) / 2;
    (mean_hop(up, direction, middle) < wanted ? low : high) = middle;
  }
  return (low + high) / 2;
}

CoarseSandSettings::Node node_of(const CoarseSandRow& row, double angle) {
  const double highest = 0.98 / std::sin(angle);
  const LogNormal up(row.ejecta_up.mean / unit(), row.ejecta_up.half_width / unit());
  const TruncatedNormal direction(row.direction.mean * degree, row.direction.half_width * degree,
                                  -widest_direction, widest_direction);
  return {TruncatedNormal(row.along.mean, row.along.half_width, -0.98, 0.98),
          TruncatedNormal(row.upward.mean, row.upward.half_width, 0, highest),
          CountDistribution(row.number.mean, row.number.half_width),
          up,
          direction,
          correlation_for(up, direction, row.reptation),
          row.number.mean};
}

}  // namespace

const std::array<CoarseSandRow, 9>& coarse_sand_rows() {
  static const std::array<CoarseSandRow, 9> rows{{
      {650, 15, 12, 33, {.58, .13}, {.80, .43}, {2.8, 1.1}, {48, 28}, {34, 17}, .42, 4.3},
      {760, 16, 22, 51, {.55, .24}, {.71, .36}, {2.3, 1.8}, {50, 28}, {27, 18}, .40, 4.4},
      {910, 16, 20, 81, {.48, .27}, {.72, .36}, {4.1, 2.6}, {49, 29}, {23, 26}, .36, 4.2},
      {1000, 15, 18, 90, {.49, .25}, {.74, .30}, {5.0, 2.1}, {49, 34}, {19, 22}, .36, 4.1},
      {1100, 15, 18, 102, {.54, .25}, {.68, .31}, {5.7, 3.1}, {58, 46}, {17, 24}, .42, 4.7},
      {1200, 16, 19, 109, {.58, .17}, {.86, .36}, {5.7, 3.2}, {54, 37}, {17, 27}, .43, 3.8},
      {880, 12, 17, 50, {.61, .17}, {.94, .46}, {2.9, 2.4}, {64, 42}, {18, 23}, .47, 6.9},
      {1200, 10, 12, 59, {.61, .17}, {1.27, .48}, {4.9, 2.4}, {72, 57}, {20, 22}, .49, 8.7},
      {920, 21, 17, 80, {.50, .18}, {.48, .24}, {4.7, 2.2}, {59, 38}, {22, 24}, .35, 7.9},
  }};
  return rows;
}

const CoarseSandSettings& CoarseSandSettings::instance() {
  static const CoarseSandSettings settings;
  return settings;
}

CoarseSandSettings::CoarseSandSettings()
    : angles_{10 * degree, 12 * degree, 15 * degree, 16 * degree, 21 * degree} {
  const auto& rows = coarse_sand_rows();
  for (std::size_t i = 0; i < speeds; ++i) {
    speeds_[i] = rows[i].speed / unit();
    nodes_[2 * speeds + i] = node_of(rows[i], rows[i].angle * degree);
  }
  const struct { std::size_t node, row; } others[] = {{0, 7}, {1, 6}, {3, 8}};
  for (const auto& other : others) {
    const CoarseSandRow& there = rows[other.row];
    const CoarseSandRow here = at_fifteen(there.speed);
    for (std::size_t i = 0; i < speeds; ++i) {
      CoarseSandRow row = rows[i];
      row.along = changed(row.along, here.along, there.along);
      row.upward = changed(row.upward, here.upward, there.upward);
      row.number = changed(row.number, here.number, there.number);
      row.ejecta_up = changed(row.ejecta_up, here.ejecta_up, there.ejecta_up);
      row.direction = changed(row.direction, here.direction, there.direction);
      row.reptation *= there.reptation / here.reptation;
      nodes_[other.node * speeds + i] = node_of(row, there.angle * degree);
    }
  }
}

CoarseSandSettings::Node::Ejectum CoarseSandSettings::Node::draw_ejectum(RandomStream& random) const {
  const double rest = std::sqrt(1 - correlation * correlation);
  for (;;) {
    const double z = draw_normal(random);
    const double angle =
        direction.middle() + direction.width() * (correlation * z + rest * draw_normal(random));
    if (std::abs(angle) <= widest_direction) return {ejecta_up.at(z), angle};
  }
}

CoarseSandSettings::Interval CoarseSandSettings::speed_interval(double speed) const {
  if (speed <= speeds_.front()) return {0, 0};
  if (speed >= speeds_.back()) return {speeds - 1, 0};
  std::size_t i = 0;
  while (speeds_[i + 1] < speed) ++i;
  return {i, (speed - speeds_[i]) / (speeds_[i + 1] - speeds_[i])};
}

// Angles 15 and 16 degrees share their nodes.
CoarseSandSettings::Interval CoarseSandSettings::angle_interval(double angle) const {
  if (angle <= angles_[0]) return {0, 0};
  if (angle >= angles_[4]) return {3, 0};
  if (angle < angles_[1]) return {0, (angle - angles_[0]) / (angles_[1] - angles_[0])};
  if (angle < angles_[2]) return {1, (angle - angles_[1]) / (angles_[2] - angles_[1])};
  if (angle <= angles_[3]) return {2, 0};
  return {2, (angle - angles_[3]) / (angles_[4] - angles_[3])};
}

CoarseSandSettings::Place CoarseSandSettings::choose(double speed, double angle, RandomStream& random) const {
  const Interval by_speed = speed_interval(speed);
  const Interval by_angle = angle_interval(angle);
  std::size_t node = by_angle.low * speeds + by_speed.low;
  if (by_speed.share > 0 && random.uniform() < by_speed.share) ++node;
  if (by_angle.share > 0 && random.uniform() < by_angle.share) node += speeds;
  double factor = 1;
  if (angle < angles_.front()) factor = upward_fit(angle) / upward_fit(angles_.front());
  if (angle > angles_.back()) factor = upward_fit(angle) / upward_fit(angles_.back());
  return {node, factor};
}

double CoarseSandSettings::mean_number(double speed, double angle) const {
  const Interval by_speed = speed_interval(speed);
  const Interval by_angle = angle_interval(angle);
  const auto at = [&](std::size_t i) {
    const double low = nodes_[i].mean_number;
    return by_speed.share > 0 ? low + by_speed.share * (nodes_[i + 1].mean_number - low) : low;
  };
  const std::size_t node = by_angle.low * speeds + by_speed.low;
  const double low = at(node);
  return beyond(speed) * (by_angle.share > 0 ? low + by_angle.share * (at(node + speeds) - low) : low);
}

double CoarseSandSettings::beyond(double speed) const {
  const double threshold = 2.4 / 0.0070 / unit();
  const double nearest = std::clamp(speed, speeds_.front(), speeds_.back());
  return std::max(0.0, (speed - threshold) / (nearest - threshold));
}

}  // namespace aeolian
