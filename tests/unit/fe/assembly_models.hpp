#pragma once

#include <map>

#include "fe/model.hpp"
#include "linalg/sparse.hpp"

/// Small models that the tests of assembly share, with round numbers so that the expected values can be written out.
namespace twindeck::fe::test {

/// The whole of a symmetric matrix. @param lower  its lower triangle (n × n)
inline Eigen::MatrixXd full(const linalg::SparseMatrix& lower) {
  return Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
}

inline int add_node(Model& model, double x, double y, double z) {
  model.nodes.push_back({static_cast<long>(model.nodes.size()) + 1, {x, y, z}});
  return static_cast<int>(model.nodes.size()) - 1;
}

inline Element& add_element(Model& model, ElementType type, const std::string& group, int material, int section,
                            std::vector<int> nodes) {
  Element e;
  e.id = static_cast<long>(model.elements.size()) + 1;
  e.type = type;
  e.group = group;
  e.material = material;
  e.section = section;
  e.nodes = std::move(nodes);
  model.elements.push_back(e);
  return model.elements.back();
}

/// Ends of the edges that a quadratic solid has nodes on, by its corners (solid_quadratic.hpp). @param corners  4 or 8
inline std::vector<std::array<std::size_t, 2>> edges_of_solid(std::size_t corners) {
  if (corners == 4) return {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  return {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
}

/// Gives every solid of the model a node in the middle of each edge; neighbours share it.
inline void make_quadratic(Model& model) {
  std::map<std::pair<int, int>, int> middles;
  for (Element& e : model.elements) {
    if (e.type != ElementType::solid) continue;
    const std::vector<int> corners = e.nodes;
    for (const auto& [a, b] : edges_of_solid(corners.size())) {
      const auto [at, fresh] = middles.try_emplace(std::minmax({corners[a], corners[b]}), 0);
      const Eigen::Vector3d x = 0.5 * (model.nodes[slot(corners[a])].x_m + model.nodes[slot(corners[b])].x_m);
      if (fresh) at->second = add_node(model, x.x(), x.y(), x.z());
      e.nodes.push_back(at->second);
    }
  }
}

inline void fix(Model& model, int node, std::array<bool, 6> fixed = {true, true, true, true, true, true}) {
  model.supports.push_back({"s" + std::to_string(node), node, fixed});
}

/// Steel of E = 200 GPa, G = 80 GPa, 8000 kg/m3; a section of A = 0.01 m2, Iy = 4e-5, Iz = 1e-5, J = 3e-5 m4, rigid in shear.
inline Model with_steel() {
  Model model;
  model.source = "small_model";
  model.gravity_m_s2 = 10.0;
  model.formulation.beam_rotary_inertia = false;
  model.materials.push_back({"steel", 200e9, 80e9, 0.25, 8000.0});
  Section section;
  section.name = "girder";
  section.area_m2 = 0.01;
  section.inertia_y_m4 = 4e-5;
  section.inertia_z_m4 = 1e-5;
  section.torsion_m4 = 3e-5;
  model.sections.push_back(section);
  return model;
}

/// Cantilever of two beams of 2 m along X, held at the left end.
inline Model cantilever() {
  Model model = with_steel();
  for (int i = 0; i < 3; ++i) add_node(model, 2.0 * i, 0.0, 0.0);
  add_element(model, ElementType::beam, "left", 0, 0, {0, 1});
  add_element(model, ElementType::beam, "right", 0, 0, {1, 2});
  fix(model, 0);
  return model;
}

/// A plate on edge beams, of four-node shells and a triangle, with a stay, springs, a rigid link and a lumped mass: one of
/// everything.
inline Model one_of_everything() {
  Model model = with_steel();
  model.formulation.beam_rotary_inertia = true;
  model.materials.push_back({"concrete", 30e9, 12.5e9, 0.2, 2400.0});
  model.materials.push_back({"cable", 165e9, 65e9, 0.25, 8289.0});
  Section slab;
  slab.name = "slab";
  slab.thickness_m = 0.1;
  slab.bending_inertia_ratio = 2.0;
  model.sections.push_back(slab);
  Section strand;
  strand.name = "strand";
  strand.area_m2 = 1.3e-3;
  model.sections.push_back(strand);
  model.sections[0].shear_area_y_m2 = 0.006;
  model.sections[0].shear_area_z_m2 = 0.005;

  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 2; ++j) add_node(model, 3.0 * i, 2.0 * j, 0.1 * i);  // 0-5: a strip 6 m long, 2 m wide
  add_element(model, ElementType::shell, "slab", 1, 1, {0, 2, 3, 1});
  add_element(model, ElementType::shell, "slab", 1, 1, {2, 4, 5, 3});
  for (int j = 0; j < 2; ++j) {
    add_element(model, ElementType::beam, "edge", 0, 0, {j, j + 2});
    add_element(model, ElementType::beam, "edge", 0, 0, {j + 2, j + 4});
  }
  const int bracket = add_node(model, 6.0, -0.4, 0.1), head = add_node(model, -24.0, -0.4, 18.0);
  model.links.push_back({"bracket", 4, bracket});
  Element& stay = add_element(model, ElementType::stay, "stays", 2, 2, {bracket, head});
  stay.name = "N1";
  stay.pull_N = 60e3;
  add_element(model, ElementType::bar, "tie", 2, 2, {3, 4});
  const int apex = add_node(model, 8.0, 1.0, 0.2);
  add_element(model, ElementType::shell, "slab", 1, 1, {4, apex, 5});  // a triangle at the strip's end
  fix(model, 0);
  fix(model, 1);
  fix(model, head, {true, true, true, false, false, false});
  Spring bearing;
  bearing.name = "b1";
  bearing.group = "bearings";
  bearing.node = 5;
  bearing.stiffness = 2e6;
  model.springs.push_back(bearing);
  model.masses.push_back({"railing", 5, 300.0, Eigen::Vector3d(5.0, 6.0, 7.0)});

  model.prestress.rule = PullRule::given;
  const auto parameter = [&](const char* name, Target target, const char* of, const char* unit, double initial) {
    model.parameters.push_back({name, target, {of}, unit, initial, 0.5 * initial, 2.0 * initial});
  };
  parameter("E_s", Target::youngs_modulus, "steel", "Pa", 200e9);
  parameter("E_c", Target::youngs_modulus, "concrete", "Pa", 30e9);
  parameter("E_stay", Target::youngs_modulus, "cable", "Pa", 165e9);
  parameter("rho_c", Target::density, "concrete", "kg/m3", 2400.0);
  parameter("t", Target::thickness, "slab", "m", 0.1);
  parameter("RMI", Target::bending_inertia_ratio, "slab", "-", 2.0);
  parameter("A", Target::area, "girder", "m2", 0.01);
  parameter("k", Target::spring_stiffness, "bearings", "-", 1.0);
  parameter("m", Target::point_mass, "railing", "-", 1.0);
  return model;
}

}  // namespace twindeck::fe::test
