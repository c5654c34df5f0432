#include "aeolian_core/slide/mpm/snow_body.hpp"

#include <cmath>

#include "aeolian_core/surface/random.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {

template <int Dim>
std::vector<MaterialPoint<Dim>> filled_box(const SnowBox<Dim>& box, const SnowLaw& law, double cell,
                                           double particles_per_cell, double jitter, std::uint64_t seed) {
  constexpr Require require{"snow"};
  require(box.size.minCoeff() > 0 && box.size.allFinite(), "size of a body", box.size.minCoeff(), "positive");
  require(cell > 0 && std::isfinite(cell), "cell", cell, "positive");
  require(particles_per_cell >= 0.5 && particles_per_cell <= 1000, "particles per cell", particles_per_cell,
          "from 0.5 to 1000");
  const double spacing = cell / std::pow(particles_per_cell, 1. / Dim);
  long counts[3] = {1, 1, 1};
  double all = 1;
  for (int d = 0; d < Dim; ++d) {
    counts[d] = std::max(1L, static_cast<long>(std::ceil(box.size[d] / spacing * (1 - 1e-9))));
    all *= static_cast<double>(counts[d]);
  }
  require(all <= 1e8, "number of particles", all, "at most 1e8");
  const double volume = box.size.prod() / all;
  std::vector<MaterialPoint<Dim>> points;
  points.reserve(static_cast<std::size_t>(all));
  for (long k = 0; k < counts[2]; ++k)
    for (long j = 0; j < counts[1]; ++j)
      for (long i = 0; i < counts[0]; ++i) {
        const long at[3] = {i, j, k};
        RandomStream random(seed, points.size());
        Point<Dim> local;
        for (int d = 0; d < Dim; ++d) {
          const double moved = jitter > 0 ? jitter * (2 * random.uniform() - 1) : 0;
          local[d] =
              (static_cast<double>(at[d]) + 0.5 + moved) * box.size[d] / static_cast<double>(counts[d]);
        }
        MaterialPoint<Dim> point;
        point.place = box.corner + box.axes * local;
        point.mass = law.density * volume;
        point.volume = volume;
        point.alpha = law.initial_compaction();
        points.push_back(point);
      }
  return points;
}

template std::vector<MaterialPoint<2>> filled_box(const SnowBox<2>&, const SnowLaw&, double, double, double,
                                                  std::uint64_t);
template std::vector<MaterialPoint<3>> filled_box(const SnowBox<3>&, const SnowLaw&, double, double, double,
                                                  std::uint64_t);

}  // namespace aeolian
