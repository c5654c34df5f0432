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
  bool ahead = false;               ///< as given ahead; else the wind so far, which goes on
};

/// The wind so far and as it is given ahead.
///
///     WindCourse wind({});
///     wind.add({10.0, 0.4, 0.1});
///     for (const WindSpell& spell : wind.spells(10.0, 300)) ...
class WindCourse {
 public:
  struct Settings {
    double window = 60;                ///< the wind of so long before a forecast goes on blowing [s]
    double max_gap = 5;                ///< no sample stands for longer [s]
    double max_friction_velocity = 3;  ///< what is above is a spike, not a wind [m/s]
    double spell = 30;                 ///< wind given ahead is averaged over at most so long [s]
  };

  /// Throws Error naming a setting that is not positive.
  explicit WindCourse(const Settings& settings);

  /// Takes a sample of what blew. One that is older than the last begins the course anew (a bag that loops).
  /// Throws Error for a sample that is not physical; it is then left out.
  void add(const WindSample& sample);
  /// Replaces what is known of the wind to come; times increase. A sample holds until the next one, the last
  /// for as long as the one before it, a single one for a window. Throws Error as add() does; what was known
  /// then stays.
  void give_ahead(std::vector<WindSample> samples);

  /// The wind of a forecast from `time` on to a lead time of `horizon` [s]: spells in the order of their
  /// ends, the last at `horizon`. Where nothing is given ahead, the mean of the window before `time` goes on;
  /// without that, the nearest spell that is given ahead. Empty when no wind is known in the window and none
  /// is given ahead for any time of the forecast.
  std::vector<WindSpell> spells(double time, double horizon) const;

  /// The time up to which wind has been given ahead [s]; nothing when none has.
  std::optional<double> ahead_until() const;

 private:
  void check(const WindSample& sample) const;
  std::optional<WindSpell> before(double time) const;
  double end_of_ahead(std::size_t sample) const;
  std::vector<WindSpell> given(double time, double horizon) const;

  Settings settings_;
  std::deque<WindSample> past_;
  std::vector<WindSample> ahead_;
};

/// From one time to another [s], to the microsecond: seconds since the epoch leave a quarter of one.
double seconds_between(double from, double to);

}  // namespace aeolian
