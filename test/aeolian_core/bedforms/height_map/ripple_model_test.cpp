#include "aeolian_core/bedforms/height_map/ripple_model.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "ripple_bed.hpp"
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

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

TEST(RippleModelTest, flat_sand_is_skipped_and_booked_as_if_it_were_not) {
  const GridGeometry g(0, 0, 0.002, 60, 90);
  for (const Border border : {Border::open, Border::periodic})
    for (const double direction : {0.0, 0.5, -2.2}) {
      std::vector<double> flat(g.size(), 0.3);
      const BedChange skipped = RippleModel(parameters(border, 0.4, 1)).advance(g, flat, wind(direction), 20);
      EXPECT_EQ(flat, std::vector<double>(g.size(), 0.3));
      EXPECT_EQ(skipped.active.count(), 0);
      std::vector<double> nearly(g.size(), 0.3);
      nearly[1000] += 1e-12;
      const BedChange run = RippleModel(parameters(border, 0.4, 1)).advance(g, nearly, wind(direction), 20);
      EXPECT_GT(run.active.count(), 0);
      EXPECT_NEAR(skipped.volume.moved / run.volume.moved, 1, 1e-6);
      EXPECT_EQ(skipped.volume.inflow, skipped.volume.outflow);
      // A run counts what begins and ends in the lines that lie half beside the grid, too.
      EXPECT_NEAR(skipped.volume.inflow, run.volume.inflow, 0.2 * run.volume.inflow);
    }
}

TEST(RippleModelTest, what_is_steeper_than_repose_slides_before_impacts_see_it) {
  const GridGeometry g(0, 0, 0.08, 50, 22);
  std::vector<double> h = noise(g, 0.5);
  const double rough = deviation(h);
  const VolumeBalance volume =
      RippleModel(parameters(Border::open, 0.4, 1)).advance(g, h, wind(1.2), 1e3).volume;
  EXPECT_LT(deviation(h), rough);
  EXPECT_LT(volume.moved, 2 * rough * g.length_x() * g.length_y());
  EXPECT_LT(std::abs(volume.error()), 1e-12);
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
