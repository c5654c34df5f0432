#include "aeolian_core/bedforms/height_map/ripple_model.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "aeolian_core/bedforms/height_map/impact_angles.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

constexpr double degree = M_PI / 180;
constexpr double hop = 0.01;
constexpr double erosion_rate = 1e-4;

Forcing wind(double direction = 0) {
  Forcing forcing;
  forcing.direction = direction;
  forcing.impact_angle = 10 * degree;
  const double side = forcing.grain.effective_diameter();
  forcing.ejection_rate = erosion_rate / (side * side * side);
  forcing.reptation_length = hop;
  return forcing;
}

const double cot_alpha = 1 / std::tan(10 * degree);
constexpr double unit_time = hop / erosion_rate;  ///< [s] in which a reptation length of depth is set moving

RippleParameters parameters(Border border, double slope_effect, double hop_shortening = 0) {
  RippleParameters result;
  result.border = border;
  result.slope_effect = slope_effect;
  result.hop_shortening = hop_shortening;
  result.relief_scale = 100;
  return result;
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

std::vector<double> noise(const GridGeometry& g, double deviation, std::uint64_t seed = 1) {
  RandomStream random(seed, 0);
  std::vector<double> h(g.size());
  for (double& value : h) value = deviation * random.normal();
  return h;
}

double deviation(const std::vector<double>& h) {
  const double mean = sum(h) / static_cast<double>(h.size());
  double square = 0;
  for (const double v : h) square += (v - mean) * (v - mean);
  return std::sqrt(square / static_cast<double>(h.size()));
}

/// The complex amplitude of one plane wave.
std::complex<double> amplitude(const GridGeometry& g, const std::vector<double>& h, double kx, double ky) {
  std::complex<double> total = 0;
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x)
      total += h[g.index(x, y)] * std::polar(1.0, -(kx * g.x(x) + ky * g.y(y)));
  return total * 2.0 / static_cast<double>(h.size());
}

/// Mean wavelength along x [m], weighted with the power spectrum.
double wavelength(const GridGeometry& g, const std::vector<double>& h) {
  double power = 0;
  double moment = 0;
  for (int n = 1; n < g.nx() / 4; ++n) {
    const double k = 2 * M_PI * n / g.length_x();
    double at_k = 0;
    for (int y = 0; y < g.ny(); ++y) {
      std::complex<double> total = 0;
      for (int x = 0; x < g.nx(); ++x) total += h[g.index(x, y)] * std::polar(1.0, -k * g.x(x));
      at_k += std::norm(total);
    }
    power += at_k;
    moment += at_k * k;
  }
  return 2 * M_PI * power / moment;
}

TEST(RippleModelTest, single_modes_grow_and_move_as_linear_theory_says) {
  struct Case {
    double nu, mu;
  };
  for (const double waves_in_hop : {0.5, 0.83, 1.2})
    for (const Case c : {Case{0, 0.5}, Case{0, 1}, Case{0, 2}, Case{1, 0.4}, Case{2, 0}}) {
      const double cell = hop / 20;
      const int cells = static_cast<int>(std::lround(2 * M_PI / waves_in_hop * 20)) * 2;
      const double k = 4 * M_PI / (cells * cell);
      const double ka = k * hop;
      const GridGeometry g(0, 0, cell, cells, 1);
      std::vector<double> h(g.size());
      for (int x = 0; x < cells; ++x) h[g.index(x, 0)] = 1e-7 * std::cos(k * g.x(x));
      const double duration = 0.3 * unit_time;
      const std::complex<double> before = amplitude(g, h, k, 0);
      RippleModel(parameters(Border::periodic, c.mu, c.nu)).advance(g, h, wind(), duration);
      const std::complex<double> rate = std::log(amplitude(g, h, k, 0) / before) / duration;

      const double contrast = cot_alpha - c.nu;
      const double growth = erosion_rate * (contrast * k * ka / (1 + ka * ka) - c.mu * hop * k * k);
      const double speed = erosion_rate * contrast * (1 - 1 / (1 + ka * ka));
      EXPECT_NEAR(rate.real() / growth, 1, 0.01) << "ka " << ka << " nu " << c.nu << " mu " << c.mu;
      EXPECT_NEAR(-rate.imag() / k / speed, 1, 0.01) << "ka " << ka << " nu " << c.nu << " mu " << c.mu;
    }
}

TEST(RippleModelTest, with_impacts_of_several_angles_modes_grow_by_their_mean_cotangent) {
  const double cell = hop / 20;
  Forcing forcing = wind();
  forcing.impact_angle = 12 * degree;
  for (const double spread : {0.0, 2 * degree, 6 * degree}) {
    forcing.impact_angle_spread = spread;
    // Log-normal angles (Gauss-Hermite nodes): the cotangent of the mean angle alone would be 20 % low.
    const double contrast = 1 / ImpactAngles(forcing.impact_angle, spread).effective_tangent() - 1;
    const double ka = std::sqrt(std::sqrt(contrast / 0.4) - 1);
    const int cells = static_cast<int>(std::lround(2 * M_PI / ka * 20)) * 2;
    const double k = 4 * M_PI / (cells * cell);
    const GridGeometry g(0, 0, cell, cells, 1);
    std::vector<double> h(g.size());
    for (int x = 0; x < cells; ++x) h[g.index(x, 0)] = 1e-7 * std::cos(k * g.x(x));
    const double duration = 0.2 * unit_time;
    const std::complex<double> before = amplitude(g, h, k, 0);
    RippleModel(parameters(Border::periodic, 0.4, 1)).advance(g, h, forcing, duration);
    const std::complex<double> rate = std::log(amplitude(g, h, k, 0) / before) / duration;
    const double q = k * hop;
    const double growth = erosion_rate * (contrast * k * q / (1 + q * q) - 0.4 * hop * k * k);
    EXPECT_NEAR(rate.real() / growth, 1, 0.01) << spread;
  }
}

/// The rate at which a wave of (n, m) periods per side grows (real part) and turns, relative to linear
/// theory. Crests need not lie across the wind.
std::complex<double> oblique_mode(int n, int m, double wind_direction, double nu, double mu, double spread) {
  const int cells = 160;
  const GridGeometry g(0, 0, hop / 5, cells, cells);
  const double kx = 2 * M_PI * n / g.length_x();
  const double ky = 2 * M_PI * m / g.length_y();
  std::vector<double> h(g.size());
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x) h[g.index(x, y)] = 1e-7 * std::cos(kx * g.x(x) + ky * g.y(y));
  const double duration = 0.2 * unit_time;
  const std::complex<double> before = amplitude(g, h, kx, ky);
  RippleParameters p = parameters(Border::periodic, mu, nu);
  p.lateral_spread = spread;
  RippleModel(p).advance(g, h, wind(wind_direction), duration);
  const std::complex<double> rate = std::log(amplitude(g, h, kx, ky) / before) / duration;

  const double along = kx * std::cos(wind_direction) + ky * std::sin(wind_direction);
  const double across = ky * std::cos(wind_direction) - kx * std::sin(wind_direction);
  const std::complex<double> ik(0, along);
  const std::complex<double> eroded = cot_alpha * ik;
  const std::complex<double> deposited = (eroded - nu * hop * along * along) / (1.0 + ik * hop) *
                                         std::exp(-0.5 * spread * hop * spread * hop * across * across);
  const std::complex<double> theory =
      erosion_rate * (deposited - eroded - mu * hop * (along * along + across * across));
  return {rate.real() / theory.real(), rate.imag() / theory.imag()};
}

TEST(RippleModelTest, a_mode_along_the_wind_grows_alike_whatever_the_wind_is) {
  // About 0, 17, 30 and 45 degrees to either axis; the waves are about as long as those that grow fastest.
  const CellIndex periods[] = {{7, 0}, {7, 2}, {6, 3}, {7, 4}, {5, 5}, {0, 7}, {-7, 0}, {-2, 7}, {4, -7}};
  for (const CellIndex n : periods)
    for (const double spread : {0.0, 0.25}) {
      const std::complex<double> default_slopes =
          oblique_mode(n.x, n.y, std::atan2(n.y, n.x), 1, 0.4, spread);
      EXPECT_NEAR(default_slopes.real(), 1, 0.01) << n.x << ' ' << n.y;
      EXPECT_NEAR(default_slopes.imag(), 1, 0.01) << n.x << ' ' << n.y;
      const std::complex<double> steep = oblique_mode(n.x, n.y, std::atan2(n.y, n.x), 0, 1, spread);
      EXPECT_NEAR(steep.real(), 1, 0.01) << n.x << ' ' << n.y;
      EXPECT_NEAR(steep.imag(), 1, 0.01) << n.x << ' ' << n.y;
    }
}

TEST(RippleModelTest, crests_lie_across_the_wind_whatever_the_wind_is) {
  // Waves turned to either side of the wind grow as theory says, so that none is favoured.
  for (const CellIndex w :
       {CellIndex{10, 0}, CellIndex{10, 3}, CellIndex{7, 4}, CellIndex{4, 7}, CellIndex{5, 5}})
    for (const CellIndex n : {CellIndex{7, 0}, CellIndex{7, 2}, CellIndex{6, 3}, CellIndex{6, 4},
                              CellIndex{5, 5}, CellIndex{3, 6}, CellIndex{2, 7}, CellIndex{6, -2}}) {
      const double direction = std::atan2(w.y, w.x);
      if (std::abs(std::atan2(n.y, n.x) - direction) > 0.6) continue;
      const std::complex<double> rate = oblique_mode(n.x, n.y, direction, 1, 0.4, 0.25);
      EXPECT_NEAR(rate.real(), 1, 0.02) << w.x << ' ' << w.y << ", " << n.x << ' ' << n.y;
      EXPECT_NEAR(rate.imag(), 1, 0.02) << w.x << ' ' << w.y << ", " << n.x << ' ' << n.y;
    }
}

TEST(RippleModelTest, first_ripples_have_the_wavelength_of_the_specification) {
  // Specification sec. 5.4: first crest spacing 5.1-6.1 hops for mu = 1, 7.6-8.5 for mu = 2.
  struct Case {
    double mu, spacing;
  };
  for (const Case c : {Case{1, 5.6}, Case{2, 8.0}}) {
    const GridGeometry g(0, 0, hop / 10, 1024, 1);
    std::vector<double> h = noise(g, 1e-6);
    const double growth_time = unit_time / std::pow(std::sqrt(cot_alpha) - std::sqrt(c.mu), 2);
    RippleModel(parameters(Border::periodic, c.mu)).advance(g, h, wind(), 6 * growth_time);
    EXPECT_NEAR(wavelength(g, h) / hop / c.spacing, 1, 0.15) << c.mu;
  }
}

TEST(RippleModelTest, ripples_on_a_patch_grow_move_downwind_and_merge) {
  const GridGeometry g(0, 0, hop / 5, 200, 24);
  RippleModel model(parameters(Border::periodic, 2));
  std::vector<double> h = noise(g, 1e-5);
  const double before = sum(h);
  model.advance(g, h, wind(), 16 * unit_time);
  const double young = wavelength(g, h);
  EXPECT_GT(deviation(h), 1e-3);
  EXPECT_NEAR(young / hop / 9, 1, 0.25);

  // Moved downwind: the map fits its own past best when that is shifted by a part of a wavelength towards +x.
  const std::vector<double> past = h;
  model.advance(g, h, wind(), 0.5 * unit_time);
  int best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (int shift = -12; shift <= 12; ++shift) {
    double product = 0;
    for (int y = 0; y < g.ny(); ++y)
      for (int x = 0; x < g.nx(); ++x)
        product += past[g.index(x, y)] * h[g.index((x + shift + g.nx()) % g.nx(), y)];
    if (product > most) {
      most = product;
      best = shift;
    }
  }
  EXPECT_GT(best, 0);

  model.advance(g, h, wind(), 32 * unit_time);
  EXPECT_GT(wavelength(g, h), 1.3 * young);
  EXPECT_NEAR(sum(h), before, 1e-10);
}

TEST(RippleModelTest, volume_is_conserved_to_rounding) {
  for (const double direction : {0.0, 17 * degree, 45 * degree, -100 * degree})
    for (const Border border : {Border::periodic, Border::open}) {
      const GridGeometry g(0, 0, hop / 5, 96, 64);
      std::vector<double> h = noise(g, 1e-3);
      const double before = sum(h);
      const BedChange change =
          RippleModel(parameters(border, 0.4, 1)).advance(g, h, wind(direction), 2 * unit_time);
      const double area = g.cell() * g.cell();
      EXPECT_GT(change.volume.moved, 0);
      EXPECT_NEAR(change.volume.change, (sum(h) - before) * area, 1e-12 * change.volume.moved);
      EXPECT_NEAR(change.volume.error(), 0, 1e-12) << direction;
      if (border == Border::periodic) {
        EXPECT_NEAR(sum(h) - before, 0, 1e-12 * change.volume.moved / area);
      }
    }
}

TEST(RippleModelTest, a_flat_bed_stays_flat_under_an_open_border) {
  for (const double direction : {0.0, 0.4, 2.5}) {
    const GridGeometry g(0, 0, hop / 5, 80, 50);
    std::vector<double> h(g.size(), 0.25);
    RippleModel(parameters(Border::open, 0.4, 1)).advance(g, h, wind(direction), unit_time);
    for (const double v : h) ASSERT_NEAR(v, 0.25, 1e-12);
  }
}

TEST(RippleModelTest, a_dune_flank_is_no_slope_to_the_impacts) {
  const GridGeometry g(0, 0, hop / 5, 80, 50);
  std::vector<double> h(g.size());
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x) h[g.index(x, y)] = 0.15 * g.x(x) - 0.05 * g.y(y);
  const std::vector<double> before = h;
  RippleParameters p = parameters(Border::open, 0);
  RippleModel(p).advance(g, h, wind(0.2), 0.2 * unit_time);
  for (std::size_t i = 0; i < h.size(); ++i) ASSERT_NEAR(h[i], before[i], 1e-11);
}

TEST(RippleModelTest, calm_leaves_the_map_bit_for_bit) {
  const GridGeometry g(0, 0, 0.002, 70, 40);
  const std::vector<double> rough = noise(g, 0.01);  // steeper than repose in places
  HeightMap map(g);
  map.add(layer::elevation, HeightMap::Layer(rough.begin(), rough.end()));
  const HeightMap::Layer before = map.layer(layer::elevation);
  RippleModel model(RippleParameters{});
  Forcing calm = wind();
  calm.ejection_rate = 0;
  EXPECT_TRUE(model.advance(map, calm, 600).active.empty());
  EXPECT_TRUE(model.advance(map, wind(), 0).active.empty());
  EXPECT_EQ(map.layer(layer::elevation), before);
}

TEST(RippleModelTest, unknown_cells_stay_unknown_and_the_known_stay_known) {
  const GridGeometry g(0, 0, 0.002, 120, 60);
  const std::vector<double> rough = noise(g, 3e-4);
  HeightMap map(g);
  HeightMap::Layer& h = map.add(layer::elevation, HeightMap::Layer(rough.begin(), rough.end()));
  for (int y = 10; y < 30; ++y)
    for (int x = 40; x < 70; ++x) h[g.index(x, y)] = HeightMap::unknown;
  h[0] = HeightMap::unknown;
  const HeightMap::Layer before = h;
  const BedChange change = RippleModel(RippleParameters{}).advance(map, wind(0.3), 20);
  EXPECT_FALSE(change.active.empty());
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(std::isfinite(before[i]), std::isfinite(h[i]));
}

TEST(RippleModelTest, holes_beside_a_border_swallow_nothing_however_long_the_hops) {
  HeightMap map(GridGeometry(0, 0, 0.002, 40, 30));
  HeightMap::Layer& height = map.add(layer::elevation, 0);
  RandomStream random(1, 0);
  for (float& h : height)
    h = random.uniform() < 0.2 ? HeightMap::unknown : 0.001F * static_cast<float>(random.normal());
  Forcing forcing = wind(0.4);
  forcing.reptation_length = 0.05;  // spread by six cells across
  const BedChange change = RippleModel(parameters(Border::open, 0.4, 1)).advance(map, forcing, 30);
  EXPECT_GT(change.volume.moved, 0);
  EXPECT_LT(std::abs(change.volume.error()), 1e-12);
}

TEST(RippleModelTest, a_map_of_which_nothing_is_known_is_left_alone) {
  HeightMap map(GridGeometry(0, 0, 0.002, 20, 20));
  map.add(layer::elevation);
  EXPECT_NO_THROW(RippleModel(RippleParameters{}).advance(map, wind(), 20));
  EXPECT_EQ(count_known(map.layer(layer::elevation)), 0U);
}

TEST(RippleModelTest, a_map_of_floats_keeps_its_volume_to_one_rounding) {
  const GridGeometry g(0, 0, 0.002, 128, 64);
  HeightMap map(g);
  const std::vector<double> rough = noise(g, 5e-4);
  HeightMap::Layer& h = map.add(layer::elevation, 0);
  for (std::size_t i = 0; i < h.size(); ++i) h[i] = static_cast<float>(100 + rough[i]);
  const auto total = [&] {
    double result = 0;
    for (const float v : h) result += static_cast<double>(v);
    return result;
  };
  const double before = total();
  RippleModel(parameters(Border::periodic, 1)).advance(map, wind(), 30);
  EXPECT_NEAR(total(), before, 8e-6);  // half a unit in the last place of 100 is 4e-6
}

TEST(RippleModelTest, every_map_and_every_time_step_gives_finite_heights) {
  for (const double duration : {1e-3, 1.0, 1e3})
    for (const double direction : {0.0, 0.7, -2.0})
      for (const Border border : {Border::open, Border::periodic})
        for (const CellIndex size :
             {CellIndex{64, 40}, CellIndex{64, 1}, CellIndex{1, 64}, CellIndex{1, 1}}) {
          const GridGeometry g(0, 0, 0.005, size.x, size.y);
          std::vector<double> h = noise(g, 1e-3);
          h[h.size() / 2] += 0.2;                                                         // a spike
          for (std::size_t i = h.size() - h.size() / 4; i < h.size(); ++i) h[i] += 0.05;  // a cliff
          Forcing forcing = wind(direction);
          forcing.reptation_length = 0.004;
          const BedChange change = RippleModel(parameters(border, 0.4, 1)).advance(g, h, forcing, duration);
          for (const double v : h)
            ASSERT_TRUE(std::isfinite(v)) << duration << ' ' << size.x << 'x' << size.y;
          EXPECT_NEAR(change.volume.error(), 0, 1e-9) << duration << ' ' << size.x << 'x' << size.y;
        }
}

TEST(RippleModelTest, thirty_days_of_turning_wind_keep_the_volume_and_stay_finite) {
  const GridGeometry g(0, 0, 0.05, 48, 32);
  std::vector<double> h = noise(g, 0.01);
  for (double& z : h) z += 1;
  const double before = sum(h);
  RippleModel model(parameters(Border::periodic, 0.4, 1));
  for (int day = 0; day < 30; ++day)
    for (int half = 0; half < 2; ++half) {
      const double direction = 0.37 * day + half * M_PI;  // turned round twice a day
      EXPECT_NEAR(model.advance(g, h, wind(direction), 43200).volume.error(), 0, 1e-12);
    }
  EXPECT_NEAR(sum(h) / before, 1, 1e-12);
  for (const double z : h) ASSERT_NEAR(z, 1, 1);
}

TEST(RippleModelTest, wind_that_turns_round_every_step_moves_no_ripple_far) {
  const GridGeometry g(0, 0, 0.002, 100, 20);
  std::vector<double> h(g.size());
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x) h[g.index(x, y)] = 0.001 * std::cos(2 * M_PI * x / 25.0);
  RippleModel model(parameters(Border::periodic, 0.4, 1));
  const std::complex<double> before = amplitude(g, h, 2 * M_PI / 0.05, 0);
  for (int n = 0; n < 200; ++n) model.advance(g, h, wind(n % 2 * M_PI), 0.5);
  const std::complex<double> after = amplitude(g, h, 2 * M_PI / 0.05, 0);
  EXPECT_GT(std::abs(after), std::abs(before));
  EXPECT_NEAR(std::arg(after / before), 0, 0.1);
}

TEST(RippleModelTest, cells_of_a_grain_to_a_metre_and_durations_over_six_decades_are_stable) {
  for (const double cell : {0.0004, 0.01, 1.0})
    for (const double duration : {1e-3, 1e-1, 10.0, 1e3}) {
      const GridGeometry g(0, 0, cell, 40, 30);
      std::vector<double> h = noise(g, 0.3 * cell);
      const double highest = *std::max_element(h.begin(), h.end());
      Forcing forcing = wind(0.5);
      forcing.ejection_rate *= cell < 0.001 && duration > 100 ? 0.05 : 1;
      const BedChange change = RippleModel(parameters(Border::open, 0.4, 1)).advance(g, h, forcing, duration);
      EXPECT_NEAR(change.volume.error(), 0, 1e-9);
      for (const double z : h) ASSERT_LT(std::abs(z), 10 * (highest + 0.05)) << cell << ' ' << duration;
    }
}

TEST(RippleModelTest, weak_and_gale_force_winds_give_finite_heights) {
  for (const double factor : {1e-3, 1.0, 1e3}) {
    const GridGeometry g(0, 0, 0.002, 64, 32);
    std::vector<double> h = noise(g, 1e-3);
    Forcing forcing = wind(0.1);
    forcing.ejection_rate *= factor;
    const BedChange change = RippleModel(RippleParameters{}).advance(g, h, forcing, 5);
    for (const double v : h) ASSERT_TRUE(std::isfinite(v));
    EXPECT_NEAR(change.volume.error(), 0, 1e-9);
  }
}

TEST(RippleModelTest, the_bits_are_the_same_for_any_number_of_threads) {
  const GridGeometry g(0, 0, 0.002, 300, 280);
  for (const Border border : {Border::open, Border::periodic}) {
    std::vector<std::vector<double>> beds;
    for (const std::size_t threads : {1U, 2U, 5U}) {
      const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
      std::vector<double> h = noise(g, 1e-3);
      RippleModel(parameters(border, 0.4, 1)).advance(g, h, wind(0.3), 20);
      beds.push_back(h);
    }
    EXPECT_EQ(beds[0], beds[1]);
    EXPECT_EQ(beds[0], beds[2]);
  }
}

/// A map of sand with a rise of rock in it, a flat of rock, and unknown cells.
HeightMap rocky_map(double sand_depth) {
  const GridGeometry g(0, 0, 0.002, 200, 120);
  HeightMap map(g);
  const std::vector<double> rough = noise(g, 3e-4);
  HeightMap::Layer& h = map.add(layer::elevation);
  HeightMap::Layer ground(g.size(), HeightMap::unknown);
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x) {
      const std::size_t i = g.index(x, y);
      h[i] = static_cast<float>(0.01 + rough[i]);
      const double rise = 0.02 * std::exp(-0.005 * ((x - 60.0) * (x - 60) + (y - 60.0) * (y - 60)));
      if (x < 100) ground[i] = static_cast<float>(0.01 - sand_depth + rise);
      if (x >= 100 && x < 150) ground[i] = 0.01F;
      if (std::isfinite(ground[i])) h[i] = std::max(h[i], ground[i]);
      if (x >= 100 && x < 150) h[i] = 0.01F;
      if (x >= 160 && x < 175 && y > 30 && y < 80) h[i] = HeightMap::unknown;
    }
  map.add(layer::ground, ground);
  return map;
}

TEST(RippleModelTest, hard_ground_is_never_eroded_and_sand_is_conserved_on_it) {
  for (const double direction : {0.0, 0.4, M_PI / 4, 2.0, -2.5}) {
    HeightMap map = rocky_map(0.0005);
    const GridGeometry& g = map.geometry();
    const HeightMap::Layer before = map.layer(layer::elevation);
    const HeightMap::Layer ground = map.layer(layer::ground);
    const BedChange change = RippleModel(RippleParameters{}).advance(map, wind(direction), 120);
    EXPECT_NEAR(change.volume.error(), 0, 1e-12) << direction;
    double moved = 0;
    double total = 0;
    const HeightMap::Layer& after = map.layer(layer::elevation);
    for (std::size_t i = 0; i < before.size(); ++i) {
      ASSERT_EQ(std::isfinite(before[i]), std::isfinite(after[i]));
      if (!std::isfinite(before[i])) continue;
      if (std::isfinite(ground[i])) {
        ASSERT_GE(after[i], ground[i] - 1e-8F) << direction << ' ' << i % 200 << ' ' << i / 200;
      }
      moved += std::abs(static_cast<double>(after[i]) - static_cast<double>(before[i]));
      total += static_cast<double>(after[i]) - static_cast<double>(before[i]);
    }
    EXPECT_GT(moved, 0);
    // What the known cells gained is what the whole bed gained: nothing went into the unknown ones.
    EXPECT_NEAR(total * g.cell() * g.cell(), change.volume.change, 1e-7 * g.cell() * g.cell()) << direction;
  }
}

TEST(RippleModelTest, the_part_that_is_worked_on_is_worked_on_as_in_the_whole) {
  // An unknown cell far from the sand has the whole grid worked on.
  const GridGeometry g(0, 0, 0.002, 500, 400);
  HeightMap map(g);
  map.add(layer::elevation);
  map.add(layer::ground);
  const std::vector<double> rough = noise(g, 3e-4);
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x) {
      const std::size_t i = g.index(x, y);
      map.layer(layer::ground)[i] = static_cast<float>(0.002 * std::sin(0.05 * x + 0.03 * y));
      const bool sand = x >= 220 && x < 280 && y >= 170 && y < 230;
      map.layer(layer::elevation)[i] =
          map.layer(layer::ground)[i] + (sand ? static_cast<float>(0.004 + std::abs(rough[i])) : 0.0F);
    }
  for (const double direction : {0.4, 2.0, M_PI}) {
    HeightMap part = map;
    const BedChange change = RippleModel(RippleParameters{}).advance(part, wind(direction), 60);
    EXPECT_NEAR(change.volume.error(), 0, 1e-12);
    HeightMap whole = map;
    const std::size_t hole = g.index(direction == 0.4 ? 20 : 480, 20);
    whole.layer(layer::elevation)[hole] = HeightMap::unknown;
    RippleModel(RippleParameters{}).advance(whole, wind(direction), 60);
    for (std::size_t i = 0; i < g.size(); ++i) {
      if (i == hole) continue;
      ASSERT_NEAR(part.layer(layer::elevation)[i], whole.layer(layer::elevation)[i], 1e-5F)
          << direction << ' ' << i % 500 << ' ' << i / 500;
    }
  }
}

TEST(RippleModelTest, sheltered_sand_is_left_as_it_is) {
  // A lee of 28 degrees that shades more than grains hop, and noise that nothing can reach.
  const GridGeometry g(0, 0, 0.002, 640, 70);
  const std::vector<double> rough = noise(g, 2e-5);
  HeightMap map(g);
  map.add(layer::ground);  // unknown: none
  HeightMap::Layer& h = map.add(layer::elevation);
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x)
      h[g.index(x, y)] =
          static_cast<float>(0.106 * (1 - std::clamp((x - 200) / 100.0, 0.0, 1.0)) + rough[g.index(x, y)]);
  const HeightMap::Layer before = h;
  Forcing forcing = wind();
  forcing.reptation_length = 0.004;
  const BedChange change = RippleModel(parameters(Border::open, 0.4, 1)).advance(map, forcing, 20);
  EXPECT_NEAR(change.volume.error(), 0, 1e-12);
  for (int y = 0; y < g.ny(); ++y)
    for (const int x : {250, 300, 350})  // to what rounding to floats hands on
      EXPECT_NEAR(map.layer(layer::elevation)[g.index(x, y)], before[g.index(x, y)], 1e-8F);
}

TEST(RippleModelTest, bare_ground_costs_nothing_and_changes_nothing) {
  // Sand in one corner of a hard plain with some relief: the run must not depend on what is skipped.
  const GridGeometry g(0, 0, 0.002, 256, 192);
  HeightMap map(g);
  HeightMap::Layer& h = map.add(layer::elevation, 0.0F);
  HeightMap::Layer ground(g.size());
  const std::vector<double> rough = noise(g, 3e-4);
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x) {
      const std::size_t i = g.index(x, y);
      ground[i] = static_cast<float>(0.003 * std::sin(0.1 * x) * std::cos(0.07 * y));
      const bool sand = x >= 100 && x < 140 && y >= 70 && y < 110;
      h[i] = ground[i] + (sand ? static_cast<float>(0.004 + std::abs(rough[i])) : 0.0F);
    }
  map.add(layer::ground, ground);
  for (const double direction : {0.0, 0.5, -1.9}) {
    HeightMap forecast = map;
    const BedChange change = RippleModel(RippleParameters{}).advance(forecast, wind(direction), 60);
    EXPECT_NEAR(change.volume.error(), 0, 1e-12);
    EXPECT_GT(change.active.count(), 3);
    EXPECT_LT(change.active.count(), 30);  // of 48
    // Far upwind nothing happens, bit for bit.
    const int x = direction < -1 ? 120 : 20;
    const int y = direction < -1 ? 180 : 20;
    EXPECT_EQ(forecast.layer(layer::elevation)[g.index(x, y)], h[g.index(x, y)]);
  }
}

TEST(RippleModelTest, refuses_parameters_and_maps_that_it_cannot_use) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  RippleParameters p;
  p.slope_effect = -1;
  EXPECT_THROW(RippleModel{p}, Error);
  p = RippleParameters{};
  p.hop_shortening = nan;
  EXPECT_THROW(RippleModel{p}, Error);
  p = RippleParameters{};
  p.lateral_spread = nan;
  EXPECT_THROW(RippleModel{p}, Error);
  for (const double step : {0.0, 1.5, nan}) {
    p = RippleParameters{};
    p.step = step;
    EXPECT_THROW(RippleModel{p}, Error);
  }
  p = RippleParameters{};
  p.relief_scale = 0;
  EXPECT_THROW(RippleModel{p}, Error);

  RippleModel periodic(parameters(Border::periodic, 1));
  HeightMap map(GridGeometry(0, 0, 0.002, 20, 20));
  map.add(layer::elevation, 0.0F)[7] = HeightMap::unknown;
  EXPECT_THROW(periodic.advance(map, wind(), 1), Error);
  EXPECT_THROW(periodic.advance(map, wind(), -1), Error);
  HeightMap bare(GridGeometry(0, 0, 0.002, 20, 20));
  EXPECT_THROW(periodic.advance(bare, wind(), 1), Error);

  const GridGeometry g(0, 0, 0.002, 20, 20);
  std::vector<double> h(g.size() - 1, 0.0);
  EXPECT_THROW(periodic.advance(g, h, wind(), 1), Error);
  h.assign(g.size(), 0.0);
  h[3] = nan;
  EXPECT_THROW(periodic.advance(g, h, wind(), 1), Error);
}

}  // namespace
}  // namespace aeolian
