// Bed models on scenes that nobody would choose: ./twin stress
#include <algorithm>
#include <memory>
#include <string>

#include "bed_scenes.hpp"
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "aeolian_core/bedforms/height_map/ripple_model.hpp"
#include "aeolian_core/bedforms/sorting/sorted_ripple_model.hpp"

namespace aeolian {
namespace {

constexpr std::uint64_t scenes = 150;

double range_of(const HeightMap::Layer& heights) {
  double low = 1e300;
  double high = -1e300;
  for (const float h : heights) {
    if (!std::isfinite(h)) continue;
    low = std::min(low, static_cast<double>(h));
    high = std::max(high, static_cast<double>(h));
  }
  return high < low ? 0 : high - low;
}

/// What holds for a bed after any wind.
void expect_sound(const BedScene& scene, const HeightMap::Layer& start, const BedChange& change) {
  const HeightMap::Layer& now = scene.map.layer(layer::elevation);
  const GridGeometry& g = scene.map.geometry();
  const double area = g.cell() * g.cell();
  double largest = 0;
  double volume = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    ASSERT_EQ(std::isfinite(start[i]), std::isfinite(now[i])) << "cell " << i;
    if (!std::isfinite(now[i])) continue;
    largest =
        std::max({largest, std::abs(static_cast<double>(start[i])), std::abs(static_cast<double>(now[i]))});
    volume += (static_cast<double>(now[i]) - static_cast<double>(start[i])) * area;
  }
  // Cells are floats, and pass on what rounding takes from them.
  const double float_rounding = 2.4e-7 * largest;
  const double cells = static_cast<double>(now.size());
  const double unaccounted = change.volume.change - change.volume.inflow + change.volume.outflow;
  EXPECT_LT(std::abs(unaccounted), 1e-9 * change.volume.moved + 1e-15 * largest * area * cells);
  EXPECT_NEAR(volume, change.volume.change, float_rounding * area * cells + 1e-9 * change.volume.moved);

  if (scene.map.has(layer::ground))
    for (std::size_t i = 0; i < now.size(); ++i) {
      const float ground = scene.map.layer(layer::ground)[i];
      if (!std::isfinite(ground) || !std::isfinite(now[i])) continue;
      ASSERT_GE(now[i], std::min(ground, start[i]) - float_rounding - 1e-7F)
          << "cell " << i << " dug into the ground";
    }
  // What is steeper than repose slides, so the bed's range cannot outgrow its extent; holes are walls.
  if (count_known(start) < start.size()) return;
  const double extent = std::hypot(g.length_x(), g.length_y());
  EXPECT_LE(range_of(now), range_of(start) + extent * std::tan(scene.forcing.grain.angle_of_repose));
}

struct Kind {
  Border border;
  bool two_sizes;

  std::string told() const {
    return std::string(two_sizes ? "two_sizes_" : "one_size_") +
           (border == Border::open ? "open" : "periodic");
  }
  std::unique_ptr<BedModel> model(const Forcing& forcing) const {
    RippleParameters parameters;
    parameters.border = border;
    if (!two_sizes) return std::make_unique<RippleModel>(parameters);
    SortedRippleParameters sorted = sizes(forcing);
    sorted.ripples = parameters;
    return std::make_unique<SortedRippleModel>(sorted);
  }
  static SortedRippleParameters sizes(const Forcing& forcing) {
    SortedRippleParameters sorted;
    sorted.coarse_diameter = 2.5 * forcing.grain.diameter;
    return sorted;
  }
  /// Two sizes step by their active layer, which may be a millionth of a cell: their times are shorter.
  BedScene scene(std::uint64_t seed, const SceneKind& kind) const {
    BedScene drawn = draw_scene(seed, kind);
    if (!two_sizes) return drawn;
    const double exposed =
        1 + std::tan(drawn.forcing.grain.angle_of_repose) / std::tan(drawn.forcing.impact_angle);
    const double layer = sizes(drawn.forcing).layers().active;
    drawn.duration = std::min(drawn.duration, 200 * layer / (exposed * drawn.forcing.erosion_rate()));
    return drawn;
  }
  void run_all(const SceneKind& kind) const {
    for (std::uint64_t seed = 1; seed <= scenes; ++seed) {
      BedScene scene = this->scene(seed, kind);
      SCOPED_TRACE(fmt::format("seed {}: {}", seed, scene.told()));
      const HeightMap::Layer start = scene.map.layer(layer::elevation);
      expect_sound(scene, start, model(scene.forcing)->advance(scene.map, scene.forcing, scene.duration));
      if (testing::Test::HasFatalFailure()) return;
    }
  }
};

class AnyModel : public testing::TestWithParam<Kind> {};

TEST_P(AnyModel, sand_everywhere) { GetParam().run_all({}); }

TEST_P(AnyModel, a_wind_that_reverses_every_step) {
  for (std::uint64_t seed = 1; seed <= scenes / 10; ++seed) {
    BedScene scene = GetParam().scene(seed, {});
    SCOPED_TRACE(fmt::format("seed {}: {}", seed, scene.told()));
    const std::unique_ptr<BedModel> model = GetParam().model(scene.forcing);
    for (int turn = 0; turn < 50; ++turn) {
      const HeightMap::Layer start = scene.map.layer(layer::elevation);
      expect_sound(scene, start, model->advance(scene.map, scene.forcing, scene.duration / 50));
      if (HasFatalFailure()) return;
      scene.forcing.direction += M_PI;
    }
  }
}

TEST_P(AnyModel, as_many_threads_as_there_are_give_the_bits_of_one) {
  for (std::uint64_t seed = 1; seed <= scenes / 10; ++seed) {
    BedScene one = GetParam().scene(seed, {false, !GetParam().two_sizes && seed % 2 == 0});
    BedScene many = one;
    {
      const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
      GetParam().model(one.forcing)->advance(one.map, one.forcing, one.duration);
    }
    GetParam().model(many.forcing)->advance(many.map, many.forcing, many.duration);
    EXPECT_EQ(one.map.layer(layer::elevation), many.map.layer(layer::elevation)) << one.told();
  }
}

INSTANTIATE_TEST_SUITE_P(RippleModels, AnyModel,
                         testing::Values(Kind{Border::open, false}, Kind{Border::periodic, false},
                                         Kind{Border::open, true}, Kind{Border::periodic, true}),
                         [](const auto& kind) { return kind.param.told(); });

TEST(RippleModelStress, sand_on_open_hard_ground) { Kind{Border::open, false}.run_all({false, true}); }
TEST(RippleModelStress, sand_on_periodic_hard_ground) {
  Kind{Border::periodic, false}.run_all({false, true});
}

TEST(RippleModelStress, holes_stay_holes_and_swallow_nothing) {
  for (const bool ground : {false, true}) Kind{Border::open, false}.run_all({true, ground});
}

/// Sand of two sizes lies in holes too, which the map does not tell: its volume is not that of the map.
TEST(SortedRippleModelStress, holes_stay_holes) {
  const Kind kind{Border::open, true};
  for (std::uint64_t seed = 1; seed <= scenes; ++seed) {
    BedScene scene = kind.scene(seed, {true, false});
    SCOPED_TRACE(fmt::format("seed {}: {}", seed, scene.told()));
    const HeightMap::Layer start = scene.map.layer(layer::elevation);
    kind.model(scene.forcing)->advance(scene.map, scene.forcing, scene.duration);
    const HeightMap::Layer& now = scene.map.layer(layer::elevation);
    for (std::size_t i = 0; i < now.size(); ++i)
      ASSERT_EQ(std::isfinite(start[i]), std::isfinite(now[i])) << "cell " << i;
  }
}

}  // namespace
}  // namespace aeolian
