#include <cmath>

#include "slide_rows.hpp"

#include "aeolian_core/slide/calibration/rescaled_score.hpp"
#include "aeolian_core/slide/mpm/return_mapping.hpp"

namespace aeolian {

void slide_law_rows(AccuracyTable& table) {
  table.section("Return mapping",
                "Golden table of the specification, section 2.6: three dimensions, M 0.5, beta "
                "0.2, p0 7 kPa, xi 0.1, E 1 MPa, nu 0.3.");
  const SnowLaw law;
  const YieldConstants y = yield_constants(law, 3);
  struct Golden {
    double p, q, p_after, q_after, expansion, p0_after;
  };
  for (const Golden& g :
       {Golden{3000, 1000, 3000, 1000, 0, 7000}, Golden{3000, 4000, 2972.13, 1773.33, -3.345e-5, 7002.8},
        Golden{9000, 500, 6992.49, 106.09, -2.409e-3, 7200.8},
        Golden{12000, 6000, 6799.77, 541.47, -6.240e-3, 7520.0},
        Golden{-1000, 2000, -598.01, 1043.14, 4.824e-4, 6959.8},
        Golden{-3000, 0, -1400.00, 0, 1.920e-3, 6840.0}}) {
    const auto out = returned_to_ellipse<double>(y, {g.p, g.q}, 7000);
    const double expansion = (out.p - g.p) / y.bulk;
    const std::string trial = fmt::format("trial ({:g}, {:g}) Pa: ", g.p, g.q);
    table.relative_row(trial + "p [Pa]", g.p_after, out.p, 1e-3);
    table.row(trial + "q [Pa]", g.q_after, out.q, 1e-3 * g.q_after + 1e-9);
    table.row(trial + "plastic volume strain", g.expansion, expansion, 1e-3 * std::abs(g.expansion) + 1e-12);
    table.relative_row(trial + "p0 after [Pa]", g.p0_after,
                       law.consolidation_at(law.initial_compaction() - expansion), 1e-3);
  }
  table.section("Score of a calibration", "Specification, section 5 A; the thesis prints 0.237.");
  table.row("rescaled score of the calibrated set", 0.24,
            rescaled_scores({{0.009, 0.118}, {0.014, 0.067}, {0.067, 0.034}})[1], 0.005);
}

}  // namespace aeolian
