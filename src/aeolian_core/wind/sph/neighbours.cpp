#include "aeolian_core/wind/sph/neighbours.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <tbb/enumerable_thread_specific.h>

#include "aeolian_core/wind/sph/pair_kernels.hpp"

namespace aeolian::sph {
namespace {

/// Of the matrices of the corrections: that of a half space is 1/8.
constexpr float least_whole = 0.2F;
constexpr float least_beside = 0.02F;

}  // namespace

/// The particles of the 27 cells around one, and what is worked out of them.
struct NeighbourFinder::Candidates {
  std::vector<float> x, y, z, square, hit_square, pull;
  std::vector<Four> place;
  std::vector<std::uint32_t> who, hit;

  void clear() {
    x.clear();
    y.clear();
    z.clear();
    place.clear();
    who.clear();
  }
  void add(const std::vector<Four>& from, std::uint32_t begin, std::uint32_t end, const Four& shift) {
    for (std::uint32_t i = begin; i < end; ++i) {
      const Four p = from[i] + shift;
      x.push_back(p[0]);
      y.push_back(p[1]);
      z.push_back(p[2]);
      place.push_back(p);
      who.push_back(i);
    }
  }
  void make_room() {
    const std::size_t n = x.size() + 8;
    if (square.size() >= n) return;
    square.resize(2 * n);
    hit_square.resize(2 * n);
    pull.resize(2 * n);
    hit.resize(2 * n);
  }
};

NeighbourFinder::NeighbourFinder(const Torus& torus, float support)
    : torus_(torus),
      kernel_(support),
      volume_(lattice_volume(kernel_)),
      most_(static_cast<std::size_t>(1.6F * 4.19F * support * support * support) + 8) {}

void NeighbourFinder::find(const CellOrder& cells, const std::vector<Four>& place,
                           const std::vector<Four>& normal) {
  const std::size_t n = place.size();
  for (std::vector<std::size_t>* v : {&rows_.begin, &rows_.images, &rows_.end}) v->resize(n);
  for (std::vector<Four>& column : sums_.correction) column.resize(n);
  for (std::vector<Four>& column : sums_.beside) column.resize(n);
  sums_.crowding.resize(n);
  sums_.diagonal.resize(n);
  static tbb::enumerable_thread_specific<Candidates> candidates;
  for (bool complete = false; !complete;) {
    if (rows_.who.size() < n * most_) {
      rows_.who.resize(n * most_);
      rows_.weight.resize(n * most_);
      rows_.gradient.resize(n * most_);
    }
    std::atomic<bool> full{false};
    std::atomic<std::size_t> plain{0};
    tbb::parallel_for(0, cells.ny() * cells.nz(), [&](int row) {
      if (!fill_row(cells, row % cells.ny(), row / cells.ny(), place, normal, candidates.local()))
        full = true;
      const std::size_t begin = cells.first()[cells.cell(0, row % cells.ny(), row / cells.ny())];
      const std::size_t end =
          cells.first()[cells.cell(cells.nx() - 1, row % cells.ny(), row / cells.ny()) + 1];
      std::size_t count = 0;
      for (std::size_t i = begin; i < end; ++i) count += sums_.correction[0][i][3] > 0 ? 1 : 0;
      plain += count;
    });
    complete = !full;
    uncorrected_ = plain;
    if (full) most_ *= 2;
  }
}

bool NeighbourFinder::fill_row(const CellOrder& cells, int y, int z, const std::vector<Four>& place,
                               const std::vector<Four>& normal, Candidates& near) {
  const std::vector<std::uint32_t>& first = cells.first();
  const int nx = cells.nx();
  const int ny = cells.ny();
  std::size_t next = first[cells.cell(0, y, z)] * most_;
  const std::size_t limit = first[cells.cell(nx - 1, y, z) + 1] * most_;
  const float reach2 = kernel_.support * kernel_.support;
  for (int x = 0; x < nx; ++x) {
    const std::uint32_t begin = first[cells.cell(x, y, z)];
    const std::uint32_t end = first[cells.cell(x, y, z) + 1];
    if (begin == end) continue;
    near.clear();
    for (int dz = -1; dz <= 1; ++dz) {
      const int cz = z + dz;
      if (cz < 0 || cz >= cells.nz()) continue;
      for (int dy = -1; dy <= 1; ++dy) {
        const int cy = (y + dy + ny) % ny;
        const float shift_y = y + dy < 0 ? -torus_.length_y : y + dy >= ny ? torus_.length_y : 0;
        const int low = std::max(x - 1, 0);
        const int high = std::min(x + 1, nx - 1);
        near.add(place, first[cells.cell(low, cy, cz)], first[cells.cell(high, cy, cz) + 1],
                 Four{0, shift_y, 0, 0});
        if (x == 0)
          near.add(place, first[cells.cell(nx - 1, cy, cz)], first[cells.cell(nx - 1, cy, cz) + 1],
                   Four{-torus_.length_x, shift_y, 0, 0});
        if (x == nx - 1)
          near.add(place, first[cells.cell(0, cy, cz)], first[cells.cell(0, cy, cz) + 1],
                   Four{torus_.length_x, shift_y, 0, 0});
      }
    }
    near.make_room();
    const std::size_t count = near.x.size();
    for (std::uint32_t i = begin; i < end; ++i) {
      const Four at = place[i];
      const std::size_t hits =
          pick_near(near.x.data(), near.y.data(), near.z.data(), count, at[0], at[1], at[2], kernel_.support,
                    near.square.data(), near.hit.data(), near.hit_square.data());
      if (next + 2 * hits > limit) return false;
      pulls(near.hit_square.data(), hits, kernel_, volume_, near.pull.data());
      Four moment[3] = {};
      Four crowding{};
      float diagonal = 0;
      const auto add = [&](std::uint32_t who, const Four& way, float pull) {
        const Four g = way * pull;
        const float weight = 2 * pull;
        moment[0] += way * g[0];
        moment[1] += way * g[1];
        moment[2] += way * g[2];
        crowding += g;
        rows_.who[next] = who;
        rows_.weight[next] = weight;
        rows_.gradient[next] = Four{g[0], g[1], g[2], weight};
        ++next;
        diagonal += weight;
      };
      rows_.begin[i] = next;
      for (std::size_t k = 0; k < hits; ++k) {
        const std::uint32_t h = near.hit[k];
        if (near.who[h] != i) add(near.who[h], near.place[h] - at, near.pull[k]);
      }
      rows_.images[i] = next;
      if (at[3] < kernel_.support) {
        Four beside[3] = {Four{1, 0, 0, 0}, Four{0, 1, 0, 0}, Four{0, 0, 1, 0}};
        invert(moment, least_beside, beside);
        for (int c = 0; c < 3; ++c) sums_.beside[c][i] = beside[c];
        const Four n = normal[i];
        for (std::size_t k = 0; k < hits; ++k) {
          const std::uint32_t h = near.hit[k];
          const float depth = near.place[h][3];
          const float square = near.hit_square[k] + 4 * at[3] * depth;
          if (square >= reach2) continue;
          add(near.who[h], near.place[h] - at - (2 * depth) * n, volume_ * kernel_.pull(std::sqrt(square)));
        }
      }
      rows_.end[i] = next;
      Four inverse[3] = {Four{1, 0, 0, 1}, Four{0, 1, 0, 0}, Four{0, 0, 1, 0}};
      invert(moment, least_whole, inverse);
      for (int c = 0; c < 3; ++c) sums_.correction[c][i] = inverse[c];
      crowding[3] = 0;
      sums_.crowding[i] = crowding;
      sums_.diagonal[i] = diagonal;
    }
  }
  return true;
}

}  // namespace aeolian::sph
