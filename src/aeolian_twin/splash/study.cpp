#include "aeolian_twin/splash/study.hpp"

#include <mutex>
#include <optional>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

/// A seed of its own for each purpose of a study.
std::uint64_t derived_seed(std::uint64_t seed, std::uint64_t purpose, std::uint64_t number) {
  const auto bits = Philox(seed)(number, purpose);
  return std::uint64_t{bits[1]} << 32 | bits[0];
}
constexpr std::uint64_t for_beds = 1;
constexpr std::uint64_t for_impacts = 2;

}  // namespace

template <int Dim>
double StudyBeds<Dim>::roughness(std::size_t kind) const {
  double sum = 0;
  for (const Bed<Dim>& bed : kinds[kind]) sum += bed.state.roughness;
  return sum / static_cast<double>(kinds[kind].size());
}

template <int Dim>
StudyBeds<Dim> lay_beds(const StudySettings& study, const StudyProgress& progress,
                        const std::atomic<bool>& stop) {
  std::vector<std::pair<std::size_t, std::uint64_t>> orders;
  for (std::size_t kind = 0; kind < study.beds.size(); ++kind)
    for (int i = 0; i < study.beds[kind].number; ++i)
      orders.emplace_back(kind,
                          derived_seed(study.seed, for_beds, 1000 * kind + static_cast<std::uint64_t>(i)));
  std::vector<std::optional<Bed<Dim>>> laid(orders.size());
  std::mutex telling;
  double done = 0;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, orders.size(), 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          if (stop) return;
          const auto& [kind, seed] = orders[i];
          laid[i] = make_bed<Dim>(study.beds[kind].recipe, study.world<Dim>(), seed);
          const std::lock_guard<std::mutex> lock(telling);
          done += 1;
          progress(done / static_cast<double>(orders.size()), "beds settle");
        }
      },
      tbb::simple_partitioner());
  StudyBeds<Dim> beds;
  for (std::size_t i = 0; i < orders.size(); ++i) {
    if (!laid[i]) {
      if (!beds.kinds.empty() && beds.kinds.size() == orders[i].first + 1) beds.kinds.pop_back();
      break;
    }
    beds.kinds.resize(orders[i].first + 1);
    beds.kinds.back().push_back(std::move(*laid[i]));
  }
  return beds;
}

template <int Dim>
std::vector<StudyPoint> fire_all(const StudySettings& study, const StudyBeds<Dim>& beds,
                                 StudyJournal& journal, const StudyProgress& progress,
                                 const std::atomic<bool>& stop) {
  std::vector<StudyPoint> points;
  for (std::size_t kind = 0; kind < beds.kinds.size(); ++kind)
    for (const double ratio : study.size_ratios)
      for (const double angle : study.angles)
        for (const double speed : study.speeds)
          points.push_back({kind, speed, angle, ratio, beds.roughness(kind), {}, {}});
  std::size_t finished = 0;
  for (StudyPoint& point : points) {
    if (stop) break;
    ImpactSeries series;
    series.speed = point.speed;
    series.angle = point.angle;
    series.size_ratio = point.size_ratio;
    series.impacts = study.impacts;
    series.seed = derived_seed(study.seed, for_impacts, finished);
    const auto& of_kind = beds.kinds[point.kind];
    const auto tell = [&](const ImpactOutcome& outcome, int done) {
      journal.add(finished, outcome);
      const double share = (static_cast<double>(finished) + static_cast<double>(done) / study.impacts) /
                           static_cast<double>(points.size());
      progress(share, fmt::format("impacts at {:.3g} m/s, {:.3g}°", point.speed, point.angle * 180 / M_PI));
    };
    point.outcomes = fire_series<Dim>(of_kind, series, study.rules, tell, &stop, journal.done(finished));
    point.statistics = impact_statistics<Dim>(point.outcomes, of_kind.front());
    ++finished;
  }
  points.resize(finished);
  return points;
}

template struct StudyBeds<2>;
template struct StudyBeds<3>;
template StudyBeds<2> lay_beds(const StudySettings&, const StudyProgress&, const std::atomic<bool>&);
template StudyBeds<3> lay_beds(const StudySettings&, const StudyProgress&, const std::atomic<bool>&);
template std::vector<StudyPoint> fire_all(const StudySettings&, const StudyBeds<2>&, StudyJournal&,
                                          const StudyProgress&, const std::atomic<bool>&);
template std::vector<StudyPoint> fire_all(const StudySettings&, const StudyBeds<3>&, StudyJournal&,
                                          const StudyProgress&, const std::atomic<bool>&);

}  // namespace aeolian
