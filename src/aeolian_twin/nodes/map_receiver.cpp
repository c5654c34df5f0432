#include "aeolian_twin/nodes/map_receiver.hpp"

#include <utility>

#include <fmt/format.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

/// Parts of one stamp come one right after the other; when none has come for so long, all have.
const ros::WallDuration part_gap(0.02);
/// A part that is lost stays lost until the place changes again.
constexpr std::uint32_t most_waiting_parts = 10000;

}  // namespace

MapReceiver::MapReceiver(ros::NodeHandle& node, const std::string& topic, Taken taken, Refused refused,
                         WantedMap wanted)
    : taken_(std::move(taken)), refused_(std::move(refused)), wanted_(std::move(wanted)) {
  const auto told = [this](const ros::WallTimerEvent&) { guarded([this] { tell(); }); };
  last_part_ = node.createWallTimer(part_gap, told, /*oneshot=*/true, /*autostart=*/false);
  const boost::function<void(const Message::ConstPtr&)> whole = [this](const Message::ConstPtr& message) {
    guarded([&] { take_whole(*message); });
  };
  const boost::function<void(const Message::ConstPtr&)> part = [this](const Message::ConstPtr& message) {
    guarded([&] { take_part(*message); });
  };
  whole_ = node.subscribe<Message>(topic, wanted_.queue_size, whole);
  updates_ = node.subscribe<Message>(topic + "_updates", most_waiting_parts, part);
}

void MapReceiver::take_whole(const Message& message) {
  HeightMap map = decode(message, whole_.getTopic());
  tell();
  const std_msgs::Header& header = message.info.header;
  if (held_.known() && header.frame_id != header_.frame_id) held_ = HeldMap();
  not_told_ = held_.take_whole(std::move(map), to_stamp(header.stamp));
  if (not_told_) header_ = header;
  tell();
}

void MapReceiver::take_part(const Message& message) {
  const std::string topic = updates_.getTopic();
  HeightMap part = decode(message, topic);
  const std_msgs::Header& header = message.info.header;
  if (held_.known() && header.frame_id != header_.frame_id)
    throw Error(fmt::format("{}: frame is '{}', must be '{}' as that of {}", topic, header.frame_id,
                            header_.frame_id, whole_.getTopic()));
  if (header.stamp != header_.stamp) tell();
  const std::optional<TileMask> changed = held_.take_part(std::move(part), to_stamp(header.stamp));
  if (!changed) return;
  if (not_told_)
    not_told_->merge(*changed);
  else
    not_told_ = changed;
  header_ = header;
  last_part_.stop();
  last_part_.start();
}

HeightMap MapReceiver::decode(const Message& message, const std::string& topic) const {
  if (wanted_.accept) wanted_.accept(topic, message.info.header);
  try {
    return to_height_map(message, wanted_.layers);
  } catch (const Error& error) {
    throw Error(topic + ": " + error.what());
  }
}

void MapReceiver::tell() {
  last_part_.stop();
  if (!not_told_) return;
  const TileMask changed = *std::exchange(not_told_, std::nullopt);
  // A part that came late does not set the map's time back.
  std_msgs::Header header = header_;
  header.stamp.fromNSec(static_cast<std::uint64_t>(held_.stamp().count()));
  taken_(held_.map(), header, changed);
}

template <class Work>
void MapReceiver::guarded(Work&& work) {
  try {
    work();
  } catch (const Error& error) {
    refused_(error.what());
  }
}

}  // namespace aeolian
