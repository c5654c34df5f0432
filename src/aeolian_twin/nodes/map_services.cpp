#include "aeolian_twin/nodes/map_services.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <tf2_eigen/tf2_eigen.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/submap.hpp"
#include "aeolian_twin/nodes/conversions.hpp"
#include "aeolian_twin/nodes/map_file.hpp"

namespace aeolian {
namespace {

std::string topic_of(const grid_map_msgs::ProcessFile::Request& request) {
  return request.topic_name.empty() ? "height_map" : request.topic_name;
}

/// The cells of a map within a box about a point; throws Error when there are none.
CellRange cells_within(const GridGeometry& g, const Eigen::Vector2d& centre, double length_x,
                       double length_y) {
  const auto bounded = [](double cells, int count) {
    return static_cast<int>(std::clamp(cells, 0.0, static_cast<double>(count)));
  };
  const double slack = 1e-6;  // of a cell: borders that are meant to be those of cells
  const auto first = [&](double from, int count) { return bounded(std::floor(from + slack), count); };
  const auto end = [&](double to, int count) { return bounded(std::ceil(to - slack), count); };
  const double x = (centre.x() - g.origin_x()) / g.cell();
  const double y = (centre.y() - g.origin_y()) / g.cell();
  const double half_x = length_x / (2 * g.cell());
  const double half_y = length_y / (2 * g.cell());
  const CellRange range{first(x - half_x, g.nx()), end(x + half_x, g.nx()), first(y - half_y, g.ny()),
                        end(y + half_y, g.ny())};
  if (!(length_x > 0 && length_y > 0) || range.x0 >= range.x1 || range.y0 >= range.y1)
    throw Error(fmt::format(
        "a submap of {} m x {} m about ({}, {}) m has no cell of the map, which is {} m x "
        "{} m from ({}, {}) m",
        length_x, length_y, centre.x(), centre.y(), g.length_x(), g.length_y(), g.origin_x(), g.origin_y()));
  return range;
}

}  // namespace

MapServices::MapServices(ros::NodeHandle& node, Host host) : host_(std::move(host)) {
  servers_ = {node.advertiseService("save_map", &MapServices::save, this),
              node.advertiseService("load_map", &MapServices::load, this),
              node.advertiseService("clear_map", &MapServices::clear, this),
              node.advertiseService("get_submap", &MapServices::get_submap, this),
              node.advertiseService("masked_replace", &MapServices::masked_replace, this),
              node.advertiseService("enable_updates", &MapServices::enable_updates, this),
              node.advertiseService("disable_updates", &MapServices::disable_updates, this)};
}

/// Does the work of a service and tells the line that it gives, or its error, once: nothing is wrong after
/// it.
template <class Work>
bool MapServices::attempt(const std::string& service, Work&& work) {
  try {
    host_.good(service, work());
    return true;
  } catch (const Error& error) {
    host_.bad(service, error.what());
    host_.good(service, "the last call failed");
    return false;
  }
}

std::string MapServices::file_of(const ProcessFile::Request& request) const {
  const std::string file = request.file_path.empty() ? host_.default_file() : request.file_path;
  return std::filesystem::absolute(file).string();
}

bool MapServices::save(ProcessFile::Request& request, ProcessFile::Response& response) {
  response.success = attempt("save_map", [&] {
    const std::string file = file_of(request);
    save_map(host_.live.stored(), file, topic_of(request));
    return "saved to " + file;
  });
  return true;
}

bool MapServices::load(ProcessFile::Request& request, ProcessFile::Response& response) {
  response.success = attempt("load_map", [&] {
    const std::string file = file_of(request);
    host_.live.load(load_map(file, topic_of(request)));
    host_.is_another();
    return "loaded from " + file;
  });
  return true;
}

bool MapServices::clear(Empty::Request&, Empty::Response&) {
  if (!host_.live.begun()) return true;
  host_.live.clear();
  host_.is_another();
  return true;
}

bool MapServices::get_submap(GetGridMap::Request& request, GetGridMap::Response& response) {
  return attempt("get_submap", [&] {
    const HeightMap& map = host_.live.map();
    HeightMap part =
        submap(map, cells_within(map.geometry(), position_of(request), request.length_x, request.length_y));
    HeightMap asked(part.geometry());
    for (const std::string& name : request.layers.empty() ? part.names() : request.layers)
      asked.add(name, part.layer(name));
    response.map = to_message(asked, host_.live.header());
    return fmt::format("{} x {} cells", asked.geometry().nx(), asked.geometry().ny());
  });
}

Eigen::Vector2d MapServices::position_of(const GetGridMap::Request& request) const {
  const Eigen::Vector3d position(request.position_x, request.position_y, 0);
  const std::string& frame = host_.live.frame();
  if (request.frame_id.empty() || request.frame_id == frame) return position.head<2>();
  try {
    const auto transform = host_.transforms.lookupTransform(frame, request.frame_id, ros::Time());
    return (tf2::transformToEigen(transform) * position).head<2>();
  } catch (const tf2::TransformException& error) {
    throw Error(error.what());
  }
}

bool MapServices::masked_replace(SetGridMap::Request& request, SetGridMap::Response&) {
  return attempt("masked_replace", [&] {
    const TileMask changed = host_.live.replace(to_height_map(request.map), request.map.info.header.frame_id);
    host_.has_changed(changed);
    return fmt::format("cells of {} tiles replaced", changed.count());
  });
}

bool MapServices::enable_updates(Empty::Request&, Empty::Response&) {
  updates_enabled_ = true;
  return true;
}

bool MapServices::disable_updates(Empty::Request&, Empty::Response&) {
  updates_enabled_ = false;
  return true;
}

}  // namespace aeolian
