#include "aeolian_twin/nodes/map_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <grid_map_msgs/GridMap.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sys/mman.h>
#include <unistd.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/geotiff.hpp"
#include "aeolian_core/surface/text.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

constexpr const char* frame_note = "AEOLIAN_FRAME";
constexpr const char* stamp_note = "AEOLIAN_STAMP_S";

enum class Format { geotiff, bag };

Format format_of(const std::string& file) {
  const std::string extension = extension_of(file);
  if (extension == "tif" || extension == "tiff") return Format::geotiff;
  if (extension == "bag") return Format::bag;
  throw Error(
      fmt::format("map '{}': the name ends in '{}', must end in .tif, .tiff or .bag", file, extension));
}

ros::Time time_of(const std::string& text) {
  unsigned seconds = 0;
  unsigned nanoseconds = 0;
  if (std::sscanf(text.c_str(), "%10u.%9u", &seconds, &nanoseconds) != 2) return {};
  return {seconds, nanoseconds};
}

void save_geotiff(const StoredMap& stored, const std::string& file) {
  const GeotiffNotes notes{{frame_note, stored.frame},
                           {stamp_note, fmt::format("{}.{:09}", stored.stamp.sec, stored.stamp.nsec)}};
  write_geotiff(stored.map, file, {}, notes);
}

StoredMap load_geotiff(const std::string& file) {
  StoredMap stored{read_geotiff(file), {}, {}};
  const GeotiffNotes notes = read_geotiff_notes(file);
  if (const auto frame = notes.find(frame_note); frame != notes.end()) stored.frame = frame->second;
  if (const auto stamp = notes.find(stamp_note); stamp != notes.end()) stored.stamp = time_of(stamp->second);
  return stored;
}

/// A file in memory. A rosbag::Bag that meets a full disk ends the program, from its destructor; here it
/// meets none.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("map", MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw Error(fmt::format("no file in memory: {}", std::strerror(errno)));
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

 private:
  int descriptor_;
};

void save_bag(const StoredMap& stored, const std::string& file, const std::string& topic) {
  std_msgs::Header header;
  header.frame_id = stored.frame;
  header.stamp = stored.stamp;
  const MemoryFile memory;
  try {
    rosbag::Bag bag(memory.path(), rosbag::bagmode::Write);
    bag.write(topic, std::max(stored.stamp, ros::TIME_MIN), to_message(stored.map, header));
    bag.close();
  } catch (const rosbag::BagException& error) {
    throw Error(fmt::format("bag '{}': {}", file, error.what()));
  }
  write_atomically(file, [&](const std::string& temporary) {
    std::error_code error;
    std::filesystem::copy_file(memory.path(), temporary, std::filesystem::copy_options::overwrite_existing,
                               error);
    if (error) throw Error(fmt::format("bag '{}': {}", file, error.message()));
  });
}

std::string topics_of(const rosbag::Bag& bag) {
  rosbag::View all(bag);
  std::set<std::string> topics;
  for (const rosbag::ConnectionInfo* connection : all.getConnections()) topics.insert(connection->topic);
  return topics.empty() ? "nothing" : fmt::format("{}", fmt::join(topics, ", "));
}

StoredMap load_bag(const std::string& file, const std::string& topic) {
  try {
    const rosbag::Bag bag(file, rosbag::bagmode::Read);
    grid_map_msgs::GridMap::ConstPtr last;
    for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery(topic)))
      if (const auto map = message.instantiate<grid_map_msgs::GridMap>()) last = map;
    if (!last)
      throw Error(fmt::format("bag '{}': no grid map on topic {}; it holds {}", file, topic, topics_of(bag)));
    return {to_height_map(*last), last->info.header.frame_id, last->info.header.stamp};
  } catch (const rosbag::BagException& error) {
    throw Error(fmt::format("bag '{}': {}", file, error.what()));
  }
}

}  // namespace

void save_map(const StoredMap& stored, const std::string& file, const std::string& topic) {
  if (format_of(file) == Format::geotiff)
    save_geotiff(stored, file);
  else
    save_bag(stored, file, topic);
}

StoredMap load_map(const std::string& file, const std::string& topic) {
  StoredMap stored = format_of(file) == Format::geotiff ? load_geotiff(file) : load_bag(file, topic);
  const std::vector<std::string> names = stored.map.names();
  if (!stored.map.has(layer::elevation))
    throw Error(fmt::format("map '{}': has the layers {}, must have '{}'", file, fmt::join(names, ", "),
                            layer::elevation));
  if (count_known(stored.map.layer(layer::elevation)) == 0)
    throw Error(fmt::format("map '{}': no cell of '{}' is known", file, layer::elevation));
  return stored;
}

}  // namespace aeolian
