#pragma once

#include <functional>
#include <string>
#include <vector>

#include "shadow_scene.hpp"

namespace aeolian {

/// A photograph that must be refused: a scene that shows no measurable shadow, or one spoilt afterwards.
struct UnmeasurableScene {
  std::string name;
  std::string reason;  ///< what a refusal should speak of: shadow, exposed, contrast, two, frame, blur, marks
  SetUp set_up;
  std::function<void(Photo*)> spoil;  ///< what happened to the picture; may be empty

  Photo photo() const;
};

/// Fifty of them, of about a megapixel; always the same.
std::vector<UnmeasurableScene> unmeasurable_set_ups();

}  // namespace aeolian
