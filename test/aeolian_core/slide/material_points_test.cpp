#include "aeolian_core/slide/mpm/material_points.hpp"

#include <cmath>
#include <cstring>

#include "../../error_of.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/slide/mpm/snow_body.hpp"
#include "aeolian_core/slide/mpm/stencil.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

template <int Dim>
Obstacle<Dim> floor_of(Contact contact, double friction = 0) {
  return {std::make_shared<HalfSpace<Dim>>(Point<Dim>::Zero(), Point<Dim>::Unit(Dim - 1)), contact, friction,
          Point<Dim>::Zero()};
}

template <int Dim>
std::vector<MaterialPoint<Dim>> block(const SnowLaw& law, const Point<Dim>& corner, const Point<Dim>& size,
                                      double cell, double per_cell = Dim == 2 ? 4 : 8, double jitter = 0) {
  SnowBox<Dim> box;
  box.corner = corner;
  box.size = size;
  return filled_box(box, law, cell, per_cell, jitter, 5);
}

template <int Dim>
double mass_of(const std::vector<MaterialPoint<Dim>>& points) {
  double mass = 0;
  for (const auto& p : points) mass += p.mass;
  return mass;
}
template <int Dim>
Point<Dim> momentum_of(const std::vector<MaterialPoint<Dim>>& points) {
  Point<Dim> sum = Point<Dim>::Zero();
  for (const auto& p : points) sum += p.mass * p.velocity;
  return sum;
}
template <int Dim>
double kinetic(const std::vector<MaterialPoint<Dim>>& points) {
  double sum = 0;
  for (const auto& p : points) sum += 0.5 * p.mass * p.velocity.squaredNorm();
  return sum;
}

TEST(Stencil, PartsOfUnity) {
  RandomStream random(1, 0);
  for (int k = 0; k < 1000; ++k) {
    Lanes place[3];
    for (Lanes& p : place)
      for (int lane = 0; lane < lane_count; ++lane) p[lane] = 0.01 * (4.5 + 4 * random.uniform());
    const int corner[3] = {3, 3, 3};
    const Stencil<3> s(place, corner, 0.01);
    for (int lane = 0; lane < lane_count; ++lane) {
      double sum = 0, slopes = 0, first = 0;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          for (int l = 0; l < 3; ++l) {
            const double w = s.weight[0][i][lane] * s.weight[1][j][lane] * s.weight[2][l][lane];
            sum += w;
            slopes += s.slope[0][i][lane] * s.weight[1][j][lane] * s.weight[2][l][lane];
            first += w * (s.offset[0][lane] + 0.01 * i);
          }
      ASSERT_NEAR(sum, 1, 1e-12);
      ASSERT_NEAR(slopes, 0, 1e-10);
      ASSERT_NEAR(first, 0, 1e-14);  // nodes are on average where the particle is
    }
  }
}

// A jelly that is let go turning and shaking: mass to the bit, momentum to rounding, without obstacles.
template <int Dim>
void conserve(Transfer transfer) {
  SnowLaw law;
  MpmSettings settings;
  settings.threads = 1;
  settings.transfer = transfer;
  settings.gravity = 0;
  MaterialPoints<Dim> world(settings, law);
  auto points = block<Dim>(law, Point<Dim>::Constant(-0.03), Point<Dim>::Constant(0.08), settings.cell,
                           Dim == 2 ? 4 : 8, 0.3);
  RandomStream random(2, 0);
  for (auto& p : points) {
    for (int d = 0; d < Dim; ++d) p.velocity[d] = 1 + 0.5 * random.normal();
    p.velocity[0] -= 10 * p.place[1];
  }
  world.add(points);
  const Point<Dim> before = momentum_of(points);
  world.advance(0.01);
  const auto after = world.points();
  EXPECT_EQ(mass_of(after), mass_of(points));
  EXPECT_LT((momentum_of(after) - before).norm(), 1e-10 * before.norm());
  if (transfer == Transfer::apic) {
    // Angular momentum with what the affine part carries: sum m (x v + h^2/4 C).
    const auto angular = [&](const std::vector<MaterialPoint<Dim>>& all) {
      double sum = 0;
      for (const auto& p : all)
        sum += p.mass * (p.place[0] * p.velocity[1] - p.place[1] * p.velocity[0] +
                         0.25 * settings.cell * settings.cell * (p.affine(1, 0) - p.affine(0, 1)));
      return sum;
    };
    EXPECT_NEAR(angular(after), angular(points), 1e-10 * std::abs(angular(points)));
  }
}
TEST(MaterialPoints, ConserveMassAndMomentum) {
  conserve<2>(Transfer::apic);
  conserve<2>(Transfer::flip);
  conserve<3>(Transfer::apic);
  conserve<3>(Transfer::flip);
}

template <int Dim>
void fall(Transfer transfer) {
  SnowLaw law;
  MpmSettings settings;
  settings.threads = 1;
  settings.transfer = transfer;
  MaterialPoints<Dim> world(settings, law);
  Point<Dim> corner = Point<Dim>::Zero();
  corner[Dim - 1] = 10;
  const auto points = block<Dim>(law, corner, Point<Dim>::Constant(0.05), settings.cell);
  world.add(points);
  world.advance(0.1);
  const double dt = 0.1 / static_cast<double>(world.work().steps);
  const auto after = world.points();
  // Velocity first, then place: after n steps dt^2 g n (n + 1) / 2.
  const double fallen = 0.5 * 9.81 * 0.1 * (0.1 + dt);
  for (std::size_t k = 0; k < points.size(); ++k) {
    ASSERT_NEAR(after[k].velocity[Dim - 1], -0.981, 1e-6 * 0.981);
    ASSERT_NEAR(points[k].place[Dim - 1] - after[k].place[Dim - 1], fallen, 1e-6 * fallen);
    ASSERT_NEAR(after[k].place[0], points[k].place[0], 1e-9);
  }
}
TEST(MaterialPoints, FallFreely) {
  fall<2>(Transfer::apic);
  fall<2>(Transfer::flip);
  fall<3>(Transfer::apic);
}

// A free bar that rings in its first mode: period 2 L / c with c = sqrt(E / rho), Poisson's ratio zero.
void ring(Transfer transfer) {
  SnowLaw law;
  law.yield = SnowLaw::Yield::none;
  law.poisson_ratio = 0;
  MpmSettings settings;
  settings.threads = 1;
  settings.transfer = transfer;
  settings.gravity = 0;
  settings.rest_speed = 0;
  const double length = 0.5;
  MaterialPoints<2> world(settings, law);
  auto points = block<2>(law, {0, 0}, {length, 0.04}, settings.cell);
  for (auto& p : points) p.velocity[0] = 0.05 * std::cos(M_PI * p.place[0] / length);
  world.add(points);
  // The mode's amplitude is a cosine: its third zero is at 5/4 of a period.
  double time = 0, zero = 0, last = 1;
  for (int crossings = 0; crossings < 3;) {
    world.advance(1e-4);
    time += 1e-4;
    ASSERT_LT(time, 1);
    double amplitude = 0;
    const auto now = world.points();
    for (std::size_t k = 0; k < now.size(); ++k)
      amplitude += now[k].velocity[0] * std::cos(M_PI * points[k].place[0] / length);
    if (amplitude * last < 0) {
      ++crossings;
      zero = time - 1e-4 * amplitude / (amplitude - last);
    }
    last = amplitude;
  }
  const double period = 2 * length / std::sqrt(law.youngs_modulus / law.density);
  EXPECT_NEAR(zero / 1.25, period, 0.02 * period);
}
TEST(MaterialPoints, BarRingsWithItsPeriod) {
  ring(Transfer::apic);
  ring(Transfer::flip);
}

// Two elastic discs meet head on (Sulsky et al. 1994): they leave with swapped velocities, and the affine or
// FLIP transfer loses little.
void collide(Transfer transfer, double kept) {
  SnowLaw law;
  law.yield = SnowLaw::Yield::none;
  MpmSettings settings;
  settings.threads = 1;
  settings.transfer = transfer;
  settings.gravity = 0;
  settings.rest_speed = 0;
  MaterialPoints<2> world(settings, law);
  std::vector<MaterialPoint<2>> discs;
  for (const double side : {-1., 1.})
    for (auto p : block<2>(law, {-0.1, -0.1}, {0.2, 0.2}, settings.cell)) {
      if (p.place.norm() > 0.1) continue;
      p.place[0] += side * 0.13;
      p.velocity[0] = -side;
      discs.push_back(p);
    }
  world.add(discs);
  const double before = kinetic(discs);
  world.advance(0.12);
  const auto after = world.points();
  EXPECT_LT(std::abs(momentum_of(after)[0]), 1e-10 * mass_of(discs));
  double left = 0;
  for (std::size_t k = 0; k < after.size() / 2; ++k)
    left += 2 * after[k].velocity[0] / static_cast<double>(after.size());
  EXPECT_LT(left, -0.8);
  EXPECT_GT(kinetic(after), kept * before);
  EXPECT_LT(kinetic(after), before);
}
TEST(MaterialPoints, DiscsBounce) {
  collide(Transfer::apic, 0.75);
  collide(Transfer::flip, 0.85);
}

/// A stiff block on an incline: how fast its mean velocity down the slope grows [m/s^2].
double acceleration_on_slope(double degrees, double friction) {
  SnowLaw law;
  law.yield = SnowLaw::Yield::none;
  MpmSettings settings;
  settings.threads = 1;
  const double angle = degrees * M_PI / 180;
  const Point<2> normal(std::sin(angle), std::cos(angle)), down(std::cos(angle), -std::sin(angle));
  MaterialPoints<2> world(settings, law,
                          {{std::make_shared<HalfSpace<2>>(Point<2>(0.003, 0), normal), Contact::separate,
                            friction, Point<2>::Zero()}});
  SnowBox<2> box;
  box.corner = Point<2>(0.003, 0) + 0.25 * settings.cell * normal;
  box.axes.col(0) = down;
  box.axes.col(1) = normal;
  box.size = {0.2, 0.04};
  world.add(filled_box(box, law, settings.cell, 4));
  const auto speed = [&] {
    const auto points = world.points();
    return momentum_of(points).dot(down) / mass_of(points);
  };
  world.advance(0.2);
  const double first = speed();
  world.advance(0.4);
  return (speed() - first) / 0.4;
}
// Specification, section 5 F.
TEST(MaterialPoints, BlockSlidesExactlyWhenItShould) {
  for (const double friction : {0.3, 0.6, 0.75}) {
    const double angle = 40 * M_PI / 180;
    const double expected = 9.81 * (std::sin(angle) - friction * std::cos(angle));
    EXPECT_NEAR(acceleration_on_slope(40, friction), expected, 0.05 * expected) << friction;
  }
  EXPECT_NEAR(acceleration_on_slope(30, 0.7), 0, 0.01);
}

template <int Dim>
bool same_bits(const std::vector<MaterialPoint<Dim>>& a, const std::vector<MaterialPoint<Dim>>& b) {
  for (std::size_t k = 0; k < a.size(); ++k)
    if (std::memcmp(a[k].place.data(), b[k].place.data(), sizeof a[k].place) != 0 ||
        std::memcmp(a[k].b.data(), b[k].b.data(), sizeof a[k].b) != 0 || a[k].alpha != b[k].alpha)
      return false;
  return a.size() == b.size();
}

template <int Dim>
std::vector<MaterialPoint<Dim>> dropped(int threads) {
  const SnowLaw law;
  MpmSettings settings;
  settings.threads = threads;
  MaterialPoints<Dim> world(settings, law, {floor_of<Dim>(Contact::sticky)});
  Point<Dim> corner = Point<Dim>::Constant(0.003);
  corner[Dim - 1] = 0.004;
  world.add(block<Dim>(law, corner, Point<Dim>::Constant(0.1), settings.cell, Dim == 2 ? 4 : 6, 0.2));
  world.advance(0.02);
  return world.points();
}
TEST(MaterialPoints, SameBitsForAnyNumberOfThreads) {
  EXPECT_TRUE(same_bits<2>(dropped<2>(1), dropped<2>(3)));
  EXPECT_TRUE(same_bits<3>(dropped<3>(1), dropped<3>(4)));
}

// A heap at rest is skipped, stays where it is, and a block that falls on it does what it does to one that is
// kept awake.
TEST(MaterialPoints, SleepChangesNothingThatMatters) {
  const SnowLaw law;
  double tops[2], heaps[2];
  for (const bool sleeps : {false, true}) {
    MpmSettings settings;
    settings.threads = 1;
    if (!sleeps) settings.rest_speed = 0;
    MaterialPoints<2> world(settings, law, {floor_of<2>(Contact::sticky)});
    world.add(block<2>(law, {0, 0.0025}, {0.3, 0.06}, settings.cell));
    world.advance(1);
    EXPECT_EQ(world.awake(), sleeps ? 0 : world.size());
    world.add(block<2>(law, {0.1, 0.1}, {0.08, 0.04}, settings.cell));
    world.advance(0.5);
    EXPECT_EQ(world.awake() < world.size(), sleeps);
    double top = 0, heap = 0;
    for (const auto& p : world.points()) {
      top = std::max(top, p.place[1]);
      heap += p.place[1] / static_cast<double>(world.size());
    }
    tops[sleeps] = top;
    heaps[sleeps] = heap;
  }
  EXPECT_NEAR(tops[1], tops[0], 0.0015);
  EXPECT_NEAR(heaps[1], heaps[0], 0.0005);
}

// Stiffness over four decades, drops from 10 m, one particle per cell: no number is lost, nor a particle.
TEST(MaterialPoints, SurviveStiffnessHeightAndThinSampling) {
  for (const double modulus : {1e4, 1e6, 1e8})
    for (const double speed : {0., 14.}) {  // 14 m/s after 10 m
      SnowLaw law;
      law.youngs_modulus = modulus;
      law.consolidation = std::min(7000., 0.1 * modulus);
      MpmSettings settings;
      settings.threads = 1;
      settings.cell = 0.02;
      MaterialPoints<2> world(settings, law, {floor_of<2>(Contact::sticky)});
      auto points = block<2>(law, {0.001, 0.01}, {0.2, 0.1}, settings.cell, 1, 0.3);
      for (auto& p : points) p.velocity[1] = -speed;
      world.add(points);
      ASSERT_NO_THROW(world.advance(modulus > 1e7 ? 0.02 : 0.1)) << modulus << ' ' << speed;
      const auto after = world.points();
      ASSERT_EQ(mass_of(after), mass_of(points));
      for (const auto& p : after) {
        ASSERT_TRUE(p.place.allFinite() && p.velocity.allFinite() && p.b.allFinite() &&
                    std::isfinite(p.alpha));
        ASSERT_GT(p.place[1], -1.5 * settings.cell);
      }
    }
}

TEST(MaterialPoints, StepsBeyondWhatWavesAllowAreRefused) {
  const SnowLaw law;
  MpmSettings settings;
  settings.threads = 1;
  const double allowed = MaterialPoints<2>(settings, law).longest_step();
  EXPECT_NEAR(allowed, 5.0e-5, 1e-6);  // specification, section 2.10
  settings.time_step = allowed;
  EXPECT_NO_THROW(MaterialPoints<2>(settings, law));
  settings.time_step = 1.01 * allowed;
  EXPECT_NE(error_of([&] { MaterialPoints<2>(settings, law); }).find("longer ones are unstable"),
            std::string::npos);
  settings.time_step = 0;
  settings.courant = 0.9;
  EXPECT_NE(error_of([&] { MaterialPoints<2>(settings, law); }).find("Courant number is 0.9"),
            std::string::npos);
}

TEST(MaterialPoints, FastParticlesShortenTheStep) {
  const SnowLaw law;
  MpmSettings settings;
  settings.threads = 1;
  settings.gravity = 0;
  MaterialPoints<2> world(settings, law);
  auto points = block<2>(law, {0, 0}, {0.05, 0.05}, settings.cell);
  for (auto& p : points) p.velocity[0] = 300;
  world.add(points);
  world.advance(0.001);
  EXPECT_GT(world.work().shortened, 0);
  EXPECT_NEAR(world.points().front().place[0], points.front().place[0] + 0.3, 1e-9);
}

TEST(MaterialPoints, RefuseWhatIsNotPossible) {
  const SnowLaw law;
  MaterialPoints<2> world(MpmSettings{}, law);
  MaterialPoint<2> point;
  EXPECT_EQ(error_of([&] { world.add({point}); }), "snow: mass of a particle is 0, must be positive");
  point.mass = point.volume = 1;
  point.place[0] = std::nan("");
  EXPECT_EQ(error_of([&] { world.add({point}); }), "snow: particle 0 is not finite");
  point.place[0] = 1e9;
  EXPECT_NE(error_of([&] { world.add({point}); }).find("must stay within"), std::string::npos);
  EXPECT_EQ(error_of([&] { world.advance(-1); }), "mpm: duration is -1, must be at least 0 and finite");
  SnowLaw bad;
  bad.youngs_modulus = 0;
  EXPECT_EQ(error_of([&] { MaterialPoints<2>(MpmSettings{}, bad); }),
            "snow: Young's modulus is 0, must be from 1e2 to 1e11 Pa");
  EXPECT_EQ(error_of([&] {
              filled_box<2>({Point<2>::Zero(), Eigen::Matrix2d::Identity(), {1, 0}}, law, 0.01, 4);
            }),
            "snow: size of a body is 0, must be positive");
}

}  // namespace
}  // namespace aeolian
