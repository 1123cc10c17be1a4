#include "records/corrections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/lists.hpp"
#include "io/toml_value.hpp"

namespace twindeck::records {

namespace {

using Eigen::Index;
using Action = Correction::Action;

const std::vector<std::string>& action_names() {
  static const std::vector<std::string> names = {"reverse", "exchange", "scale"};
  return names;
}

double factor_of(const io::TomlEntry& entry, const Place& place) {
  const double factor = io::number_of(entry.value).value_or(0.0);
  if (!(factor > 0.0) || !std::isfinite(factor))
    throw InputError(place, "is " + io::shown(entry.value) + ", expected a number above 0",
                     "give what the channel's values are to be multiplied by; a wrong sign is the action \"reverse\"");
  return factor;
}

Action action_of(const std::string& text, const Place& place) {
  const auto at = std::ranges::find(action_names(), text);
  if (at == action_names().end())
    throw InputError(place, fmt::format("'{}' is no action{}", text, did_you_mean(text, action_names())),
                     fmt::format("use one of {}", fmt::join(action_names(), ", ")));
  return static_cast<Action>(at - action_names().begin());
}

/// Content of one [[correction]], not checked yet.
struct Said {
  std::optional<std::string> channel, action, with, state;
  std::optional<double> factor;
  Place action_place;
};

Said read_said(const io::TomlValue::Table& table, const std::string& file) {
  static const std::vector<std::string> known = {"channel", "action", "with", "factor", "state"};
  Said said;
  for (const io::TomlEntry& entry : table) {
    const Place place{file, entry.line, entry.key};
    if (entry.key == "channel")
      said.channel = io::text_of(entry.value, place);
    else if (entry.key == "action") {
      said.action = io::text_of(entry.value, place);
      said.action_place = place;
    } else if (entry.key == "with")
      said.with = io::text_of(entry.value, place);
    else if (entry.key == "state")
      said.state = io::text_of(entry.value, place);
    else if (entry.key == "factor")
      said.factor = factor_of(entry, place);
    else
      throw InputError(place, "is not a known key of a correction" + did_you_mean(entry.key, known),
                       fmt::format("use {}", fmt::join(known, ", ")));
  }
  return said;
}

Correction correction_of(const Said& said, const Place& place) {
  const auto needed = [&](const std::string& key, const std::string& mend) {
    throw InputError({place.file, place.line, key}, "is missing", mend);
  };
  if (!said.channel || said.channel->empty()) needed("channel", "name the channel that is corrected");
  if (!said.action) needed("action", fmt::format("say what is done to it: one of {}", fmt::join(action_names(), ", ")));
  Correction correction;
  correction.place = place;
  correction.channel = *said.channel;
  correction.action = action_of(*said.action, said.action_place);
  correction.state = said.state.value_or("");
  const bool has_with = said.with && !said.with->empty();
  if (correction.action == Action::exchange) {
    if (!has_with) needed("with", "name the channel that '" + correction.channel + "' is exchanged with");
    correction.with = *said.with;
    if (correction.with == correction.channel)
      throw InputError({place.file, place.line, "with"}, "'" + correction.with + "' is exchanged with itself",
                       "name the other channel");
  } else if (has_with) {
    throw InputError({place.file, place.line, "with"}, fmt::format("belongs to the action exchange, not to {}", *said.action),
                     "take it out, or write action = \"exchange\"");
  }
  if (correction.action == Action::scale) {
    if (!said.factor) needed("factor", "give what the values of '" + correction.channel + "' are to be multiplied by");
    correction.factor = *said.factor;
  } else if (said.factor && *said.factor != 1.0) {
    throw InputError({place.file, place.line, "factor"}, fmt::format("belongs to the action scale, not to {}", *said.action),
                     "take it out, or write action = \"scale\"");
  }
  return correction;
}

}  // namespace

std::optional<std::size_t> undone_by(const std::vector<Correction>& list, const Correction& next) {
  if (next.action == Action::scale) return std::nullopt;
  for (std::size_t i = list.size(); i-- > 0;) {
    const Correction& earlier = list[i];
    const bool same = earlier.channel == next.channel && earlier.with == next.with;
    const bool turned = earlier.channel == next.with && earlier.with == next.channel;
    if (earlier.action == next.action && earlier.state == next.state && (same || turned)) return i;
    if (earlier.action == Action::exchange || next.action == Action::exchange)
      return std::nullopt;  // before an exchange the names mean other channels
  }
  return std::nullopt;
}

std::string name_of(Correction::Action action) { return action_names()[static_cast<std::size_t>(action)]; }

std::string words_of(const Correction& correction) {
  const std::string where = correction.state.empty() ? "" : " in state " + correction.state;
  switch (correction.action) {
    case Action::reverse:
      return correction.channel + " reversed" + where;
    case Action::exchange:
      return correction.channel + " and " + correction.with + " exchanged" + where;
    case Action::scale:
      return fmt::format("{} multiplied by {:.4g}{}", correction.channel, correction.factor, where);
  }
  return "";
}

std::vector<Correction> read_corrections(const std::filesystem::path& file) {
  std::vector<Correction> corrections;
  for (const io::TomlEntry& entry : io::read_toml(file)) {
    const auto* list = entry.value.as<io::TomlValue::Array>();
    if (entry.key != "correction" || list == nullptr)
      throw InputError({file.string(), entry.line, entry.key}, "is not known here",
                       "write one [[correction]] for each thing to put right");
    for (const io::TomlValue& value : *list) {
      const auto* table = value.as<io::TomlValue::Table>();
      if (table == nullptr)
        throw InputError({file.string(), value.line, "correction"}, "is no table", "write [[correction]] with its keys below");
      const Correction correction = correction_of(read_said(*table, file.string()), {file.string(), value.line, ""});
      if (undone_by(corrections, correction))
        throw InputError(correction.place, words_of(correction) + ": stands twice, which undoes it", "remove one of the two");
      corrections.push_back(correction);
    }
  }
  if (corrections.empty())
    throw InputError({file.string(), 0, ""}, "holds no [[correction]]",
                     "write one for each thing to put right, or leave --correct out");
  return corrections;
}

std::string corrections_toml(const std::vector<Correction>& corrections) {
  std::string text;
  for (const Correction& c : corrections) {
    text += fmt::format("\n[[correction]]\nchannel = {}\naction = {}\n", io::toml_text(c.channel),
                        io::toml_text(name_of(c.action)));
    if (c.action == Action::exchange) text += fmt::format("with = {}\n", io::toml_text(c.with));
    if (c.action == Action::scale) text += fmt::format("factor = {}\n", io::toml_number(c.factor));
    if (!c.state.empty()) text += fmt::format("state = {}\n", io::toml_text(c.state));
  }
  return text;
}

CorrectedChannel corrected(const std::vector<Correction>& corrections, const std::string& channel, const std::string& state) {
  CorrectedChannel now{channel, 1.0};
  for (const Correction& c : corrections) {
    if (!c.state.empty() && c.state != state) continue;
    if (c.action == Action::exchange && (now.name == c.channel || now.name == c.with))
      now.name = now.name == c.channel ? c.with : c.channel;
    else if (c.action == Action::reverse && now.name == c.channel)
      now.factor = -now.factor;
    else if (c.action == Action::scale && now.name == c.channel)
      now.factor *= c.factor;
  }
  return now;
}

void refuse_unknown_channels(const std::vector<Correction>& corrections, const std::vector<std::string>& known,
                             const std::string& source) {
  for (const Correction& c : corrections) {
    for (const std::string* name : {&c.channel, &c.with})
      if (!(name == &c.with && c.action != Action::exchange) && !contains(known, *name))
        throw InputError({c.place.file, c.place.line, name == &c.with ? "with" : "channel"},
                         fmt::format("'{}' is no channel of {}{}", *name, source, did_you_mean(*name, known)),
                         known.empty() ? "there are no channels, so that nothing can be corrected"
                                       : fmt::format("it has {}", fmt::join(known, ", ")));
  }
}

void correct(const std::vector<Correction>& corrections, const std::vector<MeasuredCondition>& conditions,
             FeatureRows& features) {
  if (corrections.empty()) return;
  const std::vector<std::string> states = states_of(conditions);
  for (const Correction& c : corrections)
    if (!c.state.empty() && !contains(states, c.state))
      throw InputError({c.place.file, c.place.line, "state"},
                       fmt::format("'{}' is no state of the measurement{}", c.state, did_you_mean(c.state, states)),
                       fmt::format("it has {}", fmt::join(states, ", ")));
  Eigen::VectorXd factors = Eigen::VectorXd::Ones(std::ssize(features.rows));
  for (std::size_t r = 0; r < features.rows.size(); ++r) {
    FeatureRow& row = features.rows[r];
    if (!row.is_shape() && (row.is_modal() || row.type == "stay_frequency_Hz")) continue;  // not by channel
    const auto condition = std::ranges::find(conditions, row.condition, &MeasuredCondition::name);
    const CorrectedChannel now =
        corrected(corrections, row.channel, condition == conditions.end() ? std::string() : condition->state);
    const bool is_signed = row.is_shape() || row.type.starts_with("static_");
    const double factor = is_signed                       ? now.factor
                          : row.type == "psd_floor_m2_s3" ? now.factor * now.factor
                                                          : std::abs(now.factor);
    row.channel = now.name;
    row.value *= factor;
    row.std *= std::abs(factor);
    factors[static_cast<Index>(r)] = factor;
  }
  if (features.covariance.size() > 0)
    features.covariance = (factors.asDiagonal() * features.covariance * factors.asDiagonal()).eval();
}

void correct(const std::vector<Correction>& corrections, std::vector<MeasuredCondition>& conditions) {
  for (MeasuredCondition& condition : conditions) {
    if (condition.amplitude_channel.empty()) continue;
    const CorrectedChannel now = corrected(corrections, condition.amplitude_channel, condition.state);
    condition.amplitude_channel = now.name;
    if (condition.amplitude_m) *condition.amplitude_m *= std::abs(now.factor);
  }
}

void correct(const std::vector<Correction>& corrections, modal::ModeSet& modes, const std::string& source) {
  if (corrections.empty()) return;
  const auto names = each_of(modes.dofs, &modal::ShapeDof::direction);
  refuse_unknown_channels(corrections, names, source);
  for (const Correction& c : corrections) {
    if (!c.state.empty())
      throw InputError(
          {c.place.file, c.place.line, "state"}, "is given, but " + source + " names no states",
          "give the folder features of step 3, or the corrections of the state that was measured, without `state`");
    for (const std::string& name : {c.channel, c.with})
      if (std::ranges::count(names, name) > 1)
        throw InputError({c.place.file, c.place.line, "channel"},
                         fmt::format("'{}' stands at several points of {}", name, source),
                         "name the channel as the direction of its rows in shapes.csv");
  }
  const Eigen::MatrixXcd recorded = modes.shapes;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const CorrectedChannel now = corrected(corrections, names[i], "");
    const auto to = now.name == names[i] ? i : static_cast<std::size_t>(std::ranges::find(names, now.name) - names.begin());
    modes.shapes.row(static_cast<Index>(to)) = now.factor * recorded.row(static_cast<Index>(i));
  }
}

}  // namespace twindeck::records
