#include "matching/pairing_account.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "dynamics/unit_slips.hpp"
#include "modal/mac.hpp"

namespace twindeck::matching {

namespace {

using Eigen::Index;

constexpr double same_shape_mac = 0.9;  ///< [-] the usual mark of one and the same mode
constexpr int fewest_same_shapes = 3;   ///< fewer frequency ratios may agree by chance
constexpr double least_factor = 1.10;   ///< [-] between frequencies; usual models are nearer, or off mode by mode
constexpr double factor_spread = 0.25;  ///< [-] of ln(factor): largest distance of a single ratio from it
std::string guess_of(double ratio) {
  return dynamics::slip_of_factor(ratio).value_or(
      fmt::format("look for a unit or a mass; stiffness over mass is {:.3g} times what was measured", ratio * ratio));
}

/// The computed mode with the shape of each measured one, one-to-one; -1 where no MAC reaches `same_shape_mac`.
std::vector<int> same_shapes(const Eigen::MatrixXd& mac) {
  const Eigen::MatrixXd alike = (mac.array() >= same_shape_mac).select(mac.array(), 0.0).matrix().transpose();
  std::vector<int> at = matching::follow_modes(alike);
  for (std::size_t i = 0; i < at.size(); ++i)
    if (at[i] >= 0 && !(alike(static_cast<Index>(i), at[i]) > 0.0)) at[i] = -1;
  return at;
}

/// Pairs for one factor on all frequencies, which keeps the order of the modes. At few channels several computed modes have the
/// shape of a measured one. This function takes the lowest of them above the computed mode of the previous pair. `same_shapes`
/// may take any of them.
std::vector<int> same_shapes_in_order(const Eigen::MatrixXd& mac, const Eigen::VectorXd& measured_Hz) {
  std::vector<int> order(static_cast<std::size_t>(mac.cols())), at(order.size(), -1);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, [&](int a, int b) { return measured_Hz[a] < measured_Hz[b]; });
  Index next = 0;
  for (const int i : order)
    for (Index n = next; n < mac.rows() && at[static_cast<std::size_t>(i)] < 0; ++n)
      if (mac(n, i) >= same_shape_mac) at[static_cast<std::size_t>(i)] = static_cast<int>(n), next = n + 1;
  return at;
}

/// Ratios of computed to measured frequency for modes of one shape, ascending. Empty if there are too few or they are not one
/// factor.
std::optional<std::vector<double>> ratios_of_one_factor(const std::vector<int>& same, const Eigen::VectorXd& measured_Hz,
                                                        const Eigen::VectorXd& computed_Hz) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < same.size(); ++i)
    if (same[i] >= 0) ratios.push_back(computed_Hz[same[i]] / measured_Hz[static_cast<Index>(i)]);
  const auto n = static_cast<Index>(ratios.size());
  if (n < fewest_same_shapes || 2 * n < measured_Hz.size()) return std::nullopt;
  std::sort(ratios.begin(), ratios.end());
  const double ratio = ratios[ratios.size() / 2], off = std::abs(std::log(ratio));
  if (!(off > std::log(least_factor))) return std::nullopt;
  for (const double each : {ratios.front(), ratios.back()})
    if (!(std::abs(std::log(each / ratio)) < factor_spread * off)) return std::nullopt;
  return ratios;
}

std::string few(const std::vector<std::string>& names) {
  constexpr std::size_t most = 6;  // names in a message; a line is read to its end only if it is short
  if (names.size() <= most) return fmt::format("{}", fmt::join(names, ", "));
  return fmt::format("{} and {} more", fmt::join(names.begin(), names.begin() + most, ", "), names.size() - most);
}

constexpr Index fewest_channels = 4;     ///< with three channels, reversing one has the same effect as reversing the other two
constexpr double part_left = 1.0 / 3.0;  ///< [-] of 1 - MAC that may remain after the right channel is reversed
constexpr double least_gain = 0.05;      ///< [-] least gain of the mean MAC; model errors and noise may give less

}  // namespace

PairingAccount account_of(const Measured& measured, const Pairing& pairing, const Eigen::VectorXd& computed_Hz) {
  PairingAccount account;
  account.by_shape = pairing.method == "mac";
  account.reversed = reversed_channel(measured, pairing);
  const double highest = computed_Hz.size() > 0 ? computed_Hz.maxCoeff() : 0.0;
  for (Index i = 0; i < measured.modes.size(); ++i) {
    const std::string& label = measured.labels[static_cast<std::size_t>(i)];
    const auto pair = std::ranges::find_if(pairing.pairs, [&](const auto& p) { return p.experimental == i; });
    if (pair == pairing.pairs.end()) {
      const bool reached = measured.modes.frequency_Hz[i] <= highest;
      (reached ? account.unpaired : account.beyond).push_back(label);
      account.measured += reached ? 1 : 0;
      continue;
    }
    ++account.measured;
    const std::string name = label + "-" + numerical_label(pair->numerical);
    if (std::isnan(pair->mac)) {
      if (account.by_shape) account.shapeless.push_back(name);
      continue;
    }
    if (!(account.worst_mac <= pair->mac)) {
      account.worst_mac = pair->mac;
      account.worst = name;
    }
    if (pair->mac < agreeing_mac) account.unlike.push_back(fmt::format("{} (MAC {:.2f})", name, pair->mac));
  }
  return account;
}

std::string pairing_words(const PairingAccount& account) {
  if (!account.by_shape) return "";
  std::string words = fmt::format("; {} of {} measured modes unpaired", account.unpaired.size(), account.measured);
  if (!account.beyond.empty()) words += fmt::format(", {} above the highest computed", account.beyond.size());
  if (!account.shapeless.empty()) words += fmt::format(", {} paired by frequency", account.shapeless.size());
  if (!account.worst.empty()) words += fmt::format(", worst MAC {:.2f} ({})", account.worst_mac, account.worst);
  if (!account.unlike.empty()) words += "; WARNING: shapes disagree";
  return words;
}

Status outcome(Status status, const PairingAccount& account) {
  if (status.converged && !account.unlike.empty()) status.message = "shapes disagree: " + few(account.unlike);
  return status;
}

std::optional<std::string> common_factor(const Measured& measured, const Pairing& pairing, const Eigen::VectorXd& computed_Hz) {
  if (pairing.mac.size() == 0) return std::nullopt;
  const Eigen::VectorXd& measured_Hz = measured.modes.frequency_Hz;
  auto ratios = ratios_of_one_factor(same_shapes(pairing.mac), measured_Hz, computed_Hz);
  if (!ratios) ratios = ratios_of_one_factor(same_shapes_in_order(pairing.mac, measured_Hz), measured_Hz, computed_Hz);
  if (!ratios) return std::nullopt;
  const double ratio = (*ratios)[ratios->size() / 2];
  return fmt::format(
      "the shapes of {} measured modes agree with computed ones (MAC of {} and more) whose frequencies are all {:.3g} "
      "times the measured ({:.3g} to {:.3g}): {}",
      ratios->size(), same_shape_mac, ratio, ratios->front(), ratios->back(), guess_of(ratio));
}

std::optional<std::string> far_by_order(const Measured& measured, const Pairing& pairing, const Eigen::VectorXd& computed_Hz,
                                        double maximum_error) {
  if (pairing.method != "order") return std::nullopt;
  std::vector<std::string> far;
  for (const ComparisonRow& row : compare("", measured, computed_Hz, pairing))
    if (!(std::abs(row.error_pct()) <= 100.0 * maximum_error))
      far.push_back(fmt::format("{}-{} ({:+.0f} %)", row.experimental, row.numerical, row.error_pct()));
  if (far.empty()) return std::nullopt;
  return fmt::format(
      "paired by the order of frequencies, {} {} further apart than maximum_frequency_error ({:g}): a mode may be missing or "
      "stand twice on one side, and all pairs after it are then wrong; `pairs` states which modes belong together",
      few(far), far.size() == 1 ? "is" : "are", maximum_error);
}

void warn_of_pairing(Reporter& reporter, const PairingAccount& account, const std::optional<std::string>& factor,
                     const std::string& stage) {
  if (factor) reporter.warn(*factor);
  if (account.reversed) reporter.warn(*account.reversed);
  if (!account.shapeless.empty())
    reporter.warn(fmt::format("{}: measured at one channel alone, where any two shapes agree; paired by frequency",
                              few(account.shapeless)));
  if (account.unlike.empty()) return;
  reporter.warn(
      fmt::format("shapes disagree{}: {}; frequencies that fit say nothing there. A channel may be reversed, exchanged or "
                  "mis-scaled (s9_diagnosis finds out, --correct puts it right), or the model lacks something",
                  stage.empty() ? "" : " " + stage, few(account.unlike)));
}

void refuse_few_pairs(const PairingAccount& account, double least_paired, double minimum_mac, const std::string& source,
                      const std::optional<std::string>& factor) {
  if (!account.by_shape || account.paired() >= least_paired * std::max(account.measured, 1)) return;
  const std::vector<std::string>& lacking = account.measured > 0 ? account.unpaired : account.beyond;
  const std::size_t of = account.measured > 0 ? static_cast<std::size_t>(account.measured) : account.beyond.size();
  throw InputError(
      {source, 0, ""},
      fmt::format("only {} of {} measured modes are like a computed one (MAC of at least {:g}, frequency within "
                  "maximum_frequency_error), expected a share of at least {:g}: unpaired {} {}",
                  account.paired(), of, minimum_mac, least_paired, lacking.size() == 1 ? "mode" : "modes", few(lacking)),
      factor.value_or("check directions, signs and places of the channels and the model's axes; s9_diagnosis looks for "
                      "wrong channels; `minimum_mac` and `least_paired` say what is enough"));
}

Pairing pair_as_configured(Reporter& reporter, const PairingSettings& settings, const Measured& measured,
                           const dynamics::LoadedModel& model, const dynamics::EigenModes& modes, const Place& place) {
  const Eigen::VectorXd& computed_Hz = modes.frequency_Hz;
  const Pairing pairing = measured.modes.has_shapes()
                              ? pair_at_sensors(measured, model, modes, settings, settings.sensor_tolerance_m)
                          : settings.pairs.empty() ? pair_by_order(measured, computed_Hz.size())
                                                   : pair_as_published(measured, computed_Hz.size(), settings.pairs, place);
  warn_of_unmeasured(reporter, pairing);
  const std::optional<std::string> factor = common_factor(measured, pairing, computed_Hz);
  refuse_few_pairs(account_of(measured, pairing, computed_Hz), settings.least_paired, settings.minimum_mac, measured.source,
                   factor);
  if (factor) reporter.warn(*factor);
  if (const auto far = far_by_order(measured, pairing, computed_Hz, settings.maximum_frequency_error)) reporter.warn(*far);
  return pairing;
}

std::optional<std::string> reversed_channel(const Measured& measured, const Pairing& pairing) {
  const Index channels = pairing.shapes.rows();
  if (channels < fewest_channels || pairing.pairs.size() < 2) return std::nullopt;
  double lacking = 0.0;                                      // sum of 1 - MAC over the pairs
  Eigen::VectorXd turned = Eigen::VectorXd::Zero(channels);  // the same with one channel turned
  for (const ModePair& pair : pairing.pairs) {
    const Eigen::VectorXcd measured_shape = measured.modes.shapes.col(pair.experimental);
    const std::vector<Index> rows = modal::measured_rows(measured_shape);
    const Eigen::VectorXcd x = measured_shape(rows), n = pairing.shapes.col(pair.numerical)(rows);
    const double norms = x.squaredNorm() * n.squaredNorm();
    if (!(norms > 0.0)) continue;
    const std::complex<double> product = n.dot(x);
    const double lack = 1.0 - std::norm(product) / norms;
    lacking += lack;
    turned.array() += lack;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const auto at = static_cast<Index>(k);
      turned[rows[k]] += 1.0 - std::norm(product - 2.0 * std::conj(n[at]) * x[at]) / norms - lack;
    }
  }
  Index best = 0;
  const double left = turned.minCoeff(&best);
  const auto pairs = static_cast<double>(pairing.pairs.size());
  if (left > part_left * lacking || lacking - left < least_gain * pairs) return std::nullopt;
  return fmt::format(
      "channel {} seems to be reversed: with its sign turned the mean MAC of {} pairs is {:.2f}, as recorded it is {:.2f} "
      "(s9_diagnosis makes sure, --correct puts it right)",
      measured.modes.dofs[static_cast<std::size_t>(best)].direction, pairing.pairs.size(), 1.0 - left / pairs,
      1.0 - lacking / pairs);
}

}  // namespace twindeck::matching
