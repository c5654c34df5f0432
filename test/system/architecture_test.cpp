// The design as a test: no ROS in the core, includes go up the list of rooms only.
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace fs = std::filesystem;

namespace {

const fs::path core = fs::path(AEOLIAN_REPOSITORY) / "src/aeolian_core";

/// The rooms that each room may include, itself not named.
const std::map<std::string, std::set<std::string>> allowed = {
    {"surface", {}},
    {"measure", {"surface"}},
    {"wind", {"surface"}},
    {"grains", {"surface"}},
    {"saltation", {"surface", "wind", "grains"}},
    {"bedforms", {"surface", "wind", "grains", "saltation"}},
    {"slide", {"surface", "wind", "grains", "saltation"}},
    {"twin", {"surface", "measure", "wind", "grains", "saltation", "bedforms", "slide"}},
};

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

template <class Visit>
void for_each_include(Visit visit) {
  const std::regex include(R"re(#include\s*[<"]([^>"]+)[>"])re");
  for (const auto& [room, lower] : allowed)
    for (const auto& entry : fs::recursive_directory_iterator(core / room)) {
      if (!entry.is_regular_file()) continue;
      const std::string text = text_of(entry.path());
      for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it)
        visit(room, entry.path().filename().string(), (*it)[1].str());
    }
}

TEST(Architecture, EveryRoomExistsAndSaysWhatItIs) {
  for (const auto& [room, lower] : allowed) {
    const std::string header = text_of(core / room / (room + ".hpp"));
    EXPECT_NE(header.find("/// The room `" + room + "`"), std::string::npos) << room;
  }
  for (const auto& entry : fs::directory_iterator(core))
    if (entry.is_directory()) {
      EXPECT_TRUE(allowed.count(entry.path().filename().string())) << entry.path();
    }
}

TEST(Architecture, IncludesGoUpTheListOfRooms) {
  std::size_t seen = 0;
  for_each_include([&](const std::string& room, const std::string& file, const std::string& include) {
    const std::string prefix = "aeolian_core/";
    if (include.compare(0, prefix.size(), prefix) != 0) return;
    ++seen;
    const std::string target =
        include.substr(prefix.size(), include.find('/', prefix.size()) - prefix.size());
    EXPECT_TRUE(target == room || allowed.at(room).count(target))
        << room << "/" << file << " includes " << include;
  });
  EXPECT_GT(seen, 50U);
}

TEST(Architecture, NoRosInTheCore) {
  const std::regex ros(R"((ros|rosbag|tf2.*|nodelet|pluginlib|[a-z_]+_msgs|std_srvs|message_filters)/.*)");
  for_each_include([&](const std::string& room, const std::string& file, const std::string& include) {
    EXPECT_FALSE(std::regex_match(include, ros)) << room << "/" << file << " includes " << include;
  });
}

}  // namespace
