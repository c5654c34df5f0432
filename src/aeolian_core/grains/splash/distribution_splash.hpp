#pragma once

#include "aeolian_core/grains/splash/splash.hpp"

namespace aeolian {

/// Splash of normal rebounds and exponential ejecta of the thesis' saltation model (Werner 1987, eq. 4.34;
/// splash specification, sec. 6.1), for sand of 0.25 mm on a level bed. On a slope the impact is taken
/// relative to it.
///
///     S = c1 / (c2 sqrt(2 pi)) vix / (vix + c5) exp(-(voy - f vix - e |viy|)^2 / (2 c2^2))
///         + c3 vi^2 exp(-voy / c4),    vox = c6 e (1 - f) vix
///
/// `c1` of up to two means up to two grains: the first is told as the rebound, another as an ejectum. A
/// normal upward speed below zero is a grain that does not leave.
class DistributionSplash : public Splash {
 public:
  struct Parameters {
    double c1, c2, c3, c4, c5, c6;  ///< c2, c4, c5 in m/s, c3 in (m/s)^-3
    double restitution;             ///< e
    double conversion;              ///< f: horizontal to vertical
  };
  /// 1 to 6, the cases of the thesis. Throws Error for others.
  static Parameters thesis_case(int number);

  enum class Balance {
    each,  ///< no event has more energy or momentum than its impact, as Splash says
    mean,  ///< as printed: only in the mean, for what chapter IV of the thesis is held against
  };
  /// Throws Error naming the parameter, its value and what is allowed.
  explicit DistributionSplash(const Parameters& parameters, Balance balance = Balance::each);

  double mean_rebounds(const Impact& impact) const;         ///< c1 vix / (vix + c5)
  double mean_ejecta(const Impact& impact) const override;  ///< c3 c4 vi^2

 private:
  void draw(const Impact& impact, RandomStream& random, SplashEvent& event) const override;
  void draw_once(const Impact& impact, RandomStream& random, SplashEvent& event) const;

  Parameters parameters_;
  Balance balance_;
};

}  // namespace aeolian
