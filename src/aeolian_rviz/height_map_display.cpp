#include "aeolian_rviz/height_map_display.hpp"

#include <OgreSceneNode.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/properties/enum_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/string_property.h>

#include <pluginlib/class_list_macros.hpp>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {

HeightMapDisplay::HeightMapDisplay() {
  height_layer_ = new rviz::StringProperty("Height Layer", "elevation", "Layer drawn as the surface.", this,
                                           SLOT(redraw()));
  colour_layer_ = new rviz::StringProperty("Colour Layer", "elevation", "Layer that gives the colours.", this,
                                           SLOT(redraw()));
  palette_ = new rviz::EnumProperty("Palette", "Sand", "Colours: sand for heights, diverging for differences.", this,
                                    SLOT(redraw()));
  palette_->addOption("Sand", static_cast<int>(Palette::sand));
  palette_->addOption("Diverging", static_cast<int>(Palette::diverging));
  exaggeration_ = new rviz::FloatProperty("Exaggeration", 1, "Heights are drawn this many times too high.", this,
                                          SLOT(redraw()));
  exaggeration_->setMin(0.01F);
}

HeightMapDisplay::~HeightMapDisplay() = default;

void HeightMapDisplay::onInitialize() {
  MFDClass::onInitialize();
  mesh_ = std::make_unique<SurfaceMesh>(context_->getSceneManager(), scene_node_);
}

void HeightMapDisplay::reset() {
  MFDClass::reset();
  message_.reset();
  if (mesh_) mesh_->clear();
}

void HeightMapDisplay::processMessage(const grid_map_msgs::GridMap::ConstPtr& message) {
  message_ = message;
  redraw();
}

void HeightMapDisplay::redraw() {
  if (!message_ || !mesh_) return;
  Ogre::Vector3 position;
  Ogre::Quaternion orientation;
  const auto& header = message_->info.header;
  if (!context_->getFrameManager()->getTransform(header.frame_id, header.stamp, position, orientation)) return;
  try {
    const HeightMap map = to_height_map(*message_);
    const GridGeometry& geometry = map.geometry();
    const HeightMap::Layer& heights = map.layer(height_layer_->getStdString());
    const HeightMap::Layer& values = map.layer(colour_layer_->getStdString());
    const auto palette = static_cast<Palette>(palette_->getOptionInt());
    const double exaggeration = static_cast<double>(exaggeration_->getFloat());
    mesh_->update(geometry, heights,
                  shaded_colours(geometry, values, palette, display_range(values, palette), &heights, exaggeration),
                  exaggeration);
    const Ogre::Vector3 corner(static_cast<float>(geometry.origin_x()), static_cast<float>(geometry.origin_y()), 0);
    scene_node_->setPosition(position + orientation * corner);
    scene_node_->setOrientation(orientation);
    setStatus(rviz::StatusProperty::Ok, "Map", "drawn");
  } catch (const Error& error) {
    setStatusStd(rviz::StatusProperty::Error, "Map", error.what());
  }
}

}  // namespace aeolian

PLUGINLIB_EXPORT_CLASS(aeolian::HeightMapDisplay, rviz::Display)
