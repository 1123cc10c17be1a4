#include "steps/diagnosis/outputs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "core/lists.hpp"
#include "diagnosis/bar_stays_effect.hpp"
#include "diagnosis/extended_model.hpp"
#include "diagnosis/visibility.hpp"
#include "io/atomic.hpp"
#include "io/csv.hpp"
#include "io/toml_value.hpp"
#include "model_io/load_cases.hpp"
#include "model_io/matrix_model.hpp"
#include "model_io/write_model.hpp"

namespace twindeck::steps {

namespace {

constexpr std::size_t kToldBlocks = 5;  ///< number of blocks of the residual test that are named

using diagnosis::Diagnosis;
using diagnosis::Inference;
using diagnosis::Row;
using Eigen::Index;
using Eigen::VectorXd;

double own_unit(const Row& row, double transformed) { return is_logarithmic(row.type) ? std::exp(transformed) : transformed; }

std::string channel_of(const Inference& inference, const Row& row) {
  return row.channel >= 0 ? inference.map().features().channels[static_cast<std::size_t>(row.channel)] : row.stay;
}

/// The form error's scales, and the gain on modes left out.
void add_form(const diagnosis::FormReport& form, nlohmann::ordered_json& json) {
  json["form"] = nlohmann::ordered_json::array();
  for (const diagnosis::ErrorClass& c : form.classes)
    json["form"].push_back({{"name", c.name},
                            {"unit", "% " + c.unit},
                            {"scale", 100.0 * c.scale.level},
                            {"low", 100.0 * c.scale.low},
                            {"high", 100.0 * c.scale.high},
                            {"level", 0.90}});
  json["warnings"] = form.warnings;
  auto& gain = json["gain"];
  gain["log_gain"] = form.gain.log_gain;
  gain["log_gain_interval"] = {form.gain.low, form.gain.high};
  gain["blocks"] = form.gain.blocks.size();
}

nlohmann::ordered_json listed_parameters(const std::vector<diagnosis::EffectParameter>& parameters) {
  auto out = nlohmann::ordered_json::array();
  for (const auto& p : parameters)
    out.push_back({{"name", p.name},
                   {"unit", p.unit},
                   {"value", p.value},
                   {"low", p.low},
                   {"high", p.high},
                   {"level", 0.90},
                   {"one_sided", p.at_low_bound && p.at_high_bound ? "open"
                                 : p.at_high_bound                 ? "lower limit"
                                 : p.at_low_bound                  ? "upper limit"
                                                                   : ""}});
  return out;
}

/// State, location and rivals of an effect. An unknown coordinate is null.
void add_place_and_rivals(const diagnosis::Effect& effect, const Told& told, nlohmann::ordered_json& json) {
  const diagnosis::PlaceInWords place = told.places.at(effect.cause.candidate->location);
  json["state"] = effect.state;
  if (const auto& further = effect.cause.candidate->further_states; !further.empty()) {
    json["states"] = {effect.state};
    for (const std::string& state : further) json["states"].push_back(state);
  }
  json["place"] = {{"words", place.words}, {"x_m", place.x_m.x()}, {"y_m", place.x_m.y()}, {"z_m", place.x_m.z()}};
  json["rivals"] = nlohmann::ordered_json::array();
  for (const diagnosis::Rival& rival : effect.rivals)
    json["rivals"].push_back(
        {{"id", rival.id},
         {"words", rival.candidate == nullptr ? "something else that changed" : told.ids.in_text(rival.id)},
         {"probability", rival.probability},
         {"parameters", listed_parameters(rival.parameters)}});
}

nlohmann::ordered_json listed_model_parameters(const std::vector<diagnosis::ModelParameter>& parameters) {
  const auto numbers = [](const diagnosis::ParameterEstimate& e) {
    return nlohmann::ordered_json{{"value", e.value}, {"low", e.low}, {"high", e.high}};
  };
  auto out = nlohmann::ordered_json::array();
  for (const auto& p : parameters)
    out.push_back(
        {{"name", p.name}, {"unit", p.unit}, {"before", numbers(p.before)}, {"after", numbers(p.after)}, {"level", 0.90}});
  return out;
}

nlohmann::ordered_json listed_sentences(const diagnosis::Sentences& sentences) {
  return {{"what", sentences.what},
          {"why", sentences.why},
          {"how_sure", sentences.how_sure},
          {"how_much_better", sentences.how_much_better},
          {"next", sentences.next}};
}

nlohmann::ordered_json residual_json(const Diagnosis& result) {
  nlohmann::ordered_json json = {{"statistic", result.residual.statistic},
                                 {"dof", result.residual.dof},
                                 {"p_value", result.residual.p_value},
                                 {"block_p_value", result.residual.block_p_value},
                                 {"stage", result.after_extension ? "after extension" : "before"},
                                 {"blocks", nlohmann::ordered_json::array()}};
  for (std::size_t i = 0; i < std::min(result.residual.blocks.size(), kToldBlocks); ++i) {
    const auto& block = result.residual.blocks[i];
    json["blocks"].push_back({{"name", block.name},
                              {"rows", block.rows},
                              {"statistic", block.statistic},
                              {"dof", block.dof},
                              {"p_value", block.p_value}});
  }
  return json;
}

nlohmann::ordered_json effect_json(const diagnosis::Effect& effect, const Told& told) {
  nlohmann::ordered_json one;
  one["cause"] = effect.cause.candidate->hypothesis->id;
  one["location"] = effect.cause.candidate->location;
  one["cluster"] = effect.cluster;
  one["probability"] = effect.probability;
  one["log_odds"] = effect.log_odds;
  one["split_by"] = effect.split_by;
  one["parameters"] = listed_parameters(effect.parameters);
  add_place_and_rivals(effect, told, one);
  one["sentence"] = effect.sentence;
  one["remedy"] = effect.remedy;
  return one;
}

nlohmann::ordered_json gain_json(const Diagnosis& result) {
  const diagnosis::Gain gain = diagnosis::told_gain(result);
  nlohmann::ordered_json json = {{"held_out", gain.held_out},
                                 {"rows", gain.rows},
                                 {"before", gain.before},
                                 {"after", gain.after},
                                 {"reduction_pct", gain.reduction_pct},
                                 {"interval_pct", {gain.low_pct, gain.high_pct}},
                                 {"level", 0.90}};
  for (const diagnosis::HeldOutMode& mode : gain.modes)
    json["raw"].push_back({{"mode", mode.mode},
                           {"condition", mode.condition},
                           {"frequency_error_pct_before", mode.frequency_before_pct},
                           {"frequency_error_pct_after", mode.frequency_after_pct},
                           {"damping_error_pct_before", mode.damping_before_pct},
                           {"damping_error_pct_after", mode.damping_after_pct},
                           {"mac_before", mode.mac_before},
                           {"mac_after", mode.mac_after}});
  if (const auto explained = diagnosis::explained_gain(result)) {
    json["modes_measured"] = explained->measured;
    json["modes_explained_before"] = explained->before;
    json["modes_explained_after"] = explained->after;
  }
  return json;
}

/// channels.csv with the causes on the measurement's side put right.
void write_corrected_channels(const diagnosis::CorrectedChannels& corrected, const std::filesystem::path& file) {
  io::CsvWriter csv({"channel", "point", "x_m", "y_m", "z_m", "dx", "dy", "dz", "gain"});
  for (std::size_t i = 0; i < corrected.channels.size(); ++i) {
    const matching::Channel& c = corrected.channels[i];
    const auto coordinate = [&](Eigen::Index k) { return c.x_m ? std::optional<double>((*c.x_m)[k]) : std::nullopt; };
    const auto cosine = [&](Eigen::Index k) {
      return c.direction.isZero(0.0) ? std::nullopt : std::optional<double>(c.direction[k]);
    };
    csv.row({c.name, c.point, coordinate(0), coordinate(1), coordinate(2), cosine(0), cosine(1), cosine(2), corrected.gain[i]});
  }
  csv.save(file);
}

std::string listed(const diagnosis::Effect& effect, bool several_states, bool in_model) {
  const diagnosis::Candidate& cause = *effect.cause.candidate;
  std::string text =
      fmt::format("\n[[cause]]\nid = {}\nlocation = {}\n", io::toml_text(cause.hypothesis->id), io::toml_text(cause.location));
  if (several_states) text += fmt::format("acts = {}\n", io::toml_text(cause.state.empty() ? "in all states" : cause.when));
  text += fmt::format("in_model = {}\n", in_model);
  for (const diagnosis::EffectParameter& p : effect.parameters)
    text += fmt::format("{} = {}\n", p.name, io::toml_number(p.value));
  return text;
}

/// residuals.csv: predictions in the row's own unit; residuals over the standard deviation of identification; beyond: 1 where
/// it lies outside the limit that all rows together keep with 99 % (Sidak). Cells of a side are empty in rows of a mode that
/// has no counterpart in its model: nothing is predicted there.
void write_residuals(const Inference& inference, const Diagnosis& result, const std::filesystem::path& file) {
  io::CsvWriter csv({"type", "mode", "channel", "condition", "held_out", "value", "std", "before", "after", "residual_before",
                     "residual_after", "beyond_before", "beyond_after"});
  const auto& map = inference.map();
  const VectorXd e0 = standardised_residuals(inference, result.before), e1 = standardised_residuals(inference, result.after);
  const double limit = diagnosis::sidak_limit(map.features().rows.size());
  const auto told = [](const diagnosis::Fit& fit, Index row, double value) {
    return contains(fit.all.open, static_cast<int>(row)) ? std::nullopt : std::optional<double>(value);
  };
  for (std::size_t r = 0; r < map.features().rows.size(); ++r) {
    const Row& row = map.features().rows[r];
    const auto i = static_cast<Index>(r);
    csv.row({name_of(row.type), row.mode, channel_of(inference, row), map.features().condition_of(row).name,
             row.held_out ? 1 : 0, row.value, row.std, told(result.before, i, own_unit(row, result.before.all.g[i])),
             told(result.after, i, own_unit(row, result.after.all.g[i])), told(result.before, i, e0[i]),
             told(result.after, i, e1[i]), told(result.before, i, std::abs(e0[i]) > limit ? 1.0 : 0.0),
             told(result.after, i, std::abs(e1[i]) > limit ? 1.0 : 0.0)});
  }
  csv.save(file);
}

/// All entries of the catalogue in the order of their odds, and the families that these data cannot show, with the reason.
void write_hypotheses(const Diagnosis& result, const std::vector<diagnosis::Invisible>& invisible,
                      const std::filesystem::path& file) {
  io::CsvWriter csv({"cause", "location", "log_odds", "screen", "signature_sigma", "status"});
  for (const auto& scored : result.ranking)
    csv.row({scored.candidate->hypothesis->id, scored.candidate->location, scored.log_odds, scored.screen,
             scored.signature.norm(), scored.fitted ? "fitted" : "screened"});
  for (const auto& none : invisible) csv.row({none.hypothesis, "", "", "", "", "not visible: " + none.reason});
  csv.save(file);
}

/// Rows of modes without a counterpart in the model before or after, which do not compare the two.
std::set<int> not_compared(const Diagnosis& result) {
  std::set<int> open(result.before.all.open.begin(), result.before.all.open.end());
  open.insert(result.after.all.open.begin(), result.after.all.open.end());
  return open;
}

/// RMS of standardised residuals of held-out rows by kind.
void write_gain(const Inference& inference, const Diagnosis& result, const std::filesystem::path& file) {
  io::CsvWriter csv({"type", "mode", "condition", "rows", "before", "after"});
  const auto& features = inference.map().features();
  const VectorXd e0 = standardised_residuals(inference, result.before), e1 = standardised_residuals(inference, result.after);
  struct Sum {
    int rows = 0;
    double before = 0.0, after = 0.0;
  };
  std::map<std::tuple<std::string, std::string, std::string>, Sum> sums;
  const std::set<int> open = not_compared(result);
  for (const int r : inference.held_out()) {
    if (open.contains(r)) continue;
    const Row& row = features.rows[static_cast<std::size_t>(r)];
    Sum& sum = sums[{name_of(row.type), row.mode, features.condition_of(row).name}];
    sum.rows += 1;
    sum.before += e0[r] * e0[r];
    sum.after += e1[r] * e1[r];
  }
  for (const auto& [key, sum] : sums)
    csv.row({std::get<0>(key), std::get<1>(key), std::get<2>(key), sum.rows, std::sqrt(sum.before / sum.rows),
             std::sqrt(sum.after / sum.rows)});
  csv.save(file);
}

/// In units of the prior deviation; shrinkage 1 - posterior variance.
void write_unknowns(const Inference& inference, const Diagnosis& result, const std::filesystem::path& file) {
  io::CsvWriter csv({"unknown", "before", "after", "shrinkage", "bound"});
  const auto& nuisances = inference.map().nuisances();
  const Eigen::MatrixXd& j = result.after.map.jacobian;
  // Posterior covariance of x: I - J' Sigma_tot^-1 J.
  const Eigen::MatrixXd l = result.after.total_factor.triangularView<Eigen::Lower>().solve(j);
  for (std::size_t i = 0; i < nuisances.size(); ++i) {
    const auto k = static_cast<Index>(i);
    const bool bounded = contains(result.on_bounds, nuisances[i].name);
    csv.row({nuisances[i].name, result.before.map.x[k], result.after.map.x[k], l.col(k).squaredNorm(),
             bounded ? "on bound before" : ""});
  }
  csv.save(file);
}

/// Each measured mode with the model's that it is compared with, fitted without and with the causes, and as the step read it;
/// MAC over the channels of that mode.
void write_pairs(const Inference& inference, const Diagnosis& result, const std::filesystem::path& file) {
  io::CsvWriter csv(
      {"mode", "condition", "measured_Hz", "before_Hz", "after_Hz", "mac_before", "mac_after", "given_Hz", "mac_given"});
  const auto& map = inference.map();
  const diagnosis::Prediction given = map.predict(map.base(map.standing()), {}, false);
  const auto hertz = [](double f) { return f > 0.0 ? std::optional<double>(f) : std::nullopt; };
  const auto known = [](double mac) { return std::isfinite(mac) ? std::optional<double>(mac) : std::nullopt; };
  for (std::size_t m = 0; m < map.measured_modes().size(); ++m) {
    const diagnosis::MeasuredMode& mode = map.measured_modes()[m];
    const auto &before = result.before.all, &after = result.after.all;
    csv.row({mode.label, map.features().condition_of(mode).name, mode.frequency_Hz, hertz(before.frequency_Hz[m]),
             hertz(after.frequency_Hz[m]), known(before.mac[m]), known(after.mac[m]), hertz(given.frequency_Hz[m]),
             known(given.mac[m])});
  }
  csv.save(file);
}

/// Mean squares of standardised residuals by type, condition, mode, channel.
void write_misfit(const Inference& inference, const Diagnosis& result, const std::filesystem::path& file) {
  io::CsvWriter csv({"by", "name", "rows", "mean_square_before", "mean_square_after"});
  const auto& features = inference.map().features();
  const VectorXd e0 = standardised_residuals(inference, result.before), e1 = standardised_residuals(inference, result.after);
  const std::set<int> open = not_compared(result);
  for (const std::string by : {"type", "condition", "mode", "channel"}) {
    std::map<std::string, std::array<double, 3>> sums;
    for (std::size_t r = 0; r < features.rows.size(); ++r) {
      if (open.contains(static_cast<int>(r))) continue;
      const Row& row = features.rows[r];
      const std::string name = by == "type"        ? name_of(row.type)
                               : by == "condition" ? features.condition_of(row).name
                               : by == "mode"      ? row.mode
                                                   : channel_of(inference, row);
      if (name.empty()) continue;
      const auto i = static_cast<Index>(r);
      sums[name][0] += 1.0;
      sums[name][1] += e0[i] * e0[i];
      sums[name][2] += e1[i] * e1[i];
    }
    for (const auto& [name, sum] : sums) csv.row({by, name, static_cast<long>(sum[0]), sum[1] / sum[0], sum[2] / sum[0]});
  }
  csv.save(file);
}

}  // namespace

void write_diagnosis(const Diagnosis& result, const std::vector<diagnosis::Finding>& account, const Told& told,
                     const diagnosis::FullCheck& check, double seconds, const std::filesystem::path& file) {
  nlohmann::ordered_json json;
  json["schema"] = 2;
  json["verdict"] = name_of(result.verdict);
  json["message"] = result.message;
  json["sentences"] = listed_sentences(told.sentences);
  json["detection"] = {{"log_odds", result.log_odds}, {"threshold", result.threshold}, {"probability", result.probability}};
  json["residual_test"] = residual_json(result);
  json["account"] = nlohmann::ordered_json::array();
  for (const diagnosis::Finding& finding : account)
    json["account"].push_back({{"kind", finding.kind},
                               {"text", finding.text},
                               {"names", finding.names},
                               {"candidates", finding.candidates},
                               {"split_by", finding.split_by}});
  json["effects"] = nlohmann::ordered_json::array();
  for (const auto& effect : result.effects) json["effects"].push_back(effect_json(effect, told));
  json["measurement_corrections"] = nlohmann::ordered_json::array();
  for (const records::Correction& c : told.corrections) {
    nlohmann::ordered_json& entry = json["measurement_corrections"].emplace_back();
    entry = {{"channel", c.channel}, {"action", name_of(c.action)}, {"with", c.with}, {"factor", c.factor}};
    if (!c.state.empty()) entry["state"] = c.state;
  }
  json["localisation"] = nlohmann::ordered_json::array();
  for (const auto& at : result.localisation)
    json["localisation"].push_back(
        {{"location", at.location}, {"score", at.score}, {"words", told.places.at(at.location).words}});
  json["gain"] = gain_json(result);
  if (result.form) add_form(*result.form, json);
  json["measure_next"] = told.measure_next;
  const auto values = [](const VectorXd& v) { return std::vector<double>(v.begin(), v.end()); };
  json["full_model"] = {{"frequency_Hz", values(check.full_Hz)},
                        {"reduced_Hz", values(check.reduced_Hz)},
                        {"largest_deviation_pct", check.largest_pct}};
  json["model_parameters"] = listed_model_parameters(told.model_parameters);
  json["parameters_on_bounds"] = result.on_bounds;
  json["seconds"] = seconds;
  json["extended_model"] = "extended_model/";
  io::write_file_atomically(file, json.dump(1) + "\n");
}

void write_tables(const diagnosis::Inference& inference, const diagnosis::Instantiated& entries,
                  const diagnosis::Diagnosis& result, const std::filesystem::path& out) {
  write_residuals(inference, result, out / "residuals.csv");
  write_hypotheses(result, entries.invisible, out / "hypotheses.csv");
  write_gain(inference, result, out / "gain.csv");
  write_pairs(inference, result, out / "pairs.csv");
  write_misfit(inference, result, out / "misfit.csv");
  write_unknowns(inference, result, out / "parameters.csv");
}

void write_plan(const Inference& inference, const std::vector<diagnosis::Invisible>& invisible,
                const std::filesystem::path& file) {
  io::CsvWriter csv(
      {"cause", "location", "unknown", "smallest", "unit", "sigma", "best_imitation", "separation_sigma", "status"});
  for (const diagnosis::Visibility& one : diagnosis::visibility(inference)) {
    const auto& spec = one.candidate->hypothesis->unknowns;
    csv.row({one.candidate->hypothesis->id, one.candidate->location, spec.empty() ? "" : spec[0].name, one.smallest,
             spec.empty() ? "" : spec[0].unit, one.sigma, one.imitation, one.separation, one.status});
  }
  for (const auto& none : invisible) csv.row({none.hypothesis, "", "", "", "", "", "", "", "not visible: " + none.reason});
  csv.save(file);
}

std::vector<std::string> write_extended_model(const diagnosis::DiagnosedModel& model, const diagnosis::Places& places,
                                              const diagnosis::Diagnosis& result, const std::string& state, bool several,
                                              const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const auto of_state = [&](const diagnosis::Effect& e) { return e.cause.candidate->acts_in_state(state); };
  diagnosis::Diagnosis here = result;
  std::erase_if(here.effects, [&](const diagnosis::Effect& e) { return !of_state(e); });
  const diagnosis::ExtendedModel extended = diagnosis::extended_model(model, places, here);
  std::string list = "# Causes that the diagnosis put into this model, in the order in which they were found.\n";
  if (several) list += fmt::format("state = {}\n", io::toml_text(state));
  std::vector<std::string> others;
  bool measurement = false;
  std::size_t held = 0;  // effects of this state so far
  for (const diagnosis::Effect& effect : result.effects) {
    const bool is_here = of_state(effect);
    measurement = measurement || (is_here && effect.cause.candidate->hypothesis->measurement);
    list += listed(effect, several, is_here && extended.holds[held]);
    if (is_here) ++held;
    if (!is_here) others.push_back(effect.cause.candidate->key());
  }
  if (extended.elements)
    model_io::write_model(*extended.elements, folder);
  else
    model_io::write_matrix_model(extended.system, folder);
  model_io::carry_load_cases(model.loaded.source, folder);
  if (measurement) write_corrected_channels(diagnosis::corrected_channels(model.channels, here), folder / "channels.csv");
  io::write_file_atomically(folder / "extension.toml", list);
  return others;
}

}  // namespace twindeck::steps
