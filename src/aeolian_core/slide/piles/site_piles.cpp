#include "aeolian_core/slide/piles/site_piles.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "aeolian_core/slide/piles/slide_series.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/median.hpp"
#include "aeolian_core/surface/require.hpp"
#include "aeolian_core/surface/resample.hpp"

namespace aeolian {
namespace {

constexpr double sigmas = 3;  ///< within which a map agrees with a pile

template <int Dim>
class Piles : public SitePiles {
 public:
  Piles(const SlideScene& scene, const SlideSite& site, double model_error)
      : scene_(scene), site_(site), model_error_(model_error) {
    scene_.ground.reset();
    check_apart_from_ground(scene_, Dim);
  }

  std::optional<SitePile> release(const HeightMap& map, double thickness, const Watch& watch) override {
    SlideScene scene = scene_;
    scene.slab_thickness = thickness;
    check_apart_from_ground(scene, Dim);
    SiteGround ground = ground_of_site(map, scene, site_, Dim);
    SitePile result;
    result.guessed = ground.guessed;
    result.news = news(ground.map);
    if (result.news == PileNews::seen || result.news == PileNews::unseen)
      lay_bare(ground.map, 1.5 * map.geometry().cell() + scene.cell);
    scene.ground = std::move(ground.map);
    check(scene, Dim);
    if (!series_) series_.emplace(scene);
    series_->go_on(scene);
    if (result.news == PileNews::contradicted) forget();
    const auto shown = [&](const SlideMoment<Dim>& m) {
      return watch({m.event, m.time, m.snow.fastest(), m.snow.awake()});
    };
    const auto event = series_->next(watch ? shown : typename SlideSeries<Dim>::Watch());
    if (!event) return std::nullopt;
    pile_ = pile_map<Dim>(scene, event->snow, scene.cell);
    bare_ = *scene.ground;
    result.number = event->number;
    result.size = event->pile;
    result.duration = event->duration;
    result.still = event->still;
    result.left_behind = event->left_behind / (event->left_behind + event->mass);
    result.patch = site_patch(map, scene, site_, *pile_, bare_, Dim, model_error_);
    return result;
  }

  void forget() override {
    if (series_) series_->drop_pile();
    pile_.reset();
  }

 private:
  double depth(std::size_t cell) const {
    return static_cast<double>(pile_->layer(layer::elevation)[cell]) -
           static_cast<double>(pile_->layer(layer::ground)[cell]);
  }

  /// By the medians over the cells with deep snow of what the map differs from bare ground and from the pile.
  PileNews news(const HeightMap& ground) const {
    if (!pile_) return PileNews::none;
    std::vector<double> from_bare, from_pile, variances;
    const GridGeometry& grid = pile_->geometry();
    for (std::size_t k = 0; k < grid.size(); ++k) {
      const CellIndex at = grid.cell_at(k);
      if (depth(k) < 2 * scene_.cell || !ground.geometry().find(grid.x(at.x), grid.y(at.y))) continue;
      const double seen =
          sample(ground.geometry(), ground.layer(layer::elevation), grid.x(at.x), grid.y(at.y));
      from_bare.push_back(std::abs(seen - static_cast<double>(pile_->layer(layer::ground)[k])));
      from_pile.push_back(std::abs(seen - static_cast<double>(pile_->layer(layer::elevation)[k])));
      variances.push_back(static_cast<double>(pile_->layer(layer::variance)[k]) +
                          model_error_ * model_error_ * depth(k) * depth(k));
    }
    if (from_bare.empty()) return PileNews::unseen;
    const double bare = median(from_bare), covered = median(from_pile);
    if (covered <= bare)
      return covered <= sigmas * std::sqrt(median(variances)) ? PileNews::seen : PileNews::contradicted;
    return bare <= scene_.cell ? PileNews::unseen : PileNews::contradicted;
  }

  /// Puts the ground of the last event where there is snow within `reach` [m]: beside the pile the map's
  /// cells mix it with the ground.
  void lay_bare(HeightMap& ground, double reach) const {
    const GridGeometry& grid = ground.geometry();
    for (std::size_t k = 0; k < grid.size(); ++k) {
      const CellIndex at = grid.cell_at(k);
      const double x = grid.x(at.x), y = grid.y(at.y);
      if (!bare_.geometry().find(x, y) || !has_snow_near(x, y, reach)) continue;
      for (const std::string& name : {layer::elevation, layer::variance})
        ground.layer(name)[k] = static_cast<float>(sample(bare_.geometry(), bare_.layer(name), x, y));
    }
  }

  bool has_snow_near(double x, double y, double reach) const {
    const GridGeometry& grid = pile_->geometry();
    const double step = grid.cell();
    const double across = Dim == 3 ? reach : 0;
    for (double dy = -across; dy <= across; dy += step)
      for (double dx = -reach; dx <= reach; dx += step)
        if (const auto cell = grid.find(x + dx, y + dy))
          if (depth(grid.index(*cell)) > 0) return true;
    return false;
  }

  SlideScene scene_;
  SlideSite site_;
  double model_error_;
  std::optional<SlideSeries<Dim>> series_;
  std::optional<HeightMap> pile_;  ///< in the slide's axes
  HeightMap bare_;                 ///< the ground that it lies on, in the same axes
};

}  // namespace

void check_apart_from_ground(const SlideScene& scene, int dimensions) {
  constexpr double far = 1e5;  // ground below [m]
  SlideScene high = scene;
  high.ground.reset();
  if (std::isfinite(high.panel_height)) high.panel_height = far;
  check(high, dimensions);
}

std::unique_ptr<SitePiles> make_site_piles(const SlideScene& scene, const SlideSite& site, int dimensions,
                                           double model_error) {
  constexpr Require require{"slide"};
  require(dimensions == 2 || dimensions == 3, "number of dimensions", dimensions, "2 or 3");
  require(model_error >= 0 && std::isfinite(model_error), "model error", model_error, "at least 0");
  if (dimensions == 3) return std::make_unique<Piles<3>>(scene, site, model_error);
  return std::make_unique<Piles<2>>(scene, site, model_error);
}

}  // namespace aeolian
