// Oracles: a deck of masses on springs with strings that end on it, whose modes are the roots of
// det(K - w² M + sum T kappa cot(kappa L) e e') = 0, counted as Wittrick and Williams do; a taut string's f_n = n/(2 L)
// sqrt(T/m); means and deviations by hand.
#include "diagnosis/causes/bar_stays.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fe/assembly.hpp"
#include "unit/fe/assembly_models.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::BarStays;
using diagnosis::FeatureSet;
using diagnosis::ForceSource;
using diagnosis::Row;
using diagnosis::RowType;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
constexpr double pi = std::numbers::pi;

/// Mode of the deck with its strings, exactly.
struct Exact {
  double hertz;
  VectorXd shape;  ///< (n_masses)
};

/// Eight masses of 2 t that move in z, on springs; level stays without weight, 80 m and 4 kg/m, from the masses to fixed
/// anchors.
class DeckWithStays {
 public:
  static constexpr int masses = 8;
  static constexpr double mass = 2000.0, length = 80.0, per_metre = 4.0, area = per_metre / 8000.0;

  struct Stay {
    std::string name;
    int at;          ///< mass
    double force_N;  ///< in the structure
    double modelled_N;
  };
  explicit DeckWithStays(std::vector<Stay> stays) : stays_(std::move(stays)) {
    model_.source = "deck";
    model_.gravity_m_s2 = 0.0;
    model_.materials.push_back({"rope", 165e9, 60e9, 0.3, 8000.0});
    fe::Section section;
    section.name = "rope";
    section.area_m2 = area;
    model_.sections.push_back(section);
    for (int i = 0; i < masses; ++i) {
      fe::test::add_node(model_, 10.0 * i, 0.0, 0.0);
      fe::test::fix(model_, i, {true, true, false, true, true, true});
      model_.masses.push_back({"deck", i, mass, Eigen::Vector3d::Zero()});
      spring(i, -1, ground(i));
      if (i > 0) spring(i - 1, i, between);
    }
    spring(0, -1, between);
    spring(masses - 1, -1, between);
    for (const Stay& stay : stays_) {
      const int anchor = fe::test::add_node(model_, 10.0 * stay.at, length, 0.0);
      fe::test::fix(model_, anchor);
      fe::test::add_element(model_, fe::ElementType::stay, "stays", 0, 0, {anchor, stay.at}).name = stay.name;
      state_.stay_pull_N.conservativeResize(std::ssize(model_.elements));
      state_.stay_pull_N.tail(1)[0] = stay.modelled_N;
    }
    state_.axial_force_N = VectorXd::Zero(std::ssize(model_.elements));
  }
  DeckWithStays(const DeckWithStays&) = delete;
  DeckWithStays& operator=(const DeckWithStays&) = delete;

  /// Force under which a string has this first frequency.
  static double force_of(double hertz) { return per_metre * std::pow(2.0 * length * hertz, 2); }
  static double hertz_of(double force_N) { return std::sqrt(force_N / per_metre) / (2.0 * length); }

  /// Frequencies of the model whose stays are bars: T/L and a third of the mass at the end that moves.
  static VectorXd with_bars(const std::vector<Stay>& stays) {
    MatrixXd k = deck(), m = mass * MatrixXd::Identity(masses, masses);
    for (const Stay& stay : stays) {
      k(stay.at, stay.at) += stay.modelled_N / length;
      m(stay.at, stay.at) += per_metre * length / 3.0;
    }
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eig(k, m);
    return eig.eigenvalues().cwiseSqrt() / (2.0 * pi);
  }
  /// Number of modes in the vertical plane below a frequency.
  [[nodiscard]] int modes_below(double hertz) const {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eig(dynamic_stiffness(hertz));
    return static_cast<int>((eig.eigenvalues().array() < 0.0).count()) + strings_below(hertz);
  }
  /// Number of modes of the strings between fixed ends: those across the vertical plane, in which no mass moves.
  [[nodiscard]] int strings_below(double hertz) const {
    int count = 0;
    for (const Stay& stay : stays_) count += static_cast<int>(std::floor(hertz / hertz_of(stay.force_N)));
    return count;
  }
  [[nodiscard]] std::vector<Exact> modes_up_to(double hertz) const {
    std::vector<Exact> out;
    for (int n = 1; n <= modes_below(hertz); ++n) {
      double low = 0.01, high = hertz;
      for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (modes_below(middle) >= n ? high : low) = middle;
      }
      const Eigen::SelfAdjointEigenSolver<MatrixXd> eig(dynamic_stiffness(low));
      Index least = 0;
      eig.eigenvalues().cwiseAbs().minCoeff(&least);
      out.push_back({low, eig.eigenvectors().col(least)});
    }
    return out;
  }
  /// Rows of these modes in one more condition.
  static void measure(FeatureSet& features, const std::vector<Exact>& modes, std::optional<bool> dampers_on = {},
                      int channels = masses) {
    features.conditions.emplace_back();
    features.conditions.back().dampers_on = dampers_on;
    const int condition = static_cast<int>(features.conditions.size()) - 1;
    for (std::size_t i = 0; i < modes.size(); ++i) {
      const std::string name = std::to_string(i + 1);
      features.rows.push_back({RowType::frequency, name, -1, "", condition, modes[i].hertz, 0.01, false});
      for (int c = 0; c < channels; ++c) {
        // As complex values at 135 degrees.
        features.rows.push_back({RowType::shape, name, c, "", condition, -modes[i].shape[c], 0.01, false});
        features.rows.push_back({RowType::shape_imag, name, c, "", condition, modes[i].shape[c], 0.01, false});
      }
    }
  }
  [[nodiscard]] FeatureSet measured(double up_to_Hz) const {
    FeatureSet features;
    measure(features, modes_up_to(up_to_Hz));
    return features;
  }
  [[nodiscard]] std::optional<BarStays> found(const FeatureSet& features, const std::vector<Row>& stay_rows = {}) {
    system_ = fe::assemble(model_, state_);
    diagnosis::Structure structure;
    structure.system = &system_;
    structure.model = &model_;
    structure.state = &state_;
    structure.theta = system_.initial();
    structure.sensors = [](const MatrixXd& v) {
      MatrixXd out = MatrixXd::Zero(4 * masses, v.cols());
      for (int c = 0; c < masses; ++c) out.row(4 * c) = out.row(4 * c + 3) = v.row(c);
      return out;
    };
    return diagnosis::find_bar_stays(structure, features, stay_rows, {});
  }
  [[nodiscard]] fe::Model& model() { return model_; }
  [[nodiscard]] const fe::PrestressState& state() const { return state_; }

 private:
  static constexpr double between = 4e5;
  static double ground(int i) { return 2e4 * (i + 1); }
  static MatrixXd deck() {
    MatrixXd k = MatrixXd::Zero(masses, masses);
    for (int i = 0; i < masses; ++i) {
      k(i, i) = 2.0 * between + ground(i);
      if (i > 0) k(i, i - 1) = k(i - 1, i) = -between;
    }
    return k;
  }
  [[nodiscard]] MatrixXd dynamic_stiffness(double hertz) const {
    const double w = 2.0 * pi * hertz;
    MatrixXd d = deck() - w * w * mass * MatrixXd::Identity(masses, masses);
    for (const Stay& stay : stays_) {
      const double kappa = w / std::sqrt(stay.force_N / per_metre);
      d(stay.at, stay.at) += stay.force_N * kappa / std::tan(kappa * length);
    }
    return d;
  }
  void spring(int node, int node2, double stiffness) {
    fe::Spring s;
    s.name = "k" + std::to_string(model_.springs.size());
    s.group = "deck";
    s.node = node;
    s.node2 = node2;
    s.stiffness = stiffness;
    model_.springs.push_back(s);
  }

  std::vector<Stay> stays_;
  fe::Model model_;
  fe::PrestressState state_;
  fe::ParametricSystem system_;
};

Row harmonic(const std::string& stay, int number, double hertz, double relative_std = 0.01) {
  return {RowType::stay_frequency, std::to_string(number), -1, stay, 0, hertz, relative_std * hertz, false};
}

/// First frequency of a string that meets mode `i` of the deck alone.
double beside_mode(Index i) { return 1.01 * DeckWithStays::with_bars({})[i]; }
constexpr double kBand = 4.2;  ///< [Hz] the deck's first six modes lie below

/// Two stays that meet modes 2 and 4; their forces in the model are off.
std::vector<DeckWithStays::Stay> two_stays() {
  const double a = DeckWithStays::force_of(beside_mode(1)), b = DeckWithStays::force_of(beside_mode(3));
  return {{"A", 2, a, 0.8 * a}, {"B", 5, b, 1.3 * b}};
}

TEST(BarStays, AStayThatBeginsToSwingFarAboveTheBandIsLeftABar) {
  auto stays = two_stays();
  const double above = 3.0 * kBand;
  stays.push_back({"C", 7, DeckWithStays::force_of(above), DeckWithStays::force_of(above)});
  DeckWithStays deck(stays);
  const FeatureSet features = deck.measured(kBand);
  const auto found =
      deck.found(features, {harmonic("A", 1, beside_mode(1)), harmonic("B", 1, beside_mode(3)), harmonic("C", 1, above)});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->stays.size(), 2u);
}

TEST(BarStays, MeasuredStaysThatSwingAreFoundWithTheirForces) {
  const auto stays = two_stays();
  DeckWithStays deck(stays);
  const FeatureSet features = deck.measured(kBand);
  const auto found = deck.found(features, {harmonic("A", 1, beside_mode(1)), harmonic("B", 1, beside_mode(3))});
  ASSERT_TRUE(found);
  ASSERT_EQ(found->stays.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(found->stays[i].name, stays[i].name);
    EXPECT_EQ(found->stays[i].element, static_cast<int>(i));
    EXPECT_EQ(found->stays[i].source, ForceSource::measured);
    EXPECT_NEAR(found->stays[i].force_N / stays[i].force_N, 1.0, 1e-3);  // six pieces: 0.02 % in frequency
    EXPECT_NEAR(found->stays[i].relative_std, 0.02, 1e-9);               // the force goes with the square
  }
  EXPECT_GT(found->deck_log_odds, 7.0);
  // The extended model's modes are those of deck and strings.
  EXPECT_EQ(found->extended.matrix_elements.size(), 2u);
  EXPECT_EQ(found->extended.nodes.size(), deck.model().nodes.size() + 2 * 5);
  const double highest = deck.modes_up_to(kBand).back().hertz;
  EXPECT_EQ(found->modes_in_band, deck.modes_below(highest * 1.001) + deck.strings_below(highest));
  const double half = DeckWithStays::with_bars(stays)[3];  // of eight modes
  EXPECT_EQ(found->modes_in_basis, deck.modes_below(half) + deck.strings_below(half));
}

TEST(BarStays, TheExtendedModelHasTheModesOfDeckAndStrings) {
  DeckWithStays deck(two_stays());
  const FeatureSet features = deck.measured(kBand);
  const auto found = deck.found(features, {harmonic("A", 1, beside_mode(1)), harmonic("B", 1, beside_mode(3))});
  ASSERT_TRUE(found);
  fe::PrestressState state = deck.state();
  for (std::size_t i = 0; i < 2; ++i) state.stay_pull_N[static_cast<Index>(i)] = two_stays()[i].force_N;
  const auto system = fe::assemble(found->extended, state);
  std::vector<int> vertical;
  for (std::size_t i = 0; i < system.dofs.size(); ++i)
    if (system.dofs[i].direction == 2) vertical.push_back(static_cast<int>(i));
  const MatrixXd k = fe::test::full(system.stiffness(system.initial()))(vertical, vertical),
                 m = fe::test::full(system.mass(system.initial()))(vertical, vertical);
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eig(k, m);
  const auto exact = deck.modes_up_to(kBand);
  ASSERT_GE(exact.size(), 6u);
  for (std::size_t i = 0; i < exact.size(); ++i)
    EXPECT_NEAR(std::sqrt(eig.eigenvalues()[static_cast<Index>(i)]) / (2.0 * pi) / exact[i].hertz, 1.0, 5e-3) << i;
}

/// Frequency n of six pieces over that of the string, whose masses are half lumped and half consistent.
double of_six_pieces(int n) {
  const double share = 1.0 - std::cos(n * pi / 6.0);
  return 6.0 / (n * pi) * std::sqrt(2.0 * share / (1.0 - share / 6.0));
}

// Oracle: a bar has no frequency of its own: ln(0.3/0.98) for each of the measured harmonics 2 and 3. A cable has both within
// reach: ln(0.7/c), c the part of the band, of ln 1.5 + 2 w, that lies within w of one of its own, which are a little lower.
TEST(BarStays, HigherHarmonicsOfAStayItselfAreEvidence) {
  DeckWithStays deck(two_stays());
  const FeatureSet features = deck.measured(kBand);
  std::vector<Row> rows = {harmonic("A", 1, beside_mode(1)), harmonic("B", 1, beside_mode(3))};
  const auto without = deck.found(features, rows);
  for (const int n : {2, 3}) rows.push_back(harmonic("A", n, n * beside_mode(1), 0.5));  // the first one gives the force
  const auto with = deck.found(features, rows);
  ASSERT_TRUE(without && with);
  EXPECT_EQ(without->log_odds, without->deck_log_odds);  // the lowest harmonic gave the force: it proves nothing
  const double w = with->rule.within, below = std::log(of_six_pieces(1) / of_six_pieces(2));
  ASSERT_GT(w, 0.02);  // all of the third's interval lies in the band then
  const double part = (4.0 * w - below) / (std::log(1.5) + 2.0 * w);
  EXPECT_NEAR(with->log_odds - with->deck_log_odds, 2.0 * (std::log(0.7 / part) - std::log(0.3 / 0.98)), 1e-3);
}

// Oracle: two readings of one force that differ by 2 d in ln f have deviations of d from their mean: with equal weights w each
// the misfit is 2 d² w for one degree of freedom, and 2 sqrt(2 d² w / 2 w) = 2 d.
TEST(BarStays, HarmonicsThatDisagreeWidenTheForce) {
  DeckWithStays deck(two_stays());
  const FeatureSet features = deck.measured(kBand);
  const double f = beside_mode(1), d = 0.03;
  const auto found = deck.found(features, {harmonic("A", 1, f * std::exp(d), 1e-4), harmonic("A", 1, f * std::exp(-d), 1e-4),
                                           harmonic("B", 1, beside_mode(3), 1e-4)});
  ASSERT_TRUE(found);
  ASSERT_EQ(found->stays.size(), 2u);
  EXPECT_NEAR(found->stays[0].relative_std, 2.0 * d, 1e-6);
  EXPECT_NEAR(found->stays[0].force_N / DeckWithStays::force_of(f), 1.0, 1e-3);
  EXPECT_NEAR(found->stays[1].relative_std, 2.0 * 0.002, 1e-9);  // no frequency is known better than the ends' motion leaves
}

// The mirror images at 2 and 5 have one frequency; one of them was measured, twice more force than modelled.
TEST(BarStays, AMirrorImageHasTheMeasuredForce) {
  const double force = DeckWithStays::force_of(beside_mode(1));
  DeckWithStays deck({{"A", 2, force, 0.5 * force}, {"B", 5, force, 0.5 * force}, {"C", 3, 400.0 * force, 400.0 * force}});
  const FeatureSet features = deck.measured(kBand);
  const auto found = deck.found(features, {harmonic("A", 1, beside_mode(1))});
  ASSERT_TRUE(found);
  ASSERT_EQ(found->stays.size(), 2u);  // C swings far above the band
  EXPECT_EQ(found->stays[0].source, ForceSource::measured);
  EXPECT_EQ(found->stays[1].name, "B");
  EXPECT_EQ(found->stays[1].source, ForceSource::twin);
  EXPECT_EQ(found->stays[1].force_N, found->stays[0].force_N);
  EXPECT_EQ(found->stays[1].relative_std, 0.05);
}

TEST(BarStays, SeveralMirrorImagesHaveTheMean) {
  const double force = DeckWithStays::force_of(beside_mode(1));
  DeckWithStays deck({{"A", 2, force, force}, {"B", 5, force, force}, {"C", 6, force, force}});
  const FeatureSet features = deck.measured(kBand);
  const auto found = deck.found(features, {harmonic("A", 1, 1.005 * beside_mode(1)), harmonic("C", 1, 0.995 * beside_mode(1))});
  ASSERT_TRUE(found);
  ASSERT_EQ(found->stays.size(), 3u);
  EXPECT_EQ(found->stays[1].source, ForceSource::twin);
  EXPECT_NEAR(found->stays[1].force_N, 0.5 * (found->stays[0].force_N + found->stays[2].force_N), 1e-6);
  EXPECT_GT(found->stays[0].force_N, found->stays[2].force_N * 1.01);
}

// A stay with another force in the model is no mirror image: nothing is known of it but what the model says.
TEST(BarStays, AStayThatIsNoMirrorImageHasTheForceOfTheModel) {
  const double force = DeckWithStays::force_of(beside_mode(1));
  DeckWithStays deck({{"A", 2, force, 0.9 * force}, {"B", 5, force, force}, {"C", 6, force, force}});
  const auto found = deck.found(deck.measured(kBand), {harmonic("A", 1, beside_mode(1))});
  ASSERT_TRUE(found);
  ASSERT_EQ(found->stays.size(), 3u);
  EXPECT_EQ(found->stays[0].source, ForceSource::measured);
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_EQ(found->stays[i].source, ForceSource::model);
    EXPECT_EQ(found->stays[i].force_N, force);
    EXPECT_EQ(found->stays[i].relative_std, 0.10);
  }
}

TEST(BarStays, OfOtherLengthOrSectionIsNoMirrorImage) {
  const double force = DeckWithStays::force_of(beside_mode(1));
  for (const bool shorter : {true, false}) {
    DeckWithStays deck({{"A", 2, force, force}, {"B", 5, force, force}, {"C", 6, force, force}});
    const FeatureSet features = deck.measured(kBand);
    if (shorter) {
      deck.model().nodes[static_cast<std::size_t>(deck.model().elements[0].nodes[0])].x_m.y() *= 0.98;
    } else {
      deck.model().sections.push_back(deck.model().sections[0]);
      deck.model().elements[0].section = 1;
    }
    const auto found = deck.found(features, {harmonic("A", 1, beside_mode(1))});
    ASSERT_TRUE(found) << shorter;
    ASSERT_EQ(found->stays.size(), 3u);
    for (const std::size_t i : {1u, 2u}) EXPECT_EQ(found->stays[i].source, ForceSource::model) << shorter;
    // T = m (2 L f)²
    EXPECT_NEAR(found->stays[0].force_N / force, shorter ? 0.98 * 0.98 : 1.0, 1e-3);
  }
}

TEST(BarStays, NothingIsFoundWhereNoStaySwings) {
  const auto stays = two_stays();
  DeckWithStays deck(stays), none({});
  const FeatureSet swinging = deck.measured(kBand), still = none.measured(kBand);
  EXPECT_FALSE(none.found(swinging));
  DeckWithStays taut({{"A", 2, 0.0, 1e3 * stays[0].force_N}, {"B", 5, 0.0, 1e3 * stays[1].force_N}});
  EXPECT_FALSE(taut.found(swinging));  // they begin to swing above twice the highest frequency
  EXPECT_FALSE(deck.found(still, {harmonic("A", 1, beside_mode(1)), harmonic("B", 1, beside_mode(3))}));
}

TEST(BarStays, NothingIsFoundWithoutShapesOrAForceOrAModel) {
  const double force = DeckWithStays::force_of(beside_mode(1));
  DeckWithStays deck({{"A", 2, force, force}, {"B", 5, force, force}, {"C", 6, force, force}});
  for (const int channels : {0, 2, 3}) {  // two channels are no shape
    FeatureSet features;
    DeckWithStays::measure(features, deck.modes_up_to(kBand), {}, channels);
    EXPECT_EQ(deck.found(features).has_value(), channels == 3) << channels;
  }
  DeckWithStays slack({{"A", 2, force, 0.0}, {"B", 5, force, 0.0}, {"C", 6, force, 0.0}});
  const FeatureSet features = deck.measured(kBand);
  std::vector<Row> rows;
  for (const char* name : {"A", "B", "C"}) rows.push_back(harmonic(name, 1, beside_mode(1)));
  EXPECT_FALSE(slack.found(features));
  EXPECT_TRUE(slack.found(features, rows));  // a measured frequency is a force
  EXPECT_FALSE(diagnosis::find_bar_stays(diagnosis::Structure{}, features, rows, {}));
}

// Dampers hold the deck and not the strings: where there are conditions without them, those decide.
TEST(BarStays, ConditionsWithoutDampersDecide) {
  DeckWithStays deck(two_stays());
  const DeckWithStays none({});
  const std::vector<Row> rows = {harmonic("A", 1, beside_mode(1)), harmonic("B", 1, beside_mode(3))};
  for (const bool swinging_is_undamped : {true, false}) {
    FeatureSet features;
    DeckWithStays::measure(features, deck.modes_up_to(kBand), !swinging_is_undamped);
    DeckWithStays::measure(features, none.modes_up_to(kBand), swinging_is_undamped);
    EXPECT_EQ(deck.found(features, rows).has_value(), swinging_is_undamped);
  }
}

}  // namespace
}  // namespace twindeck::tests
