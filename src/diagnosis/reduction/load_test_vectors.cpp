#include "diagnosis/reduction/load_test_vectors.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/lists.hpp"
#include "fe/assembly_elements.hpp"
#include "fe/beam_frame.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

constexpr const char* kDirectionNames[] = {"x", "y", "z", "rx", "ry", "rz"};

/// Displacements of nodes in terms of the free degrees of freedom.
class Nodes {
 public:
  explicit Nodes(const Structure& structure) : structure_(structure), expansion_(structure.system->expansion) {}

  /// One direction of a node in terms of the free dofs, (1 × n); empty if it is held or if there is no such node.
  [[nodiscard]] RowVectorXd motion(const std::string& node, int direction) const {
    const fe::ParametricSystem& system = *structure_.system;
    if (structure_.model != nullptr) {
      const int at = position(node);
      return at < 0 ? RowVectorXd() : RowVectorXd(expansion_.row(6 * at + direction));
    }
    RowVectorXd row;
    for (std::size_t i = 0; i < system.dofs.size(); ++i) {
      if (system.dofs[i].node != node) continue;
      if (row.size() == 0) row = RowVectorXd::Zero(system.size());
      if (system.dofs[i].direction == direction) row[static_cast<Index>(i)] = 1.0;
    }
    return row;
  }

 private:
  [[nodiscard]] int position(const std::string& node) const {
    const auto& nodes = structure_.model->nodes;
    const auto at = std::ranges::find_if(nodes, [&](const fe::Node& n) { return std::to_string(n.id) == node; });
    return at == nodes.end() ? -1 : static_cast<int>(at - nodes.begin());
  }

  const Structure& structure_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> expansion_;
};

/// Displacements of all free dofs if the structure moves by one metre along a direction.
VectorXd translation(const fe::ParametricSystem& system, const Eigen::Vector3d& direction) {
  VectorXd out = VectorXd::Zero(system.size());
  for (std::size_t i = 0; i < system.dofs.size(); ++i)
    if (system.dofs[i].direction < 3) out[static_cast<Index>(i)] = direction[system.dofs[i].direction];
  return out;
}

/// Supports without the single bearings of those with several.
std::vector<Place> supports_of(const Places& places) {
  std::vector<Place> out;
  if (const auto found = places.sets.find("supports"); found != places.sets.end())
    std::ranges::copy_if(found->second, std::back_inserter(out),
                         [](const Place& place) { return !place.attributes.contains(kOneBearing); });
  return out;
}

std::string name_of_support(const Place& place) {
  static const std::string rigid = " fixed";  // appended to a support name for its rigid part, if springs have the same name
  std::string name = place.id.substr(place.id.find(':') + 1);
  if (name.ends_with(rigid)) name.resize(name.size() - rigid.size());
  return name;
}

int parameter_of(const Structure& structure, const Place& place) {
  const std::string name = name_of_support(place);
  const auto& parameters = structure.system->parameters;
  for (std::size_t p = 0; p < parameters.size(); ++p)
    if (parameters[p].target == fe::Target::spring_stiffness && contains(parameters[p].of, name)) return static_cast<int>(p);
  return -1;
}

/// Strain of a fibre by the displacements of the element's nodes (1 × 6 n_nodes), of a bar by translations alone.
RowVectorXd fibre_strain(const fe::Model& model, const fe::Element& element, const Gauge& gauge) {
  if (element.type != fe::ElementType::beam) {
    const auto ends = fe::end_nodes(model, element);
    const Eigen::Vector3d chord = ends[1] - ends[0];
    RowVectorXd row = RowVectorXd::Zero(12);
    row.segment<3>(0) = -chord.transpose() / chord.squaredNorm();
    row.segment<3>(6) = -row.segment<3>(0);
    return row;
  }
  const fe::BeamGeometry geometry = fe::beam_geometry(model, element);
  const fe::BeamStiffnessProperties properties = fe::beam_properties(model, element);
  const double length = fe::beam_length(geometry);
  const fe::Matrix12 ends = fe::beam::release_transformation(fe::beam::local_stiffness(properties, length), geometry.releases) *
                            fe::beam::end_displacements(geometry);
  const Eigen::Matrix2d shear = fe::beam::shear_parameter(properties, length);
  // The slope is quadratic along the beam, so that a central difference over its whole length is the curvature without error.
  const fe::beam::Matrix2x12 curvature = (fe::beam::shape_at(gauge.xi + 0.5, length, shear).section_slope -
                                          fe::beam::shape_at(gauge.xi - 0.5, length, shear).section_slope) /
                                         length;
  const RowVectorXd axial = (ends.row(6) - ends.row(0)) / length;
  return axial - gauge.fibre_m.transpose() * curvature * ends;
}

/// The row of a strain gauge over the free dofs.
RowVectorXd strain_row(const Structure& structure, const Gauge& gauge, const twindeck::Place& at) {
  const fe::Model* model = structure.model;
  const std::string without = "leave the channel and its rows out";
  if (model == nullptr) throw InputError(at, "names an element, but a model of matrices has none", without);
  const auto is_it = [&](const fe::Element& e) { return e.name == gauge.element || std::to_string(e.id) == gauge.element; };
  const auto element = std::ranges::find_if(model->elements, is_it);
  if (element == model->elements.end()) throw no_such_element(at, gauge.element);
  const bool line = element->type == fe::ElementType::bar || element->type == fe::ElementType::stay ||
                    (element->type == fe::ElementType::beam && element->section2 < 0);
  if (!line)
    throw InputError(
        at, fmt::format("element '{}' is no uniform beam, bar or stay: the strain of others is not computed", gauge.element),
        without);
  const RowVectorXd local = fibre_strain(*model, *element, gauge);
  const Eigen::SparseMatrix<double, Eigen::RowMajor> expansion = structure.system->expansion;
  RowVectorXd row = RowVectorXd::Zero(structure.system->size());
  for (Index i = 0; i < local.size(); ++i)
    if (local[i] != 0.0)
      row += local[i] * RowVectorXd(expansion.row(6 * element->nodes[static_cast<std::size_t>(i / 6)] + i % 6));
  return row;
}

ForceGauge force_gauge(const Structure& structure, const LoadTests& tests, const std::vector<Place>& supports,
                       const Gauge& gauge, const MatrixXd& case_moves, const twindeck::Place& at) {
  std::vector<std::string> known;
  ForceGauge out;
  for (std::size_t s = 0; s < supports.size(); ++s) {
    known.push_back(supports[s].id.substr(supports[s].id.find(':') + 1));
    if (known.back() == gauge.support) out.ground = static_cast<int>(s);
  }
  if (out.ground < 0) throw no_such_support(at, gauge.support, known);
  if (!(gauge.direction.norm() > 0.0))
    throw InputError(at, "measures a force along no direction", "give dx, dy, dz: 0, 0, 1 for what a support carries upwards");
  const Place& support = supports[static_cast<std::size_t>(out.ground)];
  out.pull = support.stiffness * translation(*structure.system, gauge.direction);
  if (!(out.pull.norm() > 0.0))
    throw InputError(at, fmt::format("support '{}' does not hold along the channel's direction", gauge.support),
                     "correct dx, dy, dz");
  out.settle = out.pull.dot(translation(*structure.system, Eigen::Vector3d::UnitZ()));
  out.moved = case_moves.transpose() * out.pull;
  TWINDECK_ASSERT(out.moved.size() == static_cast<Index>(tests.cases.size()));
  return out;
}

}  // namespace

InputError no_such_node(const twindeck::Place& at, const std::string& node) {
  return {at, fmt::format("'{}' is no node of the model", node), "name a node of its nodes.csv"};
}

InputError no_support_to_move(const twindeck::Place& at, const std::string& node, int direction) {
  return {at,
          fmt::format("no support holds node '{}' in direction {}, so that none can move it", node, kDirectionNames[direction]),
          "move the node of a support, along a direction that it holds"};
}

InputError no_such_element(const twindeck::Place& at, const std::string& element) {
  return {at, fmt::format("'{}' is no element of the model", element), "name an element of its elements.csv"};
}

InputError no_such_support(const twindeck::Place& at, const std::string& support, const std::vector<std::string>& known) {
  return {at, fmt::format("'{}' is no support of the model{}", support, did_you_mean(support, known)),
          known.empty() ? "the model has none: leave the channel and its rows out"
                        : fmt::format("name one of {}", fmt::join(known, ", "))};
}

LoadTests load_tests_of(const Structure& structure, const Places& places, const std::vector<NodalLoad>& loads,
                        const std::vector<Gauge>& gauges, const std::string& loads_file, const std::string& channels_file) {
  LoadTests out;
  for (const NodalLoad& load : loads)
    if (!contains(out.cases, load.load)) out.cases.push_back(load.load);
  if (out.empty()) return out;
  const Nodes nodes(structure);
  const std::vector<Place> supports = supports_of(places);
  const Index n = structure.system->size(), cases = static_cast<Index>(out.cases.size());
  out.force = MatrixXd::Zero(n, cases);
  MatrixXd moves = MatrixXd::Zero(n, cases);  // movements of the ground, as displacements of the free dofs that are held to it
  for (const NodalLoad& load : loads) {
    const auto c = static_cast<Index>(std::ranges::find(out.cases, load.load) - out.cases.begin());
    const twindeck::Place at{loads_file, load.line, "node"};
    const RowVectorXd motion = nodes.motion(load.node, load.direction);
    if (motion.size() == 0) throw no_such_node(at, load.node);
    if (!load.ground) {
      if (load.value != 0.0 && !(motion.norm() > 0.0))
        throw InputError(at,
                         fmt::format("node '{}' cannot move in direction {}, so that the load does nothing", load.node,
                                     kDirectionNames[load.direction]),
                         "load another node, or take the row out");
      out.force.col(c) += load.value * motion.transpose();
      continue;
    }
    const auto holds = [&](const Place& support) { return (support.stiffness * VectorXd(motion.transpose())).norm() > 0.0; };
    if (std::ranges::none_of(supports, holds)) throw no_support_to_move(at, load.node, load.direction);
    moves.col(c) += load.value / motion.squaredNorm() * motion.transpose();  // a node on a rigid arm depends on several dofs
  }
  const VectorXd up = translation(*structure.system, Eigen::Vector3d::UnitZ());
  for (const Place& support : supports)
    out.grounds.push_back({support.id, parameter_of(structure, support), support.stiffness * up, support.stiffness * moves});
  out.rotation = out.strain = MatrixXd::Zero(static_cast<Index>(gauges.size()), n);
  for (std::size_t g = 0; g < gauges.size(); ++g) {
    const Gauge& gauge = gauges[g];
    const auto at = static_cast<Index>(g);
    if (!gauge.element.empty()) out.strain.row(at) = strain_row(structure, gauge, {channels_file, gauge.line, "element"});
    out.forces.push_back(gauge.support.empty()
                             ? ForceGauge{}
                             : force_gauge(structure, out, supports, gauge, moves, {channels_file, gauge.line, "support"}));
    for (int d = 0; d < 3 && !gauge.node.empty(); ++d)
      if (const RowVectorXd turn = nodes.motion(gauge.node, 3 + d); turn.size() > 0)
        out.rotation.row(at) += gauge.direction[d] * turn;
  }
  return out;
}

}  // namespace twindeck::diagnosis
