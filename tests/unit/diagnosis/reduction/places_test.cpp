// Oracles: places of small matrix models by hand; sums of the parts; the farthest-point rule on points on a line.
#include <gtest/gtest.h>

#include "diagnosis/reduction/structure.hpp"
#include "unit/diagnosis/matrix_model.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::Place;
using diagnosis::PlaceOptions;
using diagnosis::Places;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<std::string> ids(const std::vector<Place>& places) {
  std::vector<std::string> out;
  for (const Place& place : places) out.push_back(place.id);
  return out;
}

MatrixModel::Part spring_part(const std::string& name, fe::Target target, int spring, double stiffness, double lower,
                              double upper) {
  VectorXd springs = VectorXd::Zero(5);
  springs[spring] = stiffness;
  return {{name, target, {}, "-", 2.0, lower, upper}, springs_in_a_row(springs)};
}

TEST(GroupPlaces, AreWhatAParameterScales) {
  // A parameter of value 2 whose part is written at 2: its place is that part, and not its derivative.
  const MatrixXd rest = springs_in_a_row(VectorXd::Constant(5, 1e6));
  const auto part = spring_part("k3", fe::Target::matrix_stiffness, 3, 4e6, 1.0, 3.0);
  const MatrixModel model(nodes_in_a_row(4), rest, MatrixXd::Identity(4, 4), {part});
  const Place group = find_places(model.structure(), {}).sets.at("groups").at(0);
  EXPECT_EQ(group.id, "group:k3");
  EXPECT_LT((MatrixXd(group.stiffness.whole()) - part.stiffness).norm(), 1e-9);
  EXPECT_EQ(group.mass.size(), 0);
  EXPECT_EQ(group.attributes.at("parameter"), 0.0);
  EXPECT_FALSE(group.attributes.contains("least_change"));  // a spring may be replaced by any other
}

TEST(GroupPlaces, OfAMaterialChangeWithinItsBounds) {
  const MatrixXd rest = springs_in_a_row(VectorXd::Constant(5, 1e6));
  const MatrixModel model(nodes_in_a_row(4), rest, MatrixXd::Identity(4, 4),
                          {spring_part("E", fe::Target::youngs_modulus, 1, 4e6, 1.6, 2.5)});
  const Place group = find_places(model.structure(), {}).sets.at("groups").at(0);
  EXPECT_DOUBLE_EQ(group.attributes.at("least_change"), 1.6 / 2.5);
  EXPECT_DOUBLE_EQ(group.attributes.at("most_change"), 2.5 / 1.6);
}

/// Two nodes: one with all translations and a rotation, one with z alone.
std::vector<fe::DofLabel> mixed_dofs() {
  const Eigen::Vector3d a(1, 2, 3), b(4, 5, 6);
  return {{"a", 0, a}, {"a", 1, a}, {"a", 2, a}, {"a", 3, a}, {"b", 2, b}};
}

TEST(NodePlaces, OfAMatrixModelHaveTheirTranslationsAndMasses) {
  const VectorXd mass = (VectorXd(5) << 10, 20, 30, 40, 50).finished();
  const MatrixModel model(mixed_dofs(), MatrixXd::Identity(5, 5), mass.asDiagonal());
  const Places places = find_places(model.structure(), {});
  const auto& nodes = places.sets.at("nodes");
  ASSERT_EQ(ids(nodes), (std::vector<std::string>{"node:a", "node:b"}));
  EXPECT_EQ(nodes[0].x_m, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(MatrixXd(nodes[0].directions), MatrixXd(MatrixXd::Identity(5, 5).leftCols(3)));
  EXPECT_EQ(MatrixXd(nodes[1].directions), MatrixXd(MatrixXd::Identity(5, 5).col(4)));
  EXPECT_EQ(MatrixXd(nodes[0].mass.whole()), MatrixXd(VectorXd((VectorXd(5) << 10, 20, 30, 0, 0).finished()).asDiagonal()));
  // In x are 10 kg, in y 20 kg, in z 80 kg: some directions have no dofs at some nodes. The rotary inertia counts nowhere.
  EXPECT_EQ(places.total_mass_kg, 80.0);
}

TEST(NodePlaces, OfManyNodesAreTheMeasuredOnes) {
  const MatrixModel model(nodes_in_a_row(6), springs_in_a_row(VectorXd::Ones(7)), MatrixXd::Identity(6, 6));
  diagnosis::Structure structure = model.structure();
  structure.sensor_nodes = {"2", "5", ""};
  PlaceOptions options;
  options.max_nodes = 5;
  EXPECT_EQ(ids(find_places(structure, options).sets.at("nodes")), (std::vector<std::string>{"node:2", "node:5"}));
  options.max_nodes = 6;
  EXPECT_EQ(find_places(structure, options).sets.at("nodes").size(), 6U);
}

TEST(GlobalPlace, IsTheWholeMatrixModel) {
  const MatrixXd k = springs_in_a_row((VectorXd(5) << 1, 2, 3, 4, 5).finished()), m = 7.0 * MatrixXd::Identity(4, 4);
  const MatrixModel model(nodes_in_a_row(4), k, m);
  const Place global = find_places(model.structure(), {}).sets.at("global").at(0);
  EXPECT_EQ(MatrixXd(global.stiffness.whole()), k);
  EXPECT_EQ(MatrixXd(global.mass.whole()), m);
  EXPECT_EQ(global.attributes.at("total_mass"), 28.0);
}

TEST(Nearest, IsTheFirstOfEqualsAndNoneOfNone) {
  EXPECT_EQ(diagnosis::nearest({{0, 0, 0}, {2, 0, 0}}, {1, 0, 0}), 0);
  EXPECT_EQ(diagnosis::nearest({{0, 0, 0}, {2, 0, 0}}, {1.01, 0, 0}), 1);
  EXPECT_EQ(diagnosis::nearest({}, {1, 0, 0}), -1);
}

}  // namespace
}  // namespace twindeck::tests
