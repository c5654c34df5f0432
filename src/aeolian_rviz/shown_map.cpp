#include "aeolian_rviz/shown_map.hpp"

namespace aeolian {

void ShownMap::listen(ros::NodeHandle& node, const std::string& topic) {
  receiver_.reset();
  map_ = nullptr;
  mesh_.clear();
  taken_ = refused_ = 0;
  complaint_.clear();
  marked_ = GridGeometry();
  if (topic.empty()) return;
  receiver_ = std::make_unique<MapReceiver>(
      node, topic,
      [this](const HeightMap& map, const std_msgs::Header& header, const TileMask& changed) {
        take(map, header, changed);
      },
      [this](const std::string& reason) {
        ++refused_;
        complaint_ = reason;
      });
}

void ShownMap::take(const HeightMap& map, const std_msgs::Header& header, const TileMask& changed) {
  if (map.geometry() == marked_)
    changed_.merge(changed);
  else
    changed_ = changed;
  marked_ = map.geometry();
  map_ = &map;
  header_ = header;
  pending_ = true;
  ++taken_;
  complaint_.clear();
}

void ShownMap::draw(const Look& look) {
  if (!known()) return;
  if (!(look == look_)) {
    look_ = look;
    changed_ = TileMask(marked_, true);
    pending_ = true;
  }
  if (!pending_) return;
  pending_ = false;  // also when a layer is absent: until the next map or another look
  mesh_.update(marked_, map_->layer(look.height_layer), map_->layer(look.colour_layer), look.colouring,
               changed_);
  changed_.clear();
}

}  // namespace aeolian
