#pragma once

#include <QStringList>
#include <QWidget>

namespace aeolian {

/// The names of a horizontal slider's positions, each under its place. A name that would run into the one
/// before is left out.
class SliderMarks : public QWidget {
 public:
  explicit SliderMarks(QWidget* parent);
  void set(const QStringList& names);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QStringList names_;
};

}  // namespace aeolian
