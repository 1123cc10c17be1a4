// Oracle: the poles and shapes of the modal model that the functions are computed from, in closed form.
#include "identification/plscf.hpp"

#include <gtest/gtest.h>

#include "hammer_data.hpp"

namespace twindeck::identification {
namespace {

// Without noise a model of some orders more than modes has their poles. The polynomials in z describe the functions up to the
// modes' mirror images at negative frequencies, which lie far away: 0.1 % of a frequency, 5 % of a damping ratio.
TEST(Plscf, FindsThePolesOfTheModelFromOneAndTwoReferences) {
  const twindeck::test::ModalModel model = twindeck::test::six_modes();
  for (const std::vector<Eigen::Index>& hammer : {std::vector<Eigen::Index>{0}, std::vector<Eigen::Index>{0, 3}}) {
    const ResponseData data = twindeck::test::hammer_data(model, hammer, twindeck::test::lines_of(5.0, 45.0, 641), 0.0, 1);
    const auto poles = plscf_poles(data.frequency_Hz, data.values, data.n_inputs, {40, 60});
    ASSERT_EQ(poles.size(), 2U);
    for (Eigen::Index r = 0; r < model.frequency_Hz.size(); ++r) {
      const Pole* best = nullptr;
      for (const Pole& pole : poles.back())
        if (std::abs(pole.frequency_Hz / model.frequency_Hz[r] - 1.0) < 1e-3 &&
            (best == nullptr ||
             twindeck::test::mac_with(model, r, pole.shape) > twindeck::test::mac_with(model, r, best->shape)))
          best = &pole;
      ASSERT_NE(best, nullptr) << r;
      EXPECT_EQ(best->order, 60);
      EXPECT_NEAR(best->damping_ratio, model.damping_ratio[r], 0.05 * model.damping_ratio[r]);
      EXPECT_GT(twindeck::test::mac_with(model, r, best->shape), 0.99);
    }
  }
}

// The property for which A_0 = I is chosen: poles that are none of the structure are unstable and do not appear.
TEST(Plscf, HasFewPolesBesideThoseOfTheStructure) {
  const ResponseData data =
      twindeck::test::hammer_data(twindeck::test::six_modes(), {0}, twindeck::test::lines_of(5.0, 45.0, 641), 0.01, 2);
  const auto poles = plscf_poles(data.frequency_Hz, data.values, 1, {50});
  const auto inside = std::count_if(poles[0].begin(), poles[0].end(), [](const Pole& pole) {
    return pole.frequency_Hz > 5.0 && pole.frequency_Hz < 45.0 && pole.damping_ratio < 0.2;
  });
  EXPECT_GE(inside, 6);
  EXPECT_LE(inside, 8);
}

}  // namespace
}  // namespace twindeck::identification
