#include <memory>
#include <mutex>

#include <fmt/format.h>
#include <pluginlib/class_list_macros.hpp>
#include <std_srvs/SetBool.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/twin/forecast_engine.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/nodes/conversions.hpp"
#include "aeolian_twin/nodes/engine_settings.hpp"
#include "aeolian_twin/nodes/job_thread.hpp"
#include "aeolian_twin/nodes/map_receiver.hpp"
#include "aeolian_twin/nodes/node.hpp"
#include "aeolian_twin/nodes/wind_words.hpp"

namespace aeolian {

/// Hands maps and wind to a ForecastEngine and runs its forecasts in a thread of its own.
class Forecaster : public Node {
 public:
  Forecaster() : Node(describe_forecaster()) {}

 private:
  /// A job and the header of its map.
  struct Job {
    ForecastJob job;
    std_msgs::Header header;
  };

  void start() override {
    engine_ = std::make_unique<ForecastEngine>(read_engine(parameters(), tell_));
    prepare_engine(parameters(), *engine_, tell_);
    const auto horizons = static_cast<std::uint32_t>(engine_->settings().horizons.size());
    publisher_ = nh().advertise<grid_map_msgs::GridMap>("forecast", horizons + 10);
    wind_subscriber_ = nh().subscribe("wind_field", 1000, &Forecaster::take_wind, this);
    ahead_subscriber_ = nh().subscribe("wind_ahead", 10, &Forecaster::take_wind_ahead, this);
    if (engine_->learner()) {
      learned_publisher_ = nh().advertise<aeolian_msgs::LearnedParameters>("learned", 10, /*latch=*/true);
      freeze_server_ = nh().advertiseService("freeze_learning", &Forecaster::freeze, this);
    }
    WantedMap wanted;
    wanted.layers = {layer::elevation, layer::ground};
    if (engine_->learner()) wanted.layers.push_back(layer::variance);
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
    worker_.start([this](const Job& job) { run(job); });
  }

  void take_wind(const grid_map_msgs::GridMap::ConstPtr& message) {
    try {
      require_frame(wind_subscriber_.getTopic(), message->info.header);
      const WindField field = to_wind_field(*message);
      const std::lock_guard<std::mutex> lock(mutex_);
      engine_->take_wind(
          {message->info.header.stamp.toSec(), field.friction_velocity, field.direction, field.air_density});
    } catch (const Error& error) {
      bad("wind", error.what());
    }
  }

  void take_wind_ahead(const aeolian_msgs::WindAhead::ConstPtr& message) {
    try {
      require_frame(ahead_subscriber_.getTopic(), message->header);
      std::vector<WindSample> samples = to_wind_samples(*message, bed_roughness(parameters()));
      const std::lock_guard<std::mutex> lock(mutex_);
      engine_->give_wind_ahead(std::move(samples));
    } catch (const Error& error) {
      bad("wind ahead", error.what());
    }
  }

  void take_map(const HeightMap& map, const std_msgs::Header& header) {
    if (header.stamp < last_map_)
      bad("clock", fmt::format("time jumped back by {:.1f} s (a bag that loops?)",
                               (last_map_ - header.stamp).toSec()));
    else if (!last_map_.isZero())
      good("clock", "time runs forward");
    last_map_ = header.stamp;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ForecastEngine::Taken taken = engine_->take_map(map, header.stamp.toSec());
      tell_of_wind(taken, engine_->settings(), header.stamp, tell_);
      if (taken.learned) publish(*taken.learned, header);
      if (taken.job) submit({std::move(*taken.job), header});
    }
    good("map", "in use");
  }

  void publish(const ParameterLearner::Update& update, const std_msgs::Header& header) {
    const LearnedState& state = engine_->learner()->state();
    learned_publisher_.publish(to_message(state, update, engine_->believes(), header));
    if (!update.learned) {
      good("learning", "nothing learned: " + update.why_not);
      return;
    }
    try {
      const std::string& path = parameters().text("learned_file");
      if (!path.empty()) engine_->learner()->save(path);
      good("learning", fmt::format("{} updates; the friction velocity is {:.3f} times what is given; {}",
                                   state.updates, update.after.friction_velocity,
                                   engine_->believes() ? "in use" : "not in use until it forecasts better"));
    } catch (const Error& error) {
      bad("learning", error.what());
    }
  }

  bool freeze(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
    const std::lock_guard<std::mutex> lock(mutex_);
    engine_->learner()->freeze(request.data);
    response.success = 1;
    response.message = request.data ? "misses are only watched" : "misses are learned from";
    return true;
  }

  /// Hands a job to the worker; one that still waits there is replaced, so that the newest map wins.
  void submit(Job job) {
    const double time = job.job.time;
    if (worker_.submit(std::move(job))) {
      good("speed", "forecasts keep up with the maps");
    } else {
      bad("speed",
          fmt::format("a forecast still runs when the next is due after {} s (~period): the newest map waits",
                      engine_->settings().period));
      engine_->defer(time);
    }
  }

  void run(const Job& job) {
    try {
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        engine_->begin(job.job.time);
      }
      const ros::WallTime begin = ros::WallTime::now();
      const EnsembleForecast result = engine_->run(job.job);
      for (const Forecast& forecast : result.forecasts) {
        std_msgs::Header header = job.header;
        header.stamp += ros::Duration(forecast.lead_time);
        publisher_.publish(to_message(forecast.map, header));
      }
      const Forcing forcing = forcing_of(engine_->settings().physics, job.job.wind.front(), job.job.median);
      good("forecast",
           fmt::format(
               "{} horizons, {} members in {:.2f} s; depth set moving {:.3g} mm/s towards {:.0f} degrees "
               "from east",
               result.forecasts.size(), result.members.size(), (ros::WallTime::now() - begin).toSec(),
               1e3 * forcing.erosion_rate(), radians_to_degrees(forcing.direction)));
    } catch (const Error& error) {
      bad("forecast", error.what());
    }
  }

  const Tell tell_ = [this](const std::string& thing, bool well, const std::string& line) {
    well ? good(thing, line) : bad(thing, line);
  };
  ros::Time last_map_;
  ros::Publisher publisher_;
  ros::Publisher learned_publisher_;
  ros::ServiceServer freeze_server_;
  ros::Subscriber wind_subscriber_;
  ros::Subscriber ahead_subscriber_;
  std::unique_ptr<MapReceiver> receiver_;

  std::mutex mutex_;  ///< guards what follows, but for what of the engine is constant
  std::unique_ptr<ForecastEngine> engine_;
  JobThread<Job> worker_;  ///< the last member: it uses the others
};

NodeDescription describe_forecaster() {
  std::vector<ParameterDeclaration> parameters = engine_parameters();
  parameters.insert(parameters.begin(), frame_parameter());
  return {"forecaster",
          "predicts the surface from the newest map and the wind",
          {"height_map, height_map_updates (grid_map_msgs/GridMap): whole, what has changed",
           "wind_field (grid_map_msgs/GridMap)",
           "wind_ahead (aeolian_msgs/WindAhead): the wind to come, where somebody knows it",
           "freeze_learning (std_srvs/SetBool, a service): with ~members, misses are only watched"},
          {"forecast (grid_map_msgs/GridMap) for each horizon: elevation, initial [m], lead_time [s], with "
           "~members spread [m]; stamped with the time for which it holds",
           "learned (aeolian_msgs/LearnedParameters, latched): with ~members, what misses have told"},
          parameters,
          [] { return std::make_shared<Forecaster>(); }};
}

}  // namespace aeolian

PLUGINLIB_EXPORT_CLASS(aeolian::Forecaster, nodelet::Nodelet)
