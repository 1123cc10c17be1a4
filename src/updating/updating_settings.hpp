#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/lists.hpp"
#include "matching/pairing_account.hpp"
#include "updating/updating.hpp"

namespace twindeck::updating {

/// What is updated, to what, with which weights; the step's configuration has a sentence for each value.
struct UpdatingSettings : matching::PairingSettings, UpdatingOptions {
  std::string parameters_from = "list";                ///< "list" | "s5_sensitivity"
  std::vector<std::string> parameters;                 ///< empty: all that have a range
  bool beside_selection = false;                       ///< a second update, of the parameters that s5_sensitivity selects
  std::vector<std::string> common_pairs;               ///< experimental modes of the second mean; empty: none
  std::string condition;                               ///< of the measured features
  std::vector<std::string> residuals = {"frequency"};  ///< "frequency", "shape"
  std::string weights = "automatic";                   ///< "automatic" | "relative" | "covariance"
  double frequency_model_error = 0.0;                  ///< [-] of the frequency
  double shape_model_error = 0.0;                      ///< [-] of the shape's largest component
  std::string published_values;  ///< file with the result of another updating; the cost of its parameters is reported

  [[nodiscard]] bool weighs_shapes() const { return contains(residuals, "shape"); }
  /// Whether rows are weighed by their covariance; false: relative frequencies, Eq. (5).
  [[nodiscard]] bool weighs() const { return weights == "covariance" || weighs_shapes(); }
  /// @param points, regularise  `elsewhere` and `regularised` of UpdatingOptions
  [[nodiscard]] UpdatingOptions options(std::uint64_t own_seed, std::vector<Eigen::VectorXd> points = {},
                                        bool regularise = true) const {
    UpdatingOptions out = *this;
    out.seed = own_seed;
    out.elsewhere = std::move(points);
    out.regularised = regularise;
    return out;
  }
};

}  // namespace twindeck::updating
