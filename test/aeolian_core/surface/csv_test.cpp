#include "aeolian_core/surface/csv.hpp"

#include <cmath>
#include <limits>

#include "../../temporary_folder.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

class Csv : public testing::Test {
 protected:
  Table read(const std::string& text) const { return read_csv(folder_.write("table.csv", text)); }
  std::string error(const std::string& text) const {
    return error_of([&] { read(text); });
  }
  std::string where(int line) const {
    return "table '" + folder_.file("table.csv") + "', line " + std::to_string(line) + ": ";
  }
  TemporaryFolder folder_;
};

TEST_F(Csv, ReadsNamesAndNumbers) {
  const Table table = read("# a comment\nt_s, speed\n\n0,1.5\n 1 ,\t+2e1 # gust\n2,nan\n3,\n");
  EXPECT_EQ(table.names, (std::vector<std::string>{"t_s", "speed"}));
  EXPECT_EQ(table.column("t_s"), (std::vector<double>{0, 1, 2, 3}));
  EXPECT_EQ(table.column("speed")[1], 20);
  EXPECT_TRUE(std::isnan(table.column("speed")[2]));
  EXPECT_TRUE(std::isnan(table.column("speed")[3]));
}

TEST_F(Csv, ReadsWhatSpreadsheetsWrite) {
  const Table table = read("\xEF\xBB\xBFx,y\r\n1,2\r\n3,4");
  EXPECT_EQ(table.column("x"), (std::vector<double>{1, 3}));
  EXPECT_EQ(table.column("y"), (std::vector<double>{2, 4}));
}

TEST_F(Csv, NamesFileLineAndField) {
  EXPECT_EQ(error("t_s,speed\n0,1\n1,fast\n"), where(3) + "speed is 'fast', must be a number");
  EXPECT_EQ(error("t_s,speed\n0,1,5\n"), where(2) + "3 fields, must be 2 as in the first line");
  EXPECT_EQ(error("t_s,speed\n0\n"), where(2) + "1 fields, must be 2 as in the first line");
  EXPECT_EQ(error("a\n1,5 m\n").substr(0, where(2).size()), where(2));
  EXPECT_NE(error("# only a comment\n").find("is empty"), std::string::npos);
  EXPECT_NE(error_of([&] { read_csv(folder_.file("none.csv")); }).find("none.csv': No such file"),
            std::string::npos);
  EXPECT_NE(error_of([&] { read_csv(folder_.path()); }).find("Is a directory"), std::string::npos);
}

TEST_F(Csv, NamesAnAbsentColumn) {
  const Table table = read("a,b\n1,2\n");
  EXPECT_NE(error_of([&] { table.column("c"); }).find("'c'"), std::string::npos);
}

TEST_F(Csv, WritesNumbersThatReadBackToTheSameDouble) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Table table{{"a", "b"}, {{0.1, 1.0 / 3, -0.0}, {5401234.123456789, 1e-308, nan}}};
  const std::string path = folder_.file("out.csv");
  write_csv(table, path);
  const Table back = read_csv(path);
  EXPECT_EQ(back.names, table.names);
  EXPECT_EQ(back.column("a"), table.column("a"));
  EXPECT_EQ(back.column("b")[0], 5401234.123456789);
  EXPECT_EQ(back.column("b")[1], 1e-308);
  EXPECT_TRUE(std::isnan(back.column("b")[2]));
}

TEST_F(Csv, WritesTheKnownCellsOfAMap) {
  HeightMap map(GridGeometry(500000, 5400000, 0.5, 2, 2));
  constexpr float nan = HeightMap::unknown;
  map.add(layer::elevation, HeightMap::Layer{1, nan, 3, nan});
  map.add(layer::age, HeightMap::Layer{nan, nan, nan, 4});
  const std::string path = folder_.file("map.csv");
  write_map_csv(map, path);
  const Table table = read_csv(path);
  EXPECT_EQ(table.names, (std::vector<std::string>{"x_m", "y_m", "elevation", "age"}));
  EXPECT_EQ(table.column("x_m"), (std::vector<double>{500000.25, 500000.25, 500000.75}));
  EXPECT_EQ(table.column("y_m"), (std::vector<double>{5400000.25, 5400000.75, 5400000.75}));
  EXPECT_EQ(table.column("elevation")[1], 3);
  EXPECT_TRUE(std::isnan(table.column("elevation")[2]));
}

TEST_F(Csv, CannotBeWrittenBelowAFile) {
  const std::string file = folder_.write("file", "");
  EXPECT_NE(error_of([&] {
              write_csv({{"a"}, {{1}}}, file + "/x.csv");
            }).find("Not a directory"),
            std::string::npos);
}

}  // namespace
}  // namespace aeolian
