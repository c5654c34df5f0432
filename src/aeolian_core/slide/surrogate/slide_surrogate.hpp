#pragma once

#include <optional>
#include <string>

#include "aeolian_core/slide/surrogate/convex_hull.hpp"
#include "aeolian_core/slide/surrogate/cross_validation.hpp"

namespace aeolian {

/// A number and where it lies in so many of cases as the surrogate's coverage says.
struct Estimate {
  double value = 0;
  double low = 0;
  double high = 0;
};

/// A pile that was not simulated.
struct PilePrediction {
  Estimate height;  ///< [m]
  Estimate length;  ///< [m]
  Estimate shape;   ///< height over length, learnt by itself: the thesis' H/L
};

/// Height, length and shape of piles, learnt from those of a table (Frischholz, ch. 5; specification, 3.6).
///
/// Each is an epsilon-support-vector regression on its logarithm, so that none can be negative and errors are
/// parts of the value. Settings are those with the smallest mean absolute error over folds of whole runs. The
/// interval is conformal: the quantile of the absolute residuals out of those folds, n + 1 for n (Vovk et al.
/// 2018, cross-conformal), of the logarithm.
class SlideSurrogate {
 public:
  struct Settings {
    SvrKernel kernel = SvrKernel::rbf;
    int folds = 10;
    double coverage = 0.9;
    std::uint64_t seed = 1;
    SvrGrid grid;
  };
  /// One of the three.
  struct Target {
    SupportVectors vectors;
    double half_width = 0;  ///< of the interval, of the logarithm
  };

  /// Throws Error for a table with fewer runs than folds or fewer rows than the coverage needs.
  static SlideSurrogate train(const PileTable& table, const Settings& settings);

  /// Nothing when the query is outside the convex hull of what was learnt: then it has to be simulated.
  std::optional<PilePrediction> predict(const PileQuery& query) const;
  /// The same without that question: what it says far outside is a guess.
  PilePrediction predict_anywhere(const PileQuery& query) const;
  /// In words why a query is outside: the first number out of its range, or that their combination is.
  std::string why_outside(const PileQuery& query) const;

  SvrKernel kernel() const { return height_.vectors.parts().settings.kernel; }
  double coverage() const { return coverage_; }
  const Target& height() const { return height_; }
  const Target& length() const { return length_; }
  const Target& shape() const { return shape_; }
  const ConvexHull& hull() const { return hull_; }

  /// As YAML, atomically; the comment is a line above.
  void write(const std::string& file, const std::string& comment) const;
  /// Throws Error naming file, line, key, value and what is allowed.
  static SlideSurrogate read(const std::string& file);

 private:
  SlideSurrogate(Target height, Target length, Target shape, ConvexHull hull, double coverage);

  Target height_, length_, shape_;
  ConvexHull hull_;
  double coverage_;
};

/// What is learnt from a table: the logarithm of one of its numbers.
TrainingRows rows_of(const PileTable& table, double (*number)(const PileRecord&));

}  // namespace aeolian
