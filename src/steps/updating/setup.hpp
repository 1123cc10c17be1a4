#pragma once

#include <string>
#include <vector>

#include "dynamics/eigenmodes.hpp"
#include "io/config.hpp"
#include "steps/measured/measured.hpp"
#include "steps/refinement/comparison.hpp"
#include "steps/refinement/pairing_account.hpp"
#include "steps/shared/model_source.hpp"
#include "steps/shared/run_step.hpp"
#include "updating/updating.hpp"

namespace twindeck::steps {

/// Configuration of s6_updating.
struct UpdatingConfig {
  std::string parameters_from = "list";   ///< "list" | "s5_sensitivity"
  std::vector<std::string> parameters;    ///< empty: all that have a range
  std::vector<std::string> pairs;         ///< "7X-8N", where no shape was measured; empty: by order
  std::vector<std::string> common_pairs;  ///< experimental modes of the second mean; empty: none
  std::string condition;                  ///< of the measured features
  double trust_radius = 2.0;
  long starts = 8;
  long n_modes = 20;
  long max_iterations = 100;
  long outer_iterations = 12;
  double optimality_tolerance = 1e-6;
  double minimum_mac = usual_minimum_mac;
  double least_paired = usual_least_paired;
  double maximum_frequency_error = 0.35;
  double cluster_gap = 0.02;
  double sensor_tolerance_m = 0.5;
  bool leave_one_out = false;
  std::vector<std::string> residuals = {"frequency"};  ///< "frequency", "shape"
  std::string weights = "automatic";                   ///< "automatic" | "relative" | "covariance"
  double frequency_model_error = 0.0;                  ///< [-] of the frequency
  double shape_model_error = 0.0;                      ///< [-] of the shape's largest component
  std::string published_values;                        ///< file with somebody else's result: the cost of its parameters is told

  [[nodiscard]] bool weighs_shapes() const;
  /// Whether rows are weighed by their covariance; false: relative frequencies, Eq. (5).
  [[nodiscard]] bool weighs() const;
  [[nodiscard]] io::FieldTable fields();
  [[nodiscard]] updating::UpdatingOptions options(std::uint64_t seed) const;
};

/// The lowest modes, as many of `n_modes` as the structure has.
[[nodiscard]] dynamics::EigenModes available_modes(const fe::ParametricSystem& system, const Eigen::VectorXd& theta,
                                                   int n_modes);

/// The model with parameter values put in and its prestress found anew.
[[nodiscard]] LoadedModel with_values(const LoadedModel& loaded, const Eigen::VectorXd& theta);

/// Positions of the parameters to update: as listed, as s5_sensitivity selected them, or all that have a range.
/// @throws InputError  for a name that is no parameter, is listed twice or has no range
[[nodiscard]] std::vector<int> active_parameters(const UpdatingConfig& config, const ReadModel& model, StepContext& context);

/// Values of the updated parameters in somebody else's result: `parameter,unit,final_value`, in units of its own; a parameter
/// that it does not name stays at its initial value. Empty where none is given.
/// @throws InputError  for a name that is not updated, or a unit of another kind
[[nodiscard]] std::vector<Eigen::VectorXd> published_values(const UpdatingConfig& config,
                                                            const std::vector<fe::Parameter>& parameters,
                                                            const std::vector<int>& active, StepContext& context);

/// What the step reads.
struct UpdatingInputs {
  ReadModel model;  ///< the refined one
  Measured measured;
  std::vector<int> active;                 ///< see active_parameters
  std::vector<Eigen::VectorXd> published;  ///< see published_values
};
/// @throws InputError  also where no modes were measured
[[nodiscard]] UpdatingInputs read_updating(const UpdatingConfig& config, StepContext& context);

/// Pairs of measured and computed modes: by MAC where shapes were measured, else as published, else by order. Warns of pairs of
/// a list that are not measured, and of one factor between all frequencies.
/// @throws InputError  where no pair is left, or fewer than the share that the configuration asks for
[[nodiscard]] Pairing pair_for_updating(StepContext& context, const UpdatingConfig& config, const LoadedModel& loaded,
                                        const dynamics::EigenModes& modes, const Measured& measured);

[[nodiscard]] std::vector<updating::FrequencyTarget> frequency_targets(const Measured& measured, const Pairing& pairing);

/// How prestress is found anew for parameter values; empty for a matrix model. Holds a reference to `loaded`.
[[nodiscard]] updating::Refresh prestress_refresh(const LoadedModel& loaded);

/// The same measured modes with the computed modes that the updating followed them to, and MAC where shapes were measured.
/// @param before  the pairing that the targets came from
[[nodiscard]] Pairing followed_pairing(const UpdatingConfig& config, const Pairing& before,
                                       const updating::UpdatingResult& result, const LoadedModel& after,
                                       const dynamics::EigenModes& modes, const Measured& measured);

/// What the pairs are worth after the updating; close modes that have turned into each other count by their common subspace.
/// Warns where shapes disagree; where they did before and no longer do, the updating has shown the pairs right.
[[nodiscard]] PairingAccount account_after(StepContext& context, const UpdatingConfig& config, const Pairing& followed,
                                           const LoadedModel& after, const dynamics::EigenModes& modes,
                                           const Measured& measured);

/// "mean |error| of 9 pairs: 5.12 % before, 0.04 % after; 1 of 10 measured modes unpaired, worst MAC 0.93 (4X-4N)".
[[nodiscard]] std::string summary_line(const std::vector<ComparisonRow>& comparison, const PairingAccount& account);

}  // namespace twindeck::steps
