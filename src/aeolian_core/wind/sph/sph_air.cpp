#include "aeolian_core/wind/sph/sph_air.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/wind/log_law.hpp"

namespace aeolian::sph {
namespace {

constexpr float kappa = static_cast<float>(von_karman);
constexpr float contact = 0.1F;     ///< no particle comes closer to a wall [spacings]
constexpr float fastest_wind = 20;  ///< of the surroundings' that is still a wind
constexpr float still = 0.5F;       ///< speed below which steps grow no longer
constexpr int first_iterations = 400;

/// Of an acceleration by what rubs along a wall, so that its integral over the distance is one.
float skin(float distance) { return distance < 1 ? 2 * (1 - distance) : 0; }

}  // namespace

float Upwind::speed(float height) const {
  if (friction <= 0) return 1;
  return height > roughness ? friction / kappa * std::log(height / roughness) : 0;
}

Four SphAir::given_wind(float height) const {
  const float speed = upwind_.speed(height);
  return Four{upwind_.east * speed, upwind_.north * speed, 0, 0};
}

float SphAir::ring(float x, float y) const {
  const BoxPlace& p = ground_.place();
  const auto share = [](float at, float length, float width) {
    if (width <= 0) return 0.0F;
    const float t = std::clamp(1 - std::min(at, length - at) / width, 0.0F, 1.0F);
    return t * t * (3 - 2 * t);
  };
  const float sx = share(x, torus_.length_x, p.ring_x);
  const float sy = share(y, torus_.length_y, p.ring_y);
  return 1 - (1 - sx) * (1 - sy);
}

void SphAir::order() {
  cells_.sort(place_);
  const std::vector<std::uint32_t>& order = cells_.order();
  for (std::vector<Four>* values : {&place_, &motion_}) {
    sorted_.resize(values->size());
    for_chunks(values->size(), [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) sorted_[i] = (*values)[order[i]];
    });
    values->swap(sorted_);
  }
}

void SphAir::see_walls() {
  normal_.resize(size());
  const float support = settings_.support;
  std::vector<std::size_t> lifted(chunks_of(size()), 0);
  std::vector<std::size_t> lowered(chunks_of(size()), 0);
  for_chunks(size(), [&](std::size_t c, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Four& p = place_[i];
      ground_.nearest(p, normal_[i], support);
      if (p[3] < contact) {
        if (p[3] < -contact) ++lifted[c];
        const float up = contact - p[3];
        const Four moved = p + up * normal_[i];
        p = Four{wrapped(moved[0], torus_.length_x), wrapped(moved[1], torus_.length_y),
                 std::min(std::max(moved[2], contact), torus_.height - contact), contact};
      }
      float under = torus_.height - p[2];
      if (under < contact) {
        if (under < -contact) ++lowered[c];
        p[2] = torus_.height - contact;
        under = contact;
      }
      if (under < p[3]) {
        p[3] = under;
        normal_[i] = Four{0, 0, -1, 0};
      }
    }
  });
  for (std::size_t c = 0; c < lifted.size(); ++c) {
    guards_.lifted += lifted[c];
    guards_.lowered += lowered[c];
  }
}

void SphAir::differentiate() {
  for (std::vector<Four>& s : slope_) s.resize(size());
  bend_.resize(size());
  const NeighbourRows& rows = finder_.rows();
  const NeighbourSums& sums = finder_.sums();
  const float level = ground_.level();
  const float eddy = kappa * upwind_.friction;
  // Mixing over a length that grows with the height.
  const auto mixing = [&](std::size_t i) {
    const float height = normal_[i][2] > 0 && place_[i][3] < settings_.support
                             ? place_[i][3]
                             : std::max(place_[i][2] - level, 1.0F);
    return settings_.viscosity + eddy * height;
  };
  for_chunks(size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Four own = motion_[i];
      Four along[3] = {};
      Four bend{};
      const float mine = mixing(i);
      for (std::size_t k = rows.begin[i]; k < rows.images[i]; ++k) {
        const Four g = rows.gradient[k];
        const std::size_t j = rows.who[k];
        const Four d = motion_[j] - own;
        along[0] += d * g[0];
        along[1] += d * g[1];
        along[2] += d * g[2];
        bend += d * (eddy > 0 ? 0.5F * g[3] * (mine + mixing(j)) : g[3] * mine);
      }
      for (std::size_t k = rows.images[i]; k < rows.end[i]; ++k) {
        const Four g = rows.gradient[k];
        const Four d = mirrored(motion_[rows.who[k]], normal_[i]) - own;
        along[0] += d * g[0];
        along[1] += d * g[1];
        along[2] += d * g[2];
        bend += d * (g[3] * mine);
      }
      for (int axis = 0; axis < 3; ++axis) {
        const Four c = sums.correction[axis][i];
        slope_[axis][i] = along[0] * c[0] + along[1] * c[1] + along[2] * c[2];
      }
      bend_[i] = bend;
    }
  });
}

void SphAir::damp() {
  const NeighbourRows& rows = finder_.rows();
  for_chunks(size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Four sum{};
      for (std::size_t k = rows.begin[i]; k < rows.images[i]; ++k) {
        const std::size_t j = rows.who[k];
        const Four g = rows.gradient[k];
        // What the derivatives on both sides tell is resolved, and kept.
        const Four told = (slope_[0][i] + slope_[0][j]) * g[0] + (slope_[1][i] + slope_[1][j]) * g[1] +
                          (slope_[2][i] + slope_[2][j]) * g[2];
        sum += (motion_[j] - motion_[i]) * g[3] - told;
      }
      bend_[i] += settings_.damping * sum;
    }
  });
}

void SphAir::press() {
  pressure_.resize(size());
  source_.resize(size());
  force_.resize(size());
  const float ahead = implicitness * dt_;
  for_chunks(size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      source_[i] = (slope_[0][i][0] + slope_[1][i][1] + slope_[2][i][2]) / ahead;
      pressure_[i] = motion_[i][3];
    }
  });
  const float residual = settings_.residual / ahead;
  const float left =
      solver_.solve(finder_.rows(), finder_.sums().diagonal, source_,
                    {residual, time_ > 0 ? settings_.iterations : first_iterations}, pressure_);
  if (!(left <= 10 * residual)) ++guards_.unsolved;
  const NeighbourRows& rows = finder_.rows();
  // A wall that bends holds the air that runs along it by a slope of pressure, so the pressure's image is
  // that of its particle less this slope.
  wall_drop_.resize(size());
  for_chunks(size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      force_[i] = Four{};
      wall_drop_[i] = 0;
      const float own = pressure_[i];
      for (std::size_t k = rows.begin[i]; k < rows.images[i]; ++k)
        force_[i] += rows.gradient[k] * (pressure_[rows.who[k]] - own);
      if (place_[i][3] >= settings_.support) continue;
      Four beside{};
      for (int axis = 0; axis < 3; ++axis) beside += finder_.sums().beside[axis][i] * force_[i][axis];
      wall_drop_[i] = 2 * place_[i][3] * dot3(beside, normal_[i]);
    }
  });
  for_chunks(size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const float own = pressure_[i];
      Four sum = force_[i];
      for (std::size_t k = rows.images[i]; k < rows.end[i]; ++k)
        sum += rows.gradient[k] * (pressure_[rows.who[k]] - wall_drop_[rows.who[k]] - own);
      Four force{};
      for (int axis = 0; axis < 3; ++axis) force += finder_.sums().correction[axis][i] * sum[axis];
      force[3] = 0;
      force_[i] = force;
    }
  });
}

void SphAir::carry(std::size_t i, const Four& way) {
  const Four to = place_[i] + way;
  place_[i] = Four{wrapped(to[0], torus_.length_x), wrapped(to[1], torus_.length_y),
                   std::clamp(to[2], 0.0F, torus_.height), 0};
}

void SphAir::push() {
  const float dt = dt_;
  const float shifting = settings_.shifting * settings_.support * std::max(fastest_, still) * dt;
  greatest_.resize(chunks_of(size()));
  std::vector<std::size_t> slowed(chunks_of(size()), 0);
  const float lid_drag = upwind_.friction * upwind_.friction;
  for_chunks(size(), [&](std::size_t c, std::size_t begin, std::size_t end) {
    float most = 0;
    for (std::size_t i = begin; i < end; ++i) {
      Four u = motion_[i] - dt * force_[i];
      Four shift = -shifting * finder_.sums().crowding[i];
      const float length = std::sqrt(dot3(shift, shift));
      if (length > far_shift) shift *= far_shift / length;
      const Four way = (0.5F * dt) * u + shift;
      const Four at = place_[i];
      // What the air is, not where the particle was put.
      u += slope_[0][i] * shift[0] + slope_[1][i] * shift[1] + slope_[2][i] * shift[2];
      u += dt * bend_[i];
      if (upwind_.friction > 0 && at[3] < 1) {
        Four rub{};
        if (normal_[i][2] < 0) {
          rub = Four{upwind_.east, upwind_.north, 0, 0} * lid_drag;
        } else {
          const Four along = u - dot3(u, normal_[i]) * normal_[i];
          const float speed = std::sqrt(dot3(along, along));
          const float drag = kappa / std::log(std::max(at[3], 2 * upwind_.roughness) / upwind_.roughness);
          rub = along * (-drag * drag * speed);
          const float stop = dt * skin(at[3]) * drag * drag * speed;
          if (stop > 0.5F) rub *= 0.5F / stop;
        }
        u += rub * (dt * skin(at[3]));
      }
      const float given = ring(at[0], at[1]);
      if (given > 0) {
        const float part = 1 - std::exp(-settings_.ring_rate * given * dt);
        u += (given_wind(at[2] - ground_.level()) - u) * part;
      }
      const float speed = std::sqrt(dot3(u, u));
      if (speed > fastest_wind) {
        ++slowed[c];
        u *= fastest_wind / speed;
      }
      most = std::max(most, std::min(speed, fastest_wind));
      u[3] = pressure_[i] + dt * dot3(u, force_[i]);
      motion_[i] = u;
      carry(i, way);
    }
    greatest_[c] = most;
  });
  fastest_ = greatest_.empty() ? 0 : *std::max_element(greatest_.begin(), greatest_.end());
  for (const std::size_t n : slowed) guards_.slowed += n;
}

void SphAir::step() {
  // Air at rest is asked again after the time in which a wind of its scale would cross a spacing.
  dt_ = settings_.step * settings_.support / std::max(fastest_, still);
  for_chunks(size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) carry(i, (0.5F * dt_) * motion_[i]);
  });
  order();
  see_walls();
  finder_.find(cells_, place_, normal_);
  differentiate();
  damp();
  press();
  push();
  time_ += static_cast<double>(dt_);
}

std::vector<float> SphAir::density() {
  order();
  see_walls();
  finder_.find(cells_, place_, normal_);
  const NeighbourRows& rows = finder_.rows();
  std::vector<float> result(size());
  for_chunks(size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      float sum = finder_.kernel().value(0);
      for (std::size_t k = rows.begin[i]; k < rows.end[i]; ++k) {
        const Four way = rows.gradient[k] * (2 / rows.weight[k]);
        sum += finder_.kernel().value(std::sqrt(dot3(way, way)));
      }
      result[i] = finder_.volume() * sum;
    }
  });
  return result;
}

std::vector<float> SphAir::divergence() {
  order();
  see_walls();
  finder_.find(cells_, place_, normal_);
  differentiate();
  std::vector<float> result(size());
  for (std::size_t i = 0; i < size(); ++i) result[i] = slope_[0][i][0] + slope_[1][i][1] + slope_[2][i][2];
  return result;
}

double SphAir::energy() const {
  double sum = 0;
  for (const Four& u : motion_) sum += static_cast<double>(dot3(u, u));
  return sum / static_cast<double>(size());
}

}  // namespace aeolian::sph
