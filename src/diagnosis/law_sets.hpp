#pragma once

#include <functional>
#include <vector>

#include "diagnosis/law_search.hpp"

/// Private to src/diagnosis. Causes that act together.
namespace twindeck::diagnosis {

constexpr std::size_t kMostInASet = 3;
constexpr std::size_t kMembersOfSets = 40;  ///< entries that sets are made of: the leading ones
constexpr std::size_t kTried = 3;  ///< sets of each size, and entries beside the leading account, that get a fit of their own

/// Sets of two causes among the leading entries, and of three if a set of two leads. All sets are looked at on the linearised
/// base, magnitudes summed over; the most promising are weighed.
/// @param weigh  gives an account its evidence @param found  takes those that were weighed
void add_sets(const LawSearch& search, const OneLaw& law, const std::function<void(LawAccount&)>& weigh,
              const Progress& progress, std::vector<LawAccount>& found);

}  // namespace twindeck::diagnosis
