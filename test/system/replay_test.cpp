/// replay as people run it, on small field days.
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <thread>

#include "../child_process.hpp"
#include "../temporary_folder.hpp"
#include "field_bag.hpp"
#include "program_outcome.hpp"
#include <aeolian_msgs/Comparison.h>
#include <gtest/gtest.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>
#include <sys/wait.h>

#include "aeolian_core/twin/forecast.hpp"

namespace aeolian {
namespace {

namespace fs = std::filesystem;

const std::string twin_config = std::string(AEOLIAN_REPOSITORY) + "/test/system/replay.yaml";

std::map<std::string, std::size_t> topics_of(const std::string& path) {
  const rosbag::Bag bag(path);
  std::map<std::string, std::size_t> topics;
  for (const rosbag::MessageInstance& message : rosbag::View(bag)) ++topics[message.getTopic()];
  return topics;
}

class Replay : public testing::Test {
 protected:
  std::string day(const std::string& name, const SmallDay& small = {}) const {
    const std::string path = folder_.file(name);
    write_small_day(path, small);
    return path;
  }
  /// Runs it into the folder `out`.
  Outcome run(const std::string& bags, const std::string& with = twin_config,
              const std::string& out = "out") const {
    return run_program("replay " + bags + " --config " + with + " --out " + folder_.file(out));
  }
  /// Expects exit code 1, one line that holds `part`, and no bag.
  void expect_refusal(const std::string& bags, const std::string& part,
                      const std::string& with = twin_config) const {
    const Outcome outcome = run(bags, with, "refused");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(fs::exists(folder_.file("refused/twin.bag")));
  }

  const TemporaryFolder folder_;
};

TEST_F(Replay, WritesWhatTheNodesWouldPublishAndAReport) {
  const Outcome outcome = run(day("field.bag"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out, folder_.file("out/report/index.html") + "\n");
  const std::map<std::string, std::size_t> expected{
      {"/wind_field", 9}, {"/height_map", 9}, {"/forecast", 10}, {"/comparison", 7}, {"/difference", 7}};
  const std::map<std::string, std::size_t> written = topics_of(folder_.file("out/twin.bag"));
  for (const auto& [topic, count] : expected) {
    ASSERT_EQ(written.count(topic), 1U) << topic;
    EXPECT_EQ(written.at(topic), count) << topic;
  }
  const std::string page = content_of(folder_.file("out/report/index.html"));
  EXPECT_NE(page.find("From field.bag"), std::string::npos);

  const rosbag::Bag bag(folder_.file("out/twin.bag"));
  for (const rosbag::MessageInstance& m : rosbag::View(bag, rosbag::TopicQuery("/comparison"))) {
    const auto comparison = m.instantiate<aeolian_msgs::Comparison>();
    EXPECT_LT(comparison->rmse, 0.001);
    EXPECT_NEAR(comparison->wavelength_measured, 0.04, 0.002);
  }
}

TEST_F(Replay, TheSameBitsOnOneCoreAndOnAll) {
  const std::string bag = day("field.bag");
  ASSERT_EQ(run(bag, twin_config, "all").code, 0);
  const std::string one = "taskset -c 0 " AEOLIAN_BIN "/replay " + bag + " --config " + twin_config +
                          " --out " + folder_.file("one") + " > " + folder_.file("log");
  ASSERT_EQ(std::system(one.c_str()), 0);
  EXPECT_TRUE(content_of(folder_.file("one/twin.bag")) == content_of(folder_.file("all/twin.bag")));
}

TEST_F(Replay, WhatIsDoneIsNotDoneAgainUnlessItWouldDiffer) {
  const std::string bag = day("field.bag");
  ASSERT_EQ(run(bag).code, 0);
  const auto written = [&] { return fs::last_write_time(folder_.file("out/twin.bag")); };
  const auto first = written();
  ASSERT_EQ(run(bag).code, 0);
  EXPECT_EQ(written(), first);
  std::string text = content_of(twin_config);
  text.replace(text.find("period: 2.0"), 11, "period: 4.0");
  ASSERT_EQ(run(bag, folder_.write("other.yaml", text)).code, 0);
  EXPECT_GT(written(), first);
  EXPECT_EQ(topics_of(folder_.file("out/twin.bag"))["/forecast"], 6U);
}

TEST_F(Replay, ACloudWaitsForItsTransform) {
  SmallDay late;
  late.tf_delay = 2.2;
  const Outcome outcome = run(day("late.bag", late));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(topics_of(folder_.file("out/twin.bag"))["/height_map"], 9U) << "none was lost";
}

TEST_F(Replay, SeveralBagsOfWhichOneIsBad) {
  SmallDay calm;
  calm.wind = false;
  fs::create_directories(folder_.file("days"));
  day("days/a.bag");
  day("days/b.bag", calm);
  SmallDay longer;
  longer.seconds = 10;
  day("days/c.bag", longer);
  const Outcome outcome = run(folder_.file("days"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("days/b.bag: there is no wind on /wind; its topics are: /points, /tf_static"),
            std::string::npos)
      << outcome.err;
  EXPECT_TRUE(fs::exists(folder_.file("out/a/report/index.html")));
  EXPECT_TRUE(fs::exists(folder_.file("out/c/report/index.html")));
  const std::string table = content_of(folder_.file("out/summary.csv"));
  EXPECT_NE(table.find("\n\"a\",\"\",8,9,10,7,4,"), std::string::npos) << table;
  EXPECT_NE(table.find("\n\"b\",\"bag "), std::string::npos) << table;
  EXPECT_NE(table.find("\n\"c\",\"\",10,11,12,9,4,"), std::string::npos) << table;
  const std::string page = content_of(folder_.file("out/index.html"));
  EXPECT_NE(page.find("2 of 3 bags were replayed"), std::string::npos);
  EXPECT_NE(page.find("href=\"c/report/index.html\""), std::string::npos);
}

TEST_F(Replay, ProcessesOfMpirunShareTheBagsWithTheSameResult) {
  fs::create_directories(folder_.file("days"));
  for (const char* name : {"days/a.bag", "days/b.bag", "days/c.bag"}) {
    SmallDay small;
    small.seconds = 6 + name[5] % 3;
    day(name, small);
  }
  ASSERT_EQ(run(folder_.file("days"), twin_config, "alone").code, 0);
  const std::string command = "mpirun --allow-run-as-root --oversubscribe -n 2 " AEOLIAN_BIN "/replay " +
                              folder_.file("days") + " --config " + twin_config + " --out " +
                              folder_.file("together") + " > " + folder_.file("log") + " 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0) << content_of(folder_.file("log"));
  for (const char* file : {"summary.csv", "index.html", "a/twin.bag", "b/twin.bag", "c/twin.bag"})
    EXPECT_TRUE(content_of(folder_.file("alone/") + file) == content_of(folder_.file("together/") + file))
        << file;
}

TEST_F(Replay, StoppedItLeavesWhatIsWhole) {
  SmallDay longer;
  longer.seconds = 300;
  const std::string bag = day("field.bag", longer);
  ChildProcess replay(
      {std::string(AEOLIAN_BIN) + "/replay", bag, "--config", twin_config, "--out", folder_.file("out")});
  const auto begun = [&] { return fs::exists(folder_.file("out")) && !fs::is_empty(folder_.file("out")); };
  for (int i = 0; i < 1000 && !begun(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ASSERT_TRUE(begun());
  replay.end(SIGINT);
  EXPECT_TRUE(fs::is_empty(folder_.file("out")));
}

TEST_F(Replay, RefusesBagsThatCannotDo) {
  SmallDay small;
  small.wind = false;
  expect_refusal(day("calm.bag", small),
                 "calm.bag: there is no wind on /wind; its topics are: /points, /tf_static");
  small = {};
  small.clouds = false;
  expect_refusal(day("blind.bag", small),
                 "blind.bag: there are no clouds on /points; its topics are: /tf_static, /wind");
  expect_refusal(folder_.file("absent.bag"), "absent.bag: there is no such file");
  expect_refusal(folder_.write("text.bag", "no bag\n"), "text.bag: cannot be read");

  const std::string whole = content_of(day("field.bag"));
  expect_refusal(folder_.write("cut.bag", whole.substr(0, whole.size() / 2)), "cut.bag: ");
  {
    rosbag::Bag open(folder_.file("open.bag"), rosbag::bagmode::Write);
    open.write("/wind", SmallDay::start(), small_wind(0));
    fs::copy_file(folder_.file("open.bag"), folder_.file("unindexed.bag"));
  }
  expect_refusal(folder_.file("unindexed.bag"), "unindexed.bag: has no index (its recording was cut off?)");

  rosbag::Bag bag(folder_.file("typed.bag"), rosbag::bagmode::Write);
  bag.write("/wind", SmallDay::start(), std_msgs::String());
  bag.write("/points", SmallDay::start(), small_cloud(0));
  bag.close();
  expect_refusal(folder_.file("typed.bag"),
                 "topic /wind holds std_msgs/String, must be geometry_msgs/TwistStamped");
}

TEST_F(Replay, ABagWithoutTransformsLeadsToNoMap) {
  SmallDay small;
  small.tf = false;
  const Outcome outcome = run(day("lost.bag", small));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("lost.bag: there is no map: "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("no transform from 'scanner' to 'map'"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder_.file("out/twin.bag")));
}

TEST_F(Replay, RefusesParametersAsTheNodesDo) {
  const std::string bag = day("field.bag");
  const auto with = [&](const std::string& text) { return folder_.write("twin.yaml", text); };
  expect_refusal(bag, "twin.yaml: height_mapper/cell_size: -1 is not allowed, must be a number above 0 [m]",
                 with("height_mapper: {cell_size: -1}"));
  expect_refusal(bag, "twin.yaml: forecaster/horizon: there is no such parameter",
                 with("forecaster: {horizon: 3}"));
  expect_refusal(bag, "twin.yaml: topics/point: there is no such parameter",
                 with("topics: {point: /points}"));
  expect_refusal(bag, "twin.yaml:1: there is no section 'mapper'", with("mapper: {cell_size: 1}"));
  expect_refusal(bag, "there are no clouds on /scans", with("topics: {points: /scans}"));
  expect_refusal(bag, "height_mapper/incremental: true is not allowed",
                 with("height_mapper: {incremental: true}"));
  expect_refusal(bag, "no.yaml: cannot be read", folder_.file("no.yaml"));
  expect_refusal(bag + " " + bag, "two bags are called 'field'");
  fs::create_directories(folder_.file("empty"));
  expect_refusal(folder_.file("empty"), "there is no *.bag in it");
}

}  // namespace
}  // namespace aeolian
