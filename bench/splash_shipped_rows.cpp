// The tables that ship, beside experiments on beads and sand (splash specification, sec. 7).

#include <cmath>

#include "splash_rows.hpp"
#include "splash_sample.hpp"

#include "aeolian_core/grains/splash/coarse_sand.hpp"
#include "aeolian_core/grains/splash/splash_table.hpp"
#include "aeolian_core/surface/degree.hpp"

namespace aeolian {
namespace {

struct Means {
  Sample ratio, upward, ejecta_speed;
  double share = 1;  ///< drawn events over those that the node has
  double error(const Sample& sample) const { return sample.deviation() * std::sqrt(share / sample.count()); }
};

/// At a node of speed and angle, over all roughnesses.
Means measure(const SplashTable& table, double speed, double angle_deg) {
  constexpr int draws = 4000;
  Means means;
  RandomStream random(1, 0);
  for (const double roughness : table.axis(SplashTable::roughness))
    for (int i = 0; i < draws; ++i) {
      const SplashTable::Event event = table.draw({speed, angle_deg * degree, 1, roughness}, random);
      if (!event.captured) {
        means.ratio.add(
            std::sqrt(event.along * event.along + event.across * event.across + event.away * event.away));
        means.upward.add(event.away / std::sin(angle_deg * degree));
      }
      for (const auto* grain = event.first; grain != event.last; ++grain)
        means.ejecta_speed.add(std::sqrt(grain->along * grain->along + grain->across * grain->across +
                                         grain->away * grain->away));
    }
  double nodes = 1;
  for (const auto axis :
       {SplashTable::speed, SplashTable::angle, SplashTable::size_ratio, SplashTable::roughness})
    nodes *= static_cast<double>(table.axis(axis).size());
  const double roughnesses = static_cast<double>(table.axis(SplashTable::roughness).size());
  means.share = draws * roughnesses / (static_cast<double>(table.events()) * roughnesses / nodes);
  return means;
}

double mean_number(const SplashTable& table, double speed, double angle_deg) {
  double sum = 0;
  const auto& roughnesses = table.axis(SplashTable::roughness);
  for (const double roughness : roughnesses)
    sum += table.mean_number({speed, angle_deg * degree, 1, roughness});
  return sum / static_cast<double>(roughnesses.size());
}

/// The straight line through the mean numbers: where it is zero, and which part of their variance it leaves.
struct Line {
  double zero, unexplained;
};

Line line_through(const SplashTable& table, double angle_deg, double slowest) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (const double speed : table.axis(SplashTable::speed)) {
    if (speed < slowest) continue;
    const double number = mean_number(table, speed, angle_deg);
    n += 1, x += speed, y += number, xx += speed * speed, xy += speed * number, yy += number * number;
  }
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  const double offset = (y - slope * x) / n;
  return {-offset / slope, 1 - (n * xy - x * y) * (n * xy - x * y) / ((n * xx - x * x) * (n * yy - y * y))};
}

SplashTable shipped(const std::string& name) {
  return SplashTable::read(std::string(AEOLIAN_REPOSITORY) + "/config/splash/tables/" + name + ".csv");
}

}  // namespace

void shipped_rows(AccuracyTable& table) {
  const SplashTable fine = shipped("fine_sand");
  table.section("The table of fine sand: spheres, beside experiments",
                "`config/splash/tables/fine_sand.csv` at its nodes, over both roughnesses, against Beladjine "
                "et al. (2007): beads of 6 mm, "
                "rebound speed 0.87 - 0.72 sin(angle), upward 0.30 / sin(angle) - 0.15, ejecta at 1.2 (v / "
                "sqrt(g d))^(1/4) sqrt(g d), their "
                "number 13 (1 - e^2) (v / (40 sqrt(g d)) - 1). Natural sand throws up about a third of that "
                "number (specification, sec. 7).");
  for (const double angle : fine.axis(SplashTable::angle)) {
    const double deg = std::round(angle / degree);
    const Means means = measure(fine, 90, deg);
    table.row(fmt::format("rebound speed over impact's, {:g} degrees", deg), 0.87 - 0.72 * std::sin(angle),
              means.ratio.mean(), 0.15, means.error(means.ratio));
    table.relative_row(fmt::format("upward speed over impact's, {:g} degrees", deg),
                       0.30 / std::sin(angle) - 0.15, means.upward.mean(), 0.3, means.error(means.upward));
    table.relative_row(fmt::format("ejecta speed over sqrt(g d), {:g} degrees, v = 90 sqrt(g d)", deg),
                       1.2 * std::pow(90., 0.25), means.ejecta_speed.mean(), 0.5,
                       means.error(means.ejecta_speed));
    const Line line = line_through(fine, deg, 40);
    table.range_row(
        fmt::format(
            "number of ejecta from 50 sqrt(g d) on, {:g} degrees: part of its variance that no line explains",
            deg),
        0, 0.03, line.unexplained);
    table.range_row(fmt::format("where that line is zero, {:g} degrees [sqrt(g d)] (beads 40, sand 39)", deg),
                    20, 60, line.zero);
    const double e = 0.87 - 0.72 * std::sin(angle);
    table.remark(fmt::format("ejecta at 90 sqrt(g d), {:g} degrees, against beads", deg),
                 13 * (1 - e * e) * (90. / 40 - 1), mean_number(fine, 90, deg));
  }
  double last = 1;
  bool falls = true;
  std::string values;
  for (const double angle : fine.axis(SplashTable::angle)) {
    const double e = measure(fine, 90, std::round(angle / degree)).ratio.mean();
    falls = falls && e < last;
    last = e;
    values += (values.empty() ? "" : ", ") + fmt::format("{:.2f}", e);
  }
  table.statement("rebound speed falls with the angle", values, falls);
  const Means rice = measure(fine, 77, 10.5);
  table.row("fine sand of Rice et al. (1995), 3.8 m/s, 10.5 degrees: rebound speed", 0.55, rice.ratio.mean(),
            0.1, rice.error(rice.ratio));
  table.remark("the same: number of ejecta", 1.7, mean_number(fine, 77, 10.5));
  table.remark("the same: ejecta speed [m/s]", 0.27, std::sqrt(gravity * 0.00025) * rice.ejecta_speed.mean(),
               std::sqrt(gravity * 0.00025) * rice.error(rice.ejecta_speed));

  const SplashTable coarse = shipped("coarse_sand");
  table.section("The table of coarse sand: number of ejecta calibrated to the experiment",
                fmt::format("`config/splash/tables/coarse_sand.csv`, of whose ejecta {:.2f} are kept, "
                            "against table 3.12 of the thesis.",
                            coarse.source().ejecta_kept));
  for (const double speed : {90., 140.})
    for (const double deg : {10., 20.})
      table.relative_row(fmt::format("ejecta at {:g} sqrt(g d), {:g} degrees", speed, deg),
                         CoarseSandSettings::instance().mean_number(speed, deg * degree),
                         mean_number(coarse, speed, deg), 0.35);
}

}  // namespace aeolian
