#pragma once

#include <memory>

#include "aeolian_rviz/surface_mesh.hpp"
#include <grid_map_msgs/GridMap.h>
#include <ros/subscriber.h>
#include <rviz/display.h>

namespace rviz {
class EnumProperty;
class FloatProperty;
class RosTopicProperty;
class StringProperty;
}  // namespace rviz

namespace aeolian {

/// rviz display of a grid map: a shaded surface of one layer, coloured by the same or another.
/// (Not a MessageFilterDisplay: that asks for a header at the top of the message, and a grid map's is inside
/// `info`.)
class HeightMapDisplay : public rviz::Display {
  Q_OBJECT

 public:
  HeightMapDisplay();
  ~HeightMapDisplay() override;
  void reset() override;
  void setTopic(const QString& topic, const QString& datatype) override;

 protected:
  void onInitialize() override;
  void onEnable() override;
  void onDisable() override;
  void fixedFrameChanged() override;

 private Q_SLOTS:
  void resubscribe();
  void redraw();

 private:
  void take(const grid_map_msgs::GridMap::ConstPtr& message);

  rviz::RosTopicProperty* topic_;
  rviz::StringProperty* height_layer_;
  rviz::StringProperty* colour_layer_;
  rviz::EnumProperty* palette_;
  rviz::FloatProperty* exaggeration_;
  std::unique_ptr<SurfaceMesh> mesh_;
  ros::Subscriber subscriber_;
  grid_map_msgs::GridMap::ConstPtr message_;
};

}  // namespace aeolian
