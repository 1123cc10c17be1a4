#pragma once

#include <optional>
#include <string>
#include <vector>

#include "matching/comparison.hpp"

/// Quality of a pairing by shape: how many measured modes have a partner, the MAC of the worst pair, and whether all
/// frequencies differ by one common factor. A user who looks only at frequencies could take a wrong pairing for a good fit.
namespace twindeck::matching {

/// [-] Shapes with a MAC below this value disagree: the computed mode explains less than half of the measured shape.
inline constexpr double agreeing_mac = 0.5;
/// [-] Default of `minimum_mac`. Unrelated shapes at n channels have a MAC of 1/n on average. A small test has five to ten
/// channels. With so few channels, a MAC below this value can be due to chance.
inline constexpr double usual_minimum_mac = 0.2;
/// [-] Default of `least_paired`. If most measured modes resemble no mode of the model, the few other pairs are due to chance
/// too.
inline constexpr double usual_least_paired = 0.5;

/// How measured modes are paired with computed ones, as a step's configuration says.
struct PairingSettings : PairingOptions {
  PairingSettings() { minimum_mac = usual_minimum_mac; }
  std::vector<std::string> pairs;            ///< "7X-8N", where no shape was measured; empty: by order
  double least_paired = usual_least_paired;  ///< [-] of the measured modes, in a pairing by MAC
  double sensor_tolerance_m = 0.5;           ///< largest distance of a sensor from its node
};

struct PairingAccount {
  bool by_shape = false;                ///< false: by order or by a published list; shapes do not show its quality
  int measured = 0;                     ///< number of modes that are paired or not above the highest computed mode
  std::vector<std::string> unpaired;    ///< modes counted in `measured` that have no partner
  std::vector<std::string> beyond;      ///< measured modes above the highest computed mode, not paired
  double worst_mac = kUnknown;          ///< smallest MAC of the pairs; NaN if no pair has one
  std::string worst;                    ///< its pair, "3X-4N"
  std::vector<std::string> unlike;      ///< pairs below `agreeing_mac`, "3X-4N (MAC 0.31)"
  std::vector<std::string> shapeless;   ///< pairs of modes that were measured at one channel: by frequency, "3X-4N"
  std::optional<std::string> reversed;  ///< a channel that seems to be reversed, in a sentence
  [[nodiscard]] int paired() const { return measured - static_cast<int>(unpaired.size()); }
};

/// @param computed_Hz  ascending frequencies of the modes that took part
[[nodiscard]] PairingAccount account_of(const Measured& measured, const Pairing& pairing, const Eigen::VectorXd& computed_Hz);

/// For example "; 2 of 9 measured modes unpaired, worst MAC 0.43 (5X-6N)", with "shapes disagree" if a pair is below
/// `agreeing_mac`. Empty if the pairing was not made by shape.
[[nodiscard]] std::string pairing_words(const PairingAccount& account);

/// Status for the manifest. If a run converged but shapes disagree, the message says that they disagree. Reports then do not
/// show the run as a plain success.
[[nodiscard]] Status outcome(Status status, const PairingAccount& account);

/// Looks for one factor between all measured and computed frequencies. Modes are matched by shape alone. At least three
/// measured modes, and at least half of them, must agree with computed shapes.
/// @return a sentence with the factor and its likely reason (a unit, a mass); empty if there is no such factor
[[nodiscard]] std::optional<std::string> common_factor(const Measured& measured, const Pairing& pairing,
                                                       const Eigen::VectorXd& computed_Hz);

/// Looks for pairs by order whose frequencies are too far apart. If a mode is missing or listed twice, all pairs by order above
/// it are wrong.
/// @param maximum_error  [-] of a frequency
/// @return a sentence with these pairs; empty if there is none, or the pairing was made otherwise
[[nodiscard]] std::optional<std::string> far_by_order(const Measured& measured, const Pairing& pairing,
                                                      const Eigen::VectorXd& computed_Hz, double maximum_error);

/// Warns of pairs whose shapes disagree, of pairs by frequency in a pairing by shape, of a reversed channel and of a common
/// factor.
/// @param stage  "before the updating" or so, for the message; may be empty
void warn_of_pairing(Reporter& reporter, const PairingAccount& account, const std::optional<std::string>& factor,
                     const std::string& stage);

/// Refuses a pairing in which too few measured modes have a partner.
/// @param least_paired  [-] least share of the measured modes that must have a partner
/// @param factor        the sentence of `common_factor`: the likely reason, if there is one
/// @throws InputError  if fewer modes have a partner; the message names the modes without one, and the likely reason
void refuse_few_pairs(const PairingAccount& account, double least_paired, double minimum_mac, const std::string& source,
                      const std::optional<std::string>& factor);

/// Pairs of measured and computed modes: by MAC where shapes were measured, else as published, else by order. Warns of
/// published pairs that are not measured, of pairs by order that are too far apart, and of one factor between all frequencies.
/// @param place  where the list of pairs stands, for messages
/// @throws InputError  as pair_as_published, pair_at_sensors, refuse_few_pairs
[[nodiscard]] Pairing pair_as_configured(Reporter& reporter, const PairingSettings& settings, const Measured& measured,
                                         const dynamics::LoadedModel& model, const dynamics::EigenModes& modes,
                                         const Place& place);

/// The channel whose shapes agree with the paired computed ones if its sign is reversed, in a sentence. The reversal must
/// remove two thirds of 1 - MAC, summed over all pairs, and raise the mean MAC by 0.05. For a sound channel that moves, a
/// reversal lowers the MAC.
/// @return nothing where no channel meets this, with fewer than two pairs, or with fewer than four channels
[[nodiscard]] std::optional<std::string> reversed_channel(const Measured& measured, const Pairing& pairing);

}  // namespace twindeck::matching
