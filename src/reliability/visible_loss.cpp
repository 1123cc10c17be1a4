#include "reliability/visible_loss.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/distributions.hpp"
#include "core/lists.hpp"
#include "core/parallel.hpp"

namespace twindeck::reliability {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// [-] probability with which a loss is neither overlooked nor claimed where there is none.
constexpr double kSureness = 0.95;
/// [-] share of the wall at which the search begins, and relative width at which it ends.
constexpr double kFirstShare = 0.05, kWidth = 0.01;
constexpr int kMostSteps = 12;
/// [-] least ratio of squared frequencies: a worn model that has lost its stability has none above 0.
constexpr double kLeastRatio = 1e-6;

double wall_of(const fe::Model& model, const Wall& wall) {
  if (wall.thickness_m > 0.0) return wall.thickness_m / wall.sides;
  double least = std::numeric_limits<double>::infinity();
  for (const fe::Section& section : model.sections) {
    if (!contains(wall.sections, section.name)) continue;
    const double there =
        section.thickness_m > 0.0 ? section.thickness_m / wall.sides : std::sqrt(section.area_m2 / std::numbers::pi);
    least = std::min(least, there);
  }
  return least;
}

/// Changes of ln f of the monitored modes, divided by their deviations and by the root of two. After the loss, a monitored mode
/// is the one with the largest component of the mode before.
VectorXd weighed_change(const fe::Model& model, const MatrixXd& modes, const VectorXd& frequency_Hz, Wall wall, double loss_m,
                        const std::vector<MonitoredMode>& monitored) {
  wall.corrosion = {loss_m, 1.0, 0.0};  // all of it in one year
  const dynamics::LoadedModel worn = dynamics::from_model(worn_model(model, {wall}, 1.0));
  const MatrixXd k = modes.transpose() * (worn.system.stiffness(worn.theta).selfadjointView<Eigen::Lower>() * modes);
  const MatrixXd m = modes.transpose() * (worn.system.mass(worn.theta).selfadjointView<Eigen::Lower>() * modes);
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solved(k, m);
  VectorXd out(std::ssize(monitored));
  for (Index i = 0; i < out.size(); ++i) {
    const MonitoredMode& mode = monitored[static_cast<std::size_t>(i)];
    Index after = 0;
    solved.eigenvectors().row(mode.mode).cwiseAbs().maxCoeff(&after);
    const double omega = 2.0 * std::numbers::pi * frequency_Hz[mode.mode];
    const double ratio = std::max(solved.eigenvalues()[after] / (omega * omega), kLeastRatio);
    out[i] = 0.5 * std::log(ratio) / (std::numbers::sqrt2 * mode.deviation);
  }
  return out;
}

/// Distance of a direction from the span of others, over the length of the direction [-].
double apart(const VectorXd& direction, const std::vector<VectorXd>& others) {
  MatrixXd span(direction.size(), std::ssize(others));
  for (Index i = 0; i < span.cols(); ++i) span.col(i) = others[static_cast<std::size_t>(i)].normalized();
  if (span.cols() >= span.rows()) return 0.0;
  if (span.cols() == 0) return 1.0;
  const VectorXd along = span.colPivHouseholderQr().solve(direction);
  return (direction - span * along).norm() / direction.norm();
}

}  // namespace

std::vector<VisibleLoss> visible_losses(const fe::Model& model, const MatrixXd& modes, const VectorXd& frequency_Hz,
                                        const std::vector<Wall>& walls, const std::vector<MonitoredMode>& monitored) {
  const double seen = 2.0 * normal_quantile(kSureness);
  std::vector<VisibleLoss> out(walls.size());
  std::vector<VectorXd> directions(walls.size());
  parallel_for(std::ssize(walls), [&](Index at) {
    const Wall& wall = walls[static_cast<std::size_t>(at)];
    VisibleLoss& found = out[static_cast<std::size_t>(at)];
    found.wall_m = wall_of(model, wall);
    const double most = kLargestLoss * found.wall_m;
    double loss = kFirstShare * found.wall_m;
    VectorXd change = weighed_change(model, modes, frequency_Hz, wall, loss, monitored);
    directions[static_cast<std::size_t>(at)] = change;
    double power = 1.0;  // of the distance as a function of the loss, from the last two losses
    for (int step = 0; step < kMostSteps && std::abs(change.norm() / seen - 1.0) > kWidth; ++step) {
      const double before = change.norm();
      const double next = std::min(most, before > 0.0 ? loss * std::pow(seen / before, 1.0 / power) : most);
      if (next == loss) break;
      change = weighed_change(model, modes, frequency_Hz, wall, next, monitored);
      const double slope = std::log(change.norm() / before) / std::log(next / loss);
      if (std::isfinite(slope) && slope > 0.0) power = slope;
      loss = next;
    }
    found.distance = change.norm();
    if (std::abs(found.distance / seen - 1.0) <= kWidth) found.loss_m = loss;
    for (Index i = 0; i < change.size(); ++i)
      change[i] *= std::numbers::sqrt2 * monitored[static_cast<std::size_t>(i)].deviation;
    found.change = change;
  });
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (!out[i].loss_m) continue;
    std::vector<VectorXd> others = directions;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const double share = apart(directions[i], others), located = *out[i].loss_m / std::max(share, 1e-12);
    if (located <= kLargestLoss * out[i].wall_m) out[i].located_m = located;
  }
  return out;
}

}  // namespace twindeck::reliability
