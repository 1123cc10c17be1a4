#include "fe/matrix_element.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>

#include "core/error.hpp"

namespace twindeck::fe {

namespace {

Eigen::MatrixXd or_zero(const Eigen::MatrixXd& matrix, Eigen::Index n) {
  return matrix.size() > 0 ? matrix : Eigen::MatrixXd::Zero(n, n);
}

Eigen::MatrixXd symmetric_part(const Eigen::MatrixXd& a) { return 0.5 * (a + a.transpose()); }

}  // namespace

ConservativePart conservative_part(const MatrixElement& element) {
  const auto m = static_cast<Eigen::Index>(element.dofs.size());
  const Eigen::Index n = m + element.internal;
  const Eigen::MatrixXd k = or_zero(element.stiffness, n);
  Eigen::MatrixXd t = Eigen::MatrixXd::Identity(n, m);
  if (element.internal > 0)
    t.bottomRows(n - m) = -k.bottomRightCorner(n - m, n - m).partialPivLu().solve(k.bottomLeftCorner(n - m, m));
  // K T has zero rows at the own unknowns, so Tᵀ K T is its upper part: right for an unsymmetric K too.
  ConservativePart part;
  for (const MatrixElement::Dof& dof : element.dofs) part.stiffness.dofs.push_back(6 * dof.node + dof.direction);
  part.mass.dofs = part.stiffness.dofs;
  part.stiffness.matrix = symmetric_part((k * t).topRows(m));
  part.mass.matrix = symmetric_part(t.transpose() * or_zero(element.mass, n) * t);
  return part;
}

void validate_matrix_elements(const Model& model) {
  for (const MatrixElement& element : model.matrix_elements) {
    const auto refuse = [&](const std::string& problem, const std::string& mend) {
      throw InputError({model.source, 0, "matrix element " + element.name}, problem, mend);
    };
    if (element.dofs.empty()) refuse("acts on no degree of freedom", "list them as \"node:direction\"");
    if (element.internal < 0) refuse(fmt::format("has {} unknowns of its own", element.internal), "give 0 or more");
    for (const MatrixElement::Dof& dof : element.dofs)
      if (dof.node < 0 || dof.node >= std::ssize(model.nodes) || dof.direction < 0 || dof.direction > 5)
        refuse(fmt::format("acts on direction {} of node number {}, which is not there", dof.direction, dof.node),
               "give nodes of the model and directions x y z rx ry rz");
    const Eigen::Index n = std::ssize(element.dofs) + element.internal;
    for (const auto& [name, matrix] : {std::pair<const char*, const Eigen::MatrixXd&>{"stiffness", element.stiffness},
                                       {"damping", element.damping},
                                       {"mass", element.mass}}) {
      if (matrix.size() == 0) continue;
      if (matrix.rows() != n || matrix.cols() != n)
        refuse(fmt::format("{} is {} x {}, expected {} x {}: {} degrees of freedom and {} unknowns of its own", name,
                           matrix.rows(), matrix.cols(), n, n, element.dofs.size(), element.internal),
               "give matrices of that size");
      if (!matrix.allFinite()) refuse(fmt::format("{} holds a number that is not finite", name), "replace NaN and infinity");
    }
    if (element.internal == 0) continue;
    const bool regular =
        element.stiffness.size() > 0 &&
        Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(element.stiffness.bottomRightCorner(element.internal, element.internal))
            .isInvertible();
    if (!regular)
      refuse("leaves its own unknowns without a static position: their block of the stiffness is singular",
             "give them stiffness, or state them so that they come to rest when the structure does");
  }
}

}  // namespace twindeck::fe
