#include "diagnosis/promising_ties.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kModesInTies = 16;  // products of two of them: 136, so that a pair costs 20,000 operations
constexpr double kCloseSquares =
    0.1;  // least relative gap of w² (5 % in frequency): closer modes turn, to first order without limit
constexpr std::size_t kRankedNodes = 64;  // 2,016 pairs: 0.04 s, whatever the number of nodes

/// Position of the product of modes i <= j.
Index product_of(Index i, Index j, Index modes) { return i * modes - i * (i - 1) / 2 + (j - i); }

/// Explained chi² of springs, by the products of the modes' motions along them.
class SpringScreen {
 public:
  SpringScreen(const Inference& inference, const Fit& base) : found_(inference.map().form_modes(base.base, base.causes)) {
    modes_ = std::min<Index>(kModesInTies, found_.modes.omega_rad_s.size());
    if (found_.paired.empty() || modes_ == 0) return;
    const MatrixXd whitened = linalg::lower_solve(base.total_factor, signatures(inference, base));
    along_ = whitened.transpose() * base.whitened;
    gram_ = linalg::product(whitened, whitened, true);
  }
  [[nodiscard]] bool empty() const { return along_.size() == 0; }
  /// Motion of each mode along each direction of a place (k × n_modes).
  [[nodiscard]] MatrixXd motion(const ReducedPlace& place) const {
    MatrixXd out(place.directions.cols(), modes_);
    for (Index d = 0; d < out.rows(); ++d)
      out.row(d) = place.directions.part(d, found_.columns).transpose() * found_.coordinates.leftCols(modes_);
    return out;
  }
  /// Products of the modes, summed over the springs. @param q (n_springs × n_modes)
  [[nodiscard]] VectorXd products(const MatrixXd& q) const {
    VectorXd out = VectorXd::Zero(along_.size());
    for (Index d = 0; d < q.rows(); ++d)
      for (Index i = 0; i < modes_; ++i)
        for (Index j = i; j < modes_; ++j) out[product_of(i, j, modes_)] += q(d, i) * q(d, j);
    return out;
  }
  /// Largest fall of chi² by springs of one positive stiffness.
  [[nodiscard]] double explained(const VectorXd& products) const {
    const double along = products.dot(along_), square = products.dot(gram_ * products);
    return along > 0.0 && square > 0.0 ? along * along / square : 0.0;
  }

 private:
  /// Change of the training rows by each product (n_train × n_products).
  [[nodiscard]] MatrixXd signatures(const Inference& inference, const Fit& base) const {
    std::map<int, Index> place;  // of a row among the training rows
    for (std::size_t r = 0; r < inference.training().size(); ++r) place[inference.training()[r]] = static_cast<Index>(r);
    MatrixXd out = MatrixXd::Zero(std::ssize(inference.training()), modes_ * (modes_ + 1) / 2);
    const VectorXd squares = found_.modes.omega_rad_s.head(modes_).cwiseAbs2();
    for (const PairedMode& mode : found_.paired) {
      const Index i = mode.model_mode;
      if (i < 0 || i >= modes_ || !(squares[i] > 0.0)) continue;
      if (const auto row = place.find(mode.frequency_row); row != place.end())
        out(row->second, product_of(i, i, modes_)) = 0.5 / squares[i];
      double own = 0.0, shown = 0.0;  // the rows' shape is a multiple of the model's
      for (std::size_t k = 0; k < mode.shape_rows.size(); ++k) {
        const double phi = found_.modes.shapes(mode.shape_channels[k], i);
        own += phi * phi;
        shown += phi * base.all.g[mode.shape_rows[k]];
      }
      if (!(own > 0.0)) continue;
      for (std::size_t k = 0; k < mode.shape_rows.size(); ++k) {
        const auto row = place.find(mode.shape_rows[k]);
        if (row == place.end()) continue;
        for (Index j = 0; j < modes_; ++j) {
          if (j == i) continue;
          const double least = kCloseSquares * std::max(squares[i], squares[j]), gap = squares[i] - squares[j];
          out(row->second, product_of(std::min(i, j), std::max(i, j), modes_)) =
              shown / own * found_.modes.shapes(mode.shape_channels[k], j) / std::copysign(std::max(std::abs(gap), least), gap);
        }
      }
    }
    return out;
  }

  FormModes found_;
  Index modes_ = 0;
  VectorXd along_;
  MatrixXd gram_;
};

/// Motions along a tie: on the line between two nodes in space, else in each direction that both have
/// (structure_of_causes.cpp).
MatrixXd stretch(const SpringScreen& screen, const ReducedPlace& from, const ReducedPlace& to) {
  const Index shared = std::min(from.directions.cols(), to.directions.cols());
  const MatrixXd apart = screen.motion(from).topRows(shared) - screen.motion(to).topRows(shared);
  const Eigen::Vector3d line = to.x_m - from.x_m;
  if (shared == 3 && line.allFinite() && line.norm() > 0.0) return line.normalized().transpose() * apart;
  return apart;
}

/// Positions in descending order of what each explains.
std::vector<std::size_t> by_explained(const std::vector<double>& explained) {
  std::vector<std::size_t> order(explained.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return explained[a] > explained[b]; });
  return order;
}

}  // namespace

std::vector<std::pair<const ReducedPlace*, const ReducedPlace*>> promising_ties(const Inference& inference, const Fit& base,
                                                                                const std::vector<const ReducedPlace*>& nodes,
                                                                                std::size_t count) {
  const SpringScreen screen(inference, base);
  if (screen.empty()) return {};
  std::vector<const ReducedPlace*> best = nodes;
  if (nodes.size() > kRankedNodes) {
    std::vector<double> alone;
    for (const ReducedPlace* node : nodes) alone.push_back(screen.explained(screen.products(screen.motion(*node))));
    const std::vector<std::size_t> order = by_explained(alone);
    std::vector<std::size_t> kept(order.begin(), order.begin() + kRankedNodes);
    std::sort(kept.begin(), kept.end());  // pairs are named in the order of the nodes
    best.clear();
    for (const std::size_t k : kept) best.push_back(nodes[k]);
  }
  std::vector<std::pair<const ReducedPlace*, const ReducedPlace*>> pairs;
  std::vector<double> explained;
  for (std::size_t i = 0; i < best.size(); ++i)
    for (std::size_t j = i + 1; j < best.size(); ++j) {
      pairs.emplace_back(best[i], best[j]);
      explained.push_back(screen.explained(screen.products(stretch(screen, *best[i], *best[j]))));
    }
  std::vector<std::pair<const ReducedPlace*, const ReducedPlace*>> out;
  for (const std::size_t k : by_explained(explained)) {
    if (out.size() == count || !(explained[k] > 0.0)) break;
    out.push_back(pairs[k]);
  }
  return out;
}

}  // namespace twindeck::diagnosis
