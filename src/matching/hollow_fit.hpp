#pragma once

#include <string>
#include <vector>

#include "core/reporter.hpp"
#include "matching/comparison.hpp"

/// Defects that a good fit of frequencies can hide: a shape that became worse, two measured modes that are one, a parameter
/// that the data would move beyond its bound.
namespace twindeck::matching {

/// [-] Share of a measured shape's energy that the model explained before updating and no longer does (the fall of MAC). Noise
/// of five per cent in the components changes a MAC by a hundredth at most. A fall by a tenth means another shape.
inline constexpr double lost_mac = 0.1;

/// Pairs of a comparison with the stages "before" and "after" whose frequency came nearer and whose MAC fell by more than
/// `lost_mac`. @return "2X-2N (MAC 0.998 to 0.68, frequency error 9.58 to 0.50 %)" each
[[nodiscard]] std::vector<std::string> worse_shapes(const std::vector<ComparisonRow>& comparison);

/// Pairs of measured modes in use whose shapes are alike at the channels that both have, at least three: at two channels any
/// two modes may be. @return "2X and 3X (MAC 0.99)" each
[[nodiscard]] std::vector<std::string> shared_shapes(const Measured& measured, const std::vector<ComparisonRow>& comparison);

/// Warns of worse shapes, of shared shapes, and of parameters that end on a bound. @param on_bounds  "E_deck (upper)" each
void warn_of_hollow_fit(Reporter& reporter, const Measured& measured, const std::vector<ComparisonRow>& comparison,
                        const std::vector<std::string>& on_bounds);

}  // namespace twindeck::matching
