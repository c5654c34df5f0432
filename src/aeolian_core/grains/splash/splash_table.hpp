#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "aeolian_core/grains/grain.hpp"
#include "aeolian_core/grains/splash/splash.hpp"

namespace aeolian {

/// What many impacts of one kind did.
struct SplashCase {
  Impact impact;
  std::vector<SplashEvent> events;
};

/// Where a table comes from; stands in the head of its file.
struct SplashTableSource {
  std::string command;   ///< the exact one, in one line
  std::string material;  ///< in one line
  /// Share of the ejecta that was kept, drawn at random: two dimensions count too many, so a table for three
  /// is thinned to the experiment with coarse sand (splash specification, T14).
  double ejecta_kept = 1;
};

/// Splash events on a grid of impact speed over sqrt(g d), angle to the bed, size ratio and roughness, kept
/// one by one: an event of the table is what one impact did, not a mean (splash specification, sec. 6.5).
///
/// Between nodes one of those about is chosen at random with the weights of linear interpolation, and one of
/// its events: means are interpolated and no two velocities are ever mixed. Beyond the grid the nearest nodes
/// serve. Velocities of rebounds are kept over the speed of the impact, those of ejecta over sqrt(g d), and
/// both relative to the bed: so rebounds scale with the impact and ejecta do not (T8). Where an impact is
/// slower or faster than all of the table, the number of ejecta follows the table's own straight line through
/// the mean numbers, N ~ v - v0, zero below v0 (T8).
class SplashTable {
 public:
  /// `diameter` of the bed's grains in these events [m]. Cases at the same node add up. Velocities are kept
  /// to four decimals, towards zero. Throws Error naming the node that has no events, and for impacts that
  /// check() refuses, a rebound faster than its impact, a share that is not above 0, to 1, or a head of
  /// several lines.
  static SplashTable build(const std::vector<SplashCase>& cases, double diameter,
                           const SplashTableSource& source, std::uint64_t seed = 1);

  /// Throws Error naming file, line and value for anything that write() would not have written.
  static SplashTable read(const std::string& path);
  void write(const std::string& path) const;  ///< atomically; reads back to the same table

  const SplashTableSource& source() const { return source_; }
  enum Axis { speed, angle, size_ratio, roughness };
  /// Values of the grid, ascending: speed over sqrt(g d), angle [rad], size ratio, brinks per diameter.
  const std::vector<double>& axis(Axis which) const { return axes_[which]; }
  std::size_t events() const { return events_.size(); }
  std::size_t ejecta() const { return ejecta_.size(); }
  double threshold() const { return threshold_; }  ///< v0 over sqrt(g d)

  /// Mean number of ejecta at this place of the grid.
  double mean_number(const std::array<double, 4>& place) const;

  struct Ejectum {
    float along, across, away;  ///< on the bed, over sqrt(g d)
    float size_ratio;
    float distance;  ///< along the bed, in diameters of the bed's grains
    Origin origin;
  };
  struct Event {
    bool captured;
    double along, across, away;  ///< of the rebound, over the speed of the impact
    const Ejectum* first;
    const Ejectum* last;  ///< one beyond
  };
  /// One event of a node near this place of the grid.
  Event draw(const std::array<double, 4>& place, RandomStream& random) const;
  /// What the number of ejecta is multiplied with at this speed: 1 within the grid.
  double beyond(double speed) const;

 private:
  struct StoredEvent {
    bool captured;
    double along, across, away;
    std::size_t first;
  };
  struct Node {
    std::size_t first = 0, count = 0;
    double mean_number = 0;
  };
  struct Gathered;

  SplashTable() = default;
  /// Puts what was gathered onto the grid. `where` begins the message of errors.
  static SplashTable of(const std::vector<Gathered>& nodes, const SplashTableSource& source,
                        const std::string& where);
  void find_threshold();
  std::size_t node_index(const std::array<std::size_t, 4>& indices) const;

  SplashTableSource source_;
  std::array<std::vector<double>, 4> axes_;
  std::vector<Node> nodes_;
  std::vector<StoredEvent> events_;
  std::vector<Ejectum> ejecta_;
  double threshold_ = 0;
};

/// The splash of a table for a bed of this grain.
///
/// Ejecta that would take an event beyond its impact, as they may from a node of faster impacts, are drawn
/// again and then left out, as in ComposedSplash.
class TabulatedSplash : public Splash {
 public:
  TabulatedSplash(std::shared_ptr<const SplashTable> table, const Grain& grain);
  double mean_ejecta(const Impact& impact) const override;

 private:
  void draw(const Impact& impact, RandomStream& random, SplashEvent& event) const override;

  std::shared_ptr<const SplashTable> table_;
  double diameter_;
  double unit_;  ///< sqrt(g d) [m/s]
};

}  // namespace aeolian
