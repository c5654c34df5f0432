#pragma once

#include <optional>

#include "aeolian_core/saltation/saltation_state.hpp"
#include "aeolian_core/saltation/saltation_table.hpp"

namespace aeolian {

/// Where a twin has its saltation from: the three-number law (steady_saltation) or a table of solved states.
///
///     const SaltationSource law;
///     const SaltationSource solved(SaltationTable::read("config/saltation/quartz_in_air.csv"));
///     solved.check(grain);
///     const SaltationState state = solved.state(0.4, grain, air_density);
class SaltationSource {
 public:
  SaltationSource() = default;  ///< the law
  explicit SaltationSource(SaltationTable table) : table_(std::move(table)) {}

  /// Throws Error, in one line, for a grain or an air [kg/m^3] of which the source knows nothing: of a table,
  /// diameters that are not within it, and densities of grain over air more than a quarter from its own.
  void check(const Grain& grain, double air_density = 1.225) const;

  /// The state in a wind. For densities that are not the table's, thresholds go with
  /// (grain density / air density)^0.15 at one diameter, as solved states do; means of impacts stay, and the
  /// flux is that of the excess stress. From 1.0 to 1.4 kg/m^3 the flux is good to 2 % at twice the threshold
  /// and 8 % at 1.2 times. Throws Error as check() and for a friction velocity that is negative or not
  /// finite.
  SaltationState state(double friction_velocity, const Grain& grain, double air_density = 1.225) const;

 private:
  std::optional<SaltationTable> table_;
};

}  // namespace aeolian
