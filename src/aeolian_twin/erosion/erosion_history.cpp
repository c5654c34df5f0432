#include "aeolian_twin/erosion/erosion_history.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "aeolian_core/measure/power_spectrum.hpp"
#include "aeolian_core/measure/ripple_statistics.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/resample.hpp"

namespace aeolian {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr int strip_cells = 8;  ///< across the wind: crests are longer, noise is not

HeightMap::Layer depth_on_ground(const HeightMap& map) {
  HeightMap::Layer depth = map.layer(layer::elevation);
  if (map.has(layer::ground))
    for (std::size_t i = 0; i < depth.size(); ++i) depth[i] -= map.layer(layer::ground)[i];
  return depth;
}

double deviation_of(const HeightMap::Layer& depth) {
  double n = 0, sum = 0, squares = 0;
  for (const float d : depth)
    if (std::isfinite(d)) {
      ++n;
      sum += d;
      squares += static_cast<double>(d) * d;
    }
  return n > 0 ? std::sqrt(std::max(0.0, squares / n - sum * sum / n / n)) : unknown;
}

}  // namespace

double crest_wavelength(const GridGeometry& g, const HeightMap::Layer& values, double direction) {
  const double c = std::cos(direction);
  const double s = std::sin(direction);
  const double side = std::min(g.length_x(), g.length_y()) / std::max(1.0, std::abs(c) + std::abs(s));
  // Along an axis of the grid the whole map, else the largest square in it.
  const bool east_west = std::abs(s) < 1e-6;
  const bool on_axis = east_west || std::abs(c) < 1e-6;
  const double length = !on_axis ? side : east_west ? g.length_x() : g.length_y();
  const double width = !on_axis ? side : east_west ? g.length_y() : g.length_x();
  const int count = static_cast<int>(length / g.cell());
  const int count_across = static_cast<int>(width / g.cell());
  if (count < 16) return unknown;
  PowerSpectrum spectrum(static_cast<std::size_t>(count), g.cell());
  const std::vector<double> wavenumber = spectrum.wavenumber();
  std::vector<double> total(wavenumber.size(), 0);
  const double x0 = g.origin_x() + 0.5 * g.length_x();
  const double y0 = g.origin_y() + 0.5 * g.length_y();
  for (int strip = 0; strip + strip_cells <= count_across; strip += strip_cells) {
    std::vector<double> profile(static_cast<std::size_t>(count), 0);
    double mean = 0;
    for (int i = 0; i < count; ++i) {
      double& height = profile[static_cast<std::size_t>(i)];
      for (int j = strip; j < strip + strip_cells; ++j) {
        const double along = (i + 0.5 - 0.5 * count) * g.cell();
        const double across = (j + 0.5 - 0.5 * count_across) * g.cell();
        height += sample(g, values, x0 + along * c - across * s, y0 + along * s + across * c) / strip_cells;
      }
      mean += height / count;
    }
    if (!std::isfinite(mean)) continue;
    for (double& height : profile) height -= mean;
    const std::vector<double> density = spectrum.density(profile);
    for (std::size_t i = 0; i < total.size(); ++i) total[i] += density[i];
  }
  // Equal variance in each factor of the wavelength counts the same; smoothed over an eighth.
  double best = 0;
  double wavelength = unknown;
  for (double l = length / 4; l > 4 * g.cell(); l /= 1.02) {
    double weighted = 0, weights = 0;
    for (std::size_t i = 0; i < total.size(); ++i) {
      const double off = std::log(wavenumber[i] * l) / 0.12;
      if (std::abs(off) > 4) continue;
      const double weight = std::exp(-0.5 * off * off) / wavenumber[i];
      weighted += weight * total[i] * wavenumber[i];
      weights += weight;
    }
    if (weights > 0 && weighted / weights > best) {
      best = weighted / weights;
      wavelength = l;
    }
  }
  return wavelength < length / 4.1 ? wavelength : unknown;
}

ErosionHistory run_erosion(HeightMap& map, ParticleErosion& model, const BlowingWind& blowing,
                           const Grain& grain, double duration, int frames,
                           const std::function<void(const HeightMap&, int)>& keep,
                           const std::function<void(double)>& progress) {
  if (!(duration > 0 && std::isfinite(duration)))
    throw Error("erosion run: the duration is " + std::to_string(duration) + " s, must be positive");
  ErosionHistory run;
  HeightMap::Layer before;
  WindField wind = blowing.model.solve(blowing.input, &map);
  const double part = duration / frames;
  const int solved = blowing.every > 0 ? std::max(1, static_cast<int>(std::lround(part / blowing.every))) : 1;
  const auto observe = [&](double time) {
    const HeightMap::Layer depth = depth_on_ground(map);
    ErosionMoment m;
    m.time = time;
    m.deviation = deviation_of(depth);
    m.wavelength = crest_wavelength(map.geometry(), depth, blowing.input.direction);
    m.speed = unknown;
    if (!before.empty() && std::isfinite(m.wavelength)) {
      const auto shift =
          pattern_displacement(map.geometry(), before, depth, blowing.input.direction, 0.5 * m.wavelength);
      if (shift) m.speed = *shift / part;
    }
    std::size_t bare = 0, sintered = 0;
    for (std::size_t i = 0; i < depth.size(); ++i) {
      bare += depth[i] < static_cast<float>(grain.diameter) ? 1 : 0;
      if (map.has("sintered"))
        sintered += map.layer("sintered")[i] > 0 &&
                            depth[i] - map.layer("sintered")[i] < static_cast<float>(grain.diameter)
                        ? 1
                        : 0;
    }
    m.bare = static_cast<double>(bare) / static_cast<double>(depth.size());
    m.sintered = static_cast<double>(sintered) / static_cast<double>(depth.size());
    m.airborne = model.airborne_volume();
    m.error = run.volume.error();
    run.moments.push_back(m);
    before = depth;
  };
  observe(0);
  keep(map, 0);
  for (int frame = 1; frame <= frames; ++frame) {
    const auto start = std::chrono::steady_clock::now();
    for (int n = 0; n < solved; ++n) {
      if (blowing.every > 0) {
        WindInput input = blowing.input;
        input.time = part * (frame - 1) + part * n / solved;
        wind = blowing.model.solve(input, &map);
      }
      const VolumeBalance more = model.advance(map, wind, grain, part / solved).volume;
      run.volume.moved += more.moved;
      run.volume.change += more.change;
      run.volume.inflow += more.inflow;
      run.volume.outflow += more.outflow;
    }
    run.computing_time += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    observe(duration * frame / frames);
    keep(map, frame);
    progress(static_cast<double>(frame) / frames);
  }
  run.counts = model.counts();
  return run;
}

}  // namespace aeolian
