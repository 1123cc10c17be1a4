#include "diagnosis/files/measurement_corrections.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/lists.hpp"
#include "io/atomic.hpp"

namespace twindeck::diagnosis {

namespace {

bool is_fault_of_channels(const Candidate& candidate) {
  const std::vector<ActionSpec>& actions = candidate.hypothesis->actions;
  return !candidate.channels.empty() && std::ranges::all_of(actions, [](const ActionSpec& action) {
    return action.primitive == Primitive::channel_sign || action.primitive == Primitive::channel_swap ||
           action.primitive == Primitive::channel_gain;
  });
}

records::Correction undo(const ActionSpec& action, const Cause& cause, const std::vector<std::string>& channels,
                         const std::string& state) {
  const Candidate& candidate = *cause.candidate;
  const auto name = [&](std::size_t which) { return channels[static_cast<std::size_t>(candidate.channels[which])]; };
  records::Correction correction;
  correction.channel = name(0);
  correction.state = state;
  if (action.primitive == Primitive::channel_swap) {
    correction.action = records::Correction::Action::exchange;
    correction.with = name(1);
  } else if (action.primitive == Primitive::channel_gain) {
    correction.action = records::Correction::Action::scale;
    correction.factor = 1.0 / candidate.value(action.number.at("factor"), cause.a);
  }
  return correction;
}

std::vector<std::string> words(const std::vector<records::Correction>& corrections) {
  const auto said = each_of(corrections, records::words_of);
  return said;
}

}  // namespace

std::vector<records::Correction> corrections_of(const Diagnosis& result, const std::vector<std::string>& channels) {
  std::vector<records::Correction> of_values, exchanges;
  for (const Effect& effect : result.effects) {
    const Candidate& fault = *effect.cause.candidate;
    if (effect.cluster.size() > 1 || !is_fault_of_channels(fault)) continue;
    std::vector<std::string> states = {fault.state};
    states.insert(states.end(), fault.further_states.begin(), fault.further_states.end());
    for (const std::string& state : states)
      for (const ActionSpec& action : fault.hypothesis->actions) {
        const records::Correction correction = undo(action, effect.cause, channels, state);
        (correction.action == records::Correction::Action::exchange ? exchanges : of_values).push_back(correction);
      }
  }
  of_values.insert(of_values.end(), exchanges.rbegin(), exchanges.rend());
  return of_values;
}

void write_corrections(const std::vector<records::Correction>& before, const std::vector<records::Correction>& found,
                       const std::filesystem::path& file) {
  if (found.empty()) return;
  std::string text =
      "# What is to be put right in the measured features before they are used: --correct FILE of steps 4, 6 and 9.\n";
  if (!before.empty()) text += fmt::format("# Corrected in this run already: {}.\n", fmt::join(words(before), ", "));
  text += fmt::format("# Found in this run: {}.\n", fmt::join(words(found), ", "));
  std::vector<records::Correction> all = before;
  for (const records::Correction& correction : found) {
    if (const auto undone = undone_by(all, correction))
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(*undone));  // the new correction cancels an earlier one
    else
      all.push_back(correction);
  }
  io::write_file_atomically(file, text + corrections_toml(all));
}

std::vector<std::string> correction_advice(const std::vector<records::Correction>& found) {
  if (found.empty()) return {};
  std::vector<std::string> channels;
  for (const records::Correction& correction : found)
    channels.push_back(correction.with.empty() ? correction.channel : correction.channel + " and " + correction.with);
  return {fmt::format("correct {}, then update: --correct with corrections.toml of this step ({})", fmt::join(channels, ", "),
                      fmt::join(words(found), ", "))};
}

}  // namespace twindeck::diagnosis
