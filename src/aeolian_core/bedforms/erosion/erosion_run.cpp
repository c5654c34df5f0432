#include "aeolian_core/bedforms/erosion/erosion_run.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/bedforms/erosion/erosion_batch.hpp"
#include "aeolian_core/bedforms/erosion/half_excess_slides.hpp"
#include "aeolian_core/bedforms/erosion/spread.hpp"
#include "aeolian_core/wind/log_law.hpp"

namespace aeolian {
namespace {

constexpr int settling_sweeps = 2000;         ///< of a new map's slopes
constexpr double still_air_speed = 10;        ///< for steps without wind [m/s]
constexpr double steps_of_a_hop = 15;         ///< at least
constexpr double launches_of_a_round = 0.05;  ///< per cell
constexpr double remembered = 0.95;           ///< from one interval to the next
constexpr double least_pace = 0.6;            ///< so that what lies in shelter does not stop the clock
constexpr double most_pace = 5;
constexpr int awake_every = 20;                             ///< intervals, for snow
constexpr std::size_t sorted_above = std::size_t{1} << 18;  ///< cells, of which a cache holds only some
constexpr std::int64_t sort_every = 200;                    ///< steps

double parcel_thickness(const Grain& grain, const ErosionParameters& p) {
  check(grain);
  return p.parcel_thickness > 0 ? p.parcel_thickness : grain.diameter;
}

}  // namespace

ErosionRun::ErosionRun(const HeightMap& map, const Grain& grain, const ErosionParameters& parameters)
    : p_(parameters),
      grain_(grain),
      bed_(map, parcel_thickness(grain, parameters), parameters.border == Border::periodic),
      impacts_(p_, grain_, bed_) {
  if (p_.snow) {
    snow_ = std::make_unique<SnowCover>(*p_.snow, bed_);
    if (map.has(layer::age)) {
      const HeightMap::Layer& age = map.layer(layer::age);
      for (std::size_t i = 0; i < age.size(); ++i)
        if (age[i] >= 0) snow_->set_age(i, age[i]);
    }
  }
}

ErosionRun::~ErosionRun() = default;

void ErosionRun::set_wind(const WindField& wind) {
  const auto same = [&] {
    return wind_ && wind.cells.names().empty() && wind_->cells.names().empty() &&
           wind.friction_velocity == wind_->friction_velocity && wind.direction == wind_->direction;
  };
  if (same()) return;
  launcher_.reset();
  drift_ = std::make_unique<Drift>(wind, bed_, grain_, p_);
  launcher_ = std::make_unique<Launcher>(p_, grain_, bed_, *drift_, snow_.get());
  wind_ = wind;
  since_awake_ = 0;
  const double u = drift_->strongest();
  const double apex = std::max(1e-4, std::pow(p_.lift_off.most_factor * u, 2) / p_.air.gravity);
  const double fastest =
      drift_->blows() ? std::max(u / von_karman * std::log(std::max(apex / drift_->roughness(), 2.0)), u)
                      : still_air_speed;
  step_time_ = std::min(p_.step, bed_.geometry().cell() / fastest);
  if (drift_->blows())
    step_time_ = std::min(step_time_, 2 * p_.lift_off.least_factor * u / p_.air.gravity / steps_of_a_hop);
  step_ = flight_step(bed_, grain_, p_.air, drift_->roughness(), step_time_);
  step_.shear = drift_->shear();
  step_.uniform_shear_x = static_cast<float>(wind.friction_velocity / von_karman * std::cos(wind.direction));
  step_.uniform_shear_y = static_cast<float>(wind.friction_velocity / von_karman * std::sin(wind.direction));
}

double ErosionRun::advance(double duration) {
  double left = duration;
  while (left > 0) left -= interval(left);
  return duration;
}

double ErosionRun::iterate(std::int64_t steps) {
  double time = 0;
  for (std::int64_t n = 0; n < steps; ++n) {
    launcher_->set_impacts(parcels_.size() > 0);
    if (n % p_.slide_every == 0) launcher_->find_awake();
    const double passed = fly_step();
    let_snow_lie(passed, true);
    if (++since_slides_ >= p_.slide_every) settle_slopes(p_.slide_sweeps);
    time += passed;
  }
  return time;
}

/// Time [s] that lies behind, at most `left`: some steps or a round, or all of it where nothing can move.
double ErosionRun::interval(double left) {
  launcher_->set_impacts(hopped_ || parcels_.size() > 0);
  if (!snow_ || since_awake_++ % awake_every == 0 || !launcher_->anything_awake()) launcher_->find_awake();
  const bool enters = drift_->blows() && p_.border == Border::open && p_.inflow > 0;
  if (!launcher_->anything_awake() && !enters && parcels_.size() == 0) {
    const bool snows = snow_ && p_.snow->snowfall > 0;
    const double bulk = grain_.density * (1 - grain_.porosity);
    hopped_ = false;
    const double time = snows ? std::min(left, bed_.parcel() * bulk / p_.snow->snowfall) : left;
    let_snow_lie(time, true);
    if (snows && drift_->blows()) settle_slopes(p_.slide_sweeps);
    return time;
  }
  double passed = 0;
  if (p_.flight == FlightMode::hop_table && parcels_.size() == 0) {
    const double attempts = launcher_->attempts();
    const double per_round = launches_of_a_round * static_cast<double>(launcher_->awake().size()) * 1024 *
                             launcher_->most_exposed();
    passed = std::min(left, attempts > 0 ? per_round / attempts * pace_ : left);
    if (enters) passed = std::min(passed, 1000 / entries_per_second() * pace_);
    const double seconds = passed / pace_;
    hop_round(attempts * seconds, seconds);
    set_pace(seconds);
    ++since_slides_;
  } else if (p_.pool) {
    if (left + owed_time_ <= 0) {
      owed_time_ += left;
      return left;
    }
    const double time = fly_step();
    ++since_slides_;
    passed = std::min(time, left + owed_time_);
    owed_time_ = std::min(0.0, left + owed_time_ - time);
    passed = std::clamp(passed, 0.0, left);
  } else {
    const double each = p_.acceleration * step_time_ * pace_;
    if (left + owed_time_ < each) {
      owed_time_ += left;
      let_snow_lie(left, true);
      return left;
    }
    const double whole = std::floor((left + owed_time_) / each);
    const int steps = static_cast<int>(std::min(whole, static_cast<double>(p_.slide_every)));
    for (int n = 0; n < steps; ++n) fly_step();
    since_slides_ += steps;
    set_pace(steps * p_.acceleration * step_time_);
    passed = std::min(left, steps * each - owed_time_);
    owed_time_ = 0;
  }
  let_snow_lie(passed, passed >= left);
  if (since_slides_ >= p_.slide_every) settle_slopes(p_.slide_sweeps);
  return passed;
}

/// After what should have been so many seconds of saturated flux.
void ErosionRun::set_pace(double seconds) {
  double covered = 0;
  for (const int tile : launcher_->awake()) covered += bed_.covered_in_tile(static_cast<std::size_t>(tile));
  const double cell = bed_.geometry().cell();
  const double due = drift_->mean_flux() * covered * cell * cell * seconds;
  carried_ = remembered * carried_ + counts_.transported - counted_;
  due_ = remembered * due_ + due;
  counted_ = counts_.transported;
  pace_ = due_ > 0 ? std::clamp(carried_ / due_, least_pace, most_pace) : 1;
}

/// Lets snow age, fall and sinter, some intervals at a time.
void ErosionRun::let_snow_lie(double time, bool at_once) {
  if (!snow_) return;
  lying_ += time;
  if (!at_once && since_awake_ % awake_every != 0) return;
  balance_.inflow += snow_->advance(bed_, lying_, grain_.density * (1 - grain_.porosity));
  lying_ = 0;
}

void ErosionRun::settle_slopes(int sweeps) {
  since_slides_ = 0;
  if (counts_.steps <= p_.slide_every) sweeps = std::max(sweeps, settling_sweeps);
  const std::int64_t units =
      slide(bed_, std::tan(grain_.angle_of_repose), sweeps, [&](std::size_t cell, std::int32_t moved) {
        if (snow_) snow_->deposited(cell, moved);
      });
  counts_.slid += static_cast<double>(units) * bed_.unit() * bed_.parcel_volume() / bed_.parcel();
}

/// One step of the flight; gives the time of the bed [s].
double ErosionRun::fly_step() {
  const double seconds = p_.acceleration * step_time_;
  const double before = counts_.transported;
  if (p_.pool) {
    const double pool = p_.pool->parcels_per_cell * static_cast<double>(bed_.geometry().size());
    launch(std::max(0.0, pool - static_cast<double>(parcels_.size())) * p_.pool->chance);
  } else {
    launch(launcher_->attempts() * seconds);
    enter(seconds);
  }
  fly_all();
  ++counts_.steps;
  if (bed_.geometry().size() > sorted_above && counts_.steps % sort_every == 0) sort_parcels();
  if (!p_.pool) return seconds;
  // The wind never does less in the time of the flight than in that time.
  const double flux = drift_->blows() ? drift_->flux(drift_->strongest()) : 0;
  const double area = bed_.geometry().length_x() * bed_.geometry().length_y();
  return flux > 0 ? std::max((counts_.transported - before) / (flux * area), step_time_) : step_time_;
}

void ErosionRun::launch(double attempts) {
  if (!launcher_->anything_awake()) return;
  owed_attempts_ += attempts;
  const double whole = std::floor(owed_attempts_);
  owed_attempts_ -= whole;
  for (double n = 0; n < whole; ++n) {
    const std::uint64_t number = attempts_++;
    const std::optional<Launch> launched = launcher_->attempt(number);
    if (!launched) continue;
    if (!Spread(bed_, launched->x, launched->y, p_.spread).take_parcel(bed_, ErodibleBed::parcel_units))
      continue;
    balance_.moved += ErodibleBed::parcel_units;
    ++counts_.launches;
    take_off(*launched, number);
  }
}

void ErosionRun::enter(double seconds) {
  if (!(p_.inflow > 0) || p_.border != Border::open || !drift_->blows()) return;
  owed_entries_ += seconds * entries_per_second();
  for (; owed_entries_ >= 1; --owed_entries_) {
    const std::uint64_t number = first_entry + entries_++;
    balance_.inflow += ErodibleBed::parcel_units;
    take_off(entry(number), number);
  }
}

void ErosionRun::take_off(const Launch& launch, std::uint64_t number) {
  const float x = bed_.periodic() ? on_ring(launch.x, bed_.geometry().nx()) : launch.x;
  const float y = bed_.periodic() ? on_ring(launch.y, bed_.geometry().ny()) : launch.y;
  const float ground = patch_at(bed_, x, y).height;
  parcels_.add(x, y, just_above(ground), launch.velocity.x(), launch.velocity.y(), launch.velocity.z(),
               number);
}

/// Parcels that the saturated flux brings over the upwind borders.
double ErosionRun::entries_per_second() const {
  const Drift::Cell& wind = drift_->at(0);
  const GridGeometry& g = bed_.geometry();
  const double width = std::abs(wind.east) * g.length_y() + std::abs(wind.north) * g.length_x();
  return p_.inflow * drift_->flux(drift_->strongest()) * width / bed_.parcel_volume();
}

Launch ErosionRun::entry(std::uint64_t number) const {
  const GridGeometry& g = bed_.geometry();
  const Drift::Cell& wind = drift_->at(0);
  const Philox::Block bits = Philox(p_.seed)(0, number);
  const double over_west = std::abs(wind.east) * g.length_y();
  const double over_south = std::abs(wind.north) * g.length_x();
  const auto share = static_cast<float>(bits[1] * 0x1p-32);
  Launch launch{};
  const auto last_x = static_cast<float>(g.nx()) - 0.501F;
  const auto last_y = static_cast<float>(g.ny()) - 0.501F;
  if (bits[0] * 0x1p-32 * (over_west + over_south) < over_west) {
    launch.x = wind.east >= 0 ? -0.499F : last_x;
    launch.y = -0.499F + share * (last_y + 0.499F);
  } else {
    launch.y = wind.north >= 0 ? -0.499F : last_y;
    launch.x = -0.499F + share * (last_x + 0.499F);
  }
  launch.cell =
      g.index(static_cast<int>(std::floor(launch.x + 0.5F)), static_cast<int>(std::floor(launch.y + 0.5F)));
  launch.velocity = launcher_->lift_off(number, launch.cell);
  return launch;
}

void ErosionRun::give(const Transfer& t, std::int32_t units) {
  const auto settle = [this](std::size_t cell, std::int32_t part) {
    if (snow_) snow_->deposited(cell, part);
  };
  balance_.outflow += t.outside ? units : Spread(bed_, t.to_x, t.to_y, p_.spread).give(bed_, units, settle);
}

/// Grains broken out of loose snow lie where they were, without bonds.
void ErosionRun::stir(const Transfer& t) {
  const std::int64_t cell = cell_near(bed_, t.from_x, t.from_y);
  if (cell >= 0 && bed_.loose(static_cast<std::size_t>(cell)) > 0)
    snow_->deposited(static_cast<std::size_t>(cell), t.units);
}

void ErosionRun::carry_out(const Transfers& transfers) {
  bool on_its_way = true;
  for (const Transfer& t : transfers) {
    std::int32_t units = t.units;
    if (t.kind == Transfer::Kind::stirred) {
      stir(t);
      continue;
    }
    if (t.kind == Transfer::Kind::settled) {
      on_its_way = true;
    } else if (t.kind == Transfer::Kind::lifted) {
      on_its_way = Spread(bed_, t.from_x, t.from_y, p_.spread).take_parcel(bed_, units);
      counts_.launches += on_its_way ? 1 : 0;
    } else if (on_its_way) {
      units = Spread(bed_, t.from_x, t.from_y, p_.spread).take_loose(bed_, units);
    }
    if (!on_its_way || units == 0) continue;
    if (t.kind != Transfer::Kind::settled) balance_.moved += units;
    give(t, units);
  }
}

void ErosionRun::store(HeightMap& map) const {
  HeightMap::Layer& elevation = map.layer(layer::elevation);
  for (std::size_t i = 0; i < elevation.size(); ++i)
    if (!bed_.hole(i)) elevation[i] = static_cast<float>(bed_.elevation(i));
  if (!snow_) return;
  HeightMap::Layer& sintered = map.add("sintered", 0);
  HeightMap::Layer& age = map.add(layer::age, 0);
  for (std::size_t i = 0; i < elevation.size(); ++i) {
    sintered[i] = static_cast<float>(bed_.unit() * bed_.sintered(i));
    age[i] = static_cast<float>(snow_->age(i));
  }
}

std::int64_t ErosionRun::units() const {
  return bed_.total_units() + static_cast<std::int64_t>(parcels_.size()) * ErodibleBed::parcel_units;
}

}  // namespace aeolian
