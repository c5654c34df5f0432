#include "aeolian_core/measure/ripple_events.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>

namespace aeolian {
namespace {

constexpr int memory = 3;  ///< maps over which a crest may be gone

/// Changes that may be one: what ends crests, what begins them, what leaves them.
int family(RippleChange kind) {
  switch (kind) {
    case RippleChange::merger:
    case RippleChange::loss:
      return 0;
    case RippleChange::split:
    case RippleChange::birth:
      return 1;
    default:
      return 2;
  }
}

/// Sets of numbers that are joined pair by pair.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::size_t of(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = of(a);
    b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

std::set<int> rows_of(const EventCluster& cluster) {
  std::set<int> rows;
  for (const RowEvent& event : cluster.rows) rows.insert(event.row);
  return rows;
}

double mean_moving(const EventCluster& cluster) {
  double sum = 0;
  for (const RowEvent& event : cluster.rows) sum += event.moving;
  return sum / static_cast<double>(cluster.rows.size());
}

EventCluster make_cluster(std::vector<RowEvent> rows, double row_spacing) {
  std::stable_sort(rows.begin(), rows.end(), [](const RowEvent& a, const RowEvent& b) {
    return a.time != b.time ? a.time < b.time : a.row < b.row;
  });
  std::map<RippleChange, int> votes;
  for (const RowEvent& event : rows) ++votes[event.kind];
  EventCluster cluster;
  cluster.kind = std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) {
                   return a.second < b.second;
                 })->first;
  cluster.rows = std::move(rows);
  cluster.length = row_spacing * static_cast<double>(rows_of(cluster).size());
  return cluster;
}

/// Whether a beginning takes back an ending.
bool takes_back(const EventCluster& end, const EventCluster& begin, double wavelength) {
  const int gap = begin.rows.front().frame - end.rows.back().frame;
  if (gap < 0 || gap > memory || std::abs(mean_moving(begin) - mean_moving(end)) > 0.5 * wavelength)
    return false;
  const std::set<int> a = rows_of(end);
  const std::set<int> b = rows_of(begin);
  const auto shared = std::count_if(a.begin(), a.end(), [&](int row) { return b.count(row) > 0; });
  return 2 * shared >= static_cast<std::ptrdiff_t>(std::min(a.size(), b.size()));
}

/// Crests that went and came back.
void settle_returns(std::vector<EventCluster>& clusters, const std::vector<double>& wavelength) {
  std::vector<bool> gone(clusters.size(), false);
  for (std::size_t a = 0; a < clusters.size(); ++a) {
    if (family(clusters[a].kind) != 0) continue;
    for (std::size_t b = 0; b < clusters.size(); ++b) {
      if (gone[b] || family(clusters[b].kind) != 1) continue;
      const auto frame = static_cast<std::size_t>(clusters[b].rows.front().frame);
      if (!takes_back(clusters[a], clusters[b], wavelength[frame])) continue;
      gone[b] = true;
      if (clusters[a].kind == RippleChange::merger && clusters[b].kind == RippleChange::split)
        clusters[a].kind = RippleChange::repulsion;
      else
        gone[a] = true;
      break;
    }
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < clusters.size(); ++i)
    if (!gone[i]) {
      if (kept != i) clusters[kept] = std::move(clusters[i]);
      ++kept;
    }
  clusters.resize(kept);
}

}  // namespace

std::vector<EventCluster> cluster_events(std::vector<RowEvent> events, const std::vector<double>& wavelength,
                                         double row_spacing) {
  std::stable_sort(events.begin(), events.end(),
                   [](const RowEvent& a, const RowEvent& b) { return a.row < b.row; });
  Groups groups(events.size());
  for (std::size_t i = 0; i < events.size(); ++i) {
    for (std::size_t j = i + 1; j < events.size() && events[j].row <= events[i].row + 2; ++j) {
      const RowEvent& a = events[i];
      const RowEvent& b = events[j];
      const double reach = 0.5 * wavelength[static_cast<std::size_t>(a.frame)];
      if (family(a.kind) == family(b.kind) && std::abs(a.frame - b.frame) <= 1 &&
          std::abs(a.moving - b.moving) <= reach)
        groups.join(i, j);
    }
  }
  std::map<std::size_t, std::vector<RowEvent>> members;
  for (std::size_t i = 0; i < events.size(); ++i) members[groups.of(i)].push_back(events[i]);
  std::vector<EventCluster> clusters;
  for (auto& [first, rows] : members) {
    EventCluster cluster = make_cluster(std::move(rows), row_spacing);
    const auto frame = static_cast<std::size_t>(cluster.rows.front().frame);
    if (cluster.length >= 0.5 * wavelength[frame]) clusters.push_back(std::move(cluster));
  }
  settle_returns(clusters, wavelength);
  return clusters;
}

std::vector<RowEvent> find_repulsions(const std::vector<CrestTrack>& tracks,
                                      const std::vector<CrestFrame>& frames, const std::vector<double>& moved,
                                      int row) {
  constexpr double nearest = 0.65;  // wavelengths
  constexpr double parting = 0.25;
  // The tracks of neighbouring crests, upwind first, and the maps in which they are neighbours.
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> neighbours;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    std::vector<std::optional<std::size_t>> owner(frames[f].crests.size());
    for (std::size_t t = 0; t < tracks.size(); ++t) {
      if (f < tracks[t].first || f > tracks[t].last()) continue;
      const int crest = tracks[t].crests[f - tracks[t].first];
      if (crest >= 0) owner[static_cast<std::size_t>(crest)] = t;
    }
    for (std::size_t c = 0; c + 1 < owner.size(); ++c)
      if (owner[c] && owner[c + 1]) neighbours[{*owner[c], *owner[c + 1]}].push_back(f);
  }

  std::vector<RowEvent> events;
  for (const auto& meeting : neighbours) {
    const auto& pair = meeting.first;
    const std::vector<std::size_t>& maps = meeting.second;
    const auto crest_at = [&](std::size_t track, std::size_t f) {
      return frames[f].crests[static_cast<std::size_t>(tracks[track].crests[f - tracks[track].first])];
    };
    std::vector<double> gap;
    for (const std::size_t f : maps) gap.push_back(crest_at(pair.second, f) - crest_at(pair.first, f));
    const auto closest = static_cast<std::size_t>(std::min_element(gap.begin(), gap.end()) - gap.begin());
    const std::size_t f = maps[closest];
    const double wavelength = frames[f].wavelength;
    const auto middle = gap.begin() + static_cast<std::ptrdiff_t>(closest);
    const auto before = std::max_element(gap.begin(), middle + 1);
    const auto after = std::max_element(middle, gap.end());
    if (gap[closest] > nearest * wavelength || *before < gap[closest] + parting * wavelength ||
        *after < gap[closest] + parting * wavelength)
      continue;
    RowEvent event;
    event.kind = RippleChange::repulsion;
    event.row = row;
    event.frame = static_cast<int>(f);
    event.time = frames[f].time;
    event.place = 0.5 * (crest_at(pair.first, f) + crest_at(pair.second, f));
    event.moving = event.place - moved[f];
    const auto numbers = [&](std::vector<double>::const_iterator at) {
      const std::size_t map = maps[static_cast<std::size_t>(at - gap.cbegin())];
      return RowEvent::Pair{map, tracks[pair.first].crests[map - tracks[pair.first].first],
                            tracks[pair.second].crests[map - tracks[pair.second].first]};
    };
    event.before = numbers(before);
    event.after = numbers(after);
    events.push_back(event);
  }
  return events;
}

}  // namespace aeolian
