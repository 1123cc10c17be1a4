// Oracle: shapes of dense matrices, each scaled to the largest motion of its mode.
#include "diagnosis/splitting_measurement.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "unit/diagnosis/prediction/hand_made.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::Scored;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kNodes = 5;

MatrixXd row_of_springs() { return springs_in_a_row((VectorXd(6) << 2.0e6, 1.6e6, 2.4e6, 1.8e6, 2.2e6, 1.9e6).finished()); }
MatrixXd row_of_masses(int node, double kg) {
  MatrixXd m = 1000.0 * MatrixXd::Identity(kNodes, kNodes);
  if (node > 0) m(node - 1, node - 1) += kg;
  return m;
}

/// |phi| of each mode over its largest (nodes × modes).
MatrixXd motion(int node, double kg) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(row_of_springs(), row_of_masses(node, kg));
  MatrixXd phi = eigen.eigenvectors().cwiseAbs();
  for (Index m = 0; m < phi.cols(); ++m) phi.col(m) /= phi.col(m).maxCoeff();
  return phi;
}

class TwoMasses : public testing::Test {
 protected:
  TwoMasses() : model(nodes_in_a_row(kNodes), row_of_springs(), row_of_masses(0, 0.0)) {
    model.add_frequencies(dense_hertz(row_of_springs(), row_of_masses(0, 0.0)));
  }
  [[nodiscard]] std::unique_ptr<HandMade> mass_at(int node, double kg) const {
    const std::vector<const diagnosis::ReducedPlace*> places = {model.place("nodes", fmt::format("node:{}", node))};
    return std::make_unique<HandMade>("mass.add", std::map<std::string, double>{{"mass", kg}}, places);
  }
  [[nodiscard]] std::string split(const std::vector<const HandMade*>& causes) const {
    const diagnosis::FeatureMap map = model.map();
    const std::vector<std::unique_ptr<diagnosis::Candidate>> none;
    const diagnosis::Inference inference(map, none);
    std::vector<Scored> scored(causes.size());
    std::vector<const Scored*> members;
    for (std::size_t i = 0; i < causes.size(); ++i) {
      scored[i].candidate = &causes[i]->candidate;
      members.push_back(&scored[i]);
    }
    return splitting_measurement(inference, inference.fit({}, {}), members);
  }
  Predicted model;
};

TEST_F(TwoMasses, AreToldApartWhereTheirShapesDifferMost) {
  const double kg = 150.0;
  const MatrixXd apart = (motion(1, kg) - motion(4, kg)).cwiseAbs();
  Index node = 0, mode = 0;
  const double most = apart.maxCoeff(&node, &mode);
  EXPECT_EQ(
      split({mass_at(1, kg).get(), mass_at(4, kg).get()}),
      fmt::format("the shape of mode {} at node:{} (differs by {:.1f} % of the largest)", mode + 1, node + 1, 100.0 * most));
}

TEST_F(TwoMasses, OneOrTheSameTwiceHasNothingToTellApart) {
  const auto mass = mass_at(2, 100.0), same = mass_at(2, 100.0);
  EXPECT_EQ(split({mass.get()}), "");
  EXPECT_EQ(split({mass.get(), same.get()}), "");
}

}  // namespace
}  // namespace twindeck::tests
