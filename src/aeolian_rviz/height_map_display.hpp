#pragma once

#include <grid_map_msgs/GridMap.h>
#include <rviz/message_filter_display.h>

#include <memory>

#include "aeolian_rviz/surface_mesh.hpp"

namespace rviz {
class EnumProperty;
class FloatProperty;
class StringProperty;
}  // namespace rviz

namespace aeolian {

/// rviz display of a grid map: a shaded surface of one layer, coloured by the same or another.
class HeightMapDisplay : public rviz::MessageFilterDisplay<grid_map_msgs::GridMap> {
  Q_OBJECT

 public:
  HeightMapDisplay();
  ~HeightMapDisplay() override;
  void reset() override;

 protected:
  void onInitialize() override;

 private Q_SLOTS:
  void redraw();

 private:
  void processMessage(const grid_map_msgs::GridMap::ConstPtr& message) override;

  rviz::StringProperty* height_layer_;
  rviz::StringProperty* colour_layer_;
  rviz::EnumProperty* palette_;
  rviz::FloatProperty* exaggeration_;
  std::unique_ptr<SurfaceMesh> mesh_;
  grid_map_msgs::GridMap::ConstPtr message_;
};

}  // namespace aeolian
