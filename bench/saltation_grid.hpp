#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "saltation_rows.hpp"

#include "aeolian_core/saltation/kok_renno_kernel.hpp"

namespace aeolian {

/// How wrong a state is that is solved to 1e-8, so that one grid alone is to blame.
struct GridError {
  std::string grid;  ///< what is made finer
  double size;       ///< of it
  bool usual;        ///< the solver's own choice
  double surface;    ///< error of u*_eff, relative
  double flux;
};

inline std::vector<GridError> measure_grids() {
  std::vector<GridError> rows;
  const auto measure = [&](const std::string& grid, const std::vector<double>& sizes, double usual,
                           double finest, const std::function<SteadyState(double)>& solve) {
    const SteadyState exact = solve(finest);
    for (const double size : sizes) {
      const SteadyState s = solve(size);
      rows.push_back({grid, size, size == usual,
                      std::abs(s.surface_friction_velocity / exact.surface_friction_velocity - 1),
                      std::abs(s.mass_flux() / exact.mass_flux() - 1)});
    }
  };
  const auto case_1 = [](double width, double flight) {
    return SaltationSolver(thesis_bed(), DistributionKernel(DistributionSplash::thesis_case(1), width),
                           {1e-8, flight, 300})
        .solve(0.75);
  };
  const auto sand = [](double speeds, double angles) {
    const SaltatingBed bed;
    const KokRennoKernel splash(bed.grain, bed.atmosphere, {}, static_cast<int>(speeds),
                                static_cast<int>(angles));
    return SaltationSolver(bed, splash, {1e-8, 1e-6, 300}).solve(0.4);
  };
  measure("width of bins, case 1 [cm/s]", {40, 20, 10, 5, 2.5, 1.25}, 5, 0.625,
          [&](double width) { return case_1(percent * width, 1e-8); });
  measure("tolerance of flights, case 1", {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7}, 1e-4, 1e-8,
          [&](double tolerance) { return case_1(0.05, tolerance); });
  measure("bins of speed in an octave, Kok and Renno", {1, 2, 4, 8, 16}, 4, 32,
          [&](double speeds) { return sand(speeds, 56); });
  measure("bins of angle, Kok and Renno", {7, 14, 28, 56}, 14, 112,
          [&](double angles) { return sand(16, angles); });
  return rows;
}

}  // namespace aeolian
