#pragma once

#include "aeolian_rviz/horizon_choice.hpp"
#include <aeolian_msgs/ForecastHorizons.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <rviz/panel.h>

class QLabel;
class QSlider;

namespace aeolian {

class SliderMarks;

/// Which forecast the displays show: a slider from the surface as measured now over the lead times that there
/// are, with the time for which the forecast holds. Follows what others choose on the topic.
class HorizonPanel : public rviz::Panel {
  Q_OBJECT
 public:
  explicit HorizonPanel(QWidget* parent = nullptr);
  void onInitialize() override;

 private Q_SLOTS:
  void choose(int position);

 private:
  void take(const aeolian_msgs::ForecastHorizons::ConstPtr& message);
  void say(int position);

  HorizonChoice choice_;
  QLabel* title_;
  QLabel* times_;
  QSlider* slider_;
  SliderMarks* marks_;
  ros::NodeHandle node_;
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
};

}  // namespace aeolian
