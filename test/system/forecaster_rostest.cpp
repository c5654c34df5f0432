/// Where a forecaster has its saltation from: the law, a table of solved states, a table that cannot be used.
/// What it says of its uncertainty and of its wind.
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include "../temporary_folder.hpp"
#include "program_outcome.hpp"
#include "ros_test.hpp"
#include "running_program.hpp"
#include <aeolian_msgs/LearnedParameters.h>
#include <aeolian_msgs/WindAhead.h>
#include <grid_map_msgs/GridMap.h>
#include <gtest/gtest.h>
#include <std_srvs/SetBool.h>

#include "aeolian_core/bedforms/height_map/ripple_model.hpp"
#include "aeolian_core/saltation/saltation_source.hpp"
#include "aeolian_core/twin/forecast.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

const std::string shipped = AEOLIAN_REPOSITORY "/config/saltation/quartz_in_air.csv";
const GridGeometry geometry(0, 0, 0.005, 64, 32);
constexpr double horizon = 30;  // the first of the default

HeightMap ripples() {
  HeightMap map(geometry);
  HeightMap::Layer& elevation = map.add(layer::elevation);
  for (std::size_t i = 0; i < elevation.size(); ++i)
    elevation[i] =
        static_cast<float>(0.01 + 0.002 * std::sin(2 * M_PI * geometry.x(geometry.cell_at(i).x) / 0.08));
  return map;
}

WindField wind(double air_density) {
  WindField field;
  field.friction_velocity = 0.45;
  field.direction = 0.1;
  field.air_density = air_density;
  return field;
}

/// What a forecast must be that comes from this state.
HeightMap::Layer expected(const SaltationState& state) {
  const Grain grain;
  RippleParameters parameters;
  parameters.wavelength_law = make_wavelength_law("constant", 250);
  RippleModel model(parameters);
  const Forcing forcing = make_forcing(state, wind(1.225).direction, grain, MeanSplash{});
  return make_forecasts(ripples(), mean_forcing({forcing}, {1}), {horizon}, model)[0].map.layer(
      layer::elevation);
}

double largest_difference(const HeightMap::Layer& a, const HeightMap::Layer& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(double(a[i]) - b[i]));
  return largest;
}

class ForecasterTest : public ::testing::Test {
 protected:
  void TearDown() override { ros::param::del("/forecaster"); }  // the next one has its own parameters

  void start(const std::string& saltation, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"_saltation:=" + saltation, "_diagnostic_period:=0.1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    node_ = std::make_unique<RunningProgram>("forecaster", arguments);
    ASSERT_TRUE(wait_until([&] {
      return winds_.getNumSubscribers() > 0 && maps_.getNumSubscribers() > 0 && forecasts_.connected();
    }));
  }

  HeightMap::Layer forecast(double air_density = 1.225) {
    std_msgs::Header header;
    header.frame_id = "map";
    header.stamp = ros::Time(1000);
    winds_.publish(to_message(wind(air_density), geometry, header));
    // The wind is another topic: the map may overtake it, and then nothing comes of that map.
    const bool came = wait_until([&] {
      header.stamp += ros::Duration(1);
      maps_.publish(to_message(ripples(), header));
      return wait_until([&] { return !forecasts_.messages.empty(); }, 1);
    });
    EXPECT_TRUE(came);
    return came ? to_height_map(*forecasts_.messages.front()).layer(layer::elevation)
                : HeightMap::Layer(geometry.size());
  }

  /// A reading and a map of the same second; false when nothing comes of them.
  bool map_at(double time, double friction_velocity = 0.45) {
    std_msgs::Header header;
    header.frame_id = "map";
    header.stamp = ros::Time(time);
    WindField field = wind(1.225);
    field.friction_velocity = friction_velocity;
    winds_.publish(to_message(field, geometry, header));
    ros::WallDuration(0.2).sleep();  // another topic: the map may overtake it
    const std::size_t before = forecasts_.messages.size();
    HeightMap map = ripples();
    map.add(layer::variance, 1e-10F);  // so sure that any lesson sees the bed move
    maps_.publish(to_message(map, header));
    return wait_until([&] { return forecasts_.messages.size() > before; }, 2);
  }

  ros::NodeHandle nh_;
  ros::Publisher winds_ = nh_.advertise<grid_map_msgs::GridMap>("wind_field", 10);
  ros::Publisher maps_ = nh_.advertise<grid_map_msgs::GridMap>("height_map", 10);
  Listener<grid_map_msgs::GridMap> forecasts_{nh_, "forecast"};
  Diagnostics diagnostics_{nh_};
  const TemporaryFolder folder_;
  std::unique_ptr<RunningProgram> node_;
};

TEST_F(ForecasterTest, ATableGivesTheForecastOfItsStates) {
  start(shipped);
  const SaltationTable table = SaltationTable::read(shipped);
  const HeightMap::Layer solved = expected(table.state(wind(1.225).friction_velocity, Grain{}.diameter));
  const HeightMap::Layer by_law = expected(steady_saltation(wind(1.225).friction_velocity, Grain{}));
  EXPECT_GT(largest_difference(solved, by_law), 2e-5);
  EXPECT_LT(largest_difference(forecast(), solved), 1e-7);
  EXPECT_TRUE(diagnostics_.is_well("forecaster"));
}

TEST_F(ForecasterTest, ByDefaultItIsTheLaw) {
  start("law");
  EXPECT_LT(largest_difference(forecast(), expected(steady_saltation(0.45, Grain{}))), 1e-7);
}

TEST_F(ForecasterTest, ABadTableIsToldAndTheLawIsUsed) {
  std::string text = content_of(shipped);
  text.replace(text.find("hop_length_m"), 12, "hop_lenght_m");
  const std::string path = folder_.write("misspelt.csv", text);
  start(path);
  EXPECT_TRUE(diagnostics_.warns("forecaster",
                                 path + ": there is no column 'hop_length_m'; the three-number law is used"));
  EXPECT_LT(largest_difference(forecast(), expected(steady_saltation(0.45, Grain{}))), 1e-7);
}

TEST_F(ForecasterTest, AirThatTheTableDoesNotKnowIsTold) {
  start(shipped);
  std_msgs::Header header;
  header.frame_id = "map";
  header.stamp = ros::Time(1000);
  winds_.publish(to_message(wind(0.02), geometry, header));
  EXPECT_TRUE(diagnostics_.warns("forecaster", "density of the grain over that of the air is 132500"));
}

TEST_F(ForecasterTest, MembersTellTheSpreadAndLeaveTheElevation) {
  start("law", {"_members:=8", "_member_cell:=0.01"});
  EXPECT_LT(largest_difference(forecast(), expected(steady_saltation(0.45, Grain{}))), 1e-7);
  const HeightMap map = to_height_map(*forecasts_.messages.front());
  ASSERT_TRUE(map.has(layer::spread));
  for (const float spread : map.layer(layer::spread)) EXPECT_GT(spread, 0);
}

TEST_F(ForecasterTest, LearningIsSaidSavedGoneOnWithAndFrozen) {
  const std::string path = folder_.path() + "/learned.yaml";
  const std::vector<std::string> learning{"_members:=8",          "_learning:=on", "_learned_file:=" + path,
                                          "_learning_period:=30", "_max_gap:=31",  "_period:=30"};
  Listener<aeolian_msgs::LearnedParameters> learned{nh_, "learned"};
  start("law", learning);
  ASSERT_TRUE(map_at(1000));
  ASSERT_TRUE(map_at(1030));
  ASSERT_TRUE(wait_until([&] { return !learned.messages.empty(); }));
  EXPECT_EQ(learned.messages[0]->header.stamp, ros::Time(1030));
  EXPECT_EQ(learned.messages[0]->why_not, "");
  EXPECT_TRUE(learned.messages[0]->learned);
  EXPECT_TRUE(std::filesystem::exists(path));

  std_srvs::SetBool freeze;
  freeze.request.data = 1;
  ASSERT_TRUE(ros::service::call("freeze_learning", freeze));
  ASSERT_TRUE(map_at(1060));
  ASSERT_TRUE(wait_until([&] { return learned.messages.size() > 1; }));
  EXPECT_FALSE(learned.messages[1]->learned);
  EXPECT_EQ(learned.messages[1]->median, learned.messages[0]->median);

  node_.reset();
  learned.messages.clear();
  start("law", learning);
  ASSERT_TRUE(map_at(2000));
  ASSERT_TRUE(map_at(2030));
  ASSERT_TRUE(wait_until([&] { return !learned.messages.empty(); }));
  EXPECT_EQ(learned.messages.back()->updates, 2U);
}

TEST_F(ForecasterTest, SpikesOfTheWindAreToldAndLeftOut) {
  start("law");
  EXPECT_FALSE(map_at(1000, 9));
  EXPECT_TRUE(diagnostics_.warns("forecaster", "is 9, must be 0 to 3"));
  EXPECT_TRUE(map_at(1001));
}

TEST_F(ForecasterTest, WindAheadIsUsedAndToldWhenItIsLate) {
  start("law");
  ros::Publisher ahead = nh_.advertise<aeolian_msgs::WindAhead>("wind_ahead", 10);
  ASSERT_TRUE(wait_until([&] { return ahead.getNumSubscribers() > 0; }));
  aeolian_msgs::WindAhead calm;
  calm.header.frame_id = "map";
  calm.header.stamp = ros::Time(1000);
  calm.lead_time = {0, 300};
  calm.speed = {1, 1};
  calm.direction = {0, 0};
  calm.height = 1;
  ahead.publish(calm);
  ASSERT_TRUE(map_at(1000));
  const HeightMap map = to_height_map(*forecasts_.messages.front());
  EXPECT_EQ(map.layer(layer::elevation), ripples().layer(layer::elevation));
  EXPECT_TRUE(diagnostics_.is_well("forecaster"));

  ASSERT_TRUE(map_at(1390));
  EXPECT_TRUE(diagnostics_.warns("forecaster", "90 s of 300 are not given and are bridged"));
  calm.speed.pop_back();
  ahead.publish(calm);
  EXPECT_TRUE(diagnostics_.warns("forecaster", "2 lead times, 1 speeds and 2 directions"));
}

TEST_F(ForecasterTest, BadParametersAreRefused) {
  EXPECT_EQ(run_program("forecaster __name:=few _members:=3").err,
            "forecaster: /few/members: 3 is not allowed, must be 0, or 8 and more\n");
  EXPECT_EQ(run_program("forecaster __name:=lost _wind_ahead_file:=/nowhere.csv").code, 1);
}

TEST_F(ForecasterTest, GrainsThatTheTableDoesNotHoldAreRefused) {
  const std::string table = " _saltation:=" + shipped;
  const Outcome snow = run_program("forecaster __name:=refused _grain_density:=910" + table);
  EXPECT_EQ(snow.code, 1);
  EXPECT_EQ(snow.err,
            "forecaster: saltation table: density of the grain over that of the air is 742.857, must be "
            "1622.45 to 2704.08\n");
  const Outcome gravel = run_program("forecaster __name:=refused _grain_diameter:=0.003" + table);
  EXPECT_EQ(gravel.code, 1);
  EXPECT_EQ(gravel.err,
            "forecaster: saltation table: the grain's diameter is 0.003, must be 0.0001 to 0.001 m\n");
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "forecaster_rostest");
  const ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
