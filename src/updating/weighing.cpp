#include "updating/weighing.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "matching/shapes_at_sensors.hpp"

namespace twindeck::updating {

namespace {

using Eigen::Index;

/// Position of each measured mode among the pairs; -1 for an unpaired one.
std::vector<int> target_of_mode(const matching::Measured& measured, const matching::Pairing& pairing) {
  std::vector<int> target(static_cast<std::size_t>(measured.modes.size()), -1);
  for (std::size_t t = 0; t < pairing.pairs.size(); ++t)
    target[static_cast<std::size_t>(pairing.pairs[t].experimental)] = static_cast<int>(t);
  return target;
}

/// A computed mode with its cluster: modes whose neighbours in frequency are closer than the gap (as in matching/pairing).
std::vector<int> close_modes(const Eigen::VectorXd& frequency_Hz, Index mode, double gap) {
  const auto close = [&](Index upper) { return frequency_Hz[upper] - frequency_Hz[upper - 1] < gap * frequency_Hz[upper]; };
  std::vector<int> span = {static_cast<int>(mode)};
  for (Index i = mode; i > 0 && close(i); --i) span.push_back(static_cast<int>(i - 1));
  for (Index i = mode + 1; i < frequency_Hz.size() && close(i); ++i) span.push_back(static_cast<int>(i));
  return span;
}

double largest_component(const matching::Measured& measured, Index mode) {
  double largest = 0.0;
  for (const std::complex<double> value : measured.modes.shapes.col(mode))
    if (!std::isnan(value.real())) largest = std::max(largest, std::abs(value));
  return largest;
}

}  // namespace

void refuse_unweighable_shapes(const matching::Measured& measured) {
  if (!measured.modes.has_shapes())
    throw InputError({measured.source, 0, "shape"}, "holds no measured shape, which `residuals` asks for",
                     "give shapes in rows.csv, or residuals = [\"frequency\"]");
  if (std::ranges::none_of(measured.rows, [](const matching::MeasuredRow& row) { return row.dof >= 0; }))
    throw InputError({measured.source, 0, "shapes.csv"}, "has no standard deviations, so that shapes can't be weighed",
                     "give the modes as a features folder (--features), whose rows.csv has them");
}

MeasuredRows weighed_rows(const UpdatingSettings& config, const matching::Measured& measured, const matching::Pairing& pairing,
                          const dynamics::LoadedModel& loaded, const dynamics::EigenModes& modes) {
  MeasuredRows rows;
  if (!config.weighs()) return rows;
  const std::vector<int> target = target_of_mode(measured, pairing);
  std::vector<Index> taken(pairing.pairs.size());
  std::vector<double> own_error(taken.size());  // of the model, in the unit of the row
  for (std::size_t r = 0; r < measured.rows.size(); ++r) {
    const matching::MeasuredRow& row = measured.rows[r];
    const int t = target[static_cast<std::size_t>(row.mode)];
    if (t < 0) continue;
    if (row.dof < 0) {
      taken[static_cast<std::size_t>(t)] = static_cast<Index>(r);
      own_error[static_cast<std::size_t>(t)] = config.frequency_model_error * row.value;
    } else if (config.weighs_shapes()) {
      rows.shape.push_back({t, static_cast<int>(row.dof), row.imaginary, row.value});
      taken.push_back(static_cast<Index>(r));
      own_error.push_back(config.shape_model_error * largest_component(measured, row.mode));
    }
  }
  if (config.weighs_shapes()) {
    rows.channels = matching::sensor_vectors(measured, loaded, config.sensor_tolerance_m);
    for (const matching::ModePair& pair : pairing.pairs)
      rows.span.push_back(close_modes(modes.frequency_Hz, pair.numerical, config.cluster_gap));
  }
  rows.covariance = measured.covariance(taken, taken);
  for (std::size_t i = 0; i < own_error.size(); ++i)
    rows.covariance(static_cast<Index>(i), static_cast<Index>(i)) += own_error[i] * own_error[i];
  return rows;
}

Eigen::VectorXd Weighed::normalised() const {
  Eigen::VectorXd x(result.scale.size());
  for (Index j = 0; j < x.size(); ++j) x[j] = result.theta(active[static_cast<std::size_t>(j)]) / result.scale[j];
  return x;
}

}  // namespace twindeck::updating
