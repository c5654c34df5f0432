#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "aeolian_core/measure/directional_lines.hpp"
#include "aeolian_core/measure/shadow_profile.hpp"

namespace aeolian {

/// The Fourier transforms of lines, from which all their correlations follow.
class LineSpectra {
 public:
  explicit LineSpectra(const DirectionalLines& lines);

 private:
  friend class LineCorrelation;
  struct Transforms {
    cv::Mat value, square, known;  ///< a line in each row, packed as cv::dft packs real data
  };
  Transforms transforms_of(const DirectionalLines& lines) const;

  int length_;
  int padded_;
  Transforms all_;
  /// Few lines: the same with a stretch of them hidden, one after the other. Otherwise empty: groups of lines
  /// are left out.
  std::vector<Transforms> with_gap_;
};

/// Correlation coefficient of earlier(x) with later(x + lag), over the pairs of which both are known, for all
/// lags up to half of the lines; and the same with one part of the map left out after the other.
class LineCorrelation {
 public:
  /// Lags -reach..reach; index `reach` is lag 0. NaN where less than a twentieth of all samples pair up.
  using Curve = std::vector<double>;

  LineCorrelation(const LineSpectra& earlier, const LineSpectra& later);

  int reach() const { return reach_; }
  const Curve& curve() const { return curve_; }
  /// What `estimate` [samples] makes of the curve, with its standard error: the delete-a-group jackknife over
  /// eight parts of the map, strips along the wind or, of less than 16 lines, stretches of them (Efron &
  /// Stein 1981, Ann. Stat. 9, 586-596). NaN unless it can be had of all parts together and without each.
  Figure jackknifed(const std::function<std::optional<double>(const Curve&)>& estimate) const;

 private:
  int reach_;
  Curve curve_;
  std::vector<Curve> without_;
};

/// The first maximum of an autocorrelation after its first minimum [samples], as ripple_statistics finds it.
std::optional<double> repeating_lag(const LineCorrelation::Curve& curve);
/// The lag of the highest correlation within +-range, above 0.2 [samples]; of equal ones the nearest to zero.
std::optional<double> lag_of_best_match(const LineCorrelation::Curve& curve, double range);

}  // namespace aeolian
