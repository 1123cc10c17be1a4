#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "diagnosis/diagnose.hpp"
#include "diagnosis/evidence.hpp"
#include "diagnosis/full_check.hpp"
#include "diagnosis/model_parameters.hpp"
#include "diagnosis/reduction/diagnosed_model.hpp"
#include "diagnosis/words/sentences.hpp"
#include "steps/measured/measured_input.hpp"

namespace twindeck::steps {

/// Data for the words about a diagnosis. The first two are borrowed.
struct Told {
  const diagnosis::PlaceWords& places;
  const diagnosis::IdsInWords& ids;
  diagnosis::Sentences sentences;
  std::vector<std::string> measure_next;
  std::vector<diagnosis::ModelParameter> model_parameters;
  std::vector<records::Correction> corrections;  ///< of corrections_of
};

/// diagnosis.json, as docs/ describes it.
/// @param check  of the winner against the full model
void write_diagnosis(const diagnosis::Diagnosis& result, const std::vector<diagnosis::Finding>& account, const Told& told,
                     const diagnosis::FullCheck& check, double seconds, const std::filesystem::path& file);
/// residuals.csv, hypotheses.csv, gain.csv, pairs.csv, misfit.csv, parameters.csv.
void write_tables(const diagnosis::Inference& inference, const diagnosis::Instantiated& entries,
                  const diagnosis::Diagnosis& result, const std::filesystem::path& out);

void write_plan(const diagnosis::Inference& inference, const std::vector<diagnosis::Invisible>& invisible,
                const std::filesystem::path& file);

/// Writes `folder` as a model that every step accepts, with the parameters of the extended fit and the causes that a model
/// folder can hold. The file extension.toml lists each cause with its numbers and whether the model holds it. Faults of the
/// measurement do not change the model; channels.csv beside it is corrected.
/// @param state  of the structure in the model; causes that act only in other states are listed but not put in
/// @param several  whether there are other states; extension.toml then names the states
/// @return the causes that act only in other states
[[nodiscard]] std::vector<std::string> write_extended_model(const diagnosis::DiagnosedModel& model,
                                                            const diagnosis::Places& places, const diagnosis::Diagnosis& result,
                                                            const std::string& state, bool several,
                                                            const std::filesystem::path& folder);

}  // namespace twindeck::steps
