#pragma once

namespace aeolian {

/// How far a grain that leaves a bed at these speeds [m/s], horizontal and upward, hops without air before it
/// meets the bed again, which rises by `slope` [rad]: 2 vx (vz - vx tan slope) / g, horizontal, backward
/// negative [m]; zero for a grain that would go into the bed (splash specification, sec. 3.7, turned into the
/// frame of the flight).
double hop_length(double horizontal, double upward, double slope);

/// Mean reptation of an impact on a slope [m], R(slope) = R0 - 2 N <vn^2> tan(slope) / g, of `level` [m], the
/// mean on level ground at the same angle to the bed, and of the number and the mean square speed [m^2/s^2]
/// away from the bed of the grains that it ejects (splash specification, sec. 3.7). It changes sign near 8
/// degrees for the thesis' ejecta: the proposed cause of the limit of stoss slopes.
double mean_reptation(double level, double number, double mean_square_speed, double slope);

}  // namespace aeolian
