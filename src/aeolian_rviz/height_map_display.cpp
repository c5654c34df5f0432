#include "aeolian_rviz/height_map_display.hpp"

#include <cmath>

#include <OgreSceneNode.h>
#include <OgreViewport.h>
#include <fmt/format.h>
#include <grid_map_msgs/GridMap.h>
#include <pluginlib/class_list_macros.hpp>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/properties/bool_property.h>
#include <rviz/properties/editable_enum_property.h>
#include <rviz/properties/enum_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/ros_topic_property.h>
#include <rviz/render_panel.h>
#include <rviz/view_manager.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// Leaves room for taking maps between the frames at ten or more of them a second.
constexpr double frame_budget = 0.04;
const ros::WallDuration telling_period(0.5);

std::string told_length(double metres) {
  return std::abs(metres) < 0.5 ? fmt::format("{:.3g} mm", metres * 1e3) : fmt::format("{:.4g} m", metres);
}

}  // namespace

HeightMapDisplay::HeightMapDisplay() : budget_(frame_budget) {
  make_map_properties();
  make_look_properties();
}

HeightMapDisplay::~HeightMapDisplay() {
  if (initialized()) clock_.stop();
}

void HeightMapDisplay::make_map_properties() {
  const QString type = QString::fromStdString(ros::message_traits::datatype<grid_map_msgs::GridMap>());
  topic_ = new rviz::RosTopicProperty(
      "Topic", "", type, "Grid map to draw; what changes of it is taken from the same name with _updates.",
      this, SLOT(listen()));
  predicted_topic_ = new rviz::RosTopicProperty("Predicted Topic", "", type,
                                                "Grid map that takes turns with the first, in its place.",
                                                this, SLOT(listen()));
  flicker_period_ = new rviz::FloatProperty(
      "Flicker Period", 0, "Time [s] in which both maps are seen once; 0: the first one stays.", this);
  flicker_period_->setMin(0);
}

void HeightMapDisplay::make_look_properties() {
  height_layer_ = new rviz::EditableEnumProperty("Height Layer", QString::fromStdString(layer::elevation),
                                                 "Layer drawn as the surface.", this, SLOT(change_look()));
  colour_layer_ = new rviz::EditableEnumProperty("Colour Layer", QString::fromStdString(layer::elevation),
                                                 "Layer that gives the colours.", this, SLOT(change_look()));
  for (rviz::EditableEnumProperty* property : {height_layer_, colour_layer_})
    connect(property, &rviz::EditableEnumProperty::requestOptions, this, &HeightMapDisplay::offer_layers);
  palette_ = new rviz::EnumProperty("Palette", "Sand",
                                    "Sand for heights, diverging (blue below zero, red above) for "
                                    "differences, viridis for other values, grey "
                                    "for the relief alone.",
                                    this, SLOT(change_look()));
  palette_->addOption("Sand", static_cast<int>(Palette::sand));
  palette_->addOption("Diverging", static_cast<int>(Palette::diverging));
  palette_->addOption("Viridis", static_cast<int>(Palette::viridis));
  palette_->addOption("Grey", static_cast<int>(Palette::grey));
  automatic_range_ = new rviz::BoolProperty(
      "Automatic Range", true, "The colours span the middle 96 % of the values.", this, SLOT(change_look()));
  automatic_range_->setDisableChildrenIfFalse(false);
  range_low_ = new rviz::FloatProperty("Low", 0, "Value of the first colour.", automatic_range_,
                                       SLOT(change_look()), this);
  range_high_ = new rviz::FloatProperty("High", 1, "Value of the last colour.", automatic_range_,
                                        SLOT(change_look()), this);
  shading_ = new rviz::BoolProperty("Shading", true,
                                    "Slopes are darker or brighter, as under a lamp in the north-west.", this,
                                    SLOT(change_look()));
  contours_ = new rviz::BoolProperty("Contours", false, "Lines of equal height, every fifth one stronger.",
                                     this, SLOT(change_look()));
  contours_->setDisableChildrenIfFalse(true);
  contour_interval_ = new rviz::FloatProperty(
      "Interval", 0, "Height between the lines [m]; 0: a round one, for some ten lines.", contours_,
      SLOT(change_look()), this);
  contour_interval_->setMin(0);
  exaggeration_ = new rviz::FloatProperty("Exaggeration", 1,
                                          "Heights above the lowest are drawn this many times too high.",
                                          this, SLOT(change_look()));
  exaggeration_->setMin(0.01F);
  alpha_ = new rviz::FloatProperty("Alpha", 1, "0 is transparent, 1 opaque.", this, SLOT(change_alpha()));
  alpha_->setMin(0);
  alpha_->setMax(1);
  centred_ = new rviz::BoolProperty(
      "Centred", false,
      "Drawn with its centre at the origin of its frame: for large coordinates, which rviz draws trembling.",
      this);
}

void HeightMapDisplay::onInitialize() {
  measured_ = std::make_unique<ShownMap>(scene_node_);
  predicted_ = std::make_unique<ShownMap>(scene_node_);
  clock_.start();
}

void HeightMapDisplay::onEnable() { listen(); }

void HeightMapDisplay::onDisable() {
  measured_->listen(update_nh_, "");
  predicted_->listen(update_nh_, "");
}

void HeightMapDisplay::setTopic(const QString& topic, const QString& /*datatype*/) {
  topic_->setString(topic);
}

void HeightMapDisplay::reset() {
  Display::reset();
  listen();
}

void HeightMapDisplay::listen() {
  if (!initialized() || !isEnabled()) return;
  clearStatuses();
  look_is_new_ = true;
  flicker_time_ = 0;
  const auto start = [this](ShownMap& shown, const rviz::RosTopicProperty& topic) {
    try {
      shown.listen(update_nh_, topic.getTopicStd());
    } catch (const ros::Exception& error) {
      setStatusStd(rviz::StatusProperty::Error, topic.getName().toStdString(), error.what());
    }
  };
  start(*measured_, *topic_);
  start(*predicted_, *predicted_topic_);
}

void HeightMapDisplay::change_look() { look_is_new_ = true; }

void HeightMapDisplay::change_alpha() {
  if (!initialized()) return;
  for (ShownMap* shown : {measured_.get(), predicted_.get()}) shown->mesh().set_alpha(alpha_->getFloat());
}

void HeightMapDisplay::offer_layers(rviz::EditableEnumProperty* property) {
  property->clearOptions();
  if (!reference().known()) return;
  for (const std::string& name : reference().map().names()) property->addOptionStd(name);
}

const ShownMap& HeightMapDisplay::reference() const { return measured_->known() ? *measured_ : *predicted_; }

void HeightMapDisplay::choose_ranges() {
  const ShownMap& shown = reference();
  if (!shown.known() || (!look_is_new_ && shown.taken() == ranged_maps_)) return;
  ranged_maps_ = shown.taken();
  const auto range = [&](const std::string& name, Palette palette, const ValueRange& before) {
    if (!shown.map().has(name)) return before;
    const ValueRange present = quick_display_range(shown.map().layer(name), palette);
    return look_is_new_ ? present : steady_range(before, present);
  };
  value_range_ =
      range(colour_layer_->getStdString(), static_cast<Palette>(palette_->getOptionInt()), value_range_);
  height_range_ = range(height_layer_->getStdString(), Palette::sand, height_range_);
  look_is_new_ = false;
}

Look HeightMapDisplay::look() const {
  Look result{height_layer_->getStdString(), colour_layer_->getStdString(), {}};
  Colouring& colouring = result.colouring;
  colouring.palette = static_cast<Palette>(palette_->getOptionInt());
  colouring.range = value_range_;
  if (!automatic_range_->getBool())
    colouring.range = {static_cast<double>(range_low_->getFloat()),
                       static_cast<double>(range_high_->getFloat())};
  colouring.shaded = shading_->getBool();
  colouring.exaggeration = static_cast<double>(exaggeration_->getFloat());
  if (contours_->getBool()) {
    const auto given = static_cast<double>(contour_interval_->getFloat());
    colouring.contour_interval = given > 0 ? given : round_contour_interval(height_range_);
  }
  return result;
}

void HeightMapDisplay::draw(ShownMap& shown, const QString& status) {
  try {
    shown.draw(look());
  } catch (const Error& error) {
    setStatusStd(rviz::StatusProperty::Error, status.toStdString(), error.what());
  }
}

bool HeightMapDisplay::place(ShownMap& shown, const std::array<double, 2>& centre) {
  if (!shown.known()) return false;
  Ogre::Vector3 position;
  Ogre::Quaternion orientation;
  // The newest transform: a forecast's stamp lies in the future.
  const std::string& frame = shown.header().frame_id;
  if (!context_->getFrameManager()->getTransform(frame, ros::Time(), position, orientation)) {
    setStatusStd(rviz::StatusProperty::Error, "Transform", "none from '" + frame + "' to the fixed frame");
    return false;
  }
  setStatus(rviz::StatusProperty::Ok, "Transform", "known");
  shown.mesh().place(position, orientation, centre, static_cast<double>(exaggeration_->getFloat()));
  return true;
}

bool HeightMapDisplay::prediction_is_due(double wall_dt) {
  const auto period = static_cast<double>(flicker_period_->getFloat());
  if (!predicted_->known()) return false;
  if (!measured_->known()) return true;
  if (period <= 0) return false;
  flicker_time_ = std::fmod(flicker_time_ + wall_dt, period);
  return flicker_time_ >= period / 2;
}

void HeightMapDisplay::update(float wall_dt, float /*ros_dt*/) {
  choose_ranges();
  ShownMap* next = prediction_is_due(static_cast<double>(wall_dt)) ? predicted_.get() : measured_.get();
  ShownMap* other = next == measured_.get() ? predicted_.get() : measured_.get();
  draw(*next, next == measured_.get() ? "Map" : "Prediction");

  std::array<double, 2> centre{0, 0};
  if (centred_->getBool() && reference().known()) {
    const GridGeometry& grid = reference().map().geometry();
    centre = {grid.origin_x() + grid.length_x() / 2, grid.origin_y() + grid.length_y() / 2};
  }
  place(*next, centre);
  // Mesa's software renderer writes beyond the picture of a window that is being closed.
  next->mesh().set_visible(context_->getViewManager()->getRenderPanel()->isVisible());
  other->mesh().set_visible(false);
  const bool turned = seen_ != next;
  seen_ = next;
  choose_detail();
  if (turned || ros::WallTime::now() - told_ > telling_period) tell();
}

void HeightMapDisplay::choose_detail() {
  const rviz::RenderPanel* panel = context_->getViewManager()->getRenderPanel();
  const Ogre::Viewport* viewport = panel ? panel->getViewport() : nullptr;
  if (!viewport || !viewport->getCamera() || !seen_->known()) return;
  if (clock_.frames() > 0)
    budget_.add_frame(clock_.last_seconds(),
                      [&](double pixels) { return seen_->mesh().count_triangles(*viewport, pixels); });
  seen_->mesh().set_detail(*viewport, budget_.quad_pixels());
}

void HeightMapDisplay::tell_of_messages(const ShownMap& shown, const QString& name) {
  using rviz::StatusProperty;
  const QString refusals = name + " refused";
  if (shown.refused() > 0)
    setStatusStd(shown.complaint().empty() ? StatusProperty::Warn : StatusProperty::Error,
                 refusals.toStdString(),
                 fmt::format("{} messages{}", shown.refused(),
                             shown.complaint().empty() ? "" : ", the latest: " + shown.complaint()));
  if (!shown.known()) {
    setStatus(StatusProperty::Warn, name, "none has come");
    return;
  }
  for (const std::string& layer : {height_layer_->getStdString(), colour_layer_->getStdString()})
    if (!shown.map().has(layer)) return;  // said when it was drawn
  const GridGeometry& grid = shown.map().geometry();
  setStatusStd(StatusProperty::Ok, name.toStdString(),
               fmt::format("{} x {} cells of {}, stamp {:.3f}, {} taken", grid.nx(), grid.ny(),
                           told_length(grid.cell()), shown.header().stamp.toSec(), shown.taken()));
}

void HeightMapDisplay::tell() {
  using rviz::StatusProperty;
  told_ = ros::WallTime::now();
  tell_of_messages(*measured_, "Map");
  if (!predicted_topic_->getTopicStd().empty()) tell_of_messages(*predicted_, "Prediction");
  if (!seen_->known()) return;
  std::string shown = seen_ == measured_.get() ? "measured" : "predicted";
  if (seen_ == predicted_.get() && measured_->known())
    shown += fmt::format(", {:.1f} s after the measured",
                         (predicted_->header().stamp - measured_->header().stamp).toSec());
  setStatusStd(StatusProperty::Ok, "Shown", shown);
  const Colouring colouring = look().colouring;
  std::string range = fmt::format("{:.4g} to {:.4g}", colouring.range.low, colouring.range.high);
  if (colouring.contour_interval > 0) range += ", contours every " + told_length(colouring.contour_interval);
  setStatusStd(StatusProperty::Ok, "Range", range);
  setStatusStd(
      StatusProperty::Ok, "Frames",
      fmt::format("{:.0f} ms each, {} triangles, quads of up to {:.0f} pixels", budget_.frame_seconds() * 1e3,
                  seen_->mesh().drawn_triangles(), budget_.quad_pixels()));
}

}  // namespace aeolian

PLUGINLIB_EXPORT_CLASS(aeolian::HeightMapDisplay, rviz::Display)
