#include "aeolian_core/bedforms/lattice/lattice_bed.hpp"

#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr double repose = 33 * M_PI / 180;
constexpr double spacing = 0.0004;

Forcing strong_wind(double direction = 0) {
  Forcing forcing;
  forcing.direction = direction;
  forcing.impact_angle = 12 * M_PI / 180;
  forcing.grain.diameter = 0.0004;
  const double side = forcing.grain.effective_diameter();
  forcing.ejection_rate = 1e-4 / (side * side * side);  // 0.1 mm/s
  forcing.reptation_length = 8 * spacing;
  return forcing;
}

/// How long the wind must blow for so many ejections per column.
double time_for(const LatticeBed& bed, const Forcing& forcing, double ejections_per_column) {
  return ejections_per_column * bed.grain_volume() / (spacing * spacing) / forcing.erosion_rate();
}

bool is_single_step(const LatticeBed& bed) {
  const auto& h = bed.heights();
  for (int y = 0; y < bed.ny(); ++y)
    for (int x = 0; x < bed.nx(); ++x) {
      const auto at = [&](int i, int j) {
        return h[static_cast<std::size_t>(j % bed.ny() * bed.nx() + i % bed.nx())];
      };
      if (std::abs(at(x, y) - at(x + 1, y)) != 1 || std::abs(at(x, y) - at(x, y + 1)) != 1) return false;
      if ((at(x, y) + x + y) % 2 != 0) return false;
    }
  return true;
}

/// Heights on cells of four columns.
GridGeometry grid_of(const LatticeBed& bed) { return {0, 0, 4 * spacing, bed.nx() / 4, bed.ny() / 4}; }

double deviation(const HeightMap::Layer& h) {
  double mean = 0;
  for (const float v : h) mean += static_cast<double>(v) / static_cast<double>(h.size());
  double square = 0;
  for (const float v : h) square += (static_cast<double>(v) - mean) * (static_cast<double>(v) - mean);
  return std::sqrt(square / static_cast<double>(h.size()));
}

/// Covariance of two maps when the second is shifted back by (dx, dy) cells.
double covariance(const GridGeometry& g, const HeightMap::Layer& a, const HeightMap::Layer& b, int dx,
                  int dy) {
  double mean = 0;
  for (const float v : a) mean += static_cast<double>(v) / static_cast<double>(a.size());
  double total = 0;
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x) {
      const std::size_t there =
          g.index(((x + dx) % g.nx() + g.nx()) % g.nx(), ((y + dy) % g.ny() + g.ny()) % g.ny());
      total += (static_cast<double>(a[g.index(x, y)]) - mean) * (static_cast<double>(b[there]) - mean);
    }
  return total;
}

TEST(LatticeBedTest, keeps_its_grains_and_its_rule_through_a_million_ejections) {
  for (const double direction : {0.0, 0.6, 2.1, -1.6}) {
    LatticeBed bed(256, 128, spacing, repose, 5);
    const std::int64_t total = bed.total();
    ASSERT_TRUE(is_single_step(bed));
    const Forcing forcing = strong_wind(direction);
    bed.advance(forcing, time_for(bed, forcing, 31));
    EXPECT_GT(bed.ejections(), 950000U);
    EXPECT_EQ(bed.total(), total);
    EXPECT_TRUE(is_single_step(bed));
  }
}

TEST(LatticeBedTest, moves_as_much_sand_as_the_forcing_says) {
  // Impacts are a Poisson process: 4 standard deviations of 256 * 128 * 10.
  for (const double direction : {0.0, 0.3, M_PI / 2, M_PI}) {
    LatticeBed bed(256, 128, spacing, repose, 1);
    const Forcing forcing = strong_wind(direction);
    const double duration = time_for(bed, forcing, 10);
    for (int n = 0; n < 20; ++n) bed.advance(forcing, duration / 20);
    EXPECT_NEAR(static_cast<double>(bed.ejections()), 327680, 4 * std::sqrt(327680)) << direction;
  }
}

TEST(LatticeBedTest, the_same_seed_gives_the_same_bed) {
  std::vector<std::vector<std::int16_t>> beds;
  for (const std::uint64_t seed : {7U, 7U, 8U}) {
    LatticeBed bed(64, 64, spacing, repose, seed);
    bed.advance(strong_wind(), 5);
    beds.push_back(bed.heights());
  }
  EXPECT_EQ(beds[0], beds[1]);
  EXPECT_NE(beds[0], beds[2]);
}

TEST(LatticeBedTest, calm_changes_nothing) {
  LatticeBed bed(64, 64, spacing, repose, 1);
  const auto before = bed.heights();
  Forcing calm = strong_wind();
  calm.ejection_rate = 0;
  bed.advance(calm, 1000);
  bed.advance(strong_wind(), 0);
  Forcing breath = strong_wind();
  breath.ejection_rate *= 1e-12;
  bed.advance(breath, 1);
  EXPECT_EQ(bed.heights(), before);
  EXPECT_EQ(bed.ejections(), 0U);
}

TEST(LatticeBedTest, ripples_grow_across_the_wind_and_move_with_it) {
  for (const bool north : {false, true}) {
    const Forcing forcing = strong_wind(north ? M_PI / 2 : 0);
    LatticeBed bed(256, 256, spacing, repose, 3);
    const GridGeometry g = grid_of(bed);
    const double rough = deviation(bed.elevation(g));
    bed.advance(forcing, time_for(bed, forcing, 60));
    const HeightMap::Layer before = bed.elevation(g);
    EXPECT_GT(deviation(before), 4 * rough);

    // Crests lie across the wind: heights stay alike for longer across than along it.
    const double along = covariance(g, before, before, north ? 0 : 5, north ? 5 : 0);
    const double across = covariance(g, before, before, north ? 5 : 0, north ? 0 : 5);
    EXPECT_GT(across, 2 * along);

    bed.advance(forcing, time_for(bed, forcing, 4));
    const HeightMap::Layer after = bed.elevation(g);
    int best = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (int shift = -6; shift <= 6; ++shift) {
      const double c = covariance(g, before, after, north ? 0 : shift, north ? shift : 0);
      if (c > most) {
        most = c;
        best = shift;
      }
    }
    EXPECT_GT(best, 0);
  }
}

TEST(LatticeBedTest, elevation_is_the_mean_of_the_columns_of_a_cell) {
  LatticeBed bed(60, 40, spacing, repose, 2, 5);
  const GridGeometry fine(0, 0, spacing, 60, 40);
  const HeightMap::Layer columns = bed.elevation(fine);
  for (std::size_t i = 0; i < columns.size(); ++i)
    ASSERT_NEAR(columns[i], bed.heights()[i] * bed.layer(), 1e-9);
  const GridGeometry coarse(0, 0, 5 * spacing, 12, 8);
  double expected = 0;
  for (int y = 5; y < 10; ++y)
    for (int x = 10; x < 15; ++x) expected += columns[fine.index(x, y)] / 25.0;
  EXPECT_NEAR(bed.elevation(coarse)[coarse.index(2, 1)], expected, 1e-9);
  // Cells that cut through columns keep the volume all the same.
  const GridGeometry odd(0, 0, 2.4 * spacing, 25, 1);
  const GridGeometry odd_rows(0, 0, 2.5 * spacing, 24, 16);
  double volume = 0;
  for (const float h : bed.elevation(odd_rows))
    volume += static_cast<double>(h) * odd_rows.cell() * odd_rows.cell();
  EXPECT_NEAR(volume, static_cast<double>(bed.total()) * bed.layer() * spacing * spacing,
              1e-6 * std::abs(volume));
  EXPECT_EQ(bed.elevation(odd).size(), 25U);
}

TEST(LatticeBedTest, refuses_what_is_no_lattice) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(LatticeBed(63, 64, spacing, repose, 1), Error);
  EXPECT_THROW(LatticeBed(64, 2, spacing, repose, 1), Error);
  EXPECT_THROW(LatticeBed(64, 64, 0, repose, 1), Error);
  EXPECT_THROW(LatticeBed(64, 64, nan, repose, 1), Error);
  EXPECT_THROW(LatticeBed(64, 64, spacing, 33, 1), Error);
  EXPECT_THROW(LatticeBed(64, 64, spacing, repose, 1, -1), Error);
  LatticeBed bed(64, 64, spacing, repose, 1);
  EXPECT_THROW(bed.advance(strong_wind(), -1), Error);
  EXPECT_THROW(bed.advance(strong_wind(), nan), Error);
}

}  // namespace
}  // namespace aeolian
