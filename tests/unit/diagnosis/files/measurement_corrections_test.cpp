// Corrections of channels out of a diagnosis. Oracle: the diagnosis's own model of faulty channels, which they have to undo:
// what it predicts with the faults, corrected, is what it predicts without them, up to the free scale of each shape.
#include "diagnosis/files/measurement_corrections.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>

#include "unit/diagnosis/chain.hpp"

namespace twindeck::tests {
namespace {

struct Faulty {
  Chain chain{{.masses = 6, .modes = 4}};
  Examined e = examine(chain, chain.measure(chain.as_modelled()), catalogue({"swap", "pol", "gain", "axis"}));
  diagnosis::Diagnosis result;

  void has(const std::string& id, const Eigen::VectorXd& a = {}) {
    diagnosis::Effect effect;
    effect.cause = {&e.entry(id), a};
    effect.cluster = {id};
    result.effects.push_back(effect);
  }
  [[nodiscard]] std::vector<diagnosis::Cause> causes() const {
    std::vector<diagnosis::Cause> list;
    for (const auto& effect : result.effects) list.push_back(effect.cause);
    return list;
  }
  [[nodiscard]] std::vector<records::Correction> corrections() const {
    return diagnosis::corrections_of(result, e.map->features().channels);
  }
};

TEST(CorrectionsOf, UndoWhatTheModelOfTheChannelsDoes) {
  Faulty faulty;
  faulty.has("pol@channel:c2");
  faulty.has("swap@channels:c2,c5");
  faulty.has("gain@channel:c2", Eigen::VectorXd::Constant(1, std::log(1.7)));
  faulty.has("swap@channels:c3,c5");  // with the one before it a ring of three
  const auto& features = faulty.e.map->features();
  const auto base = faulty.e.map->base(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(faulty.e.map->nuisances().size())));
  const Eigen::VectorXd right = faulty.e.map->predict(base, {}, false).g;
  const diagnosis::Prediction with_faults = faulty.e.map->predict(base, faulty.causes(), false);
  const Eigen::VectorXd& wrong = with_faults.g;
  // A mode that the faults make unlike the measured one is none of the model's, and is not predicted.
  const std::set<int> open(with_faults.open.begin(), with_faults.open.end());
  const std::vector<records::Correction> corrections = faulty.corrections();
  ASSERT_EQ(corrections.size(), 4U);
  std::map<std::string, std::map<std::string, double>> plain, mended;  // by mode and channel
  for (std::size_t r = 0; r < features.rows.size(); ++r) {
    const diagnosis::Row& row = features.rows[r];
    if (row.type != diagnosis::RowType::shape || open.contains(static_cast<int>(r))) continue;
    const std::string& channel = features.channels[static_cast<std::size_t>(row.channel)];
    const records::CorrectedChannel now = records::corrected(corrections, channel, "");
    plain[row.mode][channel] = right[static_cast<Eigen::Index>(r)];
    mended[row.mode][now.name] = now.factor * wrong[static_cast<Eigen::Index>(r)];
  }
  ASSERT_GE(plain.size(), 3U);
  for (const auto& [mode, shape] : plain) {
    double ab = 0.0, aa = 0.0, bb = 0.0;
    ASSERT_EQ(mended[mode].size(), shape.size());
    for (const auto& [channel, value] : shape) {
      ab += value * mended[mode][channel];
      aa += value * value;
      bb += mended[mode][channel] * mended[mode][channel];
    }
    EXPECT_NEAR(ab * ab / (aa * bb), 1.0, 1e-9) << "mode " << mode;
  }
}

TEST(CorrectionsOf, LeavesOutWhatIsNotDecidedAndWhatIsNoFaultOfSignGainOrName) {
  Faulty faulty;
  faulty.has("pol@channel:c2");
  faulty.result.effects.back().cluster = {"pol@channel:c2", "pol@channel:c3"};
  EXPECT_TRUE(faulty.corrections().empty());
  EXPECT_TRUE(diagnosis::correction_advice(faulty.corrections()).empty());
}

TEST(CorrectionsOf, NamesEachStateThatHasTheFault) {
  Faulty faulty;
  diagnosis::Candidate later = faulty.e.entry("pol@channel:c2");
  later.state = "mid";
  later.further_states = {"late"};
  diagnosis::Effect effect;
  effect.cause = {&later, {}};
  effect.cluster = {later.key()};
  faulty.result.effects.push_back(effect);
  const std::vector<records::Correction> corrections = faulty.corrections();
  ASSERT_EQ(corrections.size(), 2U);
  EXPECT_EQ(words_of(corrections[0]), "c2 reversed in state mid");
  EXPECT_EQ(words_of(corrections[1]), "c2 reversed in state late");
}

TEST(WriteCorrections, AddsToWhatWasGivenAndTakesBackWhatWasWrong) {
  const auto file = std::filesystem::temp_directory_path() / "twindeck_measurement_corrections.toml";
  const records::Correction a{"a", records::Correction::Action::reverse, "", 1.0, "", {}},
      b{"b", records::Correction::Action::scale, "", 0.5, "", {}};
  std::filesystem::remove(file);
  diagnosis::write_corrections({a}, {}, file);
  EXPECT_FALSE(std::filesystem::exists(file));
  diagnosis::write_corrections({a}, {b}, file);
  EXPECT_EQ(records::read_corrections(file).size(), 2U);
  diagnosis::write_corrections({a, b}, {a}, file);
  const auto left = records::read_corrections(file);
  std::filesystem::remove(file);
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(left[0].channel, "b");
}

}  // namespace
}  // namespace twindeck::tests
