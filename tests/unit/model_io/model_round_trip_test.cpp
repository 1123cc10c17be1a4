/// Oracle: identity. What was written comes back equal (to the 12 digits of the files), and what was read once is written again
/// byte for byte.
#include <cmath>

#include "model_io/any_model_folder.hpp"
#include "model_io/write_model.hpp"
#include "test_folder.hpp"

namespace twindeck::model_io::test {
namespace {

const char* const kFiles[] = {"model.toml",  "nodes.csv", "elements.csv", "materials.csv", "sections.csv",   "supports.csv",
                              "springs.csv", "links.csv", "masses.csv",   "points.csv",    "constraints.csv"};

/// Half a unit in the twelfth digit.
void expect_12_digits(double a, double b) { EXPECT_LE(std::abs(a - b), 5.1e-12 * std::abs(a)) << a << " became " << b; }
void expect_12_digits(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  for (int i = 0; i < 3; ++i) expect_12_digits(a[i], b[i]);
}

TEST(ModelRoundTrip, ReturnsEveryFieldToTwelveDigits) {
  const TestFolder folder;
  const fe::Model a = one_of_everything();
  write_model(a, folder.path());
  const fe::Model b = read_model(folder.path());

  EXPECT_EQ(a.title, b.title);
  EXPECT_EQ(a.gravity_m_s2, b.gravity_m_s2);
  EXPECT_EQ(a.formulation.shear_flexible, b.formulation.shear_flexible);
  EXPECT_EQ(a.formulation.beam_rotary_inertia, b.formulation.beam_rotary_inertia);
  EXPECT_EQ(a.formulation.shell_rotary_inertia, b.formulation.shell_rotary_inertia);
  EXPECT_EQ(a.formulation.drilling, b.formulation.drilling);
  EXPECT_EQ(a.formulation.drilling_factor, b.formulation.drilling_factor);
  EXPECT_EQ(a.formulation.lumped_mass, b.formulation.lumped_mass);
  EXPECT_EQ(a.prestress.displacements, b.prestress.displacements);
  EXPECT_EQ(a.prestress.load_steps, b.prestress.load_steps);
  ASSERT_EQ(b.matrix_elements.size(), 1u);
  EXPECT_EQ(b.matrix_elements[0].name, "self_excited");
  EXPECT_EQ(b.matrix_elements[0].group, "wind");
  ASSERT_EQ(b.matrix_elements[0].dofs.size(), 2u);
  EXPECT_EQ(b.matrix_elements[0].dofs[1].node, 2);
  EXPECT_EQ(b.matrix_elements[0].dofs[1].direction, 4);
  EXPECT_EQ(b.matrix_elements[0].internal, 1);
  EXPECT_EQ(b.matrix_elements[0].stiffness, a.matrix_elements[0].stiffness);  // 17 digits: to the last bit
  EXPECT_EQ(b.matrix_elements[0].damping, a.matrix_elements[0].damping);
  EXPECT_EQ(b.matrix_elements[0].mass.size(), 0);
  EXPECT_EQ(a.prestress.rule, b.prestress.rule);
  EXPECT_EQ(a.prestress.geometric_stiffness, b.prestress.geometric_stiffness);
  EXPECT_EQ(a.prestress.minimum_pull_N, b.prestress.minimum_pull_N);
  EXPECT_EQ(a.prestress.ridge, b.prestress.ridge);
  EXPECT_EQ(a.prestress.site_weight, b.prestress.site_weight);
  ASSERT_EQ(a.prestress.conditions.size(), b.prestress.conditions.size());
  for (std::size_t i = 0; i < a.prestress.conditions.size(); ++i) {
    EXPECT_EQ(a.prestress.conditions[i].node, b.prestress.conditions[i].node);
    EXPECT_EQ(a.prestress.conditions[i].dof, b.prestress.conditions[i].dof);
  }
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    EXPECT_EQ(a.nodes[i].id, b.nodes[i].id);
    expect_12_digits(a.nodes[i].x_m, b.nodes[i].x_m);
  }
  EXPECT_EQ(a.monitoring_points, b.monitoring_points);
  EXPECT_EQ(b.source, folder.path().string());
}

TEST(ModelRoundTrip, ReturnsPropertiesAndParameters) {
  const TestFolder folder;
  const fe::Model a = one_of_everything();
  write_model(a, folder.path());
  const fe::Model b = read_model(folder.path());
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t i = 0; i < a.materials.size(); ++i) {
    EXPECT_EQ(a.materials[i].name, b.materials[i].name);
    expect_12_digits(a.materials[i].youngs_modulus_Pa, b.materials[i].youngs_modulus_Pa);
    expect_12_digits(a.materials[i].shear_modulus_Pa, b.materials[i].shear_modulus_Pa);
    expect_12_digits(a.materials[i].poisson_ratio, b.materials[i].poisson_ratio);
    expect_12_digits(a.materials[i].density_kg_m3, b.materials[i].density_kg_m3);
  }
  ASSERT_EQ(a.sections.size(), b.sections.size());
  for (std::size_t i = 0; i < a.sections.size(); ++i) {
    EXPECT_EQ(a.sections[i].name, b.sections[i].name);
    for (const auto field :
         {&fe::Section::area_m2, &fe::Section::inertia_y_m4, &fe::Section::inertia_z_m4, &fe::Section::inertia_yz_m4,
          &fe::Section::torsion_m4, &fe::Section::shear_area_y_m2, &fe::Section::shear_area_z_m2, &fe::Section::thickness_m,
          &fe::Section::bending_inertia_ratio, &fe::Section::shear_thickness_ratio}) {
      expect_12_digits(a.sections[i].*field, b.sections[i].*field);
    }
  }
  ASSERT_EQ(a.parameters.size(), b.parameters.size());
  for (std::size_t i = 0; i < a.parameters.size(); ++i) {
    EXPECT_EQ(a.parameters[i].name, b.parameters[i].name);
    EXPECT_EQ(a.parameters[i].target, b.parameters[i].target);
    EXPECT_EQ(a.parameters[i].of, b.parameters[i].of);
    EXPECT_EQ(a.parameters[i].unit, b.parameters[i].unit);
    EXPECT_EQ(a.parameters[i].initial, b.parameters[i].initial);
    EXPECT_EQ(a.parameters[i].lower, b.parameters[i].lower);
    EXPECT_EQ(a.parameters[i].upper, b.parameters[i].upper);
    EXPECT_EQ(a.parameters[i].nominal, b.parameters[i].nominal);
  }
}

TEST(ModelRoundTrip, ReturnsElementsAndWhatHangsOnThem) {
  const TestFolder folder;
  const fe::Model a = one_of_everything();
  write_model(a, folder.path());
  const fe::Model b = read_model(folder.path());
  ASSERT_EQ(a.elements.size(), b.elements.size());
  for (std::size_t i = 0; i < a.elements.size(); ++i) {
    const auto &e = a.elements[i], &f = b.elements[i];
    EXPECT_EQ(e.id, f.id);
    EXPECT_EQ(e.type, f.type);
    EXPECT_EQ(e.name, f.name);
    EXPECT_EQ(e.group, f.group);
    EXPECT_EQ(e.material, f.material);
    EXPECT_EQ(e.section, f.section);
    EXPECT_EQ(e.nodes, f.nodes);
    expect_12_digits(e.orientation, f.orientation);
    expect_12_digits(e.offset_m[0], f.offset_m[0]);
    expect_12_digits(e.offset_m[1], f.offset_m[1]);
    EXPECT_EQ(e.releases, f.releases);
    EXPECT_EQ(e.pull_N, f.pull_N);
  }
  ASSERT_EQ(a.springs.size(), b.springs.size());
  for (std::size_t i = 0; i < a.springs.size(); ++i) {
    const auto &s = a.springs[i], &t = b.springs[i];
    EXPECT_EQ(s.name, t.name);
    EXPECT_EQ(s.group, t.group);
    EXPECT_EQ(s.node, t.node);
    EXPECT_EQ(s.node2, t.node2);
    expect_12_digits(s.direction, t.direction);
    EXPECT_EQ(s.rotation, t.rotation);
    EXPECT_EQ(s.stiffness, t.stiffness);
    EXPECT_EQ(s.damping, t.damping);
    EXPECT_EQ(s.friction_N, t.friction_N);
    EXPECT_EQ(s.series, t.series);
    EXPECT_EQ(s.active, t.active);
  }
  ASSERT_EQ(b.links.size(), 1u);
  EXPECT_EQ(a.links[0].name, b.links[0].name);
  EXPECT_EQ(a.links[0].master, b.links[0].master);
  EXPECT_EQ(a.links[0].slave, b.links[0].slave);
  ASSERT_EQ(b.constraints.size(), 1u);
  EXPECT_EQ(b.constraints[0].name, "tie");
  EXPECT_EQ(b.constraints[0].node, 2);
  EXPECT_EQ(b.constraints[0].direction, 4);
  ASSERT_EQ(b.constraints[0].terms.size(), 2u);
  EXPECT_EQ(b.constraints[0].terms[1].node, 0);
  EXPECT_EQ(b.constraints[0].terms[1].direction, 2);
  expect_12_digits(b.constraints[0].terms[0].factor, 1.0 / 3.0);
  ASSERT_EQ(b.masses.size(), 1u);
  EXPECT_EQ(a.masses[0].group, b.masses[0].group);
  EXPECT_EQ(a.masses[0].node, b.masses[0].node);
  EXPECT_EQ(a.masses[0].mass_kg, b.masses[0].mass_kg);
  EXPECT_EQ(a.masses[0].inertia_kg_m2, b.masses[0].inertia_kg_m2);
  ASSERT_EQ(b.supports.size(), 1u);
  EXPECT_EQ(a.supports[0].name, b.supports[0].name);
  EXPECT_EQ(a.supports[0].node, b.supports[0].node);
  EXPECT_EQ(a.supports[0].fixed, b.supports[0].fixed);
}

TEST(ModelRoundTrip, WritesTheSameBytesAgain) {
  const TestFolder folder;
  write_model(one_of_everything(), folder.path() / "first");
  write_model(read_model(folder.path() / "first"), folder.path() / "second");
  for (const char* file : kFiles) {
    const std::string name = file, first = folder.read("first/" + name);
    EXPECT_FALSE(first.empty()) << file;
    EXPECT_EQ(first, folder.read("second/" + name)) << file;
  }
}

TEST(ModelRoundTrip, OptionalFilesAndColumnsMayBeMissing) {
  // Oracle: the defaults that fe/model.hpp documents; G = E / (2 (1 + nu)) of an isotropic material.
  const TestFolder folder;
  folder.write("model.toml", "title = \"two nodes\"\n");
  folder.write("nodes.csv", "node,x_m,y_m,z_m\n1,0,0,0\n2,1,0,0\n");
  folder.write("materials.csv", "material,youngs_modulus_Pa,poisson_ratio,density_kg_m3\nsteel,2e11,0.25,7850\n");
  folder.write("sections.csv", "section,area_m2\nrod,0.01\n");
  folder.write("elements.csv", "element,type,material,section,node1,node2\n1,bar,steel,rod,1,2\n");
  const fe::Model m = read_model(folder.path());
  EXPECT_DOUBLE_EQ(m.materials[0].shear_modulus_Pa, 0.8e11);
  EXPECT_EQ(m.sections[0].bending_inertia_ratio, 1.0);
  EXPECT_EQ(m.gravity_m_s2, 9.81);
  EXPECT_EQ(m.elements[0].releases, 0);
  EXPECT_TRUE(m.supports.empty() && m.springs.empty() && m.parameters.empty());
}

}  // namespace
}  // namespace twindeck::model_io::test
