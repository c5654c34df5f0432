#include "aeolian_core/slide/mpm/material_points.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "aeolian_core/slide/mpm/block_grid.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr double strain_allowed = 1;      ///< of dt grad v: more turns a particle inside out
constexpr double strain_aimed_at = 0.25;  ///< steps are shortened to stay below
constexpr double waking = 3;              ///< nodes this much faster than rest wake a block

void check(const MpmSettings& s) {
  constexpr Require require{"mpm"};
  require(s.cell > 0 && std::isfinite(s.cell), "cell", s.cell, "positive");
  require(s.flip_share >= 0 && s.flip_share <= 1, "share of FLIP", s.flip_share, "from 0 to 1");
  require(s.courant > 0 && s.courant <= 0.7, "Courant number", s.courant, "above 0 and at most 0.7");
  require(s.time_step >= 0 && std::isfinite(s.time_step), "time step", s.time_step, "at least 0");
  require(std::isfinite(s.gravity), "gravity", s.gravity, "finite");
  require(s.rest_speed >= 0 && std::isfinite(s.rest_speed), "rest speed", s.rest_speed, "at least 0");
  require(s.rest_patience >= 0 && std::isfinite(s.rest_patience), "rest patience", s.rest_patience,
          "at least 0");
  require(s.threads >= 0 && s.threads <= 1024, "threads", s.threads, "from 0 to 1024");
}

}  // namespace

template <int Dim>
class MaterialPoints<Dim>::Engine {
 public:
  Engine(const MpmSettings& settings, const SnowLaw& law, std::vector<Obstacle<Dim>> obstacles)
      : settings_(settings),
        law_(law),
        constants_(yield_constants(law, Dim)),
        grid_(settings.cell, std::move(obstacles)) {
    aeolian::check(law);
    check(settings);
    longest_ = settings.courant * settings.cell / law.wave_speed();
    if (settings.time_step > longest_ * (1 + 1e-12))
      throw Error(
          fmt::format("mpm: time step is {:g} s, must be at most {:.3g} s = {:g} cells of {:g} m at the "
                      "speed of elastic waves, "
                      "{:.3g} m/s: longer ones are unstable",
                      settings.time_step, longest_, settings.courant, settings.cell, law.wave_speed()));
    if (settings.time_step > 0) longest_ = settings.time_step;
    gravity_ = Point<Dim>::Zero();
    gravity_[Dim - 1] = -settings.gravity;
    constexpr int all = tbb::task_arena::automatic;
    if (settings.threads != 1)
      arena_ = std::make_unique<tbb::task_arena>(settings.threads > 0 ? settings.threads : all);
  }

  void add(const std::vector<MaterialPoint<Dim>>& points) {
    std::vector<Passenger<Dim>> newcomers;
    newcomers.reserve(points.size());
    for (const MaterialPoint<Dim>& point : points) {
      if (!(point.place.allFinite() && point.velocity.allFinite() && point.affine.allFinite() &&
            point.b.allFinite() && std::isfinite(point.alpha)))
        throw Error(fmt::format("snow: particle {} is not finite", size_ + newcomers.size()));
      constexpr Require require{"snow"};
      require(point.mass > 0 && std::isfinite(point.mass), "mass of a particle", point.mass, "positive");
      require(point.volume > 0 && std::isfinite(point.volume), "volume of a particle", point.volume,
              "positive");
      newcomers.push_back(passenger_of<Dim>(point, static_cast<int>(size_ + newcomers.size())));
      heaviest_ = std::max(heaviest_, point.mass);
      fastest_ = std::max(fastest_, point.velocity.norm());
      most_gradient_ = std::max(most_gradient_, point.affine.cwiseAbs().maxCoeff());
    }
    size_ += points.size();
    grid_.hand_over(std::move(newcomers));
    for (const int k : grid_.awake()) refresh_stress(block(k), constants_);
    drift_ = 0;
  }

  void advance(double duration) {
    constexpr Require require{"mpm"};
    require(duration >= 0 && std::isfinite(duration), "duration", duration, "at least 0 and finite");
    // Equal steps that fill the duration; where particles are fast, halves, quarters... of them.
    const double count = std::ceil(duration / longest_ * (1 - 1e-12));
    require(count < 1e12, "number of steps", count, "below 1e12");
    if (count == 0) return;
    const double whole = duration / count;
    const double start = time_;
    for (double step = 0; step < count; ++step) {
      if (grid_.awake().empty()) break;
      int parts = 1;
      while (whole / parts > allowed_step()) parts *= 2;
      for (int part = 0; part < parts; ++part) take_step(whole / parts);
      if (parts > 1) work_.shortened += parts;
      time_ = start + (step + 1) * whole;
    }
    time_ = start + duration;
  }

  std::vector<MaterialPoint<Dim>> points() const {
    std::vector<MaterialPoint<Dim>> result(size_);
    for (const ParticleBlock<Dim>& block : grid_.particles())
      for (const Pack<Dim>& pack : block.packs)
        for (int lane = 0; lane < lane_count; ++lane) {
          const Passenger<Dim> passenger = take_lane(pack, lane);
          if (passenger.id >= 0) result[static_cast<std::size_t>(passenger.id)] = point_of(passenger);
        }
    return result;
  }

  std::size_t awake() const {
    std::size_t count = 0;
    for (const int k : grid_.awake())
      count += static_cast<std::size_t>(grid_.particles()[static_cast<std::size_t>(k)].count);
    return count;
  }

  const MpmSettings settings_;
  const SnowLaw law_;
  double longest_ = 0;
  double time_ = 0;
  double fastest_ = 0;
  std::size_t size_ = 0;
  MpmWork work_;

 private:
  ParticleBlock<Dim>& block(int number) { return grid_.particles()[static_cast<std::size_t>(number)]; }

  template <class Each>
  void share(const std::vector<int>& numbers, Each each) {
    if (!arena_ || numbers.size() < 4) {
      for (const int number : numbers) each(number);
      return;
    }
    arena_->execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, numbers.size()),
                        [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t k = range.begin(); k < range.end(); ++k) each(numbers[k]);
                        });
    });
  }

  /// What particles allow: a part of a cell, and of their own size.
  double allowed_step() const {
    const double by_speed = fastest_ > 0 ? settings_.courant * settings_.cell / fastest_ : longest_;
    const double by_strain = most_gradient_ > 0 ? strain_aimed_at / most_gradient_ : longest_;
    return std::min(
        {longest_ * (1 + 1e-9), std::max(by_speed, 1e-6 * longest_), std::max(by_strain, 1e-6 * longest_)});
  }

  void take_step(double dt) {
    const TransferStep step{dt, settings_.cell, settings_.flip_share};
    if (dt != last_step_) {  // blocks asleep hold impulses of a step
      for (ParticleBlock<Dim>& asleep : grid_.particles())
        if (asleep.asleep) to_nodes(asleep, step, settings_.transfer);
      last_step_ = dt;
    }
    share(grid_.awake(), [&](int k) { to_nodes(block(k), step, settings_.transfer); });
    share(grid_.live(), [&](int n) {
      update_nodes(grid_.nodes()[static_cast<std::size_t>(n)], grid_.particles(), grid_.obstacles(), gravity_,
                   dt, 1e-12 * heaviest_, settings_.transfer);
    });
    share(grid_.awake(), [&](int k) {
      ReachedNodes<Dim> velocity, before;
      collect_velocities(block(k), grid_.nodes(), &NodeBlock<Dim>::velocity, velocity);
      if (settings_.transfer == Transfer::flip)
        collect_velocities(block(k), grid_.nodes(), &NodeBlock<Dim>::before, before);
      from_nodes(block(k), velocity, before, constants_, step, settings_.transfer);
    });
    finish_step(dt);
  }

  void finish_step(double dt) {
    time_ += dt;
    ++work_.steps;
    fastest_ = 0;
    double strain = 0;
    bool changed = false;
    for (const int k : grid_.awake()) {
      ParticleBlock<Dim>& b = block(k);
      work_.particle_steps += b.count;
      if (!(b.strain <= strain_allowed)) refuse(b, dt);
      fastest_ = std::max(fastest_, b.fastest);
      strain = std::max(strain, b.strain);
      b.calm = b.fastest < settings_.rest_speed ? b.calm + dt : 0;
      if (b.calm > settings_.rest_patience) changed = fall_asleep(b, dt) || changed;
    }
    most_gradient_ = strain / dt;
    drift_ += fastest_ * dt;
    for (const int k : grid_.border()) changed = wake(block(k)) || changed;
    // Before the next step carries a particle further than a block reaches.
    if (drift_ > (1 - settings_.courant) * settings_.cell) {
      drift_ = 0;
      grid_.hand_over({});
    } else if (changed) {
      grid_.list_awake();
    }
  }

  bool fall_asleep(ParticleBlock<Dim>& b, double dt) {
    for (Pack<Dim>& pack : b.packs)
      for (int r = 0; r < Dim; ++r) {
        pack.velocity[r] = constant<Lanes>(0);
        for (int c = 0; c < Dim; ++c) pack.affine[r][c] = constant<Lanes>(0);
      }
    to_nodes(b, {dt, settings_.cell, settings_.flip_share}, settings_.transfer);
    b.asleep = true;
    return true;
  }

  /// When a node on which its snow lies moves.
  bool wake(ParticleBlock<Dim>& b) {
    ReachedNodes<Dim> velocity;
    collect_velocities(b, grid_.nodes(), &NodeBlock<Dim>::velocity, velocity);
    const double limit = waking * settings_.rest_speed;
    for (std::size_t side = 0; side < b.nodes.size(); ++side)
      if (!grid_.is_live(b.nodes[side])) clear_side(velocity, static_cast<int>(side));
    for (int n = 0; n < ReachedNodes<Dim>::size; ++n) {
      const Lanes square = velocity.at[n] * velocity.at[n];
      if (square[0] + square[1] + square[2] > limit * limit &&
          b.sums.momentum->at[n][3] > 1e-12 * heaviest_) {
        b.asleep = false;
        b.calm = 0;
        return true;
      }
    }
    return false;
  }

  /// Nodes that no step has updated have old velocities.
  static void clear_side(ReachedNodes<Dim>& velocity, int side) {
    for (int n = 0; n < ReachedNodes<Dim>::size; ++n) {
      int rest = n, number = 0, stride = 1;
      for (int d = 0; d < Dim; ++d) {
        const int local = rest % reach_nodes;
        number += stride * (local == 0 ? 0 : local <= block_cells ? 1 : 2);
        rest /= reach_nodes;
        stride *= 3;
      }
      if (number == side) velocity.at[n] = constant<Lanes>(0);
    }
  }

  [[noreturn]] void refuse(const ParticleBlock<Dim>& b, double dt) const {
    const double size = block_cells * settings_.cell;
    throw Error(
        fmt::format("mpm: unstable at {:.6g} s: a step of {:.3g} s strains a particle near ({:.3g}, {:.3g}) "
                    "m by {:.3g}, must be at "
                    "most {:g}",
                    time_, dt, size * b.place[0], size * b.place[Dim - 1], b.strain, strain_allowed));
  }

  YieldConstants constants_;
  BlockGrid<Dim> grid_;
  Point<Dim> gravity_;
  std::unique_ptr<tbb::task_arena> arena_;
  double heaviest_ = 0;
  double most_gradient_ = 0;
  double drift_ = 0;      ///< that a particle may have gone since it was handed over [m]
  double last_step_ = 0;  ///< [s]
};

template <int Dim>
MaterialPoints<Dim>::MaterialPoints(const MpmSettings& settings, const SnowLaw& law,
                                    std::vector<Obstacle<Dim>> obstacles)
    : engine_(std::make_unique<Engine>(settings, law, std::move(obstacles))) {}
template <int Dim>
MaterialPoints<Dim>::~MaterialPoints() = default;
template <int Dim>
MaterialPoints<Dim>::MaterialPoints(MaterialPoints&&) noexcept = default;

template <int Dim>
void MaterialPoints<Dim>::add(const std::vector<MaterialPoint<Dim>>& points) {
  engine_->add(points);
}
template <int Dim>
void MaterialPoints<Dim>::advance(double duration) {
  engine_->advance(duration);
}
template <int Dim>
std::vector<MaterialPoint<Dim>> MaterialPoints<Dim>::points() const {
  return engine_->points();
}
template <int Dim>
std::size_t MaterialPoints<Dim>::size() const {
  return engine_->size_;
}
template <int Dim>
std::size_t MaterialPoints<Dim>::awake() const {
  return engine_->awake();
}
template <int Dim>
double MaterialPoints<Dim>::time() const {
  return engine_->time_;
}
template <int Dim>
double MaterialPoints<Dim>::longest_step() const {
  return engine_->longest_;
}
template <int Dim>
double MaterialPoints<Dim>::fastest() const {
  return engine_->fastest_;
}
template <int Dim>
const MpmWork& MaterialPoints<Dim>::work() const {
  return engine_->work_;
}
template <int Dim>
const SnowLaw& MaterialPoints<Dim>::law() const {
  return engine_->law_;
}
template <int Dim>
const MpmSettings& MaterialPoints<Dim>::settings() const {
  return engine_->settings_;
}

template class MaterialPoints<2>;
template class MaterialPoints<3>;

}  // namespace aeolian
