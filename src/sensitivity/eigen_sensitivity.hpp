#pragma once

#include "sensitivity/channel_sensitivity.hpp"
#include "sensitivity/frequency_jacobian.hpp"
#include "sensitivity/shape_sensitivity.hpp"

/// Exact derivatives of frequencies and shapes.
