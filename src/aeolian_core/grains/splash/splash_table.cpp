#include "aeolian_core/grains/splash/splash_table.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/grains/splash/splash_table_nodes.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// Values of an axis nearer than this, in parts, are the same.
constexpr double same = 1e-6;

bool equal(double a, double b) { return std::abs(a - b) <= same * std::max(1.0, std::abs(b)); }

std::size_t index_of(const std::vector<double>& axis, double value) {
  for (std::size_t i = 0; i < axis.size(); ++i)
    if (equal(axis[i], value)) return i;
  return axis.size();
}

std::string told(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string told(const std::array<double, 4>& place) {
  return "speed " + told(place[SplashTable::speed]) + " sqrt(g d), angle " +
         told(place[SplashTable::angle] * 180 / M_PI) + " degrees, size ratio " +
         told(place[SplashTable::size_ratio]) + ", roughness " + told(place[SplashTable::roughness]);
}

/// The two values about one and the weight of the upper.
struct Interval {
  std::size_t low;
  double share;
};

Interval interval(const std::vector<double>& axis, double value) {
  if (axis.size() == 1 || value <= axis.front()) return {0, 0};
  if (value >= axis.back()) return {axis.size() - 1, 0};
  std::size_t i = 0;
  while (axis[i + 1] <= value) ++i;
  return {i, (value - axis[i]) / (axis[i + 1] - axis[i])};
}

}  // namespace

SplashTable SplashTable::of(const std::vector<Gathered>& nodes, const SplashTableSource& source,
                            const std::string& where) {
  SplashTable table;
  table.source_ = source;
  for (std::size_t k = 0; k < 4; ++k) {
    for (const Gathered& node : nodes)
      if (index_of(table.axes_[k], node.place[k]) == table.axes_[k].size())
        table.axes_[k].push_back(node.place[k]);
    std::sort(table.axes_[k].begin(), table.axes_[k].end());
  }
  std::size_t count = 1;
  for (const auto& axis : table.axes_) count *= axis.size();
  if (count == 0) throw Error(where + ": there are no nodes, must be at least one");
  std::vector<std::vector<const Gathered*>> at(count);
  for (const Gathered& node : nodes) {
    std::array<std::size_t, 4> indices;
    for (std::size_t k = 0; k < 4; ++k) indices[k] = index_of(table.axes_[k], node.place[k]);
    at[table.node_index(indices)].push_back(&node);
  }
  for (std::size_t i = 0; i < count; ++i) {
    Node node;
    node.first = table.events_.size();
    const std::size_t ejecta_before = table.ejecta_.size();
    for (const Gathered* part : at[i]) {
      for (StoredEvent event : part->events) {
        event.first += table.ejecta_.size();
        table.events_.push_back(event);
      }
      table.ejecta_.insert(table.ejecta_.end(), part->ejecta.begin(), part->ejecta.end());
    }
    node.count = table.events_.size() - node.first;
    if (node.count == 0) {
      std::array<double, 4> place;
      std::size_t rest = i;
      for (std::size_t k = 4; k-- > 0; rest /= table.axes_[k].size())
        place[k] = table.axes_[k][rest % table.axes_[k].size()];
      throw Error(where + ": there are no events at " + told(place) +
                  ", must be some at every node of the grid");
    }
    node.mean_number =
        static_cast<double>(table.ejecta_.size() - ejecta_before) / static_cast<double>(node.count);
    table.nodes_.push_back(node);
  }
  table.find_threshold();
  return table;
}

std::size_t SplashTable::node_index(const std::array<std::size_t, 4>& indices) const {
  std::size_t index = 0;
  for (std::size_t k = 0; k < 4; ++k) index = index * axes_[k].size() + indices[k];
  return index;
}

// Least squares of the mean numbers of all nodes against speed, which is the first axis.
void SplashTable::find_threshold() {
  const std::size_t per_speed = nodes_.size() / axes_[speed].size();
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const double v = axes_[speed][i / per_speed];
    n += 1;
    x += v;
    y += nodes_[i].mean_number;
    xx += v * v;
    xy += v * nodes_[i].mean_number;
  }
  const double slope = axes_[speed].size() > 1 ? (n * xy - x * y) / (n * xx - x * x) : 0;
  threshold_ = slope > 0 ? std::max(0.0, x / n - y / n / slope) : 0;
  if (threshold_ >= axes_[speed].front()) threshold_ = 0;
}

double SplashTable::beyond(double v) const {
  const double nearest = std::clamp(v, axes_[speed].front(), axes_[speed].back());
  return v == nearest ? 1 : std::max(0.0, (v - threshold_) / (nearest - threshold_));
}

double SplashTable::mean_number(const std::array<double, 4>& place) const {
  std::array<Interval, 4> intervals;
  for (std::size_t k = 0; k < 4; ++k) intervals[k] = interval(axes_[k], place[k]);
  double sum = 0;
  for (unsigned corner = 0; corner < 16; ++corner) {
    double weight = 1;
    std::array<std::size_t, 4> indices;
    for (std::size_t k = 0; k < 4; ++k) {
      const bool upper = (corner >> k & 1U) != 0;
      weight *= upper ? intervals[k].share : 1 - intervals[k].share;
      indices[k] = intervals[k].low + (upper ? 1 : 0);
    }
    if (weight > 0) sum += weight * nodes_[node_index(indices)].mean_number;
  }
  return beyond(place[speed]) * sum;
}

SplashTable::Event SplashTable::draw(const std::array<double, 4>& place, RandomStream& random) const {
  std::size_t index = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Interval between = interval(axes_[k], place[k]);
    const bool upper = between.share > 0 && random.uniform() < between.share;
    index = index * axes_[k].size() + between.low + (upper ? 1 : 0);
  }
  const Node& node = nodes_[index];
  const std::size_t which =
      node.first + static_cast<std::size_t>(random.uniform() * static_cast<double>(node.count));
  const StoredEvent& event = events_[which];
  const std::size_t end = which + 1 < events_.size() ? events_[which + 1].first : ejecta_.size();
  return {event.captured,      event.along, event.across, event.away, ejecta_.data() + event.first,
          ejecta_.data() + end};
}

}  // namespace aeolian
