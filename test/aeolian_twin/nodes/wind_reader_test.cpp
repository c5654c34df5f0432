#include "aeolian_twin/nodes/wind_reader.hpp"

#include <cmath>
#include <limits>
#include <map>

#include "../../aeolian_core/wind/relief_worlds.hpp"
#include <gtest/gtest.h>
#include <tf2/buffer_core.h>
#include <tf2_eigen/tf2_eigen.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/log_law.hpp"
#include "aeolian_twin/nodes/conversions.hpp"
#include "aeolian_twin/nodes/node.hpp"
#include "aeolian_twin/nodes/wind_prober.hpp"

namespace aeolian {
namespace {

constexpr double roughness = 1e-4;
constexpr double z = 2;

/// A WindReader, anemometers on tf, and what was told.
class WindReaderTest : public ::testing::Test {
 protected:
  WindReader& reader(const std::map<std::string, XmlRpc::XmlRpcValue>& given = {}) {
    XmlRpc::XmlRpcValue values;
    values["roughness"] = roughness;
    values["anemometer_height"] = z;
    for (const auto& [name, value] : given) values[name] = value;
    parameters_ =
        std::make_unique<Parameters>(describe_wind_estimator().parameters, "wind_estimator", values);
    reader_ = std::make_unique<WindReader>(
        *parameters_, "wind", tf_, [this](const std::string& thing, bool well, const std::string& line) {
          told_[thing] = (well ? "well: " : "bad: ") + line;
        });
    return *reader_;
  }

  void stand(const std::string& frame, double x, double y, double height, double turned = 0) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = Eigen::Vector3d(x, y, height);
    pose.rotate(Eigen::AngleAxisd(turned, Eigen::Vector3d::UnitZ()));
    geometry_msgs::TransformStamped transform = tf2::eigenToTransform(pose);
    transform.header.frame_id = "map";
    transform.child_frame_id = frame;
    tf_.setTransform(transform, "test", true);
  }

  std::optional<WindField> blow(double time, double east, double north = 0,
                                const std::string& frame = "map") {
    geometry_msgs::TwistStamped message;
    message.header.frame_id = frame;
    message.header.stamp = ros::Time(1000 + time);
    message.twist.linear.x = east;
    message.twist.linear.y = north;
    const auto field = reader_->take_wind(message);
    if (!field) return std::nullopt;
    return reader_->field();
  }
  bool says(const std::string& thing, const std::string& text) const {
    return told_.at(thing).find(text) != std::string::npos;
  }

  tf2::BufferCore tf_;
  std::unique_ptr<Parameters> parameters_;
  std::unique_ptr<WindReader> reader_;
  std::map<std::string, std::string> told_;
};

HeightMap hill(double height) {
  return world(64, 64, 1.5, [&](double x, double y) { return gaussian(std::hypot(x, y), height, 15); });
}
HeightMap dune_across() {
  return world(130, 16, 0.75, [&](double x, double) { return dune(x, 3, 40); });
}

TEST_F(WindReaderTest, OverARippledBedTheWindIsUniformAndNothingIsSolvedPerReading) {
  reader();
  // Ripples of 8 mm and 10 cm on a plot that slopes by half a degree.
  const HeightMap bed = world(
      500, 250, 0.002, [](double x, double) { return 0.004 * std::sin(2 * M_PI * x / 0.1) + 0.0087 * x; });
  reader_->take_map(bed);
  for (int i = 0; i < 50; ++i) {
    const auto field = blow(0.1 * i, 8, 0.02 * i);
    ASSERT_TRUE(field);
    EXPECT_EQ(field->model, "log law");
    EXPECT_TRUE(field->cells.names().empty());
    EXPECT_DOUBLE_EQ(field->friction_velocity, friction_velocity(std::hypot(8, 0.02 * i), z, roughness));
  }
  EXPECT_EQ(reader_->model().solutions(), 2) << "one for each sector of directions";
}

TEST_F(WindReaderTest, ReliefIsSolvedOnceASectorAndTheFieldSaysWhatItIs) {
  reader();
  reader_->take_map(hill(2));
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(blow(i, 4 + 0.2 * i, 0.1));
  EXPECT_EQ(reader_->model().solutions(), 1);
  HeightMap again = hill(2);
  again.layer(layer::elevation)[2000] += 0.01F;
  reader_->take_map(again);
  const auto field = blow(20, 8);
  EXPECT_EQ(reader_->model().solutions(), 1) << "a trifle has changed";
  EXPECT_EQ(field->model, "spectral");
  EXPECT_EQ(field->age, 20);
  EXPECT_TRUE(says("wind", "by the spectral wind over the map"));
  const aeolian_msgs::WindStatistics statistics = reader_->statistics();
  EXPECT_EQ(statistics.model, "spectral");
  EXPECT_EQ(statistics.age, 20);
  EXPECT_NEAR(statistics.friction_velocity, friction_velocity(8, z, roughness), 1e-9);
  ASSERT_EQ(statistics.anemometers.size(), 1U);
  EXPECT_EQ(statistics.anemometers[0].readings, 21U);
  EXPECT_TRUE(statistics.anemometers[0].used);

  geometry_msgs::TwistStamped message;
  message.header.stamp = ros::Time(1021);
  message.twist.linear.x = 8;
  const HeightMap cells = to_height_map(*reader_->take_wind(message));
  EXPECT_EQ(cells.layer(layer::elevation), again.layer(layer::elevation));
  const std::size_t crest = cells.geometry().index(31, 31);
  EXPECT_GT(cells.layer("speed_up")[crest], 0.05F);
  EXPECT_NEAR(cells.layer("friction_velocity")[crest],
              friction_velocity(8, z, roughness) * (1 + cells.layer("speed_up")[crest]), 1e-6);
  EXPECT_EQ(cells.layer("separated")[crest], 0);
  reader_->take_map(hill(6));
  EXPECT_EQ(blow(22, 8)->age, 0);
  EXPECT_EQ(reader_->model().solutions(), 2);
}

TEST_F(WindReaderTest, AModelThatIsForcedIsTaken) {
  const HeightMap map = hill(2);
  for (const auto& [name, told] : std::map<std::string, std::string>{
           {"log", "log law"}, {"spectral", "spectral"}, {"mass_consistent", "mass consistent"}}) {
    reader({{"model", name}});
    reader_->take_map(map);
    EXPECT_EQ(blow(0, 8)->model, told);
  }
}

TEST_F(WindReaderTest, ReadingsAreAveragedOverTheTimeAskedFor) {
  reader({{"averaging_time", 4.0}});
  for (int i = 0; i < 40; ++i) blow(i, i % 2 == 0 ? 6 : 10, i % 4 < 2 ? 1 : -1);
  const auto field = reader_->field();
  EXPECT_NEAR(field->friction_velocity, friction_velocity(8, z, roughness), 1e-12);
  EXPECT_NEAR(field->direction, 0, 1e-12);
  EXPECT_NEAR(reader_->statistics().anemometers[0].turbulence_intensity, 2 / 8.0, 0.01);
}

TEST_F(WindReaderTest, TwoAnemometersMirroredAboutTheWindTellItsDirection) {
  reader();
  reader_->take_map(hill(2));
  // In the mirror of the axis through the hill readings are each other's mirror images.
  stand("left", -10, 12, 3 + gaussian(std::hypot(10, 12), 2, 15));
  stand("right", -10, -12, 3 + gaussian(std::hypot(10, 12), 2, 15), M_PI / 2);
  const double east = 8, north = 0.2;
  ASSERT_TRUE(blow(0, east, north, "left"));
  EXPECT_GT(reader_->field()->direction, 0.005);
  // The second one's own frame is turned by a quarter.
  const auto both = blow(0.5, -north, -east, "right");
  ASSERT_TRUE(both);
  EXPECT_NEAR(both->direction, 0, 2e-3);
  EXPECT_TRUE(says("anemometers", "well: 2 in use"));
  // When it falls silent the other one goes on by itself.
  const auto later = blow(7, east, north, "left");
  EXPECT_GT(later->direction, 0.005);
  EXPECT_TRUE(says("anemometers", "bad: 1 in use; right: silent for 6.5 s"));
  EXPECT_FALSE(reader_->statistics().anemometers[1].used);
}

TEST_F(WindReaderTest, OnTheHillTheSurroundingsAreFoundThatTheProbeTellsOf) {
  reader();
  reader_->take_map(hill(2));
  blow(0, 8);
  const double given = reader_->field()->friction_velocity;
  WindProber prober(*reader_);
  const double ground = reader_->ground().at(0, 0);
  const WindRelief relief = wind_relief(hill(2), 0.5);
  EXPECT_NEAR(reader_->ground().at(0.75, 0.75), relief.mean + relief.height[relief.geometry.index(32, 32)],
              0.001);
  const AirVelocity wind = prober.at({{0, 0, ground + 1.5}})[0].mean;
  EXPECT_GT(wind.east, 1.05 * log_law_speed(given, 1.5, roughness)) << "the hill speeds it up";
  stand("crest", 0, 0, ground + 1.5);
  blow(100, wind.east, wind.north, "crest");
  EXPECT_NEAR(reader_->field()->friction_velocity, given, 0.005 * given);
}

TEST_F(WindReaderTest, InTheLeeItIsRefusedWithTheReasonAndTheLastFieldStays) {
  reader();
  reader_->take_map(dune_across());
  ASSERT_TRUE(blow(0, 8));
  const double before = reader_->field()->friction_velocity;
  stand("lee", 8, 0, 1);
  EXPECT_FALSE(blow(6, 3, 0, "lee"));
  EXPECT_TRUE(says("wind", "bad: wind (lee): anemometer at (8, 0) m: it stands in the air that separates"));
  EXPECT_EQ(reader_->field()->friction_velocity, before);
  // Beside one that is of use it is left out, its eddy too, which by itself would tell of an east wind.
  for (const double eddy : {1.0, -1.0}) {
    ASSERT_TRUE(blow(10 + eddy, 8));
    const auto field = blow(10.5 + eddy, eddy, 0, "lee");
    ASSERT_TRUE(field);
    EXPECT_NEAR(field->friction_velocity, before, 1e-9);
    EXPECT_NEAR(field->direction, 0, 1e-9);
    EXPECT_TRUE(says("anemometers", "bad: 1 in use; lee: "));
    EXPECT_NE(reader_->statistics().anemometers[0].refused.find("separates"), std::string::npos);
  }
}

TEST_F(WindReaderTest, InTheRoughnessItIsRefused) {
  reader();
  reader_->take_map(hill(2));
  stand("low", 0, 0, 0.5);
  EXPECT_FALSE(blow(0, 8, 0, "low"));
  EXPECT_TRUE(says("wind", "wind (low): "));
  EXPECT_TRUE(says("wind", "must be above the roughness length"));
  EXPECT_FALSE(reader_->field());
}

TEST_F(WindReaderTest, BesideWhatIsKnownItStandsInTheSurroundings) {
  reader();
  HeightMap map = hill(2);
  map.layer(layer::elevation)[map.geometry().index(10, 10)] = HeightMap::unknown;
  reader_->take_map(map);
  const double mean = reader_->ground().at(500, 0);
  for (const MapPoint place : {MapPoint{500, 0}, {map.geometry().x(10), map.geometry().y(10)}}) {
    stand("mast", place.x, place.y, mean + 4);
    ASSERT_TRUE(blow(place.x, 8, 0, "mast"));
    EXPECT_NEAR(reader_->field()->friction_velocity, friction_velocity(8, 4, roughness), 1e-9);
  }
}

TEST_F(WindReaderTest, BadReadingsAreToldAndLeaveTheRest) {
  reader();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(blow(0, nan));
  EXPECT_TRUE(says("wind", "velocity is (nan, 0) m/s"));
  EXPECT_FALSE(blow(1, 61));
  EXPECT_TRUE(says("wind", "at most 60"));
  ASSERT_TRUE(blow(2, 8));
  EXPECT_EQ(reader_->statistics().anemometers[0].readings, 1U);
  ASSERT_TRUE(blow(20, 8));
  EXPECT_TRUE(says("clock", "gap of 18.0 s"));
  ASSERT_TRUE(blow(5, 8));
  EXPECT_TRUE(says("clock", "time jumped back by 15.0 s"));
  EXPECT_EQ(reader_->statistics().anemometers[0].readings, 1U);
  HeightMap unknown(GridGeometry(0, 0, 1, 4, 4));
  unknown.add(layer::elevation);
  reader_->take_map(unknown);
  ASSERT_TRUE(blow(6, 8)) << "without any known ground it is level";
  EXPECT_THROW(reader_->take_map(HeightMap(GridGeometry(0, 0, 1, 4, 4))), Error);
}

TEST_F(WindReaderTest, AnyWindOverAnyGroundIsFinite) {
  for (const double height : {0.0, 2.0, 40.0}) {
    reader();
    HeightMap map =
        world(24, 24, 4, [&](double x, double y) { return gaussian(std::hypot(x, y), height, 15); });
    map.layer(layer::elevation)[100] = 50;
    map.layer(layer::elevation)[300] = HeightMap::unknown;
    reader_->take_map(map);
    for (const double speed : {0.0, 1e-9, 8.0, 60.0})
      for (const double turn : {0.0, M_PI, -M_PI / 2}) {
        const auto field = blow(0, speed * std::cos(turn), speed * std::sin(turn));
        ASSERT_TRUE(field) << told_["wind"];
        if (field->cells.names().empty()) continue;
        const HeightMap::Layer& friction = field->cells.layer("friction_velocity");
        for (std::size_t i = 0; i < friction.size(); ++i)
          ASSERT_TRUE(i == 300 ? std::isnan(friction[i]) : friction[i] >= 0 && friction[i] < 20) << i;
      }
  }
}

TEST_F(WindReaderTest, ProbesScaleAndTurnWithTheWind) {
  reader();
  reader_->take_map(hill(2));
  blow(0, 6, 0.3);
  WindProber prober(*reader_);
  const std::vector<Eigen::Vector3d> points{{-12, 4, 4}, {0, 0, 5}, {12, 0, 3}};
  const std::vector<ProbeReading> slow = prober.at(points);
  const int solutions = reader_->model().solutions();
  blow(1, 12, 0.6);
  const std::vector<ProbeReading> fast = prober.at(points);
  EXPECT_EQ(reader_->model().solutions(), solutions);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(fast[i].mean.up, 2 * slow[i].mean.up, 1e-9);
    EXPECT_NEAR(fast[i].mean.north, 2 * slow[i].mean.north, 1e-9);
    EXPECT_NEAR(fast[i].intensity, slow[i].intensity, 1e-12);
  }
  EXPECT_GT(slow[0].mean.up, 0) << "up the windward side";
  EXPECT_LT(slow[2].mean.up, 0) << "down the lee";
  EXPECT_NEAR(std::atan2(slow[1].mean.north, slow[1].mean.east), std::atan2(0.3, 6), 1e-3);
  blow(2, -6, -0.3);
  EXPECT_LT(prober.at(points)[0].mean.up, 0) << "the other way round";
}

TEST_F(WindReaderTest, ProbesOutOfTheAirAreNotANumber) {
  reader();
  WindProber prober(*reader_);
  EXPECT_THROW(prober.at({{0, 0, 1}}), Error) << "no wind yet";
  blow(0, 8);
  EXPECT_NEAR(prober.at({{700, 0, 2}})[0].mean.east, 8, 1e-9) << "without a map the air is the log law's";
  reader_->take_map(hill(2));
  blow(1, 8);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const ProbeReading& reading :
       prober.at({{0, 0, 1}, {0, 0, 1.9}, {700, 0, 5}, {0, nan, 5}, {0, 0, nan}}))
    EXPECT_TRUE(std::isnan(reading.mean.east) && std::isnan(reading.mean.up));
  EXPECT_TRUE(std::isfinite(prober.at({{0, 0, 50}})[0].mean.east)) << "far above";
  const std::vector<Eigen::Vector3d> points{{0, 0, 5}, {0, 0, 1}};
  const std::vector<Gusts> gusts = prober.gusts(points, prober.at(points), 0.1, 64, 3);
  EXPECT_EQ(gusts[0].along.size(), 64U);
  EXPECT_TRUE(gusts[1].along.empty());
  EXPECT_EQ(prober.gusts(points, prober.at(points), 0.1, 64, 3)[0].along, gusts[0].along);
  EXPECT_NE(prober.gusts(points, prober.at(points), 0.1, 64, 4)[0].along, gusts[0].along);
  EXPECT_THROW(prober.gusts(points, prober.at(points), 0, 64, 3), Error);
  EXPECT_THROW(prober.gusts(points, prober.at(points), 0.1, 3, 3), Error);
}

}  // namespace
}  // namespace aeolian
