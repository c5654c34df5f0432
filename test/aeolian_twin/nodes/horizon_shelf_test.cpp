#include "aeolian_twin/nodes/horizon_shelf.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "aeolian_twin/nodes/lead_time_words.hpp"

namespace aeolian {
namespace {

using Shelf = HorizonShelf<std::string>;
using std::chrono::hours;
using std::chrono::seconds;

/// A clock far ahead of all starts: a bag played without its own time.
constexpr hours late(1000);

std::vector<std::string> items(const Shelf& shelf) {
  std::vector<std::string> result;
  for (const auto& [lead, entry] : shelf.entries()) result.push_back(entry.item);
  return result;
}

using Items = std::vector<std::string>;

TEST(HorizonShelf, KeepsTheNewestOfEachLeadTime) {
  Shelf shelf;
  EXPECT_TRUE(shelf.put(seconds(100), 60, "a60", late));
  EXPECT_TRUE(shelf.put(seconds(100), 30, "a30", late));
  EXPECT_EQ(items(shelf), (Items{"a30", "a60"}));
  EXPECT_TRUE(shelf.put(seconds(130), 30, "b30", late));
  EXPECT_EQ(items(shelf), (Items{"b30", "a60"})) << "until the new run has come so far";
  EXPECT_TRUE(shelf.put(seconds(130), 60, "b60", late));
  EXPECT_EQ(items(shelf), (Items{"b30", "b60"}));
  EXPECT_EQ(shelf.newest_start(), seconds(130));
}

TEST(HorizonShelf, ALongRunThatEndsLateDoesNotReplaceANewerOne) {
  Shelf shelf;
  shelf.put(seconds(100), 30, "a30", late);
  shelf.put(seconds(130), 30, "b30", late);
  EXPECT_TRUE(shelf.put(seconds(100), 300, "a300", late)) << "nothing newer is there";
  shelf.put(seconds(130), 300, "b300", late);
  EXPECT_FALSE(shelf.put(seconds(100), 300, "a300 again", late));
  EXPECT_EQ(items(shelf), (Items{"b30", "b300"}));
}

TEST(HorizonShelf, ForgetsLeadTimesThatAreNoLongerForecast) {
  Shelf shelf;
  shelf.put(seconds(100), 30, "a30", late);
  shelf.put(seconds(100), 120, "a120", late);
  shelf.put(seconds(130), 45, "b45", late);
  EXPECT_EQ(shelf.entries().size(), 3U);
  shelf.put(seconds(160), 45, "c45", late);
  EXPECT_EQ(items(shelf), (Items{"c45"}));
}

TEST(HorizonShelf, BeginsAnewWhenABagLoops) {
  Shelf shelf;
  shelf.put(seconds(1000), 30, "a30", late);
  shelf.put(seconds(1000), 300, "a300", late);
  EXPECT_TRUE(shelf.put(seconds(699), 30, "b30", late)) << "farther back than any run takes";
  EXPECT_EQ(items(shelf), (Items{"b30"}));

  Shelf of_short_bag;
  of_short_bag.put(seconds(1000), 300, "a300", seconds(1000));
  EXPECT_TRUE(of_short_bag.put(seconds(900), 300, "b300", seconds(900))) << "the clock says so";
  EXPECT_EQ(items(of_short_bag), (Items{"b300"}));
}

TEST(NearestLead, PrefersTheShorterOfTwoAsNear) {
  const std::map<double, int> leads{{30, 0}, {60, 1}, {300, 2}};
  for (const auto& [wanted, nearest] :
       std::vector<std::pair<double, double>>{{0, 30}, {30, 30}, {45, 30}, {46, 60}, {180, 60}, {1e9, 300}})
    EXPECT_EQ(nearest_lead(leads, wanted)->first, nearest) << wanted;
  const std::map<double, int> none;
  EXPECT_EQ(nearest_lead(none, 30), none.end());
}

TEST(LeadTimeWords, ReadAsAPersonSaysThem) {
  const std::vector<std::pair<double, std::string>> cases = {
      {0, "now"},         {0.5, "0.5 s"},      {30, "30 s"},   {60, "1 min"},      {90, "90 s"},
      {120, "2 min"},     {150, "2 min 30 s"}, {300, "5 min"}, {3600, "1 h"},      {5400, "1 h 30 min"},
      {59.9999, "1 min"}, {86400, "24 h"},     {2, "2 s"},     {119.9999, "2 min"}};
  for (const auto& [time, words] : cases) EXPECT_EQ(lead_time_words(time), words) << time;
}

}  // namespace
}  // namespace aeolian
