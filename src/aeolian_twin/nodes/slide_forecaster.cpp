#include <atomic>
#include <cmath>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <pluginlib/class_list_macros.hpp>
#include <std_msgs/Float64.h>
#include <std_srvs/Trigger.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/buffer.h>

#include "aeolian_core/slide/piles/site_piles.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/nodes/conversions.hpp"
#include "aeolian_twin/nodes/job_thread.hpp"
#include "aeolian_twin/nodes/map_receiver.hpp"
#include "aeolian_twin/nodes/node.hpp"
#include "aeolian_twin/nodes/slide_settings.hpp"
#include "aeolian_twin/nodes/transform_input.hpp"

namespace aeolian {
namespace {

constexpr std::size_t most_waiting = 100;  ///< slabs
const ros::WallDuration look(0.1);         ///< whether the last event is over
constexpr double same_angle = 0.01;        ///< a panel that has turned by less stands where it stood [rad]

bool same_place(const PlacedSlide& a, const PlacedSlide& b) {
  const double moved = std::hypot(a.site.x - b.site.x, a.site.y - b.site.y);
  return moved + std::abs(a.scene.panel_height - b.scene.panel_height) < a.scene.cell &&
         std::abs(a.scene.tilt - b.scene.tilt) < same_angle &&
         std::abs(std::remainder(a.site.direction - b.site.direction, 2 * M_PI)) < same_angle;
}

std::string words(PileNews news) {
  switch (news) {
    case PileNews::seen:
      return "the map shows the pile";
    case PileNews::unseen:
      return "the map does not show the pile yet: it is kept";
    case PileNews::contradicted:
      return "the map shows neither the pile nor the ground before it: what it shows is ground now";
    case PileNews::none:
      break;
  }
  return "no pile yet";
}

}  // namespace

/// Lets slabs of snow slide off a panel onto the newest map, in a thread of its own.
class SlideForecaster : public Node {
 public:
  SlideForecaster() : Node(describe_slide_forecaster()) {}

 private:
  /// All that an event needs.
  struct Job {
    PlacedSlide slide;
    double thickness;
    HeightMap map;
    std::string frame;
    ros::Time stamp;
  };

  void start() override {
    slide_ = read_slide(parameters());
    make_piles(slide_);  // refuses what is not possible before anything is advertised
    publisher_ = nh().advertise<grid_map_msgs::GridMap>("pile", 10, /*latch=*/true);
    transforms_ = std::make_unique<TransformInput>(tf_buffer_);
    WantedMap wanted;
    wanted.layers = {layer::elevation, layer::variance};
    wanted.accept = [this](const std::string& topic, const std_msgs::Header& header) {
      require_frame(topic, header);
    };
    receiver_ = std::make_unique<MapReceiver>(
        nh(), "height_map",
        [this](const HeightMap& map, const std_msgs::Header&, const TileMask&) {
          good("map", fmt::format("{} x {} cells", map.geometry().nx(), map.geometry().ny()));
        },
        [this](const std::string& reason) { bad("map", reason); }, wanted);
    slab_subscriber_ = nh().subscribe("slab", 100, &SlideForecaster::take_slab, this);
    servers_ = {nh().advertiseService("release", &SlideForecaster::release, this),
                nh().advertiseService("clear_pile", &SlideForecaster::clear, this)};
    worker_.start([this](const Job& job) { run(job); });
    timer_ = nh().createWallTimer(look, [this](const ros::WallTimerEvent&) { begin_next(); });
  }

  void take_slab(const std_msgs::Float64::ConstPtr& message) {
    try {
      enqueue(message->data);
    } catch (const Error& error) {
      bad("slab", fmt::format("{}: {}", slab_subscriber_.getTopic(), error.what()));
    }
  }

  bool release(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
    try {
      enqueue(slide_.scene.slab_thickness);
      response.success = 1;
      response.message = fmt::format("a slab of {:g} m slides", slide_.scene.slab_thickness);
    } catch (const Error& error) {
      bad("slab", error.what());
      response.success = 0;
      response.message = error.what();
    }
    return true;
  }

  bool clear(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
    forget_ = true;
    response.success = 1;
    response.message = "the next event finds the ground as the map shows it";
    return true;
  }

  /// Throws Error for a slab that cannot slide, whatever the ground.
  void enqueue(double thickness) {
    if (!receiver_->known()) throw Error("there is no map yet on " + receiver_->topic());
    SlideScene scene = slide_.scene;
    scene.slab_thickness = thickness;
    check_apart_from_ground(scene, parameters().integer("dimensions"));
    if (waiting_.size() >= most_waiting)
      throw Error(fmt::format("{} slabs wait already, must be fewer", waiting_.size()));
    waiting_.push_back(thickness);
    good("slab", fmt::format("{:g} m thick", thickness));
    begin_next();
  }

  /// Hands the next slab to the worker when that has nothing to do, with the map and the panel as they are.
  void begin_next() {
    if (waiting_.empty() || !worker_.idle()) return;
    const double thickness = waiting_.front();
    waiting_.pop_front();
    try {
      worker_.submit(
          {placed(), thickness, receiver_->map(), parameters().text("frame_id"), ros::Time::now()});
    } catch (const Error& error) {
      bad("panel", error.what());
    }
  }

  /// The panel where it stands now.
  PlacedSlide placed() {
    const std::string& frame = parameters().text("panel_frame");
    if (frame.empty()) return slide_;
    PlacedSlide slide = slide_;
    try {
      const auto transform = tf_buffer_.lookupTransform(parameters().text("frame_id"), frame, ros::Time());
      place_panel(slide, tf2::transformToEigen(transform), frame);
      good("panel", fmt::format("is at ({:.3f}, {:.3f}, {:.3f}) m", slide.site.x, slide.site.y,
                                slide.scene.panel_height));
      return slide;
    } catch (const tf2::TransformException& error) {
      throw Error(error.what());
    }
  }

  void make_piles(const PlacedSlide& slide) {
    piles_ = make_site_piles(slide.scene, slide.site, parameters().integer("dimensions"),
                             parameters().number("model_error"));
    piles_of_ = slide;
  }

  void run(const Job& job) {
    try {
      if (!same_place(job.slide, piles_of_)) make_piles(job.slide);
      if (forget_.exchange(false)) piles_->forget();
      const ros::WallTime begin = ros::WallTime::now();
      const auto event = piles_->release(job.map, job.thickness, [this](const SiteMoment& m) {
        good("slide", fmt::format("event {}: {:.2f} s after release the fastest snow moves at {:.2f} m/s, {} "
                                  "particles move",
                                  m.event, m.time, m.fastest, m.awake));
        return !worker_.stopping();
      });
      if (event) publish(*event, job, (ros::WallTime::now() - begin).toSec());
    } catch (const Error& error) {
      bad("slide", error.what());
    }
  }

  void publish(const SitePile& event, const Job& job, double seconds) {
    std_msgs::Header header;
    header.frame_id = job.frame;
    header.stamp = job.stamp;
    publisher_.publish(to_message(event.patch, header));
    good("ground", fmt::format("{}; {:.0f} % of it is guessed from what lies about", words(event.news),
                               100 * event.guessed));
    const std::string line = fmt::format(
        "event {} is over: {:.3f} m high, {:.3f} m long, head {:.3f} m from the panel's middle; {:.1f} "
        "s of computing for {:.1f} s",
        event.number, event.size.height, event.size.length, event.size.head, seconds, event.duration);
    event.still ? good("slide", line) : bad("slide", line + ", and the snow still moves");
  }

  PlacedSlide slide_;  ///< as the parameters say
  tf2_ros::Buffer tf_buffer_;
  std::unique_ptr<TransformInput> transforms_;
  std::unique_ptr<MapReceiver> receiver_;
  ros::Publisher publisher_;
  ros::Subscriber slab_subscriber_;
  std::vector<ros::ServiceServer> servers_;
  ros::WallTimer timer_;
  std::deque<double> waiting_;  ///< thicknesses [m]

  std::unique_ptr<SitePiles> piles_;  ///< the worker's, once it runs
  PlacedSlide piles_of_;              ///< the same

  std::atomic<bool> forget_{false};  ///< asked for by the node, done by the worker
  JobThread<Job> worker_;            ///< the last member: it uses the others
};

NodeDescription describe_slide_forecaster() {
  std::vector<ParameterDeclaration> parameters = slide_parameters();
  parameters.insert(parameters.begin(), frame_parameter());
  const std::vector<ParameterDeclaration> more{
      {"dimensions", 2, "", "2: a slice down the slope, as wide as the slab; or 3", Limits::between(2, 3)},
      {"model_error", 0.2, "", "of the pile's depth, a share of it (standard deviation)",
       Limits::not_negative()},
      {"seed", 1, "", "decides everything random", Limits::between(0, 1e9)},
      {"threads", 1, "", "of the solver; 0: as many as the machine has", Limits::between(0, 1024)},
  };
  parameters.insert(parameters.end(), more.begin(), more.end());
  return {
      "slide_forecaster",
      "lets snow slide off a panel and pile up on the newest map",
      {"height_map, height_map_updates (grid_map_msgs/GridMap): whole, what has changed; the ground",
       "slab (std_msgs/Float64): the thickness of a slab on the panel [m], which slides off",
       "release (std_srvs/Trigger, a service): a slab of ~slab_thickness slides off",
       "clear_pile (std_srvs/Trigger, a service): the pile is forgotten, the map is the ground",
       "tf from ~panel_frame to ~frame_id, when ~panel_frame is set"},
      {"pile (grid_map_msgs/GridMap, latched): what the last event has left, on the map's cells: elevation, "
       "ground [m], variance [m^2]; for the topic patches of height_mapper"},
      parameters,
      [] { return std::make_shared<SlideForecaster>(); }};
}

}  // namespace aeolian

PLUGINLIB_EXPORT_CLASS(aeolian::SlideForecaster, nodelet::Nodelet)
