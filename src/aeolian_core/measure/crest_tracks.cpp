#include "aeolian_core/measure/crest_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace aeolian {
namespace {

using Event = ProfileSeries::Event;

/// A crest that is followed.
struct Track {
  CrestTrack seen;
  double first_position;  ///< [m]
  double last_position;   ///< where it was seen last [m]
};

class CrestFollower {
 public:
  explicit CrestFollower(const std::vector<CrestFrame>& frames) : frames_(frames) {}

  std::vector<CrestTrack> tracks() {
    for (std::size_t frame = 0; frame < frames_.size(); ++frame) follow(frame);
    std::vector<CrestTrack> result;
    for (Track& track : tracks_) {
      const bool glimpse =
          track.seen.crests.size() == 1 && track.seen.first > 0 && track.seen.last() + 1 < frames_.size();
      if (glimpse) continue;
      track.seen.beginning = beginning(track);
      track.seen.ending = ending(track);
      result.push_back(std::move(track.seen));
    }
    return result;
  }

 private:
  /// Continues tracks with crests of a frame: each crest goes to the nearest track whose nearest it is.
  void follow(std::size_t frame) {
    const CrestFrame& now = frames_[frame];
    std::vector<std::size_t> live;
    for (std::size_t t = 0; t < tracks_.size(); ++t) {
      // A crest missed once may come back.
      if (tracks_[t].seen.last() + 2 < frame) continue;
      where_[t] += now.shift;
      live.push_back(t);
    }
    std::vector<double> expected;
    expected.reserve(live.size());
    for (const std::size_t t : live) expected.push_back(where_[t]);
    for (std::size_t c = 0; c < now.crests.size(); ++c) {
      const double at = now.crests[c];
      const auto nearest = nearest_of(expected, at);
      const bool mutual = nearest && nearest_of(now.crests, expected[*nearest]) == c;
      if (mutual && std::abs(expected[*nearest] - at) < 0.5 * now.wavelength) {
        const std::size_t t = live[*nearest];
        std::vector<int>& crests = tracks_[t].seen.crests;
        crests.resize(frame - tracks_[t].seen.first, -1);
        crests.push_back(static_cast<int>(c));
        tracks_[t].last_position = where_[t] = at;
      } else {
        tracks_.push_back({{frame, {static_cast<int>(c)}, {}, {}}, at, at});
        where_.push_back(at);
      }
    }
  }

  static std::optional<std::size_t> nearest_of(const std::vector<double>& positions, double at) {
    std::optional<std::size_t> best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (std::abs(positions[i] - at) >= least) continue;
      least = std::abs(positions[i] - at);
      best = i;
    }
    return best;
  }

  /// The crest nearest to a place in a frame, within half a wavelength.
  std::optional<double> neighbour(const CrestFrame& frame, double at) const {
    const auto nearest = nearest_of(frame.crests, at);
    if (!nearest || std::abs(frame.crests[*nearest] - at) > 0.5 * frame.wavelength) return std::nullopt;
    return frame.crests[*nearest];
  }

  /// Why a crest is seen in frame `present` but not in `absent` next to it, where it would be at `at`.
  std::optional<Event> change(std::size_t present, std::size_t absent, double at, Event::Kind joined,
                              Event::Kind alone) const {
    const CrestFrame& frame = frames_[absent];
    const double time = 0.5 * (frames_[present].time + frame.time);
    if (at < frame.start || at > frame.end) return std::nullopt;
    if (const auto other = neighbour(frame, at)) return Event{joined, time, *other};
    const double margin = 0.5 * frame.wavelength;
    if (at < frame.start + margin || at > frame.end - margin) return std::nullopt;
    for (const auto& [from, to] : frame.holes)
      if (at > from - margin && at < to + margin) return std::nullopt;
    return Event{alone, time, at};
  }

  std::optional<Event> beginning(const Track& track) const {
    const std::size_t first = track.seen.first;
    if (first == 0) return std::nullopt;
    return change(first, first - 1, track.first_position - frames_[first].shift, Event::Kind::split,
                  Event::Kind::birth);
  }

  std::optional<Event> ending(const Track& track) const {
    const std::size_t last = track.seen.last();
    if (last + 1 == frames_.size()) return std::nullopt;
    return change(last, last + 1, track.last_position + frames_[last + 1].shift, Event::Kind::merger,
                  Event::Kind::loss);
  }

  const std::vector<CrestFrame>& frames_;
  std::vector<Track> tracks_;
  std::vector<double> where_;  ///< where each track is expected in the present frame [m]
};

}  // namespace

std::vector<CrestTrack> follow_crests(const std::vector<CrestFrame>& frames) {
  return CrestFollower(frames).tracks();
}

std::vector<ProfileSeries::Event> crest_events(const std::vector<CrestFrame>& frames) {
  std::vector<Event> events;
  for (const CrestTrack& track : follow_crests(frames)) {
    if (track.beginning) events.push_back(*track.beginning);
    if (track.ending) events.push_back(*track.ending);
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.time < b.time; });
  return events;
}

}  // namespace aeolian
