#include "steps/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>

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
    start_.resize(std::ssize(calibration.values));
    for (Index v = 0; v < start_.size(); ++v) {
      const CalibrationValue& value = calibration.values[static_cast<std::size_t>(v)];
      start_[v] = value.part_of(value.start);
    }
  }

  /// Relative frequency errors, then the weak pull to the start.
  bool residual(const VectorXd& part, VectorXd& r) {
    std::vector<Solved> solved(calibration_.targets.size());
    for_each(std::ssize(solved), [&](Index t) { solved[static_cast<std::size_t>(t)] = solve(part, t); });
    solved_ = std::move(solved);
    r.resize(n_frequencies_ + part.size());
    frequencies.resize(n_frequencies_);
    Index row = 0;
    for (std::size_t t = 0; t < solved_.size(); ++t) {
      if (solved_[t].frequency_Hz.size() == 0) return false;
      for (Index i = 0; i < solved_[t].frequency_Hz.size(); ++i, ++row) {
        frequencies[row] = solved_[t].frequency_Hz[i];
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
    for_each(part.size() * n_targets, [&](Index work) {
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

  VectorXd frequencies;
  [[nodiscard]] Index n_frequencies() const { return n_frequencies_; }
  [[nodiscard]] const VectorXd& start() const { return start_; }

 private:
  static constexpr double kStep = 1e-5;  ///< part of a range

  static void for_each(Index count, const std::function<void(Index)>& work) {
    std::exception_ptr failure;
#pragma omp parallel for schedule(dynamic, 1)
    for (Index i = 0; i < count; ++i) {
      try {
        work(i);
      } catch (...) {  // must not leave the parallel region
#pragma omp critical(twindeck_calibration)
        failure = std::current_exception();
      }
    }
    if (failure) std::rethrow_exception(failure);
  }

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

CalibrationResult calibrate(const Calibration& calibration, const std::filesystem::path& bridge_toml, const std::string& mesh,
                            const VectorXd& first, const std::function<void(const std::string&)>& report) {
  Fit fit(calibration, bridge_toml, mesh);
  const updating::Box box{VectorXd::Zero(first.size()), VectorXd::Ones(first.size())};
  CalibrationResult result;
  VectorXd r;
  if (!fit.residual(fit.start(), r)) {
    result.status = {false, "the untuned bridge has no modes"};
    return result;
  }
  result.untuned = fit.frequencies;
  result.part = first;
  if (first != fit.start() && !fit.residual(first, r)) {
    result.status = {false, "the bridge to begin with has no modes"};
    return result;
  }
  result.fitted = fit.frequencies;
  result.status = {false, "iteration limit"};
  double damping = 1e-4;
  const auto frequency_rms = [&] {
    return std::sqrt(r.head(fit.n_frequencies()).squaredNorm() / static_cast<double>(fit.n_frequencies()));
  };
  for (; result.iterations < calibration.max_iterations; ++result.iterations) {
    result.cost = 0.5 * r.squaredNorm();
    const MatrixXd j = fit.jacobian(result.part);
    result.projected_gradient = updating::projected_gradient(result.part, j.transpose() * r, box, 1e-9).norm();
    report(fmt::format("iteration {:2}: rms {:.3f} %, worst {:.2f} %, projected gradient {:.1e}, damping {:.0e}",
                       result.iterations, 100 * frequency_rms(), 100 * r.head(fit.n_frequencies()).cwiseAbs().maxCoeff(),
                       result.projected_gradient, damping));
    if (result.projected_gradient < 1e-7) {
      result.status = {};
      break;
    }
    bool accepted = false;
    for (int tries = 0; tries < 6 && !accepted; ++tries) {
      const VectorXd step = updating::bounded_gauss_newton_step(r, j, result.part, box, damping);
      const VectorXd next = (result.part + step).cwiseMax(0.0).cwiseMin(1.0);
      VectorXd r_next;
      accepted = fit.residual(next, r_next) && 0.5 * r_next.squaredNorm() < result.cost;
      if (!accepted) {
        damping *= 8.0;
        continue;
      }
      const double gain = result.cost - 0.5 * r_next.squaredNorm();
      result.part = next;
      r = r_next;
      result.fitted = fit.frequencies;
      damping = std::max(1e-9, damping / 5.0);
      if (gain < 1e-5 * result.cost) {
        result.status = {};
        result.cost = 0.5 * r.squaredNorm();
        return result;
      }
    }
    if (!accepted) {
      result.status = {};  // no step lowers the cost: modes change places here, or rounding is reached
      break;
    }
  }
  return result;
}

}  // namespace twindeck::steps
