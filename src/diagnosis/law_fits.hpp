#pragma once

#include <functional>
#include <vector>

#include "diagnosis/law_search.hpp"

/// Private to src/diagnosis: fits of the accounts of a search.
namespace twindeck::diagnosis {

constexpr std::size_t kMostLeading = 10;  ///< accounts that are fitted at a time
constexpr int kLeadingRounds = 4;         ///< a fit may bring others among the leading so many times

/// A set at the base: all combinations of its members' magnitudes, those that add nothing left out, at its own scales.
void score_at_base(const OneLaw& law, const LawSearch& search, LawAccount& account);

/// Puts a weighed account to its fit under its own scales, whatever that takes from the weight, and on while that grows.
/// @param weighed  an account as it stands at another fit, without a system where it cannot be weighed there
void settle(const LawSetting& setting, LawAccount& account, const std::function<LawAccount(const LawAccount&, Fit)>& weighed);

/// A fit of a refined account under its own scales, what it holds for none of the model's modes left open, from where the law
/// says that the unknowns are. The evidence is linear about a fit: far from it, it promises what the model does not hold.
/// @param aside  training rows that count for nothing
[[nodiscard]] Fit fit_by_own_scales(const LawSetting& setting, const LawAccount& account, const std::vector<int>& aside = {});

/// Fits a set with its causes in the model from each start of the parameters. A single factor starts from both sides of one:
/// the base may have moved a parameter of several places for one of them, and the others then look as if they had changed.
void refine_by_law(const LawSetting& setting, const LawSearch& search, LawAccount& account,
                   const std::vector<Eigen::VectorXd>& starts);

[[nodiscard]] Eigen::VectorXd parameters_of(const LawSetting& setting, const LawAccount& account);

/// Puts the leader and its rivals to their fits under their own scales, until none among them is new. A better optimiser must
/// look neither like a further cause nor like another one: the rivals are fitted from the leader's parameters too. From their
/// own starts they may have paired a measured mode with another mode of the model.
void settle_rivals(const LawSetting& setting, LawSearch& search);

}  // namespace twindeck::diagnosis
