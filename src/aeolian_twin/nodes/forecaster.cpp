#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <memory>
#include <optional>
#include <thread>

#include <fmt/format.h>
#include <pluginlib/class_list_macros.hpp>

#include "aeolian_core/bedforms/height_map/ripple_model.hpp"
#include "aeolian_core/saltation/saltation_source.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/twin/forecast.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/nodes/conversions.hpp"
#include "aeolian_twin/nodes/map_receiver.hpp"
#include "aeolian_twin/nodes/node.hpp"

namespace aeolian {
namespace {

const std::string law = "law";  // name of the three-number law

}  // namespace

/// Runs the ripple model forward from the newest map, in a thread of its own.
class Forecaster : public Node {
 public:
  Forecaster() : Node(describe_forecaster()) {}
  ~Forecaster() override {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      stop_ = true;
    }
    wake_.notify_one();
    if (worker_.joinable()) worker_.join();
  }

 private:
  struct WindSample {
    ros::Time stamp;
    Forcing forcing;
  };
  /// A map to start from and the wind that is to move it.
  struct Job {
    HeightMap start;
    std_msgs::Header header;
    Forcing forcing;
  };

  void start() override {
    grain_.diameter = parameters().number("grain_diameter");
    grain_.density = parameters().number("grain_density");
    grain_.porosity = parameters().number("porosity");
    grain_.angle_of_repose = degrees_to_radians(parameters().number("angle_of_repose_deg"));
    check(grain_);
    saltation_ = read_saltation(parameters().text("saltation"));
    splash_.reptation_diameters = parameters().number("reptation_diameters");
    RippleParameters ripple;
    ripple.hop_shortening = parameters().number("hop_shortening");
    ripple.slope_effect = parameters().number("slope_effect");
    ripple.doubling_slope = degrees_to_radians(parameters().number("doubling_slope_deg"));
    ripple.wavelength_law =
        make_wavelength_law(parameters().text("wavelength_law"), parameters().number("wavelength_diameters"));
    const std::string& inflow = parameters().text("inflow");
    ripple.inflow = inflow == "none"      ? Inflow::none
                    : inflow == "ripples" ? Inflow::ripples
                                          : Inflow::flat_bed;
    ripple.lateral_spread = parameters().number("lateral_spread");
    ripple.relief_scale = parameters().number("relief_scale");
    model_ = std::make_unique<RippleModel>(ripple);
    horizons_ = parameters().numbers("horizons");
    if (horizons_.empty() ||
        std::adjacent_find(horizons_.begin(), horizons_.end(), std::greater_equal<>()) != horizons_.end())
      parameters().refuse("horizons", "a list of at least one time, each longer than the one before");
    period_ = ros::Duration(parameters().number("period"));
    wind_window_ = parameters().number("wind_window");
    max_gap_ = parameters().number("max_gap");

    publisher_ =
        nh().advertise<grid_map_msgs::GridMap>("forecast", static_cast<std::uint32_t>(horizons_.size()) + 10);
    wind_subscriber_ = nh().subscribe("wind_field", 1000, &Forecaster::take_wind, this);
    WantedMap wanted;
    wanted.layers = {layer::elevation, layer::ground};
    wanted.accept = [this](const std::string& topic, const std_msgs::Header& header) {
      require_frame(topic, header);
    };
    wanted.queue_size = 2;
    receiver_ = std::make_unique<MapReceiver>(
        nh(), "height_map",
        [this](const HeightMap& map, const std_msgs::Header& header, const TileMask&) {
          take_map(map, header);
        },
        [this](const std::string& reason) { bad("map", reason); }, wanted);
    worker_ = std::thread([this] { work(); });
  }

  /// The law or a table. A file that cannot be used is told, and the law is used; a table that can but knows
  /// nothing of the grain is refused.
  SaltationSource read_saltation(const std::string& name) {
    if (name == law) return {};
    SaltationSource solved;
    try {
      solved = SaltationSource(SaltationTable::read(name));
    } catch (const Error& error) {
      bad("saltation", fmt::format("{}; the three-number law is used", error.what()));
      return {};
    }
    solved.check(grain_);
    good("saltation", "states of " + name);
    return solved;
  }

  void take_wind(const grid_map_msgs::GridMap::ConstPtr& message) {
    try {
      require_frame(wind_subscriber_.getTopic(), message->info.header);
      const ros::Time stamp = message->info.header.stamp;
      const WindField field = to_wind_field(*message);
      const SaltationState state = saltation_.state(field.friction_velocity, grain_, field.air_density);
      if (!wind_.empty() && stamp < wind_.back().stamp) wind_.clear();  // a bag that loops
      wind_.push_back({stamp, make_forcing(state, field.direction, grain_, splash_)});
      // Maps may be stamped well before the newest wind, so twice the window is kept.
      while ((stamp - wind_.front().stamp).toSec() > 2 * wind_window_) wind_.pop_front();
    } catch (const Error& error) {
      bad("wind", error.what());
    }
  }

  void take_map(const HeightMap& map, const std_msgs::Header& header) {
    const ros::Time stamp = header.stamp;
    if (stamp < last_map_) {
      bad("clock",
          fmt::format("time jumped back by {:.1f} s (a bag that loops?)", (last_map_ - stamp).toSec()));
    } else if (!last_map_.isZero()) {
      good("clock", "time runs forward");
    }
    last_map_ = stamp;
    if (!is_due(stamp)) return;
    if (const std::optional<Forcing> forcing = forcing_before(stamp)) submit({map, header, *forcing});
    good("map", "in use");
  }

  /// The mean forcing over the wind window that ends at a time, each sample with the time for which it
  /// stands. What is missing is bridged with what is there; nothing when nothing is.
  std::optional<Forcing> forcing_before(const ros::Time& end) {
    std::vector<Forcing> forcings;
    std::vector<double> ages;
    double longest_gap = 0;
    double last_age = 0;
    for (auto sample = wind_.rbegin(); sample != wind_.rend(); ++sample) {
      const double age = (end - sample->stamp).toSec();
      if (age < 0) continue;
      if (last_age < wind_window_) longest_gap = std::max(longest_gap, age - last_age);
      last_age = age;
      if (age > wind_window_) break;
      forcings.push_back(sample->forcing);
      ages.push_back(age);
    }
    if (forcings.empty()) {
      bad("wind", fmt::format("no wind in the {} s before the map at {}.{:09}: no forecast", wind_window_,
                              end.sec, end.nsec));
      return std::nullopt;
    }
    std::vector<double> weights;
    for (std::size_t i = 0; i < ages.size(); ++i) {
      const double stands_for = ages[i] - (i > 0 ? ages[i - 1] : 0);
      weights.push_back(std::min(max_gap_, std::max(stands_for, 1e-3)));
    }
    if (longest_gap > max_gap_)
      bad("wind",
          fmt::format("a gap of {:.1f} s in the wind is bridged with the mean of the rest", longest_gap));
    else
      good("wind", fmt::format("{} readings in the last {} s", forcings.size(), wind_window_));
    return mean_forcing(forcings, weights);
  }

  /// Hands a job to the worker; one that still waits there is replaced, so that the newest map wins.
  void submit(Job job) {
    const ros::Time stamp = job.header.stamp;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (working_) {
        bad("speed",
            fmt::format(
                "a forecast still runs when the next is due after {} s (~period): the newest map waits",
                period_.toSec()));
      } else {
        good("speed", "forecasts keep up with the maps");
        started_ = stamp;
      }
      next_ = std::move(job);
    }
    wake_.notify_one();
  }

  bool is_due(const ros::Time& stamp) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return started_.isZero() || stamp < started_ || stamp - started_ >= period_;
  }

  void work() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (true) {
      wake_.wait(lock, [this] { return stop_ || next_; });
      if (stop_) return;
      const Job job = std::move(*next_);
      next_.reset();
      started_ = job.header.stamp;
      working_ = true;
      lock.unlock();
      forecast(job);
      lock.lock();
      working_ = false;
    }
  }

  void forecast(const Job& job) {
    try {
      const ros::WallTime begin = ros::WallTime::now();
      for (const Forecast& forecast : make_forecasts(job.start, job.forcing, horizons_, *model_)) {
        std_msgs::Header header = job.header;
        header.stamp += ros::Duration(forecast.lead_time);
        publisher_.publish(to_message(forecast.map, header));
      }
      good("forecast",
           fmt::format(
               "{} horizons in {:.2f} s; depth set moving {:.3g} mm/s towards {:.0f} degrees from east",
               horizons_.size(), (ros::WallTime::now() - begin).toSec(), 1e3 * job.forcing.erosion_rate(),
               radians_to_degrees(job.forcing.direction)));
    } catch (const Error& error) {
      bad("forecast", error.what());
    }
  }

  Grain grain_;
  SaltationSource saltation_;
  MeanSplash splash_;
  std::vector<double> horizons_;
  ros::Duration period_;
  double wind_window_ = 0;
  double max_gap_ = 0;
  std::unique_ptr<RippleModel> model_;  ///< used by the worker only

  std::deque<WindSample> wind_;
  ros::Time last_map_;
  ros::Publisher publisher_;
  ros::Subscriber wind_subscriber_;
  std::unique_ptr<MapReceiver> receiver_;

  std::mutex mutex_;  ///< guards what follows
  std::condition_variable wake_;
  std::optional<Job> next_;
  bool working_ = false;
  bool stop_ = false;
  ros::Time started_;  ///< stamp of the map of the newest forecast
  std::thread worker_;
};

NodeDescription describe_forecaster() {
  const Grain grain;
  const RippleParameters ripple;
  return {
      "forecaster",
      "predicts the surface from the newest map and the wind",
      {"height_map, height_map_updates (grid_map_msgs/GridMap): whole, what has changed",
       "wind_field (grid_map_msgs/GridMap)"},
      {"forecast (grid_map_msgs/GridMap) for each horizon: elevation, initial [m], lead_time [s]; stamped "
       "with the "
       "time for which it holds"},
      {
          frame_parameter(),
          {"grain_diameter", grain.diameter, "m", "of the bed", Limits::between(1e-5, 1e-2)},
          {"grain_density", grain.density, "kg/m^3", "of the solid", Limits::positive()},
          {"porosity", grain.porosity, "", "of the bed at rest", Limits::between(0, 0.95)},
          {"angle_of_repose_deg", 33.0, "degrees", "of the bed", Limits::between(1, 60)},
          {"saltation", law, "", "law (of three numbers), or the path of a table of solved states"},
          {"reptation_diameters", MeanSplash{}.reptation_diameters, "grain diameters",
           "mean length of a reptation hop", Limits::positive()},
          {"hop_shortening", ripple.hop_shortening, "", "hops end early by this share of the bed's rise",
           Limits::not_negative()},
          {"slope_effect", ripple.slope_effect, "", "downslope bias of reptation", Limits::not_negative()},
          {"doubling_slope_deg", 22.0, "degrees", "slope at which the downslope bias has doubled",
           Limits::between(1, 90)},
          {"wavelength_law",
           std::string("constant"),
           "",
           "where ripples stop growing: nowhere, alike in every wind, or linear in the friction velocity",
           {},
           {"none", "constant", "linear"}},
          {"wavelength_diameters", 250.0, "grain diameters",
           "final wavelength; of the linear law, at twice the impact threshold", Limits::positive()},
          {"inflow",
           std::string("flat_bed"),
           "",
           "what comes in from upwind: as from a flat bed, nothing, or a random train of ripples",
           {},
           {"flat_bed", "none", "ripples"}},
          {"lateral_spread", ripple.lateral_spread, "", "spread of a hop across the wind / mean length",
           Limits::not_negative()},
          {"relief_scale", ripple.relief_scale, "m", "heights count above the surface smoothed over this",
           Limits::positive()},
          {"horizons", std::vector<double>{30, 60, 120, 300}, "s", "lead times of the forecasts, increasing",
           Limits::positive()},
          {"period", 30.0, "s", "between forecasts, by the stamps of the maps", Limits::positive()},
          {"wind_window", 60.0, "s", "the wind of so long before the map goes on blowing",
           Limits::positive()},
          {"max_gap", 5.0, "s", "longer times without wind are reported", Limits::positive()},
      },
      [] { return std::make_shared<Forecaster>(); }};
}

}  // namespace aeolian

PLUGINLIB_EXPORT_CLASS(aeolian::Forecaster, nodelet::Nodelet)
