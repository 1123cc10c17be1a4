#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include "core/error.hpp"
#include "diagnosis/reduction/place_parts.hpp"
#include "diagnosis/reduction/structure.hpp"
#include "fe/term_sum.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Triplets = std::vector<Eigen::Triplet<double>>;
const Eigen::Vector3d kNowhere = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());

/// A sum of terms on both triangles. @param amounts  (n_terms)
Symmetric of_terms(const fe::ParametricSystem& system, const std::vector<fe::Term>& terms, const std::vector<double>& amounts) {
  Triplets entries;
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const double a = amounts[t];
    if (a == 0.0) continue;
    fe::for_each_entry(system.pattern, terms[t], [&](int row, int column, double value) {
      entries.emplace_back(row, column, a * value);
      if (row != column) entries.emplace_back(column, row, a * value);
    });
  }
  Symmetric matrix;
  if (entries.empty()) return matrix;
  matrix.resize(system.size(), system.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Dependence of a sum of terms on the parameters, from the coefficient of each term.
/// @param amounts  (n_terms) values in the unchanged model
ParameterLaw<CompactMatrix> law_of_terms(const fe::ParametricSystem& system, const std::vector<fe::Term>& terms,
                                         const Eigen::VectorXd& theta, const std::vector<double>& amounts) {
  ParameterLaw<CompactMatrix> law;
  std::vector<fe::Coefficient> ratios;
  std::vector<std::vector<double>> shares;  // (n_ratios × n_terms)
  for (std::size_t t = 0; t < terms.size(); ++t) {
    if (amounts[t] == 0.0) continue;
    const std::size_t at = position_of(ratio_of(terms[t].coefficient, theta), ratios);
    shares.resize(ratios.size(), std::vector<double>(terms.size(), 0.0));
    shares[at][t] = amounts[t];
  }
  if (!ratios.empty()) law.ratio = ratios.front();
  for (std::size_t i = 1; i < ratios.size(); ++i)
    law.parts.push_back({ratios[i], 1.0, CompactMatrix(of_terms(system, terms, shares[i]))});
  return law;
}

/// The same for the whole structure's stiffness or mass. A correction term that starts at zero is a part with `held` 0.
ParameterLaw<CompactMatrix> law_of_all(const fe::ParametricSystem& system, const std::vector<fe::Term>& terms,
                                       const Eigen::VectorXd& theta) {
  std::vector<double> amounts;
  for (const fe::Term& term : terms) amounts.push_back(term.coefficient.value(theta));
  ParameterLaw<CompactMatrix> law = law_of_terms(system, terms, theta, amounts);
  for (std::size_t t = 0; t < terms.size(); ++t) {
    if (amounts[t] != 0.0) continue;
    std::vector<double> alone(terms.size(), 0.0);
    alone[t] = 1.0;
    law.parts.push_back({terms[t].coefficient, 0.0, CompactMatrix(of_terms(system, terms, alone))});
  }
  return law;
}

constexpr int kMostPlaces = 200;  // locations of a kind; the time of a search grows with their number

/// Picks `count` points far from each other, beginning with the given ones (farthest-point selection). Further ones follow
/// until every point is within half a spacing of one.
std::vector<int> spread(const std::vector<Eigen::Vector3d>& points, std::vector<int> chosen, int count, double spacing_m) {
  const auto n = static_cast<int>(points.size());
  if (n <= count) {
    std::vector<int> all(points.size());
    for (int i = 0; i < n; ++i) all[static_cast<std::size_t>(i)] = i;
    return all;
  }
  if (chosen.empty()) chosen.push_back(0);
  std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
  std::size_t done = 0;
  while (true) {
    for (; done < chosen.size(); ++done)
      for (std::size_t i = 0; i < points.size(); ++i)
        distance[i] = std::min(distance[i], (points[i] - points[static_cast<std::size_t>(chosen[done])]).norm());
    const auto far = std::max_element(distance.begin(), distance.end());
    const bool is_wide = spacing_m > 0.0 && *far > 0.5 * spacing_m && static_cast<int>(chosen.size()) < kMostPlaces;
    if (!(*far > 0.0) || (static_cast<int>(chosen.size()) >= count && !is_wide)) break;
    chosen.push_back(static_cast<int>(far - distance.begin()));
  }
  return chosen;
}

std::vector<Place> group_places(const Structure& structure) {
  std::vector<Place> places;
  const fe::ParametricSystem& system = *structure.system;
  for (std::size_t p = 0; p < system.parameters.size(); ++p) {
    const double value = structure.theta[static_cast<Index>(p)];
    Place place{"group:" + system.parameters[p].name, kNowhere};
    const double scale = value != 0.0 ? value : 1.0;  // a correction term that starts at zero counts in its own unit
    const fe::Parameter& parameter = system.parameters[p];
    if (value != 0.0) place.attributes["parameter"] = static_cast<double>(p);
    // Bounds of a change between states. A material's modulus or density is uncertain within its bounds, but hardly changes.
    const bool of_material = parameter.target == fe::Target::youngs_modulus || parameter.target == fe::Target::density;
    if (of_material && parameter.lower > 0.0 && parameter.upper > parameter.lower) {
      place.attributes["least_change"] = parameter.lower / parameter.upper;
      place.attributes["most_change"] = parameter.upper / parameter.lower;
    }
    const auto scaled = [&](const std::vector<fe::Term>& terms, CompactMatrix& matrix, ParameterLaw<CompactMatrix>& law) {
      std::vector<double> amounts;
      for (const fe::Term& term : terms)
        amounts.push_back(scale * term.coefficient.derivative(structure.theta, static_cast<int>(p)));
      matrix = of_terms(system, terms, amounts);
      if (value != 0.0) law = law_of_terms(system, terms, structure.theta, amounts);
    };
    scaled(system.stiffness_terms, place.stiffness, place.stiffness_law);
    scaled(system.mass_terms, place.mass, place.mass_law);
    places.push_back(std::move(place));
  }
  return places;
}

/// Nodes of a matrix model with their translations; with their rotations if they have no translations.
std::vector<Place> matrix_nodes(const Structure& structure, const PlaceOptions& options) {
  const fe::ParametricSystem& system = *structure.system;
  std::vector<std::string> names;
  std::map<std::string, std::vector<int>> rows;
  std::map<std::string, Eigen::Vector3d> where;
  for (std::size_t i = 0; i < system.dofs.size(); ++i) {
    const fe::DofLabel& dof = system.dofs[i];
    if (!rows.contains(dof.node)) names.push_back(dof.node);
    where[dof.node] = dof.x_m;
    if (dof.direction < 3)
      rows[dof.node].push_back(static_cast<int>(i));
    else
      rows[dof.node];
  }
  std::vector<std::string> chosen;
  const std::set<std::string> measured(structure.sensor_nodes.begin(), structure.sensor_nodes.end());
  for (const std::string& name : names)
    if (static_cast<int>(names.size()) <= options.max_nodes || measured.contains(name)) chosen.push_back(name);
  const Eigen::VectorXd diagonal = system.mass(structure.theta).diagonal();
  std::vector<Place> places;
  for (const std::string& name : chosen) {
    const auto& dofs = rows.at(name);
    if (dofs.empty()) continue;
    Place place{"node:" + name, where.at(name)};
    Triplets entries;
    for (std::size_t k = 0; k < dofs.size(); ++k) entries.emplace_back(dofs[k], static_cast<int>(k), 1.0);
    place.directions.resize(system.size(), static_cast<Index>(dofs.size()));
    place.directions.setFromTriplets(entries.begin(), entries.end());
    Triplets masses;  // masses at the node, for its scatter
    for (const int dof : dofs)
      if (diagonal[dof] > 0.0) masses.emplace_back(dof, dof, diagonal[dof]);
    Symmetric mass(system.size(), system.size());
    mass.setFromTriplets(masses.begin(), masses.end());
    place.mass = mass;
    places.push_back(std::move(place));
  }
  return places;
}

std::vector<int> nearest_of(const std::vector<Eigen::Vector3d>& points, const std::vector<Eigen::Vector3d>& wanted) {
  std::vector<int> found;
  for (const Eigen::Vector3d& x : wanted) found.push_back(nearest(points, x));
  return found;
}

}  // namespace

int nearest(const std::vector<Eigen::Vector3d>& centres, const Eigen::Vector3d& x) {
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const double distance = (centres[i] - x).squaredNorm();
    if (distance < least) {
      least = distance;
      best = static_cast<int>(i);
    }
  }
  return best;
}

Places find_places(const Structure& structure, const PlaceOptions& options) {
  Places places;
  places.sets["groups"] = group_places(structure);
  Place global{"global", kNowhere};
  const Eigen::VectorXd& theta = structure.theta;
  const Eigen::VectorXd diagonal = structure.system->mass(theta).diagonal();
  std::array<double, 6> by_direction{};
  for (std::size_t i = 0; i < structure.system->dofs.size(); ++i)
    by_direction[static_cast<std::size_t>(structure.system->dofs[i].direction)] += diagonal[static_cast<Index>(i)];
  places.total_mass_kg = *std::max_element(by_direction.begin(), by_direction.begin() + 3);
  if (structure.model == nullptr) {
    places.sets["nodes"] = matrix_nodes(structure, options);
    global.stiffness = Symmetric(structure.system->stiffness(theta).selfadjointView<Eigen::Lower>());
    global.mass = Symmetric(structure.system->mass(theta).selfadjointView<Eigen::Lower>());
    global.stiffness_law = law_of_all(*structure.system, structure.system->stiffness_terms, theta);
    global.mass_law = law_of_all(*structure.system, structure.system->mass_terms, theta);
  } else {
    ElementPlaces elements(structure);
    if (options.zone_centres.empty())
      elements.add_zones(spread(elements.centroids(), {}, options.max_zones, options.zone_spacing_m), places);
    else
      elements.add_zones(nearest_of(elements.centroids(), options.zone_centres), places, options.zone_centres);
    elements.add_stays(places);
    elements.add_dampers(places);
    elements.add_supports(places);
    elements.add_groups(places);
    elements.add_support_moves(places);
    elements.add_moves(options.moves, places);
    elements.add_nodes(options.node_positions.empty() ? spread(elements.node_positions(), elements.measured_nodes(),
                                                               options.max_nodes, options.node_spacing_m)
                                                      : nearest_of(elements.node_positions(), options.node_positions),
                       places);
    elements.fill_global(global);
    Place stays{"global", kNowhere};
    for (const Place& stay : places.sets["stays"])
      stays.stiffness =
          stays.stiffness.size() == 0 ? stay.stiffness : Symmetric(stays.stiffness.whole() + stay.stiffness.whole());
    std::vector<int> all;
    for (const Place& stay : places.sets["stays"]) all.insert(all.end(), stay.elements.begin(), stay.elements.end());
    stays.stiffness_law = elements.stiffness_law(all);
    if (stays.stiffness.size() > 0) places.sets["all_stays"] = {std::move(stays)};
  }
  if (places.total_mass_kg > 0.0) global.attributes["total_mass"] = places.total_mass_kg;
  places.sets["global"] = {std::move(global)};
  return places;
}

}  // namespace twindeck::diagnosis
