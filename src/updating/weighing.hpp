#pragma once

#include <vector>

#include "dynamics/loaded_model.hpp"
#include "matching/comparison.hpp"
#include "matching/measured.hpp"
#include "updating/posterior.hpp"
#include "updating/updating.hpp"
#include "updating/updating_settings.hpp"

/// An update that weighs frequencies and shapes by the covariance of the measurement: its rows, and their values after the fit.
namespace twindeck::updating {

/// @throws InputError  where no shape was measured, or none has a standard deviation
void refuse_unweighable_shapes(const matching::Measured& measured);

/// The rows of the paired modes with their covariance, to which the model error is added. The shape of a pair may combine the
/// computed modes that are closer in frequency than `cluster_gap`.
/// @return empty rows (given() is false) if the configuration asks for Eq. (5)
[[nodiscard]] MeasuredRows weighed_rows(const UpdatingSettings& config, const matching::Measured& measured,
                                        const matching::Pairing& pairing, const dynamics::LoadedModel& loaded,
                                        const dynamics::EigenModes& modes);

/// What the tables and words about a weighed update come from.
struct Weighed {
  const dynamics::LoadedModel& loaded;
  const std::vector<int>& active;
  const matching::Measured& measured;
  const matching::Pairing& pairing;
  const MeasuredRows& rows;
  const UpdatingResult& result;

  /// (n_active) the published values.
  [[nodiscard]] Eigen::VectorXd normalised() const;
  /// The j-th updated one.
  [[nodiscard]] const fe::Parameter& parameter(Eigen::Index j) const {
    return loaded.system.parameters[static_cast<std::size_t>(active[static_cast<std::size_t>(j)])];
  }
};

}  // namespace twindeck::updating
