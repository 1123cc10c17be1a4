#include "steps/diagnosis/extension.hpp"

#include <fmt/format.h>

#include <optional>

#include "diagnosis/extended_model.hpp"
#include "io/atomic.hpp"
#include "io/csv.hpp"
#include "io/toml_value.hpp"
#include "model_io/load_cases.hpp"
#include "model_io/write_matrix_model.hpp"
#include "model_io/write_model.hpp"

namespace twindeck::steps {

namespace {

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

/// Entry of extension.toml.
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

}  // namespace

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
    measurement = measurement || effect.cause.candidate->hypothesis->measurement;
    const bool is_here = of_state(effect);
    list += listed(effect, several, is_here && extended.holds[held]);
    if (is_here) ++held;
    if (!is_here) others.push_back(effect.cause.candidate->key());
  }
  if (extended.elements)
    model_io::write_model(*extended.elements, folder);
  else
    model_io::write_matrix_model(extended.system, folder);
  model_io::carry_load_cases(model.loaded.source, folder);
  if (measurement) write_corrected_channels(diagnosis::corrected_channels(model.channels, result), folder / "channels.csv");
  io::write_file_atomically(folder / "extension.toml", list);
  return others;
}

}  // namespace twindeck::steps
