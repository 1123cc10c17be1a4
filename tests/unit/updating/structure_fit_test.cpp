// Oracles: statics of a propped cantilever written out, masses by hand, sizes from which the data were made, and central
// differences of the whole residual.
#include "updating/structure_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numbers>

#include "fe/structure.hpp"

namespace twindeck::updating {
namespace {

using Eigen::VectorXd;

constexpr int kBeams = 8;
constexpr double kLength_m = 16.0, kArea_m2 = 0.01, kGravity = 10.0;

/// A cantilever along X with a stay from its tip straight up, weightless. Sizes: density 4000 to 12000 kg/m3, modulus 100 to
/// 300 GPa, both even in the part of the range.
fe::Model propped(const VectorXd& part) {
  fe::Model model;
  model.source = "propped";
  model.gravity_m_s2 = kGravity;
  model.formulation.shear_flexible = false;
  const double modulus_Pa = 1e11 * (1.0 + 2.0 * part[1]);
  model.materials.push_back({"steel", modulus_Pa, modulus_Pa / 2.6, 0.3, 4000.0 * (1.0 + 2.0 * part[0])});
  model.materials.push_back({"weightless", 165e9, 65e9, 0.3, 0.0});
  fe::Section section;
  section.name = "girder";
  section.area_m2 = kArea_m2;
  section.inertia_y_m4 = 4e-5;
  section.inertia_z_m4 = 1e-5;
  section.torsion_m4 = 3e-5;
  model.sections.push_back(section);
  const auto add = [&](fe::ElementType type, const std::string& group, int material, std::vector<int> nodes) {
    fe::Element element;
    element.id = static_cast<long>(model.elements.size()) + 1;
    element.type = type;
    element.group = group;
    element.material = material;
    element.section = 0;
    element.nodes = std::move(nodes);
    model.elements.push_back(element);
  };
  for (int i = 0; i <= kBeams; ++i) model.nodes.push_back({i + 1, {kLength_m / kBeams * i, 0.0, 0.0}});
  model.nodes.push_back({kBeams + 2, {kLength_m, 0.0, 10.0}});
  for (int i = 0; i < kBeams; ++i) add(fe::ElementType::beam, i < kBeams / 2 ? "deck_root" : "deck_tip", 0, {i, i + 1});
  add(fe::ElementType::stay, "stays", 1, {kBeams, kBeams + 1});
  model.elements.back().name = "S1";
  for (const int node : {0, kBeams + 1}) model.supports.push_back({"s", node, {true, true, true, true, true, true}});
  model.prestress.rule = fe::PullRule::shape_finding;
  model.prestress.minimum_pull_N = 1.0;
  model.prestress.ridge = 1e-14;
  model.prestress.conditions = {{kBeams, 2}};
  return model;
}

VectorXd two(double a, double b) { return (VectorXd(2) << a, b).finished(); }

/// Data without error of the structure at given sizes.
StructureData known_at(const VectorXd& part) {
  StructureData data;
  data.frequencies.modes = {1, 2, 4};
  data.frequencies.frequency_Hz = VectorXd::Ones(3);
  data.forces = {{"S1", 1.0, 100.0}};
  data.masses = {{"deck", {"deck"}, kLength_m, 1.0, 5.0}};
  std::vector<FittedStructure> one = {{propped, {}, data}};
  StructureFit fit(one, {{1.0, 1.0, 1.0, 1.0}, 0.01, 0.0, part});
  VectorXd r;
  EXPECT_TRUE(fit.residual(part, r));
  const StructureAnswer& answer = fit.answers().front();
  data.frequencies.frequency_Hz = answer.frequency_Hz;
  data.forces[0].force_N = answer.force_N[0];
  data.masses[0].mass_kg_m = answer.mass_kg_m[0];
  return data;
}

TEST(StructureData, ForceAndMassAreThoseOfAProppedCantilever) {
  // The tip does not move, so the stay is the prop: 3/8 w L, w = rho A g. At part (0.5, .) rho = 8000: w = 800 N/m, 80 kg/m.
  const StructureData data = known_at(two(0.5, 0.2));
  EXPECT_NEAR(data.forces[0].force_N, 3.0 / 8.0 * 800.0 * kLength_m, 1e-3);
  EXPECT_NEAR(data.masses[0].mass_kg_m, 80.0, 1e-9);
  // One half of the beams, over the whole length.
  EXPECT_NEAR(mass_of_groups(propped(two(0.5, 0.2)), {"deck_tip"}), 80.0 * kLength_m / 2.0, 1e-9);
}

TEST(StructureData, DeviationsAreInStandardDeviations) {
  StructureData data = known_at(two(0.5, 0.2));
  StructureAnswer answer;
  answer.frequency_Hz = 1.02 * data.frequencies.frequency_Hz;
  answer.force_N = VectorXd::Constant(1, data.forces[0].force_N - 150.0);
  answer.mass_kg_m = VectorXd::Constant(1, data.masses[0].mass_kg_m + 10.0);
  answer.displacement_m = two(0.008, -0.014);
  data.limits = {{0.010, 0.002}};
  VectorXd expected(7);
  expected << 2.0, 2.0, 2.0, -1.5, 2.0, 0.0, 2.0;  // 8 mm is below the limit of 10 mm, 14 mm two standard deviations above
  EXPECT_LT((deviations(answer, data) - expected).cwiseAbs().maxCoeff(), 1e-9);
  const std::vector<DataKind> kinds = kinds_of_rows(data, 2);
  ASSERT_EQ(kinds.size(), 7u);
  EXPECT_EQ(kinds[3], DataKind::cable_force);
  EXPECT_EQ(kinds[4], DataKind::mass);
  EXPECT_EQ(kinds[6], DataKind::displacement);
}

TEST(StructureData, UnknownStayAndGroupAreNamed) {
  const fe::Model model = propped(two(0.5, 0.5));
  const fe::PrestressState state = fe::find_prestress(model, fe::initial_parameters(model));
  StructureData data;
  data.forces = {{"S2", 1.0, 1.0}};
  EXPECT_THROW((void)static_answer(model, state, data), InputError);
  data.forces.clear();
  data.masses = {{"mast", {"mast"}, 1.0, 1.0, 1.0}};
  EXPECT_THROW((void)static_answer(model, state, data), InputError);
}

TEST(StructureFit, RecoversTheSizesThatMadeTheData) {
  const VectorXd truth = two(0.3, 0.7);
  const std::vector<FittedStructure> one = {{propped, {}, known_at(truth)}};
  StructureFit fit(one, {{1.0, 1.0, 1.0, 1.0}, 0.01, 0.0, two(0.5, 0.5)});
  const FitSearch found = search_fit(fit, two(0.5, 0.5), 30, [](const FitSearch&) {});
  EXPECT_LT((found.part - truth).cwiseAbs().maxCoeff(), 1e-5) << found.part.transpose();
  for (const double cost : fit.costs()) EXPECT_LT(cost, 1e-12);
}

// Half the squares of 3 x 2, 1.5 and 0.8 standard deviations, a kind each, times the square of its weight.
TEST(StructureFit, CostsAreThoseOfEachKindOfData) {
  const VectorXd part = two(0.3, 0.7);
  StructureData data = known_at(part);
  data.frequencies.frequency_Hz /= 1.02;
  data.forces[0].force_N -= 150.0;
  data.masses[0].mass_kg_m -= 4.0;
  std::vector<FittedStructure> one = {{propped, {}, data}};
  StructureFit fit(one, {{1.0, 2.0, 3.0, 1.0}, 0.01, 0.0, part});
  VectorXd r;
  ASSERT_TRUE(fit.residual(part, r));
  const double unit = 0.01;
  const auto cost = [&](DataKind kind) { return fit.costs()[static_cast<std::size_t>(kind)] / (unit * unit); };
  EXPECT_NEAR(cost(DataKind::frequency), 0.5 * 3.0 * 4.0, 1e-6);
  EXPECT_NEAR(cost(DataKind::cable_force), 0.5 * 4.0 * 2.25, 1e-6);
  EXPECT_NEAR(cost(DataKind::mass), 0.5 * 9.0 * 0.64, 1e-6);
  EXPECT_EQ(cost(DataKind::displacement), 0.0);
}

TEST(StructureFit, FrequenciesAloneLeaveTheMassOpenAndAForceSettlesIt) {
  // With a stay whose modulus follows the girder's, and without geometric stiffness, frequencies depend on E / rho alone:
  // without the pull to the start J has rank one. The force, which depends on rho, gives two.
  const auto model = [](const VectorXd& part) {
    fe::Model out = propped(part);
    out.materials[1].youngs_modulus_Pa = out.materials[0].youngs_modulus_Pa;
    out.prestress.geometric_stiffness = false;
    return out;
  };
  const VectorXd truth = two(0.3, 0.7);
  const std::vector<FittedStructure> one = {{model, {}, known_at(truth)}};
  const auto rank = [&](double force_weight) {
    StructureFit fit(one, {{1.0, force_weight, 0.0, 0.0}, 0.01, 0.0, truth});
    VectorXd r;
    EXPECT_TRUE(fit.residual(truth, r));
    Eigen::JacobiSVD<Eigen::MatrixXd> svd(fit.jacobian(truth));
    return svd.singularValues()[1] / svd.singularValues()[0];
  };
  EXPECT_LT(rank(0.0), 1e-4);
  EXPECT_GT(rank(1.0), 1e-2);
}

TEST(StructureFit, DerivativeIsThatOfTheResidual) {
  // Two stiffening data are off their known values, the tip is held up by less than it needs (an old site value), so that the
  // rows of the displacement count. The cable force is frozen in the frequencies' derivative: geometric stiffness is switched
  // off.
  const auto model = [](const VectorXd& part) {
    fe::Model out = propped(part);
    out.prestress.geometric_stiffness = false;
    out.prestress.site_weight = 0.05;
    out.elements.back().pull_N = 3000.0;
    return out;
  };
  StructureData data = known_at(two(0.3, 0.7));
  data.limits = {{1e-4, 0.01}};
  const std::vector<FittedStructure> one = {{model, {}, data}};
  StructureFit fit(one, {{1.0, 2.0, 0.5, 1.0}, 0.01, 0.02, two(0.5, 0.5)});
  const VectorXd at = two(0.4, 0.6);
  VectorXd r, above, below;
  ASSERT_TRUE(fit.residual(at, r));
  EXPECT_GT(std::abs(r[5]), 1e-3) << "the displacement is within its limit";
  const Eigen::MatrixXd j = fit.jacobian(at);
  ASSERT_EQ(j.rows(), 8);
  for (int v = 0; v < 2; ++v) {
    const double h = 1e-3;  // error of the central difference h²/6 r''' ~ 1e-6 of r
    VectorXd step = VectorXd::Zero(2);
    step[v] = h;
    ASSERT_TRUE(fit.residual(at + step, above));
    ASSERT_TRUE(fit.residual(at - step, below));
    const VectorXd difference = (above - below) / (2.0 * h);
    EXPECT_LT((j.col(v) - difference).norm(), 1e-4 * difference.norm()) << "size " << v << "\n"
                                                                        << j.col(v).transpose() << "\n"
                                                                        << difference.transpose();
  }
}

TEST(StructureFit, RatioCorrectsFrequenciesAlone) {
  const VectorXd truth = two(0.3, 0.7);
  const std::vector<FittedStructure> one = {{propped, {}, known_at(truth)}};
  StructureFit fit(one, {{1.0, 1.0, 1.0, 1.0}, 0.01, 0.0, truth});
  fit.ratio = VectorXd::Constant(3, 1.01);
  VectorXd r;
  ASSERT_TRUE(fit.residual(truth, r));
  EXPECT_NEAR(r[0], 0.01, 1e-9);
  EXPECT_NEAR(r[3], 0.0, 1e-9);
  EXPECT_NEAR(fit.frequencies()[2] / one[0].data.frequencies.frequency_Hz[2], 1.01, 1e-12);
}

}  // namespace
}  // namespace twindeck::updating
