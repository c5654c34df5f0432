#include <algorithm>
#include <cmath>

#include "saltation_rows.hpp"

#include "aeolian_core/saltation/profiles.hpp"

namespace aeolian {
namespace {

/// Eq. 4.34 on a grid that ends where the reference solver's did, whatever that cuts off.
class EndedKernel : public DistributionKernel {
 public:
  EndedKernel(int number, double top)
      : DistributionKernel(DistributionSplash::thesis_case(number), 0.05, top) {}
  std::unique_ptr<SplashKernel> clone() const override { return std::make_unique<EndedKernel>(*this); }
  double cut_off(const std::vector<double>&) const override { return 0; }
};

/// A row of the specification's table in sec. 5.2; zero where it gives nothing.
struct Row52 {
  int number;
  double u, thesis, surface, rate, flux, surface62, flux62;
};
const Row52 table_4_5[] = {{1, 35, 33.1, 29.6, 62, .0433, 32.7, .0217},
                           {1, 75, 29.0, 26.15, 867, .651, 29.2, .690},
                           {1, 125, 24.8, 22.05, 2597, 2.131, 24.65, 2.33},
                           {2, 35, 25.1, 21.9, 248, .0811, 25.5, .068},
                           {2, 75, 20.1, 16.9, 1812, .635, 20.4, .667},
                           {2, 125, 13.9, 11.5, 5375, 2.02, 14.3, 2.17},
                           {3, 35, 35.0, 31.6, 57, .0237, 0, 0},
                           {3, 75, 30.6, 26.25, 1298, .560, 31.3, .565},
                           {3, 125, 24.2, 19.2, 4192, 1.88, 23.8, 1.99},
                           {4, 35, 26.4, 21.5, 227, .127, 24.6, .110},
                           {4, 50, 24.6, 19.3, 646, .368, 22.4, .365},
                           {4, 75, 20.9, 15.6, 1701, .989, 18.5, 1.02},
                           {5, 50, 40.6, 35.3, 282, .202, 40.4, .149},
                           {5, 100, 35.7, 31.0, 2010, 1.57, 35.85, 1.61},
                           {5, 150, 31.1, 27.4, 4779, 4.07, 31.4, 4.31},
                           {6, 50, 28.0, 22.4, 970, .309, 26.75, .290},
                           {6, 100, 20.4, 16.8, 5105, 1.74, 20.2, 1.80},
                           {6, 150, 12.1, 14.1, 12630, 4.52, 15.7, 4.77}};

}  // namespace

void state_rows(AccuracyTable& table) {
  table.section(
      "W1: u*_eff and flux, printed parameters",
      "Specification 5.2, [R]: cm/s, g/(cm s). In case 4 the reference ended its launches at 500 cm/s; "
      "exp(-v/80) leaves 0.2 % of the grains above, which carry 2 % of the flux. So case 4 is judged on "
      "that grid, and told on the whole one.");
  for (const Row52& r : table_4_5) {
    const SaltationSolver solver =
        r.number == 4 ? SaltationSolver(thesis_bed(1), EndedKernel(4, 5)) : thesis_solver(r.number);
    const SteadyState s = solver.solve(r.u / 100);
    const bool near_threshold = r.u < 120 * solver.impact_threshold().value_or(0);
    const std::string name = name_of(r.number, r.u);
    table.relative_row(name + ", u*_eff", r.surface, 100 * s.surface_friction_velocity,
                       (r.number == 6 && r.u == 150 ? 3 : 1.5) * percent);
    table.relative_row(name + ", Q", r.flux, 10 * s.mass_flux(), (near_threshold ? 4 : 1.5) * percent);
    if (r.number == 4) {
      const SteadyState whole = thesis_solver(4).solve(r.u / 100);
      table.remark(name + ", u*_eff, whole spectrum", r.surface, 100 * whole.surface_friction_velocity);
      table.remark(name + ", Q, whole spectrum", r.flux, 10 * whole.mass_flux());
    }
  }
  table.section(
      "W2: the thesis' table 4.5 with drag x 0.62",
      "The printed parameters do not give the printed table (W1 against [T] differs by 10 to 25 %): its code "
      "must have had a weaker drag; 0.62 is fitted, the cause is not known (specification 5.2). Case 6 at "
      "150 is "
      "told only.");
  for (const Row52& r : table_4_5) {
    const SteadyState s = thesis_solver(r.number, 0.62).solve(r.u / 100);
    const std::string name = name_of(r.number, r.u) + ", u*_eff";
    if (r.surface62 == 0)
      table.statement(name + ", 35.0 in the thesis: nothing moves", s.reason, !s.steady());
    else if (r.number == 6 && r.u == 150)
      table.remark(name, r.thesis, 100 * s.surface_friction_velocity);
    else
      table.relative_row(name, r.thesis, 100 * s.surface_friction_velocity,
                         (r.number == 4 ? 13 : 8) * percent);
  }
  table.section("W2: both columns of the specification at drag x 0.62", "Against [R], cm/s.");
  for (const Row52& r : table_4_5)
    if (r.surface62 > 0)
      table.relative_row(name_of(r.number, r.u) + ", u*_eff", r.surface62,
                         100 * thesis_solver(r.number, 0.62).solve(r.u / 100).surface_friction_velocity,
                         (r.number == 6 && r.u == 150 ? 3 : 1.5) * percent);

  table.section("W3 to W6", "Conservation, and the threshold below which nothing is solved.");
  const double nominal[] = {29.96, 23.2, 32.0, 23.0, 36.4, 25.3};
  const double compatible[] = {32.8, 26.4, 36.5, 25.8, 41.1, 29.3};
  for (int number = 1; number <= 6; ++number) {
    const double part = (number > 4 ? 3 : 1.5) * percent;
    table.relative_row(fmt::format("W6 case {}, u*_it", number), nominal[number - 1],
                       100 * thesis_solver(number).impact_threshold().value_or(0), part);
    table.relative_row(fmt::format("W6 case {}, u*_it, drag x 0.62", number), compatible[number - 1],
                       100 * thesis_solver(number, 0.62).impact_threshold().value_or(0), part);
  }
  double momentum = 0, flux = 0, number_balance = 0;
  bool falls = true;
  for (int number = 1; number <= 6; ++number) {
    const SaltationSolver solver = thesis_solver(number);
    double last = 1;
    for (const double u : {0.5, 0.75, 1.0, 1.25}) {
      const SteadyState s = solver.solve(u);
      const SaltationProfiles p = profiles(s, solver.bed());
      falls = falls && s.surface_friction_velocity < last;
      last = s.surface_friction_velocity;
      const double lost = 1.23 * (u * u - last * last);
      momentum = std::max(momentum, std::abs(s.grain_stress[0] / lost - 1));
      momentum = std::max(momentum, std::abs(p.stress() / s.grain_stress[0] - 1));
      flux = std::max(flux, std::abs(p.mass_flux(s.grain_mass) / s.mass_flux() - 1));
      number_balance = std::max(number_balance, std::abs(s.replacement - 1));
    }
  }
  table.statement("W3 u*_eff falls as u* rises, all cases", falls ? "everywhere" : "not everywhere", falls);
  table.row("W4 momentum lost by the wind over that gained by the grains, less one (issue: 1e-8)", 0,
            momentum, 1e-8);
  table.row("W5 flux from hop lengths over that from the profile, less one", 0, flux, 0.005);
  table.row("number of grains that leave for one that lands, less one", 0, number_balance, 1e-3);
}

}  // namespace aeolian
