#include "aeolian_twin/nodes/wind_reader.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <tf2_eigen/tf2_eigen.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/log_law.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

double roughness_of(const Parameters& parameters) {
  const double roughness = parameters.number("roughness");
  return roughness > 0 ? roughness : grain_roughness(parameters.number("grain_diameter"));
}

TerrainWindSettings settings_of(const Parameters& parameters) {
  TerrainWindSettings settings;
  settings.relief.roughness = roughness_of(parameters);
  settings.backend = backend_of(parameters.text("model"));
  return settings;
}

}  // namespace

WindReader::WindReader(const Parameters& parameters, const std::string& topic,
                       const tf2::BufferCore& transforms, Tell tell)
    : topic_(topic),
      transforms_(transforms),
      tell_(std::move(tell)),
      frame_(parameters.text("frame_id")),
      anemometer_height_(parameters.number("anemometer_height")),
      air_density_(parameters.number("air_density")),
      max_speed_(parameters.number("max_speed")),
      max_gap_(parameters.number("max_gap")),
      averaging_time_(parameters.number("averaging_time")),
      window_(std::max(averaging_time_, parameters.number("statistics_window"))),
      roughness_(roughness_of(parameters)),
      model_(settings_of(parameters)),
      ground_(settings_of(parameters).relief.shortest()) {}

void WindReader::take_map(const grid_map_msgs::GridMap& message) {
  ground_.take(to_height_map(message, {layer::elevation}));
}

std::optional<grid_map_msgs::GridMap> WindReader::take_wind(const geometry_msgs::TwistStamped& message) {
  const double now = clock_.seconds(message.header.stamp);
  notice_time(message.header.frame_id, now);
  try {
    const Anemometer& anemometer = take_reading(message, now);
    WindField wind = solve(now);
    const double height = height_over_ground(anemometer);
    tell_("wind", true,
          fmt::format("{:.2f} m/s at {:.2f} m over the ground gives a friction velocity of {:.3f} m/s{}",
                      anemometer.window.mean(averaging_time_).norm(), height, wind.friction_velocity,
                      wind.cells.names().empty() ? "" : ", by the " + wind.model + " wind over the map"));
    if (!wind.cells.names().empty()) wind.cells.add(layer::elevation, ground_.map()->layer(layer::elevation));
    stamp_ = message.header.stamp;
    time_ = now;
    field_ = std::move(wind);
  } catch (const Error& error) {
    tell_("wind", false, error.what());
    return std::nullopt;
  }
  const GridGeometry one_cell(-0.5, -0.5, 1, 1, 1);
  return to_message(*field_, ground_.extent().size() > 0 ? ground_.extent() : one_cell, header());
}

WindReader::Anemometer& WindReader::take_reading(const geometry_msgs::TwistStamped& message, double time) {
  Eigen::Vector3d velocity(message.twist.linear.x, message.twist.linear.y, 0);
  if (!velocity.allFinite() || velocity.norm() > max_speed_)
    throw Error(
        fmt::format("{}: velocity is ({}, {}) m/s, must be finite and at most {} m/s (~max_speed); skipped",
                    topic_, velocity.x(), velocity.y(), max_speed_));
  const std::string& frame = message.header.frame_id;
  Anemometer& anemometer = anemometers_.try_emplace(frame, frame, window_).first->second;
  anemometer.place.reset();
  if (const std::optional<Eigen::Isometry3d> mast = anemometer_pose(message.header)) {
    velocity = mast->linear() * velocity;
    anemometer.place = mast->translation();
  }
  anemometer.window.add(time, velocity.head<2>());
  return anemometer;
}

std::vector<WindReader::Anemometer*> WindReader::heard(double now) {
  std::vector<Anemometer*> result;
  for (auto at = anemometers_.begin(); at != anemometers_.end();) {
    Anemometer& anemometer = at->second;
    const double silent = std::abs(now - anemometer.window.last());
    anemometer.refused.clear();
    if (silent <= max_gap_)
      result.push_back(&anemometer);
    else
      anemometer.refused = fmt::format("{}: silent for {:.1f} s", anemometer.frame, silent);
    const bool is_gone = silent > std::max(window_, max_gap_);
    at = is_gone ? anemometers_.erase(at) : std::next(at);
  }
  return result;
}

WindField WindReader::solve(double now) {
  std::vector<Anemometer*> used = heard(now);
  WindField field;
  try {
    field = solve(used, now);
  } catch (const Error& error) {
    if (used.size() == 1) throw Error(fmt::format("{} ({}): {}", topic_, used[0]->frame, error.what()));
    keep_useful(used, now);
    field = solve(used, now);
  }
  if (used.size() > 1 && refuse_sheltered(used, field)) field = solve(used, now);
  const std::string reasons = refusals();
  tell_("anemometers", reasons.empty(),
        fmt::format("{} in use{}{}", used.size(), reasons.empty() ? "" : "; ", reasons));
  return field;
}

WindField WindReader::solve(const std::vector<Anemometer*>& used, double now) {
  std::vector<WindInput> inputs;
  for (const Anemometer* anemometer : used) inputs.push_back(input(*anemometer, now));
  return model_.solve(inputs, ground_.map());
}

/// One that tells nothing does not take the others with it.
void WindReader::keep_useful(std::vector<Anemometer*>& used, double now) {
  const auto is_useless = [&](Anemometer* anemometer) {
    try {
      solve({anemometer}, now);
    } catch (const Error& error) {
      anemometer->refused = anemometer->frame + ": " + error.what();
    }
    return !anemometer->refused.empty();
  };
  used.erase(std::remove_if(used.begin(), used.end(), is_useless), used.end());
  if (used.empty()) throw Error(topic_ + ": " + refusals());
}

/// An eddy blows backwards: taken by itself, it tells of surroundings in whose lee it does not lie.
bool WindReader::refuse_sheltered(std::vector<Anemometer*>& used, const WindField& field) {
  if (!field.cells.has("separated")) return false;
  const HeightMap::Layer& separated = field.cells.layer("separated");
  const auto is_sheltered = [&](Anemometer* anemometer) {
    const WindInput at = input(*anemometer, 0);
    if (!at.place) return false;
    const auto cell = field.cells.geometry().find(at.place->x, at.place->y);
    if (!cell || !(separated[field.cells.geometry().index(*cell)] > 0)) return false;
    anemometer->refused = anemometer->frame + ": the others' wind separates there, behind a lee";
    return true;
  };
  const std::size_t before = used.size();
  used.erase(std::remove_if(used.begin(), used.end(), is_sheltered), used.end());
  if (used.empty()) throw Error(topic_ + ": " + refusals());
  return used.size() < before;
}

std::string WindReader::refusals() const {
  std::string reasons;
  for (const auto& [frame, anemometer] : anemometers_)
    if (!anemometer.refused.empty()) reasons += (reasons.empty() ? "" : "; ") + anemometer.refused;
  return reasons;
}

WindInput WindReader::input(const Anemometer& anemometer, double now) const {
  const Eigen::Vector2d velocity = anemometer.window.mean(averaging_time_);
  WindInput result;
  result.speed = velocity.norm();
  result.direction = std::atan2(velocity.y(), velocity.x());
  result.height = height_over_ground(anemometer);
  result.air_density = air_density_;
  result.time = now;
  // Beside what is known of the ground it stands in the surroundings.
  if (anemometer.place && ground_.is_known(anemometer.place->x(), anemometer.place->y()))
    result.place = MapPoint{anemometer.place->x(), anemometer.place->y()};
  return result;
}

double WindReader::height_over_ground(const Anemometer& anemometer) const {
  if (!anemometer.place) return anemometer_height_;
  return anemometer.place->z() - ground_.at(anemometer.place->x(), anemometer.place->y());
}

/// Where the anemometer stands; nothing when tf does not know, then its parameters hold.
std::optional<Eigen::Isometry3d> WindReader::anemometer_pose(const std_msgs::Header& header) const {
  if (header.frame_id.empty() || header.frame_id == frame_) return std::nullopt;
  if (!transforms_.canTransform(frame_, header.frame_id, ros::Time(0))) return std::nullopt;
  return tf2::transformToEigen(transforms_.lookupTransform(frame_, header.frame_id, ros::Time(0)));
}

/// Each anemometer has a clock of its own; one that jumps back is a bag that begins anew, with all of them.
void WindReader::notice_time(const std::string& frame, double time) {
  const auto known = heard_.find(frame);
  const double step = known == heard_.end() ? 0 : time - known->second;
  if (step < 0) {
    tell_("clock", false, fmt::format("time jumped back by {:.1f} s (a bag that loops?)", -step));
    anemometers_.clear();
    heard_.clear();
  } else if (step > max_gap_) {
    tell_("clock", false,
          fmt::format("the wind record has a gap of {:.1f} s, more than ~max_gap = {} s", step, max_gap_));
  } else {
    tell_("clock", true, "no gaps");
  }
  heard_[frame] = time;
}

std_msgs::Header WindReader::header() const {
  std_msgs::Header header;
  header.frame_id = frame_;
  header.stamp = stamp_;
  return header;
}

aeolian_msgs::WindStatistics WindReader::statistics() const {
  aeolian_msgs::WindStatistics message = to_message(*field_, header());
  for (const auto& [frame, anemometer] : anemometers_) {
    aeolian_msgs::AnemometerStatistics one = to_message(anemometer.window.statistics());
    one.frame_id = frame;
    one.used = anemometer.refused.empty();
    one.refused = anemometer.refused;
    one.height = height_over_ground(anemometer);
    message.anemometers.push_back(std::move(one));
  }
  return message;
}

}  // namespace aeolian
