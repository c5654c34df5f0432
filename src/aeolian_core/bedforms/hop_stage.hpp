#pragma once

#include <vector>

namespace aeolian {

/// How impacts and hops act from station to station along the wind.
struct HopLaw {
  /// `step` is the distance of stations along the wind, `hop` the mean reptation length [m]; `shortening` as
  /// in RippleParameters; `blur` is what the blend of rows takes from a wave along the wind, relative to the
  /// square of its phase per station.
  HopLaw(double step, double tan_impact_angle, double hop, double shortening, double blur);

  double drop;        ///< height lost by a falling grain from station to station [m]
  double carried;     ///< share of the reptation flux that passes a station
  double launched;    ///< share of a cell's ejected grains that leave the cell
  double flat_flux;   ///< flux on a flat bed, in flat-bed erosions of one cell
  double shortening;  ///< shift of flux per metre of rise [1/m]
  /// Weights of the flux upwind, here and downwind, and of the heights before and behind a face, that cancel
  /// the error of second order of cells of this size.
  double flux_upwind, flux_here, flux_downwind;
  double height_before, height_behind;
};

/// Lines side by side that are swept from station to station, one array each for what a line remembers.
///
/// With heights h, exposure E (see exposure.hpp), flux of grains F and of grains times their height of
/// take-off G, all relative to a flat bed: e_i = (E_i + E_i+1) / 2; F and G lose exp(-step / hop) per station
/// and gain what cells launch, exactly for sources that are uniform in each cell; the flux through a face is
/// F + s (G - h F); its divergence is what the bed loses.
class HopStage {
 public:
  explicit HopStage(int lines);

  /// Sweeps lines [begin, end) to station k: takes their heights at k, k - 1, k - 2 and gives erosion and
  /// deposition at station k - 2.
  void sweep(const HopLaw& law, int begin, int end, const double* height, const double* height_1,
             const double* height_2, double* erosion, double* deposition);

  /// The same on hard ground: of station k - 1 no more than `movable` is eroded, in flat-bed erosions; where
  /// `open` is zero, at k - 1 or k - 2, sand passes over the bed as it is.
  void sweep_hard(const HopLaw& law, int begin, int end, const double* height, const double* height_1,
                  const double* height_2, const double* movable_1, const double* open_1, const double* open_2,
                  double* erosion, double* deposition);

  /// Sweeps bare ground that no grain reaches: only the envelope of the impacts changes.
  void pass_over(const HopLaw& law, int begin, int end, const double* height);

  /// A line begins at station k, just swept, with the exposure of a flat bed at this height and a share of
  /// its flux.
  void begin(const HopLaw& law, int line, double height, double share);

  /// Largest flux of grains among some lines.
  double strongest_flux(int begin, int end) const;

  /// Flux through the face behind the station whose deposition was given last, and through the one before it.
  double flux_out(int line) const { return out_[static_cast<std::size_t>(line)]; }
  double flux_in(int line) const { return in_[static_cast<std::size_t>(line)]; }

 private:
  std::vector<double> envelope_, exposure_, erosion_, grains_, heights_, flux_, flux_before_, in_, out_;
};

}  // namespace aeolian
