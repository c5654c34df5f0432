#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/thinning.hpp"
#include "aeolian_twin/nodes/drawn_surface.hpp"

namespace aeolian {
namespace {

std_msgs::ColorRGBA to_colour(const Rgb& rgb) {
  std_msgs::ColorRGBA colour;
  colour.r = static_cast<float>(rgb[0]) / 255.0F;
  colour.g = static_cast<float>(rgb[1]) / 255.0F;
  colour.b = static_cast<float>(rgb[2]) / 255.0F;
  colour.a = 1;
  return colour;
}

/// Of two triangles each: steps from the south-western corner, counter-clockwise from above.
constexpr std::array<CellIndex, 6> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}};

}  // namespace

visualization_msgs::MarkerArray& DrawnMesh::draw(const DrawnLayers& layers, const SurfaceLook& look,
                                                 const TileMask& changed, const std_msgs::Header& header) {
  const TileMask thinned = thin(layers, changed);
  std::vector<CellRange> ranges = cells_.update({geometry_, heights_, values_}, look, thinned);
  for (CellRange& range : ranges) range = squares_at(range);
  const auto kept = [&](const CellRange& squares) { return has_squares_of(squares); };
  if (square_of_cell_.size() != heights_.size() || !std::all_of(ranges.begin(), ranges.end(), kept)) {
    make_squares();
    ranges = {squares_at({0, geometry_.nx(), 0, geometry_.ny()})};
  }
  for (const CellRange& squares : ranges) write(squares);
  visualization_msgs::Marker& mesh = markers_.markers.front();
  mesh.header = header;
  mesh.ns = "surface";
  mesh.type = visualization_msgs::Marker::TRIANGLE_LIST;
  mesh.action = visualization_msgs::Marker::ADD;
  mesh.pose.position.x = geometry_.origin_x() + look.offset[0];
  mesh.pose.position.y = geometry_.origin_y() + look.offset[1];
  mesh.pose.position.z = cells_.lowest() + look.offset[2];
  mesh.pose.orientation.w = 1;
  mesh.scale.x = mesh.scale.y = mesh.scale.z = 1;
  mesh.color.a = 1;
  return markers_;
}

/// Brings the blocks up to date; the tiles of them that have changed.
TileMask DrawnMesh::thin(const DrawnLayers& layers, const TileMask& changed) {
  const double cells = static_cast<double>(layers.geometry.size());
  const int factor = std::max(1, static_cast<int>(std::ceil(std::sqrt(cells / max_cells_))));
  const bool anew = full_ != layers.geometry;
  if (anew) {
    full_ = layers.geometry;
    geometry_ = thinned(full_, factor);
    heights_.resize(geometry_.size());
    values_.resize(geometry_.size());
    square_of_cell_.clear();
  }
  TileMask tiles = anew ? TileMask(geometry_, true) : thinned(changed, full_, factor);
  for (const CellRange& range : rectangles(tiles)) {
    aeolian::thin(full_, layers.heights, factor, range, heights_);
    aeolian::thin(full_, layers.values, factor, range, values_);
  }
  return tiles;
}

bool DrawnMesh::is_known(int x, int y) const {
  const auto known = [&](int cx, int cy) { return std::isfinite(heights_[geometry_.index(cx, cy)]); };
  return known(x, y) && known(x + 1, y) && known(x, y + 1) && known(x + 1, y + 1);
}

/// The squares that have a corner in a range of cells.
CellRange DrawnMesh::squares_at(const CellRange& cells) const {
  return {std::max(cells.x0 - 1, 0), std::min(cells.x1, geometry_.nx() - 1), std::max(cells.y0 - 1, 0),
          std::min(cells.y1, geometry_.ny() - 1)};
}

bool DrawnMesh::has_squares_of(const CellRange& squares) const {
  for (int y = squares.y0; y < squares.y1; ++y)
    for (int x = squares.x0; x < squares.x1; ++x)
      if (is_known(x, y) != (square_of_cell_[geometry_.index(x, y)] >= 0)) return false;
  return true;
}

void DrawnMesh::make_squares() {
  std::int32_t squares = 0;
  square_of_cell_.assign(heights_.size(), -1);
  for (int y = 0; y + 1 < geometry_.ny(); ++y)
    for (int x = 0; x + 1 < geometry_.nx(); ++x)
      if (is_known(x, y)) square_of_cell_[geometry_.index(x, y)] = squares++;
  visualization_msgs::Marker& mesh = markers_.markers.front();
  mesh.points.resize(corners.size() * static_cast<std::size_t>(squares));
  mesh.colors.resize(mesh.points.size());
}

void DrawnMesh::write(const CellRange& squares) {
  visualization_msgs::Marker& mesh = markers_.markers.front();
  for (int y = squares.y0; y < squares.y1; ++y) {
    for (int x = squares.x0; x < squares.x1; ++x) {
      const std::int32_t square = square_of_cell_[geometry_.index(x, y)];
      if (square < 0) continue;
      std::size_t vertex = corners.size() * static_cast<std::size_t>(square);
      for (const CellIndex& corner : corners) {
        const CellIndex cell{x + corner.x, y + corner.y};
        const std::size_t i = geometry_.index(cell);
        geometry_msgs::Point& point = mesh.points[vertex];
        point.x = (cell.x + 0.5) * geometry_.cell();
        point.y = (cell.y + 0.5) * geometry_.cell();
        point.z = cells_.drawn_height(heights_[i]);
        mesh.colors[vertex] = to_colour(cells_.colour(i));
        ++vertex;
      }
    }
  }
}

}  // namespace aeolian
