#include "steps/diagnosis/setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "diagnosis/files/feature_files.hpp"
#include "diagnosis/reduction/basis_modes.hpp"
#include "dynamics/unit_slips.hpp"
#include "matching/mode_name.hpp"

namespace twindeck::steps {

namespace {

/// Measured frequencies of each condition.
std::vector<dynamics::MeasuredFrequencies> frequencies_of(const diagnosis::FeatureSet& features) {
  std::vector<dynamics::MeasuredFrequencies> conditions(features.conditions.size());
  for (const diagnosis::Row& row : features.rows) {
    if (row.type != diagnosis::RowType::frequency) continue;
    dynamics::MeasuredFrequencies& found = conditions[static_cast<std::size_t>(row.condition)];
    found.names.push_back(fmt::format("{} of {}", row.mode, features.conditions[static_cast<std::size_t>(row.condition)].name));
    found.frequency_Hz.conservativeResize(found.frequency_Hz.size() + 1);
    found.frequency_Hz.tail<1>()[0] = row.value;
  }
  std::erase_if(conditions, [](const dynamics::MeasuredFrequencies& found) { return found.names.empty(); });
  return conditions;
}

constexpr double kAlike = 0.6;  ///< MAC where least_mac says nothing: below it two shapes share less than they do not

/// Where the highest measured frequency is so far up that no basis holds the modes below it.
void refuse_endless_basis(const diagnosis::BasisModes& basis, const dynamics::LoadedModel& loaded,
                          const diagnosis::FeatureSet& features, runner::StepContext& context) {
  if (basis.enough) return;
  warn_of_unit_slips(context, loaded, basis.frequency_Hz, frequencies_of(features));  // which may be why
  throw InputError(
      {loaded.source, 0, ""},
      fmt::format("has more than {} modes below {:.4g} Hz, the reach of the basis for the highest measured frequency",
                  basis.frequency_Hz.size(), basis.reach_Hz),
      "set highest_frequency below the measured modes that are too high, or take bodies and cables that swing by "
      "themselves out of the model");
}

/// Places and reduced model of the model as it is now.
void reduce(const diagnosis::PlaceOptions& place_options, const diagnosis::BasisModes& basis, DiagnosisInputs& inputs) {
  const diagnosis::Structure& structure = inputs.structure;
  inputs.places = diagnosis::find_places(structure, place_options);
  inputs.structure.load_tests =
      diagnosis::load_tests_in_use(*inputs.model, structure, inputs.places, inputs.features, inputs.load_tests);
  diagnosis::ReductionOptions reduction;
  reduction.modes = basis.modes;
  // Fits end far from where the basis is made (full_model): parameters on bounds, element scatter off by several deviations.
  reduction.parameter_vectors = 60;
  reduction.least_correction = 2.5e-4;
  reduction.element_change = 0.1;
  std::set<std::string> measured;
  for (const diagnosis::Row& row : inputs.features.rows)
    if (row.type == diagnosis::RowType::frequency) measured.insert(row.mode);
  reduction.corrected_modes = std::max({12, static_cast<int>(measured.size()) + 2, basis.in_band + 2});
  inputs.reduced = std::make_unique<diagnosis::ReducedModel>(structure, inputs.places, reduction);
}

/// A reduced model that predicts modes: of all places only the dampers, which change them, are there.
diagnosis::ReducedModel reduced_for_modes(const diagnosis::DiagnosedModel& model, int modes, int corrected) {
  const diagnosis::Structure structure = model.structure();
  diagnosis::Places places = diagnosis::find_places(structure, {});
  std::erase_if(places.sets, [](const auto& set) { return set.first != "dampers"; });
  diagnosis::ReductionOptions reduction;
  reduction.modes = modes;
  reduction.corrected_modes = corrected;
  return {structure, places, reduction};
}

/// Whether measured modes are those of stays that swing. The model that is searched keeps its bars: the modes that only cables
/// explain are left out of the search, and the extended model has the cables (decision 0014). Nothing where no more modes are
/// explained with cables, dampers and all conditions included.
void swing_stays(const DiagnosisConfig& config, const std::vector<diagnosis::Row>& stay_rows, DiagnosisInputs& inputs) {
  const diagnosis::BarStaysOptions options{config.least_mac > 0.0 ? config.least_mac : kAlike,
                                           2 * static_cast<int>(config.modes)};
  auto found = diagnosis::find_bar_stays(inputs.model->structure(), inputs.features, stay_rows, options);
  if (!found) return;
  const diagnosis::ModesExplained before =
      diagnosis::modes_explained(*inputs.reduced, inputs.features, config.scatter, found->rule);
  auto cables = std::make_shared<diagnosis::DiagnosedModel>(*inputs.model);
  cables->loaded = dynamics::from_model(std::move(found->extended));
  const diagnosis::ReducedModel reduced =
      reduced_for_modes(*cables, std::max(static_cast<int>(config.modes), found->modes_in_basis), found->modes_in_band + 2);
  const diagnosis::ModesExplained after = diagnosis::modes_explained(reduced, inputs.features, config.scatter, found->rule);
  if (after.explained <= before.explained) return;
  inputs.bar_stays.emplace(std::move(found->stays), found->log_odds, before, after);
  inputs.extended = std::move(cables);
}

}  // namespace

DiagnosisInputs prepare_diagnosis(const DiagnosisConfig& config, const DiagnosisFiles& files, runner::StepContext& context) {
  DiagnosisInputs inputs;
  inputs.features = files.features;
  inputs.corrected = files.corrected;
  inputs.catalogue = files.catalogue;
  const dynamics::LoadedModel loaded = dynamics::solvable(files.model);
  if (!loaded.state.status.converged) throw InputError({loaded.source, 0, ""}, loaded.state.status.message, "");
  inputs.load_tests = {loaded.source, files.folder / "channels.csv"};
  inputs.model = diagnosis::prepare_model(loaded, files.channels, config.sensor_tolerance_m);
  diagnosis::PlaceOptions place_options{static_cast<int>(config.zones), static_cast<int>(config.nodes), {}, {}, {}};
  place_options.moves = files.moves;
  inputs.structure = inputs.model->structure();
  const diagnosis::BasisModes basis =
      diagnosis::modes_of_basis(inputs.structure, inputs.features, static_cast<int>(config.modes));
  refuse_endless_basis(basis, loaded, inputs.features, context);
  inputs.basis_modes = basis.modes;
  reduce(place_options, basis, inputs);
  diagnosis::refuse_slack_stays(inputs.features, inputs.places, files.folder);
  inputs.extended = inputs.model;
  if (config.stays == "auto") swing_stays(config, files.stay_rows, inputs);
  diagnosis::FeatureMap as_it_stands(*inputs.reduced, inputs.features, config.scatter);
  as_it_stands.bind_modes(bound_modes(config, inputs));
  inputs.account = diagnosis::account_of(files.claims, inputs.features, files.channels, inputs.places, &as_it_stands);
  judge_units(context, loaded, inputs.reduced->frequency_Hz, frequencies_of(inputs.features),
              dynamics::FactorWithinBounds::is_refused);
  const double least_mac = config.least_mac > 0.0 || !inputs.bar_stays ? config.least_mac : kAlike;
  if (const auto unpaired = diagnosis::leave_out_unpaired(least_mac, config.scatter, *inputs.reduced, inputs.features))
    inputs.account.push_back(*unpaired);
  if (const auto imaginary = diagnosis::leave_out_imaginary(*inputs.reduced, inputs.features))
    inputs.account.push_back(*imaginary);
  diagnosis::hold_out(config.hold_out, inputs.features);
  return inputs;
}

std::map<std::string, int> bound_modes(const DiagnosisConfig& config, const DiagnosisInputs& inputs,
                                       std::vector<std::string>* unmeasured) {
  std::map<std::string, int> bound;
  for (const matching::NamedPair& pair :
       matching::read_pairs(config.pairs, inputs.reduced->mode_coordinates.cols(), {"", 0, "pairs"}, "raise modes")) {
    const std::size_t before = bound.size();
    for (const diagnosis::Row& row : inputs.features.rows)
      if (matching::experimental_label(row.mode) == pair.experimental) bound[row.mode] = static_cast<int>(pair.numerical);
    if (bound.size() == before && unmeasured != nullptr) unmeasured->push_back(pair.experimental);
  }
  return bound;
}

}  // namespace twindeck::steps
