#include "aeolian_twin/slide/slide_config.hpp"

#include <cmath>
#include <filesystem>

#include "aeolian_core/surface/geotiff.hpp"
#include "aeolian_core/surface/yaml_section.hpp"

namespace aeolian {
namespace {

/// Which of two words.
bool first_of(YamlSection& section, const std::string& key, const std::string& first,
              const std::string& second) {
  const std::string word = section.text(key);
  if (word != first && word != second) section.refuse(key, "must be " + first + " or " + second);
  return word == first;
}

void read_snow(YamlSection section, SnowLaw& snow) {
  snow.density = section.positive("density_kg_m3", 1e4);
  snow.youngs_modulus = 1e6 * section.number("youngs_modulus_mpa", 1e-3, 1e4);
  snow.poisson_ratio = section.number("poisson_ratio", 0, 0.49);
  snow.friction = section.positive("m", 10);
  snow.consolidation = 1e3 * section.positive("p0_kpa", 1e6);
  snow.cohesion = section.number("beta", 0, 10);
  snow.hardening = section.positive("xi", 100);
  section.finish();
}

void read_panel(YamlSection section, SlideScene& scene) {
  scene.panel_length = section.positive("length_m", 1e4);
  scene.panel_width = section.positive("width_m", 1e4);
  scene.tilt = section.number("tilt_deg", 0, 90) * M_PI / 180;
  scene.panel_height = section.number("height_m", -1e4, 1e4);
  scene.height_of = first_of(section, "height_of", "centre", "lower_edge") ? SlideScene::HeightOf::centre
                                                                           : SlideScene::HeightOf::lower_edge;
  scene.panel_friction = section.number("friction", 0, 10);
  section.finish();
}

void read_slab(YamlSection section, SlideScene& scene) {
  scene.slab_thickness = section.positive("thickness_m", 1e3);
  scene.slab_width = section.positive("width_m", 1e4);
  section.finish();
}

void read_grid(YamlSection section, SlideScene& scene) {
  scene.cell = section.positive("cell_m", 1e3);
  scene.particles_per_cell = section.number("particles_per_cell", 1, 1000);
  scene.transfer = first_of(section, "transfer", "apic", "flip") ? Transfer::apic : Transfer::flip;
  section.finish();
}

}  // namespace

SlideConfig read_slide_config(const std::string& file) {
  YamlSection root = YamlSection::load(file);
  SlideConfig config;
  config.name = root.text("name");
  read_snow(root.section("snow"), config.scene.snow);
  read_panel(root.section("panel"), config.scene);
  read_slab(root.section("slab"), config.scene);
  read_grid(root.section("grid"), config.scene);
  config.events = root.integer("events", 1, 1000);
  config.scene.between = first_of(root, "between_events", "keep", "reseed") ? SlideScene::Between::keep
                                                                            : SlideScene::Between::reseed;
  if (root.has("ground"))
    config.scene.ground =
        read_geotiff((std::filesystem::path(file).parent_path() / root.text("ground")).string());
  root.finish();
  return config;
}

}  // namespace aeolian
