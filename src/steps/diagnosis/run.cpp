#include "steps/diagnosis/run.hpp"

#include <fmt/format.h>

#include <chrono>

#include "diagnosis/files/measurement_corrections.hpp"
#include "diagnosis/law_diagnosis.hpp"
#include "diagnosis/paired_check.hpp"
#include "steps/diagnosis/outputs.hpp"
#include "steps/diagnosis/setup.hpp"

/// The step from its inputs to its files, and what it says at the end.
namespace twindeck::steps {

namespace {

void say_form(const diagnosis::FormReport& form, runner::StepContext& context) {
  context.say(
      fmt::format("  form error of the model: {:.2f} % in frequency ({:.2f} to {:.2f}), {:.2f} % in shape ({:.2f} to {:.2f})",
                  100.0 * form.frequency.level, 100.0 * form.frequency.low, 100.0 * form.frequency.high,
                  100.0 * form.shape.level, 100.0 * form.shape.low, 100.0 * form.shape.high));
  if (!form.gain.blocks.empty())
    context.say(fmt::format("  left out mode by mode ({} modes): gain {:.1f} nats ({:.1f} to {:.1f})", form.gain.blocks.size(),
                            form.gain.log_gain, form.gain.low, form.gain.high));
  for (const std::string& warning : form.warnings) context.say("  warning: " + warning);
}

/// The last lines of the step.
void say_sentences(diagnosis::Verdict verdict, const diagnosis::Sentences& sentences, runner::StepContext& context) {
  context.say("verdict: " + name_of(verdict));
  context.say("  what is wrong: " + sentences.what);
  context.say("  why: " + sentences.why);
  context.say("  how sure: " + sentences.how_sure);
  context.say("  how much better: " + sentences.how_much_better);
  context.say("  next: " + sentences.next);
}

void say_modes_explained(const diagnosis::Diagnosis& result, runner::StepContext& context) {
  if (const auto gain = diagnosis::explained_gain(result))
    context.say(fmt::format("  modes explained: {} -> {} of {} measured", gain->before, gain->after, gain->measured));
}

/// The tables of a diagnosis, but for diagnosis.json.
void write_tables(const diagnosis::Inference& inference, const diagnosis::Instantiated& entries,
                  const diagnosis::Diagnosis& result, const std::filesystem::path& out) {
  write_residuals(inference, result, out / "residuals.csv");
  write_hypotheses(result, entries.invisible, out / "hypotheses.csv");
  write_gain(inference, result, out / "gain.csv");
  write_pairs(inference, result, out / "pairs.csv");
  write_misfit(inference, result, out / "misfit.csv");
  write_unknowns(inference, result, out / "parameters.csv");
}

/// The model of the last state; what acts in others alone is none of it.
void write_extension(const DiagnosisInputs& inputs, const diagnosis::Diagnosis& result, runner::StepContext& context) {
  const std::string state = diagnosis::last_state(inputs.features);
  const bool several = diagnosis::states_of(inputs.features).size() > 1;
  const std::vector<std::string> others =
      write_extended_model(*inputs.extended, inputs.places, result, state, several, context.out / "extended_model");
  if (!others.empty())
    context.warn(fmt::format("the extended model is that of state {}: what acts in other states alone is not in it ({})", state,
                             fmt::join(others, ", ")));
}

/// Says how far the reduced basis and the full model agree, and warns where the basis is too small for the measured modes.
void say_check(const diagnosis::FullCheck& check, double allowed_pct, long modes, runner::StepContext& context) {
  if (!check.message.empty()) {
    context.warn("the extended model was not checked against the full one, which cannot be solved: " + check.message);
    return;
  }
  context.say(fmt::format("reduced basis against the full model: the {} paired frequencies agree to {:.4f} %",
                          check.full_Hz.size(), check.largest_pct));
  if (check.largest_pct > allowed_pct)
    context.warn(
        fmt::format("the reduced basis is too small for the measured modes: their frequencies are up to {:.2g} % off the "
                    "full model's (more than {:.2g} %); set modes above {}",
                    check.largest_pct, allowed_pct, modes));
}

Status run_diagnosis(const DiagnosisConfig& config, const DiagnosisFiles& files, runner::StepContext& context) {
  const auto begin = std::chrono::steady_clock::now();
  DiagnosisInputs inputs = prepare_diagnosis(config, files, context);
  diagnosis::FeatureMap map(*inputs.reduced, inputs.features, config.scatter);
  std::vector<std::string> unmeasured;
  map.bind_modes(bound_modes(config, inputs, &unmeasured));
  if (!unmeasured.empty()) context.warn(fmt::format("pairs: no row in use has the mode of {}", fmt::join(unmeasured, ", ")));
  diagnosis::Instantiated entries = diagnosis::instantiate(inputs.catalogue, *inputs.reduced, inputs.features);
  if (inputs.bar_stays) inputs.bar_stays->take_out_entries(entries);
  const diagnosis::Inference inference(map, entries.candidates);
  context.say(fmt::format("{} rows ({} held out), {} unknowns, {} entries of {} families, basis of {}",
                          inputs.features.rows.size(), inference.held_out().size(), map.nuisances().size(),
                          entries.candidates.size(), inputs.catalogue.size(), inputs.reduced->size()));
  if (context.has_flag("plan")) {
    write_plan(inference, entries.invisible, context.out / "plan.csv");
    context.say("plan.csv says what these rows would see");
    return {};
  }
  diagnosis::DiagnoseOptions options;
  options.most_causes = static_cast<int>(config.most_causes);
  options.progress = [&](const char* what, int done, int of) { context.progress(what, done, of); };
  diagnosis::Diagnosis result = diagnosis::diagnose(inference, options, context.seed + 1);
  if (result.before.all.g.size() == 0) return {false, result.message};
  if (inputs.bar_stays) inputs.bar_stays->put_first(result);
  const diagnosis::PlaceWords places(inputs.model->loaded.fe_model(), inputs.model->loaded.system.dofs, inputs.model->channels,
                                     inputs.places);
  const diagnosis::IdsInWords ids = diagnosis::ids_in_words(places, inference, result.ranking);
  diagnosis::put_into_words(result, places, ids);
  result.scatter = diagnosis::scatter_scales(inference, result.after);
  const diagnosis::Inference judged(result.with_form ? *result.with_form : map, entries.candidates);
  write_tables(judged, entries, result, context.out);
  write_extension(inputs, result, context);
  const diagnosis::FullCheck check =
      check_paired_modes(inputs.model->structure(), inputs.places, map, result, diagnosis::last_state(inputs.features));
  say_check(check, diagnosis::allowed_basis_error_pct(result), inputs.basis_modes, context);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const std::vector<records::Correction> corrections = diagnosis::corrections_of(result, inputs.features.channels);
  const std::vector<std::string> next = diagnosis::measure_next(result, places, ids, entries.invisible);
  const Told told{places,
                  ids,
                  diagnosis::sentences_of(judged, result, places, ids, next),
                  next,
                  diagnosis::model_parameters(inference, result),
                  corrections};
  std::vector<diagnosis::Finding> account = inputs.account;
  for (diagnosis::Finding& finding : account) finding.text = ids.in_text(finding.text);
  write_diagnosis(result, account, told, check, seconds, context.out / "diagnosis.json");
  diagnosis::write_corrections(inputs.corrected, corrections, context.out / "corrections.toml");
  for (const diagnosis::Finding& finding : account) context.say(finding.text);
  say_modes_explained(result, context);
  if (result.form) say_form(*result.form, context);
  say_sentences(result.verdict, told.sentences, context);
  for (const std::string& line : diagnosis::correction_advice(corrections)) context.say(line);
  return {};
}

}  // namespace

runner::Computation read_diagnosis(const DiagnosisConfig& config, runner::StepContext& context) {
  return [&config, &context, files = read_diagnosis_files(config, context)] { return run_diagnosis(config, files, context); };
}

}  // namespace twindeck::steps
