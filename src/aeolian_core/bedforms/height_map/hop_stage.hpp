#pragma once

#include <array>

#include "aeolian_core/bedforms/height_map/impact_angles.hpp"
#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {

/// How impacts and hops act from station to station along the wind.
struct HopLaw {
  /// `step` is the distance of stations along the wind, `hop` the mean reptation length [m]; `shortening` as
  /// in RippleParameters; `blur` is what the blend of rows takes from a wave along the wind, relative to the
  /// square of its phase per station.
  HopLaw(double step, const ImpactAngles& angles, double hop, double shortening, double blur);

  int angles;  ///< of impact
  std::array<double, ImpactAngles::most>
      drop;  ///< height lost by a falling grain from station to station [m]
  std::array<double, ImpactAngles::most> exposed_per_height;  ///< share of the impacts per drop [1/m]
  double carried;     ///< share of the reptation flux that passes a station
  double launched;    ///< share of a cell's ejected grains that leave the cell
  double flat_flux;   ///< flux on a flat bed, in flat-bed erosions of one cell
  double shortening;  ///< shift of flux per metre of rise [1/m]
  /// Weights of the flux upwind, here and downwind, and of the heights before and behind a face, that cancel
  /// the error of second order of cells of this size.
  double flux_upwind, flux_here, flux_downwind;
  double height_before, height_behind;

  double least_drop() const;
};

/// A flux after hops have ended early or late: on slopes near repose over cells longer than hops the shift,
/// of first order in the slope, would turn it round or make it many times what it is.
AEOLIAN_INLINE double shifted(double flux, double shift) {
  const double raw = flux + shift;
  const double positive = raw > 0 ? raw : 0;
  const double most = 3 * flux;
  return positive < most ? positive : most;
}

/// Lines side by side that are swept from station to station, one array each for what a line remembers.
///
/// With heights h, exposure E (see exposure.hpp), flux of grains F and of grains times their height of
/// take-off G, all relative to a flat bed: e_i = (E_i + E_i+1) / 2; F and G lose exp(-step / hop) per station
/// and gain what cells launch, exactly for sources that are uniform in each cell; the flux through a face is
/// F + s (G - h F); its divergence is what the bed loses. Where impacts have several angles, E is the mean of
/// each one's.
class HopStage {
 public:
  static constexpr int most_lines = 64;  ///< what they remember fits a first cache

  /// What lines were given or gave at some stations, each an array over lines.
  struct Stations {
    const double* height;     ///< k
    const double* height_1;   ///< k - 1
    const double* height_2;   ///< k - 2
    double* erosion_1;        ///< k - 1, given
    const double* erosion_2;  ///< k - 2, as given before
    double* deposition_2;     ///< k - 2, given
  };
  /// Hard ground: of station k - 1 no more than `movable` is eroded, in flat-bed erosions; where `open` is
  /// zero, at k - 1 or k - 2, sand passes over the bed as it is.
  struct Ground {
    const double* movable_1;
    const double* open_1;
    const double* open_2;
  };

  /// Sweeps lines [begin, end) to station k.
  void sweep(const HopLaw& law, int begin, int end, const Stations& at);
  void sweep(const HopLaw& law, int begin, int end, const Stations& at, const Ground& ground);

  /// Sweeps bare or shaded ground that no grain reaches: only the envelope of the impacts changes.
  void pass_over(const HopLaw& law, int begin, int end, const double* height);

  /// Whether an impact falls between stations k - 1 and k, the next one, or fell between the last two.
  bool is_struck(const HopLaw& law, int begin, int end, const double* height) const;
  bool was_struck(int begin, int end) const;

  /// Forgets what shades the bed.
  void forget_shadows();

  /// Adds what goes out of station k - 2, just swept, to its deposition instead; then no grain is on its way.
  void put_down(int begin, int end, double* deposition_2);

  /// A line begins at station k, just swept, with the exposure of a flat bed at this height and a share of
  /// its flux.
  void begin(const HopLaw& law, int line, double height, double share);

  /// What a line has just begun behind shades it from this height.
  void shade(int line, double height);

  /// Largest flux on its way among some lines.
  double strongest_flux(int begin, int end) const;

  /// Flux through the face behind the station whose deposition was given last, and through the one before it.
  double flux_out(int line) const { return memory_.out[now_][line]; }
  double flux_in(int line) const { return memory_.out[1 - now_][line]; }

  struct Memory {
    double envelope[ImpactAngles::most][most_lines];
    double exposure[most_lines];
    double grains[most_lines];
    double heights[most_lines];
    double flux[2][most_lines];  ///< through the last faces, in turn
    double out[2][most_lines];
  };

 private:
  alignas(64) Memory memory_{};
  int now_ = 0;  ///< which of two in turn is the last
};

}  // namespace aeolian
