#pragma once

#include "matching/pairing.hpp"

namespace twindeck {

/// Pairs by the likeness of the modes, which the product forms first and uses for more than this.
inline std::vector<matching::ModePair> pair_by_mac(const Eigen::VectorXd& frequency_x, const Eigen::MatrixXcd& phi_x,
                                                   const Eigen::VectorXd& frequency_n, const Eigen::MatrixXcd& phi_n,
                                                   const matching::PairingOptions& options = {}) {
  return matching::pair_by_likeness(frequency_x, frequency_n,
                                    matching::likeness_of(frequency_x, phi_x, frequency_n, phi_n, options), options);
}

}  // namespace twindeck
