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

}  // namespace

void write_extended_model(const diagnosis::DiagnosedModel& model, const diagnosis::Places& places,
                          const diagnosis::Diagnosis& result, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const diagnosis::ExtendedModel extended = diagnosis::extended_model(model, places, result);
  std::string list = "# Causes that the diagnosis put into this model, in the order in which they were found.\n";
  bool measurement = false;
  for (std::size_t i = 0; i < result.effects.size(); ++i) {
    const diagnosis::Effect& effect = result.effects[i];
    const diagnosis::Hypothesis& cause = *effect.cause.candidate->hypothesis;
    measurement = measurement || cause.measurement;
    list += fmt::format("\n[[cause]]\nid = {}\nlocation = {}\nin_model = {}\n", io::toml_text(cause.id),
                        io::toml_text(effect.cause.candidate->location), static_cast<bool>(extended.holds[i]));
    for (const diagnosis::EffectParameter& p : effect.parameters)
      list += fmt::format("{} = {}\n", p.name, io::toml_number(p.value));
  }
  if (extended.elements)
    model_io::write_model(*extended.elements, folder);
  else
    model_io::write_matrix_model(extended.system, folder);
  model_io::carry_load_cases(model.loaded.source, folder);
  if (measurement) write_corrected_channels(diagnosis::corrected_channels(model.channels, result), folder / "channels.csv");
  io::write_file_atomically(folder / "extension.toml", list);
}

}  // namespace twindeck::steps
