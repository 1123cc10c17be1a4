/// Oracles: the samples of the wind's own simulators, the order of the load's columns.
#include <gtest/gtest.h>

#include "buffeting/loads.hpp"
#include "gusty_beam.hpp"

namespace twindeck::buffeting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using tests::GustyBeam;

constexpr double kGustStep_s = 1.0 / 64;

TEST(Gusts, StandComponentByComponentAsTheLoadsColumns) {
  GustyBeam beam;
  const BridgeInWind bridge = beam.bridge();
  const Index n = std::ssize(bridge.model.strips);
  for (const bool across : {false, true}) {
    beam.config.across = across;
    const Gusts gusts(bridge, beam.set, beam.config, 15.0, kGustStep_s);
    const MatrixXd found = gusts.sample(3);
    EXPECT_EQ(gusts.before(), 0);
    ASSERT_EQ(found.rows(), 40 * 64);
    ASSERT_EQ(found.cols(), (across ? 3 : 2) * n);
    Index first = 0;
    for (const wind::Component component : beam.config.components()) {
      const wind::Simulator own(field_at_nodes(bridge, beam.set, beam.config.height_m, 15.0, component, beam.config.frozen),
                                {.duration_s = 40.0, .rate_Hz = 64.0, .cutoff_Hz = 4.0, .anchors = 10});
      EXPECT_EQ((found.middleCols(first, n) - own.sample(3)).cwiseAbs().maxCoeff(), 0.0);
      first += n;
    }
  }
}

TEST(Gusts, ThatDoNotRepeatBringTheirRunUp) {
  GustyBeam beam;
  beam.config.frequencies = "double_indexed";
  const Gusts gusts(beam.bridge(), beam.set, beam.config, 15.0, kGustStep_s);
  EXPECT_EQ(gusts.before(), 20 * 64);
  EXPECT_EQ(gusts.sample(3).rows(), (20 + 40) * 64);
  EXPECT_EQ(
      (gusts.sample(3).bottomRows(40 * 64).leftCols(gusts.simulators()[0].field().size()) - gusts.simulators()[0].sample(3))
          .cwiseAbs()
          .maxCoeff(),
      0.0);
}

}  // namespace
}  // namespace twindeck::buffeting
