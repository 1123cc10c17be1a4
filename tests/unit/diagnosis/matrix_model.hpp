#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/reduction/structure.hpp"

namespace twindeck::tests {

/// A structure that is given by its matrices, as a test writes them down. Every dof is a channel, in the order of the dofs.
class MatrixModel {
 public:
  struct Part {
    fe::Parameter parameter;
    Eigen::MatrixXd stiffness;  ///< at the parameter's initial value, to which it is proportional
  };
  MatrixModel(std::vector<fe::DofLabel> dofs, const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
              const std::vector<Part>& parts = {}) {
    system_.dofs = std::move(dofs);
    const auto n = static_cast<int>(stiffness.rows());
    std::vector<Eigen::Triplet<double>> entries;
    const auto coupled = [&](int i, int j) {
      bool any = i == j || stiffness(i, j) != 0.0 || mass(i, j) != 0.0;
      for (const Part& part : parts) any = any || part.stiffness(i, j) != 0.0;
      return any;
    };
    for (int j = 0; j < n; ++j)
      for (int i = j; i < n; ++i)
        if (coupled(i, j)) entries.emplace_back(i, j, 0.0);
    system_.pattern.resize(n, n);
    system_.pattern.setFromTriplets(entries.begin(), entries.end());
    system_.stiffness_terms.push_back(term_of(stiffness));
    system_.mass_terms.push_back(term_of(mass));
    for (const Part& part : parts) {
      const auto p = static_cast<int>(system_.parameters.size());
      system_.parameters.push_back(part.parameter);
      fe::Term term = term_of(part.stiffness);
      term.coefficient.factors = {{p, 1.0, part.parameter.initial}};
      system_.stiffness_terms.push_back(term);
    }
    structure_.system = &system_;
    structure_.theta = system_.initial();
    structure_.source = "matrices";
    structure_.sensors = [this](const Eigen::MatrixXd& v) {
      Eigen::MatrixXd out = Eigen::MatrixXd::Zero(4 * v.rows(), v.cols());
      for (Eigen::Index c = 0; c < v.rows(); ++c) {
        out.row(4 * c) = v.row(c);
        for (Eigen::Index d = 0; d < v.rows(); ++d) {
          const fe::DofLabel &own = system_.dofs[static_cast<std::size_t>(c)],
                             &other = system_.dofs[static_cast<std::size_t>(d)];
          if (own.node == other.node && other.direction < 3) out.row(4 * c + 1 + other.direction) = v.row(d);
        }
      }
      return out;
    };
    for (const fe::DofLabel& dof : system_.dofs) structure_.sensor_nodes.push_back(dof.node);
  }
  MatrixModel(const MatrixModel&) = delete;
  MatrixModel& operator=(const MatrixModel&) = delete;

  [[nodiscard]] const diagnosis::Structure& structure() const { return structure_; }

 private:
  [[nodiscard]] fe::Term term_of(const Eigen::MatrixXd& whole) const {
    fe::Term term;
    const int* outer = system_.pattern.outerIndexPtr();
    for (int j = 0; j < whole.cols(); ++j)
      for (int at = outer[j]; at < outer[j + 1]; ++at) {
        term.position.push_back(at);
        term.value.push_back(whole(system_.pattern.innerIndexPtr()[at], j));
      }
    return term;
  }

  fe::ParametricSystem system_;
  diagnosis::Structure structure_;
};

/// Stiffness of springs (n + 1) in a row between two walls.
inline Eigen::MatrixXd springs_in_a_row(const Eigen::VectorXd& spring) {
  const Eigen::Index n = spring.size() - 1;
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    k(i, i) = spring[i] + spring[i + 1];
    if (i + 1 < n) k(i, i + 1) = k(i + 1, i) = -spring[i + 1];
  }
  return k;
}

/// Nodes "1" to "n" one metre apart on x that move along it.
inline std::vector<fe::DofLabel> nodes_in_a_row(int n) {
  std::vector<fe::DofLabel> dofs;
  for (int i = 0; i < n; ++i) dofs.push_back({std::to_string(i + 1), 0, Eigen::Vector3d(i, 0.0, 0.0)});
  return dofs;
}

}  // namespace twindeck::tests
