#include "diagnosis/features/features.hpp"

#include <algorithm>
#include <numeric>
#include <set>

namespace twindeck::diagnosis {

namespace {

/// Holds out the conditions with the largest value of a quantity, if it has three or more different values.
template <typename Value>
void hold_out_largest(FeatureSet& features, Value value) {
  std::set<double> values;
  for (const Condition& condition : features.conditions)
    if (const std::optional<double> v = value(condition)) values.insert(*v);
  if (values.size() < 3) return;
  for (Row& row : features.rows) {
    const auto v = value(features.condition_of(row));
    if (v && *v == *values.rbegin()) row.held_out = true;
  }
}

}  // namespace

void hold_out_by_rule(FeatureSet& features) {
  if (std::ranges::any_of(features.rows, [](const Row& row) { return row.held_out; })) return;
  hold_out_largest(features, [](const Condition& c) { return c.amplitude_m; });
  hold_out_largest(features, [](const Condition& c) { return c.temperature_C; });
  hold_out_largest(features, [](const Condition& c) { return c.wind_m_s; });
  for (std::size_t c = 0; c < features.conditions.size(); ++c) {
    std::map<std::string, double> frequency;
    for (const Row& row : features.rows)
      if (row.condition == static_cast<int>(c) && row.type == RowType::frequency) frequency[row.mode] = row.value;
    if (frequency.size() < 4) continue;
    const auto highest =
        std::max_element(frequency.begin(), frequency.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    for (Row& row : features.rows) {
      const bool modal = row.type == RowType::frequency || row.type == RowType::damping || row.type == RowType::shape ||
                         row.type == RowType::shape_imag;
      if (modal && row.condition == static_cast<int>(c) && row.mode == highest->first) row.held_out = true;
    }
  }
}

std::vector<std::string> states_of(const FeatureSet& features) {
  std::vector<bool> used(features.conditions.size(), false);
  for (const Row& row : features.rows) used[static_cast<std::size_t>(row.condition)] = true;
  std::vector<std::size_t> in_order(used.size());
  std::iota(in_order.begin(), in_order.end(), std::size_t{0});
  std::ranges::stable_sort(
      in_order, [&](std::size_t a, std::size_t b) { return features.conditions[a].line < features.conditions[b].line; });
  std::vector<std::string> out;
  for (const std::size_t c : in_order) {
    const std::string& state = features.conditions[c].state;
    if (used[c] && std::ranges::find(out, state) == out.end()) out.push_back(state);
  }
  const auto reference = std::ranges::find(out, "reference");
  if (reference != out.end()) std::rotate(out.begin(), reference, reference + 1);
  return out;
}

std::string last_state(const FeatureSet& features) {
  const std::vector<std::string> states = states_of(features);
  return states.empty() ? std::string() : states.back();
}

const std::vector<std::string>& row_type_names() {
  static const std::vector<std::string> names = {"frequency_Hz",        "damping_ratio_pct", "shape",           "shape_imag",
                                                 "stay_frequency_Hz",   "rms_m_s2",          "psd_floor_m2_s3", "static_m",
                                                 "static_rotation_rad", "static_strain",     "static_force_N"};
  return names;
}

std::string name_of(RowType type) { return row_type_names()[static_cast<std::size_t>(type)]; }

}  // namespace twindeck::diagnosis
