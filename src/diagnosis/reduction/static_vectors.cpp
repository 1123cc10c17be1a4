#include "diagnosis/reduction/static_vectors.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "linalg/dense.hpp"
#include "linalg/sparse.hpp"

namespace twindeck::diagnosis {

using Eigen::Index;
using Eigen::MatrixXd;

/// Energy of a direction over the largest of its block, below which it is rounding; energies are squares.
constexpr double kRounding = 1e-13;

/// The common basis, orthonormal in K.
class CommonBasis {
 public:
  CommonBasis(const Symmetric& stiffness, Index n) : stiffness_(stiffness), vectors_(n, 0), images_(n, 0) {}

  /// The columns of `block`, orthonormalised against the basis and against each other; columns that depend on them are dropped.
  /// @param turn  in: factors that made the block; out: factors that make the result. May be null
  [[nodiscard]] MatrixXd orthonormal(const MatrixXd& block, MatrixXd* turn = nullptr) const {
    constexpr double tolerance = 1e-6;
    const Eigen::VectorXd before =
        block.cwiseProduct(linalg::product(stiffness_, block)).colwise().sum().cwiseMax(0.0).cwiseSqrt();
    const MatrixXd rest = beyond(block);
    MatrixXd kept(block.rows(), block.cols()), images(block.rows(), block.cols());
    Index size = 0;
    for (Index c = 0; c < block.cols(); ++c) {
      if (!(before[c] > 0.0)) continue;
      Eigen::VectorXd v = rest.col(c), made = turn != nullptr ? Eigen::VectorXd(turn->col(c)) : Eigen::VectorXd();
      for (int pass = 0; pass < 2; ++pass)
        for (Index k = 0; k < size; ++k) {
          const double along = images.col(k).dot(v);
          v -= kept.col(k) * along;
          if (turn != nullptr) made -= turn->col(k) * along;
        }
      const Eigen::VectorXd image = stiffness_ * v;
      const double norm = std::sqrt(std::max(v.dot(image), 0.0));
      if (norm < tolerance * before[c]) continue;
      kept.col(size) = v / norm;
      if (turn != nullptr) turn->col(size) = made / norm;
      images.col(size) = image / norm;
      ++size;
    }
    if (turn != nullptr) turn->conservativeResize(Eigen::NoChange, size);
    return kept.leftCols(size);
  }
  void append(const MatrixXd& block) {
    const MatrixXd further = orthonormal(block);
    const Index size = vectors_.cols();
    vectors_.conservativeResize(Eigen::NoChange, size + further.cols());
    images_.conservativeResize(Eigen::NoChange, size + further.cols());
    vectors_.rightCols(further.cols()) = further;
    images_.rightCols(further.cols()) = linalg::product(stiffness_, further);
  }
  /// Vectors and their loads: K vectors = loads.
  struct Held {
    MatrixXd vectors, loads;
    MatrixXd turn = {};  ///< factors that made them from the columns of a block, if there are fewer
  };
  /// The strongest directions of a block beyond the basis, by energy in K: at most `count`, and none below `least`.
  [[nodiscard]] Held strongest(Held block, int count, double least = 0.0) const {
    block.vectors = beyond(std::move(block.vectors), &block.loads);
    if (block.vectors.cols() <= count) return block;
    if (count < 1) return {block.vectors.leftCols(0), block.loads.leftCols(0)};
    const MatrixXd gram = linalg::product(block.vectors, block.loads, true);
    const linalg::LeadingEigenpairs leading = linalg::leading_eigenpairs(0.5 * (gram + gram.transpose()), count);
    const Index kept = (leading.values.array() >= std::max(least, kRounding * leading.values[0])).count();
    const MatrixXd turn = leading.vectors.leftCols(kept);
    return {linalg::product(block.vectors, turn), linalg::product(block.loads, turn), turn};
  }
  [[nodiscard]] const MatrixXd& vectors() const { return vectors_; }

 private:
  /// Removes the basis from a block. A second pass is made only if some column loses much of its length (Daniel et al. 1976),
  /// because each pass reads the whole basis twice.
  /// @param loads  in and out: K block. May be null
  [[nodiscard]] MatrixXd beyond(MatrixXd block, MatrixXd* loads = nullptr) const {
    const Eigen::VectorXd before = block.colwise().norm();
    for (int pass = 0; pass < 2; ++pass) {
      const MatrixXd part = linalg::product(images_, block, true);
      linalg::subtract_product(vectors_, part, block);
      if (loads != nullptr) linalg::subtract_product(images_, part, *loads);
      if ((block.colwise().norm().transpose().array() >= std::numbers::sqrt2 / 2.0 * before.array()).all()) break;
    }
    return block;
  }

  const Symmetric& stiffness_;
  MatrixXd vectors_, images_;  ///< V and K V
};

namespace {

constexpr Eigen::Index kGathered = 960;  // most columns of one eigenproblem; its time grows with the cube
constexpr std::size_t kChunk = 64;       // changes whose columns are computed before they are gathered

CommonBasis::Held side_by_side(std::span<const CommonBasis::Held> blocks) {
  Index columns = 0, at = 0;
  for (const CommonBasis::Held& block : blocks) columns += block.vectors.cols();
  const Index n = blocks.front().vectors.rows();
  CommonBasis::Held out{MatrixXd(n, columns), MatrixXd(n, columns)};
  for (const CommonBasis::Held& block : blocks) {
    out.vectors.middleCols(at, block.vectors.cols()) = block.vectors;
    out.loads.middleCols(at, block.vectors.cols()) = block.loads;
    at += block.vectors.cols();
  }
  return out;
}

/// Responses K^-1 (change of K times given vectors), beyond the basis. The strongest few of each change are candidates, and the
/// strongest candidates are kept.
/// @param scale  of each vector
MatrixXd strongest_of(const CommonBasis& basis, const linalg::Cholesky& factor,
                      const std::vector<std::function<MatrixXd()>>& changes, const Eigen::VectorXd& scale,
                      const ReductionOptions& options) {
  // In chunks, each reduced to the strongest so far. The eigenproblem then stays small, however many locations there are.
  const Index n = basis.vectors().rows();
  std::vector<CommonBasis::Held> part = {{MatrixXd(n, 0), MatrixXd(n, 0)}};
  Index columns = 0;
  for (std::size_t begin = 0; begin < changes.size(); begin += kChunk) {
    std::vector<CommonBasis::Held> found(std::min(kChunk, changes.size() - begin));
    parallel_for(found.size(), [&](std::size_t i) {
      const MatrixXd load = changes[begin + i]() * scale.asDiagonal();
      found[i] = basis.strongest({factor.solve(load), load}, 6);
    });
    for (CommonBasis::Held& block : found) {
      if (columns + block.vectors.cols() > kGathered) {
        part = {basis.strongest(side_by_side(part), 2 * options.parameter_vectors)};
        columns = part.front().vectors.cols();
      }
      columns += block.vectors.cols();
      part.push_back(std::move(block));
    }
  }
  CommonBasis::Held all = side_by_side(part);
  return basis.strongest(std::move(all), options.parameter_vectors, options.least_correction).vectors;
}

/// K^-1 dK Phi and K^-1 dM Phi Lambda for each parameter and, if asked for, each group of elements, by their possible change.
/// The strongest few of each beyond the basis are kept, and of all these the strongest. Each mode is scaled by its strain
/// energy, so that the remaining error is the same part of each frequency. For the answers to load tests, which have no
/// eigenvalue, K^-1 dK u alone.
/// @param squares  eigenvalues of the vectors `low`; empty for answers of unit strain energy
MatrixXd corrections(const CommonBasis& basis, const linalg::Cholesky& factor, const fe::ParametricSystem& system,
                     const Eigen::VectorXd& theta, const Eigen::VectorXd& squares, const MatrixXd& low, const Places& places,
                     const ReductionOptions& options) {
  std::vector<std::function<MatrixXd()>> changes;
  const bool of_modes = squares.size() > 0;
  for (std::size_t p = 0; p < system.parameters.size(); ++p) {
    const double range = system.parameters[p].upper - system.parameters[p].lower;
    if (!(range > 0.0)) continue;
    changes.emplace_back([&, p, range] {
      MatrixXd change = system.stiffness_derivative_times(theta, static_cast<int>(p), low);
      if (of_modes) change -= system.mass_derivative_times(theta, static_cast<int>(p), low) * squares.asDiagonal();
      return MatrixXd(0.25 * range * change);
    });
  }
  if (const auto zones = places.sets.find("zones"); zones != places.sets.end() && options.element_change > 0.0)
    for (const Place& place : zones->second) {
      if (place.stiffness.size() > 0) changes.emplace_back([&] { return place.stiffness.times(options.element_change, low); });
      if (of_modes && place.mass.size() > 0)
        changes.emplace_back([&] { return MatrixXd(place.mass.times(options.element_change, low) * squares.asDiagonal()); });
    }
  if (!of_modes) return strongest_of(basis, factor, changes, Eigen::VectorXd::Ones(low.cols()), options);
  const double least = 1e-6 * squares[squares.size() - 1];  // rigid-body modes have none
  const Eigen::VectorXd scale = squares.cwiseMax(least).cwiseSqrt().cwiseInverse();
  return strongest_of(basis, factor, changes, scale, options);
}

/// Responses to the loads of load tests, of unit strain energy.
MatrixXd unit_answers(const LoadTests& tests, const linalg::Cholesky& factor, const Symmetric& stiffness) {
  MatrixXd answers = factor.solve(loads_to_answer(tests));
  for (Index c = 0; c < answers.cols(); ++c) answers.col(c) /= std::sqrt(answers.col(c).dot(stiffness * answers.col(c)));
  return answers;
}

constexpr Index kForcesAtOnce = 512;  ///< unit forces of a location that are solved together; a support's line may have many

/// Calls fn(unit forces) for a few at once.
template <typename Fn>
void each_few(const Eigen::SparseMatrix<double>& directions, Fn fn) {
  for (Index first = 0; first < directions.cols(); first += kForcesAtOnce)
    fn(MatrixXd(directions.middleCols(first, std::min(kForcesAtOnce, directions.cols() - first))));
}

}  // namespace

StaticVectors::StaticVectors() = default;
StaticVectors::~StaticVectors() = default;

const MatrixXd& StaticVectors::common() const { return basis_->vectors(); }

MatrixXd StaticVectors::responses(const Eigen::SparseMatrix<double>& directions, int count) const {
  std::vector<CommonBasis::Held> parts;
  each_few(directions, [&](const MatrixXd& load) {
    parts.push_back({factor_.solve(load), load});
    if (directions.cols() > kForcesAtOnce) parts.back() = basis_->strongest(std::move(parts.back()), 2 * count);
  });
  return basis_->strongest(parts.size() == 1 ? std::move(parts.front()) : side_by_side(parts), count).vectors;
}

MatrixXd StaticVectors::loads_at(const Place& place) const {
  if (place.directions.size() > 0) return place.directions;
  MatrixXd load;
  if (place.stiffness.size() > 0)
    load = place.stiffness * low_;
  else if (place.mass.size() > 0)
    load = place.mass * low_;
  if (answers_.cols() == 0 || place.stiffness.size() == 0) return load;
  load.conservativeResize(Eigen::NoChange, load.cols() + answers_.cols());
  load.rightCols(answers_.cols()) = place.stiffness * answers_;
  return load;
}

MatrixXd StaticVectors::own_vectors(const Place& place, int count, MatrixXd* turn) const {
  if (count == 0) return {};
  if (place.directions.cols() > kForcesAtOnce) return basis_->orthonormal(responses(place.directions, count));
  const MatrixXd load = loads_at(place);
  if (load.size() == 0) return {};
  const Index answered = place.directions.size() == 0 && place.stiffness.size() > 0 ? answers_.cols() : 0;
  MatrixXd own(load.rows(), 0), turns(load.cols(), 0);
  for (const auto& [first, columns] : {std::pair{Index{0}, load.cols() - answered}, {load.cols() - answered, answered}}) {
    if (columns == 0) continue;
    const MatrixXd part = load.middleCols(first, columns);
    const CommonBasis::Held found = basis_->strongest({factor_.solve(part), part}, count);
    const Index before = own.cols(), kept = found.vectors.cols();
    own.conservativeResize(Eigen::NoChange, before + kept);
    own.rightCols(kept) = found.vectors;
    turns.conservativeResizeLike(MatrixXd::Zero(load.cols(), before + kept));
    turns.block(first, before, columns, kept) = found.turn.size() > 0 ? found.turn : MatrixXd::Identity(columns, kept);
  }
  own = basis_->orthonormal(own, turn != nullptr ? &turns : nullptr);
  if (turn != nullptr) *turn = turns;
  return own;
}

std::function<MatrixXd()> StaticVectors::recipe(const Place& place, int count) const {
  if (count == 0 || place.directions.cols() > kForcesAtOnce) return [this, place, count] { return own_vectors(place, count); };
  MatrixXd turn;
  if (own_vectors(place, count, &turn).cols() == 0) return [] { return MatrixXd(); };
  const MatrixXd forces = loads_at(place) * turn;
  std::vector<int> dofs;
  for (Index i = 0; i < forces.rows(); ++i)
    if (!forces.row(i).isZero(0.0)) dofs.push_back(static_cast<int>(i));
  MatrixXd at_dofs = forces(dofs, Eigen::all);
  MatrixXd part = common()(dofs, Eigen::all).transpose() * at_dofs;  // V' K (K^-1 f)
  return [this, dofs = std::move(dofs), at_dofs = std::move(at_dofs), part = std::move(part)] {
    MatrixXd force = MatrixXd::Zero(stiffness_.rows(), at_dofs.cols());
    force(dofs, Eigen::all) = at_dofs;
    MatrixXd own = factor_.solve(force);
    linalg::subtract_product(common(), part, own);
    return own;
  };
}

double StaticVectors::drive_stiffness(const Eigen::SparseMatrix<double>& directions) const {
  double flexibility = 0.0;  // of all directions
  each_few(directions, [&](const MatrixXd& b) { flexibility += b.cwiseProduct(factor_.solve(b)).sum(); });
  return static_cast<double>(directions.cols()) / flexibility;
}

void StaticVectors::factorize(const Structure& structure) {
  const linalg::SparseMatrix lower = structure.system->stiffness(structure.theta);
  stiffness_ = Symmetric(lower.selfadjointView<Eigen::Lower>());
  if (factor_.factorize(lower).converged) return;
  const linalg::SparseMatrix lower_mass = structure.system->mass(structure.theta);
  stiffness_ -= dynamics::free_structure_shift(lower, lower_mass) * Symmetric(lower_mass.selfadjointView<Eigen::Lower>());
  const linalg::SparseMatrix shifted = stiffness_.triangularView<Eigen::Lower>();
  const Status status = factor_.factorize(shifted);
  if (!status.converged) throw InputError({structure.source, 0, ""}, "has a singular stiffness: " + status.message, "");
}

void StaticVectors::make_common(const Structure& structure, const Places& places, const dynamics::EigenModes& modes,
                                const ReductionOptions& options) {
  const fe::ParametricSystem& system = *structure.system;
  low_ = modes.shapes.leftCols(std::min<Index>(options.corrected_modes, modes.shapes.cols()));
  basis_ = std::make_unique<CommonBasis>(stiffness_, system.size());
  basis_->append(modes.shapes);
  basis_->append(
      corrections(*basis_, factor_, system, structure.theta, modes.eigenvalue.head(low_.cols()), low_, places, options));
  if (const auto dampers = places.sets.find("dampers"); dampers != places.sets.end())
    for (const Place& damper : dampers->second) basis_->append(factor_.solve(MatrixXd(damper.directions)));
  if (structure.load_tests.empty()) return;
  answers_ = unit_answers(structure.load_tests, factor_, stiffness_);
  basis_->append(answers_);
  basis_->append(corrections(*basis_, factor_, system, structure.theta, {}, answers_, places, options));
}

}  // namespace twindeck::diagnosis
