#include "diagnosis/reduced_model.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "dynamics/eigenmodes.hpp"
#include "dynamics/free_structure.hpp"
#include "linalg/cholesky.hpp"
#include "linalg/dense_instances.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

Symmetric symmetric_of(const fe::ParametricSystem& system, const fe::Term& term) {
  std::vector<Eigen::Triplet<double>> entries;
  const int* outer = system.pattern.outerIndexPtr();
  const int* inner = system.pattern.innerIndexPtr();
  int column = 0;
  for (std::size_t i = 0; i < term.position.size(); ++i) {
    const int position = term.position[i];
    if (position < outer[column]) column = 0;
    while (position >= outer[column + 1]) ++column;
    entries.emplace_back(inner[position], column, term.value[i]);
    if (inner[position] != column) entries.emplace_back(column, inner[position], term.value[i]);
  }
  Symmetric matrix(system.size(), system.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// V' S V, over the rows that S touches.
MatrixXd project(const Symmetric& s, const MatrixXd& v) {
  std::vector<int> touched;
  for (int c = 0; c < s.outerSize(); ++c)
    if (Symmetric::InnerIterator(s, c)) touched.push_back(c);
  MatrixXd left(static_cast<Index>(touched.size()), v.cols()), right(left.rows(), v.cols());
  std::vector<int> at(static_cast<std::size_t>(s.rows()), -1);
  for (std::size_t i = 0; i < touched.size(); ++i) at[static_cast<std::size_t>(touched[i])] = static_cast<int>(i);
  for (std::size_t i = 0; i < touched.size(); ++i) left.row(static_cast<Index>(i)) = v.row(touched[i]);
  const MatrixXd rows = left.transpose();
  MatrixXd sum = MatrixXd::Zero(v.cols(), left.rows());
  for (std::size_t i = 0; i < touched.size(); ++i)
    for (Symmetric::InnerIterator e(s, touched[i]); e; ++e)
      sum.col(static_cast<Index>(i)) += e.value() * rows.col(at[static_cast<std::size_t>(e.row())]);
  return rows * sum.transpose();
}

/// Builds a basis that is orthonormal in K, column by column; what is nearly in it already is dropped.
class Basis {
 public:
  Basis(const Symmetric& stiffness, Index n) : stiffness_(stiffness), vectors_(n, 0), images_(n, 0) {}

  /// Appends the columns of `block`, orthogonalised against the first `common` columns and against each other.
  /// @return positions of those that were kept
  std::vector<int> append(const MatrixXd& block, Index common, double tolerance = 1e-6) {
    std::vector<int> kept;
    for (Index c = 0; c < block.cols(); ++c) {
      Eigen::VectorXd v = block.col(c);
      const double before = std::sqrt(std::max(v.dot(stiffness_ * v), 0.0));
      if (!(before > 0.0)) continue;
      for (int pass = 0; pass < 2; ++pass) {
        v -= vectors_.leftCols(common) * (images_.leftCols(common).transpose() * v);
        for (const int k : kept) v -= vectors_.col(k) * images_.col(k).dot(v);
      }
      Eigen::VectorXd image = stiffness_ * v;
      const double norm = std::sqrt(std::max(v.dot(image), 0.0));
      if (norm < tolerance * before) continue;
      kept.push_back(static_cast<int>(vectors_.cols()));
      vectors_.conservativeResize(Eigen::NoChange, vectors_.cols() + 1);
      images_.conservativeResize(Eigen::NoChange, images_.cols() + 1);
      vectors_.rightCols(1) = v / norm;
      images_.rightCols(1) = image / norm;
    }
    return kept;
  }
  /// The strongest directions of a block in K beyond the common ones, at most `count`.
  [[nodiscard]] MatrixXd strongest(const MatrixXd& block, Index common, int count) const {
    MatrixXd rest = block;
    for (int pass = 0; pass < 2; ++pass) rest -= vectors_.leftCols(common) * (images_.leftCols(common).transpose() * rest);
    if (rest.cols() <= count) return rest;
    const MatrixXd gram = rest.transpose() * (stiffness_ * rest);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(gram);
    return rest * eigen.eigenvectors().rightCols(count).rowwise().reverse();
  }
  [[nodiscard]] const MatrixXd& vectors() const { return vectors_; }
  [[nodiscard]] Index size() const { return vectors_.cols(); }

 private:
  const Symmetric& stiffness_;
  MatrixXd vectors_, images_;
};

}  // namespace

const ReducedPlace* ReducedModel::place(const std::string& set, const std::string& id) const {
  const auto found = sets.find(set);
  if (found == sets.end()) return nullptr;
  for (const ReducedPlace& place : found->second)
    if (place.id == id) return &place;
  return nullptr;
}

ReducedModel::ReducedModel(const Structure& structure, const Places& places, const ReductionOptions& options)
    : parameters(structure.system->parameters), theta(structure.theta), total_mass_kg(places.total_mass_kg) {
  const fe::ParametricSystem& system = *structure.system;
  const Index n = system.size();
  const bool whole = n <= options.full_below;

  // 1. Modes as the structure stands, and the factor that static corrections come from.
  dynamics::ModalSolver solver(system);
  int wanted = static_cast<int>(std::min<Index>(options.modes, n));
  dynamics::EigenModes modes = solver.solve(theta, wanted);
  if (!modes.status.converged && modes.frequency_Hz.size() > 0)
    modes = solver.solve(theta, static_cast<int>(modes.frequency_Hz.size()));  // fewer masses than that
  if (modes.frequency_Hz.size() == 0) throw InputError({structure.source, 0, ""}, "has no modes: " + modes.status.message, "");
  frequency_Hz = modes.frequency_Hz;
  const linalg::SparseMatrix lower = system.stiffness(theta);
  Symmetric stiffness_now = Symmetric(lower.selfadjointView<Eigen::Lower>());
  linalg::Cholesky factor;
  if (!factor.factorize(lower).converged) {
    const Symmetric mass_now = Symmetric(system.mass(theta).selfadjointView<Eigen::Lower>());
    stiffness_now -= dynamics::free_structure_shift(lower, system.mass(theta)) * mass_now;
    const linalg::SparseMatrix shifted = stiffness_now.triangularView<Eigen::Lower>();
    const Status status = factor.factorize(shifted);
    if (!status.converged) throw InputError({structure.source, 0, ""}, "has a singular stiffness: " + status.message, "");
  }

  // 2. The basis: common vectors, then each place's own.
  Basis basis(stiffness_now, n);
  const MatrixXd low = modes.shapes.leftCols(std::min<Index>(options.corrected_modes, modes.shapes.cols()));
  MatrixXd v;
  std::map<std::string, std::vector<std::vector<int>>> own;
  if (whole) {
    v = MatrixXd::Identity(n, n);
    common = static_cast<int>(n);
  } else {
    basis.append(modes.shapes, 0);
    MatrixXd forces(n, 0);
    for (std::size_t p = 0; p < parameters.size(); ++p) {
      const double range = parameters[p].upper - parameters[p].lower;
      if (!(range > 0.0)) continue;
      MatrixXd change = system.stiffness_derivative_times(theta, static_cast<int>(p), low);
      change -= system.mass_derivative_times(theta, static_cast<int>(p), low) * modes.eigenvalue.head(low.cols()).asDiagonal();
      forces.conservativeResize(Eigen::NoChange, forces.cols() + low.cols());
      forces.rightCols(low.cols()) = 0.25 * range * change;
    }
    if (forces.cols() > 0) {
      const Index modal = basis.size();
      basis.append(basis.strongest(factor.solve(forces), modal, options.parameter_vectors), modal);
    }
    if (const auto dampers = places.sets.find("dampers"); dampers != places.sets.end())
      for (const Place& damper : dampers->second) basis.append(factor.solve(MatrixXd(damper.directions)), basis.size());
    common = static_cast<int>(basis.size());
    for (const auto& [set, list] : places.sets) {
      for (const Place& place : list) {
        MatrixXd load(n, 0);
        if (place.directions.size() > 0) {
          load = MatrixXd(place.directions);
        } else if (set != "global" && (place.stiffness.size() > 0 || place.mass.size() > 0)) {
          load = place.stiffness.size() > 0 ? MatrixXd(place.stiffness * low) : MatrixXd(place.mass * low);
        }
        std::vector<int> columns;
        if (load.cols() > 0 && set != "dampers")
          columns = basis.append(basis.strongest(factor.solve(load), common, options.vectors_per_place), common);
        own[set].push_back(columns);
      }
    }
    v = basis.vectors();
  }

  // 3. Everything in that basis.
  const auto reduce_terms = [&](const std::vector<fe::Term>& terms, std::vector<Term>& out) {
    for (const fe::Term& term : terms) out.push_back({term.coefficient, project(symmetric_of(system, term), v)});
  };
  reduce_terms(system.stiffness_terms, stiffness);
  reduce_terms(system.mass_terms, mass);
  for (const auto& [set, list] : places.sets) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Place& place = list[i];
      ReducedPlace reduced{place.id, place.x_m, whole ? std::vector<int>{} : own.at(set)[i], {}, {}, {}, place.attributes};
      reduced.attributes.try_emplace("total_mass", total_mass_kg);
      if (place.stiffness.size() > 0) reduced.stiffness = project(place.stiffness, v);
      if (place.mass.size() > 0) reduced.mass = project(place.mass, v);
      if (place.directions.size() > 0) {
        reduced.directions = v.transpose() * place.directions;
        const MatrixXd b = MatrixXd(place.directions);
        const MatrixXd flexibility = b.transpose() * factor.solve(b);
        reduced.attributes["k_drive"] = static_cast<double>(b.cols()) / flexibility.trace();
      }
      sets[set].push_back(std::move(reduced));
    }
  }
  sensors = structure.sensors(v);
  // modes = V q with q from the K inner product (V is K-orthonormal), or the modes themselves.
  mode_coordinates = whole ? modes.shapes : MatrixXd(v.transpose() * (stiffness_now * modes.shapes));
}

}  // namespace twindeck::diagnosis
