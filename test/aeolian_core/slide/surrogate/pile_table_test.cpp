#include "aeolian_core/slide/surrogate/pile_table.hpp"

#include <array>
#include <cmath>
#include <set>

#include "../../../error_of.hpp"
#include "../../../temporary_folder.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/slide/surrogate/pile_design.hpp"

namespace aeolian {
namespace {

const std::string head =
    "run,panel_length_m,panel_height_m,tilt_deg,thickness_m,event,cell_m,height_m,length_m,head_m,tail_m\n";

class PileTableFile : public testing::Test {
 protected:
  std::string refusal(const std::string& text) const {
    const std::string file = folder_.write("t.csv", text);
    std::string message = error_of([&] { read_pile_table(file); });
    const auto at = message.find(file);
    return at == std::string::npos ? message : message.substr(at + file.size());
  }
  const TemporaryFolder folder_;
};

TEST_F(PileTableFile, ReadsBackWhatWasWritten) {
  PileTable table{{3, {2, 1, 0.7, 0.05, 1}, 0.01, 0.1, 2, 0.5, 2.5},
                  {3, {2, 1, 0.7, 0.05, 2}, 0.01, 0.2, 2.1, 0.4, 2.5}};
  write_pile_table(table, folder_.file("t.csv"), "made by a test");
  const PileTable read = read_pile_table(folder_.file("t.csv"));
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[1].run, 3);
  EXPECT_EQ(read[1].query.event, 2);
  EXPECT_NEAR(read[1].query.tilt, 0.7, 1e-15);
  EXPECT_EQ(read[1].height, 0.2);
  EXPECT_EQ(read[1].tail, 2.5);
  EXPECT_NEAR(read[0].shape(), 0.05, 1e-15);
}

TEST_F(PileTableFile, RefusesBadTablesInOneLine) {
  EXPECT_EQ(refusal(head), ": there are 0 piles, must be at least 1");
  EXPECT_EQ(refusal("run,colour\n1,2\n").substr(0, 49), ": column 'colour' is not one of a table of piles:");
  EXPECT_EQ(refusal("run,event\n1,2\n"), ": there is no column 'panel_length_m'");
  EXPECT_EQ(refusal(head + "0,2,1,40,0.05,1,0.01,nan,2,0.5,2.5\n"),
            ": row 1: height_m is nan, must be finite");
  EXPECT_EQ(refusal(head + "0,2,1,40,0.05,1.5,0.01,0.1,2,0.5,2.5\n"),
            ": row 1: event is 1.5, must be a whole number, at least 1");
  EXPECT_EQ(refusal(head + "0,2,1,40,0.05,0,0.01,0.1,2,0.5,2.5\n"),
            ": row 1: event is 0, must be a whole number, at least 1");
  EXPECT_EQ(refusal(head + "0,2,1,40,0.05,1,0.01,0.1,-2,0.5,2.5\n"),
            ": row 1: length_m is -2, must be positive");
  const std::string row = "0,2,1,40,0.05,1,0.01,0.1,2,0.5,2.5\n";
  EXPECT_EQ(refusal(head + row + row), ": row 2: run 0 has event 1 twice");
  EXPECT_EQ(refusal(head + row + "0,3,1,40,0.05,2,0.01,0.1,2,0.5,2.5\n"),
            ": row 2: run 0 has another panel than before");
}

TEST(PileDesignTest, HasTheCornersAndMeetsEachPartOfARangeOnce) {
  PileDesign design;
  design.runs = 28;
  const auto panels = panels_of(design);
  ASSERT_EQ(panels.size(), 28U);
  std::set<std::array<double, 3>> corners;
  for (int k = 0; k < 8; ++k) {
    const PileQuery& p = panels[static_cast<std::size_t>(k)];
    corners.insert({p.panel_length, p.panel_height, p.tilt});
    EXPECT_TRUE(p.panel_length == 0.5 || p.panel_length == 4);
    EXPECT_TRUE(p.panel_height == 1 || p.panel_height == 4);
  }
  EXPECT_EQ(corners.size(), 8U);
  std::set<int> lengths, heights;
  for (std::size_t k = 8; k < 28; ++k) {
    lengths.insert(static_cast<int>(20 * std::log(panels[k].panel_length / 0.5) / std::log(8)));
    heights.insert(static_cast<int>(20 * (panels[k].panel_height - 1) / 3));
    EXPECT_EQ(panels[k].thickness, 0.05);
  }
  EXPECT_EQ(lengths.size(), 20U);
  EXPECT_EQ(heights.size(), 20U);
  EXPECT_EQ(panels_of(design)[20].tilt, panels[20].tilt);
  design.seed = 2;
  EXPECT_NE(panels_of(design)[20].tilt, panels[20].tilt);
}

TEST(PileDesignTest, RefusesWhatCannotBe) {
  PileDesign design;
  design.runs = 7;
  EXPECT_EQ(error_of([&] { panels_of(design); }),
            "table of piles: runs is 7, must be at least 8: the corners of the ranges");
  design.runs = 8;
  design.thickness = {0.05, 0.04};
  EXPECT_EQ(error_of([&] { panels_of(design); }),
            "table of piles: thickness is from 0.05 to 0.04, must rise from above 0");
}

}  // namespace
}  // namespace aeolian
