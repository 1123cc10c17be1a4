#include "test_folder.hpp"

namespace twindeck::model_io::test {

fe::Model one_of_everything() {
  fe::Model m;
  m.title = "one of everything, \"quoted\"";
  m.gravity_m_s2 = 9.80665;
  m.formulation = {false, false, false, fe::Formulation::Drilling::diagonal, 0.03, true};
  m.prestress = {fe::PullRule::shape_finding, false, 25e3, 2e-3, 0.25, {{1, 2}, {2, 0}}, fe::Displacements::large, 7};
  m.nodes = {{1, {0.0, 0.0, 0.0}}, {2, {1.0 / 3.0, 0.0, 0.0}}, {5, {1.0, 1.0, 0.1}}, {7, {0.0, 1.0, 0.0}}};
  m.materials = {{"steel", 210e9, 210e9 / 2.6, 0.3, 7850.0}, {"concrete, light", 20e9, 20e9 / 2.4, 0.2, 1500.0}};
  fe::Section tube;
  tube.name = "tube";
  tube.area_m2 = 0.01;
  tube.inertia_y_m4 = 1e-5 / 3.0;
  tube.inertia_z_m4 = 2e-5;
  tube.inertia_yz_m4 = -1e-6;
  tube.torsion_m4 = 3e-5;
  tube.shear_area_y_m2 = 0.004;
  tube.shear_area_z_m2 = 0.005;
  fe::Section slab;
  slab.name = "slab";
  slab.thickness_m = 0.0617;
  slab.bending_inertia_ratio = 1.25;
  slab.shear_thickness_ratio = 0.8;
  m.sections = {tube, slab};
  fe::Element beam;
  beam.id = 10;
  beam.group = "chord";
  beam.material = 0;
  beam.section = 0;
  beam.nodes = {0, 1};
  beam.orientation = {0.0, 0.6, 0.8};
  beam.offset_m = {Eigen::Vector3d(0.0, 0.0, 0.1), Eigen::Vector3d(0.0, 0.0, 0.2)};
  beam.releases = 0b110000000000;
  fe::Element stay;
  stay.id = 11;
  stay.type = fe::ElementType::stay;
  stay.name = "NE8";
  stay.group = "stay_60";
  stay.material = 0;
  stay.section = 0;
  stay.nodes = {1, 2};
  stay.pull_N = 286e3;
  fe::Element bar = stay;
  bar.id = 13;
  bar.type = fe::ElementType::bar;
  bar.name = "";
  bar.pull_N = 0.0;
  fe::Element shell;
  shell.id = 12;
  shell.type = fe::ElementType::shell;
  shell.group = "slab_foot_B";
  shell.material = 1;
  shell.section = 1;
  shell.nodes = {0, 1, 2, 3};
  fe::Element triangle = shell;
  triangle.id = 14;
  triangle.nodes = {1, 2, 3};
  m.elements = {beam, stay, bar, shell, triangle};
  m.springs = {{"C1", "damper_C", 2, -1, {0.6, 0.0, 0.8}, false, 1e6, 2e4, 3e3, true, false},
               {"turn", "bearing", 0, 3, Eigen::Vector3d(1.0, 2.0, 3.0).normalized(), true, 5e6, 0.0, 0.0, false, true}};
  const Eigen::Matrix3d k{{1e6 / 3.0, -2e5, 0.0}, {3e5, 1e5, 7.0}, {0.0, 1.0, 4e4}};
  m.matrix_elements = {{"self_excited", "wind", {{1, 2}, {2, 4}}, 1, k, Eigen::Matrix3d::Identity() / 7.0, {}}};
  m.links = {{"eccentric", 0, 3}};
  m.constraints = {{"tie", 2, 4, {{1, 4, 1.0 / 3.0}, {0, 2, -2.0}}}};
  m.masses = {{"rail", 1, 120.5, {1.0, 2.0, 3.0}}};
  m.supports = {{"foot_north", 0, {true, true, true, false, true, false}}};
  m.parameters = {{"E_s", fe::Target::youngs_modulus, {"steel"}, "Pa", 210e9, 190e9, 220e9, 205e9},
                  {"t", fe::Target::thickness, {"slab"}, "m", 0.0617, 0.05, 0.07},
                  {"k", fe::Target::spring_stiffness, {"bearing"}, "-", 1.0, 0.1, 10.0},
                  {"rail", fe::Target::point_mass, {"rail"}, "-", 1.0, 1.0, 1.0}};
  m.monitoring_points = {{"M1", 1}, {"M2", 2}};
  return m;
}

}  // namespace twindeck::model_io::test
