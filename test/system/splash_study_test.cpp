// splash_study as people run it, on beds that are small and soft.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "../temporary_folder.hpp"
#include "bad_config.hpp"
#include "program_outcome.hpp"
#include "running_program.hpp"
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <sys/wait.h>

#include "aeolian_core/grains/splash/splash_table.hpp"
#include "aeolian_core/surface/csv.hpp"

namespace aeolian {
namespace {

namespace fs = std::filesystem;

const std::string splash_config =
    "name: small\n"
    "shape: discs\n"
    "grains: {diameter_mm: 20, density_kg_m3: 2000}\n"
    "contact: {law: spring, stiffness_n_m: 6.0e+4, restitution: 0.85, friction: 0.5, steps_per_contact: 24}\n"
    "beds:\n"
    "  - {packing: loose, grains: 50, length_diameters: 10.5, beds: 2}\n"
    "impacts: {speeds_m_s: [12], angles_deg: [30], size_ratios: [1], number: 6, follow_sqrt_r_g: 1.5}\n";

class SplashStudy : public testing::Test {
 protected:
  SplashStudy() { folder_.write("small.yaml", splash_config); }
  Outcome run(const std::string& arguments) const {
    return run_program("splash_study " + arguments, folder_.path());
  }
  /// Exit code of a command that may begin with other programs than ours.
  int run_shell(const std::string& command) const {
    const int status = std::system(("cd '" + folder_.path() + "' && " + command + " > out 2> err").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  void expect_refusal(const std::string& from, const std::string& to, const std::string& line) const {
    ConfiguredProgram{"splash_study", splash_config}.expect_refusal(folder_, from, to, line);
  }
  const TemporaryFolder folder_;
};

TEST_F(SplashStudy, WritesAllItsResults) {
  const Outcome outcome = run("--config small.yaml --out results");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find("6 impacts -> results\n"), std::string::npos) << outcome.out;
  for (const char* name : {"beds.csv", "events.csv", "ejecta.csv", "summary.csv", "splash_table.csv",
                           "histograms.svg", "impact.png", "impact_00.png", "impact_08.png", "impact.webp"})
    EXPECT_TRUE(fs::exists(folder_.file(std::string("results/") + name))) << name;
  EXPECT_GT(cv::imread(folder_.file("results/impact.png")).cols, 1500);
  const SplashTable written = SplashTable::read(folder_.file("results/splash_table.csv"));
  EXPECT_EQ(written.events(), 6U);
  EXPECT_EQ(written.source().command, "rosrun aeolian_twin splash_study --config small.yaml --out results");
  EXPECT_NE(content_of(folder_.file("results/summary.csv")).find(",rebound_speed,"), std::string::npos);
  EXPECT_EQ(content_of(folder_.file("results/impact.webp")).substr(0, 4), "RIFF");
}

TEST_F(SplashStudy, ThreadsDoNotMatter) {
  const std::string program = AEOLIAN_BIN "/splash_study --config small.yaml --impacts 3";
  ASSERT_EQ(run_shell("taskset -c 0 " + program + " --out one"), 0);
  ASSERT_EQ(run_shell(program + " --out two"), 0);
  const auto content = [&](const std::string& name) { return content_of(folder_.file(name)); };
  for (const char* name : {"/events.csv", "/ejecta.csv", "/summary.csv", "/beds.csv"}) {
    EXPECT_EQ(content(std::string("one") + name), content(std::string("two") + name)) << name;
  }
}

TEST_F(SplashStudy, CtrlCKeepsWhatIsDone) {
  const int code = run_shell("timeout --preserve-status -s INT 3 " AEOLIAN_BIN
                             "/splash_study --config small.yaml --impacts 100000 --out results");
  EXPECT_EQ(code, 130);
  const std::string told = content_of(folder_.file("err"));
  EXPECT_NE(told.find("splash_study: stopped; "), std::string::npos) << told;
  EXPECT_NE(told.find(" of 100000 impacts are done and written to results"), std::string::npos) << told;
  const std::string events = content_of(folder_.file("results/events.csv"));
  EXPECT_GT(std::count(events.begin(), events.end(), '\n'), 1);
  EXPECT_FALSE(fs::exists(folder_.file("results/splash_table.csv")));
}

/// Killed again and again, with half a row at the journal's end: no file tells.
TEST_F(SplashStudy, AKilledStudyGoesOnAndItsResultsDoNotTell) {
  const std::string arguments = "--config " + folder_.file("small.yaml") + " --impacts 60 --out results";
  const std::string whole = folder_.file("whole"), broken = folder_.file("broken");
  for (const std::string& place : {whole, broken}) fs::create_directory(place);
  ASSERT_EQ(run_program("splash_study " + arguments, whole).code, 0);
  const std::string journal = broken + "/results/unfinished.csv";
  const auto rows = [&] {
    const std::string text = content_of(journal);
    return std::count(text.begin(), text.end(), '\n') - std::count(text.begin(), text.end(), '#');
  };
  for (const int enough : {5, 20}) {
    RunningProgram study("splash_study", {"--config", folder_.file("small.yaml"), "--impacts", "60", "--out",
                                          broken + "/results"});
    while (study.lives() && rows() < enough) std::this_thread::yield();
    study.kill_now();
    EXPECT_GE(rows(), enough);
    EXPECT_LT(rows(), 60);
    EXPECT_FALSE(fs::exists(broken + "/results/summary.csv"));
    std::ofstream(journal, std::ios::app) << "0,59,12,0.5235";
  }
  const Outcome last = run_program("splash_study " + arguments, broken);
  EXPECT_EQ(last.code, 0) << last.err;
  EXPECT_EQ(last.out.find("goes on after "), 0U) << last.out;
  EXPECT_FALSE(fs::exists(journal));
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(whole + "/results")) {
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(content_of(entry.path().string()), content_of(broken + "/results/" + name)) << name;
    ++files;
  }
  EXPECT_GE(files, 16U);
}

TEST_F(SplashStudy, AnUnfinishedStudyOfOtherSettingsIsKeptUnlessAskedFor) {
  const std::string base = "--config small.yaml --out results";
  fs::create_directory(folder_.file("results"));
  const auto kept = [&] { return content_of(folder_.file("results/unfinished.csv")); };
  folder_.write("results/unfinished.csv", "# of something else\n");
  const Outcome other = run(base);
  EXPECT_EQ(other.code, 1);
  EXPECT_EQ(other.err,
            "splash_study: results/unfinished.csv: is of a study with other settings; give another --out, or "
            "--fresh to begin anew\n");
  EXPECT_EQ(kept(), "# of something else\n");
  EXPECT_EQ(
      run_shell("timeout --preserve-status -s INT 2 " AEOLIAN_BIN "/splash_study --fresh --impacts 100000 " +
                base),
      130);
  const std::string journal = kept();  // with whole rows: the study ended itself
  EXPECT_NE(journal.find("# number: 100000\n# seed: 1\n"), std::string::npos) << journal;
  EXPECT_EQ(run(base + " --impacts 100000 --seed 2").code, 1);
  folder_.write("results/unfinished.csv", journal + "nonsense\n");
  EXPECT_EQ(
      run(base + " --impacts 100000").err,
      "splash_study: results/unfinished.csv: 'nonsense...' is no impact; --fresh begins the study anew\n");
  EXPECT_EQ(run(base + " --fresh").code, 0);
  EXPECT_FALSE(fs::exists(folder_.file("results/unfinished.csv")));
}

TEST_F(SplashStudy, RefusesWhatItCannotUse) {
  expect_refusal("name: small\n", "", "bad.yaml: there is no key 'name'");
  expect_refusal("shape: discs", "shape: cubes",
                 "bad.yaml:2: shape is 'cubes', must be one of discs, spheres");
  expect_refusal("diameter_mm: 20", "diameter_mm: -1",
                 "bad.yaml:3: grains.diameter_mm is '-1', must be from 0.01 to 1000");
  expect_refusal("law: spring", "law: glue",
                 "bad.yaml:4: contact.law is 'glue', must be one of spring, hertz_mindlin");
  expect_refusal("restitution: 0.85", "restitution: 1.5",
                 "bad.yaml:4: contact.restitution is '1.5', must be from 0.01 to 1");
  expect_refusal("packing: loose", "packing: heap",
                 "bad.yaml:6: beds[0].packing is 'heap', must be one of loose, dense, poured, struck");
  expect_refusal("speeds_m_s: [12]", "speeds_m_s: [12, 5]",
                 "bad.yaml:7: impacts.speeds_m_s[1] is '5', must be more than the one before");
  expect_refusal("angles_deg: [30]", "angles_deg: [0]",
                 "bad.yaml:7: impacts.angles_deg[0] is '0', must be from 1 to 90");
  expect_refusal("size_ratios: [1]", "size_ratios: []",
                 "bad.yaml:7: impacts.size_ratios is [], must have at least one number");
  expect_refusal("speeds_m_s: [12], ", "", "bad.yaml: impacts must have either speeds_m_s or speeds_sqrt_gd");
  expect_refusal("number: 6", "number: 6, wind: 3", "bad.yaml:7: unknown key 'impacts.wind'");
}

TEST_F(SplashStudy, RefusesBadFlags) {
  EXPECT_EQ(run("--config absent.yaml --out results").err, "splash_study: absent.yaml: cannot be read\n");
  EXPECT_EQ(run("--config small.yaml").code, 1);
  EXPECT_EQ(run("--config small.yaml --out results --angle 0").code, 1);
  EXPECT_EQ(run("--config small.yaml --out results --speed -3").code, 1);
  EXPECT_EQ(run("--config small.yaml --out results --impacts 0").code, 1);
  EXPECT_FALSE(fs::exists(folder_.file("results")));
}

TEST_F(SplashStudy, ShippedConfigsAreRead) {
  for (const auto& entry : fs::directory_iterator(fs::path(AEOLIAN_REPOSITORY) / "config/splash")) {
    const std::string name = entry.path().filename().string();
    if (name != "werner_case_a.yaml" && name != "werner_case_i.yaml" && name != "snow.yaml" &&
        name != "coarse_sand.yaml")
      continue;
    // With a folder that cannot be made: the config is read before.
    const Outcome outcome = run("--config '" + entry.path().string() + "' --out small.yaml/results");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.err.find("small.yaml/results"), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace aeolian
