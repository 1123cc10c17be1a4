#include "aero/wind_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "aero/follow_mode.hpp"
#include "aero/polar.hpp"
#include "core/lists.hpp"
#include "core/units.hpp"
#include "fe/assembly_elements.hpp"
#include "linalg/cholesky.hpp"
#include "transient/reduced_basis.hpp"

namespace twindeck::aero {
namespace {

constexpr double kLevelTolerance = 1e-9;  ///< [-] of a set's level: far finer than it is printed
constexpr int kLevelSteps = 100;          ///< a third of them halves the bracket: enough for any

bool is_damper_of_wind(const fe::Spring& spring) { return spring.group.starts_with("damper"); }

}  // namespace

std::vector<const fe::Spring*> dampers_of(const fe::Model& model) {
  std::vector<const fe::Spring*> dampers;
  for (const fe::Spring& spring : model.springs)
    if (is_damper_of_wind(spring)) dampers.push_back(&spring);
  return dampers;
}

std::string untaken_in_words(const fe::Model& model) {
  std::vector<std::string> dashpots, friction;
  for (const fe::Spring& spring : model.springs) {
    const bool taken = is_damper_of_wind(spring);
    if (!taken && spring.active && spring.damping > 0.0) dashpots.push_back(spring.name);
    if ((taken || spring.active) && spring.friction_N > 0.0) friction.push_back(spring.name);
  }
  std::string words;
  if (!dashpots.empty())
    words =
        fmt::format("the dashpots of {} are not taken in wind: dampers are the springs of a group that begins with 'damper'",
                    fmt::join(dashpots, ", "));
  if (!friction.empty())
    words += fmt::format("{}the friction of {} is not taken in wind", words.empty() ? "" : "; ", fmt::join(friction, ", "));
  return words;
}

linalg::SparseMatrix sum_of_outer_products(const Eigen::MatrixXd& patterns, const Eigen::VectorXd& factor) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index j = 0; j < patterns.cols(); ++j) {
    std::vector<int> rows;
    for (Eigen::Index i = 0; i < patterns.rows(); ++i)
      if (patterns(i, j) != 0.0) rows.push_back(static_cast<int>(i));
    for (const int a : rows)
      for (const int b : rows)
        if (a >= b) entries.emplace_back(a, b, factor[j] * patterns(a, j) * patterns(b, j));
  }
  linalg::SparseMatrix sum(patterns.rows(), patterns.rows());
  sum.setFromTriplets(entries.begin(), entries.end());
  return sum;
}

linalg::SparseMatrix stiffness_with(const dynamics::LoadedModel& loaded, const std::vector<const fe::Spring*>& dampers) {
  linalg::SparseMatrix stiffness = loaded.system.stiffness(loaded.theta);
  std::vector<const fe::Spring*> missing;
  for (const fe::Spring* damper : dampers)
    if (!damper->active && !damper->series && damper->stiffness > 0.0) missing.push_back(damper);
  if (missing.empty()) return stiffness;
  Eigen::VectorXd spring(std::ssize(missing));
  for (std::size_t j = 0; j < missing.size(); ++j) spring[static_cast<Eigen::Index>(j)] = missing[j]->stiffness;
  stiffness += sum_of_outer_products(damper_patterns(loaded, missing), spring);
  return stiffness;
}

Eigen::MatrixXd damper_patterns(const dynamics::LoadedModel& loaded, const std::vector<const fe::Spring*>& dampers) {
  Eigen::MatrixXd nodal = Eigen::MatrixXd::Zero(loaded.system.expansion.rows(), std::ssize(dampers));
  for (std::size_t j = 0; j < dampers.size(); ++j) {
    const fe::Elongation e = fe::elongation_of(*dampers[j]);
    nodal.col(static_cast<Eigen::Index>(j))(e.dofs) = e.coefficient;
  }
  return loaded.system.expansion.transpose() * nodal;
}

std::vector<SectionAero> sections_of(const WindSettings& config, const std::vector<DeckAerodynamics>& data,
                                     const std::string& set, double level) {
  if (const std::vector<std::string> known = {"standin", "quasi_steady"}; !contains(known, set))
    throw InputError({"", 0, "sets"}, "'" + set + "' is no aerodynamic set" + did_you_mean(set, known),
                     "choose standin or quasi_steady");
  std::vector<SectionAero> sections;
  for (std::size_t i = 0; i < data.size(); ++i) {
    const DeckWind& deck = config.decks[i];
    const Polar polar = set == "standin" ? data[i].polar : data[i].polar.with_lift_slope_factor(level);
    DerivativesPtr derivatives;
    if (set == "standin") {
      TWINDECK_ASSERT(data[i].flutter != nullptr);
      derivatives = std::make_shared<DerivativeTable>(data[i].flutter->scaled(level));
    } else {
      derivatives = std::make_shared<QuasiSteady>(polar, QuasiSteady::Arms{deck.arm_drag, deck.arm_lift, deck.arm_moment});
    }
    sections.push_back({deck.name, deck.chord_m, polar, derivatives});
  }
  return sections;
}

AeroNodes aero_nodes_of(const WindSettings& config, const fe::Model* model, const std::string& source) {
  if (model == nullptr)
    throw InputError({source, 0, ""}, "is a matrix model, whose decks are not known",
                     "give a model folder with nodes and elements");
  return find_aero_nodes(*model, config.deck_names(), each_of(config.decks, &DeckWind::cross_group),
                         static_cast<int>(config.nodes_per_deck));
}

WindModel prepare_wind_model(const WindSettings& config, const dynamics::LoadedModel& loaded) {
  WindModel out;
  out.nodes = aero_nodes_of(config, loaded.fe_model(), loaded.source);
  out.strips = strips_of(out.nodes, config.deck_names(), config.wind());
  const auto shape = motions_of(out.nodes, loaded.state.displacement);
  for (std::size_t i = 0; i < out.strips.size(); ++i)
    out.strips[i].alpha_rad = config.attack_deg * radians + aero::nose_up(out.strips[i], shape[i].col(0).tail<3>());
  dynamics::ModalSolver solver(loaded.system);
  const auto n_modes = static_cast<int>(std::min<Eigen::Index>(config.n_modes, loaded.system.size()));
  out.modes = solver.solve(loaded.theta, n_modes);
  out.motions = motions_of(out.nodes, loaded.system.expand(out.modes.shapes));
  return out;
}

ReducedStructure bare_structure(const WindModel& model, double damping_ratio) {
  ReducedStructure s;
  s.omega_rad_s = model.modes.eigenvalue.cwiseSqrt();
  s.damping_ratio = Eigen::VectorXd::Constant(s.size(), damping_ratio);
  return s;
}

DampedModel reduce(const WindModel& model, const dynamics::LoadedModel& loaded, double damping_ratio,
                   const Reduction& reduction) {
  const std::vector<const fe::Spring*> dampers =
      reduction.dampers ? dampers_of(*loaded.model) : std::vector<const fe::Spring*>();
  const Eigen::MatrixXd patterns = damper_patterns(loaded, dampers);
  const linalg::SparseMatrix stiffness = stiffness_with(loaded, dampers), mass = loaded.system.mass(loaded.theta);
  linalg::Cholesky factor;
  const Status factored = factor.factorize(stiffness);
  TWINDECK_ASSERT(factored.converged);  // the modes were found with the same matrix; springs of dampers only add to it
  // Dampers are strong against modes: between their ends the structure must be able to yield as it really does.
  const Eigen::MatrixXd& modes = model.modes.shapes;
  const Eigen::MatrixXd of_dampers = transient::static_corrections(factor, mass, modes, patterns, patterns.cols());
  const Eigen::MatrixXd of_loads =
      transient::static_corrections(factor, mass, modes, reduction.patterns, reduction.static_shapes);
  const Eigen::MatrixXd of_points = transient::krylov_shapes(factor, mass, reduction.points, reduction.point_generations);
  Eigen::MatrixXd shapes(modes.rows(), of_dampers.cols() + of_loads.cols() + of_points.cols());
  shapes << of_dampers, of_loads, of_points;
  const transient::ReducedBasis basis = transient::reduced_basis(stiffness, mass, modes, shapes);

  DampedModel out;
  out.dampers = static_cast<int>(dampers.size());
  out.structure.omega_rad_s = basis.omega_rad_s;
  out.structure.damping_ratio = Eigen::VectorXd::Constant(basis.omega_rad_s.size(), damping_ratio);
  out.structure.viscous = Eigen::MatrixXd::Zero(basis.omega_rad_s.size(), basis.omega_rad_s.size());
  for (std::size_t j = 0; j < dampers.size(); ++j) {
    const Eigen::VectorXd direction = basis.vectors.transpose() * patterns.col(static_cast<Eigen::Index>(j));
    if (dampers[j]->series) {
      if (dampers[j]->stiffness == 0.0 || dampers[j]->damping == 0.0) continue;  // such a chain holds no force
      out.structure.maxwell.push_back({dampers[j]->stiffness, dampers[j]->damping, direction});
    } else {
      out.structure.viscous += dampers[j]->damping * direction * direction.transpose();
    }
  }
  out.motions = motions_of(model.nodes, loaded.system.expand(basis.vectors));
  out.vectors = basis.vectors;
  return out;
}

DampedModel with_dampers(const WindModel& model, const dynamics::LoadedModel& loaded, double damping_ratio) {
  return reduce(model, loaded, damping_ratio, {});
}

std::optional<double> fit_level(const WindSettings& config, const std::vector<DeckAerodynamics>& data, const std::string& set,
                                const WindModel& model) {
  if (config.fit_speed_m_s == 0.0) return 1.0;
  const ReducedStructure structure = bare_structure(model, config.structural_damping);
  const Deployment deployment = aero::everywhere(aero::published_yaw_rule(config.fit_model));
  const std::vector<ComplexMode> start = aero::still_air_modes(structure);
  std::vector<double> speeds;
  for (int i = 1; i <= 8; ++i) speeds.push_back(config.fit_speed_m_s * i / 8);
  // Growth of mode 1 at that speed: rises with the level.
  const auto growth = [&](double level) -> std::optional<double> {
    const AeroelasticSystem system(structure, sections_of(config, data, set, level), model.strips, model.motions, config.wind(),
                                   deployment);
    const Branch branch = aero::follow_mode(system, start.front(), 1, speeds);
    if (!branch.status.converged) return std::nullopt;
    return branch.points.back().lambda.real();
  };
  double low = 0.05, high = 20.0;
  std::optional<double> at_low = growth(low), at_high;
  for (double level = 1.0; level <= high; level *= 2.0) {
    const std::optional<double> here = growth(level);
    if (!here) return std::nullopt;
    if (*here > 0.0) {
      high = level;
      at_high = here;
      break;
    }
    low = level;
    at_low = here;
  }
  if (!at_low || !at_high || *at_low >= 0.0) return std::nullopt;
  double f_low = *at_low, f_high = *at_high;
  for (int i = 0; i < kLevelSteps && high - low > kLevelTolerance * high; ++i) {
    const double guess = i % 3 == 2 ? 0.5 * (low + high) : low - f_low * (high - low) / (f_high - f_low);
    const std::optional<double> here = growth(guess);
    if (!here) return std::nullopt;
    if (*here == 0.0) return guess;
    (*here < 0.0 ? low : high) = guess;
    (*here < 0.0 ? f_low : f_high) = *here;
    (*here < 0.0 ? f_high : f_low) *= 0.5;
  }
  return 0.5 * (low + high);
}

}  // namespace twindeck::aero
