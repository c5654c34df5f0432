#include "aeolian_core/grains/impacts/bed_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr double columns_per_diameter = 50;  // of the envelope: a grain exposed less than that is not seen
constexpr int sections_per_diameter = 4;

/// The grains of a bed, for sections of it.
class Sections {
 public:
  template <int Dim>
  Sections(const GrainDynamics<Dim>& grains, double radius, double length, double width)
      : length_(length),
        columns_(static_cast<std::size_t>(std::ceil(columns_per_diameter * length / (2 * radius)))) {
    const auto& period = grains.world().period;
    period_x_ = period.x();
    for (const int grain : grains.numbers()) {
      const auto place = grains.position(grain);
      Ball ball{grain, place.x(), 0, place[Dim - 1], grains.radius(grain) + radius};
      if constexpr (Dim == 3) ball.y = place.y();
      balls_.push_back(ball);
    }
    if constexpr (Dim == 3) {
      period_y_ = period.y();
      const int count =
          std::max(1, static_cast<int>(std::round(sections_per_diameter * width / (2 * radius))));
      for (int i = 0; i < count; ++i) across_.push_back((i + 0.5) * width / count);
    } else {
      (void)width;
      across_.push_back(0);
    }
  }

  const std::vector<double>& across() const { return across_; }
  double spacing() const { return across_.size() > 1 ? across_[1] - across_[0] : 0; }
  double distance_across(int index, double y) const {
    return std::abs(nearest_image(balls_[static_cast<std::size_t>(index)].y - y, period_y_));
  }

  struct Link {
    int index;  ///< of the ball
    int grain;
    double height;
    std::size_t columns;  ///< it is seen in so many
  };
  /// The chain at one place across, without the grains of the layers above `layer`.
  std::vector<Link> chain(double y, const std::vector<int>& layers, int layer) const {
    std::vector<double> height(columns_, -std::numeric_limits<double>::infinity());
    std::vector<int> owner(columns_, -1);
    const double step = length_ / static_cast<double>(columns_);
    for (std::size_t b = 0; b < balls_.size(); ++b) {
      const Ball& ball = balls_[b];
      if (layers[static_cast<std::size_t>(ball.grain)] < layer) continue;
      const double dy = nearest_image(ball.y - y, period_y_);
      const double reach2 = ball.reach * ball.reach - dy * dy;
      if (reach2 <= 0) continue;
      const double reach = std::sqrt(reach2);
      const auto first = static_cast<long>(std::ceil((ball.x - reach) / step - 0.5));
      const auto last = static_cast<long>(std::floor((ball.x + reach) / step - 0.5));
      for (long c = first; c <= last; ++c) {
        const auto column = period_x_ > 0 ? wrapped(c) : c;
        if (column < 0 || column >= static_cast<long>(columns_)) continue;
        const double dx = (static_cast<double>(c) + 0.5) * step - ball.x;
        const double h = ball.height + std::sqrt(std::max(0.0, reach2 - dx * dx));
        const auto i = static_cast<std::size_t>(column);
        if (h > height[i]) {
          height[i] = h;
          owner[i] = static_cast<int>(b);
        }
      }
    }
    std::vector<Link> links;
    for (const int b : owner) {
      if (b < 0) continue;
      const Ball& ball = balls_[static_cast<std::size_t>(b)];
      if (links.empty() || links.back().index != b) links.push_back({b, ball.grain, ball.height, 0});
      ++links.back().columns;
    }
    return links;
  }

  bool round_x() const { return period_x_ > 0; }

 private:
  struct Ball {
    int grain;
    double x, y, height, reach;
  };
  static double nearest_image(double distance, double period) {
    return period > 0 ? distance - period * std::round(distance / period) : distance;
  }
  long wrapped(long column) const {
    const auto n = static_cast<long>(columns_);
    return (column % n + n) % n;
  }

  double length_;
  std::size_t columns_;
  double period_x_ = 0, period_y_ = 0;
  std::vector<Ball> balls_;
  std::vector<double> across_;
};

}  // namespace

template <int Dim>
BedSurface::BedSurface(const GrainDynamics<Dim>& grains, double radius, double length, double width) {
  if (grains.size() == 0) throw Error("bed: it has no grains");
  const auto numbers = static_cast<std::size_t>(grains.numbers().back()) + 1;
  layers_.assign(numbers, 3);
  steps_.assign(numbers, Origin::other);
  top_ = -std::numeric_limits<double>::infinity();
  for (const int grain : grains.numbers())
    top_ = std::max(top_, grains.position(grain)[Dim - 1] + grains.radius(grain));

  const Sections sections(grains, radius, length, width);
  double height = 0;
  double seen = 0;
  int brinks = 0;
  for (int layer = 1; layer <= 2; ++layer) {
    std::vector<int> found;
    for (const double y : sections.across()) {
      const auto chain = sections.chain(y, layers_, layer);
      for (const auto& link : chain) found.push_back(link.grain);
      if (layer == 2) continue;
      // In three dimensions a grain's own section tells which side of a step it is on.
      const auto mark = [&](std::size_t i, Origin origin) {
        const auto grain = static_cast<std::size_t>(chain[i].grain);
        if (sections.distance_across(chain[i].index, y) <= 0.501 * sections.spacing() || Dim == 2)
          steps_[grain] = origin;
      };
      const std::size_t n = chain.size();
      for (const auto& link : chain) {
        height += static_cast<double>(link.columns) * link.height;
        seen += static_cast<double>(link.columns);
      }
      for (std::size_t i = 0; i + (sections.round_x() ? 0 : 1) < n; ++i) {
        const std::size_t next = (i + 1) % n;
        const double rise = chain[next].height - chain[i].height;
        if (rise <= -step_diameters * 2 * radius) {
          ++brinks;
          mark(i, Origin::brink);
          if (i > 0 || sections.round_x()) mark((i + n - 1) % n, Origin::brink);
        } else if (rise >= step_diameters * 2 * radius) {
          mark(next, Origin::anti_brink);
          if (next + 1 < n || sections.round_x()) mark((next + 1) % n, Origin::anti_brink);
        }
      }
    }
    for (const int grain : found) layers_[static_cast<std::size_t>(grain)] = layer;
  }
  mean_height_ = height / seen;
  roughness_ = brinks * 2 * radius / (length * static_cast<double>(sections.across().size()));
}

template BedSurface::BedSurface(const GrainDynamics<2>&, double, double, double);
template BedSurface::BedSurface(const GrainDynamics<3>&, double, double, double);

}  // namespace aeolian
