#include "aeolian_core/bedforms/lattice/haff_bed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr Require require{"Haff's bed"};

bool is_angle(double value) { return value > 0 && value < M_PI / 2; }

void check(const HaffParameters& p) {
  require(p.bins >= 3 && p.bins <= 10'000'000, "number of bins", p.bins, "from 3 to 10 million");
  require(p.bin_length > 0 && std::isfinite(p.bin_length), "bin length [d]", p.bin_length, "above 0");
  require(p.reptation_length >= p.bin_length && p.reptation_length < p.bin_length * p.bins,
          "reptation length [d]", p.reptation_length, "from one bin to below the length of the bed");
  require(is_angle(p.impact_angle), "impact angle [rad]", p.impact_angle, "between 0 and pi / 2");
  require(is_angle(p.angle_of_repose), "angle of repose [rad]", p.angle_of_repose, "between 0 and pi / 2");
  if (p.steepest_stoss)
    require(is_angle(*p.steepest_stoss), "steepest stoss [rad]", *p.steepest_stoss, "between 0 and pi / 2");
  // A slope that holds must be one that whole grains can make.
  require(std::tan(p.angle_of_repose) * p.bin_length * p.bin_length >= 1, "bin length [d]", p.bin_length,
          "so long that one grain more than in the next bin is below repose");
}

}  // namespace

HaffBed::HaffBed(const HaffParameters& parameters, std::uint64_t seed, std::uint64_t stream)
    : HaffBed(parameters, std::vector<int>(static_cast<std::size_t>(std::max(0, parameters.bins))), seed,
              stream) {}

HaffBed::HaffBed(const HaffParameters& parameters, std::vector<int> grains, std::uint64_t seed,
                 std::uint64_t stream)
    : parameters_(parameters), random_(seed, stream), grains_(std::move(grains)) {
  check(parameters);
  if (grains_.size() != static_cast<std::size_t>(parameters.bins))
    throw Error("Haff's bed: grains are given for " + std::to_string(grains_.size()) + " bins, must be for " +
                std::to_string(parameters.bins));
  layer_ = 1 / parameters.bin_length;
  const double layers_per_slope = parameters.bin_length / layer_;
  drop_ = std::tan(parameters.impact_angle) * layers_per_slope;
  hop_ = static_cast<int>(std::lround(parameters.reptation_length / parameters.bin_length));
  steepest_ = static_cast<int>(std::tan(parameters.angle_of_repose) * layers_per_slope);
  rise_ = parameters.steepest_stoss ? std::tan(*parameters.steepest_stoss) * layers_per_slope
                                    : std::numeric_limits<double>::infinity();
  for (int bin = 0; bin < parameters.bins; ++bin) relax(bin);
  highest_ = *std::max_element(grains_.begin(), grains_.end());
}

std::vector<double> HaffBed::heights() const {
  std::vector<double> result;
  result.reserve(grains_.size());
  for (const int n : grains_) result.push_back(layer_ * n);
  return result;
}

int HaffBed::wrapped(int bin) const {
  const int bins = parameters_.bins;
  return bin < 0 ? bin + bins : bin >= bins ? bin - bins : bin;
}

void HaffBed::advance(double impacts_per_diameter) {
  require(impacts_per_diameter >= 0 && std::isfinite(impacts_per_diameter), "number of impacts per diameter",
          impacts_per_diameter, "zero or more and finite");
  owed_ += impacts_per_diameter * length();
  for (; owed_ >= 1; owed_ -= 1, ++impacts_) {
    const int bin = struck();
    if (!may_leave(bin)) continue;
    move(bin, wrapped(bin + hop_));
    ++moved_;
  }
}

/// The first bin that rises above the path of a grain by the time it has crossed it.
int HaffBed::struck() {
  const double start = random_.uniform() * parameters_.bins;
  int bin = static_cast<int>(start);
  double path = highest_ - drop_ * (bin + 1 - start);
  while (path > grains_[static_cast<std::size_t>(bin)]) {
    bin = wrapped(bin + 1);
    path -= drop_;
  }
  return bin;
}

bool HaffBed::may_leave(int bin) const {
  const int behind = wrapped(bin + 1);
  return grains_[static_cast<std::size_t>(behind)] - grains_[static_cast<std::size_t>(bin)] <= rise_;
}

void HaffBed::move(int from, int to) {
  --grains_[static_cast<std::size_t>(from)];
  ++grains_[static_cast<std::size_t>(to)];
  highest_ = std::max(highest_, grains_[static_cast<std::size_t>(to)]);
  relax(from);
  relax(to);
}

void HaffBed::relax(int bin) {
  unstable_.assign(1, bin);
  while (!unstable_.empty()) {
    const int at = unstable_.back();
    unstable_.pop_back();
    for (const int next : {wrapped(at + 1), wrapped(at - 1)}) {
      int& here = grains_[static_cast<std::size_t>(at)];
      int& there = grains_[static_cast<std::size_t>(next)];
      if (std::abs(here - there) <= steepest_) continue;
      const int downhill = here > there ? 1 : -1;
      here -= downhill;
      there += downhill;
      unstable_.insert(unstable_.end(), {at, next});
    }
  }
}

}  // namespace aeolian
