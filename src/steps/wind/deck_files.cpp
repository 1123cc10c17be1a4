#include "steps/wind/deck_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <sstream>
#include <string>

#include "aero/files/aero_data.hpp"
#include "aero/files/turbulence_files.hpp"
#include "aero/laws.hpp"
#include "core/error.hpp"
#include "core/lists.hpp"
#include "io/csv.hpp"

namespace twindeck::steps {

namespace {

// Laws that the data of a deck may break, as its configuration states them: {law: reason}.
std::map<std::string, std::string> exceptions_of(const aero::DeckWind& deck) {
  constexpr int least_words = 3;  // a reason has three words or more
  std::map<std::string, std::string> exceptions;
  for (const std::string& entry : deck.exceptions) {
    const Place place{"", 0, "deck " + deck.name + ": exceptions"};
    const std::size_t colon = entry.find(": ");
    const std::string law = entry.substr(0, colon), reason = colon == std::string::npos ? "" : entry.substr(colon + 2);
    if (const std::vector<std::string>& known = aero::law_names(); !contains(known, law))
      throw InputError(place, "names the law '" + law + "'" + did_you_mean(law, known), "laws are listed in aero/laws.hpp");
    std::istringstream words(reason);
    if (std::distance(std::istream_iterator<std::string>(words), {}) < least_words)
      throw InputError(place, "gives no reason for '" + law + "'", "write it as \"" + law + ": why the data break it\"");
    exceptions[law] = reason;
  }
  return exceptions;
}

void check_laws(const aero::DeckWind& deck, const aero::DeckAerodynamics& data) {
  std::map<std::string, std::string> exceptions = exceptions_of(deck);
  const aero::QuasiSteady::Arms arms{deck.arm_drag, deck.arm_lift, deck.arm_moment};
  for (const aero::BrokenLaw& broken :
       data.flutter ? aero::broken_laws(data.polar, *data.flutter, arms) : aero::broken_laws(data.polar))
    if (exceptions.erase(broken.law) == 0)
      throw InputError({"", 0, "deck " + deck.name}, "breaks the law '" + broken.law + "': " + broken.told,
                       "mend the file, or say why in the deck's exceptions: \"" + broken.law + ": reason\"");
  if (!exceptions.empty())
    throw InputError({"", 0, "deck " + deck.name + ": exceptions"},
                     "'" + exceptions.begin()->first + "' is excepted, but holds", "take the entry out");
}

}  // namespace

std::vector<aero::DeckAerodynamics> read_deck_aerodynamics(const aero::WindSettings& config, runner::StepContext& context) {
  if (config.decks.empty())
    throw InputError({"", 0, "deck"}, "no deck is given",
                     "add a [[deck]] with name, chord, polar and, where you have it, flutter");
  std::vector<aero::DeckAerodynamics> data;
  for (const aero::DeckWind& deck : config.decks) {
    data.push_back({aero::read_polar(context.input(deck.polar)), nullptr});
    if (deck.flutter.empty() && contains(config.sets, "standin"))
      throw InputError({"", 0, "deck " + deck.name}, "has no file of flutter derivatives, which the set standin is made of",
                       "give its flutter, or write sets = [\"quasi_steady\"] in step 7 and set = \"quasi_steady\" in step 8");
    if (!deck.flutter.empty())
      data.back().flutter = std::make_shared<aero::DerivativeTable>(
          aero::read_flutter_derivatives(context.input(deck.flutter), config.below_range, config.above_range));
    check_laws(deck, data.back());
  }
  return data;
}

AerodynamicsConfig read_step_7(const std::string& file, runner::StepContext& context) {
  if (file.empty() && context.study.empty())
    throw InputError({"", 0, "aerodynamics"}, "neither a study nor a configuration of step 7 was given",
                     "give --study, or --set aerodynamics=s7_aerodynamics.toml");
  AerodynamicsConfig out;
  io::FieldTable fields = out.fields();
  std::string model;
  fields.text("model", model, "model folder of step 7: that of this step too, where nothing else names one");
  fields.load(context.input(file.empty() ? context.study / "s7_aerodynamics.toml" : std::filesystem::path(file)));
  fields.require();
  if (!context.model && !model.empty()) context.model = context.resolved(model);
  return out;
}

double fitted_level(runner::StepContext& context, const std::string& set) {
  const std::filesystem::path file = context.input(context.results / "s7_aerodynamics" / "sets.csv");
  const io::CsvTable table = io::CsvTable::read(file, {"set", "level"}, {}, true);
  std::vector<std::string> known;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, "set") == set) {
      const double level = table.number(row, "level");
      if (level > 0.0) return level;
      table.fail(row, "level", fmt::format("is {}, expected a factor above 0", table.text(row, "level")),
                 "run step 7 again, which writes this file");
    }
    known.push_back(table.text(row, "set"));
  }
  throw InputError({file.string(), 0, "set"}, "has no set '" + set + "'" + did_you_mean(set, known),
                   fmt::format("choose one of {}", fmt::join(known, ", ")));
}

wind::TurbulenceSet read_turbulence(const ValidationConfig& config, runner::StepContext& context) {
  wind::TurbulenceSet set = aero::read_turbulence_set(context.input(config.turbulence_file), config.turbulence_set);
  static const std::map<std::string, wind::SpectrumLaw> laws = {{"von_karman", wind::SpectrumLaw::von_karman},
                                                                {"kaimal", wind::SpectrumLaw::kaimal},
                                                                {"en_1991_1_4", wind::SpectrumLaw::en_1991_1_4},
                                                                {"table", wind::SpectrumLaw::table}};
  for (wind::Spectrum& spectrum : set.spectrum) spectrum.law = laws.at(config.spectrum);
  if (!config.spectrum_file.empty()) {
    const auto tables = aero::read_spectra(context.input(config.spectrum_file), config.components());
    for (std::size_t c = 0; c < tables.size(); ++c) set.spectrum[c].table = tables[c];
  }
  if (!config.coherence_file.empty())
    set.coherence = aero::read_coherences(context.input(config.coherence_file), config.components());
  if (config.coherence == "davenport")
    for (wind::PerComponent& decay : set.decay) decay.fill(config.davenport_decay);
  const auto stated = [&set](wind::Component component, const std::vector<double>& decay) {
    if (!decay.empty()) std::ranges::copy(decay, set.decay[static_cast<std::size_t>(component)].begin());
  };
  stated(wind::Component::along, config.decay_v);
  stated(wind::Component::across, config.decay_u);
  stated(wind::Component::vertical, config.decay_w);
  return set;
}

}  // namespace twindeck::steps
