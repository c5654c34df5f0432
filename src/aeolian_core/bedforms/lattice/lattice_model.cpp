#include "aeolian_core/bedforms/lattice/lattice_model.hpp"

#include <cmath>
#include <string>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {

LatticeModel::LatticeModel(const LatticeParameters& parameters, std::uint64_t seed)
    : parameters_(parameters), seed_(seed) {
  if (!(parameters.spacing > 0 && std::isfinite(parameters.spacing)))
    throw Error("lattice model: spacing is " + std::to_string(parameters.spacing) + " m, must be positive");
}

BedChange LatticeModel::advance(HeightMap& map, const Forcing& forcing, double duration) {
  check(forcing, duration);
  check_all_sand("lattice model", map);
  const GridGeometry& geometry = map.geometry();
  if (forcing.erosion_rate() * duration == 0) return {TileMask(geometry), {}};

  const double repose = forcing.grain.angle_of_repose;
  if (surface_.take(map) || repose != angle_of_repose_) bed_.reset();
  if (!bed_) begin(geometry, repose);

  const std::vector<int> before = sums(geometry);
  const std::uint64_t ejections = bed_->ejections();
  bed_->advance(forcing, duration);
  const std::vector<int> after = sums(geometry);
  const double height_per_layer = bed_->layer() / (columns_per_cell_ * columns_per_cell_);
  std::vector<double> change(geometry.size());
  for (std::size_t i = 0; i < change.size(); ++i) change[i] = (after[i] - before[i]) * height_per_layer;
  return surface_.store(change, static_cast<double>(bed_->ejections() - ejections) * bed_->grain_volume(),
                        map);
}

void LatticeModel::begin(const GridGeometry& geometry, double angle_of_repose) {
  const int step = geometry.nx() % 2 == 0 && geometry.ny() % 2 == 0 ? 1 : 2;
  // A spacing that goes into a cell up to rounding goes into it.
  const double columns = std::max(1.0, std::ceil(geometry.cell() / parameters_.spacing / step - 1e-9)) * step;
  if (columns > 1000)
    throw Error("lattice model: spacing is " + std::to_string(parameters_.spacing) +
                " m, must be at least a thousandth of a cell of " + std::to_string(geometry.cell()) + " m");
  columns_per_cell_ = static_cast<int>(columns);
  angle_of_repose_ = angle_of_repose;
  const Philox::Block words = Philox(seed_)(begun_++);
  bed_ = LatticeBed::from_elevation(geometry, surface_.height(), columns_per_cell_, angle_of_repose,
                                    std::uint64_t{words[1]} << 32 | words[0]);
}

/// Of the heights of the columns in each cell, in layers.
std::vector<int> LatticeModel::sums(const GridGeometry& geometry) const {
  std::vector<int> result(geometry.size());
  const std::int16_t* column = bed_->heights().data();
  for (int y = 0; y < bed_->ny(); ++y)
    for (int x = 0; x < bed_->nx(); ++x, ++column)
      result[geometry.index(x / columns_per_cell_, y / columns_per_cell_)] += *column;
  return result;
}

}  // namespace aeolian
