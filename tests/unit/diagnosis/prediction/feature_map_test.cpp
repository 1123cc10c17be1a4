// Oracles: the transformation of rows and of their errors written out; priors by their definition; sums of dense matrices.
#include "diagnosis/prediction/feature_map.hpp"

#include <gtest/gtest.h>

#include "hand_made.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::FeatureMap;
using diagnosis::Nuisance;
using diagnosis::RowType;
using diagnosis::ScatterOptions;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRounding = 1e-14;

MatrixXd second_spring() { return springs_in_a_row((VectorXd(4) << 0, 1.5e6, 0, 0).finished()); }

/// Three masses in a row. The second spring is a parameter of value 2 with bounds 1.2 and 2.4.
std::unique_ptr<Predicted> three_masses() {
  return std::make_unique<Predicted>(
      nodes_in_a_row(3), springs_in_a_row((VectorXd(4) << 2e6, 0, 1e6, 3e6).finished()),
      MatrixXd(Eigen::Vector3d(900, 1000, 1100).asDiagonal()),
      std::vector<MatrixModel::Part>{{{"k1", fe::Target::matrix_stiffness, {}, "-", 2.0, 1.2, 2.4}, second_spring()}});
}

TEST(FeatureMapRows, AreLogarithmsWhereRatiosCount) {
  const auto model = three_masses();
  const Index f = model->add_row(RowType::frequency, "1", -1, 2.0, 0.1),
              d = model->add_row(RowType::damping, "1", -1, 0.8, 0.2);
  const Index s = model->add_row(RowType::shape, "1", 0, -0.5, 0.02), r = model->add_row(RowType::rms, "", 1, 0.03, 0.003);
  const FeatureMap map = model->map();
  EXPECT_DOUBLE_EQ(map.values()[f], std::log(2.0));
  EXPECT_DOUBLE_EQ(map.values()[d], std::log(0.8));
  EXPECT_DOUBLE_EQ(map.values()[s], -0.5);
  // Relative deviations squared; RMS rows have the 10 % of a load model beside their own.
  EXPECT_NEAR(map.covariance()(f, f), 0.05 * 0.05, kRounding);
  EXPECT_NEAR(map.covariance()(d, d), 0.25 * 0.25, kRounding);
  EXPECT_NEAR(map.covariance()(s, s), 0.02 * 0.02, kRounding);
  EXPECT_NEAR(map.covariance()(r, r), 0.1 * 0.1 + 0.1 * 0.1, kRounding);
  EXPECT_EQ(MatrixXd(map.covariance() - MatrixXd(map.covariance().diagonal().asDiagonal())).norm(), 0.0);
}

TEST(FeatureMapRows, AreNeverBetterThanTheirFloor) {
  const auto model = three_masses();
  const Index f = model->add_row(RowType::frequency, "1", -1, 2.0, 1e-6),
              d = model->add_row(RowType::damping, "1", -1, 0.8, 1e-6);
  const Index s = model->add_row(RowType::shape, "1", 0, -0.5, 1e-6), t = model->add_row(RowType::shape, "1", 1, 0.1, 1e-6);
  ScatterOptions scatter;
  scatter.frequency_floor = 0.002;
  scatter.damping_floor = 0.07;
  scatter.shape_floor = 0.03;
  const MatrixXd c = model->map(scatter).covariance();
  EXPECT_NEAR(c(f, f), 0.002 * 0.002, kRounding);
  EXPECT_NEAR(c(d, d), 0.07 * 0.07, kRounding);
  EXPECT_NEAR(c(s, s), std::pow(0.03 * 0.5, 2), kRounding);  // of the shape's largest value, whatever its sign
  EXPECT_NEAR(c(t, t), std::pow(0.03 * 0.5, 2), kRounding);
}

TEST(FeatureMapRows, NoiseScalesStatedErrorsAlone) {
  const auto model = three_masses();
  const Index f = model->add_row(RowType::frequency, "1", -1, 2.0, 0.1), r = model->add_row(RowType::rms, "", 1, 0.03, 0.003);
  ScatterOptions scatter;
  scatter.noise = 3.0;
  const MatrixXd c = model->map(scatter).covariance();
  EXPECT_NEAR(c(f, f), 9.0 * 0.05 * 0.05, kRounding);
  EXPECT_NEAR(c(r, r), 9.0 * 0.01 + 0.01, kRounding);
}

TEST(FeatureMapRows, AStatedCovarianceIsTakenInLogarithms) {
  const auto model = three_masses();
  model->add_row(RowType::frequency, "1", -1, 2.0, 0.0);
  model->add_row(RowType::frequency, "2", -1, 5.0, 0.0);
  model->features.covariance = (MatrixXd(2, 2) << 0.04, 0.03, 0.03, 0.09).finished();
  const MatrixXd c = model->map().covariance();
  EXPECT_NEAR(c(0, 0), 0.04 / 4.0, kRounding);
  EXPECT_NEAR(c(0, 1), 0.03 / 10.0, kRounding);
  EXPECT_NEAR(c(1, 1), 0.09 / 25.0, kRounding);
}

TEST(FeatureMapRows, OfLoadTestsShareTheErrorOfEveryModel) {
  // 3 % of the largest value of a type in each condition, alike for one channel under one load.
  const auto model = three_masses();
  const auto add = [&](const std::string& load, double first, double second) {
    model->features.conditions.back().load = load;
    model->add_row(RowType::static_displacement, "", 0, first, 1.0);
    model->add_row(RowType::static_displacement, "", 1, second, 1.0);
  };
  add("truck", -8.0, 2.0);
  model->add_condition("again");
  add("truck", 6.0, 3.0);
  model->add_condition("other");
  add("crowd", 5.0, 1.0);
  MatrixXd expected = MatrixXd::Identity(6, 6);
  for (const int c : {0, 1}) {
    expected(c, c) += 0.0009 * 64.0;
    expected(2 + c, 2 + c) += 0.0009 * 36.0;
    expected(4 + c, 4 + c) += 0.0009 * 25.0;
    expected(c, 2 + c) = expected(2 + c, c) = 0.0009 * 48.0;
  }
  EXPECT_LT((model->map().covariance() - expected).norm(), 1e-13);
}

const Nuisance& named(const FeatureMap& map, const std::string& name) {
  for (const Nuisance& v : map.nuisances())
    if (v.name == name) return v;
  throw std::runtime_error("no nuisance " + name);
}

/// Two modes 5 % apart at three channels; the rows of the second in this order of channels.
MatrixXd covariance_of_close_modes(const std::vector<int>& second) {
  const auto model = three_masses();
  const double low[] = {1.0, 0.6, -0.4}, high[] = {-0.5, 1.0, 0.8};
  model->add_row(RowType::frequency, "1", -1, 2.0, 0.01);
  model->add_row(RowType::frequency, "2", -1, 2.1, 0.01);
  for (const int c : {0, 1, 2}) model->add_row(RowType::shape, "1", c, low[c], 0.02);
  for (const int c : second) model->add_row(RowType::shape, "2", c, high[c], 0.02);
  return model->map().covariance();
}

// Oracle: the same rows in another order have the same covariance in that order.
TEST(CloseModes, TurnIntoEachOtherChannelByChannelInAnyOrderOfTheRows) {
  const MatrixXd sorted = covariance_of_close_modes({0, 1, 2}), shuffled = covariance_of_close_modes({2, 0, 1});
  const std::vector<int> order = {0, 1, 2, 3, 4, 7, 5, 6};
  EXPECT_LT((shuffled - sorted(order, order)).cwiseAbs().maxCoeff(), kRounding);
  EXPECT_GT(std::abs(sorted(2, 6)), 0.01);  // the turn is there
}

// Two of three channels are too few to know the turn by: the rows have their stated deviations alone.
TEST(CloseModes, DoNotTurnWhereFewChannelsAreCommon) {
  const MatrixXd c = covariance_of_close_modes({0, 2});
  for (const int r : {2, 3, 4, 5, 6}) EXPECT_NEAR(c(r, r), 0.02 * 0.02, kRounding) << r;
  EXPECT_EQ(c(2, 5), 0.0);
}

TEST(Nuisances, HaveThePriorsOfTheOptions) {
  const auto model = three_masses();
  model->add_row(RowType::frequency, "1", -1, 2.0);
  model->add_row(RowType::damping, "1", -1, 0.8);
  model->add_row(RowType::shape, "1", 2, 1.0);
  model->add_row(RowType::rms, "", 1, 0.03);
  model->add_row(RowType::psd_floor, "", 0, 1e-8);
  ScatterOptions scatter;
  scatter.fine = 2.0;
  const FeatureMap map = model->map(scatter);
  // The bounds of a parameter are two deviations to either side of their middle: a quarter of 2.4 - 1.2.
  const Nuisance& k1 = named(map, "k1");
  EXPECT_DOUBLE_EQ(k1.mean, 2.0);
  EXPECT_DOUBLE_EQ(k1.deviation, 0.3);
  EXPECT_DOUBLE_EQ(k1.lower, -0.8 / 0.3);
  EXPECT_NEAR(k1.upper, 0.4 / 0.3, 1e-12);
  EXPECT_DOUBLE_EQ(named(map, "node:2 mass").deviation, 2.0 * 0.02);
  EXPECT_DOUBLE_EQ(named(map, "channel:c2 gain").deviation, 2.0 * 0.01);
  EXPECT_DOUBLE_EQ(named(map, "channel:c1 gain").deviation, 2.0 * 0.01);
  EXPECT_THROW((void)named(map, "channel:c0 gain"), std::runtime_error);  // a noise floor says nothing of a gain
  EXPECT_DOUBLE_EQ(named(map, "mode 1 structural damping").mean, std::log(0.5));
  EXPECT_DOUBLE_EQ(named(map, "calm load level").deviation, 10.0);
  EXPECT_DOUBLE_EQ(named(map, "calm noise level").deviation, 10.0);
  EXPECT_EQ(map.nuisances().size(), 1U + 3U + 2U + 1U + 2U);
}

TEST(Nuisances, DampingIsOneOfAModeUnlessDampersOrStatesDiffer) {
  const auto count = [](const std::string& state, std::optional<bool> on, bool by_dampers) {
    const auto model = three_masses();
    model->add_row(RowType::damping, "1", -1, 0.8);
    diagnosis::Condition& second = model->add_condition("second");
    second.state = state;
    second.dampers_on = on;
    model->add_row(RowType::damping, "1", -1, 0.9);
    ScatterOptions scatter;
    scatter.damping_by_dampers = by_dampers;
    int found = 0;
    const FeatureMap map = model->map(scatter);
    for (const Nuisance& v : map.nuisances()) found += v.kind == Nuisance::Kind::mode_damping;
    return found;
  };
  EXPECT_EQ(count("reference", {}, true), 1);
  EXPECT_EQ(count("reference", true, false), 1);
  EXPECT_EQ(count("reference", true, true), 2);
  EXPECT_EQ(count("after", {}, false), 2);
}

TEST(BaseOfAMap, IsTheSumOfWhatItsUnknownsScale) {
  // The parameter at 2.3 and the second mass three deviations of 2 % heavier.
  const auto model = three_masses();
  model->add_row(RowType::frequency, "1", -1, 2.0);
  const FeatureMap map = model->map();
  VectorXd x = VectorXd::Zero(std::ssize(map.nuisances()));
  for (Index j = 0; j < x.size(); ++j) {
    if (map.nuisances()[static_cast<std::size_t>(j)].name == "k1") x[j] = 1.0;
    if (map.nuisances()[static_cast<std::size_t>(j)].name == "node:2 mass") x[j] = 3.0;
  }
  const auto [k, m] = map.matrices(map.base(x), {0, 1, 2});
  EXPECT_DOUBLE_EQ(map.base(x).theta[0], 2.3);
  const MatrixXd stiffness = springs_in_a_row((VectorXd(4) << 2e6, 2.3 / 2.0 * 1.5e6, 1e6, 3e6).finished());
  EXPECT_LT((k - stiffness).norm(), 1e-12 * stiffness.norm());
  EXPECT_LT((m - MatrixXd(Eigen::Vector3d(900, 1060, 1100).asDiagonal())).norm(), 1e-9);
}

TEST(BaseOfAMap, IsTheSameInColumnsOfALocation) {
  // Of a reduced model: matrices in the common columns and those of a node are V' K V of the whole basis.
  const int n = 70;
  const MatrixModel chain(nodes_in_a_row(n), springs_in_a_row(VectorXd::Constant(n + 1, 2e6)),
                          1000.0 * MatrixXd::Identity(n, n));
  const diagnosis::Places places =
      find_places(chain.structure(), {.max_zones = 1, .max_nodes = 99, .moves = {}, .zone_centres = {}, .node_positions = {}});
  const diagnosis::ReducedModel reduced(chain.structure(), places, {.modes = 5});
  diagnosis::FeatureSet features;
  features.conditions.emplace_back();
  features.rows.push_back({RowType::frequency, "1", -1, "", 0, 0.3, 0.01, false});
  const FeatureMap map(reduced, features, {});
  const diagnosis::ReducedPlace& node = reduced.sets.at("nodes")[30];
  std::vector<int> columns(static_cast<std::size_t>(reduced.common));
  for (int c = 0; c < reduced.common; ++c) columns[static_cast<std::size_t>(c)] = c;
  columns.insert(columns.end(), node.columns.begin(), node.columns.end());
  ASSERT_EQ(columns.size(), 6U);
  // V is orthonormal in K, and what a node shows of V is its row.
  VectorXd x = VectorXd::Zero(std::ssize(map.nuisances()));
  const auto [k, m] = map.matrices(map.base(x), columns);
  EXPECT_LT((k - MatrixXd::Identity(6, 6)).norm(), 1e-8);
  for (Index j = 0; j < x.size(); ++j)
    if (map.nuisances()[static_cast<std::size_t>(j)].name == node.id + " mass") x[j] = 2.0;
  const MatrixXd heavier = map.matrices(map.base(x), columns).second;
  const VectorXd b = node.directions.part(0, columns);
  EXPECT_LT((heavier - m - 2.0 * 0.02 * 1000.0 * b * b.transpose()).norm(), 1e-10 * m.norm());
  EXPECT_GT((heavier - m).norm(), 1e-6 * m.norm());
}

TEST(SetValues, KeepsRelativeDeviations) {
  const auto model = three_masses();
  model->add_row(RowType::frequency, "1", -1, 2.0, 0.1);
  model->add_row(RowType::shape, "1", 0, 0.7, 0.02);
  FeatureMap map = model->map();
  map.set_values(Eigen::Vector2d(std::log(4.0), -0.3));
  EXPECT_NEAR(map.features().rows[0].value, 4.0, 1e-12);
  EXPECT_NEAR(map.features().rows[0].std, 0.2, 1e-12);
  EXPECT_EQ(map.features().rows[1].value, -0.3);
  EXPECT_EQ(map.features().rows[1].std, 0.02);
  EXPECT_NEAR(map.measured_modes()[0].frequency_Hz, 4.0, 1e-12);
}

TEST(MeasuredModes, GatherTheRowsOfAModeInACondition) {
  const auto model = three_masses();
  model->add_row(RowType::shape, "1", 2, 1.0);
  model->add_row(RowType::frequency, "1", -1, 2.0);
  model->add_row(RowType::shape_imag, "1", 1, 0.1);
  model->add_condition("second");
  model->add_row(RowType::damping, "1", -1, 0.8);
  model->add_row(RowType::shape, "1", 0, 1.0);
  const FeatureMap map = model->map();
  ASSERT_EQ(map.measured_modes().size(), 2U);
  const diagnosis::MeasuredMode& first = map.measured_modes()[0];
  EXPECT_EQ(first.frequency, 1);
  EXPECT_EQ(first.damping, -1);
  EXPECT_EQ(first.real_rows, std::vector<int>{0});
  EXPECT_EQ(first.real_channels, std::vector<int>{2});
  EXPECT_EQ(first.imag_rows, std::vector<int>{2});
  EXPECT_EQ(first.imag_channels, std::vector<int>{1});
  EXPECT_EQ(map.measured_modes()[1].damping, 3);
  EXPECT_EQ(map.scales(), 3);  // a complex scale has two parts
  EXPECT_TRUE(map.same_state(0, 1));
}

}  // namespace
}  // namespace twindeck::tests
