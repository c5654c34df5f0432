#pragma once

#include <array>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "aeolian_core/measure/ripple_tracking.hpp"
#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"

namespace aeolian {

/// Where crests cross the line along the wind through the middle of the maps, over time.
class TrackPicture {
 public:
  TrackPicture(const GridGeometry& geometry, double direction)
      : middle_(geometry.origin_x() + 0.5 * geometry.length_x(),
                geometry.origin_y() + 0.5 * geometry.length_y()),
        along_(std::cos(direction), std::sin(direction)),
        left_(-along_.y(), along_.x()) {}

  void write(const RippleHistory& history, const std::string& path) const {
    struct Mark {
      RippleChange kind;
      const char* style;
    };
    // Triangles that point on (two become one) and back (one becomes two), and what comes and goes.
    const std::array<Mark, 5> marks{{{RippleChange::merger, "pt 9 ps 1.2 lc rgb '#c0392b'"},
                                     {RippleChange::split, "pt 11 ps 1.2 lc rgb '#2471a3'"},
                                     {RippleChange::repulsion, "pt 13 ps 1.2 lc rgb '#d68910'"},
                                     {RippleChange::birth, "pt 6 ps 1 lw 2 lc rgb '#1e8449'"},
                                     {RippleChange::loss, "pt 2 ps 1 lw 2 lc rgb '#444444'"}}};
    std::ostringstream script;
    script << plot_style << "set datafile missing 'NaN'\n";
    write_tracks(script, history);
    std::string plot =
        "plot $tracks using 1:2 with linespoints pt 7 ps 0.25 lw 1.3 lc rgb '#34699a' title 'crests'";
    for (const Mark& mark : marks) {
      script << '$' << name_of(mark.kind) << " << EOD\n";
      bool any = false;
      for (const RippleEvent& e : history.events) {
        const Eigen::Vector2d from = e.place - middle_;
        if (e.kind != mark.kind || std::abs(from.dot(left_)) > e.length) continue;
        script << 1e2 * from.dot(along_) << ' ' << e.time / 60 << '\n';
        any = true;
      }
      script << "EOD\n";
      if (any)
        plot += fmt::format(", ${0} using 1:2 with points {1} title '{0}'", name_of(mark.kind), mark.style);
    }
    script << "set tmargin at screen 0.88\nset key at screen 0.98, screen 0.97 top right horizontal samplen "
              "1.5\n"
              "set xlabel 'downwind from the middle of the map [cm]'\nset ylabel 'time [min]'\nset autoscale "
              "xfix\n"
           << plot << '\n';
    plot_svg(script.str(), 900, 700, path);
  }

 private:
  std::optional<double> crossing(const CrestLine& crest) const {
    for (std::size_t i = 1; i < crest.points.size(); ++i) {
      const double from = (crest.points[i - 1] - middle_).dot(left_);
      const double to = (crest.points[i] - middle_).dot(left_);
      if ((from <= 0) == (to <= 0)) continue;
      const double part = from / (from - to);
      return (crest.points[i - 1] + part * (crest.points[i] - crest.points[i - 1]) - middle_).dot(along_);
    }
    return std::nullopt;
  }

  void write_tracks(std::ostream& out, const RippleHistory& history) const {
    struct Point {
      std::size_t map;
      double place;
    };
    std::map<int, std::vector<Point>> tracks;
    for (std::size_t m = 0; m < history.maps.size(); ++m)
      for (std::size_t c = 0; c < history.maps[m].motions.size(); ++c)
        if (const auto place = crossing(history.maps[m].found.crests[c]))
          tracks[history.maps[m].motions[c].id].push_back({m, *place});
    out << "$tracks << EOD\n";
    for (const auto& [id, points] : tracks) {
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (i > 0 && points[i].map != points[i - 1].map + 1) out << '\n';
        out << 1e2 * points[i].place << ' ' << history.maps[points[i].map].time / 60 << '\n';
      }
      out << '\n';
    }
    out << "EOD\n";
  }

  Eigen::Vector2d middle_;
  Eigen::Vector2d along_;
  Eigen::Vector2d left_;
};

}  // namespace aeolian
