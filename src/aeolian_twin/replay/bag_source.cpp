#include "aeolian_twin/replay/bag_source.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr std::size_t most_ahead = 16;

void open(rosbag::Bag& bag, const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) throw Error("bag " + path + ": there is no such file");
  try {
    bag.open(path, rosbag::bagmode::Read);
  } catch (const rosbag::BagUnindexedException&) {
    throw Error("bag " + path + ": has no index (its recording was cut off?); `rosbag reindex` gives it one");
  } catch (const rosbag::BagException& error) {
    throw Error("bag " + path + ": cannot be read: " + error.what());
  }
}

/// The bag's topics and the types of their messages.
std::map<std::string, std::string> topics_of(rosbag::Bag& bag) {
  std::map<std::string, std::string> topics;
  rosbag::View all(bag);
  for (const rosbag::ConnectionInfo* connection : all.getConnections())
    topics[connection->topic] = connection->datatype;
  return topics;
}

template <class Message>
void require_type(const std::string& path, const std::map<std::string, std::string>& present,
                  const std::string& topic) {
  const auto found = present.find(topic);
  const std::string type = ros::message_traits::DataType<Message>::value();
  if (found != present.end() && found->second != type)
    throw Error(fmt::format("bag {}: topic {} holds {}, must be {}", path, topic, found->second, type));
}

void require_any(const std::string& path, const std::map<std::string, std::string>& present,
                 const std::string& what, const std::vector<std::string>& topics) {
  if (std::any_of(topics.begin(), topics.end(), [&](const std::string& t) { return present.count(t) > 0; }))
    return;
  std::vector<std::string> names;
  for (const auto& [topic, type] : present) names.push_back(topic);
  throw Error(fmt::format("bag {}: there {} on {}; its topics are: {}", path, what, fmt::join(topics, ", "),
                          names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

}  // namespace

BagSource::BagSource(const std::string& path, const ReplayConfig& config)
    : path_(path), topics_(config.topics), ahead_(most_ahead) {
  open(bag_, path);
  std::vector<std::string> clouds;
  for (const SensorSettings& sensor : config.sensors) clouds.push_back(sensor.topic);
  const std::map<std::string, std::string> present = topics_of(bag_);
  require_any(path, present, "are no clouds", clouds);
  require_any(path, present, "is no wind", {topics_.wind});
  for (const std::string& topic : clouds) require_type<sensor_msgs::PointCloud2>(path, present, topic);
  require_type<geometry_msgs::TwistStamped>(path, present, topics_.wind);
  require_type<aeolian_msgs::WindAhead>(path, present, topics_.wind_ahead);
  require_type<tf2_msgs::TFMessage>(path, present, topics_.tf);
  require_type<tf2_msgs::TFMessage>(path, present, topics_.tf_static);

  std::vector<std::string> wanted = clouds;
  for (const std::string& topic : {topics_.wind, topics_.wind_ahead, topics_.tf, topics_.tf_static})
    wanted.push_back(topic);
  view_ = std::make_unique<rosbag::View>(bag_, rosbag::TopicQuery(wanted));
  reader_ = std::thread([this] { read_ahead(); });
}

BagSource::~BagSource() {
  ahead_.close();
  reader_.join();
}

std::optional<BagSource::Message> BagSource::next() {
  std::optional<Message> message = ahead_.pop();
  if (!message && failure_) std::rethrow_exception(failure_);
  return message;
}

void BagSource::read_ahead() {
  try {
    for (const rosbag::MessageInstance& instance : *view_)
      if (!ahead_.push(read(instance))) return;
  } catch (const rosbag::BagException& error) {
    failure_ = std::make_exception_ptr(Error("bag " + path_ + ": is damaged: " + error.what()));
  } catch (...) {
    failure_ = std::current_exception();
  }
  ahead_.close();
}

BagSource::Message BagSource::read(const rosbag::MessageInstance& instance) const {
  Message message;
  message.time = instance.getTime();
  const double length = (view_->getEndTime() - view_->getBeginTime()).toSec();
  message.share = length > 0 ? (message.time - view_->getBeginTime()).toSec() / length : 1;
  const std::string& topic = instance.getTopic();
  if (topic == topics_.tf || topic == topics_.tf_static)
    message.content = Transforms{instance.instantiate<tf2_msgs::TFMessage>(), topic == topics_.tf_static};
  else if (topic == topics_.wind)
    message.content =
        geometry_msgs::TwistStampedConstPtr(instance.instantiate<geometry_msgs::TwistStamped>());
  else if (topic == topics_.wind_ahead)
    message.content = aeolian_msgs::WindAheadConstPtr(instance.instantiate<aeolian_msgs::WindAhead>());
  else
    message.content = Cloud{instance.instantiate<ReadCloud>(), topic};
  return message;
}

}  // namespace aeolian
