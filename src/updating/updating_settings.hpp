#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "matching/pairing_account.hpp"
#include "updating/updating.hpp"

namespace twindeck::updating {

/// What is updated, to what, with which weights; the step's configuration has a sentence for each value.
struct UpdatingSettings : matching::PairingSettings {
  std::string parameters_from = "list";   ///< "list" | "s5_sensitivity"
  std::vector<std::string> parameters;    ///< empty: all that have a range
  bool beside_selection = false;          ///< a second update, of the parameters that s5_sensitivity selects
  std::vector<std::string> common_pairs;  ///< experimental modes of the second mean; empty: none
  std::string condition;                  ///< of the measured features
  double trust_radius = 2.0;
  long starts = 8;
  long n_modes = 20;
  long max_iterations = 100;
  long outer_iterations = 12;
  double optimality_tolerance = 1e-6;
  bool leave_one_out = false;
  std::vector<std::string> residuals = {"frequency"};  ///< "frequency", "shape"
  std::string weights = "automatic";                   ///< "automatic" | "relative" | "covariance"
  double frequency_model_error = 0.0;                  ///< [-] of the frequency
  double shape_model_error = 0.0;                      ///< [-] of the shape's largest component
  std::string published_values;  ///< file with the result of another updating; the cost of its parameters is reported

  [[nodiscard]] bool weighs_shapes() const;
  /// Whether rows are weighed by their covariance; false: relative frequencies, Eq. (5).
  [[nodiscard]] bool weighs() const;
  /// @param elsewhere, regularised  see UpdatingOptions
  [[nodiscard]] UpdatingOptions options(std::uint64_t seed, std::vector<Eigen::VectorXd> elsewhere = {},
                                        bool regularised = true) const;
};

}  // namespace twindeck::updating
