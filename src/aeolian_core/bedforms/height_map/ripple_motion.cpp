#include "aeolian_core/bedforms/height_map/ripple_motion.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/bedforms/height_map/lay_down.hpp"
#include "aeolian_core/bedforms/height_map/slope_bias.hpp"

namespace aeolian {
namespace {

/// Says anew of the active patches whether sand lies there that can move.
void find_sand(const FrameField& bed, const HardGround& ground, const ActivePatches& active,
               ActivePatches& sandy) {
  active.for_all([&](int station, int patch, int begin, int end) {
    bool any = false;
    for (int row = begin; row < end; ++row)
      any = any || (bed.at(station)[row] - ground.floor.at(station)[row]) * ground.open.at(station)[row] >
                       least_movable;
    sandy.set(station, patch, any);
  });
}

void clear(const ActivePatches& active, const WindFrame& frame, FrameField& field) {
  for (int station = 0; station < frame.stations(); ++station) {
    bool any = false;
    active.for_runs(station, [&](int begin, int end) {
      std::fill(field.at(station) + begin, field.at(station) + end, 0.0);
      any = true;
    });
    if (any) field.fill_pads(station, frame.periodic());
  }
}

constexpr double steps_per_saturation = 16;  ///< of the longest; long waves change that slowly

/// The shortest wavelength of a long-wave flux, in those that grow fastest: their growth changes by less than
/// 0.5 %.
constexpr double shortest_limit = 1.6;

/// Of the flux that keeps ripples from growing beyond the law's wavelength [m]; none without a law or
/// growth. In runs of several winds and grains ripples settled at 0.865 times its own wavelength where that
/// was the shortest, and by its cube root less where it was longer (docs/ripple_model.md).
std::optional<double> saturating_wavelength(const RippleParameters& parameters, const Forcing& forcing,
                                            const FastestGrowth& growth) {
  if (!parameters.wavelength_law || !(growth.rate > 0)) return std::nullopt;
  const double shortest = shortest_limit * growth.wavelength;
  const double settled =
      std::max(1.0, parameters.wavelength_law->final_wavelength(forcing) / (0.865 * shortest));
  return shortest * std::pow(settled, 1.5);
}

FastestGrowth growth_of(const RippleParameters& parameters, const Forcing& forcing) {
  return fastest_growth(forcing, parameters.hop_shortening, parameters.slope_effect);
}

}  // namespace

int reach_aside(const RippleParameters& parameters, const Forcing& forcing, const WindFrame& frame,
                double cell) {
  const LateralSpread spread(frame, parameters.lateral_spread * forcing.reptation_length / cell);
  const auto wavelength = saturating_wavelength(parameters, forcing, growth_of(parameters, forcing));
  return std::max(spread.reach_across(), wavelength ? LongWaveFlux::reach(*wavelength, cell) : 0);
}

RippleMotion::RippleMotion(const RippleSetting& setting, const WindFrame& frame,
                           const std::vector<double>& height)
    : parameters_(setting.parameters),
      forcing_(setting.forcing),
      cell_(setting.cell),
      angles_(forcing_.impact_angle, forcing_.impact_angle_spread),
      growth_(growth_of(parameters_, forcing_)),
      frame_(frame),
      impacts_(frame_, angles_, forcing_.reptation_length, parameters_.hop_shortening),
      slopes_(frame_, cell_, parameters_.slope_effect * forcing_.reptation_length * forcing_.erosion_rate()),
      avalanches_(frame_.stations(), frame_.rows(), cell_, std::tan(forcing_.grain.angle_of_repose),
                  frame_.periodic()),
      spread_(frame_, parameters_.lateral_spread * forcing_.reptation_length / cell_),
      activity_(FrameField::unset(frame_.stations(), frame_.rows())),
      state_{{},
             ActivePatches(frame_.stations(), frame_.rows()),
             ActivePatches(frame_.stations(), frame_.rows()),
             {},
             0} {
  const double hop = forcing_.reptation_length;
  if (parameters_.stochastic_share > 0)
    noise_.emplace(
        frame_, cell_, ImpactNoise::Hop{hop, parameters_.lateral_spread * hop, parameters_.hop_shortening},
        std::pow(forcing_.grain.effective_diameter(), 3), parameters_.stochastic_share, parameters_.seed);
  if (const auto wavelength = saturating_wavelength(parameters_, forcing_, growth_))
    saturation_.emplace(frame_, cell_, *wavelength, growth_.rate * std::pow(*wavelength / (2 * M_PI), 2));
  frame_.enter(setting.dune, dune_);
  frame_.enter(height, state_.bed);
  if (setting.floor) {
    frame_.enter(*setting.floor, ground_.floor);
    frame_.enter(*setting.open, ground_.open);
    for (int i = 0; i < frame_.stations(); ++i) ground_.open.fill_mirrored_pads(i, frame_.periodic());
    ground_.holes = setting.holes;
  }
  state_.volume.moved +=
      hard() ? avalanches_.run(state_.bed, ground_, state_.active) : avalanches_.run(state_.bed);
}

double RippleMotion::longest_step() const {
  return parameters_.step * frame_.step() * angles_.effective_tangent() / forcing_.erosion_rate();
}

bool RippleMotion::may_leave(const SandReach& reach) {
  if (!frame_.rim().any()) return false;
  find_sand(state_.bed, ground_, state_.active, state_.sandy);
  return !reach.stays_within(frame_, state_.sandy);
}

void RippleMotion::move(double dt, double time) {
  const double depth = forcing_.erosion_rate() * dt;
  const double per_depth = depth * cell_ * cell_;
  FrameField& bed = state_.bed;
  if (!frame_.periodic()) {
    const bool ripples = parameters_.inflow == Inflow::ripples && growth_.rate > 0;
    const double frequency = ripples ? 2 * M_PI * growth_.speed / growth_.wavelength : 0;
    const Inflow inflow =
        ripples || parameters_.inflow == Inflow::none ? parameters_.inflow : Inflow::flat_bed;
    impacts_.set_supply(border_supply(inflow, growth_.wavelength, frequency, cell_, time, parameters_.seed,
                                      parameters_.supply));
  }
  if (hard()) {
    find_sand(bed, ground_, state_.active, state_.sandy);
    clear(state_.active, frame_, activity_);
    impacts_.run(bed, dune_, ground_, state_.sandy, depth, state_.active);
  } else {
    impacts_.run(bed, dune_, depth);
  }
  const SlopeBias bias(frame_, cell_, std::tan(parameters_.doubling_slope), dune_);
  const LaidDown laid =
      lay_down(frame_, impacts_, spread_, depth, hard() ? &ground_.open : nullptr,
               parameters_.doubling_slope < M_PI / 2 ? &bias : nullptr, state_.active, bed, activity_);
  state_.volume.moved += laid.eroded * per_depth;
  state_.volume.inflow += laid.inflow * per_depth;
  state_.volume.outflow += laid.outflow * per_depth;
  if (hard()) {
    slopes_.run(activity_, laid.strongest, dt, ground_, state_.active, bed);
    state_.volume.moved += avalanches_.run(bed, ground_, state_.active);
  } else {
    slopes_.run(activity_, laid.strongest, dt, bed);
    state_.volume.moved += avalanches_.run(bed);
  }
  state_.unsaturated += dt;
  if (saturation_ && state_.unsaturated >= steps_per_saturation * longest_step()) finish();
}

void RippleMotion::finish() {
  if (saturation_ && state_.unsaturated > 0)
    saturation_->run(dune_, state_.unsaturated, hard(), state_.active, state_.bed);
  state_.unsaturated = 0;
}

void RippleMotion::draw_noise(double dt, RippleClock& clock) {
  if (noise_)
    noise_->run(impacts_, forcing_.erosion_rate() * dt, clock.noisy_steps++, hard(), state_.active,
                state_.bed);
}

void RippleMotion::step(double dt, RippleClock& clock) {
  move(dt, clock.time);
  draw_noise(dt, clock);
  clock.time += dt;
}

double RippleMotion::step_and_compare(double dt, RippleClock& clock) {
  const State before = state_;
  move(dt, clock.time);
  const FrameField whole = state_.bed;
  state_ = before;
  move(dt / 2, clock.time);
  move(dt / 2, clock.time + dt / 2);
  double square = 0;
  for (int i = 0; i < frame_.stations(); ++i)
    for (int row = 0; row < frame_.rows(); ++row) {
      const double difference = whole.at(i)[row] - state_.bed.at(i)[row];
      square += difference * difference;
    }
  draw_noise(dt, clock);
  clock.time += dt;
  return std::sqrt(square / frame_.stations() / frame_.rows());
}

}  // namespace aeolian
