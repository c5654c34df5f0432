// slide_snow as people run it, on a small coarse panel.
#include <filesystem>
#include <string>

#include "../temporary_folder.hpp"
#include "bad_config.hpp"
#include "program_outcome.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/csv.hpp"

namespace aeolian {
namespace {

namespace fs = std::filesystem;

const std::string slide_config =
    "name: small\n"
    "snow: {density_kg_m3: 210, youngs_modulus_mpa: 0.5, poisson_ratio: 0.3, m: 0.5, p0_kpa: 7, beta: 0.2, "
    "xi: 0.1}\n"
    "panel: {length_m: 0.12, width_m: 0.1, tilt_deg: 45, height_m: 0.25, height_of: centre, friction: 0.2}\n"
    "slab: {thickness_m: 0.02, width_m: 0.06}\n"
    "grid: {cell_m: 0.01, particles_per_cell: 4, transfer: apic}\n"
    "events: 2\n"
    "between_events: keep\n";

class SlideSnow : public testing::Test {
 protected:
  SlideSnow() { folder_.write("small.yaml", slide_config); }
  Outcome run(const std::string& arguments) const {
    return run_program("slide_snow " + arguments, folder_.path());
  }
  void expect_refusal(const std::string& from, const std::string& to, const std::string& line) const {
    ConfiguredProgram{"slide_snow", slide_config}.expect_refusal(folder_, from, to, line);
  }
  const TemporaryFolder folder_;
};

TEST_F(SlideSnow, WritesAllItsResults) {
  const Outcome outcome = run("--config small.yaml --threads 1 --out results");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find("event 2: pile "), std::string::npos);
  for (const char* name : {"events.csv", "events.yaml", "particles_01.csv", "pile_02.csv", "event_02.png",
                           "profiles.svg", "growth.svg"})
    EXPECT_TRUE(fs::exists(folder_.file(std::string("results/") + name))) << name;
  const Table events = read_csv(folder_.file("results/events.csv"));
  ASSERT_EQ(events.rows(), 2U);
  const double slab = 210 * 0.12 * 0.02;
  EXPECT_NEAR(events.column("mass_kg_m")[0] + events.column("left_on_panel_kg_m")[0], slab, 1e-9);
  EXPECT_GT(events.column("height_m")[1], 0.01);
}

TEST_F(SlideSnow, ThreeDimensionsGiveAMap) {
  const Outcome outcome = run("--config small.yaml --threads 1 --dim 3 --events 1 --out results");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(folder_.file("results/pile_01.tif")));
}

TEST_F(SlideSnow, RefusesBadScenesInOneLine) {
  expect_refusal("thickness_m: 0.02", "thickness_m: 0",
                 "bad.yaml:4: slab.thickness_m is '0', must be positive");
  expect_refusal("transfer: apic", "transfer: pic",
                 "bad.yaml:5: grid.transfer is 'pic', must be apic or flip");
  expect_refusal("events: 2", "evnts: 2", "bad.yaml: there is no key 'events'");
  expect_refusal(
      "height_m: 0.25", "height_m: 0.01",
      "slide: the lower side of the panel above the ground is -0.0607107, must be positive: it is four cells "
      "thick, and must not be in the ground");
  const Outcome missing = run("--config nothing.yaml --out results");
  EXPECT_EQ(missing.code, 1);
  EXPECT_EQ(missing.err, "slide_snow: nothing.yaml: cannot be read\n");
}

}  // namespace
}  // namespace aeolian
