#include "aeolian_rviz/slider_marks.hpp"

#include <QFontMetrics>
#include <QPainter>
#include <QStyle>
#include <algorithm>

namespace aeolian {

SliderMarks::SliderMarks(QWidget* parent) : QWidget(parent) { setFixedHeight(fontMetrics().height() + 2); }

void SliderMarks::set(const QStringList& names) {
  if (names == names_) return;
  names_ = names;
  update();
}

void SliderMarks::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  const int handle = style()->pixelMetric(QStyle::PM_SliderLength);
  int free_from = 0;
  for (int i = 0; i < names_.size(); ++i) {
    const int place =
        handle / 2 + QStyle::sliderPositionFromValue(0, std::max(names_.size() - 1, 1), i, width() - handle);
    const int wide = fontMetrics().horizontalAdvance(names_[i]);
    const int left = std::clamp(place - wide / 2, 0, std::max(width() - wide, 0));
    if (left < free_from) continue;
    painter.drawText(left, fontMetrics().ascent(), names_[i]);
    free_from = left + wide + fontMetrics().horizontalAdvance(' ');
  }
}

}  // namespace aeolian
