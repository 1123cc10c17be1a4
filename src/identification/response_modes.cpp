#include "identification/response_modes.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "identification/modal_fit.hpp"
#include "identification/plscf.hpp"

namespace twindeck::identification {

using Eigen::Index;
using records::FrequencyResponses;

namespace {

constexpr Index kFewestLines = 40;   ///< pLSCF then has ten orders: the selection needs a mode at four or more
constexpr Index kLinesOfAPower = 4;  ///< lines for each power of z; more powers than that follow the noise
/// Largest order where the configuration states none: one reference shows two close modes at 5 % of noise from about 100 on,
/// and pLSCF has hardly any poles beside those of the structure. Its step is twice that of records.
constexpr long kLargestOrder = 120;
constexpr Index kLargestModel = 200;  ///< rows of the companion matrix: orders times inputs

/// Keeps the lines of the band. @throws InputError  if too few are left
void cut_to_band(FrequencyResponses& responses, const IdentificationSettings& config, const std::string& file) {
  const Eigen::VectorXd& f = responses.frequency_Hz;
  const double highest = config.highest_Hz > 0.0 ? config.highest_Hz : std::numeric_limits<double>::infinity();
  const Index first = (f.array() < config.lowest_Hz).count(), n = f.size() - first - (f.array() > highest).count();
  if (n < kFewestLines) {
    const bool is_cut = n < f.size();
    throw InputError(
        {is_cut ? "" : file, 0, is_cut ? "band.highest" : ""},
        fmt::format("{} {} frequency lines above 0 Hz, expected {} or more", is_cut ? "leaves" : "has", std::max<Index>(n, 0),
                    kFewestLines),
        is_cut ? "widen the band (band.lowest, band.highest)" : "export the functions with a finer resolution or a wider band");
  }
  responses.values = Eigen::MatrixXcd(responses.values.middleRows(first, n));
  responses.frequency_Hz = Eigen::VectorXd(f.segment(first, n));
}

/// The functions in units of their channels' scales.
struct ScaledFunctions {
  Eigen::MatrixXcd values;
  Eigen::VectorXd scale;
};

ScaledFunctions scaled_functions(const FrequencyResponses& responses) {
  const auto n_others = std::ssize(responses.others);
  Eigen::VectorXd scale = Eigen::VectorXd::Zero(std::ssize(responses.channels));
  Eigen::MatrixXcd values = responses.values;
  // The other side first: its sensors may differ in unit. Each channel then gets unit RMS.
  for (Index i = 0; i < n_others; ++i) {
    double squares = 0.0;
    for (Index o = 0; o < scale.size(); ++o) squares += values.col(o * n_others + i).squaredNorm();
    for (Index o = 0; o < scale.size(); ++o)
      values.col(o * n_others + i) /= std::sqrt(squares / static_cast<double>(scale.size()));
  }
  for (Index o = 0; o < scale.size(); ++o) {
    auto own = values.middleCols(o * n_others, n_others);
    scale[o] = own.norm() / std::sqrt(static_cast<double>(own.size()));
    own /= scale[o];
  }
  return {values, scale};
}

/// Even orders, as far as the lines and the size of the companion matrix carry them.
std::vector<int> response_orders(const IdentifyOptions& options, Index lines, Index n_others) {
  const Index most = 2 * std::min(lines / kLinesOfAPower - 1, std::max<Index>(kLargestModel / n_others, 10));
  std::vector<int> orders = options.orders();
  std::erase_if(orders, [&](int order) { return order % 2 != 0 || order > most; });
  if (orders.empty())
    throw InputError({"", 0, "minimum_order"},
                     fmt::format("and maximum_order leave no even order from 2 to {}, the largest of {} lines", most, lines),
                     "lower minimum_order, or raise the number of lines");
  return orders;
}

/// How badly the functions determine a mode; up to 1 they do. The frequency must be known to a share of the half bandwidth, the
/// damping ratio must exceed what the largest of as many samples of noise reaches (Donoho and Johnstone 1994), and the
/// half-power band must lie within the lines.
double badness_of(const Cluster& mode, const ModeDeviation& deviation, const IdentifyOptions& options, Index lines) {
  const double half_Hz = mode.damping_ratio * mode.frequency_Hz, share = std::max(options.largest_bandwidth_share, 1e-3);
  const double largest = std::sqrt(2.0 * std::log(static_cast<double>(lines)));
  const double badness =
      std::max(deviation.frequency_Hz / (share * half_Hz), largest * deviation.damping_ratio / mode.damping_ratio);
  const bool inside =
      mode.frequency_Hz - half_Hz >= options.limits.lowest_Hz && mode.frequency_Hz + half_Hz <= options.limits.highest_Hz;
  const bool possible = inside && mode.damping_ratio > 0.0 && mode.damping_ratio <= options.limits.largest_damping;
  return possible && badness >= 0.0 ? badness : std::numeric_limits<double>::infinity();
}

/// Puts the fitted modes into the found ones. @return the position of the mode that is determined worst, -1 if all are
/// determined
Index take_fit(Identification& found, const std::vector<FittedMode>& fitted, const IdentifyOptions& options, Index lines) {
  Index worst = -1;
  double largest = 1.0;
  found.deviations.clear();
  for (std::size_t m = 0; m < fitted.size(); ++m) {
    Cluster& mode = found.modes[m];
    const double size = std::abs(fitted[m].eigenvalue);
    mode.frequency_Hz = size / (2.0 * std::numbers::pi);
    mode.damping_ratio = -fitted[m].eigenvalue.real() / size;
    mode.shape = fitted[m].shape;
    found.deviations.push_back(fitted[m].deviation);
    const double badness = badness_of(mode, fitted[m].deviation, options, lines);
    if (badness <= largest) continue;
    largest = badness;
    worst = static_cast<Index>(m);
  }
  return worst;
}

}  // namespace

Conditioned condition_responses(const records::Campaign& campaign, const records::RecordGroup& group,
                                const IdentificationSettings& config) {
  records::RecordGroup used = group;
  std::vector<std::string> known;
  for (records::CampaignRecord& record : used.records) {
    known.insert(known.end(), record.channels.begin(), record.channels.end());
    for (std::ptrdiff_t c = std::ssize(record.channels); c-- > 0;) {
      if (!contains(config.exclude, record.channels[static_cast<std::size_t>(c)])) continue;
      record.channels.erase(record.channels.begin() + c);
      if (!record.columns.empty()) record.columns.erase(record.columns.begin() + c);
    }
  }
  require_known(config.exclude, known, "exclude");
  std::erase_if(used.records, [](const records::CampaignRecord& record) { return record.channels.empty(); });
  if (used.records.empty()) throw InputError({"", 0, "exclude"}, "leaves no channel", "leave out fewer");
  Conditioned conditioned;
  conditioned.setup = group.setup;
  conditioned.condition = group.condition;
  conditioned.responses = records::read_frequency_responses(campaign, used);
  cut_to_band(conditioned.responses, config, used.records.front().file.string());
  for (const std::string& name : conditioned.responses.channels) {
    conditioned.channels.push_back(campaign.channel(name));
    conditioned.channels.back().quantity = conditioned.responses.quantity;  // the functions were converted to it
  }
  choose_references(conditioned, config.references);
  conditioned.notes = conditioned.responses.notes;
  for (const records::CampaignRecord& record : used.records)
    conditioned.files.push_back(record.file.lexically_relative(campaign.folder).generic_string());
  return conditioned;
}

Identification identify_responses(const Conditioned& conditioned, const IdentificationSettings& config) {
  const FrequencyResponses& responses = conditioned.responses;
  const Index lines = responses.frequency_Hz.size(), n_others = std::ssize(responses.others);
  const double first_Hz = responses.frequency_Hz[0], last_Hz = responses.frequency_Hz[lines - 1];
  IdentificationSettings own = config;
  own.lowest_Hz = own.highest_Hz = 0.0;
  if (own.order_is_default) {
    own.maximum_order = std::max(kLargestOrder, own.minimum_order);
    own.order_step *= 2;
  }
  IdentifyOptions options = own.options(4.0 * last_Hz, conditioned.channels);
  options.limits.lowest_Hz = first_Hz;
  options.limits.highest_Hz = last_Hz;
  const auto [values, scale] = scaled_functions(responses);
  const ResponseData data{responses.frequency_Hz, values, n_others, derivative(responses.quantity)};
  const std::vector<int> orders = response_orders(options, lines, n_others);
  Identification found = modes_of_poles(plscf_poles(data.frequency_Hz, data.values, n_others, orders), orders, options);
  while (!found.modes.empty()) {
    const auto pole_of = [](const Cluster& mode) { return eigenvalue_of(mode.frequency_Hz, mode.damping_ratio); };
    const Index worst = take_fit(found, fit_modes(data, each_of(found.modes, pole_of)), options, lines);
    keep_modes_where(found, [&](std::size_t m) { return static_cast<Index>(m) != worst; });
    if (worst < 0) break;
  }
  drop_undetermined(found, options, 0.0);
  to_physical_shapes(found, conditioned.channels, scale);
  return found;
}

Eigen::VectorXd response_scale(const FrequencyResponses& responses) { return scaled_functions(responses).scale; }

SingularSpectra response_spectra(const FrequencyResponses& responses) {
  const Eigen::VectorXd& f = responses.frequency_Hz;
  const Index n = f.size(), n_channels = std::ssize(responses.channels), n_others = std::ssize(responses.others);
  constexpr double even = 1e-3;  // of the distance between two lines
  const Eigen::VectorXd step = f.tail(n - 1) - f.head(n - 1);
  if (step.maxCoeff() - step.minCoeff() > even * step.mean()) return {};
  const Eigen::MatrixXcd values = scaled_functions(responses).values;
  SingularSpectra spectra{f, Eigen::MatrixXd(n, std::min<Index>({3, n_channels, n_others})), Eigen::MatrixXcd(n_channels, n)};
  for (Index k = 0; k < n; ++k) {
    const Eigen::VectorXcd line = values.row(k);
    const Eigen::MatrixXcd h = Eigen::Map<const Eigen::MatrixXcd>(line.data(), n_others, n_channels).transpose();
    const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(h, Eigen::ComputeThinU);
    spectra.values.row(k) = svd.singularValues().head(spectra.values.cols()).cwiseAbs2();
    spectra.first_vectors.col(k) = svd.matrixU().col(0);
  }
  return spectra;
}

}  // namespace twindeck::identification
