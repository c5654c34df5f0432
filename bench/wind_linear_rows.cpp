#include <algorithm>
#include <cmath>

#include "../test/aeolian_core/wind/relief_worlds.hpp"
#include "wind_rows.hpp"

#include "aeolian_core/wind/inner_layer.hpp"

namespace aeolian {
namespace {

constexpr double low = 0.01;  ///< H/L

SpectralVolume potential_flow(const HeightMap& map, double top) {
  return SpectralVolume(wind_relief(map, 0), 0, UpwindProfile::uniform(), attached, top);
}

ReliefSettings settings(double roughness, bool periodic = false) {
  ReliefSettings s;
  s.roughness = roughness;
  s.shortest_wavelength = 0;
  s.periodic = periodic;
  return s;
}

void log_law_rows(AccuracyTable& table) {
  table.section("F1: level ground",
                "Speeds for u* = 0.3 m/s over z0 = 0.1 mm, in the volumes of both models.");
  const WindRelief relief = wind_relief(world(24, 24, 1, [](double, double) { return 3.0; }), 0);
  const UpwindProfile upwind = UpwindProfile::log_law(1e-4);
  const SpectralVolume linear(relief, 0.3, upwind, LeeBubble{}, 20);
  const MassConsistentVolume boxes(relief, 0.3, upwind, {});
  for (const auto& [z, speed] : {std::pair{0.1, 5.181}, {1.0, 6.908}, {10.0, 8.635}}) {
    const auto at = [z = z](const WindVolume& v) {
      const AirVelocity wind = v.velocity(0, 0, z);
      return 0.3 * std::hypot(wind.east, wind.north);
    };
    table.relative_row(fmt::format("log law, {:g} m [m/s]", z), speed, log_law_speed(0.3, z, 1e-4), 0.001);
    table.relative_row(fmt::format("spectral, {:g} m [m/s]", z), speed, at(linear), 0.001);
    if (z < boxes.top())
      table.relative_row(fmt::format("mass consistent, {:g} m [m/s]", z), speed, at(boxes), 0.01);
  }
}

void hill_rows(AccuracyTable& table) {
  table.section(
      "F3 to F6: hills in linear theory without friction",
      "Spectral volume, uniform wind, H/L = 0.01, at 25 and 100 cells to L. At the feet of the cosine "
      "bump the spec prints -0.455; the integral, -Si(2 pi)/4, is -0.3545.");
  for (const int cells : {25, 100}) {
    const double l = cells;
    const double h = low * l;
    const int n = 80 * cells + 1;
    const auto gain = [&](const SpectralVolume& v, double x, double z) {
      return (v.velocity(x, 0, z + 1e-3).east - 1) / low;
    };
    const auto name = [&](const std::string& what) { return fmt::format("{}, {} cells to L", what, cells); };
    const SpectralVolume witch =
        potential_flow(ridge(n, 1, [&](double x) { return agnesi(x, h, l); }), 3 * l);
    for (const double z : {0.0, 0.5, 1.0, 2.0})
      table.row(name(fmt::format("Agnesi, crest, z = {:g} L", z)), 1 / std::pow(1 + z, 2),
                gain(witch, 0, z * l), 0.02);
    table.row(name("Agnesi, trough at 1.73 L"), -0.125, gain(witch, 1.73 * l, 0), 0.02);
    const SpectralVolume gauss = potential_flow(ridge(n, 1, [&](double x) { return gaussian(x, h, l); }), l);
    table.row(name("Gaussian, crest"), 0.939, gain(gauss, 0, 0), 0.02);
    table.row(name("Gaussian, least, at 1.8 L"), -0.268, gain(gauss, 1.8 * l, 0), 0.02);
    const SpectralVolume bump =
        potential_flow(ridge(n, 1, [&](double x) { return cosine_bump(x, h, l); }), l);
    table.row(name("cosine bump, crest"), 0.926, gain(bump, 0, 0), 0.02);
    table.row(name("cosine bump, feet"), -0.3545, gain(bump, 2 * l, 0), 0.02);
  }
  for (const int cells : {10, 20}) {
    const double l = cells;
    const int n = 16 * cells + 1;
    const SpectralVolume round = potential_flow(
        world(n, n, 1, [&](double x, double y) { return gaussian(std::hypot(x, y), low * l, l); }), l);
    table.row(fmt::format("axisymmetric Gaussian, crest, {} cells to L", cells), 0.738,
              (round.velocity(0, 0, 1e-3).east - 1) / low, 0.02);
  }
}

/// The greatest speed-up at any height over the hilltop.
double greatest_speed_up(const SpectralVolume& v, const UpwindProfile& upwind) {
  double most = 0;
  for (double z = 3 * upwind.roughness(); z < 10; z *= 1.2)
    most = std::max(most, v.velocity(0, 0, z).east / upwind.speed(z) - 1);
  return most;
}

void shear_rows(AccuracyTable& table) {
  table.section(
      "F9: real low hills with shear",
      "Jackson & Hunt (1975), Taylor & Lee (1984): speed-up at the hilltop, greatest over heights, over "
      "H/L = 0.05; L = 100 m, z0 = 3 cm.");
  const double l = 100;
  const double h = 0.05 * l;
  const UpwindProfile upwind = UpwindProfile::log_law(0.03);
  const auto volume = [&](const HeightMap& map) {
    return SpectralVolume(wind_relief(map, 0), 0, upwind, attached, 300);
  };
  const SpectralVolume across = volume(ridge(801, 5, [&](double x) { return gaussian(x, h, l); }));
  const double greatest = greatest_speed_up(across, upwind) / 0.05;
  table.relative_row("ridge", 2, greatest, 0.25);
  const SpectralVolume round =
      volume(world(161, 161, 10, [&](double x, double y) { return gaussian(std::hypot(x, y), h, l); }));
  table.relative_row("axisymmetric hill", 1.6, greatest_speed_up(round, upwind) / 0.05, 0.25);
  // Rises over 2 L, as half a cosine bump does.
  const SpectralVolume step =
      volume(ridge(801, 5, [&](double x) { return x < 0 ? cosine_bump(x, h, l) : h; }));
  table.relative_row("escarpment", 0.8, greatest_speed_up(step, upwind) / 0.05, 0.25);
  const auto gain = [&](double z) { return across.velocity(0, 0, z).east / upwind.speed(z) - 1; };
  for (const double part : {0.25, 0.5})
    table.relative_row(
        fmt::format("decay over the ridge, A of exp(-A z/L), from the greatest to z = {:g} L", part), 3,
        std::log(0.05 * greatest / gain(part * l)) / part, 0.25);
}

void stress_rows(AccuracyTable& table) {
  table.section(
      "Stress over waves, and its phase (F10)",
      "A and B of stress/flat = 1 + A|k|h + B dh/dx, from the wind over a wave of slope 0.01 (and from the "
      "formula, as the spec tells them). The stress must lead the crest: a release gate.");
  const double expected[][3] = {
      {1e-6, 2.97, 0.88}, {1e-5, 3.12, 1.15}, {1e-4, 3.31, 1.60}, {1e-3, 3.50, 2.36}};
  for (const auto& [kz0, a, b] : expected) {
    const std::complex<double> s = ReliefWave(UpwindProfile::log_law(kz0), 1, 1, 0).stress().along;
    table.relative_row(fmt::format("A, k z0 = {:g}, formula", kz0), a, s.real(), 0.005);
    table.relative_row(fmt::format("B, k z0 = {:g}, formula", kz0), b, s.imag(), 0.005);
    const int n = 128;
    const double k = 2 * M_PI / n;
    const HeightMap map = ridge(n, 1, [&](double x) { return 0.01 / k * std::cos(k * (x - 0.5)); });
    const TerrainResponse r = SpectralWind(settings(kz0 / k, true)).solve(map, 0);
    double cosine = 0;
    double sine = 0;
    for (int i = 0; i < n; ++i) {
      const double stress = std::pow(static_cast<double>(r.friction[static_cast<std::size_t>(i)]), 2) - 1;
      const double x = map.geometry().x(i) - 0.5;
      cosine += 2.0 / n * stress * std::cos(k * x);
      sine += 2.0 / n * stress * std::sin(k * x);
    }
    table.relative_row(fmt::format("A, k z0 = {:g}, wind over the wave", kz0), a, cosine / 0.01, 0.01);
    table.relative_row(fmt::format("B, k z0 = {:g}, wind over the wave", kz0), b, -sine / 0.01, 0.01);
    const double lead = std::atan2(-sine, cosine) / (2 * M_PI);
    table.relative_row(fmt::format("F10: lead of the stress over the crest, wavelengths, k z0 = {:g}", kz0),
                       std::atan(b / a) / (2 * M_PI), lead, 0.2);
  }
}

void symmetry_rows(AccuracyTable& table) {
  table.section("F11: symmetry",
                "Greatest difference of the friction velocity over that of the surroundings.");
  const HeightMap map =
      world(129, 97, 1, [](double x, double y) { return gaussian(std::hypot(x, y), 2, 15); });
  const SpectralWind wind(settings(1e-3));
  for (const double angle : {0.0, 0.4, M_PI / 4, 1.9}) {
    const TerrainResponse there = wind.solve(map, angle);
    const TerrainResponse back = wind.solve(map, angle - M_PI);
    double most = 0;
    for (std::size_t i = 0; i < there.friction.size(); ++i)
      most = std::max(most, std::abs(static_cast<double>(there.friction[i] -
                                                         back.friction[back.friction.size() - 1 - i])));
    table.row(fmt::format("reversed wind mirrors the field, wind to {:.0f}°", angle * 180 / M_PI), 0, most,
              1e-6);
  }
  TerrainWind model({});
  WindInput input;
  input.speed = 5;
  input.height = 2;
  const WindField slow = model.solve(input, &map);
  input.speed = 10;
  const WindField fast = model.solve(input, &map);
  double most = 0;
  for (std::size_t i = 0; i < map.geometry().size(); ++i)
    most = std::max(most, std::abs(static_cast<double>(fast.cells.layer("friction_velocity")[i] /
                                                       slow.cells.layer("friction_velocity")[i]) -
                                   2));
  table.row("twice the speed, ratio less two", 0, most, 1e-6);
  const TerrainResponse flat = wind.solve(world(64, 64, 1, [](double, double) { return 5; }), 0.3);
  most = 0;
  for (const float f : flat.friction) most = std::max(most, std::abs(static_cast<double>(f) - 1));
  table.row("level ground, ratio less one", 0, most, 1e-6);
}

}  // namespace

void linear_rows(AccuracyTable& table) {
  log_law_rows(table);
  hill_rows(table);
  shear_rows(table);
  stress_rows(table);
  symmetry_rows(table);
}

}  // namespace aeolian
