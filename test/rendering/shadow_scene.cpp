#include "shadow_scene.hpp"
