#pragma once

#include <optional>
#include <vector>

#include "diagnosis/diagnose.hpp"
#include "diagnosis/reduction/diagnosed_model.hpp"

namespace twindeck::diagnosis {

/// A model with the causes of a diagnosis, as far as the data of a model can represent them, and with the parameters of the
/// fit.
struct ExtendedModel {
  std::optional<fe::Model> elements;  ///< set for a finite element model
  fe::ParametricSystem system;        ///< set for a matrix model
  std::vector<bool> holds;            ///< whether the model represents the whole effect, in the order of the effects
};

/// @param model  that the causes are put into @param places  of the diagnosis @throws InputError  for a node not in the model
[[nodiscard]] ExtendedModel extended_model(const DiagnosedModel& model, const Places& places, const Diagnosis& result);

/// The channels, corrected for faults that the diagnosis found.
struct CorrectedChannels {
  std::vector<matching::Channel> channels;
  std::vector<double> gain;  ///< (n_channels) [-] factor on the values of each channel
};
[[nodiscard]] CorrectedChannels corrected_channels(const std::vector<matching::Channel>& channels, const Diagnosis& result);

}  // namespace twindeck::diagnosis
