#include "matching/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "matching/shapes_at_sensors.hpp"
#include "modal/mac.hpp"

namespace twindeck::matching {

namespace {

using Eigen::Index;

const std::string& label(const Measured& measured, Index i) { return measured.labels[static_cast<std::size_t>(i)]; }

void sort_by_measured(std::vector<ModePair>& pairs) {
  std::ranges::sort(pairs, [](const auto& a, const auto& b) { return a.experimental < b.experimental; });
}

}  // namespace

Pairing pair_by_order(const Measured& measured, Index n_numerical, const std::vector<bool>& keep) {
  Pairing pairing;
  pairing.method = "order";
  const std::vector<Index> order = lowest_first(measured.modes.frequency_Hz);
  for (Index j = 0; j < std::min(measured.modes.size(), n_numerical); ++j) {
    const Index i = order[static_cast<std::size_t>(j)];
    if (keep.empty() || keep[static_cast<std::size_t>(i)]) pairing.pairs.push_back({i, j, kUnknown, false});
  }
  sort_by_measured(pairing.pairs);
  return pairing;
}

Pairing pair_as_published(const Measured& measured, Index n_numerical, const std::vector<std::string>& published,
                          const Place& place) {
  Pairing pairing;
  pairing.method = "published";
  for (const NamedPair& pair : matching::read_pairs(published, n_numerical, place, "raise n_modes")) {
    const auto at = std::ranges::find(measured.labels, pair.experimental);
    if (at != measured.labels.end())
      pairing.pairs.push_back({static_cast<Index>(at - measured.labels.begin()), pair.numerical, kUnknown, false});
    else
      pairing.unmeasured.push_back(pair.experimental);
  }
  sort_by_measured(pairing.pairs);
  return pairing;
}

void check_pairing(const Measured& measured, const dynamics::ReadModel& model, const std::vector<std::string>& published,
                   const Place& place, long n_modes, double sensor_tolerance_m) {
  if (measured.modes.has_shapes()) return refuse_unplaced_channels(measured, model, sensor_tolerance_m);
  static_cast<void>(pair_as_published(measured, n_modes, published, place));
}

void warn_of_unmeasured(Reporter& reporter, const Pairing& pairing) {
  if (pairing.unmeasured.empty()) return;
  reporter.warn(fmt::format("pairs: {} {} not among the measured modes and {} passed over", fmt::join(pairing.unmeasured, ", "),
                            pairing.unmeasured.size() == 1 ? "is" : "are", pairing.unmeasured.size() == 1 ? "is" : "are"));
}

Pairing pair_at_sensors(const Measured& measured, const dynamics::LoadedModel& model, const dynamics::EigenModes& modes,
                        const PairingOptions& options, double sensor_tolerance_m) {
  if (!measured.modes.has_shapes())
    throw InputError({measured.source, 0, "shape"}, "holds no measured shape, so that modes can't be paired by MAC",
                     "give shapes, or pairs");
  const Eigen::MatrixXcd phi_n = shapes_at_sensors(measured, model, modes, sensor_tolerance_m);
  // A mode without motion at the sensors has no MAC. It can have no partner and takes part with zeros.
  std::vector<Index> moving;
  for (Index j = 0; j < phi_n.cols(); ++j)
    if (phi_n.col(j).norm() > 1e-9 * modes.shapes.col(j).cwiseAbs().maxCoeff()) moving.push_back(j);
  Pairing pairing;
  pairing.method = "mac";
  pairing.shapes = phi_n;
  pairing.mac = Eigen::MatrixXd::Zero(phi_n.cols(), measured.modes.size());
  const Eigen::MatrixXcd phi_moving = phi_n(Eigen::all, moving);
  const Eigen::VectorXd frequency_moving = modes.frequency_Hz(moving);
  pairing.mac(moving, Eigen::all) = modal::mac_where_measured(phi_moving, measured.modes.shapes);
  for (Index i = 0; i < pairing.mac.cols(); ++i)
    if (!has_a_shape(measured.modes.shapes.col(i))) pairing.mac.col(i).setConstant(kUnknown);
  const Eigen::VectorXd& f_x = measured.modes.frequency_Hz;
  const Likeness like = matching::likeness_of(f_x, measured.modes.shapes, frequency_moving, phi_moving, options);
  pairing.likeness = pairing.mac;
  pairing.likeness(moving, Eigen::all) = like.value.transpose();
  pairing.pairs = matching::pair_by_likeness(f_x, frequency_moving, like, options);
  for (ModePair& pair : pairing.pairs) pair.numerical = moving[static_cast<std::size_t>(pair.numerical)];
  return pairing;
}

std::vector<ComparisonRow> compare(const std::string& stage, const Measured& measured, const Eigen::VectorXd& computed_Hz,
                                   const Pairing& pairing) {
  std::vector<ComparisonRow> rows;
  for (const ModePair& pair : pairing.pairs)
    rows.push_back({stage, label(measured, pair.experimental), numerical_label(pair.numerical),
                    measured.modes.frequency_Hz[pair.experimental], computed_Hz[pair.numerical], known(pair.mac),
                    pairing.method});
  return rows;
}

double mean_abs_error_pct(const std::vector<ComparisonRow>& rows, const std::string& stage) {
  double sum = 0.0;
  int count = 0;
  for (const ComparisonRow& row : rows) {
    if (row.stage != stage) continue;
    sum += std::abs(row.error_pct());
    ++count;
  }
  return count == 0 ? kUnknown : sum / count;
}

}  // namespace twindeck::matching
