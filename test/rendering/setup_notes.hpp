#pragma once

#include "scene_layout.hpp"
#include "shadow_scene.hpp"

#include "aeolian_core/surface/random.hpp"

namespace aeolian {

enum class LightNote { angles, post, sun };

/// What a careful person would write down of a scene, with that person's errors.
struct NoteTaking {
  LightNote light = LightNote::angles;
  bool markers = true;     ///< on the straightedge, rather than the pixels of two rows of marks
  bool calibrated = true;  ///< the camera is known
  bool height = false;
  bool wind = false;
  bool line = false;  ///< pixels of the casting edge
};

/// A date and place at which the sun stands between 15 and 55 degrees.
struct SunTime {
  double unix_time;
  double latitude;
  double longitude;
  double elevation;
  double azimuth;
};
SunTime random_sun(RandomStream* random);

/// Draws markers or marks onto the straightedge, between `from` and `to` [m].
void mark_straightedge(ShadowScene* scene, bool markers, double from, double to);

PhotoSetup take_notes(const ShadowScene& scene, const SceneLayout& layout, const NoteTaking& notes,
                      const SunTime& sun, int downwind, RandomStream* random);

}  // namespace aeolian
