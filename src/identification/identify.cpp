#include "identification/identify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "identification/era.hpp"
#include "identification/ssi_cov.hpp"
#include "identification/ssi_data.hpp"

namespace twindeck::identification {

namespace {

/// [-] A deviation within this many times the lower limit for the record's length does not speak against a mode. In a record of
/// few cycles all modes have such deviations, and deviations from few blocks are uncertain by a third.
constexpr double kNearLaw = 3.0;

/// Standard deviation of a unit-norm shape, without the part along the shape itself, whose scale and phase are free. 0 if the
/// covariance is unknown.
double shape_deviation(const Cluster& mode, const ModeDeviation& deviation) {
  const Eigen::Index n = mode.shape.size();
  if (deviation.factor.rows() < 2 + 2 * n) return 0.0;
  const Eigen::VectorXcd along = mode.shape.normalized();
  Eigen::MatrixXcd changes(n, deviation.factor.cols());
  changes.real() = deviation.factor.middleRows(2, n);
  changes.imag() = deviation.factor.middleRows(2 + n, n);
  changes -= along * (along.adjoint() * changes);
  return changes.norm();
}

/// Whether the forces are random and stationary, as the lower limit of the deviation assumes.
bool is_stationary(const IdentifyOptions& options, double seconds) { return seconds > 0.0 && options.largest_law_ratio > 0.0; }

/// Whether the phases of a shape are arbitrary and may be so by its uncertainty. A real shape with the deviation s has on
/// average s²/2 of its energy out of phase; 98 % of shapes have at most four times as much. A collinearity c means the share (1
/// - sqrt(c))/2. A larger share belongs to the structure, as with dampers.
bool has_arbitrary_phases(const Cluster& mode, const ModeDeviation& deviation, const AutomaticRule& rule) {
  constexpr double kChance = 4.0;
  // Part of the least collinearity. Just below that limit are modes of bridges with dampers, which some records determine well
  // and others badly.
  constexpr double kBelow = 0.8;
  if (phase_collinearity(one_quantity(mode.shape, rule.derivatives)) >= kBelow * rule.collinearity) return false;
  const double out_of_phase = (1.0 - std::sqrt(rule.collinearity)) / 2.0;
  return kChance * std::pow(shape_deviation(mode, deviation), 2) / 2.0 > out_of_phase;
}

bool is_settled(const Cluster& mode, const ModeDeviation& deviation, const IdentifyOptions& options, double seconds) {
  const double f = mode.frequency_Hz, zeta = std::max(mode.damping_ratio, 1e-6), relative = deviation.frequency_Hz / f;
  if (options.selection == Selection::paper) return options.largest_deviation <= 0.0 || relative <= options.largest_deviation;
  const double share = options.largest_bandwidth_share;
  // A decay whose damping may be zero is not accepted: noise has such poles, by chance with a small deviation of frequency.
  if (seconds <= 0.0) return share <= 0.0 || (deviation.frequency_Hz <= share * zeta * f && deviation.damping_ratio <= zeta);
  if (options.largest_law_ratio <= 0.0) return true;
  // The lower limit relative to the half bandwidth equals that of the damping ratio relative to itself.
  const double law = std::sqrt(1.0 / (2.0 * std::numbers::pi * f * zeta * seconds)), short_record = kNearLaw * law;
  const double frequency = relative / zeta, damping = deviation.damping_ratio / zeta;
  if (options.largest_deviation > 0.0 && relative > std::max(options.largest_deviation, short_record * zeta)) return false;
  if (options.largest_shape_deviation > 0.0 && shape_deviation(mode, deviation) > options.largest_shape_deviation) return false;
  if (has_arbitrary_phases(mode, deviation, options.automatic)) return false;
  return frequency <= options.largest_law_ratio * law && (share <= 0.0 || frequency <= std::max(share, short_record)) &&
         damping <= std::max(1.0, short_record);
}

/// Whether a mode cannot be distinguished from another one with a smaller deviation: frequencies within three standard
/// deviations, and shapes as near as two estimates of one shape. To first order, their 1 - MAC has the mean s1² + s2², with the
/// deviations s of the shapes.
bool is_shadow(const Identification& found, std::size_t m, bool stationary) {
  constexpr double kShapeFloor = 0.02;  // of 1 - MAC: errors that are not in deviations from few blocks and one order
  constexpr double kDecayFloor = 0.2;   // the same for decays and earthquakes, where modes also change with amplitude
  const double floor = stationary ? kShapeFloor : kDecayFloor;
  for (std::size_t k = 0; k < found.modes.size(); ++k) {
    const ModeDeviation &mine = found.deviations[m], &other = found.deviations[k];
    if (other.frequency_Hz >= mine.frequency_Hz) continue;
    const double apart = std::abs(found.modes[k].frequency_Hz - found.modes[m].frequency_Hz);
    if (apart > 3.0 * std::hypot(other.frequency_Hz, mine.frequency_Hz)) continue;
    const double shapes = std::hypot(shape_deviation(found.modes[k], other), shape_deviation(found.modes[m], mine));
    if (1.0 - std::norm(found.modes[k].shape.dot(found.modes[m].shape)) <= std::max(floor, shapes * shapes)) return true;
  }
  return false;
}

/// Checks modes that have lost poles once more for mixtures, which the lost poles may have hidden. Only modes that the records
/// determine count as parts of a mixture.
void drop_hidden_mixtures(Identification& result, const AutomaticRule& rule) {
  const std::vector<bool> is_part = mixtures(result.diagram, result.modes, rule, 0.0);
  keep_modes_where(result, [&](std::size_t m) {
    const auto marked =
        std::ranges::count_if(result.diagram, [&](const DiagramPole& pole) { return pole.mode == static_cast<int>(m); });
    return !is_part[m] || static_cast<std::size_t>(marked) <= result.modes[m].members.size();
  });
}

Identification select(const ShiftModels& models, const IdentifyOptions& options) {
  Identification result = modes_of_poles(poles_of(models), options.orders(), options);
  result.periodic = undamped_poles(poles_of(models), options.limits.lowest_Hz, options.limits.highest_Hz, options.periodic);
  return result;
}

/// Whether the pole has a twin: another pole of its order with the same shape and, by the data, the same frequency. Then the
/// order has one pole too many, and the mode is split in two halves.
bool has_twin(const Identification& result, const ShiftModels& models, const PoleFactors& factors, std::size_t i) {
  constexpr double kStableShape = 0.95;  // MAC of a stable shape, paper section 3.1
  constexpr double kChance = 3.0;        // [standard deviations] of the difference
  const Pole& pole = result.diagram[i].pole;
  return std::ranges::any_of(result.diagram, [&](const DiagramPole& other) {
    const Pole& twin = other.pole;
    return twin.order == pole.order && &twin != &pole && std::norm(twin.shape.dot(pole.shape)) >= kStableShape &&
           std::abs(twin.frequency_Hz - pole.frequency_Hz) <= kChance * difference_deviation(models, factors, twin, pole);
  });
}

/// Twice the lower quartile of the deviations. Poles with larger ones are dropped from their mode.
double largest_well_known(std::vector<double> deviations) {
  std::ranges::sort(deviations);
  return 2.0 * deviations[deviations.size() / 4];
}

/// Keeps the members of each mode that are known well. At an order where the pole has split in two, both halves have large
/// deviations and are dropped. If most orders are split, the quartile itself is that of halves; then the orders with an unsplit
/// pole count. This may be a single order, if the mode appears at the last order only. It does not hold for free decays: their
/// deviations are too small, and only the scatter over the orders shows the true ones.
void keep_well_known(Identification& result, const ShiftModels& models, const PoleFactors& factors, bool stationary) {
  for (Cluster& mode : result.modes) {
    std::vector<double> deviations, whole;
    for (const std::size_t i : mode.members) {
      deviations.push_back(frequency_deviation(models, factors, result.diagram[i].pole));
      if (!has_twin(result, models, factors, i)) whole.push_back(deviations.back());
    }
    const auto well_known = [&](double most) {
      std::vector<std::size_t> kept;
      for (std::size_t k = 0; k < deviations.size(); ++k)
        if (deviations[k] <= most) kept.push_back(mode.members[k]);
      return kept;
    };
    std::vector<std::size_t> kept = well_known(largest_well_known(deviations));
    const double most_of_whole = whole.empty() ? 0.0 : largest_well_known(whole);
    if (stationary && !whole.empty() && 2.0 * most_of_whole < largest_well_known(deviations)) kept = well_known(most_of_whole);
    mode = summarise(result.diagram, std::move(kept));
  }
}

/// Adds the scatter over the orders to the deviations. The covariance holds for the pole of one order only. If a pole is mixed
/// with a weak neighbour within the bandwidth, it changes with the order by more than its covariance.
void add_order_scatter(Identification& result) {
  for (std::size_t m = 0; m < result.modes.size(); ++m) {
    ModeDeviation& deviation = result.deviations[m];
    deviation.frequency_Hz = std::hypot(deviation.frequency_Hz, result.modes[m].frequency_scatter_Hz);
    deviation.damping_ratio = std::hypot(deviation.damping_ratio, result.modes[m].damping_ratio_scatter);
  }
}

void add_deviations(Identification& result, const Observability& observability, const ShiftModels& models,
                    const Changes& changes, const IdentifyOptions& options, double seconds) {
  const PoleFactors factors = pole_factors(observability, models, changes);
  for (DiagramPole& pole : result.diagram) pole.frequency_std_Hz = frequency_deviation(models, factors, pole.pole);
  if (options.selection == Selection::automatic) keep_well_known(result, models, factors, is_stationary(options, seconds));
  std::vector<std::vector<Pole>> members;
  for (const Cluster& mode : result.modes) {
    members.emplace_back();
    for (const std::size_t i : mode.members) members.back().push_back(result.diagram[i].pole);
  }
  result.deviations = mode_deviations(models, factors, members);
  drop_undetermined(result, options, seconds);
  if (options.selection == Selection::automatic && is_stationary(options, seconds)) drop_better_than_random(result, seconds);
  add_order_scatter(result);
}

/// Drops the modes that are lines of periodic forces. Such a mode is no farther from a line than the scatter of the line's
/// poles or two standard deviations, and its damping ratio is at most two standard deviations above that of a removed line.
void drop_lines(Identification& result, const std::vector<PeriodicLine>& lines, const PeriodicRule& rule) {
  constexpr double kFew = 2.0;  // [standard deviations] a difference of this size is chance
  keep_modes_where(result, [&](std::size_t m) {
    const Cluster& mode = result.modes[m];
    const bool known = m < result.deviations.size();
    const double damping = known ? kFew * result.deviations[m].damping_ratio : 0.0;
    const double spread = rule.largest_spread * mode.frequency_Hz;
    const double reach = std::max(spread, known ? kFew * result.deviations[m].frequency_Hz : 0.0);
    if (mode.damping_ratio >= rule.largest_leftover + std::max(damping, rule.largest_damping)) return true;
    return std::ranges::none_of(
        lines, [&](const PeriodicLine& line) { return std::abs(line.frequency_Hz - mode.frequency_Hz) < reach; });
  });
}

}  // namespace

void keep_modes(Identification& result, const std::vector<bool>& stays) {
  const std::size_t n = result.modes.size();
  std::vector<int> renumbered(n, -1);
  std::size_t kept = 0;
  for (std::size_t m = 0; m < n; ++m) {
    if (!stays[m]) continue;
    renumbered[m] = static_cast<int>(kept);
    if (kept != m) {
      result.modes[kept] = result.modes[m];
      if (m < result.deviations.size()) result.deviations[kept] = result.deviations[m];
    }
    ++kept;
  }
  result.modes.resize(kept);
  result.deviations.resize(std::min(result.deviations.size(), kept));
  for (DiagramPole& pole : result.diagram)
    if (pole.mode >= 0) pole.mode = renumbered[static_cast<std::size_t>(pole.mode)];
}

void drop_undetermined(Identification& result, const IdentifyOptions& options, double seconds) {
  keep_modes_where(result, [&](std::size_t m) { return is_settled(result.modes[m], result.deviations[m], options, seconds); });
  if (options.selection != Selection::automatic) return;
  drop_hidden_mixtures(result, options.automatic);
  keep_modes_where(result, [&](std::size_t m) { return !is_shadow(result, m, is_stationary(options, seconds)); });
}

std::vector<std::string> drop_noise_of_a_decay(Identification& result, Eigen::Index samples) {
  const double largest = std::sqrt(2.0 * std::log(static_cast<double>(samples)));
  std::vector<std::string> dropped;
  keep_modes_where(result, [&](std::size_t m) {
    const double damping = result.modes[m].damping_ratio, deviation = result.deviations[m].damping_ratio;
    const bool stays = damping > largest * deviation;
    if (!stays)
      dropped.push_back(fmt::format("{:.4g} Hz (damping ratio {:.2g} % with a deviation of {:.2g} %)",
                                    result.modes[m].frequency_Hz, 100.0 * damping, 100.0 * deviation));
    return stays;
  });
  return dropped;
}

void drop_better_than_random(Identification& result, double seconds) {
  constexpr double kChance = 3.0;  // standard deviations of a deviation from n blocks, each 1/sqrt(2 (n - 1)) of it
  std::vector<bool> stays;
  for (std::size_t m = 0; m < result.modes.size(); ++m) {
    const Cluster& mode = result.modes[m];
    const double law = std::sqrt(mode.damping_ratio * mode.frequency_Hz / (2.0 * std::numbers::pi * seconds));
    const auto blocks = static_cast<double>(result.deviations[m].factor.cols());
    stays.push_back(blocks < 2.0 ||
                    result.deviations[m].frequency_Hz >= (1.0 - kChance / std::sqrt(2.0 * (blocks - 1.0))) * law);
  }
  const auto n_random = std::count(stays.begin(), stays.end(), true);
  if (2 * n_random > std::ssize(stays)) keep_modes(result, stays);
}

void mark_periodic(Identification& result, const std::vector<Samples>& records, double rate_Hz, const PeriodicRule& rule,
                   const std::vector<PeriodicLine>& known) {
  const auto is_known = [&](const PeriodicLine& line) {
    return std::ranges::any_of(known, [&](const PeriodicLine& other) {
      return std::abs(other.frequency_Hz - line.frequency_Hz) < rule.largest_spread * line.frequency_Hz;
    });
  };
  result.periodic = periodic_lines(result.periodic, records, rate_Hz, rule);
  std::erase_if(result.periodic, is_known);
  result.periodic.insert(result.periodic.end(), known.begin(), known.end());
  std::ranges::sort(result.periodic, {}, &PeriodicLine::frequency_Hz);
  drop_lines(result, result.periodic, rule);
}

void drop_lines_of_others(const std::vector<Identification*>& setups, const PeriodicRule& rule) {
  for (Identification* setup : setups)
    for (const Identification* other : setups)
      if (other != setup) drop_lines(*setup, other->periodic, rule);
}

std::vector<int> IdentifyOptions::orders() const {
  std::vector<int> list;
  for (long order = minimum_order; order <= maximum_order; order += order_step) list.push_back(static_cast<int>(order));
  TWINDECK_ASSERT(!list.empty());
  return list;
}

Identification modes_of_poles(const std::vector<std::vector<Pole>>& poles, const std::vector<int>& orders,
                              const IdentifyOptions& options) {
  Identification found;
  found.diagram = stabilisation_diagram(poles, options.criteria, options.limits);
  found.modes = options.selection == Selection::paper ? identify_clusters(found.diagram, orders, options.cleaning)
                                                      : automatic_clusters(found.diagram, orders, options.automatic);
  return found;
}

Identification identify(const signal::BlockCorrelations& blocks, double rate_Hz, const IdentifyOptions& options) {
  TWINDECK_ASSERT(blocks.n_lags >= 2 * options.block_rows);
  const std::vector<int> orders = options.orders();
  const Observability observability = ssi_cov(blocks.mean(), options.block_rows, blocks.n_outputs, orders.back());
  const ShiftModels models = shift_models(observability, orders, rate_Hz);
  Identification result = select(models, options);
  if (blocks.n_blocks() < 2) return result;
  add_deviations(result, observability, models, covariance_changes(blocks, options.block_rows, observability, models), options,
                 blocks.counts.row(0).sum() / rate_Hz);
  return result;
}

Identification identify_from_data(const std::vector<Samples>& records, const std::vector<Eigen::Index>& references,
                                  const signal::BlockCorrelations& blocks, double rate_Hz, const IdentifyOptions& options) {
  const std::vector<int> orders = options.orders();
  std::vector<Eigen::MatrixXd> grams;
  double samples = 0.0;
  for (const Samples& record : records) {
    grams.push_back(hankel_gram(record, references, options.block_rows));
    samples += static_cast<double>(record.rows() - 2 * options.block_rows + 1);
  }
  const DataDriven found = ssi_data(grams, samples, static_cast<Eigen::Index>(references.size()), records.front().cols(),
                                    options.block_rows, orders.back());
  grams.clear();
  const ShiftModels models = shift_models(found.observability, orders, rate_Hz);
  Identification result = select(models, options);
  if (blocks.n_blocks() < 2) return result;
  add_deviations(result, found.observability, models, data_changes(blocks, references, options.block_rows, found, models),
                 options, samples / rate_Hz);
  return result;
}

Identification identify_decays(const std::vector<Eigen::MatrixXd>& decays, double rate_Hz, const IdentifyOptions& options,
                               std::uint64_t seed, const std::vector<Eigen::MatrixXd>& quiet) {
  constexpr int kDraws = 100;  // draws, for deviations to within 7 %
  const FreeDecay found = era(decays, options.block_rows, options.orders(), rate_Hz, seed, kDraws, quiet);
  Identification result = select(found.models, options);
  add_deviations(result, found.observability, found.models, found.changes, options, 0.0);
  return result;
}

}  // namespace twindeck::identification
