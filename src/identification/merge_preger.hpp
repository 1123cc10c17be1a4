#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identification/identification.hpp"
#include "identification/identify.hpp"
#include "identification/merge_poser.hpp"

namespace twindeck::identification {

/// Correlations of one setup for merging before identification.
struct SetupCorrelations {
  std::string setup;
  std::vector<Eigen::Index> channels;    ///< of its outputs, in the list of all
  std::vector<Eigen::Index> references;  ///< positions among its outputs, the same sensors in the same order in every setup
  std::vector<Eigen::MatrixXd> lags;     ///< R_0 … (n_outputs × n_references)
};

/// Merging before the poles are computed (PreGER). The reference parts of all setups, side by side, give one observability
/// matrix O_ref of the references and, for each setup, the states Z_s that excite it. O_s = T_s Z_s⁺  then has the common basis
/// for any excitation of the setup, and the rows of all setups make one system. Each setup is first divided by the norm of its
/// reference part.
/// @return poles of all orders, shapes over all channels (`n_channels`; zero at channels without a measurement)
/// Reference: Mevel, Basseville, Benveniste and Goursat (2002), Journal of Sound and Vibration 254(1), 97-117; Doehler,
/// Andersen and Mevel (2010), IOMAC (PreGER).
[[nodiscard]] std::vector<std::vector<Pole>> merge_preger(const std::vector<SetupCorrelations>& setups, Eigen::Index n_channels,
                                                          Eigen::Index block_rows, const std::vector<int>& orders,
                                                          double rate_Hz);

/// PoSER against PreGER for one mode.
struct MergingCheck {
  bool found = false;  ///< PreGER has the mode
  double frequency_Hz = 0.0, damping_ratio = 0.0, mac = 0.0;
  Eigen::VectorXcd shape;                                      ///< (all channels)
  double poser_frequency_Hz = 0.0, poser_damping_ratio = 0.0;  ///< values of PoSER, whichever merging is used
};

/// MAC over the channels where both shapes are known (not NaN); 0 for none.
[[nodiscard]] double known_mac(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b);

/// PreGER's counterpart of each mode of PoSER: a mode of PreGER within two per cent of its frequency, one-to-one with the
/// largest sum of MAC. Where no mode of PreGER is near, the poles within half a per cent of its frequency are taken, the
/// nearest of each order: median of frequency and damping, mean of the shape. A mode has none if all near modes of PreGER
/// belong to other modes.
/// @param modes     of PoSER
/// @param preger    shapes of its modes physical, those of its poles as identified
/// @param channels  of all setups @param scale  (n_channels) what the records were divided by
/// @return one a mode
[[nodiscard]] std::vector<MergingCheck> merging_checks(const std::vector<MergedMode>& modes, const Identification& preger,
                                                       const std::vector<records::CampaignChannel>& channels,
                                                       const Eigen::VectorXd& scale);

/// Puts PreGER's values in the place of PoSER's, where PreGER has the mode. PreGER gives no deviations. They are the root of
/// the sum of squares of PoSER's deviation and of the difference of both mergings, because the choice of the merging is
/// uncertain too. Channels that PoSER's shape lacks stay NaN.
void take_preger(MergedMode& mode, const MergingCheck& check);

}  // namespace twindeck::identification
