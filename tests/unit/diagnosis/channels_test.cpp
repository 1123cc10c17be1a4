// Errors of sensors, and what cannot be told apart. Oracles: the change that was made to the rows; the mirror symmetry of the
// chain.
#include <gtest/gtest.h>

#include "chain.hpp"

namespace twindeck::tests {
namespace {

std::vector<std::string> found(const Examined& e) {
  std::vector<std::string> out;
  for (const auto& effect : e.result.effects) out.push_back(effect.cluster.size() == 1 ? effect.cluster.front() : "ambiguous");
  return out;
}

/// Exchanges or reverses channels in the rows.
diagnosis::FeatureSet rewired(diagnosis::FeatureSet f, int a, int b) {
  for (auto& row : f.rows) {
    if (row.channel < 0) continue;
    if (a == b && row.channel == a)
      row.value = -row.value;
    else if (row.channel == a)
      row.channel = b;
    else if (row.channel == b)
      row.channel = a;
  }
  return f;
}

TEST(Channels, EachOfSixteenReversedIsFound) {
  const Chain chain;
  const auto hypotheses = catalogue();
  for (int c = 0; c < 16; ++c) {
    std::mt19937_64 random(static_cast<std::uint64_t>(100 + c));
    const Examined e = diagnosed(chain, rewired(chain.measure(chain.scattered(random), &random), c, c), hypotheses);
    EXPECT_EQ(found(e), std::vector<std::string>{"pol@channel:c" + std::to_string(c + 1)}) << e.result.message;
  }
}

TEST(Channels, EachOfSixteenExchangedWithAnotherIsFound) {
  const Chain chain;
  const auto hypotheses = catalogue();
  for (int c = 0; c < 16; ++c) {
    const int a = std::min(c, (c + 5) % 16), b = std::max(c, (c + 5) % 16);
    std::mt19937_64 random(static_cast<std::uint64_t>(200 + c));
    const Examined e = diagnosed(chain, rewired(chain.measure(chain.scattered(random), &random), a, b), hypotheses);
    EXPECT_EQ(found(e), std::vector<std::string>{"swap@channels:c" + std::to_string(a + 1) + ",c" + std::to_string(b + 1)})
        << e.result.message;
  }
}

TEST(Channels, ExchangedTwiceIsAsBefore) {
  const Chain chain({.masses = 6, .modes = 4});
  const auto features = chain.measure(chain.as_modelled());
  const Examined e = examine(chain, features, catalogue({"swap", "pol"}));
  const auto base = e.map->base(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(e.map->nuisances().size())));
  const Eigen::VectorXd nothing;
  for (const char* id : {"swap@channels:c2,c5", "pol@channel:c3"}) {
    const diagnosis::Cause cause{&e.entry(id), nothing};
    const Eigen::VectorXd plain = e.map->predict(base, {}, false).g, twice = e.map->predict(base, {cause, cause}, false).g;
    EXPECT_GT((e.map->predict(base, {cause}, false).g - plain).norm(), 0.1);
    EXPECT_LT((twice - plain).norm(), 1e-12);
  }
}

TEST(Mirror, LeftAndRightAreAnsweredByEitherOrByNone) {
  // A chain that is symmetric, with one sensor in its middle or none: a weak left spring and a weak right one give the same
  // rows.
  for (const bool shapes : {false, true}) {
    ChainOptions options;
    options.masses = 15;
    options.channels = shapes ? std::vector<int>{6, 7, 8} : std::vector<int>{};
    options.shapes = shapes;
    options.frequency_std = 0.001;
    const Chain chain(options);
    ChainTruth truth = chain.as_modelled();
    truth.spring[2] = 0.3;
    auto features = chain.measure(truth);
    if (shapes)  // only the middle sensor keeps its rows: the two beside it see the asymmetry
      std::erase_if(features.rows, [](const auto& row) { return row.channel == 0 || row.channel == 2; });
    const Examined e = diagnosed(chain, features, catalogue());
    EXPECT_NE(e.result.verdict, diagnosis::Verdict::named);
    if (e.result.effects.empty()) continue;  // an error of the form explains so few rows as well
    const auto& first = e.result.effects.front();
    const auto holds = [&](const std::string& id) {
      return std::find(first.cluster.begin(), first.cluster.end(), id) != first.cluster.end();
    };
    EXPECT_TRUE(holds("stiffness@group:g2"));
    EXPECT_TRUE(holds("stiffness@group:g13"));
    EXPECT_LT(first.probability, 0.6);  // each side has half at most
    EXPECT_FALSE(first.split_by.empty());
  }
}

}  // namespace
}  // namespace twindeck::tests
