#include "diagnosis/form_frame.hpp"

#include <algorithm>
#include <string>

#include "core/lists.hpp"
#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const std::string kStateContrast = "state ";                             // followed by a name: that state alone
const std::string kFromState = "from state ", kBeforeState = "before ";  // as Candidate::when says

const std::vector<std::string>& contrast_keys() {
  static const std::vector<std::string> keys = {"dampers", "amplitude_m", "temperature_C", "wind_m_s", "people"};
  return keys;
}

/// Keys of conditions.toml that an action depends on; empty if it acts everywhere.
std::vector<std::string> keys_of(const ActionSpec& action) {
  const Primitive does = action.primitive;
  if (does == Primitive::damper_friction) return {"amplitude_m", "dampers"};
  if (acts_on(does) == ActsOn::damper) return {"dampers"};
  if (does == Primitive::frequency_amplitude) return {"amplitude_m"};
  if (acts_on(does) == ActsOn::people) return {"people"};
  if (acts_on(does) == ActsOn::wind) return {"wind_m_s"};
  if (acts_on(does) == ActsOn::varying) {
    const auto named = action.text.find("variable");
    return {named == action.text.end() ? "temperature_C" : named->second};
  }
  return {};
}

/// Contrast of a candidate that acts in some states only.
int contrast_of_states(const Candidate& candidate, const std::vector<Contrast>& contrasts) {
  const auto at = [&](const auto& is_it) {
    const auto found = std::ranges::find_if(contrasts, is_it);
    return found == contrasts.end() ? -1 : static_cast<int>(found - contrasts.begin());
  };
  const auto named = [&](const std::string& key) { return at([&](const Contrast& c) { return c.key == key; }); };
  const std::string when = candidate.when.empty() ? kStateContrast + candidate.state : candidate.when;
  if (const int own = named(when); own >= 0) return own;
  // A cause that acts before a state has the contrast between that state and the earlier ones.
  if (when.starts_with(kBeforeState)) {
    const std::string state = when.substr(kBeforeState.size());
    if (const int own = named("from " + state + " on"); own >= 0) return own;
    return named(state);
  }
  // A cause that acts in the first state alone has the contrast between that state and all others.
  const int others = at([](const Contrast& c) { return c.key.starts_with(kFromState); });
  return others >= 0 ? others : at([](const Contrast& c) { return c.key.starts_with(kStateContrast); });
}

}  // namespace

std::vector<Contrast> contrasts_of(const FeatureSet& features) {
  std::vector<bool> used(features.conditions.size(), false);
  for (const Row& row : features.rows)
    if (row.type == RowType::frequency || row.type == RowType::shape) used[static_cast<std::size_t>(row.condition)] = true;
  std::vector<Contrast> out;
  for (const std::string& key : contrast_keys()) {
    std::vector<std::optional<double>> values;
    for (std::size_t c = 0; c < used.size(); ++c)
      values.push_back(used[c] ? number_of(features.conditions[c], key) : std::nullopt);
    if (auto contrast = contrast_of(key, values)) out.push_back(std::move(*contrast));
  }
  const std::vector<std::string> states = states_of(features);
  const auto add = [&](const std::string& key, std::size_t from, std::size_t end) {
    Contrast contrast{key, VectorXd::Zero(std::ssize(used))};
    for (std::size_t c = 0; c < used.size(); ++c) {
      const auto state = std::ranges::find(states, features.conditions[c].state) - states.begin();
      if (used[c] && state >= static_cast<Index>(from) && state < static_cast<Index>(end))
        contrast.weight[static_cast<Index>(c)] = 1.0;
    }
    if (contrast.weight.sum() > 0.0) out.push_back(std::move(contrast));
  };
  for (std::size_t s = 1; s < states.size(); ++s) add(kStateContrast + states[s], s, s + 1);
  for (std::size_t s = 1; s + 1 < states.size(); ++s) add(kFromState + states[s] + " on", s, states.size());
  return out;
}

std::vector<int> contrasts_of(const Candidate& candidate, const std::vector<Contrast>& contrasts) {
  std::vector<int> out;
  const auto add = [&](int contrast) {
    if (contrast >= 0 && !contains(out, contrast)) out.push_back(contrast);
  };
  if (is_of_a_channel(candidate)) return out;  // the structure stays as it is
  if (!candidate.state.empty()) add(contrast_of_states(candidate, contrasts));
  if (candidate.state.empty())
    for (const ActionSpec& action : candidate.hypothesis->actions)
      for (const std::string& key : keys_of(action))
        for (std::size_t c = 0; c < contrasts.size(); ++c)
          if (contrasts[c].key == key) add(static_cast<int>(c));
  return out;
}

int contrast_of(const Candidate& candidate, const std::vector<Contrast>& contrasts) {
  const std::vector<int> all = contrasts_of(candidate, contrasts);
  return all.empty() ? -1 : all.front();
}

MatrixXd form_covariance(const FeatureMap& map, const FeatureMap::Base& base, const std::vector<Cause>& causes,
                         const VectorXd& predicted, double frequency, double shape) {
  const FormModes modes = map.form_modes(base, causes);
  const FormColumns form = form_columns(modes.structures, modes.paired, predicted);
  MatrixXd all(predicted.size(), form.frequency.cols() + form.shape.cols() + form.kinks.cols());
  all << frequency * form.frequency, shape * form.shape, shape * form.kinks;
  return linalg::square(all);
}

}  // namespace twindeck::diagnosis
