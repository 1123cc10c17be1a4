#pragma once

#include "fe/bar.hpp"
#include "fe/beam.hpp"
#include "fe/beam_geometric.hpp"
#include "fe/beam_mass.hpp"
#include "fe/shell_bending.hpp"
#include "fe/shell_mass.hpp"
#include "fe/shell_membrane.hpp"

/// The catalogue of beams, bars and shells. Element matrices are pure functions: geometry and properties in, matrices in global
/// axes out.
