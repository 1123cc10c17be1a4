#include "steps/diagnosis/compared_frequencies.hpp"

#include <fmt/format.h>

#include <cmath>
#include <complex>

#include "steps/measured/measured_input.hpp"

namespace twindeck::steps {
namespace {

/// [-] (n_channels × n_modes) computed modes along the channels; zero for a mode without motion there.
Eigen::MatrixXcd computed_at_channels(const diagnosis::ReducedModel& reduced) {
  const Eigen::MatrixXd values = reduced.sensors.leftCols(reduced.mode_coordinates.rows()) * reduced.mode_coordinates;
  Eigen::MatrixXd along = values(Eigen::seq(0, Eigen::last, Eigen::fix<4>), Eigen::all);  // then x, y, z of each channel's node
  for (Eigen::Index i = 0; i < along.cols(); ++i)
    if (along.col(i).norm() < unseen * values.col(i).norm()) along.col(i).setZero();
  return along.cast<std::complex<double>>();
}

}  // namespace

std::vector<dynamics::MeasuredFrequencies> frequencies_of(const diagnosis::FeatureSet& features,
                                                          const diagnosis::ReducedModel* reduced,
                                                          const std::map<std::string, int>& bound) {
  std::vector<dynamics::MeasuredFrequencies> conditions;
  for (std::size_t c = 0; c < features.conditions.size(); ++c) {
    std::map<std::string, std::pair<double, Eigen::VectorXcd>> modes;  // frequency and shape by name
    const auto none = Eigen::VectorXcd::Constant(std::ssize(features.channels), matching::kUnknown);
    const auto of_condition = [&](const diagnosis::Row& row) { return row.condition == static_cast<int>(c); };
    for (const diagnosis::Row& row : features.rows)
      if (of_condition(row) && row.type == diagnosis::RowType::frequency) modes[row.mode] = {row.value, none};
    for (const diagnosis::Row& row : features.rows) {
      const bool real = row.type == diagnosis::RowType::shape, imaginary = row.type == diagnosis::RowType::shape_imag;
      if (!of_condition(row) || (!real && !imaginary) || !modes.contains(row.mode)) continue;
      std::complex<double>& value = modes.at(row.mode).second[row.channel];
      if (std::isnan(value.real())) value = 0.0;
      value += real ? std::complex<double>(row.value, 0.0) : std::complex<double>(0.0, row.value);
    }
    if (modes.empty()) continue;
    dynamics::MeasuredFrequencies& found = conditions.emplace_back();
    found.frequency_Hz.resize(std::ssize(modes));
    std::vector<std::pair<Eigen::Index, Eigen::Index>> given;  // measured and computed mode
    Eigen::MatrixXcd shapes(std::ssize(features.channels), std::ssize(modes));
    for (const auto& [name, mode] : modes) {
      const auto i = std::ssize(found.names);
      found.names.push_back(fmt::format("{} of {}", name, features.conditions[c].name));
      found.frequency_Hz[i] = mode.first;
      shapes.col(i) = mode.second;
      if (const auto at = bound.find(name); at != bound.end()) given.emplace_back(i, at->second);
    }
    if (reduced == nullptr) continue;
    found.mac = mac_for_units(computed_at_channels(*reduced), shapes);
    for (const auto& [i, mode] : given) {
      found.mac.col(i).setZero();
      found.mac(mode, i) = 1.0;
    }
  }
  return conditions;
}

}  // namespace twindeck::steps
