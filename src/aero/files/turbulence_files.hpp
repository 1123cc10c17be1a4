#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "wind/component.hpp"
#include "wind/spectrum.hpp"
#include "wind/turbulence.hpp"

namespace twindeck::aero {

/// Reads a set by its name from a file such as data/wind/turbulence_sets.csv, whose columns have the paper's letters (v along,
/// u across, w vertical).
/// @throws InputError  for an unknown set, with the nearest name and all names; for a number out of its range
[[nodiscard]] wind::TurbulenceSet read_turbulence_set(const std::filesystem::path& file, const std::string& name);

/// Measured laws of the turbulence as tables. The column `component` has the paper's letters (v along the wind, u across it,
/// w vertical); each component's rows ascend.
/// Spectra: columns `component,f_L_over_V,f_S_over_variance`.
/// @param wanted  components that have to be there @return  by component, none for those that are not in the file
/// @throws InputError  for a number that is not positive, rows that do not ascend, fewer than two rows of a component, and a
///                     spectrum whose integral is more than 5 % off its variance
[[nodiscard]] std::array<std::shared_ptr<const wind::SpectrumTable>, 3> read_spectra(
    const std::filesystem::path& file, const std::vector<wind::Component>& wanted);

/// Coherences: columns `component,reduced_separation,coherence`, from 1 at 0 to nearly 0.
/// @throws InputError  also for a coherence outside [-1, 1], and one that does not begin with 1 at 0 or does not die out
[[nodiscard]] std::array<std::shared_ptr<const wind::CoherenceTable>, 3> read_coherences(
    const std::filesystem::path& file, const std::vector<wind::Component>& wanted);

}  // namespace twindeck::aero
