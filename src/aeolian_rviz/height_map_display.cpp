#include "aeolian_rviz/height_map_display.hpp"

#include <OgreSceneNode.h>
#include <pluginlib/class_list_macros.hpp>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/properties/enum_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/ros_topic_property.h>
#include <rviz/properties/string_property.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {

HeightMapDisplay::HeightMapDisplay() {
  topic_ = new rviz::RosTopicProperty(
      "Topic", "", QString::fromStdString(ros::message_traits::datatype<grid_map_msgs::GridMap>()),
      "Grid map to draw.", this, SLOT(resubscribe()));
  height_layer_ = new rviz::StringProperty("Height Layer", "elevation", "Layer drawn as the surface.", this,
                                           SLOT(redraw()));
  colour_layer_ = new rviz::StringProperty("Colour Layer", "elevation", "Layer that gives the colours.", this,
                                           SLOT(redraw()));
  palette_ = new rviz::EnumProperty(
      "Palette", "Sand", "Colours: sand for heights, diverging for differences.", this, SLOT(redraw()));
  palette_->addOption("Sand", static_cast<int>(Palette::sand));
  palette_->addOption("Diverging", static_cast<int>(Palette::diverging));
  exaggeration_ = new rviz::FloatProperty("Exaggeration", 1, "Heights are drawn this many times too high.",
                                          this, SLOT(redraw()));
  exaggeration_->setMin(0.01F);
}

HeightMapDisplay::~HeightMapDisplay() = default;

void HeightMapDisplay::onInitialize() {
  mesh_ = std::make_unique<SurfaceMesh>(context_->getSceneManager(), scene_node_);
}

void HeightMapDisplay::onEnable() { resubscribe(); }

void HeightMapDisplay::onDisable() {
  subscriber_.shutdown();
  reset();
}

void HeightMapDisplay::fixedFrameChanged() { redraw(); }

void HeightMapDisplay::setTopic(const QString& topic, const QString& /*datatype*/) {
  topic_->setString(topic);
}

void HeightMapDisplay::reset() {
  Display::reset();
  message_.reset();
  if (mesh_) mesh_->clear();
}

void HeightMapDisplay::resubscribe() {
  if (!isEnabled()) return;
  reset();
  subscriber_.shutdown();
  if (topic_->getTopicStd().empty()) return;
  try {
    subscriber_ = update_nh_.subscribe(topic_->getTopicStd(), 1, &HeightMapDisplay::take, this);
  } catch (const ros::Exception& error) {
    setStatusStd(rviz::StatusProperty::Error, "Topic", error.what());
  }
}

void HeightMapDisplay::take(const grid_map_msgs::GridMap::ConstPtr& message) {
  message_ = message;
  redraw();
}

void HeightMapDisplay::redraw() {
  if (!message_ || !mesh_) return;
  Ogre::Vector3 position;
  Ogre::Quaternion orientation;
  // The newest transform: a forecast's stamp lies in the future.
  const std::string& frame = message_->info.header.frame_id;
  if (!context_->getFrameManager()->getTransform(frame, ros::Time(), position, orientation)) {
    setStatusStd(rviz::StatusProperty::Error, "Map", "no transform from '" + frame + "' to the fixed frame");
    return;
  }
  try {
    const HeightMap map = to_height_map(*message_);
    const GridGeometry& geometry = map.geometry();
    const HeightMap::Layer& heights = map.layer(height_layer_->getStdString());
    const HeightMap::Layer& values = map.layer(colour_layer_->getStdString());
    const auto palette = static_cast<Palette>(palette_->getOptionInt());
    const double exaggeration = static_cast<double>(exaggeration_->getFloat());
    mesh_->update(
        geometry, heights,
        shaded_colours(geometry, values, palette, display_range(values, palette), &heights, exaggeration),
        exaggeration);
    const Ogre::Vector3 corner(static_cast<float>(geometry.origin_x()),
                               static_cast<float>(geometry.origin_y()), 0);
    scene_node_->setPosition(position + orientation * corner);
    scene_node_->setOrientation(orientation);
    setStatus(rviz::StatusProperty::Ok, "Map", "drawn");
  } catch (const Error& error) {
    setStatusStd(rviz::StatusProperty::Error, "Map", error.what());
  }
}

}  // namespace aeolian

PLUGINLIB_EXPORT_CLASS(aeolian::HeightMapDisplay, rviz::Display)
