#include "steps/calibration/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "dynamics/eigenmodes.hpp"
#include "fe/structure.hpp"
#include "linalg/symmetric_product.hpp"
#include "updating/bounded_quadratic.hpp"
#include "updating/optimality.hpp"

namespace twindeck::steps {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// One variant at one set of values.
struct Solved {
  fe::PrestressState state;
  VectorXd eigenvalue, frequency_Hz;  ///< of the targets' modes
  MatrixXd shapes;
  VectorXd stiffness_form, mass_form;  ///< phi' K phi, phi' M phi
};

VectorXd forms(const linalg::SparseMatrix& lower, const MatrixXd& shapes) {
  return shapes.cwiseProduct(linalg::SymmetricProduct(lower).times(shapes)).colwise().sum();
}

class Fit {
 public:
  Fit(const Calibration& calibration, const std::filesystem::path& bridge_toml, const std::string& mesh)
      : calibration_(calibration), file_(bridge_toml), mesh_(mesh) {
    for (const CalibrationTarget& target : calibration.targets) n_frequencies_ += std::ssize(target.modes);
    ratio = VectorXd::Ones(n_frequencies_);
    start_.resize(std::ssize(calibration.values));
    for (Index v = 0; v < start_.size(); ++v) {
      const CalibrationValue& value = calibration.values[static_cast<std::size_t>(v)];
      start_[v] = value.part_of(value.start);
    }
  }

  /// Relative frequency errors, then the weak pull to the start.
  bool residual(const VectorXd& part, VectorXd& r) {
    std::vector<Solved> solved(calibration_.targets.size());
    parallel_for(std::ssize(solved), [&](Index t) { solved[static_cast<std::size_t>(t)] = solve(part, t); });
    solved_ = std::move(solved);
    r.resize(n_frequencies_ + part.size());
    frequencies.resize(n_frequencies_);
    Index row = 0;
    for (std::size_t t = 0; t < solved_.size(); ++t) {
      if (solved_[t].frequency_Hz.size() == 0) return false;
      for (Index i = 0; i < solved_[t].frequency_Hz.size(); ++i, ++row) {
        frequencies[row] = ratio[row] * solved_[t].frequency_Hz[i];
        r[row] = frequencies[row] / calibration_.targets[t].frequency_Hz[static_cast<std::size_t>(i)] - 1.0;
      }
    }
    r.tail(part.size()) = calibration_.whole_range_costs * (part - start_);
    return true;
  }

  /// Of the last residual.
  MatrixXd jacobian(const VectorXd& part) const {
    MatrixXd j = MatrixXd::Zero(n_frequencies_ + part.size(), part.size());
    j.bottomRows(part.size()).diagonal().setConstant(calibration_.whole_range_costs);
    const Index n_targets = std::ssize(calibration_.targets);
    parallel_for(part.size() * n_targets, [&](Index work) {
      const Index v = work / n_targets, t = work % n_targets;
      const CalibrationTarget& target = calibration_.targets[static_cast<std::size_t>(t)];
      if (!acts(calibration_.values[static_cast<std::size_t>(v)], target.variant)) return;
      Index row = 0;
      for (Index before = 0; before < t; ++before)
        row += std::ssize(calibration_.targets[static_cast<std::size_t>(before)].modes);
      const Solved& at = solved_[static_cast<std::size_t>(t)];
      // Backwards at the upper end, so that the range is never left.
      const double h = part[v] > 0.5 ? -kStep : kStep;
      VectorXd moved = part;
      moved[v] += h;
      const fe::Structure structure(model(moved, target.variant));
      const fe::ParametricSystem system = structure.system(at.state);
      const VectorXd theta = system.initial();
      const VectorXd dk = forms(system.stiffness(theta), at.shapes) - at.stiffness_form;
      const VectorXd dm = forms(system.mass(theta), at.shapes) - at.mass_form;
      for (Index i = 0; i < at.frequency_Hz.size(); ++i) {
        const double per_eigenvalue =
            0.5 / at.eigenvalue[i] * at.frequency_Hz[i] / target.frequency_Hz[static_cast<std::size_t>(i)];
        j(row + i, v) = per_eigenvalue * (dk[i] - at.eigenvalue[i] * dm[i]) / h;
      }
    });
    return j;
  }

  VectorXd frequencies;  ///< of the last residual, times `ratio`
  VectorXd ratio;        ///< (n_frequencies) what another mesh makes of this one's frequencies
  [[nodiscard]] Index n_frequencies() const { return n_frequencies_; }
  [[nodiscard]] const VectorXd& start() const { return start_; }

 private:
  static constexpr double kStep = 1e-5;  ///< part of a range

  fe::Model model(const VectorXd& part, const std::string& variant) const {
    return ponte::generate_with_values(file_, variant, mesh_, bridge_values(calibration_, part));
  }

  /// Whether a value can act on a variant: what only a change sets is not in `preliminary`; what a change sets anew is not in
  /// the others.
  bool acts(const CalibrationValue& value, const std::string& variant) const {
    return std::any_of(value.paths.begin(), value.paths.end(), [&](const std::string& path) {
      if (path.starts_with("change.")) return variant != "preliminary";
      if (variant == "preliminary") return true;
      for (const CalibrationValue& other : calibration_.values) {
        for (const std::string& changed : other.paths) {
          if (changed.starts_with("change.") && changed.ends_with("." + path)) return false;
        }
      }
      return true;
    });
  }

  Solved solve(const VectorXd& part, Index t) const {
    const CalibrationTarget& target = calibration_.targets[static_cast<std::size_t>(t)];
    const fe::Structure structure(model(part, target.variant));
    Solved out;
    out.state = structure.prestress(fe::initial_parameters(structure.model()));
    const fe::ParametricSystem system = structure.system(out.state);
    const VectorXd theta = system.initial();
    dynamics::ModalSolver solver(system);
    const int n_modes = *std::max_element(target.modes.begin(), target.modes.end());
    const dynamics::EigenModes modes = solver.solve(theta, n_modes + 3);
    if (!modes.status.converged || !out.state.status.converged) return out;
    std::vector<Index> at;
    for (const int mode : target.modes) at.push_back(mode - 1);
    out.eigenvalue = modes.eigenvalue(at);
    out.frequency_Hz = modes.frequency_Hz(at);
    out.shapes = modes.shapes(Eigen::all, at);
    out.stiffness_form = forms(system.stiffness(theta), out.shapes);
    out.mass_form = forms(system.mass(theta), out.shapes);
    return out;
  }

  const Calibration& calibration_;
  std::filesystem::path file_;
  std::string mesh_;
  Index n_frequencies_ = 0;
  VectorXd start_;
  std::vector<Solved> solved_;
};

}  // namespace

namespace {

/// Levenberg and Marquardt from `part` on one mesh, until the cost settles.
struct Search {
  VectorXd part;
  double projected_gradient = 0.0;
  int iterations = 0;
  bool settled = false;
};
Search search(Fit& fit, VectorXd part, int max_iterations, const std::function<void(const std::string&)>& report) {
  const updating::Box box{VectorXd::Zero(part.size()), VectorXd::Ones(part.size())};
  Search out{std::move(part)};
  VectorXd r;
  if (!fit.residual(out.part, r)) return out;
  double damping = 1e-4;
  for (; out.iterations < max_iterations; ++out.iterations) {
    const double cost = 0.5 * r.squaredNorm();
    const MatrixXd j = fit.jacobian(out.part);
    out.projected_gradient = updating::projected_gradient(out.part, j.transpose() * r, box, 1e-9).norm();
    const VectorXd errors = r.head(fit.n_frequencies());
    report(fmt::format("iteration {:2}: rms {:.3f} %, worst {:.2f} %, projected gradient {:.1e}", out.iterations,
                       100 * std::sqrt(errors.squaredNorm() / static_cast<double>(errors.size())),
                       100 * errors.cwiseAbs().maxCoeff(), out.projected_gradient));
    VectorXd r_next;
    bool lower = false;
    for (int tries = 0; tries < 6 && !lower; ++tries) {
      const VectorXd step = updating::bounded_gauss_newton_step(r, j, out.part, box, damping);
      const VectorXd next = (out.part + step).cwiseMax(0.0).cwiseMin(1.0);
      lower = fit.residual(next, r_next) && 0.5 * r_next.squaredNorm() < cost;
      if (lower) out.part = next;
      damping = lower ? std::max(1e-9, damping / 5.0) : damping * 8.0;
    }
    // No lower cost: rounding is reached, or modes change places here.
    out.settled = !lower || cost - 0.5 * r_next.squaredNorm() < 1e-4 * cost;
    if (lower) r = r_next;
    if (out.settled) break;
  }
  return out;
}

}  // namespace

CalibrationResult calibrate(const Calibration& calibration, const std::filesystem::path& bridge_toml, const std::string& mesh,
                            const std::string& search_mesh, const VectorXd& first,
                            const std::function<void(const std::string&)>& report) {
  Fit full(calibration, bridge_toml, mesh), quick(calibration, bridge_toml, search_mesh);
  CalibrationResult result;
  VectorXd r;
  if (!full.residual(full.start(), r)) {
    result.status = {false, "the untuned bridge has no modes"};
    return result;
  }
  result.untuned = full.frequencies;
  result.part = first;
  result.status = {false, "the frequencies of the two meshes do not settle"};
  for (int round = 0; round < 6; ++round) {
    if (!full.residual(result.part, r)) {
      result.status = {false, "the bridge has no modes at the values found"};
      return result;
    }
    result.fitted = full.frequencies;
    result.cost = 0.5 * r.squaredNorm();
    const VectorXd errors = r.head(full.n_frequencies());
    report(fmt::format("mesh {}: rms {:.3f} %, worst {:.2f} %", mesh.empty() ? "of the study" : mesh,
                       100 * std::sqrt(errors.squaredNorm() / static_cast<double>(errors.size())),
                       100 * errors.cwiseAbs().maxCoeff()));
    if (round > 0 && (full.frequencies - quick.frequencies).cwiseQuotient(full.frequencies).cwiseAbs().maxCoeff() < 2e-4) {
      result.status = {};
      return result;
    }
    quick.ratio.setOnes();
    VectorXd unused;
    if (!quick.residual(result.part, unused)) continue;
    quick.ratio = full.frequencies.cwiseQuotient(quick.frequencies);
    const Search found = search(quick, result.part, calibration.max_iterations, report);
    // The last residual may be that of a refused step.
    static_cast<void>(quick.residual(found.part, unused));
    result.part = found.part;
    result.projected_gradient = found.projected_gradient;
    result.iterations += found.iterations;
  }
  return result;
}

}  // namespace twindeck::steps
