#pragma once

#include "aeolian_twin/saltation/saltation_files.hpp"

namespace aeolian {

/// Draws what the thesis draws (Werner 1987, figs. 4.12-4.21), as SVG in a folder:
///   winds.svg     the wind against height for all winds of the run: they cross at the focus
///   heights.svg   flux, kinetic-energy flux and drag against height
///   launches.svg  the speeds at which grains leave the bed and land
/// Only winds in which grains saltate are drawn. Throws Error when gnuplot fails.
void plot_saltation(const SaltationRun& run, const std::string& folder);

/// gusts.svg: wind and flux in time.
void plot_gusts(const GustRun& gusts, const std::string& folder);

}  // namespace aeolian
