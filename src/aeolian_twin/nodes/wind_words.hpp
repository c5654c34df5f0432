#pragma once

#include <ros/time.h>

#include "aeolian_core/twin/forecast_engine.hpp"
#include "aeolian_twin/nodes/tell.hpp"

namespace aeolian {

/// Says what the wind of a forecast is made of ("wind", "wind ahead"). `stamp` is the map's, `settings` are
/// the engine's.
void tell_of_wind(const ForecastEngine::Taken& taken, const ForecastEngine::Settings& settings,
                  const ros::Time& stamp, const Tell& tell);

}  // namespace aeolian
