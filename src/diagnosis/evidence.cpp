#include "diagnosis/evidence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/distributions.hpp"
#include "core/lists.hpp"
#include "core/statistics.hpp"

namespace twindeck::diagnosis {

namespace {

/// [-] MAC below which two shapes are no pair (the paper calls 0.6 and less weak).
constexpr double kWeakMac = 0.6;
constexpr double kAlpha = 0.05;

/// The support nearest to a channel, "" if coordinates are unknown.
std::string nearest_support(const std::string& name, const std::vector<matching::Channel>& channels, const Places& places) {
  const auto channel = std::ranges::find_if(channels, [&](const matching::Channel& c) { return c.name == name; });
  const auto supports = places.sets.find("supports");
  if (channel == channels.end() || !channel->x_m || supports == places.sets.end()) return "";
  std::string best;
  double least = std::numeric_limits<double>::infinity();
  for (const Place& support : supports->second) {
    const double distance = (support.x_m - *channel->x_m).norm();
    if (!(distance < least)) continue;
    least = distance;
    best = support.id;
  }
  return best;
}

std::vector<Finding> updating_findings(const std::vector<Claim>& claims) {
  std::vector<Finding> out;
  Finding bounds{"bounds", ""}, shapes{"shapes", ""}, errors{"frequencies", ""};
  int parameters = 0, macs = 0, frequencies = 0;
  double squares = 0.0, worst = 0.0;
  for (const Claim& claim : claims) {
    if (claim.kind == Claim::Kind::parameter) {
      ++parameters;
      const double near = 0.02 * (claim.upper - claim.lower);
      if (claim.value < claim.lower + near || claim.value > claim.upper - near)
        bounds.names.push_back(fmt::format("{} ({:+.4g} %)", claim.name, claim.value));
    } else if (claim.kind == Claim::Kind::mac) {
      ++macs;
      if (claim.value < kWeakMac) shapes.names.push_back(fmt::format("{} ({:.2f})", claim.name, claim.value));
    } else if (claim.kind == Claim::Kind::frequency_error) {
      ++frequencies;
      squares += claim.value * claim.value;
      worst = std::max(worst, std::abs(claim.value));
      errors.names.push_back(fmt::format("{} ({:+.2f} %)", claim.name, claim.value));
    }
  }
  if (!bounds.names.empty()) {
    bounds.text = fmt::format(
        "{} of {} published parameters end on a bound: {}. The data push them further than a property can go, so they stand in "
        "for something else",
        bounds.names.size(), parameters, fmt::join(bounds.names, ", "));
    out.push_back(bounds);
  }
  if (frequencies > 0) {
    errors.text = fmt::format(
        "After the published updating {} frequencies are left {:.1f} % off in the root mean square, {:.1f} % at most, far more "
        "than they are measured to",
        frequencies, std::sqrt(squares / frequencies), worst);
    out.push_back(errors);
  }
  if (!shapes.names.empty()) {
    shapes.text = fmt::format(
        "{} of {} published pairs have a MAC below {}: {}. These modes are hardly the ones that they are compared with",
        shapes.names.size(), macs, kWeakMac, fmt::join(shapes.names, ", "));
    out.push_back(shapes);
  }
  return out;
}

/// Change of a mode's modal stiffness by moving dampers, according to the model: (f with / f without)² - 1 of its own modes,
/// complex with dampers. Empty if the model has no partner for one of the two.
std::optional<double> modelled_change(const FeatureMap& model, const std::string& mode) {
  const Prediction asked = model.predict(model.base(model.standing()), {}, false);
  double f[2] = {0.0, 0.0};
  for (std::size_t m = 0; asked.valid && m < model.measured_modes().size(); ++m) {
    const MeasuredMode& measured = model.measured_modes()[m];
    const auto& on = model.features().condition_of(measured).dampers_on;
    if (measured.label != mode || !on || asked.paired[m] < 0) continue;
    double& of_state = f[*on ? 1 : 0];
    if (!(of_state > 0.0)) of_state = asked.frequency_Hz[m];
  }
  if (!(f[0] > 0.0) || !(f[1] > 0.0)) return std::nullopt;
  return std::pow(f[1] / f[0], 2) - 1.0;
}

/// Findings on modes of one name with and without dampers.
std::vector<Finding> damper_findings(const FeatureSet& features, const Places& places, const FeatureMap* model) {
  std::map<std::string, std::array<double, 2>> f, deviation;
  for (const Row& row : features.rows) {
    const auto& on = features.condition_of(row).dampers_on;
    if (row.type != RowType::frequency || !on) continue;
    const std::size_t k = *on ? 1 : 0;
    if (f[row.mode][k] > 0.0) continue;
    f[row.mode][k] = row.value;
    deviation[row.mode][k] = row.std / row.value;
  }
  std::string most;
  double largest = 0.0, error = 0.0;
  int both = 0;
  for (const auto& [mode, value] : f) {
    if (!(value[0] > 0.0) || !(value[1] > 0.0)) continue;
    ++both;
    const double change = std::pow(value[1] / value[0], 2) - 1.0;
    if (std::abs(change) <= std::abs(largest)) continue;
    largest = change;
    most = mode;
    error = 2.0 * (1.0 + change) * std::hypot(deviation[mode][0], deviation[mode][1]);
  }
  if (both == 0 || !(largest > 4.0 * error)) return {};
  Finding found{"dampers", "", {most}, {}, "the modes with dampers at two or more amplitudes, one of them beyond slip"};
  found.text = fmt::format("With dampers mode {} has {:.0f} % (+- {:.0f}) {} modal stiffness than without", most,
                           100.0 * std::abs(largest), 100.0 * error, largest > 0.0 ? "more" : "less");
  if (const auto moving = model != nullptr ? modelled_change(*model, most) : std::nullopt) {
    found.text += fmt::format(". In the model, dampers that move change it by {:+.0f} %", 100.0 * *moving);
    if (std::abs(*moving - largest) <= 2.0 * error) {
      found.text += ", as much as is measured";
      return {found};
    }
  }
  for (const char* set : {"damper_types", "dampers"})
    if (const auto at = places.sets.find(set); at != places.sets.end() && found.candidates.empty())
      for (const Place& place : at->second)
        for (const char* cause : {"fric", "dampk"}) found.candidates.push_back(fmt::format("{}@{}", cause, place.id));
  return {found};
}

}  // namespace

std::vector<ChannelFactor> channel_factors(const std::vector<Claim>& claims) {
  std::map<std::string, std::map<std::string, double>> by_record;
  std::vector<std::string> order;
  for (const Claim& claim : claims) {
    if (claim.kind != Claim::Kind::rms_error) continue;
    by_record[claim.record][claim.name] = std::log1p(0.01 * claim.value);
    if (!contains(order, claim.name)) order.push_back(claim.name);
  }
  std::map<std::string, std::vector<double>> rest;
  for (const auto& [record, values] : by_record) {
    const double level = median(each_of(values, [](const auto& of_channel) { return of_channel.second; }));
    for (const auto& [channel, value] : values) rest[channel].push_back(value - level);
  }
  std::vector<ChannelFactor> out;
  if (order.size() < 4) return out;  // too few other channels for a comparison
  const auto mean = [](const std::vector<double>& v) {
    double sum = 0.0;
    for (const double x : v) sum += x / static_cast<double>(v.size());
    return sum;
  };
  for (const std::string& name : order) {
    std::vector<double> others;
    for (const std::string& other : order)
      if (other != name) others.push_back(mean(rest[other]));
    const double centre = mean(others), n = static_cast<double>(others.size());
    double variance = 0.0;
    for (const double x : others) variance += (x - centre) * (x - centre) / (n - 1.0);
    const double own = mean(rest[name]);
    const auto [lowest, highest] = std::minmax_element(rest[name].begin(), rest[name].end());
    const double t = (own - centre) / std::sqrt(std::max(variance, 1e-12) * (1.0 + 1.0 / n));
    out.push_back({name, static_cast<int>(rest[name].size()), std::exp(own), std::exp(*lowest), std::exp(*highest),
                   std::sqrt(variance), std::min(1.0, student_two_sided_tail(t, n - 1.0) * static_cast<double>(order.size()))});
  }
  return out;
}

std::vector<Finding> account_of(const std::vector<Claim>& claims, const FeatureSet& features,
                                const std::vector<matching::Channel>& channels, const Places& places, const FeatureMap* model) {
  std::vector<Finding> out = updating_findings(claims);
  for (const Finding& finding : damper_findings(features, places, model)) out.push_back(finding);
  for (const ChannelFactor& f : channel_factors(claims)) {
    const bool one_sided = f.lowest > 1.0 || f.highest < 1.0;  // in all records, not only on average
    if (f.p_value > kAlpha || f.records < 2 || !one_sided) continue;
    Finding found{"channel", "", {f.channel}, {"gain@channel:" + f.channel}};
    const std::string support = nearest_support(f.channel, channels, places);
    if (!support.empty()) found.candidates.push_back("brg@" + support);
    found.split_by = fmt::format("mode shapes with {} among the channels, or a calibrated sensor beside it", f.channel);
    found.text = fmt::format(
        "{} computes {:.2f} times what is measured in all {} records ({:.2f} to {:.2f}, the records' own levels taken out), "
        "while the other channels "
        "scatter by {:.0f} %: p = {:.2g}. It is no matter of wind; the sensor reads {:.2f} of the motion, or the structure is "
        "{} there than modelled{}",
        f.channel, f.factor, f.records, f.lowest, f.highest, 100.0 * f.others, f.p_value, 1.0 / f.factor,
        f.factor > 1.0 ? "stiffer" : "softer", support.empty() ? "" : fmt::format(", as {} would make it", support));
    out.push_back(found);
  }
  return out;
}

}  // namespace twindeck::diagnosis
