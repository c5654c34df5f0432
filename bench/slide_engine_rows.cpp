#include <cmath>

#include "slide_rows.hpp"

#include "aeolian_core/slide/mpm/snow_body.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

using Points = std::vector<MaterialPoint<2>>;

Point<2> mean_velocity(const Points& points) {
  Point<2> momentum = Point<2>::Zero();
  double mass = 0;
  for (const auto& p : points) {
    momentum += p.mass * p.velocity;
    mass += p.mass;
  }
  return momentum / mass;
}

double kinetic(const Points& points) {
  double sum = 0;
  for (const auto& p : points) sum += 0.5 * p.mass * p.velocity.squaredNorm();
  return sum;
}

MpmSettings quiet_settings(Transfer transfer, double gravity) {
  MpmSettings settings;
  settings.threads = 1;
  settings.rest_speed = 0;
  settings.transfer = transfer;
  settings.gravity = gravity;
  return settings;
}

SnowLaw elastic() {
  SnowLaw law;
  law.yield = SnowLaw::Yield::none;
  return law;
}

void free_fall(AccuracyTable& table) {
  MaterialPoints<2> world(quiet_settings(Transfer::apic, 9.81), {});
  world.add(filled_box<2>({{0, 10}, Eigen::Matrix2d::Identity(), {0.05, 0.05}}, {}, 0.01, 4));
  world.advance(0.25);
  table.relative_row("free fall, speed after 0.25 s [m/s]", 9.81 * 0.25, -mean_velocity(world.points())[1],
                     1e-6);
}

void bar(AccuracyTable& table, Transfer transfer, const char* name) {
  SnowLaw law = elastic();
  law.poisson_ratio = 0;
  MaterialPoints<2> world(quiet_settings(transfer, 0), law);
  const double length = 0.5;
  auto points = filled_box<2>({Point<2>::Zero(), Eigen::Matrix2d::Identity(), {length, 0.04}}, law, 0.01, 4);
  const Points start = points;
  for (auto& p : points) p.velocity[0] = 0.05 * std::cos(M_PI * p.place[0] / length);
  world.add(points);
  double time = 0, zero = 0, last = 1;
  for (int crossings = 0; crossings < 3 && time < 1; time += 1e-4) {
    world.advance(1e-4);
    const auto now = world.points();
    double amplitude = 0;
    for (std::size_t k = 0; k < now.size(); ++k)
      amplitude += now[k].velocity[0] * std::cos(M_PI * start[k].place[0] / length);
    if (amplitude * last < 0) {
      ++crossings;
      zero = time + 1e-4 * last / (last - amplitude);
    }
    last = amplitude;
  }
  table.relative_row(fmt::format("period of an elastic bar, {} [s]", name),
                     2 * length / std::sqrt(law.youngs_modulus / law.density), zero / 1.25, 0.02);
}

void discs(AccuracyTable& table, Transfer transfer, const char* name) {
  const SnowLaw law = elastic();
  MaterialPoints<2> world(quiet_settings(transfer, 0), law);
  Points all;
  for (const double side : {-1., 1.})
    for (auto p : filled_box<2>({{-0.1, -0.1}, Eigen::Matrix2d::Identity(), {0.2, 0.2}}, law, 0.01, 4)) {
      if (p.place.norm() > 0.1) continue;
      p.place[0] += side * 0.13;
      p.velocity[0] = -side;
      all.push_back(p);
    }
  world.add(all);
  world.advance(0.12);
  const auto after = world.points();
  const Points left(after.begin(), after.begin() + static_cast<std::ptrdiff_t>(after.size() / 2));
  table.row(fmt::format("colliding discs, {}: momentum in all per mass [m/s]", name), 0,
            mean_velocity(after)[0], 1e-10);
  table.range_row(fmt::format("colliding discs, {}: speed of return over that of approach", name), 0.8, 1,
                  -mean_velocity(left)[0]);
  table.range_row(fmt::format("colliding discs, {}: kinetic energy kept", name), 0.75, 1,
                  kinetic(after) / kinetic(all));
}

double slope_acceleration(double degrees, double friction) {
  const SnowLaw law = elastic();
  const double angle = degrees * M_PI / 180;
  const Point<2> normal(std::sin(angle), std::cos(angle)), down(std::cos(angle), -std::sin(angle));
  const MpmSettings settings = quiet_settings(Transfer::apic, 9.81);
  MaterialPoints<2> world(settings, law,
                          {{std::make_shared<HalfSpace<2>>(Point<2>(0.003, 0), normal), Contact::separate,
                            friction, Point<2>::Zero()}});
  SnowBox<2> box;
  box.corner = Point<2>(0.003, 0) + 0.25 * settings.cell * normal;
  box.axes.col(0) = down;
  box.axes.col(1) = normal;
  box.size = {0.2, 0.04};
  world.add(filled_box(box, law, settings.cell, 4));
  world.advance(0.2);
  const double first = mean_velocity(world.points()).dot(down);
  world.advance(0.4);
  return (mean_velocity(world.points()).dot(down) - first) / 0.4;
}

}  // namespace

void slide_engine_rows(AccuracyTable& table) {
  table.section(
      "Solver",
      "Specification, section 5 F; two dimensions, cells of 1 cm. Mass to the bit, momentum without "
      "obstacles, partition of unity, rotation, compression and a million deformations are tests "
      "(`slide_test`), in two and three dimensions.");
  free_fall(table);
  bar(table, Transfer::apic, "APIC");
  bar(table, Transfer::flip, "FLIP 0.99");
  discs(table, Transfer::apic, "APIC");
  discs(table, Transfer::flip, "FLIP 0.99");
  for (const double friction : {0.3, 0.6, 0.75}) {
    const double angle = 40 * M_PI / 180;
    table.relative_row(fmt::format("block on 40 degrees, friction {:g}: acceleration [m/s²]", friction),
                       9.81 * (std::sin(angle) - friction * std::cos(angle)),
                       slope_acceleration(40, friction), 0.05);
  }
  table.row("block on 30 degrees, friction 0.7: acceleration [m/s²]", 0, slope_acceleration(30, 0.7), 0.01);
  MpmSettings settings;
  settings.time_step = 1.01 * MaterialPoints<2>(MpmSettings{}, {}).longest_step();
  std::string told = "accepted";
  try {
    MaterialPoints<2>(settings, {});
  } catch (const Error& error) {
    told = error.what();
  }
  table.statement("a step 1 % beyond the elastic limit is refused", told, told != "accepted");
}

}  // namespace aeolian
