#pragma once

/// The room `twin`: say what the surface will be, and be scored when the measurement comes.

#include "aeolian_core/twin/comparison.hpp"
#include "aeolian_core/twin/forecast.hpp"
#include "aeolian_core/twin/report.hpp"
