#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "aeolian_core/measure/photo_setup.hpp"

namespace aeolian {

/// What is wrong with a list of scale marks, and with which of them.
struct MarkFault {
  std::size_t mark = 0;
  std::string reason;
};

/// Whether the marks contradict one another by themselves, without a camera: fewer than two, two marks in one
/// pixel, one mark in two pixels, an order along a row that differs from that of the pixels, or a scale that
/// changes by more than a factor of two from one pair of neighbours of a row to the next.
std::optional<MarkFault> contradiction(const std::vector<PhotoSetup::ScaleMark>& marks);

}  // namespace aeolian
