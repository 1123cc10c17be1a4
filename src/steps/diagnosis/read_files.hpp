#pragma once

#include <filesystem>
#include <vector>

#include "diagnosis/causes/catalogue.hpp"
#include "diagnosis/evidence.hpp"
#include "diagnosis/features/features.hpp"
#include "diagnosis/reduction/structure.hpp"
#include "steps/diagnosis/config.hpp"
#include "steps/measured/measured_input.hpp"
#include "steps/shared/model_source.hpp"

namespace twindeck::steps {

/// What a diagnosis reads, before anything is solved.
struct DiagnosisFiles {
  std::filesystem::path folder;                ///< of the features
  diagnosis::FeatureSet features;              ///< the rows in use
  std::vector<diagnosis::Row> stay_rows;       ///< all frequencies of stays, in use or not
  std::vector<records::Correction> corrected;  ///< what of the features --correct has put right
  std::vector<matching::Channel> channels;
  std::vector<diagnosis::Claim> claims;
  std::vector<diagnosis::Hypothesis> catalogue;
  dynamics::ReadModel model;
  std::vector<diagnosis::DamperMove> moves;
};

/// @throws InputError  for a file that is not sound, and for a name in one of them that the others do not have
[[nodiscard]] DiagnosisFiles read_diagnosis_files(const DiagnosisConfig& config, runner::StepContext& context);

}  // namespace twindeck::steps
