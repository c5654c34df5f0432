#include "aeolian_core/wind/sph/thesis_air.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/require.hpp"
#include "aeolian_core/wind/sph/lattice.hpp"

namespace aeolian::sph {
namespace {

constexpr Require require("thesis' air");
constexpr double gravity = 9.81;
constexpr double tait = 7;

/// (4.2), (4.8) and (4.11), three dimensions.
struct ThesisKernels {
  double h;
  double poly6(double r2) const {
    const double t = h * h - r2;
    return t > 0 ? 315 / (64 * M_PI * std::pow(h, 9)) * t * t * t : 0;
  }
  double spiky_slope(double r) const {
    const double t = h - r;
    return t > 0 ? 45 / (M_PI * std::pow(h, 6)) * t * t : 0;
  }
  double laplacian(double r) const { return r < h ? 45 / (M_PI * std::pow(h, 6)) * (h - r) : 0; }
};

}  // namespace

ThesisAir::ThesisAir(const AirGround& ground, const ThesisSettings& settings)
    : ground_(ground),
      settings_(settings),
      wind_{static_cast<float>(settings.wind * std::cos(settings.direction)),
            static_cast<float>(settings.wind * std::sin(settings.direction)), 0, 0},
      diameter_(settings.box / settings.side),
      mass_(settings.density * std::pow(diameter_, 3) * M_PI / 6),
      cells_({static_cast<float>(settings.side + 2 * settings.reach),
              static_cast<float>(settings.side + 2 * settings.reach),
              static_cast<float>(2 * settings.side + settings.reach) + ground.highest()},
             static_cast<float>(settings.reach)) {
  require(settings.side >= 4 && settings.side <= 64, "particles along a side", settings.side, "4 to 64");
  require(settings.reach >= 2 && settings.reach <= 4, "support over diameter", settings.reach, "2 to 4");
  require(settings.step > 0 && settings.step * settings.sound <= settings.reach * diameter_, "step",
          settings.step, "positive and at most what sound takes for a support [s]");
  const int n = settings.side + 2 * settings.reach;
  // Ghosts lie below the ground, heights count from their lowest.
  level_ = static_cast<float>(settings.reach);
  const auto add = [&](int x, int y, float relative) {
    const float px = static_cast<float>(x) + 0.5F;
    const float py = static_cast<float>(y) + 0.5F;
    place_.push_back(Four{px, py, level_ + ground_.height(px, py) + relative, 0});
    relative_.push_back(relative);
  };
  const auto within = [&](int i) { return i >= settings_.reach && i < n - settings_.reach; };
  for (const bool simulated : {true, false}) {
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x)
        for (int z = 0; z < settings.side && (within(x) && within(y)) == simulated; ++z)
          add(x, y, static_cast<float>(z) + 0.5F);
    (simulated ? simulated_ : ghosts_from_) = place_.size();
  }
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x)
      for (int z = 0; z < settings.reach; ++z) add(x, y, -static_cast<float>(z) - 0.5F);
  motion_.assign(place_.size(), wind_);
  std::fill(motion_.begin() + static_cast<std::ptrdiff_t>(ghosts_from_), motion_.end(), Four{});
  if (!settings.sphere_mass) {
    find();
    mass_ /= mean_density();
  }
}

void ThesisAir::find() {
  cells_.sort(place_);
  const std::vector<std::uint32_t>& order = cells_.order();
  sorted_.resize(place_.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    sorted_[i] = place_[order[i]];
    sorted_[i][3] = 0;
  }
  count_.assign(place_.size(), 0);
  near_count_.assign(place_.size(), 0);
  const ThesisKernels far{settings_.reach * diameter_};
  const ThesisKernels near{0.5 * diameter_};
  for_chunks(place_.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double sum = 0;
      double close = 0;
      for_near(cells_, sorted_, place_[i], static_cast<float>(settings_.reach),
               [&](std::size_t, const Four& way) {
                 const double r2 = static_cast<double>(dot3(way, way)) * diameter_ * diameter_;
                 sum += far.poly6(r2);
                 close += near.poly6(r2);
               });
      count_[i] = static_cast<float>(sum);
      near_count_[i] = static_cast<float>(close);
    }
  });
}

double ThesisAir::mean_density() const {
  double sum = 0;
  for (std::size_t i = 0; i < simulated_; ++i) sum += mass_ * static_cast<double>(count_[i]);
  return sum / (static_cast<double>(simulated_) * settings_.density);
}

double ThesisAir::mean_height() const {
  double sum = 0;
  for (std::size_t i = 0; i < simulated_; ++i) sum += static_cast<double>(relative_[i]) * diameter_;
  return sum / static_cast<double>(simulated_);
}

void ThesisAir::forces() {
  find();
  const std::size_t n = place_.size();
  pressure_.resize(n);
  near_pressure_.resize(n);
  force_.assign(n, Four{});
  const double rho = settings_.density;
  const double stiffness = settings_.sound * settings_.sound * rho / tait;
  for (std::size_t i = 0; i < n; ++i) {
    const double all =
        static_cast<double>(count_[i]) + (settings_.near_kernels ? static_cast<double>(near_count_[i]) : 0);
    pressure_[i] = static_cast<float>(stiffness * (std::pow(mass_ * all / rho, tait) - 1));
    count_[i] = static_cast<float>(all);
  }
  const ThesisKernels far{settings_.reach * diameter_};
  const ThesisKernels near{0.5 * diameter_};
  const std::vector<std::uint32_t>& order = cells_.order();
  for_chunks(simulated_, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double own = static_cast<double>(pressure_[i]) / std::pow(static_cast<double>(count_[i]), 2);
      double sum[3] = {0, 0, 0};
      for_near(cells_, sorted_, place_[i], static_cast<float>(settings_.reach),
               [&](std::size_t k, const Four& way) {
                 const std::size_t j = order[k];
                 const double r = std::sqrt(static_cast<double>(dot3(way, way))) * diameter_;
                 if (r < 1e-6 * diameter_) return;
                 const double other = static_cast<double>(count_[j]);
                 double slope = far.spiky_slope(r);
                 if (settings_.near_kernels) slope += near.spiky_slope(r);
                 // (4.6) pushes apart where the pressure is positive; (4.9) evens out.
                 const double press =
                     -(own + static_cast<double>(pressure_[j]) / (other * other)) * slope / r;
                 const double even = settings_.viscosity * settings_.density * far.laplacian(r) /
                                     (other * static_cast<double>(count_[i]));
                 for (int c = 0; c < 3; ++c)
                   sum[c] += press * static_cast<double>(way[c]) * diameter_ +
                             even * static_cast<double>(motion_[j][c] - motion_[i][c]);
               });
      for (int c = 0; c < 3; ++c) force_[i][c] = static_cast<float>(sum[c] / mass_);
    }
  });
}

void ThesisAir::evolve() {
  const auto dt = static_cast<float>(settings_.step);
  const auto wind = static_cast<float>(settings_.wind);
  const float limit = static_cast<float>(settings_.limit) * wind;
  const float move = dt / static_cast<float>(diameter_);
  const float length = cells_.torus().length_x;
  const auto reach = static_cast<float>(settings_.reach);
  constexpr float radius = 0.5F;
  std::size_t limited = 0;
  for (std::size_t i = 0; i < ghosts_from_; ++i) {
    Four& p = place_[i];
    Four& v = motion_[i];
    // simulationFactor: how much of a particle of the box is not yet in its ring.
    const float inside = std::min(std::min(p[0], length - p[0]), std::min(p[1], length - p[1])) - reach;
    const float factor = std::clamp(inside + radius, 0.0F, 1.0F);
    if (factor > 0) {
      v += dt * force_[i];
      // ApplyWind
      if (wind > 0) v += std::max(0.0F, wind - dot3(v, wind_) / wind) / wind * wind_;
      v *= static_cast<float>(settings_.friction);
      const float speed = std::sqrt(dot3(v, v));
      if (speed > limit && limit > 0) {
        v *= limit / speed;
        ++limited;
      }
      if (settings_.gravity) v[2] -= dt * static_cast<float>(gravity);
    }
    const Four way = move * (factor * v + (1 - factor) * wind_);
    const Four to = p + way;
    const bool wraps = to[0] < 0 || to[0] >= length || to[1] < 0 || to[1] >= length;
    const float x = to[0] - length * std::floor(to[0] / length);
    const float y = to[1] - length * std::floor(to[1] / length);
    const float ground = level_ + ground_.height(x, y);
    float z = to[2];
    if (factor <= 0 || wraps) {
      z = ground + relative_[i];  // Follows the terrain at every height.
      v = wind_;
    }
    if (z < ground + radius) {
      const float e = 0.5F;
      const float slope_x = (ground_.height(x + e, y) - ground_.height(x - e, y)) / (2 * e);
      const float slope_y = (ground_.height(x, y + e) - ground_.height(x, y - e)) / (2 * e);
      z = ground + radius;
      v[2] = v[0] * slope_x + v[1] * slope_y;
    }
    z = std::min(z, cells_.torus().height);
    relative_[i] = z - ground;
    p = Four{x, y, z, 0};
  }
  limited_share_ = static_cast<double>(limited) / static_cast<double>(simulated_);
}

void ThesisAir::step() {
  forces();
  evolve();
}

double ThesisAir::lift_divisor(double height, double wind, bool rising) {
  const double a = std::clamp(height, 50.0, 900.0);
  const double at_height = rising
                               ? 12.246 + a * (-4.341e-2 + a * (1.896e-4 + a * (-2.508e-7 + a * 1.262e-10)))
                               : 12.766 + a * (-5.343e-2 + a * (1.451e-4 + a * (-1.263e-7 + a * 5.227e-11)));
  return at_height * (2.0472 / wind + 0.3032);
}

}  // namespace aeolian::sph
