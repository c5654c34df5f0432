#include "aeolian_core/bedforms/height_map/impact_noise.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {
namespace {

int wrapped(double at, int n) {
  const int i = static_cast<int>(std::fmod(std::floor(at), n));
  return i < 0 ? i + n : i;
}

/// Nearly a standard normal: the sum of the four bytes of a word.
double bell(std::uint32_t bits) {
  const std::uint32_t sum = (bits & 255) + (bits >> 8 & 255) + (bits >> 16 & 255) + (bits >> 24);
  constexpr double variance = 4 * (256.0 * 256 - 1) / 12;
  static const double scale = 1 / std::sqrt(variance);
  return (sum - 510.0) * scale;
}

}  // namespace

ImpactNoise::ImpactNoise(const WindFrame& frame, double cell, const Hop& hop, double grain_volume,
                         double share, std::uint64_t seed)
    : frame_(frame),
      cell_(cell),
      hop_(hop),
      grain_volume_(grain_volume),
      turns_(static_cast<std::uint64_t>(std::max(1LL, std::llround(1 / share)))),
      random_(seed) {}

/// Where a grain from a random place in a cell comes down.
ImpactNoise::Cell ImpactNoise::target(Cell from, const Philox::Block& random, const FrameField& bed) const {
  const double along = -std::log((static_cast<double>(random[0]) + 0.5) * 0x1p-32) * hop_.length;
  const double across = bell(random[1]) * hop_.spread;
  const double cosine = 1 / std::hypot(1, frame_.drift());
  const double sine = frame_.drift() * cosine;
  const double station = from.station + (random[2] & 0xffff) * 0x1p-16;
  const double row = from.row + (random[2] >> 16) * 0x1p-16;
  const auto place = [&](double length) {
    return Cell{wrapped(station + (length * cosine - across * sine) / cell_, frame_.stations()),
                wrapped(row + (length * sine + across * cosine) / cell_, frame_.rows())};
  };
  const Cell flat = place(along);
  if (hop_.shortening == 0) return flat;
  const double rise = bed.at(flat.station)[flat.row] - bed.at(from.station)[from.row];
  return place(std::max(0.0, along - hop_.shortening * rise));
}

void ImpactNoise::run(const ImpactSweep& sweep, double depth, std::uint64_t step, const HardGround* ground,
                      const ActivePatches& active, FrameField& bed) const {
  const double variance = depth * static_cast<double>(turns_) * grain_volume_ / (cell_ * cell_);
  const auto movable = [&](Cell at) {
    if (!ground) return HardGround::bottomless * -1;
    if (!active.get(at.station, at.row / ActivePatches::rows_each)) return 0.0;
    return (bed.at(at.station)[at.row] - ground->floor.at(at.station)[at.row]) *
           ground->open.at(at.station)[at.row];
  };
  for (int station = 0; station < frame_.stations(); ++station) {
    // Neighbours draw in different steps.
    if ((static_cast<std::uint64_t>(station) * 7 + step) % turns_ != 0) continue;
    const double upper = frame_.place(station).upper;
    const double* const erosion = sweep.erosion().at(station);
    active.for_runs(station, [&](int begin, int end) {
      for (int row = begin; row < end; ++row) {
        const double eroded = erosion[row + 1] + upper * (erosion[row] - erosion[row + 1]);
        if (!(eroded > 0)) continue;
        const Cell here{station, row};
        const Philox::Block random =
            random_(static_cast<std::uint64_t>(station) * static_cast<std::uint64_t>(frame_.rows()) +
                        static_cast<std::uint64_t>(row),
                    step);
        const Cell there = target(here, random, bed);
        const double size = std::sqrt(variance * eroded);
        if (ground && (movable(here) < size || movable(there) < size)) continue;
        const double amount = random[3] & 1 ? size : -size;
        bed.at(station)[row] -= amount;
        bed.at(there.station)[there.row] += amount;
      }
    });
  }
  for (int station = 0; station < frame_.stations(); ++station) bed.fill_pads(station, frame_.periodic());
}

}  // namespace aeolian
