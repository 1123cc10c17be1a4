#pragma once

#include <optional>
#include <vector>

#include "diagnosis/diagnose.hpp"
#include "diagnosis/reduction/diagnosed_model.hpp"

namespace twindeck::diagnosis {

/// A model with the causes of a diagnosis in it, as far as a model's data can say them, and with the parameters of the fit.
struct ExtendedModel {
  std::optional<fe::Model> elements;  ///< of a model of finite elements
  fe::ParametricSystem system;        ///< of a model of matrices
  std::vector<bool> holds;            ///< whether the model holds the whole of an effect, in the order of the effects
};

/// @param model  what the causes are put into  @param places  of the diagnosis
[[nodiscard]] ExtendedModel extended_model(const DiagnosedModel& model, const Places& places, const Diagnosis& result);

/// The channels with what the diagnosis found wrong with single ones put right.
struct CorrectedChannels {
  std::vector<matching::Channel> channels;
  std::vector<double> gain;  ///< factor on what each reads
};
[[nodiscard]] CorrectedChannels corrected_channels(const std::vector<matching::Channel>& channels, const Diagnosis& result);

}  // namespace twindeck::diagnosis
