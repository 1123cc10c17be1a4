#pragma once

#include <optional>
#include <string>
#include <vector>

#include "matching/comparison.hpp"

/// What a pairing by shape is worth, said so that nobody is fooled by frequencies that fit: how many measured modes have a
/// partner, how alike the worst pair is, and whether one factor between all frequencies explains what looks wrong.
namespace twindeck::matching {

/// [-] Below it less than half of what was measured of a mode is the computed mode's: the shapes disagree.
inline constexpr double agreeing_mac = 0.5;
/// [-] Default of `minimum_mac`. Shapes that have nothing to do with each other have a MAC of 1/n in the mean at n channels: at
/// the five to ten that a small test has, a likeness below this is what chance gives.
inline constexpr double usual_minimum_mac = 0.2;
/// [-] Default of `least_paired`. Where most measured modes are like none of the model's, the few others are paired by chance
/// too.
inline constexpr double usual_least_paired = 0.5;

struct PairingAccount {
  bool by_shape = false;                ///< false: by order or by a published list, of which shapes say nothing
  int measured = 0;                     ///< modes that could have a partner: no higher than the computed modes reach
  std::vector<std::string> unpaired;    ///< of these, those that have none
  std::vector<std::string> beyond;      ///< measured above the highest computed mode
  double worst_mac = kUnknown;          ///< over the pairs; NaN where there is none
  std::string worst;                    ///< its pair, "3X-4N"
  std::vector<std::string> unlike;      ///< pairs below `agreeing_mac`, "3X-4N (MAC 0.31)"
  std::optional<std::string> reversed;  ///< a channel that seems to be reversed, in a sentence
  [[nodiscard]] int paired() const { return measured - static_cast<int>(unpaired.size()); }
};

/// @param computed_Hz  ascending frequencies of the modes that took part
[[nodiscard]] PairingAccount account_of(const Measured& measured, const Pairing& pairing, const Eigen::VectorXd& computed_Hz);

/// "; 2 of 9 measured modes unpaired, worst MAC 0.43 (5X-6N)", with "shapes disagree" where they do; empty where shapes say
/// nothing.
[[nodiscard]] std::string pairing_words(const PairingAccount& account);

/// The outcome for the manifest: what converged while shapes disagree is told as that, so that no page shows it as a plain
/// success.
[[nodiscard]] Status outcome(Status status, const PairingAccount& account);

/// Where the shapes of at least three measured modes, and of most, agree with computed ones and all their frequencies are off
/// by one and the same factor: a sentence that names the factor and what would make it (a unit, a mass). Frequencies play no
/// part in who is whose here.
[[nodiscard]] std::optional<std::string> common_factor(const Measured& measured, const Pairing& pairing,
                                                       const Eigen::VectorXd& computed_Hz);

/// Warns of pairs whose shapes disagree, of a reversed channel and of a common factor.
/// @param stage  "before the updating" or so, for the message; may be empty
void warn_of_pairing(Reporter& reporter, const PairingAccount& account, const std::optional<std::string>& factor,
                     const std::string& stage);

/// @param least_paired  [-] share of the measured modes that must have a partner
/// @throws InputError  where fewer have one, naming those that lack it; with `factor`, where there is one, as the likely reason
void refuse_few_pairs(const PairingAccount& account, double least_paired, double minimum_mac, const std::string& source,
                      const std::optional<std::string>& factor);

}  // namespace twindeck::matching
