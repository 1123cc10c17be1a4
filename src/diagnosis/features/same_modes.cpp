#include "diagnosis/features/same_modes.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>

#include "matching/pairing.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
constexpr double kLeastMac = 0.5, kFarthestOfAlike = 1.5;

/// Modes of a condition: names, frequencies, shapes over all channels (zero where not measured).
struct Listed {
  std::vector<std::string> names;
  std::vector<double> hertz;
  Eigen::MatrixXcd shapes;
};

std::vector<Listed> list_modes(const FeatureSet& features) {
  std::vector<Listed> lists(features.conditions.size());
  std::vector<std::map<std::string, Index>> at(lists.size());
  const auto n = static_cast<Index>(features.channels.size());
  for (const Row& row : features.rows) {
    if (row.type != RowType::frequency) continue;
    Listed& list = lists[static_cast<std::size_t>(row.condition)];
    at[static_cast<std::size_t>(row.condition)][row.mode] = static_cast<Index>(list.names.size());
    list.names.push_back(row.mode);
    list.hertz.push_back(row.value);
  }
  for (Listed& list : lists) list.shapes = Eigen::MatrixXcd::Zero(n, static_cast<Index>(list.names.size()));
  for (const Row& row : features.rows) {
    if (row.type != RowType::shape && row.type != RowType::shape_imag) continue;
    const auto c = static_cast<std::size_t>(row.condition);
    const auto mode = at[c].find(row.mode);
    if (mode == at[c].end()) continue;
    lists[c].shapes(row.channel, mode->second) +=
        row.type == RowType::shape ? std::complex<double>(row.value, 0.0) : std::complex<double>(0.0, row.value);
  }
  return lists;
}

/// MAC over the channels that both shapes have.
double alike(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) {
  std::complex<double> product = 0.0;
  double aa = 0.0, bb = 0.0;
  for (Index i = 0; i < a.size(); ++i) {
    if (a[i] == 0.0 || b[i] == 0.0) continue;
    product += std::conj(a[i]) * b[i];
    aa += std::norm(a[i]);
    bb += std::norm(b[i]);
  }
  return aa > 0.0 && bb > 0.0 ? std::norm(product) / (aa * bb) : 0.0;
}

}  // namespace

std::vector<int> same_modes(const Eigen::VectorXd& reference_Hz, const Eigen::MatrixXcd& reference,
                            const Eigen::VectorXd& other_Hz, const Eigen::MatrixXcd& other) {
  const Index n = reference_Hz.size(), m = other_Hz.size();
  if (n == 0 || m == 0) return std::vector<int>(static_cast<std::size_t>(m), -1);
  Eigen::MatrixXd gain(m, n), mac(m, n);
  for (Index i = 0; i < m; ++i)
    for (Index j = 0; j < n; ++j) {
      mac(i, j) = alike(reference.col(j), other.col(i));
      gain(i, j) = mac(i, j) - std::abs(std::log(other_Hz[i] / reference_Hz[j]));
    }
  std::vector<int> chosen = matching::best_assignment(gain);
  for (Index i = 0; i < m; ++i) {
    int& j = chosen[static_cast<std::size_t>(i)];
    if (j >= 0 && (mac(i, j) < kLeastMac || std::abs(std::log(other_Hz[i] / reference_Hz[j])) > std::log(kFarthestOfAlike)))
      j = -1;
  }
  return chosen;
}

void name_modes_alike(FeatureSet& features) {
  const std::vector<Listed> lists = list_modes(features);
  const auto shaped = [](const Listed& list) {
    Index count = 0;
    for (Index m = 0; m < list.shapes.cols(); ++m) count += list.shapes.col(m).squaredNorm() > 0.0;
    return count;
  };
  const auto reference =
      std::max_element(lists.begin(), lists.end(), [&](const Listed& a, const Listed& b) { return shaped(a) < shaped(b); });
  if (reference == lists.end()) return;
  const auto hertz = [](const Listed& list) {
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(list.hertz.data(), static_cast<Index>(list.hertz.size())));
  };
  for (std::size_t c = 0; c < lists.size(); ++c) {
    if (&lists[c] == &*reference || shaped(lists[c]) == 0) continue;
    const std::vector<int> same = same_modes(hertz(*reference), reference->shapes, hertz(lists[c]), lists[c].shapes);
    std::map<std::string, std::string> renamed;
    for (std::size_t m = 0; m < same.size(); ++m)
      renamed[lists[c].names[m]] = same[m] >= 0 ? reference->names[static_cast<std::size_t>(same[m])]
                                                : features.conditions[c].name + " " + lists[c].names[m];
    for (Row& row : features.rows)
      if (row.condition == static_cast<int>(c) && row.type != RowType::stay_frequency)
        if (const auto name = renamed.find(row.mode); name != renamed.end()) row.mode = name->second;
  }
}

}  // namespace twindeck::diagnosis
