#include "diagnosis/reduction/reduced_model.hpp"

#include <algorithm>
#include <functional>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "diagnosis/reduction/static_vectors.hpp"
#include "dynamics/eigenmodes.hpp"
#include "fe/term_sum.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

Symmetric symmetric_of(const fe::ParametricSystem& system, const fe::Term& term) {
  std::vector<Eigen::Triplet<double>> entries;
  fe::for_each_entry(system.pattern, term, [&](int row, int column, double value) {
    entries.emplace_back(row, column, value);
    if (row != column) entries.emplace_back(column, row, value);
  });
  Symmetric matrix(system.size(), system.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Whether a set has element scatter, so that every state needs its matrices in the coordinates of its causes.
bool is_scattered(const std::string& set) { return set == "zones" || set == "nodes" || set == "stays"; }

/// Reduces a law. Its parts are needed only where the location itself is used, never in every state.
ParameterLaw<ReducedMatrix> reduced(const ParameterLaw<CompactMatrix>& law, const std::shared_ptr<const ReducedBasis>& basis) {
  ParameterLaw<ReducedMatrix> out{law.ratio, {}};
  for (const auto& part : law.parts) out.parts.push_back({part.ratio, part.held, ReducedMatrix(part.matrix, basis, false)});
  return out;
}

/// A location in the coordinates of a basis, without its columns.
ReducedPlace reduced(const Place& place, const std::string& set, const std::shared_ptr<const ReducedBasis>& basis,
                     const StaticVectors& statics, double total_mass_kg) {
  ReducedPlace out{place.id, place.x_m, {}, {}, {}, {}, place.attributes};
  out.stiffness_law = reduced(place.stiffness_law, basis);
  out.mass_law = reduced(place.mass_law, basis);
  out.attributes.try_emplace("total_mass", total_mass_kg);
  if (place.stiffness.size() > 0) out.stiffness = ReducedMatrix(place.stiffness, basis, is_scattered(set));
  if (place.mass.size() > 0) out.mass = ReducedMatrix(place.mass, basis, is_scattered(set));
  if (place.directions.size() == 0) return out;
  out.directions = ReducedDirections(place.directions, basis, set == "dampers");
  out.attributes["k_drive"] = statics.drive_stiffness(place.directions);
  return out;
}

/// Modes of the unchanged structure; all modes if it has fewer than asked for.
dynamics::EigenModes modes_of(const Structure& structure, const ReductionOptions& options) {
  dynamics::ModalSolver solver(*structure.system);
  dynamics::EigenModes modes =
      solver.solve(structure.theta, static_cast<int>(std::min<Index>(options.modes, structure.system->size())));
  if (!modes.status.converged && modes.frequency_Hz.size() > 0)
    modes = solver.solve(structure.theta, static_cast<int>(modes.frequency_Hz.size()));
  if (modes.frequency_Hz.size() == 0) throw InputError({structure.source, 0, ""}, "has no modes: " + modes.status.message, "");
  return modes;
}

constexpr int kHeld = 1020;  ///< vectors of locations that are held at once while everything is projected to them

MatrixXd beside(const std::vector<ReducedBasis::Block>& blocks) {
  Index columns = 0, at = 0, n = 0;
  for (const ReducedBasis::Block& block : blocks) {
    columns += block.vectors->cols();
    n = std::max(n, block.vectors->rows());
  }
  MatrixXd out(n, columns);
  for (const ReducedBasis::Block& block : blocks) {
    if (block.vectors->cols() > 0) out.middleCols(at, block.vectors->cols()) = *block.vectors;
    at += block.vectors->cols();
  }
  return out;
}

/// Appends the rows of load tests in further coordinates to the present ones.
void append_coordinates(LoadTests& tests, const LoadTests& further) {
  const auto below = [](auto& to, const auto& from) {
    to.conservativeResize(to.rows() + from.rows(), Eigen::NoChange);
    to.bottomRows(from.rows()) = from;
  };
  const auto on_the_right = [](MatrixXd& to, const MatrixXd& from) {
    to.conservativeResize(Eigen::NoChange, to.cols() + from.cols());
    to.rightCols(from.cols()) = from;
  };
  below(tests.force, further.force);
  for (std::size_t g = 0; g < tests.grounds.size(); ++g) {
    below(tests.grounds[g].settle, further.grounds[g].settle);
    below(tests.grounds[g].moved, further.grounds[g].moved);
  }
  on_the_right(tests.rotation, further.rotation);
  on_the_right(tests.strain, further.strain);
  for (std::size_t g = 0; g < tests.forces.size(); ++g)
    if (tests.forces[g].ground >= 0) below(tests.forces[g].pull, further.forces[g].pull);
}

}  // namespace

struct ReducedModel::Kept {
  std::shared_ptr<StaticVectors> statics = std::make_shared<StaticVectors>();
  std::shared_ptr<ReducedBasis> basis;
  bool whole = false;  ///< V is the identity
};

struct ReducedModel::Owner {
  const Place* place;
  ReducedPlace* reduced;
  int count;  ///< most vectors
};

OnLine on_line(const std::map<std::string, double>& attributes, double position) {
  const auto x = [&](Index i) { return attributes.at("x_" + std::to_string(i)); };
  const auto stations = static_cast<Index>(attributes.at("stations"));
  OnLine out;
  while (out.first + 2 < stations && position > x(out.first + 1)) ++out.first;
  const double from = x(out.first), to = x(out.first + 1);
  out.part = std::clamp((position - from) / (to - from), 0.0, 1.0);
  return out;
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
  StaticVectors& statics = *kept_->statics;
  statics.factorize(structure);
  kept_->whole = structure.system->size() <= options.full_below;
  if (!kept_->whole) statics.make_common(structure, places, modes, options);
  kept_->basis = std::make_shared<ReducedBasis>(
      kept_->whole ? MatrixXd(MatrixXd::Identity(structure.system->size(), structure.system->size())) : statics.common());
  const MatrixXd& v = kept_->basis->common_vectors();
  common = static_cast<int>(v.cols());
  project(*structure.system, places);
  sensors = structure.sensors(v);
  load_tests = projected(structure.load_tests, v);
  // modes = V q with q from the K inner product (V is K-orthonormal), or the modes themselves.
  mode_coordinates = kept_->whole ? modes.shapes : MatrixXd(v.transpose() * (statics.stiffness() * modes.shapes));
  if (kept_->whole) return;
  std::vector<Owner> owners;
  for (const auto& [set, list] : places.sets)
    for (std::size_t i = 0; i < list.size(); ++i) {
      const bool served =
          set == "dampers" || set == "zones" || (set == "global" && list[i].directions.size() == 0);  // no own vectors
      // A support may move to any of its stations; each has its own static response.
      const int wanted = set == "support_moves" ? options.vectors_per_move : options.vectors_per_place;
      owners.push_back({&list[i], &sets.at(set)[i], served ? 0 : wanted});
    }
  add_vectors(structure, owners);
}

void ReducedModel::project(const fe::ParametricSystem& system, const Places& places) {
  // The largest jobs first, because a whole group takes as long as hundreds of locations.
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
  for (const auto& entry : places.sets) {  // clang's lambdas capture no structured binding
    const std::string& set = entry.first;
    const std::vector<Place>& list = entry.second;
    if (list.empty()) continue;
    std::vector<ReducedPlace>& reduced_set = sets[set];
    reduced_set.resize(list.size());
    for (std::size_t i = 0; i < list.size(); ++i)
      jobs.push_back({list[i].stiffness.nonZeros() + list[i].mass.nonZeros(),
                      [&, i] { reduced_set[i] = reduced(list[i], set, kept_->basis, *kept_->statics, total_mass_kg); }});
  }
  std::ranges::stable_sort(jobs, [](const Job& a, const Job& b) { return a.size > b.size; });
  parallel_for(jobs.size(), [&](std::size_t i) { jobs[i].run(); });
}

void ReducedModel::add_vectors(const Structure& structure, const std::vector<Owner>& owners) {
  std::vector<std::function<void()>> follow;
  for (std::vector<Term>* terms : {&stiffness, &mass})
    for (Term& term : *terms) follow.emplace_back([&] { term.matrix.follow_basis(); });
  for (auto& [set, list] : sets)
    for (ReducedPlace& place : list)
      follow.emplace_back([&] {
        place.stiffness.follow_basis();
        place.mass.follow_basis();
        place.directions.follow_basis();
      });
  const bool many = owners.size() > ReducedBasis::kKept;  // too many to be kept
  for (std::size_t begin = 0, end = 0; begin < owners.size(); begin = end) {
    int columns = 0;
    while (end < owners.size() && (end == begin || columns + owners[end].count <= kHeld)) columns += owners[end++].count;

    // 1. The vectors, beyond the common ones.
    std::vector<ReducedBasis::Block> blocks(end - begin);
    parallel_for(blocks.size(), [&](std::size_t i) {
      const Owner& owner = owners[begin + i];
      if (many)
        blocks[i].again = [statics = kept_->statics, compute = kept_->statics->recipe(*owner.place, owner.count)] {
          return compute();
        };
      else
        blocks[i].again = [statics = kept_->statics, place = *owner.place, count = owner.count] {
          return statics->own_vectors(place, count);
        };
      blocks[i].vectors = std::make_shared<const MatrixXd>(blocks[i].again());
    });
    const std::vector<std::vector<int>> own = kept_->basis->append(blocks);

    // 2. Everything in the new coordinates.
    parallel_for(follow.size(), [&](std::size_t i) { follow[i](); });
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      ReducedPlace& place = *owners[begin + i].reduced;
      place.columns = own[i];
      if (own[i].empty()) continue;
      const int group = kept_->basis->place_of(own[i].front()).first;
      place.stiffness.keep(group);
      place.mass.keep(group);
      for (auto* law : {&place.stiffness_law, &place.mass_law})
        for (auto& part : law->parts) part.matrix.keep(group);
      place.directions.keep(group);
    }
    const MatrixXd v = beside(blocks);
    if (v.cols() == 0) continue;  // no own vectors for these locations
    sensors.conservativeResize(Eigen::NoChange, size() + v.cols());
    sensors.rightCols(v.cols()) = structure.sensors(v);
    if (!load_tests.empty()) append_coordinates(load_tests, projected(structure.load_tests, v));
  }
}

}  // namespace twindeck::diagnosis
