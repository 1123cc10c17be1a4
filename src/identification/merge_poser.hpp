#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "identification/identify.hpp"

namespace twindeck::identification {

/// Modes of one setup, shapes over its own channels.
struct SetupModes {
  std::string setup;
  std::vector<Eigen::Index> channels;  ///< position of each of its channels in the list of all
  std::vector<Cluster> modes;
  std::vector<ModeDeviation> deviations;
};

struct MergingRule {
  /// Largest relative distance of frequencies of one mode in two setups. Half the narrower bandwidth is used if that is more,
  /// as in the automatic selection.
  double frequency = 0.02;
  double mac = 0.7;  ///< least MAC of one mode over the channels that both setups have (needs two such channels)
  /// With a lower MAC two modes may still be the same, if their frequencies agree within three standard deviations and 1 - MAC
  /// is at most this many times its expected value for one shape with these standard deviations (two complex degrees of
  /// freedom: 98 %).
  double noise = 4.0;
};

/// A mode that is merged from all setups.
struct MergedMode {
  double frequency_Hz = 0.0, damping_ratio = 0.0;
  double frequency_scatter_Hz = 0.0, damping_ratio_scatter = 0.0;  ///< standard deviation between setups; 0 for one
  ModeDeviation deviation;                                         ///< shapes' entries as `shape`; `factor` is empty
  Eigen::VectorXcd shape;  ///< (all channels) unit norm over the measured channels, NaN elsewhere
  std::vector<std::pair<std::size_t, std::size_t>> members;  ///< (setup, mode in it), ascending in setup
};

/// Merging after identification (PoSER). Modes of different setups are paired by frequency and by the MAC over common channels,
/// the nearest first, at most one of each setup. Each setup's shape, of unit norm, is scaled by the complex factor that fits
/// its reference channels to the common reference shape (leading singular vector of all, least squares weighted by the
/// covariances), so that the gain of a setup has no effect. Where a mode hardly moves the references of a setup, their sign and
/// scale are unknown: its other channels stay NaN rather than wrong. Entries that several setups measured are averaged with
/// weights 1/variance. Frequency and damping are averaged with weights 1/(sigma_s² + tau²), tau² the variance between setups
/// beyond their own (DerSimonian and Laird 1986). A mode of one setup only is kept.
/// @param n_channels  of the list of all @param references  positions in it, present in every setup
/// @throws InputError  if a setup lacks a reference, or no reference is given for several setups
/// Reference: Reynders, Magalhaes, Roeck and Cunha (2009), IMAC 27 (merging strategies).
[[nodiscard]] std::vector<MergedMode> merge_poser(const std::vector<SetupModes>& setups, Eigen::Index n_channels,
                                                  const std::vector<Eigen::Index>& references, const MergingRule& rule);

}  // namespace twindeck::identification
