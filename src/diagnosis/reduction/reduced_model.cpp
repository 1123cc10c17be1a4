#include "diagnosis/reduction/reduced_model.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <span>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "dynamics/eigenmodes.hpp"
#include "dynamics/free_structure.hpp"
#include "linalg/cholesky.hpp"
#include "linalg/dense.hpp"

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

/// Energy, of the largest of a block's, below which a direction of it is rounding: energies are squares.
constexpr double kRounding = 1e-13;

/// The common basis, orthonormal in K.
class Basis {
 public:
  Basis(const Symmetric& stiffness, Index n) : stiffness_(stiffness), vectors_(n, 0), images_(n, 0) {}
  /// @param orthonormal  in K
  Basis(const Symmetric& stiffness, const MatrixXd& orthonormal)
      : stiffness_(stiffness), vectors_(orthonormal), images_(stiffness * orthonormal) {}

  /// The columns of `block`, orthonormalised against the basis and against each other; what is nearly in them already is
  /// dropped.
  [[nodiscard]] MatrixXd orthonormal(const MatrixXd& block) const {
    constexpr double tolerance = 1e-6;
    const Eigen::VectorXd before = block.cwiseProduct(stiffness_ * block).colwise().sum().cwiseMax(0.0).cwiseSqrt();
    const MatrixXd rest = beyond(block);
    MatrixXd kept(block.rows(), block.cols()), images(block.rows(), block.cols());
    Index size = 0;
    for (Index c = 0; c < block.cols(); ++c) {
      if (!(before[c] > 0.0)) continue;
      Eigen::VectorXd v = rest.col(c);
      for (int pass = 0; pass < 2; ++pass)
        for (Index k = 0; k < size; ++k) v -= kept.col(k) * images.col(k).dot(v);
      const Eigen::VectorXd image = stiffness_ * v;
      const double norm = std::sqrt(std::max(v.dot(image), 0.0));
      if (norm < tolerance * before[c]) continue;
      kept.col(size) = v / norm;
      images.col(size) = image / norm;
      ++size;
    }
    return kept.leftCols(size);
  }
  void append(const MatrixXd& block) {
    const MatrixXd further = orthonormal(block);
    const Index size = vectors_.cols();
    vectors_.conservativeResize(Eigen::NoChange, size + further.cols());
    images_.conservativeResize(Eigen::NoChange, size + further.cols());
    vectors_.rightCols(further.cols()) = further;
    images_.rightCols(further.cols()) = stiffness_ * further;
  }
  /// Vectors and what loads hold them: K vectors = loads.
  struct Held {
    MatrixXd vectors, loads;
  };
  /// The strongest directions of a block in K beyond the basis, at most `count`, and none of less energy than `least`.
  [[nodiscard]] Held strongest(Held block, int count, double least = 0.0) const {
    for (int pass = 0; pass < 2; ++pass) {
      const MatrixXd part = linalg::product(images_, block.vectors, true);
      linalg::subtract_product(vectors_, part, block.vectors);
      linalg::subtract_product(images_, part, block.loads);
    }
    if (block.vectors.cols() <= count) return block;
    if (count < 1) return {block.vectors.leftCols(0), block.loads.leftCols(0)};
    const MatrixXd gram = linalg::product(block.vectors, block.loads, true);
    const linalg::LeadingEigenpairs leading = linalg::leading_eigenpairs(0.5 * (gram + gram.transpose()), count);
    const Index kept = (leading.values.array() >= std::max(least, kRounding * leading.values[0])).count();
    const MatrixXd turn = leading.vectors.leftCols(kept);
    return {linalg::product(block.vectors, turn), linalg::product(block.loads, turn)};
  }
  [[nodiscard]] const MatrixXd& vectors() const { return vectors_; }

 private:
  [[nodiscard]] MatrixXd beyond(MatrixXd block) const {
    for (int pass = 0; pass < 2; ++pass) linalg::subtract_product(vectors_, linalg::product(images_, block, true), block);
    return block;
  }

  const Symmetric& stiffness_;
  MatrixXd vectors_, images_;  ///< V and K V
};

/// What stands for causes at a place, beside the common vectors: K^-1 b for a force direction, K^-1 (dK Phi) for a factor.
/// @param answers  to the loads of load tests, whose change by a factor is kept as well
MatrixXd own_vectors(const Basis& basis, const linalg::Cholesky& factor, const Place& place, const MatrixXd& low,
                     const MatrixXd& answers, int count) {
  if (count == 0) return {};
  MatrixXd load;
  if (place.directions.size() > 0)
    load = MatrixXd(place.directions);
  else if (place.stiffness.size() > 0)
    load = place.stiffness * low;
  else if (place.mass.size() > 0)
    load = place.mass * low;
  if (load.cols() == 0) return {};
  MatrixXd own = basis.strongest({factor.solve(load), load}, count).vectors;
  if (answers.cols() > 0 && place.directions.size() == 0 && place.stiffness.size() > 0) {
    const MatrixXd change = place.stiffness * answers;
    const MatrixXd further = basis.strongest({factor.solve(change), change}, count).vectors;
    own.conservativeResize(Eigen::NoChange, own.cols() + further.cols());
    own.rightCols(further.cols()) = further;
  }
  return basis.orthonormal(own);
}

constexpr Eigen::Index kGathered = 960;  // columns of one eigenproblem: its time grows with their cube
constexpr std::size_t kChunk = 64;       // changes whose columns are held before they are gathered

Basis::Held side_by_side(std::span<const Basis::Held> blocks) {
  Index columns = 0, at = 0;
  for (const Basis::Held& block : blocks) columns += block.vectors.cols();
  const Index n = blocks.front().vectors.rows();
  Basis::Held out{MatrixXd(n, columns), MatrixXd(n, columns)};
  for (const Basis::Held& block : blocks) {
    out.vectors.middleCols(at, block.vectors.cols()) = block.vectors;
    out.loads.middleCols(at, block.vectors.cols()) = block.loads;
    at += block.vectors.cols();
  }
  return out;
}

/// What changes of K make of given vectors, K^-1 (change): of each change the strongest few beyond the basis, of these the
/// strongest of all.
/// @param scale  of each vector
MatrixXd strongest_of(const Basis& basis, const linalg::Cholesky& factor, const std::vector<std::function<MatrixXd()>>& changes,
                      const Eigen::VectorXd& scale, const ReductionOptions& options) {
  // In parts, each cut down to the strongest so far: the eigenproblem has a bounded size however many places there are.
  const Index n = basis.vectors().rows();
  std::vector<Basis::Held> part = {{MatrixXd(n, 0), MatrixXd(n, 0)}};
  Index columns = 0;
  for (std::size_t begin = 0; begin < changes.size(); begin += kChunk) {
    std::vector<Basis::Held> found(std::min(kChunk, changes.size() - begin));
    parallel_for(found.size(), [&](std::size_t i) {
      const MatrixXd load = changes[begin + i]() * scale.asDiagonal();
      found[i] = basis.strongest({factor.solve(load), load}, 6);
    });
    for (Basis::Held& block : found) {
      if (columns + block.vectors.cols() > kGathered) {
        part = {basis.strongest(side_by_side(part), 2 * options.parameter_vectors)};
        columns = part.front().vectors.cols();
      }
      columns += block.vectors.cols();
      part.push_back(std::move(block));
    }
  }
  Basis::Held all = side_by_side(part);
  return basis.strongest(std::move(all), options.parameter_vectors, options.least_correction).vectors;
}

/// K^-1 dK Phi and K^-1 dM Phi Lambda for each parameter and, where asked for, each group of elements, by as much as they may
/// change; of each the strongest few beyond the basis, of these the strongest of all. Each mode counts by its strain energy, so
/// that what is missed costs each the same part of its frequency.
MatrixXd corrections(const Basis& basis, const linalg::Cholesky& factor, const fe::ParametricSystem& system,
                     const Eigen::VectorXd& theta, const Eigen::VectorXd& eigenvalue, const MatrixXd& low, const Places& places,
                     const ReductionOptions& options) {
  std::vector<std::function<MatrixXd()>> changes;
  const auto squares = eigenvalue.head(low.cols());
  for (std::size_t p = 0; p < system.parameters.size(); ++p) {
    const double range = system.parameters[p].upper - system.parameters[p].lower;
    if (!(range > 0.0)) continue;
    changes.emplace_back([&, p, range] {
      MatrixXd change = system.stiffness_derivative_times(theta, static_cast<int>(p), low);
      change -= system.mass_derivative_times(theta, static_cast<int>(p), low) * squares.asDiagonal();
      return MatrixXd(0.25 * range * change);
    });
  }
  if (const auto elements = places.sets.find("elements"); elements != places.sets.end() && options.element_change > 0.0)
    for (const Place& place : elements->second) {
      if (place.stiffness.size() > 0)
        changes.emplace_back([&] { return MatrixXd(options.element_change * (place.stiffness * low)); });
      if (place.mass.size() > 0)
        changes.emplace_back([&] { return MatrixXd(options.element_change * (place.mass * low) * squares.asDiagonal()); });
    }
  const double least = 1e-6 * squares[squares.size() - 1];  // modes of a free structure have none
  const Eigen::VectorXd scale = squares.cwiseMax(least).cwiseSqrt().cwiseInverse();
  return strongest_of(basis, factor, changes, scale, options);
}

/// The same of what load tests do: K^-1 dK u for each parameter and group of elements.
/// @param answers  u (n × m), of unit strain energy
MatrixXd answer_corrections(const Basis& basis, const linalg::Cholesky& factor, const fe::ParametricSystem& system,
                            const Eigen::VectorXd& theta, const MatrixXd& answers, const Places& places,
                            const ReductionOptions& options) {
  std::vector<std::function<MatrixXd()>> changes;
  for (std::size_t p = 0; p < system.parameters.size(); ++p) {
    const double range = system.parameters[p].upper - system.parameters[p].lower;
    if (range > 0.0)
      changes.emplace_back([&, p, range] {
        return MatrixXd(0.25 * range * system.stiffness_derivative_times(theta, static_cast<int>(p), answers));
      });
  }
  if (const auto elements = places.sets.find("elements"); elements != places.sets.end() && options.element_change > 0.0)
    for (const Place& place : elements->second)
      if (place.stiffness.size() > 0)
        changes.emplace_back([&] { return MatrixXd(options.element_change * (place.stiffness * answers)); });
  return strongest_of(basis, factor, changes, Eigen::VectorXd::Ones(answers.cols()), options);
}

}  // namespace

struct ReducedModel::Kept {
  Symmetric stiffness;  ///< K where the basis was made, shifted where the structure is free
  linalg::Cholesky factor;
  std::shared_ptr<ReducedBasis> basis;
  Eigen::MatrixXd low, answers;  ///< the modes and responses that own vectors are made of
  int vectors_per_place = 0;
  bool whole = false;  ///< V is the identity

  /// The stiffness as the structure stands, and the factor that static corrections come from.
  void factorize(const Structure& structure);
  /// The common vectors, then each place's own.
  OwnColumns make_basis(const Structure& structure, const Places& places, const dynamics::EigenModes& modes,
                        const ReductionOptions& options);
};

namespace {

/// Sets whose matrices are scattered, so that every state needs them in the coordinates of its causes.
bool is_scattered(const std::string& set) { return set == "elements" || set == "nodes" || set == "stays"; }

/// A place in the coordinates of a basis, but for its columns.
ReducedPlace reduced(const Place& place, bool scattered, const std::shared_ptr<const ReducedBasis>& basis,
                     const linalg::Cholesky& factor, double total_mass_kg) {
  ReducedPlace out{place.id, place.x_m, {}, {}, {}, {}, place.attributes};
  out.attributes.try_emplace("total_mass", total_mass_kg);
  if (place.stiffness.size() > 0) out.stiffness = ReducedMatrix(place.stiffness, basis, scattered);
  if (place.mass.size() > 0) out.mass = ReducedMatrix(place.mass, basis, scattered);
  if (place.directions.size() == 0) return out;
  out.directions = basis->vectors.transpose() * place.directions;
  const MatrixXd b = MatrixXd(place.directions);
  const double flexibility = b.cwiseProduct(factor.solve(b)).sum();  // of all directions
  out.attributes["k_drive"] = static_cast<double>(b.cols()) / flexibility;
  return out;
}

/// Modes as the structure stands; all that it has, where its masses are fewer than asked for.
dynamics::EigenModes modes_of(const Structure& structure, const ReductionOptions& options) {
  dynamics::ModalSolver solver(*structure.system);
  dynamics::EigenModes modes =
      solver.solve(structure.theta, static_cast<int>(std::min<Index>(options.modes, structure.system->size())));
  if (!modes.status.converged && modes.frequency_Hz.size() > 0)
    modes = solver.solve(structure.theta, static_cast<int>(modes.frequency_Hz.size()));
  if (modes.frequency_Hz.size() == 0) throw InputError({structure.source, 0, ""}, "has no modes: " + modes.status.message, "");
  return modes;
}

/// Answers to the loads of load tests, of unit strain energy.
MatrixXd unit_answers(const LoadTests& tests, const linalg::Cholesky& factor, const Symmetric& stiffness) {
  MatrixXd answers = factor.solve(loads_to_answer(tests));
  for (Index c = 0; c < answers.cols(); ++c) answers.col(c) /= std::sqrt(answers.col(c).dot(stiffness * answers.col(c)));
  return answers;
}

}  // namespace

double parameter_ratio(const std::map<std::string, double>& attributes, const Eigen::VectorXd& reduced_at,
                       const Eigen::VectorXd& value) {
  const auto parameter = attributes.find("parameter");
  if (parameter == attributes.end()) return 1.0;
  const auto p = static_cast<Index>(parameter->second);
  return reduced_at[p] != 0.0 ? value[p] / reduced_at[p] : 1.0;
}

const ReducedPlace* ReducedModel::place(const std::string& set, const std::string& id) const {
  const auto found = sets.find(set);
  if (found == sets.end()) return nullptr;
  for (const ReducedPlace& place : found->second)
    if (place.id == id) return &place;
  return nullptr;
}

ReducedModel::ReducedModel(const Structure& structure, const Places& places, const ReductionOptions& options)
    : parameters(structure.system->parameters),
      theta(structure.theta),
      total_mass_kg(places.total_mass_kg),
      kept_(std::make_shared<Kept>()) {
  const dynamics::EigenModes modes = modes_of(structure, options);
  frequency_Hz = modes.frequency_Hz;
  kept_->factorize(structure);
  kept_->whole = structure.system->size() <= options.full_below;
  kept_->low = modes.shapes.leftCols(std::min<Index>(options.corrected_modes, modes.shapes.cols()));
  kept_->vectors_per_place = options.vectors_per_place;
  OwnColumns own;
  if (kept_->whole) {
    kept_->basis = std::make_shared<ReducedBasis>(MatrixXd::Identity(structure.system->size(), structure.system->size()));
  } else {
    own = kept_->make_basis(structure, places, modes, options);
  }
  common = static_cast<int>(kept_->basis->common());
  const MatrixXd& v = kept_->basis->vectors;
  project(*structure.system, places, own);
  sensors = structure.sensors(v);
  load_tests = projected(structure.load_tests, v);
  // modes = V q with q from the K inner product (V is K-orthonormal), or the modes themselves.
  mode_coordinates = kept_->whole ? modes.shapes : MatrixXd(v.transpose() * (kept_->stiffness * modes.shapes));
}

void ReducedModel::Kept::factorize(const Structure& structure) {
  const linalg::SparseMatrix lower = structure.system->stiffness(structure.theta);
  stiffness = Symmetric(lower.selfadjointView<Eigen::Lower>());
  if (factor.factorize(lower).converged) return;
  const linalg::SparseMatrix lower_mass = structure.system->mass(structure.theta);
  stiffness -= dynamics::free_structure_shift(lower, lower_mass) * Symmetric(lower_mass.selfadjointView<Eigen::Lower>());
  const linalg::SparseMatrix shifted = stiffness.triangularView<Eigen::Lower>();
  const Status status = factor.factorize(shifted);
  if (!status.converged) throw InputError({structure.source, 0, ""}, "has a singular stiffness: " + status.message, "");
}

ReducedModel::OwnColumns ReducedModel::Kept::make_basis(const Structure& structure, const Places& places,
                                                        const dynamics::EigenModes& modes, const ReductionOptions& options) {
  const fe::ParametricSystem& system = *structure.system;
  Basis shared(stiffness, system.size());
  shared.append(modes.shapes);
  shared.append(corrections(shared, factor, system, structure.theta, modes.eigenvalue, low, places, options));
  if (const auto dampers = places.sets.find("dampers"); dampers != places.sets.end())
    for (const Place& damper : dampers->second) shared.append(factor.solve(MatrixXd(damper.directions)));
  if (!structure.load_tests.empty()) {
    answers = unit_answers(structure.load_tests, factor, stiffness);
    shared.append(answers);
    shared.append(answer_corrections(shared, factor, system, structure.theta, answers, places, options));
  }

  std::vector<const Place*> all;
  std::vector<int> count;
  for (const auto& [set, list] : places.sets)
    for (const Place& place : list) {
      const bool served = set == "dampers" || (set == "global" && place.directions.size() == 0);  // by the common vectors
      all.push_back(&place);
      // A support may go to any of its stations, each with a static response of its own.
      const int wanted = set == "support_moves" ? options.vectors_per_move : options.vectors_per_place;
      count.push_back(served ? 0 : wanted);
    }
  std::vector<MatrixXd> own(all.size());
  parallel_for(all.size(), [&](std::size_t i) { own[i] = own_vectors(shared, factor, *all[i], low, answers, count[i]); });
  basis = std::make_shared<ReducedBasis>(shared.vectors());
  const std::vector<std::vector<int>> columns = basis->append(own);
  OwnColumns by_set;
  std::size_t at = 0;
  for (const auto& [set, list] : places.sets)
    for (std::size_t i = 0; i < list.size(); ++i) by_set[set].push_back(columns[at++]);
  return by_set;
}

void ReducedModel::project(const fe::ParametricSystem& system, const Places& places, const OwnColumns& own) {
  // The largest first: whole groups take as long as hundreds of places.
  struct Job {
    Index size;
    std::function<void()> run;
  };
  std::vector<Job> jobs;
  const auto reduce_terms = [&](const std::vector<fe::Term>& terms, std::vector<Term>& out) {
    out.resize(terms.size());
    for (std::size_t t = 0; t < terms.size(); ++t)
      jobs.push_back({system.size(), [&, t] {
                        out[t] = {terms[t].coefficient, ReducedMatrix(symmetric_of(system, terms[t]), kept_->basis, true)};
                      }});
  };
  reduce_terms(system.stiffness_terms, stiffness);
  reduce_terms(system.mass_terms, mass);
  for (const auto& [set, list] : places.sets) {
    if (list.empty()) continue;
    std::vector<ReducedPlace>& reduced_set = sets[set];
    reduced_set.resize(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Place& place = list[i];
      const auto* columns = kept_->whole ? nullptr : &own.at(set)[i];
      const auto reduce = [&, i, columns, scattered = is_scattered(set)] {
        reduced_set[i] = reduced(place, scattered, kept_->basis, kept_->factor, total_mass_kg);
        if (columns != nullptr) reduced_set[i].columns = *columns;
      };
      jobs.push_back({place.stiffness.nonZeros() + place.mass.nonZeros(), reduce});
    }
  }
  std::stable_sort(jobs.begin(), jobs.end(), [](const Job& a, const Job& b) { return a.size > b.size; });
  parallel_for(jobs.size(), [&](std::size_t i) { jobs[i].run(); });
}

void ReducedModel::extend(const Structure& structure, const Places& places, const std::string& set,
                          const std::vector<Place>& further) {
  TWINDECK_ASSERT(kept_ != nullptr && kept_.use_count() == 1 && !sets.contains(set));
  const Index before = size();

  // 1. Vectors of the further places, beyond the common ones.
  std::vector<std::vector<int>> own(further.size());
  if (!kept_->whole) {
    const Basis basis(kept_->stiffness, MatrixXd(kept_->basis->vectors.leftCols(common)));
    std::vector<MatrixXd> vectors(further.size());
    parallel_for(further.size(), [&](std::size_t i) {
      vectors[i] = own_vectors(basis, kept_->factor, further[i], kept_->low, kept_->answers, kept_->vectors_per_place);
    });
    own = kept_->basis->append(vectors);
  }

  // 2. What there is already follows the basis; then the further places themselves.
  const MatrixXd& v = kept_->basis->vectors;
  std::vector<std::function<void()>> jobs;
  if (v.cols() > before) {
    for (std::vector<Term>* terms : {&stiffness, &mass})
      for (Term& term : *terms) jobs.emplace_back([&] { term.matrix.follow_basis(); });
    for (const auto& [name, list] : places.sets)
      for (std::size_t i = 0; i < list.size(); ++i)
        jobs.emplace_back([&, &place = list[i], &known = sets.at(name)[i]] {
          known.stiffness.follow_basis();
          known.mass.follow_basis();
          if (known.directions.size() > 0) {
            known.directions.conservativeResize(v.cols(), Eigen::NoChange);
            known.directions.bottomRows(v.cols() - before) = v.rightCols(v.cols() - before).transpose() * place.directions;
          }
        });
  }
  std::vector<ReducedPlace>& reduced_set = sets[set];
  reduced_set.resize(further.size());
  for (std::size_t i = 0; i < further.size(); ++i)
    jobs.emplace_back([&, i] {
      reduced_set[i] = reduced(further[i], false, kept_->basis, kept_->factor, total_mass_kg);
      reduced_set[i].columns = own[i];
    });
  parallel_for(jobs.size(), [&](std::size_t i) { jobs[i](); });
  if (v.cols() == before) return;
  sensors = structure.sensors(v);
  load_tests = projected(structure.load_tests, v);
  mode_coordinates.conservativeResizeLike(MatrixXd::Zero(v.cols(), mode_coordinates.cols()));  // modes are common vectors
}

}  // namespace twindeck::diagnosis
