#include "matching/reversed_channel.hpp"

#include <fmt/format.h>

#include "modal/mac.hpp"

namespace twindeck::matching {

namespace {

using Eigen::Index;

constexpr Index fewest_channels = 4;     ///< turning one of three is as good as turning the other two
constexpr double part_left = 1.0 / 3.0;  ///< [-] of 1 - MAC, that turning the right channel may leave: model errors and noise
constexpr double least_gain = 0.05;      ///< [-] of the mean MAC: less is within what models and noise do

}  // namespace

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
