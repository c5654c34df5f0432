#include "aeolian_core/measure/ripple_tracking.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "aeolian_core/measure/crest_motions.hpp"
#include "aeolian_core/measure/defect_tracks.hpp"
#include "aeolian_core/measure/none.hpp"
#include "aeolian_core/measure/ripple_events.hpp"
#include "aeolian_core/measure/ripple_statistics.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/median.hpp"

namespace aeolian {
namespace {

constexpr double rows_per_wavelength = 8;

/// What is seen of a row whose places are `step` apart.
void see(TrackRow& row, const std::vector<double>& places, const std::vector<bool>& seen) {
  row.start = std::numeric_limits<double>::infinity();
  row.end = -row.start;
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!seen[i]) continue;
    row.start = std::min(row.start, places[i]);
    row.end = places[i];
    if (last && *last + 1 < i) row.holes.emplace_back(places[*last], places[i]);
    last = i;
  }
}

/// Height of one crest over that of another, both of one map.
double height_ratio(const TrackedMap& map, const TrackRow& row, const RowEvent::Pair& pair) {
  const auto height = [&](int number) {
    const TrackRow::Sample& sample = row.samples[static_cast<std::size_t>(number)];
    return static_cast<double>(
        map.found.crests[static_cast<std::size_t>(sample.crest)].sections[sample.section].height);
  };
  return height(pair.downwind) / height(pair.upwind);
}

double finite_median(std::vector<double> values) {
  values.erase(std::remove_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); }),
               values.end());
  return median(std::move(values));
}

}  // namespace

const char* name_of(RippleChange change) {
  switch (change) {
    case RippleChange::merger:
      return "merger";
    case RippleChange::split:
      return "split";
    case RippleChange::repulsion:
      return "repulsion";
    case RippleChange::birth:
      return "birth";
    case RippleChange::loss:
      return "loss";
    case RippleChange::defect:
      return "defect";
  }
  return "";
}

RippleTracker::RippleTracker(double direction, double grain_diameter)
    : direction_(direction), grain_diameter_(grain_diameter) {
  if (!std::isfinite(direction)) throw Error("ripple tracking: the direction is not finite");
  if (!(grain_diameter >= 0) || !std::isfinite(grain_diameter))
    throw Error("ripple tracking: the grain diameter is " + std::to_string(grain_diameter) +
                " m, must be zero or more");
}

const RippleField& RippleTracker::add(const GridGeometry& geometry, const HeightMap::Layer& elevation,
                                      double time) {
  if (!std::isfinite(time) || (!maps_.empty() && !(time > maps_.back().time)))
    throw Error("ripple tracking: map " + std::to_string(maps_.size() + 1) + " at " + std::to_string(time) +
                " s, must be later than the one before" +
                (maps_.empty() ? "" : " (" + std::to_string(maps_.back().time) + " s)"));
  if (!maps_.empty() && geometry != geometry_)
    throw Error("ripple tracking: map " + std::to_string(maps_.size() + 1) +
                " lies on another grid than the first; all must have the same");
  TrackedMap map;
  map.time = time;
  map.found = find_crests(geometry, elevation, direction_, grain_diameter_);
  map.field = ripple_field(map.found);
  geometry_ = geometry;
  const double wavelength = map.found.relief.pattern.wavelength;
  if (row_spacing_ == 0 && !map.found.crests.empty()) {
    row_spacing_ = std::max(geometry.cell(), wavelength / rows_per_wavelength);
    const double width = std::abs(std::sin(direction_)) * geometry.length_x() +
                         std::abs(std::cos(direction_)) * geometry.length_y();
    row_count_ = static_cast<std::size_t>(width / row_spacing_) + 1;
  }

  double shift = 0;
  if (!maps_.empty() && !maps_.back().found.crests.empty()) {
    const TrackedMap& before = maps_.back();
    const double duration = time - before.time;
    if (maps_.size() > 1) shift = shifts_.back() * duration / (before.time - maps_[maps_.size() - 2].time);
    const double range = std::abs(shift) + 0.5 * before.found.relief.pattern.wavelength;
    shift = pattern_displacement(geometry, last_, elevation, direction_, range).value_or(shift);
  }
  shifts_.push_back(shift);
  rows_.push_back(cut(map.found));
  map.found.relief.height = {};
  map.found.relief.clearance = {};
  last_ = elevation;
  maps_.push_back(std::move(map));
  return maps_.back().field;
}

Eigen::Vector2d RippleTracker::point(std::size_t row, double place) const {
  const Eigen::Vector2d middle(geometry_.origin_x() + 0.5 * geometry_.length_x(),
                               geometry_.origin_y() + 0.5 * geometry_.length_y());
  const Eigen::Vector2d along(std::cos(direction_), std::sin(direction_));
  const Eigen::Vector2d left(-along.y(), along.x());
  const double across = (static_cast<double>(row) - 0.5 * static_cast<double>(row_count_ - 1)) * row_spacing_;
  return middle + place * along + across * left;
}

std::vector<TrackRow> RippleTracker::cut(const RippleCrests& found) const {
  std::vector<TrackRow> rows(row_count_);
  if (found.crests.empty()) {
    for (TrackRow& row : rows) see(row, {}, {});
    return rows;
  }
  const Eigen::Vector2d first = point(0, 0);
  const Eigen::Vector2d along(std::cos(direction_), std::sin(direction_));
  const Eigen::Vector2d left(-along.y(), along.x());
  for (std::size_t c = 0; c < found.crests.size(); ++c) {
    const std::vector<Eigen::Vector2d>& points = found.crests[c].points;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double from = (points[i - 1] - first).dot(left) / row_spacing_;
      const double to = (points[i] - first).dot(left) / row_spacing_;
      if (!(to > from)) continue;  // nearly along the rows
      const auto last =
          static_cast<std::size_t>(std::clamp(std::ceil(to), 0.0, static_cast<double>(row_count_)));
      for (auto row = static_cast<std::size_t>(std::max(0.0, std::ceil(from))); row < last; ++row) {
        const double part = (static_cast<double>(row) - from) / (to - from);
        const double place = (points[i - 1] + part * (points[i] - points[i - 1]) - first).dot(along);
        rows[row].samples.push_back({place, static_cast<int>(c), part < 0.5 ? i - 1 : i});
      }
    }
  }
  const int reach = static_cast<int>(0.5 * (geometry_.length_x() + geometry_.length_y()) / row_spacing_);
  std::vector<double> places;
  places.reserve(static_cast<std::size_t>(2 * reach + 1));
  for (int i = -reach; i <= reach; ++i) places.push_back(i * row_spacing_);
  std::vector<bool> seen(places.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::sort(rows[r].samples.begin(), rows[r].samples.end(),
              [](const TrackRow::Sample& a, const TrackRow::Sample& b) { return a.place < b.place; });
    for (std::size_t i = 0; i < places.size(); ++i)
      seen[i] = found.relief.clearance_at(point(r, places[i])) > 0;
    see(rows[r], places, seen);
  }
  return rows;
}

std::vector<CrestFrame> RippleTracker::frames_of(std::size_t number) const {
  std::vector<CrestFrame> frames;
  for (std::size_t m = 0; m < maps_.size(); ++m) {
    CrestFrame frame;
    frame.time = maps_[m].time;
    frame.shift = shifts_[m];
    const RippleRelief& relief = maps_[m].found.relief;
    frame.wavelength = relief.pattern.wavelength / std::cos(relief.pattern.normal - direction_);
    frame.start = std::numeric_limits<double>::infinity();
    frame.end = -frame.start;
    if (number < rows_[m].size()) {
      const TrackRow& row = rows_[m][number];
      for (const TrackRow::Sample& sample : row.samples) frame.crests.push_back(sample.place);
      frame.start = row.start;
      frame.end = row.end;
      frame.holes = row.holes;
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

RippleHistory RippleTracker::history() const {
  RippleHistory history;
  history.maps = maps_;
  history.celerity = {none, none};
  std::vector<double> moved(maps_.size(), 0);
  std::vector<double> wavelength;
  for (std::size_t m = 0; m < maps_.size(); ++m) {
    if (m > 0) moved[m] = moved[m - 1] + shifts_[m];
    const RipplePattern& pattern = maps_[m].found.relief.pattern;
    wavelength.push_back(pattern.wavelength / std::cos(pattern.normal - direction_));
  }

  CrestMotions motions(history.maps, direction_);
  std::vector<RowEvent> events;
  for (std::size_t row = 0; row < row_count_; ++row) {
    const std::vector<CrestFrame> frames = frames_of(row);
    const std::vector<CrestTrack> tracks = follow_crests(frames);
    std::vector<const TrackRow*> seen;
    for (const auto& rows : rows_) seen.push_back(row < rows.size() ? &rows[row] : nullptr);
    motions.add(tracks, seen);
    for (const CrestTrack& track : tracks) {
      const auto note = [&](const std::optional<ProfileSeries::Event>& change, std::size_t frame) {
        if (!change) return;
        using Kind = ProfileSeries::Event::Kind;
        RowEvent event;
        event.kind = change->kind == Kind::merger  ? RippleChange::merger
                     : change->kind == Kind::split ? RippleChange::split
                     : change->kind == Kind::birth ? RippleChange::birth
                                                   : RippleChange::loss;
        event.row = static_cast<int>(row);
        event.frame = static_cast<int>(frame);
        event.time = change->time;
        event.place = change->position;
        // Beginnings are placed on the map before, endings on that after.
        event.moving = change->position - moved[track.first == frame ? frame - 1 : frame];
        events.push_back(event);
      };
      note(track.beginning, track.first);
      note(track.ending, track.last() + 1);
    }
    const std::vector<RowEvent> repulsions = find_repulsions(tracks, frames, moved, static_cast<int>(row));
    events.insert(events.end(), repulsions.begin(), repulsions.end());
  }
  motions.finish();

  for (const EventCluster& cluster : cluster_events(std::move(events), wavelength, row_spacing_)) {
    const RowEvent& middle = cluster.rows[cluster.rows.size() / 2];
    std::vector<double> before;
    std::vector<double> after;
    for (const RowEvent& row : cluster.rows) {
      if (row.before.upwind < 0) continue;
      const auto at = static_cast<std::size_t>(row.row);
      before.push_back(height_ratio(maps_[row.before.map], rows_[row.before.map][at], row.before));
      after.push_back(height_ratio(maps_[row.after.map], rows_[row.after.map][at], row.after));
    }
    history.events.push_back({cluster.kind, cluster.rows.front().time, cluster.rows.back().time, middle.time,
                              point(static_cast<std::size_t>(middle.row), middle.place), cluster.length,
                              finite_median(before), finite_median(after)});
  }
  history.defects = follow_defects(history.maps);
  for (const DefectTrack& track : history.defects) {
    const std::size_t last = track.first + track.places.size() - 1;
    if (std::abs(track.travel) < 0.5 * maps_[last].found.relief.pattern.wavelength) continue;
    const std::size_t half = track.places.size() / 2;
    history.events.push_back({RippleChange::defect, maps_[track.first].time, maps_[last].time,
                              maps_[track.first + half].time, track.places[half], std::abs(track.travel),
                              none, none});
  }
  std::stable_sort(history.events.begin(), history.events.end(),
                   [](const RippleEvent& a, const RippleEvent& b) { return a.time < b.time; });

  double sum = 0;
  double squares = 0;
  double duration = 0;
  for (std::size_t m = 1; m < maps_.size(); ++m) {
    const double value = history.maps[m].celerity.value;
    if (!std::isfinite(value)) continue;
    const double weight = maps_[m].time - maps_[m - 1].time;
    duration += weight;
    sum += weight * value;
    squares += weight * value * value;
  }
  if (duration > 0) {
    const double mean = sum / duration;
    history.celerity = {mean, std::sqrt(std::max(0.0, squares / duration - mean * mean))};
  }
  return history;
}

}  // namespace aeolian
