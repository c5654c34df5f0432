#include <cmath>

#include "saltation_rows.hpp"

#include "aeolian_core/saltation/mixture_solver.hpp"

namespace aeolian {

void mixture_rows(AccuracyTable& table) {
  table.section(
      "Mixtures of sizes: Kok & Renno's splash",
      "Dune sand: 0.125, 0.177, 0.25, 0.354 and 0.5 mm with shares of 10, 20, 40, 20 and 10 % of the "
      "bed, at u* = 0.40 m/s; SI. Against sand of its median size, 0.25 mm.");
  constexpr double u = 0.4;
  const SaltatingBed bed;
  const SaltationSolver median(bed, KokRennoKernel(bed.grain, bed.atmosphere));
  const SteadyState one = median.solve(u);

  const GrainMixture equal{{0.00025, 0.00025, 0.00025}, {0.6, 0.3, 0.1}};
  const MixtureState same = MixtureSolver(bed, equal).solve(u);
  table.row("three equal sizes, Q over that of one", 1, same.mass_flux() / one.mass_flux(), 1e-3);
  table.row("three equal sizes, u*_eff over that of one", 1,
            same.sizes[0].surface_friction_velocity / one.surface_friction_velocity, 1e-3);

  const GrainMixture dune{{0.000125, 0.000177, 0.00025, 0.000354, 0.0005}, {0.1, 0.2, 0.4, 0.2, 0.1}};
  const MixtureSolver solver(bed, dune);
  const MixtureState mixed = solver.solve(u);
  const double surface = mixed.sizes[0].surface_friction_velocity;
  table.remark("threshold", *median.impact_threshold(), *solver.impact_threshold());
  table.remark("u*_eff", one.surface_friction_velocity, surface);
  table.relative_row("Q", one.mass_flux(), mixed.mass_flux(), 15 * percent);
  double carried = 0;
  for (std::size_t s = 0; s < dune.share.size(); ++s) {
    const SteadyState& size = mixed.sizes[s];
    const std::string name = fmt::format("{:g} mm, ", 1e3 * dune.diameter[s]);
    carried += size.grain_stress[0];
    table.remark(name + "part of Q against its share of the bed", dune.share[s],
                 size.mass_flux() / mixed.mass_flux());
    table.remark(name + "hop length", one.mean(one.landings.length), size.mean(size.landings.length));
  }
  const double lost = bed.atmosphere.density * (u * u - surface * surface);
  table.statement("the stress of all sizes is what the wind loses, to 1e-8",
                  fmt::format("{:.1e}", carried / lost - 1), std::abs(carried / lost - 1) < 1e-8);
}

}  // namespace aeolian
