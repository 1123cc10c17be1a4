#include "identification/merging_check.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "matching/pairing.hpp"

namespace twindeck::identification {

using Eigen::Index;

namespace {

constexpr double kSameMode = 0.02;        ///< [-] of the frequency: two mergings of the same records agree far better
constexpr double kSamePole = 0.005;       ///< [-] of the frequency: poles of single orders, that no selection has cleaned
constexpr std::size_t kFewestOrders = 3;  ///< [-] a pole that fewer orders have is none of the structure's

void set(MergingCheck& check, double frequency_Hz, double damping_ratio, const Eigen::VectorXcd& shape) {
  check.found = true;
  check.frequency_Hz = frequency_Hz;
  check.damping_ratio = damping_ratio;
  check.shape = shape;
}

/// A mode that PreGER's own selection lacks, from the poles of its frequency.
void set_nearest_poles(MergingCheck& check, const Identification& preger, const MergedMode& mode) {
  std::map<int, const Pole*> nearest;
  const auto off = [&](const Pole& pole) { return std::abs(pole.frequency_Hz - mode.frequency_Hz); };
  for (const DiagramPole& p : preger.diagram) {
    if (off(p.pole) > kSamePole * mode.frequency_Hz) continue;
    const auto [at, is_new] = nearest.try_emplace(p.pole.order, &p.pole);
    if (!is_new && off(p.pole) < off(*at->second)) at->second = &p.pole;
  }
  if (nearest.size() < kFewestOrders) return;
  std::vector<double> frequencies, dampings;
  const Pole* reference = nearest.rbegin()->second;
  Eigen::VectorXcd shape = Eigen::VectorXcd::Zero(reference->shape.size());
  for (const auto& [order, pole] : nearest) {
    frequencies.push_back(pole->frequency_Hz);
    dampings.push_back(pole->damping_ratio);
    shape += pole->shape * std::polar(1.0, std::arg(pole->shape.dot(reference->shape)));
  }
  std::sort(frequencies.begin(), frequencies.end());
  std::sort(dampings.begin(), dampings.end());
  set(check, frequencies[frequencies.size() / 2], dampings[dampings.size() / 2], shape);
}

}  // namespace

double known_mac(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) {
  std::complex<double> product = 0.0;
  double aa = 0.0, bb = 0.0;
  for (Index i = 0; i < a.size(); ++i) {
    if (std::isnan(a[i].real()) || std::isnan(b[i].real())) continue;
    product += std::conj(a[i]) * b[i];
    aa += std::norm(a[i]);
    bb += std::norm(b[i]);
  }
  return aa > 0.0 && bb > 0.0 ? std::norm(product) / (aa * bb) : 0.0;
}

std::vector<MergingCheck> merging_checks(const std::vector<MergedMode>& modes, const Identification& preger,
                                         const std::vector<records::CampaignChannel>& channels, const Eigen::VectorXd& scale) {
  Eigen::MatrixXd mac = Eigen::MatrixXd::Zero(std::ssize(modes), std::ssize(preger.modes));  // of the near ones
  for (Index i = 0; i < mac.rows(); ++i) {
    for (Index j = 0; j < mac.cols(); ++j) {
      const MergedMode& mode = modes[static_cast<std::size_t>(i)];
      const Cluster& other = preger.modes[static_cast<std::size_t>(j)];
      if (std::abs(other.frequency_Hz - mode.frequency_Hz) <= kSameMode * mode.frequency_Hz)
        mac(i, j) = known_mac(mode.shape, other.shape);
    }
  }
  const std::vector<int> partner = matching::follow_modes(mac);
  std::vector<MergingCheck> checks(modes.size());
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const auto row = static_cast<Index>(i);
    MergingCheck& check = checks[i];
    check.poser_frequency_Hz = modes[i].frequency_Hz;
    check.poser_damping_ratio = modes[i].damping_ratio;
    if (partner[i] >= 0 && mac(row, partner[i]) > 0.0) {
      const Cluster& other = preger.modes[static_cast<std::size_t>(partner[i])];
      set(check, other.frequency_Hz, other.damping_ratio, other.shape);
      check.mac = mac(row, partner[i]);
    } else if (mac.row(row).isZero(0.0)) {
      set_nearest_poles(check, preger, modes[i]);
      if (!check.found) continue;
      check.shape = physical_shape(check.shape, channels, scale, check.frequency_Hz, check.damping_ratio);
      check.mac = known_mac(modes[i].shape, check.shape);
    }
  }
  return checks;
}

void take_preger(MergedMode& mode, const MergingCheck& check) {
  if (!check.found) return;
  const Eigen::Array<bool, Eigen::Dynamic, 1> unknown = mode.shape.real().array().isNaN();
  const Eigen::VectorXcd zero = Eigen::VectorXcd::Zero(mode.shape.size());
  const Eigen::VectorXcd before = unknown.select(zero.array(), mode.shape.array());
  const Eigen::VectorXcd after = normalised_shape(unknown.select(zero.array(), check.shape.array()));
  // Either is as real as it can be, but its sign follows its largest entry.
  const Eigen::VectorXcd shift = after - before * std::polar(1.0, std::arg(before.dot(after)));
  ModeDeviation& deviation = mode.deviation;
  deviation.frequency_Hz = std::hypot(deviation.frequency_Hz, check.frequency_Hz - mode.frequency_Hz);
  deviation.damping_ratio = std::hypot(deviation.damping_ratio, check.damping_ratio - mode.damping_ratio);
  for (Index i = 0; i < shift.size(); ++i) {
    if (unknown[i]) continue;
    deviation.shape_real[i] = std::hypot(deviation.shape_real[i], shift[i].real());
    deviation.shape_imag[i] = std::hypot(deviation.shape_imag[i], shift[i].imag());
    mode.shape[i] = after[i];
  }
  mode.frequency_Hz = check.frequency_Hz;
  mode.damping_ratio = check.damping_ratio;
}

}  // namespace twindeck::identification
