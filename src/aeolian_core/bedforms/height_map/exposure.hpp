#pragma once

#include <cstddef>

namespace aeolian {

/// Impacts per cell of one row along the wind, relative to a flat bed, for grains that fall at an angle alpha
/// on a bed of heights h: M_i = max over j <= i of (h_j + x_j tan alpha), E_i = (M_i - M_{i-1}) / (dx tan
/// alpha). E_i belongs to the stretch between the centres of cells i-1 and i. It is 1 on the flat, 1 +
/// tan(slope)/tan(alpha) on lit slopes, 0 in shadow; the supply of impacts is conserved exactly. (Werner
/// 1987, eq. 5.6; specification sec. 5.4.)
///
/// `drop` is dx tan(alpha) > 0 [m]; `count` cells are read at a stride of 1. For an open row `inflow_height`
/// is the height of the bed one cell upwind; a periodic row is swept twice. Sum of E = count on a periodic
/// row whose shadows are shorter than itself.
void exposure_periodic(const double* height, std::size_t count, double drop, double* exposure);
void exposure_open(const double* height, std::size_t count, double drop, double inflow_height,
                   double* exposure);

}  // namespace aeolian
