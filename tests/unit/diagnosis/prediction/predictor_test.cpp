// Oracles: what each primitive does to channels, written out for the shapes of dense matrices; closed forms of stays and noise;
// central differences of every kind of row.
#include "diagnosis/prediction/predictor.hpp"

#include <gtest/gtest.h>

#include "hand_made.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::Cause;
using diagnosis::Nuisance;
using diagnosis::RowType;
using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr double kSame = 1e-8;  // of a shape whose largest value is of order 1: two eigensolvers

/// Nodes p and q that move in x and y, all coupled. Channels 0 to 3 are p x, p y, q x, q y.
class PlaneNodes {
 public:
  explicit PlaneNodes(const std::function<void(diagnosis::Places&)>& more = {}) : model(dofs(), stiffness(), mass(), {}, more) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(stiffness(), mass());
    hertz = eigen.eigenvalues().cwiseSqrt() / (2.0 * std::numbers::pi);
    shapes = eigen.eigenvectors();
  }
  static std::vector<fe::DofLabel> dofs() {
    return {{"p", 0, {0, 0, 0}}, {"p", 1, {0, 0, 0}}, {"q", 0, {4, 0, 0}}, {"q", 1, {4, 0, 0}}};
  }
  static MatrixXd stiffness() {
    return 1e5 * (MatrixXd(4, 4) << 20, 3, -8, 1, 3, 14, 2, -5, -8, 2, 26, 4, 1, -5, 4, 9).finished();
  }
  static MatrixXd mass() { return Eigen::Vector4d(900, 1100, 1000, 1200).asDiagonal(); }
  /// Each mode with the shape that the channels show, real or complex, times an arbitrary scale.
  void measure(const std::function<VectorXcd(Index)>& shown, bool complex) {
    const Complex scale = complex ? Complex(-20.0, 12.0) : Complex(-20.0);
    for (Index mode = 0; mode < 4; ++mode) {
      const std::string label = std::to_string(mode + 1);
      model.add_row(RowType::frequency, label, -1, hertz[mode], 0.01);
      const VectorXcd shape = scale * shown(mode);
      for (int c = 0; c < 4; ++c) model.add_row(RowType::shape, label, c, shape[c].real(), 0.02);
      for (int c = 0; complex && c < 4; ++c) model.add_row(RowType::shape_imag, label, c, shape[c].imag(), 0.02);
    }
  }
  /// Rows are predicted as measured with the cause, and not without it.
  void expect_only_with(const Cause& cause) const {
    const VectorXd y = model.map().values();
    const auto p = model.predict({cause});
    ASSERT_TRUE(p.valid);
    EXPECT_LT((p.g - y).cwiseAbs().maxCoeff(), kSame);
    EXPECT_GT((model.predict().g - y).cwiseAbs().maxCoeff(), 0.02);
  }
  VectorXd hertz;
  MatrixXd shapes;
  Predicted model;
};

TEST(ChannelCauses, AGainAndASign) {
  for (const bool sign : {false, true}) {
    PlaneNodes nodes;
    nodes.measure(
        [&](Index mode) {
          VectorXcd shape = nodes.shapes.col(mode).cast<Complex>();
          shape[1] *= sign ? -1.0 : 1.6;
          return shape;
        },
        false);
    HandMade cause(sign ? "channel.sign" : "channel.gain", {{"factor", 1.6}});
    nodes.expect_only_with(cause.on_channels({1}).cause());
  }
}

TEST(ChannelCauses, ExchangedChannelsShowEachOther) {
  PlaneNodes nodes;
  nodes.measure(
      [&](Index mode) {
        VectorXcd shape = nodes.shapes.col(mode).cast<Complex>();
        std::swap(shape[0], shape[3]);
        return shape;
      },
      false);
  HandMade cause("channel.swap", {});
  nodes.expect_only_with(cause.on_channels({0, 3}).cause());
}

TEST(ChannelCauses, ATurnedSensorShowsTheDirectionBesideIt) {
  // Channel p x turned by 25 degrees towards y; p y, whose horizontal direction beside it is -x.
  const double turn = 25.0 / 180.0 * std::numbers::pi;
  for (const int channel : {0, 1}) {
    PlaneNodes nodes;
    nodes.measure(
        [&](Index mode) {
          VectorXcd shape = nodes.shapes.col(mode).cast<Complex>();
          const Complex x = shape[0], y = shape[1];
          shape[channel] = channel == 0 ? std::cos(turn) * x + std::sin(turn) * y : std::cos(turn) * y - std::sin(turn) * x;
          return shape;
        },
        false);
    HandMade cause("channel.rotate", {{"angle", 25.0}});
    nodes.expect_only_with(cause.on_channels({channel}).cause());
  }
}

TEST(ChannelCauses, ALateChannelTurnsByItsFrequency) {
  PlaneNodes nodes;
  nodes.measure(
      [&](Index mode) {
        VectorXcd shape = nodes.shapes.col(mode).cast<Complex>();
        shape[2] *= std::exp(Complex(0.0, -2.0 * std::numbers::pi * nodes.hertz[mode] * 0.02));
        return shape;
      },
      true);
  HandMade cause("channel.delay", {{"delay", 0.02}});
  nodes.expect_only_with(cause.on_channels({2}).cause());
}

TEST(ChannelCauses, ActOnRecordsAndNoiseOfTheirChannel) {
  // A gain of 3 makes RMS and amplitudes 3 times as large, a spectral density 9 times.
  PlaneNodes nodes;
  for (int c = 0; c < 2; ++c) nodes.model.add_row(RowType::rms, "", c, 0.01, 0.001);
  for (int c = 0; c < 2; ++c) nodes.model.add_row(RowType::psd_floor, "", c, 1e-8, 1e-9);
  const VectorXd plain = nodes.model.predict().g;
  const auto change = [&](const std::string& kind) {
    HandMade cause(kind, {{"factor", 3.0}});
    return VectorXd(nodes.model.predict({cause.on_channels({1}).cause()}).g - plain);
  };
  const double ln3 = std::log(3.0);
  EXPECT_LT((change("channel.gain") - Eigen::Vector4d(0, ln3, 0, 2.0 * ln3)).norm(), 1e-12);
  EXPECT_LT((change("channel.limit") - Eigen::Vector4d(0, ln3, 0, 0)).norm(), 1e-12);
  EXPECT_LT((change("channel.floor") - Eigen::Vector4d(0, 0, 0, ln3)).norm(), 1e-12);
}

TEST(ModeCauses, AddToFrequencyAndDamping) {
  PlaneNodes nodes;
  nodes.model.features.conditions[0].amplitude_m = 0.01;
  nodes.model.features.conditions[0].wind_m_s = 8.0;
  for (Index mode = 0; mode < 4; ++mode) {
    nodes.model.add_row(RowType::frequency, std::to_string(mode + 1), -1, nodes.hertz[mode]);
    nodes.model.add_row(RowType::damping, std::to_string(mode + 1), -1, 0.5);
  }
  const VectorXd plain = nodes.model.predict().g;
  const auto change = [&](const std::string& kind, const std::map<std::string, double>& numbers, const std::string& mode) {
    HandMade cause(kind, numbers);
    cause.candidate.mode = mode;
    return VectorXd(nodes.model.predict({cause.cause()}).g - plain);
  };
  const VectorXd curved = change("frequency.amplitude", {{"curvature", -500.0}}, "2");  // 1 - 500 · 1e-4
  EXPECT_LT((curved - std::log(0.95) * VectorXd::Unit(8, 2)).norm(), 1e-12);
  const VectorXd added = change("damping.add", {{"ratio", 0.004}}, "3");  // 0.5 % becomes 0.9 %
  EXPECT_LT((added - std::log(1.8) * VectorXd::Unit(8, 5)).norm(), 1e-12);
  const VectorXd wind = change("wind.damping", {{"rate", 0.0005}}, "");  // 0.4 % more of every mode
  for (Index r = 0; r < 8; ++r) EXPECT_NEAR(wind[r], r % 2 ? std::log(1.8) : 0.0, 1e-12) << r;
}

TEST(StayRows, GoWithTheRootOfTheForce) {
  const auto with_stay = [](diagnosis::Places& places) {
    diagnosis::Place stay;
    stay.id = "stay:S1";
    stay.attributes = {{"f_cable", 1.3}};
    stay.stiffness =
        diagnosis::Symmetric((MatrixXd(4, 4) << 1e5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0).finished().sparseView());
    places.sets["stays"] = {stay};
  };
  PlaneNodes nodes(with_stay);
  nodes.model.features.rows.push_back({RowType::stay_frequency, "2", -1, "S1", 0, 2.7, 0.02, false});
  const diagnosis::ReducedPlace* stay = nodes.model.place("stays", "stay:S1");
  EXPECT_NEAR(nodes.model.predict().g[0], std::log(2.6), 1e-14);  // the second harmonic
  EXPECT_NEAR(nodes.model.predict({HandMade("stay.pull", {{"factor", 0.81}}, {stay}).cause()}).g[0], std::log(0.9 * 2.6),
              1e-14);
  EXPECT_NEAR(nodes.model.predict({HandMade("stay.frequency", {{"factor", 0.81}}, {stay}).cause()}).g[0], std::log(0.81 * 2.6),
              1e-14);
}

TEST(NodeMotion, IsTheShapeScaledToItsLargest) {
  PlaneNodes nodes;
  nodes.model.add_frequencies(nodes.hertz);
  const diagnosis::FeatureMap map = nodes.model.map();
  const auto motion = map.node_motion(map.base(VectorXd::Zero(std::ssize(map.nuisances()))), {});
  // Nodes of two directions are not told apart by x, y, z: the last direction stands. Largest over all of them.
  for (Index mode = 0; mode < 4; ++mode) {
    const VectorXd own = nodes.shapes.col(mode).cwiseAbs() / nodes.shapes.col(mode).cwiseAbs().maxCoeff();
    EXPECT_NEAR(motion.at("node:p")[mode], own[1], kSame) << mode;
    EXPECT_NEAR(motion.at("node:q")[mode], own[3], kSame) << mode;
  }
}

/// Rows of every kind on unequal masses, with a damper that is on in the second condition.
std::unique_ptr<Predicted> rows_of_every_kind() {
  const VectorXd spring = (VectorXd(5) << 2.0e6, 1.6e6, 0.0, 1.8e6, 2.2e6).finished();
  const MatrixXd part = springs_in_a_row((VectorXd(5) << 0, 0, 2.4e6, 0, 0).finished());
  auto model = std::make_unique<Predicted>(
      nodes_in_a_row(4), springs_in_a_row(spring), MatrixXd(Eigen::Vector4d(900, 1200, 1000, 800).asDiagonal()),
      std::vector<MatrixModel::Part>{{{"k2", fe::Target::matrix_stiffness, {}, "-", 1.0, 0.8, 1.2}, part}},
      [](diagnosis::Places& places) {
        diagnosis::Place damper;
        damper.id = "damper:D";
        damper.directions.resize(4, 1);
        damper.directions.insert(1, 0) = 1.0;
        damper.attributes = {{"damping", 6e3}, {"stiffness", 0.0}, {"series", 0.0}, {"always_on", 0.0}};
        places.sets["dampers"] = {damper};
      });
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(springs_in_a_row(spring) + part,
                                                                 MatrixXd(Eigen::Vector4d(900, 1200, 1000, 800).asDiagonal()));
  for (const bool damped : {false, true}) {
    if (damped) model->add_condition("damped").dampers_on = true;
    for (Index i = 0; i < 4; ++i) {
      const double hertz = std::sqrt(eigen.eigenvalues()[i]) / (2.0 * std::numbers::pi);
      const std::string label = std::to_string(i + 1);
      model->add_row(RowType::frequency, label, -1, hertz, 0.01 * hertz);
      model->add_row(RowType::damping, label, -1, damped ? 5.0 : 0.5, 0.1);
      const VectorXd shape = eigen.eigenvectors().col(i) / eigen.eigenvectors().col(i).cwiseAbs().maxCoeff();
      for (int c = 0; c < 4; ++c) model->add_row(RowType::shape, label, c, shape[c], 0.02);
      for (int c = 0; damped && c < 4; ++c) model->add_row(RowType::shape_imag, label, c, 0.02 * c, 0.02);
    }
  }
  return model;
}

/// Largest error of the slopes against central differences, of each row's largest slope. What a free scale does is taken off.
double worst_slope(const diagnosis::FeatureMap& map, const std::vector<Cause>& causes, const VectorXd& x) {
  const diagnosis::Prediction here = map.predict(map.base(x), causes, true);
  EXPECT_TRUE(here.valid);
  MatrixXd difference(here.jacobian.rows(), x.size());
  for (Index j = 0; j < x.size(); ++j) {
    constexpr double h = 1e-3;
    const auto moved = [&](double step) {
      return map.predict(map.base(x + step * VectorXd::Unit(x.size(), j)), causes, false).g;
    };
    difference.col(j) = (moved(h) - moved(-h)) / (2.0 * h);
  }
  const Eigen::HouseholderQR<MatrixXd> qr(here.scales);
  const MatrixXd q = MatrixXd(qr.householderQ()).leftCols(here.scales.cols());
  const auto beyond_scales = [&](const MatrixXd& a) { return MatrixXd(a - q * (q.transpose() * a)); };
  const MatrixXd error = beyond_scales(here.jacobian) - beyond_scales(difference);
  double worst = 0.0;
  for (Index r = 0; r < error.rows(); ++r)
    worst = std::max(worst, error.row(r).cwiseAbs().maxCoeff() / std::max(difference.row(r).cwiseAbs().maxCoeff(), 1e-3));
  return worst;
}

VectorXd somewhere(const diagnosis::FeatureMap& map) {
  VectorXd x(std::ssize(map.nuisances()));
  for (Index j = 0; j < x.size(); ++j) x[j] = 0.4 * std::cos(1.0 + static_cast<double>(j));
  return x;
}

TEST(Slopes, OfModesAreThoseOfCentralDifferences) {
  // A difference of 2e-3 prior deviations errs by some 1e-6 of the slope.
  const auto model = rows_of_every_kind();
  const diagnosis::FeatureMap map = model->map();
  EXPECT_LT(worst_slope(map, {}, somewhere(map)), 1e-4);
}

TEST(Slopes, WithCausesAreThoseOfCentralDifferences) {
  const auto model = rows_of_every_kind();
  const diagnosis::FeatureMap map = model->map();
  const HandMade mass("mass.add", {{"mass", 300.0}}, {model->place("nodes", "node:3")});
  const HandMade mount("damper.series", {{"stiffness", 9e5}}, {model->place("dampers", "damper:D")});
  EXPECT_LT(worst_slope(map, {mass.cause(), mount.cause()}, somewhere(map)), 1e-4);
}

/// RMS of all channels with the frequencies of modes 1 and 4.
std::unique_ptr<Predicted> records() {
  auto model = rows_of_every_kind();
  model->features.rows.clear();
  model->features.conditions.resize(1);
  for (int c = 0; c < 4; ++c) model->add_row(RowType::rms, "", c, 0.01, 0.001);
  model->add_row(RowType::psd_floor, "", 2, 1e-8, 1e-9);
  for (const Index mode : {0, 3})
    model->add_row(RowType::frequency, std::to_string(mode + 1), -1, model->reduced().frequency_Hz[mode]);
  return model;
}

/// Largest error of the slopes of rows by unknowns of some kinds against central differences, of the row's largest of these.
double worst_slope_by(const diagnosis::FeatureMap& map, const VectorXd& x, const std::vector<Nuisance::Kind>& kinds,
                      const std::vector<Cause>& causes = {}) {
  const MatrixXd slope = map.predict(map.base(x), causes, true).jacobian;
  VectorXd error = VectorXd::Zero(slope.rows()), size = VectorXd::Constant(slope.rows(), 1e-6);
  for (Index j = 0; j < x.size(); ++j) {
    if (std::find(kinds.begin(), kinds.end(), map.nuisances()[static_cast<std::size_t>(j)].kind) == kinds.end()) continue;
    constexpr double h = 1e-3;
    const auto moved = [&](double step) {
      return map.predict(map.base(x + step * VectorXd::Unit(x.size(), j)), causes, false).g;
    };
    const VectorXd difference = (moved(h) - moved(-h)) / (2.0 * h);
    error = error.cwiseMax((slope.col(j) - difference).cwiseAbs());
    size = size.cwiseMax(difference.cwiseAbs());
  }
  return error.cwiseQuotient(size).maxCoeff();
}

TEST(Slopes, OfRecordsByStiffnessAreThoseOfCentralDifferences) {
  const auto model = records();
  const diagnosis::FeatureMap map = model->map();
  EXPECT_LT(worst_slope_by(map, somewhere(map), {Nuisance::Kind::parameter}), 1e-4);
  EXPECT_LT(worst_slope_by(map, somewhere(map), {Nuisance::Kind::level}), 1e-9);  // linear
  EXPECT_LT(worst_slope_by(map, somewhere(map), {Nuisance::Kind::gain}), 1e-4);
}

TEST(Slopes, OfRecordsByMasses) {
  const auto model = records();
  const diagnosis::FeatureMap map = model->map();
  EXPECT_LT(worst_slope_by(map, somewhere(map), {Nuisance::Kind::place}), 1e-4);
}

TEST(Slopes, OfRecordsByStructuralDamping) {
  const auto model = records();
  model->add_row(RowType::damping, "1", -1, 0.5, 0.1);
  const diagnosis::FeatureMap map = model->map();
  EXPECT_LT(worst_slope_by(map, somewhere(map), {Nuisance::Kind::mode_damping}), 1e-4);
}

TEST(Slopes, OfRecordsUnderWind) {
  const auto model = records();
  model->features.conditions[0].wind_m_s = 10.0;
  const diagnosis::FeatureMap map = model->map();
  EXPECT_LT(worst_slope_by(map, somewhere(map), {Nuisance::Kind::parameter}), 1e-4);
}

TEST(Slopes, OfAParameterUnderAFactorOnItsGroup) {
  const auto model = rows_of_every_kind();
  const diagnosis::FeatureMap map = model->map();
  const HandMade soft("scale.stiffness", {{"factor", 0.6}}, {model->place("groups", "group:k2")});
  EXPECT_LT(worst_slope(map, {soft.cause()}, somewhere(map)), 1e-4);
}

}  // namespace
}  // namespace twindeck::tests
