#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "aeolian_core/saltation/flying_grains.hpp"
#include "aeolian_core/saltation/mixing.hpp"
#include "aeolian_core/saltation/steady_state.hpp"

namespace aeolian {

/// What the way to a state has told about its neighbours.
struct Past {
  struct Begin {
    double free, surface;  ///< friction velocities [m/s]
    std::vector<double> spectrum, share;
  };
  AndersonMixing mixing;
  std::optional<Begin> begin;  ///< the neighbour that the way began at
};

/// A spectrum of launches and a wind on their way to the steady state.
class Approach {
 public:
  Approach(const SaltatingBed& bed, const SplashKernel& splash, const FlyingGrains& grains,
           double flight_tolerance);

  /// The winds from now on: free, and at the surface, not above it [m/s].
  void set_winds(double free, double surface);
  /// Begins at another state, moved on towards this free wind [m/s] as it was on its own way from a
  /// neighbour, with what is known of how spectrum and grains answer to changes.
  void begin_at(const SteadyState& other, double free);

  /// Flies the spectrum in the wind with the grains in it and lets it land.
  void step();
  /// Goes on with the spectrum and grains that the last step has made.
  void accept();
  /// The same, mixed with the past, and with the surface wind that may bring the replacement to one; it stays
  /// below `most`. After a longer spectrum the step is only taken anew.
  void mix(double most);

  /// Where the last step's fast end cuts off grains: a longer spectrum. False where it cannot be longer.
  bool extend_if_cut_off();
  /// Whether that has made it longer since the last step, whose figures then do not count.
  bool was_extended() const { return extended_; }
  /// Whether a step changes nothing more than this, relative.
  bool settled(double tolerance) const;
  /// The same for spectrum and wind alone, whatever the number of grains.
  bool same_spectrum(double tolerance) const;
  /// Mass flux over the stress that it takes from the wind, of the last step [s].
  double flux_over_stress() const;

  double surface() const { return surface_; }
  double replacement() const { return replacement_; }
  double spectrum_change() const { return spectrum_change_; }
  int steps() const { return steps_; }

  /// The last step as a state: as many grains as bring the wind at the surface to what it is.
  SteadyState state() const;

 private:
  /// Goes as far again as from `before` to where it began, and as much further or less far as the wind asks
  /// for, whose surface was told to slacken by `usual` of what the free wind gains.
  void go_on_from(const Past::Begin& before, double usual);

  const SaltatingBed& bed_;
  const FlyingGrains& grains_;
  double flight_tolerance_;
  std::unique_ptr<SplashKernel> splash_;
  AndersonMixing mixing_;
  std::optional<Past::Begin> begin_;
  std::vector<double> spectrum_, share_;            ///< that were flown
  std::vector<double> next_spectrum_, next_share_;  ///< that came of it
  std::vector<double> stress_;
  WindProfile wind_, next_wind_;
  Launches launches_;
  Landings landings_;
  double free_ = 0, surface_ = 0;
  double replacement_ = 0, spectrum_change_ = 0, wind_change_ = 0;
  int steps_ = 0;
  bool extended_ = false;
};

}  // namespace aeolian
