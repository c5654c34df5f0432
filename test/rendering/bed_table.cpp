#include "bed_table.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {

BedTable::BedTable(const std::function<double(double, double)>& bed, const Eigen::AlignedBox2d& area,
                   double spacing)
    : origin_(area.min() - Eigen::Vector2d::Constant(2 * spacing)),
      spacing_(spacing),
      columns_(static_cast<int>(area.sizes().x() / spacing) + 6),
      rows_(static_cast<int>(area.sizes().y() / spacing) + 6),
      middle_(bed(area.center().x(), area.center().y())) {
  heights_.reserve(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      heights_.push_back(
          static_cast<float>(bed(origin_.x() + column * spacing, origin_.y() + row * spacing) - middle_));
    }
  }
}

BedTable::Surface BedTable::at(double x, double y) const {
  const double fx = std::clamp((x - origin_.x()) / spacing_, 1.0, columns_ - 3.0);
  const double fy = std::clamp((y - origin_.y()) / spacing_, 1.0, rows_ - 3.0);
  const int column = static_cast<int>(fx);
  const int row = static_cast<int>(fy);
  const double u = fx - column;
  const double v = fy - row;
  const auto weights = [](double t, double* w, double* dw) {
    w[0] = t * (-0.5 + t * (1 - 0.5 * t));
    w[1] = 1 + t * t * (-2.5 + 1.5 * t);
    w[2] = t * (0.5 + t * (2 - 1.5 * t));
    w[3] = t * t * (-0.5 + 0.5 * t);
    dw[0] = -0.5 + t * (2 - 1.5 * t);
    dw[1] = t * (-5 + 4.5 * t);
    dw[2] = 0.5 + t * (4 - 4.5 * t);
    dw[3] = t * (-1 + 1.5 * t);
  };
  double wx[4], wy[4], dx[4], dy[4];
  weights(u, wx, dx);
  weights(v, wy, dy);
  const float* h = heights_.data() + static_cast<std::ptrdiff_t>(row - 1) * columns_ + (column - 1);
  Surface surface{middle_, 0, 0};
  for (int j = 0; j < 4; ++j, h += columns_) {
    const double along = wx[0] * h[0] + wx[1] * h[1] + wx[2] * h[2] + wx[3] * h[3];
    surface.height += wy[j] * along;
    surface.slope_y += dy[j] * along;
    surface.slope_x += wy[j] * (dx[0] * h[0] + dx[1] * h[1] + dx[2] * h[2] + dx[3] * h[3]);
  }
  surface.slope_x /= spacing_;
  surface.slope_y /= spacing_;
  return surface;
}

}  // namespace aeolian
