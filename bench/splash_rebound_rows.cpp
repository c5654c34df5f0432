#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "splash_rows.hpp"

#include "aeolian_core/grains/splash/rebound_model.hpp"
#include "aeolian_core/surface/degree.hpp"

namespace aeolian {
namespace {

constexpr int rays = 20000;
constexpr double curve = 0.005;  // R2

using Parameters = ReboundModel::Parameters;

ReboundModel::Means means(const Parameters& p, double angle, double slope = 0, double size = 1) {
  Impact impact{1, angle * degree};
  impact.slope = slope * degree;
  impact.size_ratio = size;
  return ReboundModel(p).means(impact, rays);
}

/// Targets have three decimals: the tolerance is not less than half of the last.
void curve_row(AccuracyTable& table, const std::string& what, double target, double ours) {
  if (std::abs(curve * target) >= 0.0005)
    table.relative_row(what, target, ours, curve);
  else
    table.row(what, target, ours, 0.0005);
}

void contact_angles(AccuracyTable& table) {
  table.section("Mean contact angle of a close-packed row", "R1. 20 000 evenly spaced rays.");
  const std::array<std::array<double, 2>, 3> targets{{{15, 12.85}, {25, 10.91}, {70, 1.94}}};
  for (const auto& [angle, target] : targets)
    table.row(fmt::format("mean beta at {:g} degrees", angle), target,
              means(ReboundModel::thesis_case(1), angle).contact_angle / degree, 0.05);
}

void angle_curves(AccuracyTable& table) {
  struct Point {
    double angle, upward, along, from_vertical;
  };
  const std::vector<Point> one{{5, 2.365, .932, 77.3},  {8, 1.663, .901, 75.2}, {10, 1.387, .883, 74.2},
                               {12, 1.186, .866, 73.3}, {15, .969, .843, 72.3}, {20, .730, .811, 71.0},
                               {25, .576, .785, 70.0},  {30, .467, .764, 69.2}, {40, .326, .733, 67.8},
                               {50, .235, .709, 65.8},  {60, .168, .684, 58.7}, {70, .122, .657, 38.7},
                               {80, .100, .641, 19.1}};
  const std::vector<Point> two{{10, 1.399, .642, 68.5}, {12, 1.211, .627, 67.1}, {15, 1.005, .607, 65.3},
                               {20, .779, .581, 62.8},  {25, .631, .561, 60.7},  {30, .527, .546, 58.8},
                               {40, .393, .529, 54.9},  {50, .310, .519, 49.3},  {70, .212, .504, 28.0}};
  for (const int number : {1, 2}) {
    table.section(
        fmt::format("Rebound model, case {}, against the angle of impact", number),
        "R2. 20 000 evenly spaced rays; targets are printed with three decimals and tenths of a degree.");
    for (const Point& p : number == 1 ? one : two) {
      const auto m = means(ReboundModel::thesis_case(number), p.angle);
      curve_row(table, fmt::format("eps_iy at {:g} degrees", p.angle), p.upward, m.upward);
      curve_row(table, fmt::format("eps_ix at {:g} degrees", p.angle), p.along, m.along);
      table.relative_row(fmt::format("theta_i at {:g} degrees", p.angle), p.from_vertical,
                         m.from_vertical / degree, curve);
    }
  }
}

template <typename Change>
void variation(AccuracyTable& table, const std::string& name, const std::vector<double>& values,
               const std::vector<double>& targets, const Change& change) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    Parameters p = ReboundModel::thesis_case(1);
    double slope = 0, size = 1;
    change(p, values[i], slope, size);
    curve_row(table, fmt::format("{} {:g}", name, values[i]), targets[i], means(p, 15, slope, size).upward);
  }
}

void variations(AccuracyTable& table) {
  table.section("Rebound model, case 1 at 15 degrees with one thing changed: mean eps_iy", "R2.");
  variation(table, "m_i / m_beff", {0, .1, .25, .4, .5, .6, .75, 1},
            {1.820, 1.584, 1.304, 1.087, .969, .867, .739, .578},
            [](Parameters& p, double x, double&, double&) { p.mass = x > 0 ? 1 / x : 1e12; });
  const std::vector<double> sizes{.25, .5, .75, 1, 1.5, 2};
  const auto grows = [](double exponent) {
    return [=](Parameters& p, double x, double&, double& size) {
      p.mass_exponent = exponent;
      size = x;
    };
  };
  variation(table, "equal masses, r_i / r_b", sizes, {1.208, 1.123, 1.042, .969, .845, .746}, grows(0));
  variation(table, "discs of one density, r_i / r_b", sizes, {2.120, 1.752, 1.344, .969, .448, .392},
            grows(2));
  variation(table, "spheres of one density, r_i / r_b", sizes, {2.189, 1.903, 1.466, .969, .351, 0},
            grows(3));
  variation(table, "gap / r_b", {0, .25, .5, 1, 1.5, 2}, {.969, 1.034, 1.090, 1.179, 1.242, 1.283},
            [](Parameters& p, double x, double&, double&) { p.gap = x; });
  variation(table, "sigma", {-1, -.5, 0, .5, 1}, {.601, .680, .767, .863, .969},
            [](Parameters& p, double x, double&, double&) { p.friction_restitution = x; });
  variation(table, "sigma 0, spin", {-1, -.5, 0, .5, 1}, {1.008, .887, .767, .648, .528},
            [](Parameters& p, double x, double&, double&) {
              p.friction_restitution = 0;
              p.spin = x;
            });
  variation(table, "slope, degrees", {0, 5, 10, 15, 20, 30, 40, 50, 60, 70},
            {.969, 1.218, 1.403, 1.533, 1.615, 1.638, 1.476, 1.156, .764, .327},
            [](Parameters&, double x, double& slope, double&) { slope = x; });
}

void distribution(AccuracyTable& table) {
  table.section("Rebound model, case 1 at 15 degrees: distribution of eps_iy",
                "Probabilities per 0.1 from 0; targets have three decimals.");
  const ReboundModel model(ReboundModel::thesis_case(1));
  std::vector<double> all;
  double sum = 0, squares = 0, second = 0;
  for (int i = 0; i < rays; ++i) {
    const auto bounce = model.bounce(15 * degree, 1, (i + 0.5) / rays);
    all.push_back(bounce.velocity.y() / std::sin(15 * degree));
    sum += all.back();
    squares += all.back() * all.back();
    second += bounce.collisions == 2 ? 1 : 0;
  }
  std::sort(all.begin(), all.end());
  const std::array<double, 15> targets{.025, .028, .032, .036, .040, .045, .050, .056,
                                       .063, .071, .082, .095, .114, .143, .120};
  const auto below = [&](double x) {
    return static_cast<double>(std::lower_bound(all.begin(), all.end(), x) - all.begin()) / rays;
  };
  for (std::size_t i = 0; i < targets.size(); ++i)
    table.row(fmt::format("from {:.1f}", 0.1 * static_cast<double>(i)), targets[i],
              below(0.1 * static_cast<double>(i + 1)) - below(0.1 * static_cast<double>(i)), 0.001);
  table.row("P(eps_iy < 1)", 0.446, below(1), 0.002);
  table.row("median", 1.068, all[rays / 2], 0.002);
  table.row("standard deviation", 0.397, std::sqrt(squares / rays - sum * sum / rays / rays), 0.002);
  table.row("largest", 1.467, all.back(), 0.002);
  table.row("share of rays with a second collision", 0.116, second / rays, 0.001);
  Parameters once = ReboundModel::thesis_case(1);
  once.most_collisions = 1;
  table.relative_row("mean eps_iy without second collisions", 0.842, means(once, 15).upward, curve);
  table.row("share with a second collision at 70 degrees", 0.42,
            means(ReboundModel::thesis_case(1), 70).twice, 0.005);
}

void statements(AccuracyTable& table) {
  table.section("What the thesis says of the rebound model", "");
  const Parameters one = ReboundModel::thesis_case(1);
  const auto upward = [&](double angle) { return means(one, angle).upward; };
  double low = 10, high = 20;
  for (int i = 0; i < 30; ++i) (upward((low + high) / 2) > 1 ? low : high) = (low + high) / 2;
  table.row("eps_iy falls through 1 at, degrees", 14.5, low, 0.1);
  const double ten = means(one, 10).from_vertical / degree, twenty = means(one, 20).from_vertical / degree;
  table.statement(
      "eps_iy varies fast from 10 to 20 degrees, the outgoing angle hardly",
      fmt::format("{:.2f} to {:.2f}; {:.1f} to {:.1f} degrees", upward(10), upward(20), ten, twenty),
      upward(10) > 1.5 * upward(20) && ten - twenty < 5);
  Parameters changed = one;
  changed.friction_restitution = 0;
  const double rough = means(changed, 15).upward;
  changed.spin = -0.5;
  const double rolling = means(changed, 15).upward;
  table.statement("eps_iy falls when sigma < 1, rises for a spin of the rolling sense",
                  fmt::format("{:.3f} to {:.3f} to {:.3f}", upward(15), rough, rolling),
                  rough < upward(15) && rolling > rough);
  table.statement("eps_iy rises with the slope up to repose, so rebounds do not limit stoss slopes",
                  fmt::format("{:.2f} to {:.2f} at 30 degrees", upward(15), means(one, 15, 30).upward),
                  means(one, 15, 30).upward > upward(15));
  table.section("Case 2 against the simulations of discs, cases A to C",
                "R3. Tolerance: half-widths of table 3.2.");
  const std::array<std::array<double, 5>, 3> simulated{
      {{15, 1.12, .29, .59, .08}, {25, .68, .22, .53, .16}, {70, .25, .07, .54, .64}}};
  for (const auto& [angle, up, up_width, along, along_width] : simulated) {
    const auto m = means(ReboundModel::thesis_case(2), angle);
    table.row(fmt::format("eps_iy at {:g} degrees", angle), up, m.upward, up_width);
    table.row(fmt::format("eps_ix at {:g} degrees", angle), along, m.along, along_width);
  }
}

}  // namespace

void rebound_rows(AccuracyTable& table) {
  contact_angles(table);
  angle_curves(table);
  variations(table);
  distribution(table);
  statements(table);
}

}  // namespace aeolian
