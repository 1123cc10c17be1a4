#pragma once

#include <functional>
#include <vector>

#include "diagnosis/law_search.hpp"

/// Private to src/diagnosis: fits of the accounts of a search.
namespace twindeck::diagnosis {

constexpr std::size_t kMostLeading = 10;  ///< accounts that are fitted per round
constexpr int kLeadingRounds = 4;         ///< rounds; a fit may bring other accounts among the leading ones

/// Evidence of a set at the base, at its own scales, over all combinations of its members' magnitudes; negligible ones are left
/// out.
void score_at_base(const OneLaw& law, const LawSearch& search, LawAccount& account);

/// Replaces an account by its fit under its own scales, even if its weight falls, and repeats while the weight grows.
/// @param weighed  weighs an account at another fit; the result has no system if that is impossible
void settle(const LawSetting& setting, LawAccount& account, const std::function<LawAccount(const LawAccount&, Fit)>& weighed);

/// Fits a refined account under its own scales, with its open modes left open, starting from the expected values of the
/// unknowns. The evidence is linearised about a fit, so far from it the expected values may be wrong.
/// @param aside  excluded training rows
[[nodiscard]] Fit fit_by_own_scales(const LawSetting& setting, const LawAccount& account, const std::vector<int>& aside = {});

/// Fits a set with its causes in the model from each start of the parameters. A single factor starts from both sides of one.
/// The base may have fitted a common parameter to one location only, and the other locations would then seem to have changed.
void refine_by_law(const LawSetting& setting, const LawSearch& search, LawAccount& account,
                   const std::vector<Eigen::VectorXd>& starts);

[[nodiscard]] Eigen::VectorXd parameters_of(const LawSetting& setting, const LawAccount& account);

/// Fits the leader and its rivals under their own scales, until no new rival appears. The rivals are fitted from the leader's
/// parameters too, because a better start must not look like a better cause. From their own starts they may have paired a
/// measured mode with another mode of the model.
void settle_rivals(const LawSetting& setting, LawSearch& search);

}  // namespace twindeck::diagnosis
