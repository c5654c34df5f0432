#include "aeolian_core/slide/mpm/pack_store.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {
namespace {

template <int Dim>
Passenger<Dim> nobody(const BlockPlace<Dim>& place, double cell) {
  MaterialPoint<Dim> point;
  for (int d = 0; d < Dim; ++d)
    point.place[d] = (block_cells * place[static_cast<std::size_t>(d)] + 0.5 * block_cells) * cell;
  return passenger_of<Dim>(point, -1);
}

template <int Dim>
void put(ParticleBlock<Dim>& block, int at, const Passenger<Dim>& passenger) {
  put_lane(block.packs[static_cast<std::size_t>(at / lane_count)], at % lane_count, passenger);
}

}  // namespace

template <int Dim>
Passenger<Dim> take_lane(const Pack<Dim>& pack, int lane) {
  Passenger<Dim> passenger;
  const auto* const rows = reinterpret_cast<const Lanes*>(&pack);
  for (std::size_t r = 0; r < Passenger<Dim>::rows; ++r) passenger.values[r] = rows[r][lane];
  passenger.id = pack.id[static_cast<std::size_t>(lane)];
  return passenger;
}

template <int Dim>
void put_lane(Pack<Dim>& pack, int lane, const Passenger<Dim>& passenger) {
  auto* const rows = reinterpret_cast<Lanes*>(&pack);
  for (std::size_t r = 0; r < Passenger<Dim>::rows; ++r) rows[r][lane] = passenger.values[r];
  pack.id[static_cast<std::size_t>(lane)] = passenger.id;
}

template <int Dim>
Passenger<Dim> passenger_of(const MaterialPoint<Dim>& point, int id) {
  Pack<Dim> pack{};
  for (int r = 0; r < Dim; ++r) {
    pack.place[r][0] = point.place[r];
    pack.velocity[r][0] = point.velocity[r];
    for (int c = 0; c < Dim; ++c) pack.affine[r][c][0] = point.affine(r, c);
    for (int c = r; c < Dim; ++c) pack.b[symmetric_index<Dim>(r, c)][0] = point.b(r, c);
  }
  pack.alpha[0] = point.alpha;
  pack.mass[0] = point.mass;
  pack.volume[0] = point.volume;
  pack.id[0] = id;
  return take_lane(pack, 0);
}

template <int Dim>
MaterialPoint<Dim> point_of(const Passenger<Dim>& passenger) {
  Pack<Dim> pack{};
  put_lane(pack, 0, passenger);
  MaterialPoint<Dim> point;
  for (int r = 0; r < Dim; ++r) {
    point.place[r] = pack.place[r][0];
    point.velocity[r] = pack.velocity[r][0];
    for (int c = 0; c < Dim; ++c) {
      point.affine(r, c) = pack.affine[r][c][0];
      point.b(r, c) = pack.b[symmetric_index<Dim>(std::min(r, c), std::max(r, c))][0];
    }
  }
  point.alpha = pack.alpha[0];
  point.mass = pack.mass[0];
  point.volume = pack.volume[0];
  return point;
}

template <int Dim>
BlockPlace<Dim> home_of(const Passenger<Dim>& passenger, double cell) {
  BlockPlace<Dim> home;
  for (std::size_t d = 0; d < Dim; ++d)  // places are the first rows
    home[d] = static_cast<int>(std::floor((passenger.values[d] / cell - 0.5) / block_cells));
  return home;
}

template <int Dim>
void board(ParticleBlock<Dim>& block, const Passenger<Dim>& passenger, double cell) {
  if (block.count % lane_count == 0) {
    Pack<Dim>& pack = block.packs.emplace_back();
    const Passenger<Dim> none = nobody<Dim>(block.place, cell);
    for (int lane = 0; lane < lane_count; ++lane) put_lane(pack, lane, none);
  }
  put(block, block.count++, passenger);
}

template <int Dim>
void take_leavers(ParticleBlock<Dim>& block, double cell, std::vector<Passenger<Dim>>& leavers) {
  int kept = 0;
  for (int at = 0; at < block.count; ++at) {
    const Passenger<Dim> passenger =
        take_lane(block.packs[static_cast<std::size_t>(at / lane_count)], at % lane_count);
    if (home_of(passenger, cell) != block.place) {
      leavers.push_back(passenger);
      continue;
    }
    if (kept != at) put(block, kept, passenger);
    ++kept;
  }
  block.count = kept;
  block.packs.resize(static_cast<std::size_t>((kept + lane_count - 1) / lane_count));
  const Passenger<Dim> none = nobody<Dim>(block.place, cell);
  for (int at = kept; at % lane_count != 0; ++at) put(block, at, none);
}

#define AEOLIAN_FOR(Dim)                                                   \
  template Passenger<Dim> take_lane(const Pack<Dim>&, int);                \
  template void put_lane(Pack<Dim>&, int, const Passenger<Dim>&);          \
  template Passenger<Dim> passenger_of(const MaterialPoint<Dim>&, int);    \
  template MaterialPoint<Dim> point_of(const Passenger<Dim>&);             \
  template BlockPlace<Dim> home_of<Dim>(const Passenger<Dim>&, double);    \
  template void board(ParticleBlock<Dim>&, const Passenger<Dim>&, double); \
  template void take_leavers(ParticleBlock<Dim>&, double, std::vector<Passenger<Dim>>&);
AEOLIAN_FOR(2)
AEOLIAN_FOR(3)
#undef AEOLIAN_FOR

}  // namespace aeolian
