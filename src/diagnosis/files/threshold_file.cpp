#include "diagnosis/files/threshold_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "io/atomic.hpp"
#include "io/manifest.hpp"
#include "io/toml_value.hpp"

namespace twindeck::diagnosis {
namespace {

/// Of the way in which null data sets are made and searched: thresholds of an earlier way are not taken.
constexpr int method = 5;

void put(std::ostream& key, const Expression& e) { key << e.factor << '*' << e.name << ','; }

void put(std::ostream& key, const std::optional<double>& value) {
  if (value) key << *value;
  key << ',';
}

void put_rules(std::ostream& key, const ThresholdRules& rules) {
  const ScatterOptions& s = rules.scatter;
  key << "rules " << rules.alpha << ',' << rules.nulls << ',' << rules.modes << ',' << rules.most_refined << ','
      << rules.refine_within << ",scatter ";
  for (const double v : {s.element_stiffness, s.element_mass, s.node_mass, s.stay_stiffness, s.stay_pull, s.gain,
                         s.frequency_floor, s.damping_floor, s.shape_floor, s.load_model, s.model_form, s.fine, s.noise})
    key << v << ',';
  key << s.damping_by_dampers << ",pairs ";
  for (const std::string& pair : rules.pairs) key << pair << ',';
}

/// What each sensor sees of the basis: others where it stands elsewhere. Norms do not know of signs and rotations of vectors,
/// which are other ones on other processors; nor may what is rounding.
void put_sensors(std::ostream& key, const Eigen::MatrixXd& sensors) {
  if (sensors.rows() == 0) return;
  const Eigen::VectorXd seen = sensors.rowwise().norm();
  const double rounding = 1e-9 * seen.maxCoeff();
  key << ",sensors";
  for (const double v : seen) key << ' ' << (v > rounding ? v : 0.0);
}

void put_model(std::ostream& key, const ReducedModel& model) {
  key << "|model " << model.size() << ',' << model.total_mass_kg << ',' << model.frequency_Hz.transpose();
  put_sensors(key, model.sensors);
  if (!model.load_tests.empty()) key << ",loads " << model.load_tests.force << model.sensors;
  for (const fe::Parameter& p : model.parameters) key << ',' << p.name << ' ' << p.lower << ' ' << p.upper << ' ' << p.initial;
}

void put_rows(std::ostream& key, const FeatureSet& features) {
  key << "|conditions ";
  for (const Condition& c : features.conditions) {
    key << c.name << ',' << (c.dampers_on ? *c.dampers_on ? "on," : "off," : ",") << c.amplitude_channel << ',';
    if (c.state != Condition().state) key << "state " << c.state << ',';
    if (!c.load.empty()) key << c.load << ',';
    for (const auto& value : {c.amplitude_m, c.temperature_C, c.wind_m_s, c.direction_deg, c.people}) put(key, value);
  }
  key << "|rows ";
  for (const Row& row : features.rows)
    key << name_of(row.type) << row.mode << ',' << row.channel << row.stay << ',' << row.condition << ',' << row.std << ','
        << row.held_out << ';';
  if (features.covariance.size() > 0) key << "|covariance " << features.covariance;
}

void put_causes(std::ostream& key, const FeatureSet& features, const std::vector<Hypothesis>& catalogue,
                const Inference& inference) {
  key << "|causes ";
  const auto& rows = features.rows;
  const bool tested = std::any_of(rows.begin(), rows.end(), [](const Row& row) { return is_static(row.type); });
  const auto of_load_tests = [](const std::string& type) { return type.starts_with("static_"); };
  for (const Hypothesis& h : catalogue) {
    // What only load tests show is no part of a null without them.
    if (!tested && !h.needs.rows.empty() && std::all_of(h.needs.rows.begin(), h.needs.rows.end(), of_load_tests)) continue;
    key << h.id << ',' << h.set << ',' << h.filter << ',' << h.prior_weight << ',' << h.measurement << ':';
    for (const UnknownSpec& u : h.unknowns) {
      key << u.name << (u.log ? " log " : " linear ");
      put(key, u.low);
      put(key, u.high);
      for (const Expression& start : u.start) put(key, start);
    }
    for (const ActionSpec& action : h.actions) {
      key << action.kind << ' ';
      for (const auto& [name, text] : action.text) key << name << '=' << text << ',';
      for (const auto& [name, number] : action.number) put(key << name << '=', number);
    }
    key << ';';
  }
  key << "|candidates ";
  for (const auto& candidate : inference.candidates())
    key << candidate->key() << ' ' << candidate->low.transpose() << ' ' << candidate->high.transpose() << ' '
        << candidate->starts.size() << ' ' << candidate->log_prior << ';';
}

/// The lines that the check sum is of.
std::string body_of(const std::string& threshold, const std::string& nulls, const std::string& key_hash) {
  return fmt::format("threshold = {}\nnull_data_sets = {}\nkey = \"{}\"\n", threshold, nulls, key_hash);
}

}  // namespace

std::string threshold_key(const ThresholdRules& rules, const ReducedModel& model, const FeatureSet& features,
                          const std::vector<Hypothesis>& catalogue, const Inference& inference, std::uint64_t seed) {
  std::ostringstream key;
  key.precision(6);
  key << method << '|' << seed << '|';
  put_rules(key, rules);
  put_model(key, model);
  put_rows(key, features);
  put_causes(key, features, catalogue, inference);
  return key.str();
}

std::filesystem::path threshold_file(const std::filesystem::path& folder, const std::string& key) {
  constexpr std::size_t name_letters = 16;  // 64 bits tell the thresholds of one folder apart; the file holds the whole hash
  return folder / (io::sha256_of_text(key).substr(0, name_letters) + ".toml");
}

std::optional<double> read_threshold(const std::filesystem::path& file, const std::string& key) {
  if (!std::filesystem::exists(file)) return std::nullopt;
  std::optional<double> threshold;
  std::string nulls, key_hash, check;
  for (const io::TomlEntry& entry : io::read_toml(file)) {
    const auto* text = entry.value.as<std::string>();
    if (entry.key == "threshold" && entry.value.as<double>() != nullptr) threshold = *entry.value.as<double>();
    if (entry.key == "null_data_sets") nulls = io::shown(entry.value);
    if (entry.key == "key" && text != nullptr) key_hash = *text;
    if (entry.key == "check" && text != nullptr) check = *text;
  }
  const bool sound = threshold && std::isfinite(*threshold) && key_hash == io::sha256_of_text(key) &&
                     check == io::sha256_of_text(body_of(fmt::format("{:.6f}", *threshold), nulls, key_hash));
  if (!sound) {
    throw InputError({file.string(), 0, threshold ? "threshold" : ""}, "is not what a run of s9_diagnosis kept for these data",
                     "remove the file: the null data sets are run again");
  }
  return threshold;
}

void write_threshold(double threshold, long nulls, double quantile, const std::filesystem::path& file, const std::string& key) {
  TWINDECK_ASSERT(std::isfinite(threshold));
  const std::string body = body_of(fmt::format("{:.6f}", threshold), std::to_string(nulls), io::sha256_of_text(key));
  io::write_file_atomically(file, fmt::format("# {} null data sets, quantile {} of the largest log odds\n{}check = \"{}\"\n",
                                              nulls, quantile, body, io::sha256_of_text(body)));
}

}  // namespace twindeck::diagnosis
