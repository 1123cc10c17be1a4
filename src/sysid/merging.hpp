#pragma once

#include "sysid/merge_poser.hpp"
#include "sysid/merge_preger.hpp"

/// Setups of one campaign merged after identification (PoSER) or before it (PreGER).
