// What is known of a structure. Oracles: hand calculations of masses, forces and deviations; central differences; symmetry in
// the displacement's sign.
#include <gtest/gtest.h>

#include <cmath>

#include "updating/structure_fit.hpp"

namespace twindeck::updating {
namespace {

using Eigen::VectorXd;

/// Two steel beams of 3 m along X, a stay of 4 m straight up from the tip, a point mass. A = 0.01 m².
fe::Model beams_and_stay() {
  fe::Model model;
  model.source = "bracket";
  model.materials.push_back({"steel", 210e9, 80e9, 0.3, 8000.0});
  fe::Section section;
  section.name = "s";
  section.area_m2 = 0.01;
  section.inertia_y_m4 = 2e-5;
  section.inertia_z_m4 = 1e-5;
  section.torsion_m4 = 1e-5;
  model.sections.push_back(section);
  model.nodes = {{1, {0.0, 0.0, 0.0}}, {2, {3.0, 0.0, 0.0}}, {3, {6.0, 0.0, 0.0}}, {4, {6.0, 0.0, 4.0}}};
  const auto add = [&](fe::ElementType type, const std::string& group, const std::string& name, std::vector<int> nodes) {
    fe::Element element;
    element.id = static_cast<long>(model.elements.size()) + 1;
    element.type = type;
    element.group = group;
    element.name = name;
    element.material = element.section = 0;
    element.nodes = std::move(nodes);
    model.elements.push_back(element);
  };
  add(fe::ElementType::beam, "deck_root", "B1", {0, 1});
  add(fe::ElementType::beam, "deck_tip", "B2", {1, 2});
  add(fe::ElementType::stay, "stays", "S1", {2, 3});
  fe::PointMass mass;
  mass.group = "deck_asphalt";
  mass.node = 1;
  mass.mass_kg = 55.0;
  model.masses.push_back(mass);
  model.prestress.conditions = {{2, 2}, {1, 1}, {1, 2}};
  return model;
}

fe::PrestressState state_of_bracket() {
  fe::PrestressState state;
  state.stay_pull_N = Eigen::Vector3d(0.0, 0.0, 7e3);
  state.displacement = VectorXd::LinSpaced(24, 0.0, 0.023);  // dof d moves by d mm
  return state;
}

// rho A L = 80 kg/m.
TEST(MassOfGroups, IsDensityTimesVolumeAndPointMasses) {
  const fe::Model model = beams_and_stay();
  EXPECT_NEAR(mass_of_groups(model, {"deck_root"}), 240.0, 1e-9);
  EXPECT_NEAR(mass_of_groups(model, {"stays"}), 320.0, 1e-9);
  EXPECT_NEAR(mass_of_groups(model, {"deck"}), 2 * 240.0 + 55.0, 1e-9);
  EXPECT_NEAR(mass_of_groups(model, {"deck", "deck_tip"}), 2 * 240.0 + 55.0, 1e-9);  // nothing counts twice
  EXPECT_EQ(mass_of_groups(model, {"eck"}), 0.0);                                    // a beginning, not a part
  EXPECT_EQ(mass_of_groups(model, {}), 0.0);
}

TEST(StaticAnswer, TakesForcesByNameAndVerticalDisplacements) {
  StructureData data;
  data.forces = {{"S1", 1.0, 1.0}};
  data.masses = {{"deck", {"deck"}, 5.0, 1.0, 1.0}};
  const StructureAnswer without = static_answer(beams_and_stay(), state_of_bracket(), data);
  ASSERT_EQ(without.force_N.size(), 1);
  EXPECT_DOUBLE_EQ(without.force_N(0), 7e3);
  EXPECT_NEAR(without.mass_kg_m(0), 535.0 / 5.0, 1e-9);
  EXPECT_EQ(without.displacement_m.size(), 0);
  data.limits = {{0.01, 0.001}};
  // Conditions at node 2 and 1 (from 0) along z: dofs 6·2 + 2 = 14 and 6·1 + 2 = 8; the one along y is none of an anchor.
  const StructureAnswer with = static_answer(beams_and_stay(), state_of_bracket(), data);
  ASSERT_EQ(with.displacement_m.size(), 2);
  EXPECT_NEAR(with.displacement_m(0), 0.014, 1e-15);
  EXPECT_NEAR(with.displacement_m(1), 0.008, 1e-15);
}

TEST(StaticAnswer, RefusesABeamAsAStayAndNamesTheNearest) {
  StructureData data;
  data.forces = {{"B1", 1.0, 1.0}};
  EXPECT_THROW((void)static_answer(beams_and_stay(), state_of_bracket(), data), InputError);
  data.forces = {{"s1", 1.0, 1.0}};
  try {
    (void)static_answer(beams_and_stay(), state_of_bracket(), data);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'S1'"), std::string::npos) << error.what();
    EXPECT_EQ(error.place().file, "bracket");
  }
}

/// Known: 2 Hz ± 1 %, 1000 N ± 50 N, 400 kg/m ± 20 kg/m, at most 10 mm with 2 mm.
StructureData known_data() {
  StructureData data;
  data.frequencies = {{3}, VectorXd::Constant(1, 2.0), 0.01};
  data.forces = {{"S1", 1000.0, 50.0}};
  data.masses = {{"deck", {"deck"}, 1.0, 400.0, 20.0}};
  data.limits = {{0.010, 0.002}};
  return data;
}

StructureAnswer answer_at(const VectorXd& v) {
  StructureAnswer out;
  out.frequency_Hz = v.segment(0, 1);
  out.force_N = v.segment(1, 1);
  out.mass_kg_m = v.segment(2, 1);
  out.displacement_m = v.segment(3, 3);
  return out;
}

VectorXd six(double a, double b, double c, double d, double e, double f) {
  return (VectorXd(6) << a, b, c, d, e, f).finished();
}

TEST(Deviations, CountStandardDeviationsWithTheirSign) {
  // 1.96 Hz is 2 % low, 1025 N half a deviation high, 370 kg/m 1.5 low; 13 mm is 1.5 deviations above the limit either way.
  const VectorXd expected = six(-2.0, 0.5, -1.5, 1.5, 1.5, 0.0);
  EXPECT_LT((deviations(answer_at(six(1.96, 1025.0, 370.0, 0.013, -0.013, -0.0099)), known_data()) - expected).norm(), 1e-12);
}

// Each row is linear in its quantity, but for the limit; so differences are exact up to rounding.
TEST(DeviationChanges, AreTheSlopesOfTheDeviations) {
  const StructureData data = known_data();
  const VectorXd at = six(1.96, 1025.0, 370.0, 0.013, -0.013, -0.002), along = six(0.3, -20.0, 11.0, 0.004, 0.003, 0.005);
  const double h = 1e-3;
  const VectorXd difference =
      (deviations(answer_at(at + h * along), data) - deviations(answer_at(at - h * along), data)) / (2.0 * h);
  const VectorXd slope = deviation_changes(answer_at(at), answer_at(along), data);
  EXPECT_LT((slope - difference).norm(), 1e-9 * difference.norm());
  EXPECT_EQ(slope(5), 0.0);  // within the limit
}

TEST(KindsOfRows, FollowTheOrderOfTheDeviations) {
  StructureData data = known_data();
  using enum DataKind;
  EXPECT_EQ(kinds_of_rows(data, 3),
            (std::vector<DataKind>{frequency, cable_force, mass, displacement, displacement, displacement}));
  data.limits.clear();
  data.frequencies.modes = {1, 4};
  EXPECT_EQ(kinds_of_rows(data, 3), (std::vector<DataKind>{frequency, frequency, cable_force, mass}));
  EXPECT_TRUE(kinds_of_rows({}, 5).empty());
}

}  // namespace
}  // namespace twindeck::updating
