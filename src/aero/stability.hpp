#pragma once

#include "aero/critical_speed.hpp"
#include "aero/follow_mode.hpp"

/// Stability in wind: modes over the wind speed, and the speeds at which one loses its damping.
