// Oracle: the prototype's frequencies again, now against the product's own formulation (shear-flexible beams, penalty drilling,
// rotary inertia, pulls of its own rule blended with the site's). Together these choices
// may move no frequency by 3 %.
#include <cstdio>

#include "ponte_reference.hpp"
#include "prototype_bridge.hpp"

namespace twindeck {
namespace {

class PonteFormulation : public ::testing::TestWithParam<const char*> {};

TEST_P(PonteFormulation, StaysWithinThreePercentOfThePrototype) {
  const std::string variant = GetParam();
  const std::vector<double> expected = reference::frequencies().at(variant);
  const reference::Solved solved = reference::solve(ponte::generate(tests::prototype_toml(), variant), 16);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double f = solved.frequency_Hz[static_cast<Eigen::Index>(i)];
    const double difference_pct = 100.0 * (f / expected[i] - 1.0);
    std::printf("%-20s mode %2zu  prototype %.4f Hz  ours %.4f Hz  %+.3f %%\n", variant.c_str(), i + 1, expected[i], f,
                difference_pct);
    EXPECT_LT(std::abs(difference_pct), 3.0) << "mode " << i + 1;
  }
}

INSTANTIATE_TEST_SUITE_P(Variants, PonteFormulation,
                         ::testing::Values("preliminary", "refined", "refined_table8", "fitted_to_measured"),
                         [](const auto& variant) { return std::string(variant.param); });

}  // namespace
}  // namespace twindeck
