// How places go with the parameters. Oracle: the places of the same model with the parameter values written into its
// materials, sections and springs, whose matrices are plain sums of element matrices.
#include "diagnosis/reduction/parameter_law.hpp"

#include <gtest/gtest.h>

#include "diagnosis/reduction/diagnosed_model.hpp"
#include "fe/assembly_parameters.hpp"
#include "unit/diagnosis/found_causes.hpp"
#include "unit/diagnosis/matrix_model.hpp"
#include "unit/fe/assembly_models.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::CompactMatrix;
using diagnosis::ParameterLaw;
using diagnosis::Place;
using diagnosis::Places;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

fe::Section plain_section(const std::string& name, double area, double thickness) {
  fe::Section section = fe::test::with_steel().sections[0];
  section.name = name;
  section.area_m2 = area;
  section.thickness_m = thickness;
  return section;
}

/// A slab of two shells with a beam along each long side, one of steel and one of a part that no parameter is of; two stays of
/// unlike pulls, bearings of one group, a clamp, and a spring between nodes in the group of the steel beams.
fe::Model small_deck() {
  fe::Model model = fe::test::with_steel();
  model.formulation.shell_rotary_inertia = true;
  model.prestress.rule = fe::PullRule::given;
  model.materials.push_back({"concrete", 30e9, 12.5e9, 0.2, 2400.0});
  model.materials.push_back({"timber", 12e9, 0.7e9, 0.3, 500.0});
  model.materials.push_back({"rope", 165e9, 60e9, 0.3, 8000.0});
  model.sections.push_back(plain_section("slab", 0.0, 0.15));
  model.sections.push_back(plain_section("rope", 2e-3, 0.0));
  for (int i = 0; i < 6; ++i) fe::test::add_node(model, 4.0 * (i % 3), 3.0 * (i / 3), 0.0);
  for (const double x : {12.0, 14.0}) fe::test::add_node(model, x, 1.0, 6.0);
  for (const int i : {0, 1}) fe::test::add_element(model, fe::ElementType::shell, "slab", 1, 1, {i, i + 1, i + 4, i + 3});
  for (const int i : {0, 1}) fe::test::add_element(model, fe::ElementType::beam, "edge", 0, 0, {i, i + 1});
  for (const int i : {3, 4}) fe::test::add_element(model, fe::ElementType::beam, "rail", 2, 0, {i, i + 1});
  for (const int i : {0, 1}) {
    fe::Element& stay = fe::test::add_element(model, fe::ElementType::stay, "ropes", 3, 2, {6 + i, 1 + i});
    stay.name = i == 0 ? "A" : "B";
    stay.pull_N = i == 0 ? 4e4 : 2e5;
    fe::test::fix(model, 6 + i);
  }
  model.springs = {spring("pad_west", "pads", 0, -1, 5e6, Vector3d::UnitZ()),
                   spring("pad_east", "pads", 2, -1, 8e6, Vector3d::UnitZ()),
                   spring("clamp", "clamps", 3, -1, 3e6, Vector3d::UnitY()), spring("joint", "rail", 4, 5, 2e5)};
  model.springs[2].rotation = true;
  fe::test::fix(model, 3, {true, true, true, false, false, false});
  fe::test::fix(model, 0, {true, true, false, false, false, false});
  model.parameters = {{"E_s", fe::Target::youngs_modulus, {"steel"}, "Pa", 200e9, 150e9, 250e9},
                      {"E_c", fe::Target::youngs_modulus, {"concrete"}, "Pa", 30e9, 20e9, 50e9},
                      {"E_r", fe::Target::youngs_modulus, {"rope"}, "Pa", 165e9, 100e9, 200e9},
                      {"rho_c", fe::Target::density, {"concrete"}, "kg/m3", 2400.0, 2000.0, 3000.0},
                      {"t", fe::Target::thickness, {"slab"}, "m", 0.15, 0.1, 0.25},
                      {"A", fe::Target::area, {"girder"}, "m2", 0.01, 0.005, 0.02},
                      {"k_pads", fe::Target::spring_stiffness, {"pads"}, "-", 1.0, 0.3, 3.0},
                      {"k_rail", fe::Target::spring_stiffness, {"rail"}, "-", 1.0, 0.3, 3.0},
                      {"k_clamp", fe::Target::spring_stiffness, {"clamps"}, "-", 1.0, 0.3, 3.0}};
  return model;
}

VectorXd moved_values() { return (VectorXd(9) << 170e9, 44e9, 120e9, 2900.0, 0.21, 0.007, 0.5, 2.2, 1.7).finished(); }

/// A model's places; stays under the pulls that the model was prepared with.
struct DeckPlaces {
  explicit DeckPlaces(const fe::Model& model, int zones = 24)
      : prepared(diagnosis::prepare_model(dynamics::from_model(model), {}, 0.1)) {
    diagnosis::PlaceOptions options;
    options.max_zones = zones;
    places = diagnosis::find_places(prepared->structure(), options);
  }
  std::shared_ptr<diagnosis::DiagnosedModel> prepared;
  Places places;
};

MatrixXd place_at(const CompactMatrix& whole, const ParameterLaw<CompactMatrix>& law, const VectorXd& theta) {
  MatrixXd sum = MatrixXd::Zero(whole.size(), whole.size());
  law.each(whole, theta, [&](double amount, const CompactMatrix& part) {
    if (part.size() > 0) sum += amount * MatrixXd(part.whole());
  });
  return sum;
}

void expect_law(const CompactMatrix& whole, const ParameterLaw<CompactMatrix>& law, const VectorXd& theta,
                const MatrixXd& expected, const std::string& id) {
  ASSERT_EQ(whole.size(), expected.rows()) << id;
  if (whole.size() == 0) return;
  EXPECT_LT((place_at(whole, law, theta) - expected).norm(), 1e-9 * expected.norm()) << id;
  std::map<int, MatrixXd> slope;
  law.each_slope(whole, theta, [&](int p, double amount, const CompactMatrix& part) {
    const auto [sum, is_new] = slope.try_emplace(p, MatrixXd::Zero(whole.size(), whole.size()));
    sum->second += amount * MatrixXd(part.whole());
  });
  for (Index p = 0; p < theta.size(); ++p) {
    const VectorXd step = 1e-4 * theta[p] * VectorXd::Unit(theta.size(), p);  // the error of a difference is 1e-8 of the value
    const MatrixXd difference = (place_at(whole, law, theta + step) - place_at(whole, law, theta - step)) / 2e-4;
    const auto found = slope.find(static_cast<int>(p));
    const MatrixXd exact = found == slope.end() ? MatrixXd(MatrixXd::Zero(whole.size(), whole.size())) : found->second;
    EXPECT_LT((theta[p] * exact - difference).norm(), 1e-7 * expected.norm()) << id << " by parameter " << p;
  }
}

/// Every place of some sets goes to its matrices in the model with these values.
void expect_places(const DeckPlaces& here, const DeckPlaces& there, const VectorXd& theta,
                   const std::vector<std::string>& sets) {
  for (const std::string& set : sets) {
    ASSERT_TRUE(here.places.sets.contains(set)) << set;
    const auto &list = here.places.sets.at(set), &others = there.places.sets.at(set);
    ASSERT_EQ(list.size(), others.size()) << set;
    for (std::size_t i = 0; i < list.size(); ++i) {
      ASSERT_EQ(list[i].id, others[i].id);
      // What stands for a rigid support follows what it holds when the model is prepared. A modulus acts on a stay with sag
      // to first order alone.
      if (list[i].id.starts_with("support:s") || list[i].id == "group:E_r") continue;
      expect_law(list[i].stiffness, list[i].stiffness_law, theta, others[i].stiffness.whole(), list[i].id + " stiffness");
      if (list[i].mass.size() > 0)
        expect_law(list[i].mass, list[i].mass_law, theta, others[i].mass.whole(), list[i].id + " mass");
    }
  }
}

TEST(ParameterLaw, OfPlacesIsWhatTheirElementsAndSpringsBecome) {
  const fe::Model model = small_deck();
  const fe::Model other = fe::with_parameters(model, moved_values());
  for (const int zones : {24, 2, 1})
    expect_places(DeckPlaces(model, zones), DeckPlaces(other, zones), moved_values(),
                  {"elements", "stays", "all_stays", "supports", "foundations", "global"});
}

TEST(ParameterLaw, OfGroupsIsWhatTheirElementsAndSpringsBecome) {
  // "rail" is beams of a material and springs, each with a parameter of its own; a parameter's own place has its powers.
  const DeckPlaces here(small_deck()), there(fe::with_parameters(small_deck(), moved_values()));
  expect_places(here, there, moved_values(), {"groups"});
}

TEST(ParameterLaw, HasPartsOnlyWhereAPlaceIsMixed) {
  const DeckPlaces found(small_deck());
  for (const Place& support : found.places.sets.at("supports")) EXPECT_TRUE(support.stiffness_law.parts.empty()) << support.id;
  for (const Place& stay : found.places.sets.at("stays")) EXPECT_TRUE(stay.stiffness_law.parts.empty()) << stay.id;
  for (const Place& zone : found.places.sets.at("elements"))  // a slab bends with t³ and stretches with t, a beam is A and I
    EXPECT_LE(zone.stiffness_law.parts.size(), 1U) << zone.id;
  fe::Model known = small_deck();
  known.parameters.clear();
  for (const auto& [set, list] : DeckPlaces(known, 1).places.sets)
    for (const Place& place : list) {
      EXPECT_TRUE(place.stiffness_law.ratio.factors.empty() && place.stiffness_law.parts.empty()) << place.id;
      EXPECT_EQ(place.stiffness_law.ratio.base, 1.0) << place.id;
    }
}

TEST(ParameterLaw, OfAMatrixModelHasTheTermsThatStartAtZero) {
  // K = K0 + a/2 K1 + b K2 at a = 2, b = 0.
  const MatrixXd k0 = 3.0 * MatrixXd::Identity(2, 2), k1 = MatrixXd(Eigen::Vector2d(2.0, 0.0).asDiagonal());
  const MatrixXd k2 = (MatrixXd(2, 2) << 1.0, -1.0, -1.0, 1.0).finished();
  const MatrixModel model({{"1", 2, Vector3d::Zero()}, {"2", 2, Vector3d::UnitX()}}, k0, MatrixXd::Identity(2, 2),
                          {{{"a", fe::Target::matrix_stiffness, {}, "-", 2.0, 1.0, 3.0}, k1},
                           {{"b", fe::Target::matrix_stiffness, {}, "-", 1.0, -1.0, 1.0}, k2}});
  fe::ParametricSystem system = *model.structure().system;
  diagnosis::Structure structure = model.structure();
  structure.system = &system;
  structure.theta[1] = system.parameters[1].initial = 0.0;  // the matrix of b is that of b = 1
  const Places places = diagnosis::find_places(structure, {});
  const Place &all = places.sets.at("global")[0], &a = places.sets.at("groups")[0], &b = places.sets.at("groups")[1];
  const VectorXd theta = Eigen::Vector2d(2.5, 0.4);
  expect_law(all.stiffness, all.stiffness_law, theta, k0 + 1.25 * k1 + 0.4 * k2, "global");
  expect_law(a.stiffness, a.stiffness_law, theta, 1.25 * k1, "a");
  expect_law(b.stiffness, b.stiffness_law, theta, k2, "b");  // a correction is counted in its own unit
}

}  // namespace
}  // namespace twindeck::tests
