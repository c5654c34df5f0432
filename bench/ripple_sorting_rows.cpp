#include <algorithm>
#include <cmath>

#include "../test/aeolian_core/bedforms/sorting/sorted_experiments.hpp"
#include "ripple_rows.hpp"

#include "aeolian_core/bedforms/sorting/sub_grid_roughness.hpp"

namespace aeolian {
namespace {

using E = SortedExperiment;

void one_size(AccuracyTable& table) {
  const GridGeometry g(0, 0, 0.002, 160, 80);
  SortedRippleParameters p = E::parameters();
  p.coarse_diameter = E::fine().grain.diameter;
  p.active_layer = 50;
  for (const double times : {1.0, 5.0}) {
    std::vector<double> one = rough_bed(g, 3e-5);
    SortedBed two(g, one, p.layers());
    RippleModel(p.ripples).advance(g, one, E::fine(0.5), times * E::unit_time);
    SortedRippleModel(p).advance(two, sorted_forcing(E::fine(0.5), p.coarse_diameter), times * E::unit_time);
    double difference = 0;
    double square = 0;
    for (std::size_t i = 0; i < one.size(); ++i) {
      difference = std::max(difference, std::abs(one[i] - two.height[i]));
      square += one[i] * one[i] / static_cast<double>(one.size());
    }
    table.row(fmt::format("two sizes alike against RippleModel after {:g} a/K0, greatest difference over rms "
                          "height",
                          times),
              0, difference / std::sqrt(square), times > 1 ? 0.03 : 1e-9);
  }
}

void waves(AccuracyTable& table) {
  for (const double hops : {4.0, 8.0, 16.0})
    for (const double fraction : {0.2, 0.5}) {
      const WaveGrowth fixed = growth_of_a_sorted_wave(hops, 1e7, fraction);
      table.relative_row(
          fmt::format("growth rate [1/s], {:g} a, {:g} coarse, fixed composition", hops, fraction),
          fixed.theory.real(), fixed.model.real(), 0.01);
    }
  for (const double hops : {4.0, 8.0, 16.0}) {
    const WaveGrowth coupled = growth_of_a_sorted_wave(hops, 2, 0.3);
    table.relative_row(fmt::format("growth rate [1/s], {:g} a, 0.3 coarse, with the active layer", hops),
                       coupled.theory.real(), coupled.model.real(), 0.01);
    table.relative_row(fmt::format("turning [1/s], {:g} a, 0.3 coarse, with the active layer", hops),
                       coupled.theory.imag(), coupled.model.imag(), 0.01);
  }
}

void armouring(AccuracyTable& table) {
  for (const double mobility : {0.0, 0.2, 2.0})
    for (const double time : {10.0, 1000.0}) {
      const SortedBed bed = armoured_bed(mobility, time);
      table.row(fmt::format("coarse fraction of the surface, K_c / K_f {:g}, {:g} s", mobility, time),
                armoured_fraction(E::erosion_rate, mobility * E::erosion_rate, E::coarse_fraction,
                                  bed.layers.active, time),
                bed.surface_fraction(9), 0.007);
    }
}

void crests(AccuracyTable& table) {
  const GridGeometry g(0, 0, 0.002, 200, 120);
  for (const double degrees : {0.0, 30.0, 45.0}) {
    SortedBed bed(g, rough_bed(g, 3e-4), E::parameters().layers());
    const double coarse = bed.coarse_volume();
    double moved = 0;
    const SortedRippleModel model(E::parameters());
    std::vector<double> enrichment;
    for (int n = 0; n < 4; ++n) {
      moved += model.advance(bed, E::forcing(degrees * M_PI / 180), 150).coarse.moved;
      enrichment.push_back(crest_enrichment(bed));
    }
    table.statement(
        fmt::format(
            "coarse fraction, highest less lowest tenth, after 2.5, 5, 7.5, 10 min, wind {:g}°: positive",
            degrees),
        fmt::format("{:.2f}, {:.2f}, {:.2f}, {:.2f}", enrichment[0], enrichment[1], enrichment[2],
                    enrichment[3]),
        *std::min_element(enrichment.begin(), enrichment.end()) > 0);
    table.row(fmt::format("coarse volume lost, over what moved, wind {:g}°", degrees), 0,
              (bed.coarse_volume() - coarse) / moved, 1e-9);
  }
}

void roughness(AccuracyTable& table) {
  Forcing wind;
  wind.grain.diameter = 0.001;
  const double d = wind.grain.effective_diameter();
  wind.ejection_rate = 0.25 / (d * d);
  wind.reptation_length = 0.04;
  const RoughnessLaw law = roughness_law(sorted_forcing(wind, 0.001), 0, 0.002, RippleParameters{});
  double time = 0;
  while (law.after(0, time) < 0.95 * d) time += 0.01;
  table.range_row("time to 95 % of one grain of mottling, a quarter of the grains ejected per second [s]", 0,
                  10, time);
}

}  // namespace

void sorting_rows(AccuracyTable& table) {
  table.section("Two sizes of grains",
                "0.25 and 0.5 mm, fine ones hop a = 1 cm at K0 = 0.1 mm/s, coarse ones by sorted_forcing(), "
                "impacts at 10°. Growth against linear theory of the mixture (SortedGrowth), twenty cells to "
                "a hop; armouring of a bed that nothing falls on against the well-mixed layer's closed form. "
                "Anderson & Bunas (1993) and Manukyan & Prigozhin (2009) found coarse crests; they are "
                "compared in sign only.");
  one_size(table);
  waves(table);
  armouring(table);
  crests(table);
  roughness(table);
}

}  // namespace aeolian
