// Studies of many slides as people run them, on small coarse panels, and the surrogate that is shipped.
#include <cstdlib>
#include <filesystem>
#include <string>

#include "../temporary_folder.hpp"
#include "program_outcome.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/csv.hpp"

namespace aeolian {
namespace {

namespace fs = std::filesystem;

const std::string scene =
    "name: small\n"
    "snow: {density_kg_m3: 210, youngs_modulus_mpa: 0.5, poisson_ratio: 0.3, m: 0.5, p0_kpa: 7, beta: 0.2, "
    "xi: 0.1}\n"
    "panel: {length_m: 0.12, width_m: 0.1, tilt_deg: 45, height_m: 0.25, height_of: centre, friction: 0.2}\n"
    "slab: {thickness_m: 0.02, width_m: 0.06}\n"
    "grid: {cell_m: 0.01, particles_per_cell: 4, transfer: apic}\n"
    "events: 2\n"
    "between_events: keep\n";
const std::string table =
    "scene: small.yaml\npanel_length_m: [0.08, 0.14]\npanel_height_m: [0.25, 0.25]\ntilt_deg: [45, 50]\n"
    "thickness_m: [0.02, 0.02]\ncells_per_thickness: 2\nruns: 10\nevents: 1\n";
const std::string shipped = AEOLIAN_REPOSITORY "/config/slide/piles_2d.yaml";

std::string without_first_line(const std::string& text) { return text.substr(text.find('\n') + 1); }

class SlideStudies : public testing::Test {
 protected:
  SlideStudies() {
    folder_.write("small.yaml", scene);
    folder_.write("piles.yaml", table);
  }
  Outcome run(const std::string& arguments) const {
    return run_program("slide_snow " + arguments, folder_.path());
  }
  std::string piles(const std::string& out) const {
    return without_first_line(content_of(folder_.file(out + "/piles.csv")));
  }
  const TemporaryFolder folder_;
};

TEST_F(SlideStudies, ATableIsTheSameStoppedSharedOrAtOnce) {
  const Outcome at_once = run("--make-table piles.yaml --threads 1 --out alone");
  ASSERT_EQ(at_once.code, 0) << at_once.err;
  EXPECT_EQ(read_csv(folder_.file("alone/piles.csv")).rows(), 10U);
  EXPECT_TRUE(fs::exists(folder_.file("alone/piles_surrogate.yaml")));
  EXPECT_FALSE(fs::exists(folder_.file("alone/unfinished.csv")));
  const std::string head = content_of(folder_.file("alone/piles.csv"));
  EXPECT_EQ(head.rfind("# slide_snow of aeolian_twin ", 0), 0U) << head.substr(0, 100);
  EXPECT_NE(head.find("rosrun aeolian_twin slide_snow --make-table piles.yaml"), std::string::npos);

  const std::string stop_soon = "cd " + folder_.path() +
                                " && timeout -s INT 1 " AEOLIAN_BIN
                                "/slide_snow --make-table piles.yaml --out twice > /dev/null 2>&1";
  ASSERT_NE(std::system(stop_soon.c_str()), -1);
  const Outcome rest = run("--make-table piles.yaml --out twice");
  ASSERT_EQ(rest.code, 0) << rest.err;
  EXPECT_EQ(piles("twice"), piles("alone"));

  const std::string shared = "cd " + folder_.path() +
                             " && mpirun --allow-run-as-root --oversubscribe -n 2 " AEOLIAN_BIN
                             "/slide_snow --make-table piles.yaml --threads 1 --out shared > log 2>&1";
  ASSERT_EQ(std::system(shared.c_str()), 0) << content_of(folder_.file("log"));
  EXPECT_EQ(piles("shared"), piles("alone"));
}

TEST_F(SlideStudies, AnUnfinishedStudyOfOtherSettingsIsRefused) {
  fs::create_directories(folder_.file("out"));
  folder_.write("out/unfinished.csv",
                "# aeolian: slides of a study that is not finished; the same command goes on\n# other\n");
  const Outcome outcome = run("--make-table piles.yaml --out out");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(
      outcome.err,
      "slide_snow: out/unfinished.csv: is of a study with other settings; give another --out, or --fresh to "
      "begin anew\n");
}

TEST_F(SlideStudies, RefusesBadTablesOfPanels) {
  const auto refusal = [&](const std::string& from, const std::string& to) {
    std::string text = table;
    folder_.write("bad.yaml", text.replace(text.find(from), from.size(), to));
    const Outcome outcome = run("--make-table bad.yaml --out out");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_FALSE(fs::exists(folder_.file("out")));
    return outcome.err;
  };
  EXPECT_EQ(refusal("[45, 50]", "[50, 45]"),
            "slide_snow: bad.yaml:4: tilt_deg is [50, 45], must be [low, high], rising within 1 to 89\n");
  EXPECT_EQ(refusal("runs: 10", "runs: 3"),
            "slide_snow: table of piles: runs is 3, must be at least 4: the corners of the ranges\n");
}

TEST_F(SlideStudies, TheShippedSurrogateAnswersAndSaysByWhat) {
  const Outcome outcome =
      run("--predict --table " + shipped +
          " --panel-length 2 --panel-height 1 --tilt-deg 40 --thickness-m 0.05 --event 3");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.rfind("height ", 0), 0U) << outcome.out;
  EXPECT_NE(outcome.out.find("\nlength "), std::string::npos);
  EXPECT_NE(outcome.out.find("\nH/L    "), std::string::npos);
  EXPECT_NE(outcome.out.find("by support vectors ("), std::string::npos);
}

TEST_F(SlideStudies, OutsideTheTableItSimulatesAndSaysSo) {
  const Outcome outcome =
      run("--predict --table " + shipped +
          " --panel-length 0.15 --panel-height 0.3 --tilt-deg 45 --thickness-m 0.05 --event 1");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.rfind("outside the surrogate: panel length is 0.15 m, ", 0), 0U) << outcome.out;
  EXPECT_NE(outcome.out.find("simulated instead (MPM"), std::string::npos);
  EXPECT_NE(outcome.out.find("\nheight 0."), std::string::npos);
}

TEST_F(SlideStudies, CalibratesOnTheLaboratorysPiles) {
  folder_.write("lab.csv", "tilt_deg,event,height_m,length_m\n45,1,0.03,0.2\n");
  folder_.write("calibration.yaml",
                "scene: small.yaml\ndimensions: 2\ncells_per_thickness: 2\nm: [0.3, 0.7]\np0_kpa: [7]\nbeta: "
                "[0.2]\npanel_friction: [0.2]\nrefinements: 2\n");
  const Outcome outcome = run("--calibrate lab.csv --config calibration.yaml --out results");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Table sets = read_csv(folder_.file("results/calibration.csv"));
  ASSERT_EQ(sets.rows(), 4U);
  EXPECT_EQ(sets.column("refined")[3], 1);
  EXPECT_NE(outcome.out.find("panel friction 0.2: score "), std::string::npos) << outcome.out;
  // What it writes is a scene.
  EXPECT_EQ(run("--config results/calibrated.yaml --events 1 --out again").code, 0);
}

TEST_F(SlideStudies, TellsSensitivities) {
  folder_.write(
      "sensitivity.yaml",
      "scene: small.yaml\npanel_height_m: 0.25\ndimensions: 2\ncells_per_thickness: 2\nevents: 1\nseeds: 2\n"
      "m: [0.3, 0.6]\np0_kpa: [3, 6]\nbeta: [0.15, 0.3]\nxi: [0.1, 0.2]\nyoungs_modulus_mpa: [0.5, 0.6]\n");
  const Outcome outcome = run("--sensitivity --config sensitivity.yaml --out results");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.rfind("M    event 1: height ", 0), 0U) << outcome.out;
  EXPECT_NE(content_of(folder_.file("results/sensitivity.csv")).find("\nbeta,1,"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder_.file("results/sensitivity.svg")));
}

TEST_F(SlideStudies, RefusesFlagsThatDoNotBelongTogether) {
  EXPECT_EQ(run("--predict --make-table piles.yaml --out out").code, 1);
  EXPECT_EQ(run("--panel-length 2").code, 1);
  EXPECT_EQ(run("--sensitivity --out out").err, "slide_snow: --config is required\n");
  EXPECT_EQ(run("--config small.yaml").err, "slide_snow: --out is required\n");
  EXPECT_NE(run("--predict --event 0").code, 0);
  EXPECT_EQ(run("--predict --table " + shipped + " --panel-length nan").code, 1);
}

}  // namespace
}  // namespace aeolian
