#pragma once

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "fe/parametric_system.hpp"

namespace twindeck::updating {

/// Small dense matrices as a parametric system: K = sum theta_i K_i (+ fixed), M likewise. For tests.
class SmallSystem {
 public:
  explicit SmallSystem(Eigen::Index n) {
    Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(n, n).triangularView<Eigen::Lower>();
    system_.pattern = ones.sparseView();
    system_.pattern.makeCompressed();
    for (Eigen::Index i = 0; i < n; ++i) system_.dofs.push_back({std::to_string(i + 1), 0, Eigen::Vector3d::Zero()});
  }
  int parameter(const std::string& name, double initial, double lower, double upper) {
    system_.parameters.push_back({name, fe::Target::matrix_stiffness, {}, "-", initial, lower, upper});
    return static_cast<int>(system_.parameters.size()) - 1;
  }
  SmallSystem& stiffness(const Eigen::MatrixXd& k, int parameter = -1) { return add(system_.stiffness_terms, k, parameter); }
  SmallSystem& mass(const Eigen::MatrixXd& m, int parameter = -1) { return add(system_.mass_terms, m, parameter); }
  [[nodiscard]] const fe::ParametricSystem& system() const { return system_; }

 private:
  SmallSystem& add(std::vector<fe::Term>& terms, const Eigen::MatrixXd& matrix, int parameter) {
    fe::Term term;
    if (parameter >= 0) term.coefficient.factors.push_back({parameter, 1.0, 1.0});
    const auto& pattern = system_.pattern;
    for (int j = 0; j < pattern.outerSize(); ++j) {
      for (int at = pattern.outerIndexPtr()[j]; at < pattern.outerIndexPtr()[j + 1]; ++at) {
        const double value = matrix(pattern.innerIndexPtr()[at], j);
        if (value == 0.0) continue;
        term.position.push_back(at);
        term.value.push_back(value);
      }
    }
    terms.push_back(term);
    return *this;
  }
  fe::ParametricSystem system_;
};

/// Stiffness of one unit spring between dofs a and b (-1 = ground) of n.
inline Eigen::MatrixXd spring(Eigen::Index n, int a, int b) {
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(n);
  if (a >= 0) direction(a) = 1.0;
  if (b >= 0) direction(b) = -1.0;
  return direction * direction.transpose();
}

/// Oracle: dense generalised eigenvalues (Eigen), not the library's solver. @return [Hz] ascending
inline Eigen::VectorXd dense_frequencies(const fe::ParametricSystem& system, const Eigen::VectorXd& theta) {
  const Eigen::MatrixXd k = Eigen::MatrixXd(system.stiffness(theta)).selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd m = Eigen::MatrixXd(system.mass(theta)).selfadjointView<Eigen::Lower>();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(k, m, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues().cwiseSqrt() / (2.0 * std::numbers::pi);
}

}  // namespace twindeck::updating
