#include "fe/dynamic_system.hpp"

#include "fe/assembly_elements.hpp"
#include "fe/matrix_element.hpp"

namespace twindeck::fe {

namespace {

using Triplets = std::vector<Eigen::Triplet<double, int>>;

linalg::SparseMatrix both_triangles(const linalg::SparseMatrix& lower) { return lower.selfadjointView<Eigen::Lower>(); }

/// Matrices over all degrees of freedom of all nodes, then the elements' own unknowns.
struct Sums {
  Triplets mass, damping, stiffness;
};

void add(Triplets& sum, const std::vector<int>& at, const Eigen::Ref<const Eigen::MatrixXd>& matrix, double sign = 1.0) {
  for (std::size_t i = 0; i < at.size(); ++i)
    for (std::size_t j = 0; j < at.size(); ++j) {
      const double value = matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      if (value != 0.0) sum.emplace_back(at[i], at[j], sign * value);
    }
}

void add_springs(const Model& model, int& next, Sums& sums, std::vector<std::string>& own) {
  for (const Spring& spring : model.springs) {
    if (!spring.active || spring.damping == 0.0) continue;
    Elongation e = elongation_of(spring);
    if (!spring.series) {
      add(sums.damping, e.dofs, spring.damping * e.coefficient * e.coefficient.transpose());
      continue;
    }
    if (spring.stiffness == 0.0) continue;
    const Eigen::Index n = e.coefficient.size();
    e.dofs.push_back(next);
    e.coefficient.conservativeResize(n + 1);
    e.coefficient[n] = -1.0;  // k acts on e - z
    add(sums.stiffness, e.dofs, spring.stiffness * e.coefficient * e.coefficient.transpose());
    sums.damping.emplace_back(next, next, spring.damping);
    own.push_back(spring.name);
    ++next;
  }
}

void add_matrix_elements(const Model& model, int& next, Sums& sums, std::vector<std::string>& own) {
  for (const MatrixElement& element : model.matrix_elements) {
    const ConservativePart part = conservative_part(element);
    add(sums.stiffness, part.stiffness.dofs, part.stiffness.matrix, -1.0);
    add(sums.mass, part.mass.dofs, part.mass.matrix, -1.0);
    std::vector<int> at = part.stiffness.dofs;
    for (int i = 0; i < element.internal; ++i) {
      at.push_back(next++);
      own.push_back(element.name);
    }
    if (element.stiffness.size() > 0) add(sums.stiffness, at, element.stiffness);
    if (element.damping.size() > 0) add(sums.damping, at, element.damping);
    if (element.mass.size() > 0) add(sums.mass, at, element.mass);
  }
}

}  // namespace

DynamicSystem assemble_dynamic(const Model& model, const ParametricSystem& system, const Eigen::VectorXd& theta) {
  const Model now = with_parameters(model, theta);
  const auto n_full = static_cast<int>(6 * model.nodes.size());
  const auto n_structure = static_cast<int>(system.size());
  DynamicSystem dynamic;
  dynamic.dofs = system.dofs;
  Sums sums;
  int next = n_full;
  add_springs(now, next, sums, dynamic.own);
  add_matrix_elements(now, next, sums, dynamic.own);
  const int n_own = next - n_full, n = n_structure + n_own;

  // [E 0; 0 1]: supports and links eliminated, own unknowns as they are.
  Triplets expansion;
  for (int column = 0; column < system.expansion.outerSize(); ++column)
    for (linalg::SparseMatrix::InnerIterator entry(system.expansion, column); entry; ++entry)
      expansion.emplace_back(static_cast<int>(entry.row()), column, entry.value());
  for (int i = 0; i < n_own; ++i) expansion.emplace_back(n_full + i, n_structure + i, 1.0);
  linalg::SparseMatrix e(next, n);
  e.setFromTriplets(expansion.begin(), expansion.end());

  const auto reduce = [&](const Triplets& sum, const linalg::SparseMatrix& structure) {
    linalg::SparseMatrix full(next, next);
    full.setFromTriplets(sum.begin(), sum.end());
    linalg::SparseMatrix reduced = e.transpose() * full * e;
    linalg::SparseMatrix widened = structure;
    widened.conservativeResize(n, n);
    return linalg::SparseMatrix(widened + reduced);
  };
  dynamic.stiffness = reduce(sums.stiffness, both_triangles(system.stiffness(theta)));
  dynamic.mass = reduce(sums.mass, both_triangles(system.mass(theta)));
  dynamic.damping = reduce(sums.damping, linalg::SparseMatrix(n_structure, n_structure));
  return dynamic;
}

}  // namespace twindeck::fe
