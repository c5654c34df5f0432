#include "aeolian_core/wind/wind_record.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

class WindRecordFile : public testing::Test {
 protected:
  ~WindRecordFile() override { std::filesystem::remove(path_); }

  WindRecord read(const std::string& text) const {
    std::ofstream(path_) << text;
    return read_wind_record(path_);
  }
  /// Expects an Error that names the file and contains `part`.
  void expect_error(const std::string& text, const std::string& part) const {
    try {
      read(text);
      ADD_FAILURE() << "no error for: " << text;
    } catch (const Error& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find(path_), std::string::npos) << message;
      EXPECT_NE(message.find(part), std::string::npos) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  }

  const std::string path_ = testing::TempDir() + "wind_record_test_" + std::to_string(::getpid()) + ".csv";
};

TEST_F(WindRecordFile, ReadsOurDirection) {
  const WindRecord record = read("t_s,speed_m_s,direction_deg\n0,5,90\n1,6,-180\n");
  ASSERT_EQ(record.time.size(), 2U);
  EXPECT_EQ(record.time[1], 1);
  EXPECT_EQ(record.speed[1], 6);
  EXPECT_NEAR(record.direction[0], M_PI / 2, 1e-14);
  EXPECT_NEAR(record.direction[1], M_PI, 1e-14);
}

TEST_F(WindRecordFile, ReadsTheMeteorologicalDirectionInAnyColumnOrder) {
  const WindRecord record = read("from_deg,t_s,speed_m_s\n0,0,5\n270,2,6\n");
  ASSERT_EQ(record.time.size(), 2U);
  EXPECT_NEAR(record.direction[0], -M_PI / 2, 1e-14);
  EXPECT_NEAR(record.direction[1], 0, 1e-14);
}

TEST_F(WindRecordFile, GapsAreLeftOutAndReported) {
  const WindRecord record =
      read("t_s,speed_m_s,direction_deg\n0,5,0\n1,5,0\n2,nan,0\n3,5,\n4,5,0\n5,5,0\n50,5,0\n");
  EXPECT_EQ(record.time, (std::vector<double>{0, 1, 4, 5, 50}));
  const auto gaps = record.gaps(1.5);
  ASSERT_EQ(gaps.size(), 2U);
  EXPECT_EQ(gaps[0].start, 1);
  EXPECT_EQ(gaps[0].end, 4);
  EXPECT_EQ(gaps[1].start, 5);
  EXPECT_EQ(gaps[1].end, 50);
  EXPECT_EQ(record.gaps(10).size(), 1U);
  EXPECT_TRUE(record.gaps(45).empty());
}

TEST_F(WindRecordFile, NamesTheRowThatIsBad) {
  expect_error("t_s,speed_m_s,direction_deg\n0,5,0\n1,5,0\n1,5,0\n", "row 3");
  expect_error("t_s,speed_m_s,direction_deg\n5,5,0\n4,5,0\n", "row 2");
  expect_error("t_s,speed_m_s,direction_deg\n0,5,0\n1,-2,0\n", "row 2: speed_m_s is -2");
  expect_error("t_s,speed_m_s,direction_deg\nnan,5,0\n", "row 1: t_s");
}

TEST_F(WindRecordFile, NamesTheColumnThatIsMissing) {
  expect_error("speed_m_s,direction_deg\n5,0\n", "t_s");
  expect_error("t_s,direction_deg\n0,0\n", "speed_m_s");
  expect_error("t_s,speed_m_s\n0,5\n", "direction_deg");
  expect_error("t_s,speed_m_s,direction_deg,from_deg\n0,5,0,0\n", "both");
}

TEST_F(WindRecordFile, AMissingFileIsNamed) {
  EXPECT_THROW(read_wind_record("/nonexistent/wind.csv"), Error);
}

}  // namespace
}  // namespace aeolian
