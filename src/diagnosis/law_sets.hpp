#pragma once

#include <functional>
#include <vector>

#include "diagnosis/law_search.hpp"

/// Private to src/diagnosis: sets of causes that act together.
namespace twindeck::diagnosis {

constexpr std::size_t kMostInASet = 3;
constexpr std::size_t kMembersOfSets = 40;  ///< number of leading entries that may be members of sets
constexpr std::size_t kTried = 3;  ///< number of sets of each size, and of entries beside the leading account, that get a fit

/// Adds sets of two causes among the leading entries, and of three if a set of two leads. All sets are screened on the
/// linearised base, summed over the magnitudes; the most promising ones are weighed.
/// @param weigh  gives an account its evidence @param found  receives the weighed sets
void add_sets(const LawSearch& search, const OneLaw& law, const std::function<void(LawAccount&)>& weigh,
              const Progress& progress, std::vector<LawAccount>& found);

}  // namespace twindeck::diagnosis
