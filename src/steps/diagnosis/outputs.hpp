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

/// What a diagnosis is told with. The first two are borrowed.
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
/// residuals.csv: `type,mode,channel,condition,held_out,value,std,before,after,residual_before,residual_after,beyond_before,
/// beyond_after`: predictions in the row's own unit; residuals over the standard deviation of identification; beyond: 1 where
/// it lies outside the limit that all rows together keep with 99 % (Sidak).
void write_residuals(const diagnosis::Inference& inference, const diagnosis::Diagnosis& result,
                     const std::filesystem::path& file);
/// hypotheses.csv: `cause,location,log_odds,screen,signature_sigma,status`: every entry of the catalogue in the order of its
/// odds, and the families that these data can't see with the reason.
void write_hypotheses(const diagnosis::Diagnosis& result, const std::vector<diagnosis::Invisible>& invisible,
                      const std::filesystem::path& file);
/// gain.csv: `type,mode,condition,rows,before,after`: RMS of standardised residuals of held-out rows by kind.
void write_gain(const diagnosis::Inference& inference, const diagnosis::Diagnosis& result, const std::filesystem::path& file);
/// parameters.csv: `unknown,before,after,shrinkage,bound`: in units of the prior deviation; shrinkage 1 - posterior variance.
void write_unknowns(const diagnosis::Inference& inference, const diagnosis::Diagnosis& result,
                    const std::filesystem::path& file);
/// pairs.csv: `mode,condition,measured_Hz,before_Hz,after_Hz,mac_before,mac_after`: each measured mode with the model's that it
/// is compared with, without and with the causes; MAC over the channels of that mode.
void write_pairs(const diagnosis::Inference& inference, const diagnosis::Diagnosis& result, const std::filesystem::path& file);
/// misfit.csv: `by,name,rows,mean_square_before,mean_square_after`: of standardised residuals by type, condition, mode,
/// channel.
void write_misfit(const diagnosis::Inference& inference, const diagnosis::Diagnosis& result, const std::filesystem::path& file);
/// plan.csv: `cause,location,unknown,smallest,unit,sigma,best_imitation,separation_sigma,status`.
void write_plan(const diagnosis::Inference& inference, const std::vector<diagnosis::Invisible>& invisible,
                const std::filesystem::path& file);

/// Writes `folder` as a model that every step accepts, with the parameters of the extended fit and the causes put in as far as
/// a model folder can say them; extension.toml lists each cause with its numbers and whether the model holds it. Causes on the
/// measurement's side leave the model as it is and correct channels.csv beside it.
/// @param state  of the structure that the model is of: causes that act in others alone are listed and not put in
/// @param several  whether there are others, which extension.toml then tells apart
/// @return the causes that were left out for their state
[[nodiscard]] std::vector<std::string> write_extended_model(const diagnosis::DiagnosedModel& model,
                                                            const diagnosis::Places& places, const diagnosis::Diagnosis& result,
                                                            const std::string& state, bool several,
                                                            const std::filesystem::path& folder);

}  // namespace twindeck::steps
