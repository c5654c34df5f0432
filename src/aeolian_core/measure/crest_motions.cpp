#include "aeolian_core/measure/crest_motions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "aeolian_core/measure/none.hpp"

namespace aeolian {
namespace {}  // namespace

CrestMotions::CrestMotions(std::vector<TrackedMap>& maps, double direction)
    : maps_(maps), direction_(direction), shared_(maps.size()), displacement_(maps.size()) {
  for (std::size_t m = 0; m < maps.size(); ++m) displacement_[m].resize(maps[m].found.crests.size());
}

void CrestMotions::add(const std::vector<CrestTrack>& tracks, const std::vector<const TrackRow*>& row) {
  for (const CrestTrack& track : tracks) {
    for (std::size_t i = 1; i < track.crests.size(); ++i) {
      if (track.crests[i - 1] < 0 || track.crests[i] < 0) continue;
      const std::size_t m = track.first + i;
      const TrackRow::Sample& then = row[m - 1]->samples[static_cast<std::size_t>(track.crests[i - 1])];
      const TrackRow::Sample& now = row[m]->samples[static_cast<std::size_t>(track.crests[i])];
      ++shared_[m][{then.crest, now.crest}];
      // Along the row the crest has moved farther than square to itself.
      const auto crest = static_cast<std::size_t>(now.crest);
      const double normal = maps_[m].found.relief.pattern.normal +
                            static_cast<double>(maps_[m].found.crests[crest].sections[now.section].turn);
      displacement_[m][crest].push_back((now.place - then.place) * std::cos(normal - direction_));
    }
  }
}

/// For each crest of the later (earlier) map the one of the other with which it shares most rows, -1 without.
std::vector<int> CrestMotions::best_of(const Shared& shared, std::size_t count, bool later) const {
  std::vector<int> best(count, -1);
  std::vector<int> most(count, 0);
  for (const auto& [pair, rows] : shared) {
    const auto at = static_cast<std::size_t>(later ? pair.second : pair.first);
    if (rows <= most[at]) continue;
    most[at] = rows;
    best[at] = later ? pair.first : pair.second;
  }
  return best;
}

void CrestMotions::finish() {
  for (std::size_t m = 0; m < maps_.size(); ++m) {
    TrackedMap& map = maps_[m];
    const std::vector<CrestLine>& crests = map.found.crests;
    const std::vector<int> before = best_of(shared_[m], crests.size(), true);
    const std::vector<int> after =
        m > 0 ? best_of(shared_[m], maps_[m - 1].found.crests.size(), false) : std::vector<int>{};
    double sum = 0;
    double squares = 0;
    double weight = 0;
    for (std::size_t c = 0; c < crests.size(); ++c) {
      CrestMotion motion{0, {none, none}, none};
      const bool same = before[c] >= 0 && after[static_cast<std::size_t>(before[c])] == static_cast<int>(c);
      motion.id = same ? maps_[m - 1].motions[static_cast<std::size_t>(before[c])].id : next_id_++;
      const std::vector<double>& ways = displacement_[m][c];
      if (!ways.empty()) {
        const double duration = map.time - maps_[m - 1].time;
        const auto rows = static_cast<double>(ways.size());
        double way = 0;
        double way_squares = 0;
        for (const double w : ways) {
          way += w / rows;
          way_squares += w * w / rows;
        }
        const double speed = way / duration;
        const double spread = std::sqrt(std::max(0.0, way_squares - way * way)) / duration;
        const double independent = std::max(1.0, crests[c].length / map.found.relief.pattern.wavelength);
        motion.speed = {speed, spread / std::sqrt(independent)};
        double turn = 0;
        for (const CrestSection& section : crests[c].sections)
          turn += static_cast<double>(section.turn) / static_cast<double>(crests[c].sections.size());
        const double heading = map.found.relief.pattern.normal + turn + (speed < 0 ? M_PI : 0);
        motion.direction = std::remainder(heading, 2 * M_PI);
        sum += rows * speed;
        squares += rows * speed * speed;
        weight += rows;
      }
      map.motions.push_back(motion);
    }
    map.celerity =
        weight > 0
            ? Figure{sum / weight, std::sqrt(std::max(0.0, squares / weight - sum * sum / weight / weight))}
            : Figure{none, none};
  }
}

}  // namespace aeolian
