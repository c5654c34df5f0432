#include "aeolian_core/bedforms/height_map/impact_sweep.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "aeolian_core/bedforms/wrapped.hpp"
#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

/// Widens the range [low, high] by a station's heights above the dune.
AEOLIAN_WIDE_KERNEL void relief(std::ptrdiff_t count, const double* __restrict bed,
                                const double* __restrict dune, double& low, double& high) {
  constexpr int lanes = 8;
  double least[lanes];
  double most[lanes];
  std::fill_n(least, lanes, low);
  std::fill_n(most, lanes, high);
  const std::ptrdiff_t whole = count / lanes * lanes;
  for (std::ptrdiff_t i = 0; i < whole; i += lanes)
    for (int k = 0; k < lanes; ++k) {
      const double h = bed[i + k] - dune[i + k];
      least[k] = h < least[k] ? h : least[k];
      most[k] = h > most[k] ? h : most[k];
    }
  for (std::ptrdiff_t i = whole; i < count; ++i) {
    const double h = bed[i] - dune[i];
    least[0] = std::min(least[0], h);
    most[0] = std::max(most[0], h);
  }
  low = *std::min_element(least, least + lanes);
  high = *std::max_element(most, most + lanes);
}

double blur_along(const WindFrame& frame) {
  const double tangent = frame.drift();
  const double across = tangent / (1 + tangent * tangent);
  return frame.blur() * across * across;
}

}  // namespace

ImpactSweep::ImpactSweep(const WindFrame& frame, const ImpactAngles& angles, double hop, double shortening)
    : frame_(frame),
      law_(frame.step(), angles, hop, shortening, blur_along(frame)),
      erosion_(FrameField::unset(frame.stations(), frame.rows())),
      deposition_(FrameField::unset(frame.stations(), frame.rows())),
      seam_in_(static_cast<std::size_t>(frame.rows()) + 1),
      seam_out_(static_cast<std::size_t>(frame.rows()) + 1) {}

/// In stations, at most as many as a line visits.
int ImpactSweep::longest_shadow(const FrameField& bed, const FrameField& dune) const {
  double low = bed.at(0)[0] - dune.at(0)[0];
  double high = low;
  for (int i = 0; i < frame_.stations(); ++i) relief(frame_.rows(), bed.at(i), dune.at(i), low, high);
  return static_cast<int>(
      std::min<double>(frame_.longest_way(), std::ceil((high - low) / law_.least_drop())));
}

/// Puts right at the last station of a periodic bed what the first round left of the difference between what
/// goes out there and what comes in at the first, so that no sand is made or lost.
void ImpactSweep::close_period() {
  const int last = frame_.stations() - 1;
  const int moved = frame_.place(last + 1).offset - frame_.place(last).offset;
  for (int q = 0; q < frame_.rows(); ++q) {
    const auto i = static_cast<std::size_t>(q);
    deposition_.at(last)[wrapped(q - moved, frame_.rows())] += seam_out_[i] - seam_in_[i];
  }
  for (int station = 0; station <= last; ++station) {
    erosion_.at(station)[frame_.rows()] = erosion_.at(station)[0];
    deposition_.at(station)[frame_.rows()] = deposition_.at(station)[0];
  }
}

SweepTask ImpactSweep::task(const FrameField& bed, const FrameField& dune, const HardGround* ground,
                            const ActivePatches* sandy, double depth) {
  const bool needed = frame_.periodic() || ground;
  const int shade = needed ? longest_shadow(bed, dune) : 0;
  // A periodic bed is swept some way before the first station, for the envelope and the flux that come round.
  const int first = frame_.periodic()
                        ? -shade - static_cast<int>(std::ceil(24 / -std::log(law_.carried))) - stage_stations
                        : 0;
  return {frame_, law_,  bed,     dune,     ground,      sandy,    depth,
          first,  shade, supply_, erosion_, deposition_, seam_in_, seam_out_};
}

void ImpactSweep::run(const FrameField& bed, const FrameField& dune, double depth) {
  run_bundles(task(bed, dune, nullptr, nullptr, depth));
}

void ImpactSweep::run(const FrameField& bed, const FrameField& dune, const HardGround& ground,
                      const ActivePatches& sandy, double depth, ActivePatches& active) {
  for (int station = 0; station < frame_.stations(); ++station)
    active.for_runs(station, [&](int begin, int end) {
      std::fill(erosion_.at(station) + begin, erosion_.at(station) + end + 1, 0.0);
      std::fill(deposition_.at(station) + begin, deposition_.at(station) + end + 1, 0.0);
    });
  active.fill(false);
  SweepTask on_ground = task(bed, dune, &ground, &sandy, depth);
  if (ground.holes) on_ground.shade = frame_.stations();
  for (const SweptBundle& bundle : run_bundles(on_ground))
    for (const SweptBundle::Rows& touched : bundle.touched) {
      active.activate_rows(touched.station, touched.begin, touched.end);
      if (frame_.periodic() && touched.begin < 0)
        active.activate_rows(touched.station, frame_.rows() - 1, frame_.rows());
    }
}

std::vector<SweptBundle> ImpactSweep::run_bundles(const SweepTask& task) {
  const int lines = frame_.end_line() - frame_.first_line();
  const int bundles = (lines + HopStage::most_lines - 1) / HopStage::most_lines;
  const int each = std::min(HopStage::most_lines, (lines / bundles + 8) / 8 * 8);
  std::fill(seam_in_.begin(), seam_in_.end(), 0.0);
  std::fill(seam_out_.begin(), seam_out_.end(), 0.0);
  std::vector<SweptBundle> swept(static_cast<std::size_t>(bundles));
  tbb::parallel_for(0, bundles, [&](int i) {
    const int begin = frame_.first_line() + i * each;
    const int end = std::min(begin + each, frame_.end_line());
    if (begin < end) swept[static_cast<std::size_t>(i)] = sweep_bundle(task, begin, end);
  });
  inflow_ = outflow_ = 0;
  for (const SweptBundle& bundle : swept) {
    inflow_ += bundle.inflow;
    outflow_ += bundle.outflow;
  }
  if (frame_.periodic()) close_period();
  return swept;
}

}  // namespace aeolian
