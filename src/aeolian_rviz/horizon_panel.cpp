#include "aeolian_rviz/horizon_panel.hpp"

#include <QLabel>
#include <QSlider>
#include <QVBoxLayout>

#include "aeolian_rviz/slider_marks.hpp"
#include <pluginlib/class_list_macros.hpp>
#include <std_msgs/Float64.h>

namespace aeolian {

HorizonPanel::HorizonPanel(QWidget* parent) : rviz::Panel(parent) {
  title_ = new QLabel(this);
  QFont bold = title_->font();
  bold.setBold(true);
  bold.setPointSizeF(1.2 * bold.pointSizeF());
  title_->setFont(bold);
  times_ = new QLabel(this);
  times_->setWordWrap(true);
  slider_ = new QSlider(Qt::Horizontal, this);
  slider_->setTickPosition(QSlider::TicksBelow);
  slider_->setTickInterval(1);
  slider_->setPageStep(1);
  marks_ = new SliderMarks(this);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(title_);
  layout->addWidget(times_);
  layout->addWidget(slider_);
  layout->addWidget(marks_);
  layout->addStretch();
  connect(slider_, &QSlider::valueChanged, this, &HorizonPanel::choose);
  slider_->setEnabled(false);
  say(0);
}

void HorizonPanel::onInitialize() {
  publisher_ = node_.advertise<std_msgs::Float64>("chosen_lead_time", 1);
  subscriber_ = node_.subscribe("forecast_horizons", 1, &HorizonPanel::take, this);
}

void HorizonPanel::choose(int position) {
  say(position);
  std_msgs::Float64 lead_time;
  lead_time.data = choice_.lead_time(position);
  publisher_.publish(lead_time);
}

void HorizonPanel::take(const aeolian_msgs::ForecastHorizons::ConstPtr& message) {
  choice_.take(*message);
  QStringList names;
  for (int position = 0; position <= choice_.last(); ++position)
    names << QString::fromStdString(choice_.mark(position));
  marks_->set(names);
  {
    const QSignalBlocker no_answer(slider_);
    slider_->setEnabled(choice_.last() > 0);
    slider_->setRange(0, choice_.last());
    // A hand on the slider is not moved.
    if (!slider_->isSliderDown()) slider_->setValue(choice_.chosen());
  }
  say(slider_->value());
}

void HorizonPanel::say(int position) {
  title_->setText(QString::fromStdString(choice_.title(position)));
  times_->setText(QString::fromStdString(choice_.times(position)));
}

}  // namespace aeolian

PLUGINLIB_EXPORT_CLASS(aeolian::HorizonPanel, rviz::Panel)
