#include <fmt/format.h>

#include <algorithm>

#include "blind/form/form_table.hpp"
#include "dynamics/loaded_model.hpp"

namespace twindeck::blind::form {

namespace {

constexpr int kEntries = 8;

std::string word_of(Feature::What what) {
  using What = Feature::What;
  switch (what) {
    case What::shear:
      return "shear flexibility";
    case What::rotary:
      return "rotary inertia";
    case What::haunch:
      return "haunches";
    case What::stiffness:
      return "stiffness varies";
    case What::mass:
      return "mass varies";
    case What::splice:
      return "turning splice";
    case What::joint:
      return "turning joint";
    case What::end_turn:
      return "hold against turning";
    case What::eccentric:
      return "bearing off the axis";
    case What::depth:
      return "fixed bearing below the axis";
    case What::diaphragm:
      return "mass";
    case What::floor:
      return "floor's mass";
    case What::high_floors:
      return "floors above the joints";
    case What::infill:
      break;
  }
  return "wall";
}

std::string parameters_of(const diagnosis::Effect& effect) {
  std::string text;
  for (const diagnosis::EffectParameter& p : effect.parameters)
    text += fmt::format(" {} {:.4g} ({:.4g} to {:.4g}) {}", p.name, p.value, p.low, p.high, p.unit);
  return text;
}

void print_evidence(const FormCase& hidden, const diagnosis::Diagnosis& result) {
  fmt::print("{}: {}\n", name_of(result.verdict), result.message);
  for (const diagnosis::Effect& effect : result.effects)
    fmt::print("  named {}: {}\n", fmt::join(effect.cluster, " or "), parameters_of(effect));
  int place = 0;
  for (const diagnosis::Scored& entry : result.ranking) {
    const bool truth = names(hidden.truth.layout, hidden.hidden.sought, entry.candidate->id());
    if (++place > kEntries && !truth) continue;
    fmt::print("  {}{:>4} {:<28} D {:>8.1f} chi2 {:>8.1f}\n", truth ? "*" : " ", place, entry.candidate->id(), entry.log_odds,
               entry.remaining);
  }
}

}  // namespace

void explain_form_case(std::uint64_t seed) {
  const FormCase hidden = make_form_case(seed);
  const Layout& layout = hidden.truth.layout;
  const Form& form = hidden.calibrated.form;
  fmt::print("seed {}: {}, {}, {}: {}\n", seed, name_of(layout.kind), name_of(hidden.hidden.turn.category),
             hidden.hidden.turn.family, hidden.hidden.words);
  fmt::print("form error {:.2f} % in frequency, {:.2f} % in shape, severity {:.3f}; what features leave alone:\n",
             100.0 * hidden.calibrated.reached, 100.0 * hidden.calibrated.shape, form.severity);
  const dynamics::LoadedModel loaded = dynamics::from_model(coarse_model(layout));
  for (std::size_t i = 0; i < form.features.size(); ++i)
    fmt::print("  {:<28} at {:>3} size {:>8.4f}: {:.3f} %\n", word_of(form.features[i].what), form.features[i].place + 1,
               form.severity * form.features[i].size,
               100.0 * rms_of_feature_alone(loaded.system, hidden.truth, static_cast<int>(i)));
  FormScore score = prepare_score(hidden);
  try {
    run_form_case(hidden, score, [&](const diagnosis::Diagnosis& result) { print_evidence(hidden, result); });
  } catch (const std::exception& error) {
    fmt::print("failed: {}\n", error.what());
    for (const diagnosis::Row& row : hidden.features.rows)
      if (row.type == diagnosis::RowType::frequency)
        fmt::print("  {} mode {}: {:.3f} Hz\n", hidden.features.conditions[static_cast<std::size_t>(row.condition)].name,
                   row.mode, row.value);
  }
}

}  // namespace twindeck::blind::form
