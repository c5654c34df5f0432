/// Where a forecaster has its saltation from: the law, a table of solved states, a table that cannot be used.
#include <cmath>
#include <memory>
#include <string>

#include "../temporary_folder.hpp"
#include "program_outcome.hpp"
#include "ros_test.hpp"
#include "running_program.hpp"
#include <grid_map_msgs/GridMap.h>
#include <gtest/gtest.h>

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
  void start(const std::string& saltation) {
    node_ = std::make_unique<RunningProgram>(
        "forecaster", std::vector<std::string>{"_saltation:=" + saltation, "_diagnostic_period:=0.1"});
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
