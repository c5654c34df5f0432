#pragma once

#include <memory>
#include <string>

#include "aeolian_rviz/frame_budget.hpp"
#include "aeolian_rviz/frame_clock.hpp"
#include "aeolian_rviz/shown_map.hpp"
#include <ros/time.h>
#include <rviz/display.h>

namespace rviz {
class BoolProperty;
class EditableEnumProperty;
class EnumProperty;
class FloatProperty;
class RosTopicProperty;
}  // namespace rviz

namespace aeolian {

/// rviz display of a grid map: a shaded surface of one layer, coloured by the same or another, with contours;
/// alternating in place with a second map, the prediction of the first. docs/rviz.md tells of its properties.
/// (Not a MessageFilterDisplay: that asks for a header at the top of the message, and a grid map's is inside
/// `info`.)
class HeightMapDisplay : public rviz::Display {
  Q_OBJECT

 public:
  HeightMapDisplay();
  ~HeightMapDisplay() override;
  void reset() override;
  void update(float wall_dt, float ros_dt) override;
  void setTopic(const QString& topic, const QString& datatype) override;
  /// The map that is visible, the measured or the predicted one; null before the first frame.
  const ShownMap* seen() const { return seen_; }
  double quad_pixels() const { return budget_.quad_pixels(); }

 protected:
  void onInitialize() override;
  void onEnable() override;
  void onDisable() override;

 private Q_SLOTS:
  void listen();
  void change_look();
  void change_alpha();
  void offer_layers(rviz::EditableEnumProperty* property);

 private:
  void make_map_properties();
  void make_look_properties();
  const ShownMap& reference() const;
  void choose_ranges();
  Look look() const;
  void draw(ShownMap& shown, const QString& status);
  bool place(ShownMap& shown, const std::array<double, 2>& centre);
  bool prediction_is_due(double wall_dt);
  void choose_detail();
  void tell();
  void tell_of_messages(const ShownMap& shown, const QString& name);

  rviz::RosTopicProperty* topic_;
  rviz::RosTopicProperty* predicted_topic_;
  rviz::FloatProperty* flicker_period_;
  rviz::EditableEnumProperty* height_layer_;
  rviz::EditableEnumProperty* colour_layer_;
  rviz::EnumProperty* palette_;
  rviz::BoolProperty* automatic_range_;
  rviz::FloatProperty* range_low_;
  rviz::FloatProperty* range_high_;
  rviz::BoolProperty* shading_;
  rviz::BoolProperty* contours_;
  rviz::FloatProperty* contour_interval_;
  rviz::FloatProperty* exaggeration_;
  rviz::FloatProperty* alpha_;
  rviz::BoolProperty* centred_;

  std::unique_ptr<ShownMap> measured_;
  std::unique_ptr<ShownMap> predicted_;
  ShownMap* seen_ = nullptr;  ///< the one of the two that is visible
  double flicker_time_ = 0;   ///< since the measured map was last turned to [s]

  bool look_is_new_ = true;
  std::size_t ranged_maps_ = 0;  ///< taken when the ranges were chosen
  ValueRange value_range_;
  ValueRange height_range_;

  FrameClock clock_;
  FrameBudget budget_;
  ros::WallTime told_;
};

}  // namespace aeolian
