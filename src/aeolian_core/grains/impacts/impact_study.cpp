#include "aeolian_core/grains/impacts/impact_study.hpp"

#include <mutex>

#include <tbb/parallel_for.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {

template <int Dim>
Shot series_shot(const Bed<Dim>& bed, const ImpactSeries& series, int number) {
  RandomStream random(series.seed, static_cast<std::uint64_t>(number));
  Shot shot;
  shot.speed = series.speed;
  shot.angle = series.angle;
  shot.size_ratio = series.size_ratio;
  if constexpr (Dim == 2) {
    shot.along = 0.5 * bed.length + series.spread * bed.radius * (2 * random.uniform() - 1);
  } else {  // one place is like another where all sides are periodic
    shot.along = bed.length * random.uniform();
    shot.across = bed.width * random.uniform();
  }
  return shot;
}

template <int Dim>
std::vector<ImpactOutcome> fire_series(const std::vector<Bed<Dim>>& beds, const ImpactSeries& series,
                                       const ImpactRules& rules, const ImpactDone& done,
                                       const std::atomic<bool>* stop,
                                       const std::vector<ImpactOutcome>& known) {
  if (beds.empty()) throw Error("impacts: there is no bed");
  const auto count = static_cast<std::size_t>(series.impacts);
  std::vector<ImpactOutcome> outcomes(count);
  std::vector<char> there(count, 0);
  std::mutex telling;
  int finished = 0;
  for (const ImpactOutcome& outcome : known) {
    if (outcome.number < 0 || outcome.number >= series.impacts) continue;
    const auto i = static_cast<std::size_t>(outcome.number);
    outcomes[i] = outcome;
    there[i] = 1;
    ++finished;
  }
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          if (stop && *stop) return;
          if (there[i]) continue;
          const Bed<Dim>& bed = beds[i % beds.size()];
          outcomes[i] = fire<Dim>(bed, series_shot(bed, series, static_cast<int>(i)), rules);
          outcomes[i].number = static_cast<int>(i);
          there[i] = 1;
          const std::lock_guard<std::mutex> lock(telling);
          ++finished;
          if (done) done(outcomes[i], finished);
        }
      },
      tbb::simple_partitioner());
  std::vector<ImpactOutcome> result;
  for (std::size_t i = 0; i < count; ++i)
    if (there[i]) result.push_back(std::move(outcomes[i]));
  return result;
}

template std::vector<ImpactOutcome> fire_series(const std::vector<Bed<2>>&, const ImpactSeries&,
                                                const ImpactRules&, const ImpactDone&,
                                                const std::atomic<bool>*, const std::vector<ImpactOutcome>&);
template std::vector<ImpactOutcome> fire_series(const std::vector<Bed<3>>&, const ImpactSeries&,
                                                const ImpactRules&, const ImpactDone&,
                                                const std::atomic<bool>*, const std::vector<ImpactOutcome>&);
template Shot series_shot(const Bed<2>&, const ImpactSeries&, int);
template Shot series_shot(const Bed<3>&, const ImpactSeries&, int);

}  // namespace aeolian
