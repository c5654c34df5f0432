#pragma once

#include <vector>

namespace aeolian {

/// Which of the points (x rising) form one line without jumps: the longest run in which neighbours differ by
/// no more than `steepest` times their distance plus `slack`, and with it every other run of eight or more
/// that can be reached from it so. NaN belongs nowhere.
std::vector<bool> continuous_part(const std::vector<double>& x, const std::vector<double>& y, double steepest,
                                  double slack);

}  // namespace aeolian
