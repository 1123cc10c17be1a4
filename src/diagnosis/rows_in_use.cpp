#include "diagnosis/rows_in_use.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "diagnosis/features/same_modes.hpp"

namespace twindeck::diagnosis {

namespace {

/// Positions of the rows that are not left out.
template <typename LeftOut>
std::vector<Eigen::Index> rows_without(const FeatureSet& features, const LeftOut& left_out) {
  std::vector<Eigen::Index> kept;
  for (std::size_t r = 0; r < features.rows.size(); ++r)
    if (!left_out(features.rows[r])) kept.push_back(static_cast<Eigen::Index>(r));
  return kept;
}

void keep(FeatureSet& features, const std::vector<Eigen::Index>& kept) {
  features.rows = each_of(kept, [&](Eigen::Index r) { return features.rows[static_cast<std::size_t>(r)]; });
  if (features.covariance.size() > 0) features.covariance = features.covariance(kept, kept).eval();
}

}  // namespace

void choose_rows(const RowChoice& choice, FeatureSet& features) {
  if (choice.names_alike) name_modes_alike(features);
  const auto left_out = [&](const std::string& what) { return contains(choice.left_out, what); };
  for (const std::string& type : choice.left_out) {
    const auto& known = row_type_names();
    if (type.starts_with("mode:")) {
      if (std::ranges::none_of(features.rows, [&](const auto& row) { return row.mode == type.substr(5); }))
        throw InputError({"", 0, "left_out"}, fmt::format("no row has the mode of '{}'", type), "");
      continue;
    }
    if (!contains(known, type))
      throw InputError({"", 0, "left_out"}, fmt::format("'{}' is no type of row{}", type, did_you_mean(type, known)), "");
  }
  std::set<std::pair<int, std::string>> high;
  for (const Row& row : features.rows)
    if (row.type == RowType::frequency && choice.highest_Hz > 0.0 && row.value > choice.highest_Hz)
      high.insert({row.condition, row.mode});
  const std::vector<Eigen::Index> kept = rows_without(features, [&](const Row& row) {
    if (left_out(name_of(row.type))) return true;
    return row.type != RowType::stay_frequency && (left_out("mode:" + row.mode) || high.contains({row.condition, row.mode}));
  });
  if (kept.empty()) throw InputError({"", 0, "left_out"}, "no row is left", "leave fewer out");
  keep(features, kept);
}

std::optional<Finding> leave_out_unpaired(double least_mac, const ScatterOptions& scatter, const ReducedModel& model,
                                          FeatureSet& features) {
  if (!(least_mac > 0.0)) return std::nullopt;
  const FeatureMap map(model, features, scatter);
  const auto base = map.base(map.standing());
  const Prediction prediction = map.predict(base, {}, false);
  std::set<std::pair<int, std::string>> unpaired;
  Finding found{"unpaired", ""};
  const auto stays = model.sets.find("stays");
  for (std::size_t m = 0; m < map.measured_modes().size(); ++m) {
    const MeasuredMode& mode = map.measured_modes()[m];
    const bool other = prediction.paired[m] < 0 || prediction.mac[m] < least_mac;
    if (mode.real_rows.size() < 2 || !other) continue;
    unpaired.insert({mode.condition, mode.label});
    std::string name = fmt::format("{} of {} ({:.3f} Hz", mode.label, features.condition_of(mode).name, mode.frequency_Hz);
    if (stays != model.sets.end())
      for (const ReducedPlace& stay : stays->second)
        for (int harmonic = 1; harmonic <= 2 && stay.attributes.contains("f_cable"); ++harmonic)
          if (std::abs(harmonic * stay.attributes.at("f_cable") / mode.frequency_Hz - 1.0) < 0.03)
            name += fmt::format(", {}x{}", harmonic, stay.id);
    found.names.push_back(name + ")");
  }
  const std::vector<Eigen::Index> kept = rows_without(features, [&](const Row& row) {
    return row.type != RowType::stay_frequency && unpaired.contains({row.condition, row.mode});
  });
  if (unpaired.empty()) return std::nullopt;
  if (kept.empty())
    throw InputError({"", 0, "least_mac"}, fmt::format("no measured mode has a MAC of {} with the model's", least_mac), "");
  keep(features, kept);
  found.text = fmt::format("{} of {} measured modes are like no mode of the model (MAC below {}) and are left out: {}",
                           unpaired.size(), map.measured_modes().size(), least_mac, fmt::join(found.names, "; "));
  if (stays != model.sets.end() && !stays->second.empty())
    found.text += ". Stays whose own frequency this is are named; the model's stays do not vibrate";
  return found;
}

std::optional<Finding> leave_out_imaginary(const ReducedModel& model, FeatureSet& features) {
  if (model.sets.contains("dampers")) return std::nullopt;
  const std::vector<Eigen::Index> kept = rows_without(features, [](const Row& row) { return row.type == RowType::shape_imag; });
  const std::size_t dropped = features.rows.size() - kept.size();
  if (dropped == 0 || kept.empty()) return std::nullopt;
  keep(features, kept);
  return Finding{"imaginary",
                 fmt::format("{} imaginary parts of shapes are left out: the model has no damper that could turn a shape "
                             "complex, so they tell errors of identification, most of modes that lie close",
                             dropped)};
}

bool has_rows_of_modes(const FeatureSet& features) {
  return std::ranges::any_of(features.rows, [](const Row& row) { return !is_static(row.type); });
}

void hold_out(const std::vector<std::string>& rules, FeatureSet& features) {
  if (rules.empty()) {
    if (!has_rows_of_modes(features)) hold_out_by_rule(features);
    return;
  }
  for (Row& row : features.rows) row.held_out = false;
  for (const std::string& rule : rules) {
    if (rule == "none") continue;
    const auto slash = rule.find('/'), second = slash == std::string::npos ? slash : rule.find('/', slash + 1);
    bool any = false;
    std::set<std::string> second_modes;  // "condition/every_second": even places in ascending frequency
    if (rule.ends_with("/every_second")) {
      std::map<double, std::string> ascending;
      for (const Row& row : features.rows)
        if (row.type == RowType::frequency && features.condition_of(row).name == rule.substr(0, slash))
          ascending[row.value] = row.mode;
      bool even = false;
      for (const auto& [frequency, mode] : ascending) {
        if (even) second_modes.insert(mode);
        even = !even;
      }
    }
    for (Row& row : features.rows) {
      const bool hit = features.condition_of(row).name == rule.substr(0, slash) &&
                       (slash == std::string::npos || row.mode == rule.substr(slash + 1, second - slash - 1) ||
                        second_modes.contains(row.mode)) &&
                       (second == std::string::npos || name_of(row.type) == rule.substr(second + 1));
      row.held_out = row.held_out || hit;
      any = any || hit;
    }
    if (!any)
      throw InputError({"", 0, "hold_out"}, fmt::format("'{}' matches no row", rule),
                       "write \"condition\", \"condition/mode\", \"condition/mode/type\" or \"condition/every_second\"");
  }
}

}  // namespace twindeck::diagnosis
