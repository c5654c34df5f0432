#pragma once

#include <deque>
#include <optional>
#include <vector>

namespace aeolian {

/// The wind at one time.
struct WindSample {
  double time = 0;               ///< [s]
  double friction_velocity = 0;  ///< [m/s]
  double direction = 0;          ///< where it blows to, counter-clockwise from east [rad]
  double air_density = 1.225;    ///< [kg/m^3]
};

/// A time over which the wind is taken as the mean of some samples.
struct WindSpell {
  double until = 0;                 ///< lead time at which it ends [s]
  std::vector<WindSample> samples;  ///< at least one
  std::vector<double> weights;      ///< the time for which each stands [s]
  double longest_gap = 0;           ///< between two that stand beside each other [s]
};

/// The wind so far and as it is given ahead.
class WindCourse {
 public:
  struct Settings {
    double window = 60;  ///< the wind of so long before a forecast goes on blowing [s]
    double max_gap = 5;  ///< no sample stands for longer [s]
  };

  explicit WindCourse(const Settings& settings) : settings_(settings) {}

  /// Takes a sample of what blew. One that is older than the last begins the course anew (a bag that loops).
  /// Throws Error for a sample that is not physical; it is then left out.
  void add(const WindSample& sample);
  /// Replaces what is known of the wind to come; times increase. Throws Error as add() does.
  void give_ahead(std::vector<WindSample> samples);

  /// The wind of a forecast from `time` on to a lead time of `horizon` [s]: spells in the order of their
  /// ends, the last at `horizon`. Where nothing is given ahead, the mean of the window before `time` goes on.
  /// Empty when no wind is known in the window and none is given ahead from `time` on.
  std::vector<WindSpell> spells(double time, double horizon) const;

 private:
  std::optional<WindSpell> before(double time) const;

  Settings settings_;
  std::deque<WindSample> past_;
  std::vector<WindSample> ahead_;
};

}  // namespace aeolian
