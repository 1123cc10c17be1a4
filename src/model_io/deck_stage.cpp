#include "model_io/deck_stage.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "fe/assembly_elements.hpp"
#include "fe/beam_frame.hpp"

namespace twindeck::model_io {
namespace {

/// Four Gauss points on [0, 1]: exact for the cubic shapes times a linear load.
struct StagePoint {
  double at, weight;
};
constexpr std::array<StagePoint, 4> line_points = {{{0.069431844202973712, 0.173927422568726929},
                                                    {0.330009478207571868, 0.326072577431273071},
                                                    {0.669990521792428132, 0.326072577431273071},
                                                    {0.930568155797026288, 0.173927422568726929}}};

constexpr std::uint16_t rotations_of_first = 0b111000, rotations_of_second = 0b111000 << 6;

const Eigen::Vector3d& stage_place(const fe::Model& model, int node) { return model.nodes[static_cast<std::size_t>(node)].x_m; }

/// Area vectors ∫ N_i n dA of the facet's nodes, n of the nodes' anticlockwise turn.
std::vector<Eigen::Vector3d> area_vectors(const fe::Model& model, const std::vector<int>& nodes) {
  std::vector<Eigen::Vector3d> x;
  for (const int node : nodes) x.push_back(stage_place(model, node));
  if (nodes.size() == 3) return std::vector<Eigen::Vector3d>(3, (x[1] - x[0]).cross(x[2] - x[0]) / 6.0);
  std::vector<Eigen::Vector3d> area(4, Eigen::Vector3d::Zero());
  constexpr std::array<double, 4> xi = {-1.0, 1.0, 1.0, -1.0}, eta = {-1.0, -1.0, 1.0, 1.0};
  const double a = 1.0 / std::sqrt(3.0);
  for (std::size_t point = 0; point < 4; ++point) {
    const double r = a * xi[point], s = a * eta[point];
    Eigen::Vector3d along_r = Eigen::Vector3d::Zero(), along_s = along_r;
    for (std::size_t i = 0; i < 4; ++i) {
      along_r += 0.25 * xi[i] * (1.0 + eta[i] * s) * x[i];
      along_s += 0.25 * eta[i] * (1.0 + xi[i] * r) * x[i];
    }
    for (std::size_t i = 0; i < 4; ++i) area[i] += 0.25 * (1.0 + xi[i] * r) * (1.0 + eta[i] * s) * along_r.cross(along_s);
  }
  return area;
}

}  // namespace

void open_stage(fe::Model& model, bool large) {
  model.gravity_m_s2 = 0.0;
  model.prestress.rule = fe::PullRule::given;
  model.prestress.load_case = "static";
  model.prestress.shells_and_solids = true;
  model.prestress.displacements = large ? fe::Displacements::large : fe::Displacements::linear;
  if (large) model.prestress.load_steps = 10;
}

std::string settle_displacements(fe::Model& model) {
  if (model.prestress.displacements == fe::Displacements::linear) return "";
  const bool moves =
      std::any_of(model.prestress.loads.begin(), model.prestress.loads.end(), [](const auto& load) { return load.movement; });
  const bool strains = std::any_of(model.elements.begin(), model.elements.end(),
                                   [](const fe::Element& e) { return e.free_strain != 0.0 && e.type != fe::ElementType::bar; });
  if (model.constraints.empty() && !moves && !strains) return "";
  model.prestress.displacements = fe::Displacements::linear;
  return fmt::format(
      "the static displacements are taken as small, though the deck asks for large ones: with {} they are not "
      "computed",
      moves     ? "moved supports"
      : strains ? "temperatures or initial stresses"
                : "ties or equations");
}

void add_load(fe::Model& model, int node, int direction, double value) {
  if (value == 0.0) return;
  for (fe::Prestress::Load& load : model.prestress.loads)
    if (load.node == node && load.direction == direction && !load.movement) {
      load.value += value;
      return;
    }
  model.prestress.loads.push_back({node, direction, value, false});
}

void add_load(fe::Model& model, int node, const Eigen::Vector3d& force, const Eigen::Vector3d& moment) {
  for (int d = 0; d < 3; ++d) add_load(model, node, d, force[d]);
  for (int d = 0; d < 3; ++d) add_load(model, node, 3 + d, moment[d]);
}

void set_movement(fe::Model& model, int node, int direction, double value) {
  std::erase_if(model.prestress.loads, [&](const fe::Prestress::Load& load) {
    return load.node == node && load.direction == direction && load.movement;
  });
  if (value != 0.0) model.prestress.loads.push_back({node, direction, value, true});
}

void add_gravity(fe::Model& model, const Eigen::Vector3d& acceleration) {
  const Eigen::Vector3d sum = model.gravity_m_s2 * model.gravity_direction + acceleration;
  model.gravity_m_s2 = sum.norm();
  if (model.gravity_m_s2 > 0.0) model.gravity_direction = sum.normalized();
}

std::string add_line_load(fe::Model& model, const fe::Element& member, const LineLoad& load) {
  const bool turns = member.type == fe::ElementType::beam;
  const bool free1 = (member.releases & rotations_of_first) != 0, free2 = (member.releases & rotations_of_second) != 0;
  if (turns && free1 != free2)
    return "is loaded along its length and has a released rotation at one end, which together are not read";
  const std::array<Eigen::Vector3d, 2> arm = turns ? member.offset_m : fe::Element{}.offset_m;
  const std::array<Eigen::Vector3d, 2> ends = {stage_place(model, member.nodes[0]) + arm[0],
                                               stage_place(model, member.nodes[1]) + arm[1]};
  const double length = (ends[1] - ends[0]).norm(), part = load.to - load.from;
  const Eigen::Vector3d axis = (ends[1] - ends[0]) / length;
  std::array<Eigen::Vector3d, 2> force, moment;
  for (auto& v : {&force, &moment}) v->fill(Eigen::Vector3d::Zero());
  for (const StagePoint& point : line_points) {
    const double x = load.from + part * point.at;
    const Eigen::Vector3d q = (load.q1 + (load.q2 - load.q1) * point.at) * (point.weight * part * length);
    const Eigen::Vector3d along = axis * axis.dot(q), across = q - along;
    const bool clamped = turns && !free1;
    const double second = clamped ? x * x * (3.0 - 2.0 * x) : x;
    force[0] += (1.0 - x) * along + (1.0 - second) * across;
    force[1] += x * along + second * across;
    if (!clamped) continue;
    moment[0] += length * x * (1.0 - x) * (1.0 - x) * axis.cross(across);
    moment[1] -= length * x * x * (1.0 - x) * axis.cross(across);
  }
  for (std::size_t end = 0; end < 2; ++end)
    add_load(model, member.nodes[end], force[end], moment[end] + arm[end].cross(force[end]));
  return "";
}

void add_pressure(fe::Model& model, const std::vector<int>& nodes, double pressure) {
  const std::vector<Eigen::Vector3d> area = area_vectors(model, nodes);
  for (std::size_t i = 0; i < nodes.size(); ++i) add_load(model, nodes[i], -pressure * area[i], Eigen::Vector3d::Zero());
}

void add_traction(fe::Model& model, const std::vector<int>& nodes, const Eigen::Vector3d& direction, double traction) {
  const std::vector<Eigen::Vector3d> area = area_vectors(model, nodes);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    add_load(model, nodes[i], traction * area[i].norm() * direction, Eigen::Vector3d::Zero());
}

Eigen::Matrix3d member_axes(const fe::Model& model, const fe::Element& member) {
  return fe::beam_axes(fe::beam_geometry(model, member));
}

const std::vector<std::vector<std::size_t>>& solid_faces(std::size_t nodes) {
  static const std::vector<std::vector<std::size_t>> hexahedron = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                                   {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}},
                                                     tetrahedron = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return nodes == 8 ? hexahedron : tetrahedron;
}

void warm(fe::Element& element, double expansion_per_K, double warming_K) {
  element.free_strain += expansion_per_K * warming_K;
}

}  // namespace twindeck::model_io
