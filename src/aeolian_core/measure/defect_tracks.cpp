#include "aeolian_core/measure/defect_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace aeolian {
namespace {

using Defects = std::vector<RippleDefect>;

std::optional<std::size_t> nearest(const Defects& defects, const RippleDefect& to,
                                   const Eigen::Vector2d& shift, double within) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < defects.size(); ++i) {
    const double distance = (defects[i].place - to.place - shift).norm();
    if (defects[i].opens_left != to.opens_left || distance >= within) continue;
    within = distance;
    best = i;
  }
  return best;
}

}  // namespace

std::vector<DefectTrack> follow_defects(const std::vector<TrackedMap>& maps) {
  std::vector<DefectTrack> tracks;
  std::vector<std::size_t> owner;  // of the defects of the map before
  for (std::size_t m = 0; m < maps.size(); ++m) {
    const Defects& now = maps[m].found.defects;
    std::vector<std::size_t> owner_now(now.size());
    for (std::size_t i = 0; i < now.size(); ++i) {
      std::optional<std::size_t> before;
      Eigen::Vector2d shift = Eigen::Vector2d::Zero();
      if (m > 0 && !maps[m - 1].found.defects.empty()) {
        const RippleRelief& relief = maps[m].found.relief;
        if (std::isfinite(maps[m].celerity.value))
          shift = maps[m].celerity.value * (maps[m].time - maps[m - 1].time) * relief.along;
        const double within = 0.75 * relief.pattern.wavelength;
        const Defects& then = maps[m - 1].found.defects;
        before = nearest(then, now[i], -shift, within);
        if (before && nearest(now, then[*before], shift, within) != i) before.reset();
      }
      if (before) {
        DefectTrack& track = tracks[owner[*before]];
        track.travel += (now[i].place - track.places.back() - shift).dot(maps[m].found.relief.left);
        track.places.push_back(now[i].place);
        owner_now[i] = owner[*before];
      } else {
        owner_now[i] = tracks.size();
        tracks.push_back({m, {now[i].place}, 0});
      }
    }
    owner = std::move(owner_now);
  }
  tracks.erase(std::remove_if(tracks.begin(), tracks.end(),
                              [](const DefectTrack& track) { return track.places.size() < 2; }),
               tracks.end());
  return tracks;
}

}  // namespace aeolian
