#include <algorithm>
#include <cmath>

#include "../test/aeolian_core/wind/relief_worlds.hpp"
#include "wind_rows.hpp"

#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

void cylinder_rows(AccuracyTable& table) {
  table.section(
      "F7, F8: half-cylinder and hemisphere",
      "Mass-consistent wind, uniform upwind, against potential flow, in units of the upwind speed: greatest "
      "error further than a cell and a half from the ground, and speed at the crest.");
  const double a = 250;
  for (const double cell : {20.0, 10.0, 5.0}) {
    const HeightMap map = ridge(static_cast<int>(8 * a / cell), cell,
                                [&](double x) { return std::abs(x) < a ? std::sqrt(a * a - x * x) : 0; });
    const WindRelief relief = wind_relief(map, 0);
    for (const double angle : {0.0, M_PI}) {
      const MassConsistentVolume v(relief, angle, UpwindProfile::uniform(), {});
      double worst = 0;
      for (double z = 5; z < 500; z += 9)
        for (double x = -490; x < 500; x += 13) {
          const double r2 = x * x + z * z;
          if (std::sqrt(r2) < a + 1.5 * cell) continue;
          const AirVelocity wind = v.velocity(x, 0, z - v.grid().ground(x, 0) - relief.mean);
          const double sign = std::cos(angle);
          worst = std::max(worst, std::hypot(sign * wind.east - 1 + a * a * (x * x - z * z) / (r2 * r2),
                                             sign * wind.up + 2 * a * a * x * z / (r2 * r2)));
        }
      const std::string name = fmt::format("cells of a/{:g}, wind to {:g}°", a / cell, angle * 180 / M_PI);
      table.row("half-cylinder, error, " + name, 0, worst, 0.1);
      table.relative_row("half-cylinder, crest, " + name, 2, std::abs(v.velocity(0, 0, 0.01).east), 0.1);
    }
  }
  for (const int n : {48, 72}) {
    const HeightMap map = world(
        n, n, 600.0 / n, [](double x, double y) { return std::sqrt(std::max(0.0, 1e4 - x * x - y * y)); });
    for (const double angle : {0.0, M_PI / 4}) {
      const MassConsistentVolume v(wind_relief(map, 0), angle, UpwindProfile::uniform(), {});
      const AirVelocity crest = v.velocity(0, 0, 0.01);
      table.relative_row(
          fmt::format("hemisphere, crest, {} cells to its radius, wind to {:g}°", n / 6, angle * 180 / M_PI),
          1.5, std::hypot(crest.east, crest.north), 0.1);
    }
  }
}

void lift_rows(AccuracyTable& table) {
  table.section("C3: lift over waves", "Amplitude over U a k, a k = 0.05, uniform wind.");
  const double length = 64;
  const double k = 2 * M_PI / length;
  const WindRelief waves =
      wind_relief(ridge(1024, 1, [&](double x) { return 0.05 / k * std::cos(k * x); }), 0);
  const SpectralVolume linear(waves, 0, UpwindProfile::uniform(), attached, 60);
  const MassConsistentVolume boxes(waves, 0, UpwindProfile::uniform(), {});
  for (const double kz : {0.5, 1.0, 2.0}) {
    const auto amplitude = [&](const WindVolume& v) {
      double most = 0;
      for (double x = -length; x < length; x += 1)
        // The height over the middle plane.
        most = std::max(most, v.velocity(x, 0, kz / k - 0.05 / k * std::cos(k * x)).up / 0.05);
      return most;
    };
    table.relative_row(fmt::format("spectral, k z = {:g}", kz), std::exp(-kz), amplitude(linear), 0.1);
    table.relative_row(fmt::format("mass consistent, k z = {:g}", kz), std::exp(-kz), amplitude(boxes), 0.1);
  }
}

void mass_rows(AccuracyTable& table) {
  table.section("Mass", "Greatest net flux of 200 boxes drawn at random, over what flows into each.");
  const HeightMap map = world(
      80, 60, 10, [](double x, double y) { return gaussian(std::hypot(x, y), 60, 70) + (x > 220 ? 25 : 0); });
  const UpwindProfile upwind = UpwindProfile::log_law(0.03);
  const auto worst = [](const FaceFlows& f) {
    RandomStream random(1, 0);
    const auto range = [&](int n) {
      const int a = static_cast<int>(random.uniform() * n);
      const int b = static_cast<int>(random.uniform() * n);
      return std::pair{std::min(a, b), std::max(a, b) + 1};
    };
    double most = 0;
    for (int i = 0; i < 200; ++i) {
      const auto [x0, x1] = range(f.nx());
      const auto [y0, y1] = range(f.ny());
      const auto [z0, z1] = range(f.nz());
      const FaceFlows::Balance b = f.balance({x0, x1, y0, y1, z0, z1});
      if (b.inflow > 0) most = std::max(most, std::abs(b.net) / b.inflow);
    }
    return most;
  };
  for (const double angle : {0.0, 2.5}) {
    const std::string name = fmt::format(", wind to {:.0f}°", angle * 180 / M_PI);
    table.row("spectral" + name, 0,
              worst(SpectralVolume(wind_relief(map, 0), angle, upwind, LeeBubble{}, 200).flows()), 1e-6);
    table.row("mass consistent" + name, 0,
              worst(MassConsistentVolume(wind_relief(map, 0), angle, upwind, {}).flows()), 1e-6);
  }
}

}  // namespace

void volume_rows(AccuracyTable& table) {
  cylinder_rows(table);
  lift_rows(table);
  mass_rows(table);
}

}  // namespace aeolian
