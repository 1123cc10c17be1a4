// Locations round the leading one. Oracles: a reduced model that was made with a place at once; halves that add up to the
// whole; a girder on a mesh twice as fine, with eight tonnes at a node between the candidate locations; a chain with ties by
// dense matrices of its own.
#include "diagnosis/refinement.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>

#include "chain.hpp"
#include "diagnosis/promising_ties.hpp"
#include "dynamics/eigenmodes.hpp"
#include "dynamics/loaded_model.hpp"

namespace twindeck::tests {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// A structure with places and a reduced model of its own, diagnosed with or without locations round the leader.
struct Refined {
  Refined(const diagnosis::Structure& structure, diagnosis::Places of, const diagnosis::FeatureSet& features,
          std::vector<diagnosis::Hypothesis> families)
      : places(std::move(of)),
        reduced(structure, places, diagnosis::ReductionOptions{}),
        rows(features),
        hypotheses(std::move(families)),
        entries(diagnosis::instantiate(hypotheses, reduced, rows)),
        map(reduced, rows, diagnosis::ScatterOptions{}),
        inference(map, entries.candidates),
        refinement(structure, places, reduced, rows) {}
  Refined(const Refined&) = delete;
  Refined& operator=(const Refined&) = delete;

  [[nodiscard]] diagnosis::Diagnosis diagnosed(bool with_refinement) {
    diagnosis::DiagnoseOptions options;
    options.threshold = diagnosis::analytic_threshold(inference, options.alpha);
    options.refinement = with_refinement ? &refinement : nullptr;
    return diagnosis::diagnose(inference, options, 1);
  }

  diagnosis::Places places;
  diagnosis::ReducedModel reduced;
  diagnosis::FeatureSet rows;
  std::vector<diagnosis::Hypothesis> hypotheses;
  diagnosis::Instantiated entries;
  diagnosis::FeatureMap map;
  diagnosis::Inference inference;
  diagnosis::Refinement refinement;
};

/// Three spans of 16, 24 and 20 m, bending in the vertical plane alone, 360 t.
class ThreeSpans {
 public:
  static constexpr double kModulus = 34e9, kDensity = 2500.0, kLength = 60.0;

  explicit ThreeSpans(double element_m, double added_kg = 0.0, double at_m = 0.0, double modulus = kModulus) {
    fe::Model model;
    model.source = "three spans";
    const auto count = static_cast<int>(std::lround(kLength / element_m));
    model.materials.push_back({"concrete", modulus, 14e9, 0.2, kDensity});
    fe::Section section;
    section.name = "box";
    section.area_m2 = 2.4;
    section.inertia_y_m4 = 0.42;
    section.inertia_z_m4 = 3.0;
    section.torsion_m4 = 0.8;
    model.sections.push_back(section);
    for (int i = 0; i <= count; ++i) {
      const double x = kLength * i / count;
      model.nodes.push_back({i + 1, {x, 0.0, 0.0}});
      const bool held = x == 0.0 || x == 16.0 || x == 40.0 || x == kLength;
      model.supports.push_back({"", i, {true, true, held, true, false, true}});
      if (added_kg > 0.0 && x == at_m) model.masses.push_back({"added", i, added_kg, Eigen::Vector3d::Zero()});
      if (i == count) break;
      fe::Element element;
      element.id = i + 1;
      element.group = x < 16.0 ? "span_1" : x < 40.0 ? "span_2" : "span_3";
      element.material = element.section = 0;
      element.nodes = {i, i + 1};
      model.elements.push_back(element);
    }
    model.parameters.push_back({"E", fe::Target::youngs_modulus, {"concrete"}, "Pa", modulus, 0.85 * modulus, 1.15 * modulus});
    loaded_ = dynamics::from_model(std::move(model));
    for (const double x : {4.0, 8.0, 12.0, 21.0, 26.0, 31.0, 36.0, 45.0, 50.0, 55.0}) channels_.push_back(node_at(x));
  }
  ThreeSpans(const ThreeSpans&) = delete;
  ThreeSpans& operator=(const ThreeSpans&) = delete;

  [[nodiscard]] diagnosis::Structure structure() const {
    diagnosis::Structure out;
    out.system = &loaded_.system;
    out.model = loaded_.fe_model();
    out.state = &loaded_.state;
    out.theta = loaded_.theta;
    out.source = "three spans";
    out.sensor_nodes = channels_;
    out.sensors = [this](const Eigen::MatrixXd& v) {
      Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(4 * std::ssize(channels_), v.cols());
      for (std::size_t c = 0; c < channels_.size(); ++c)
        for (std::size_t i = 0; i < loaded_.system.dofs.size(); ++i) {
          const fe::DofLabel& dof = loaded_.system.dofs[i];
          if (dof.node != channels_[c] || dof.direction != 2) continue;
          const auto row = 4 * static_cast<Index>(c);
          rows.row(row) = rows.row(row + 3) = v.row(static_cast<Index>(i));
        }
      return rows;
    };
    return out;
  }
  /// Eight modes: frequencies to 0.1 %, shapes to 1 % of the largest value.
  [[nodiscard]] diagnosis::FeatureSet measured(std::mt19937_64& random) const {
    using diagnosis::RowType;
    constexpr int kModes = 8;
    dynamics::ModalSolver solver(loaded_.system);
    const dynamics::EigenModes modes = solver.solve(loaded_.theta, kModes);
    const Eigen::MatrixXd rows = structure().sensors(modes.shapes);
    std::normal_distribution<double> normal;
    diagnosis::FeatureSet f;
    f.conditions.emplace_back();
    f.conditions.back().name = "calm";
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      f.channels.push_back("c" + std::to_string(c + 1));
      f.direction.push_back(Eigen::Vector3d::UnitZ());
    }
    for (int m = 0; m < kModes; ++m) {
      const std::string label = std::to_string(m + 1);
      const double std = 0.001 * modes.frequency_Hz[m];
      f.rows.push_back({RowType::frequency, label, -1, "", 0, modes.frequency_Hz[m] + std * normal(random), std, false});
      VectorXd shape(std::ssize(channels_));
      for (Index c = 0; c < shape.size(); ++c) shape[c] = rows(4 * c, m);
      shape /= shape.cwiseAbs().maxCoeff();
      for (Index c = 0; c < shape.size(); ++c)
        f.rows.push_back({RowType::shape, label, static_cast<int>(c), "", 0, shape[c] + 0.01 * normal(random), 0.01, false});
    }
    diagnosis::hold_out_by_rule(f);
    return f;
  }
  [[nodiscard]] std::string node_at(double x) const {
    for (const fe::Node& node : loaded_.model->nodes)
      if (std::abs(node.x_m.x() - x) < 1e-9) return std::to_string(node.id);
    throw std::runtime_error("no node there");
  }
  /// Zones and candidate nodes of a diagnosis.
  [[nodiscard]] diagnosis::Places places(int zones, int nodes) const {
    return diagnosis::find_places(
        structure(), {.max_zones = zones, .max_nodes = nodes, .moves = {}, .zone_centres = {}, .node_positions = {}});
  }

 private:
  dynamics::LoadedModel loaded_;
  std::vector<std::string> channels_;
};

std::vector<diagnosis::Hypothesis> families_of_girders() {
  return catalogue({"mass", "osc", "prop", "joint", "stiffness", "gain", "pol"});
}

ChainOptions long_chain() {
  ChainOptions options;
  options.masses = 120;
  options.channels = {9, 29, 49, 69, 89, 109};
  options.modes = 6;
  options.parameters = false;
  return options;
}

TEST(NodeGraph, GoesHalfTheWayToTheLocationsBesideOne) {
  const Chain chain(long_chain());
  const diagnosis::NodeGraph graph(chain.structure());
  EXPECT_EQ(graph.between("30", {"10", "30", "50"}), (std::vector<std::string>{"20", "40"}));
  EXPECT_EQ(graph.between("30", {"28", "30", "31"}), (std::vector<std::string>{"29"}));
  EXPECT_EQ(graph.between("31", {"28", "30", "31"}), (std::vector<std::string>{"120"}));  // the open end
  EXPECT_TRUE(graph.between("3", {"1", "2", "3", "4", "120"}).empty());
  EXPECT_TRUE(graph.between("no node", {"1"}).empty());
}

TEST(Halves, AddUpToTheZone) {
  const ThreeSpans girder(1.0);
  const diagnosis::Structure structure = girder.structure();
  const diagnosis::Places places = girder.places(8, 12);
  for (const char* set : {"elements", "groups"}) {
    const diagnosis::Place& whole = places.sets.at(set).front();
    const std::vector<diagnosis::Place> halves = diagnosis::halves_of(structure, places, whole);
    ASSERT_EQ(halves.size(), 2u) << whole.id;
    const Eigen::MatrixXd sum = Eigen::MatrixXd(halves[0].stiffness.whole()) + Eigen::MatrixXd(halves[1].stiffness.whole());
    EXPECT_LT((sum - Eigen::MatrixXd(whole.stiffness.whole())).norm(), 1e-9 * sum.norm()) << whole.id;
    EXPECT_NE(halves[0].id, halves[1].id);
    EXPECT_NE(halves[0].id, whole.id);
    EXPECT_GT(std::abs(halves[0].x_m.x() - halves[1].x_m.x()), 1.0);
  }
}

TEST(ReducedModel, ExtendedByAPlaceWithoutVectorsStaysAsItIs) {
  const Chain chain(long_chain());
  diagnosis::ReducedModel grown(chain.structure(), chain.places(), {});
  const Eigen::Index before = grown.size();
  grown.extend(chain.structure(), "bare", {{"bare", Eigen::Vector3d::Zero(), {}, {}, {}, {}, {}}});
  EXPECT_EQ(grown.size(), before);
  EXPECT_TRUE(grown.place("bare", "bare")->columns.empty());
}

TEST(ReducedModel, ExtendedByAPlaceIsTheOneThatWasMadeWithIt) {
  const Chain chain(long_chain());
  diagnosis::Places with = chain.places();
  const diagnosis::Place further = diagnosis::node_place(chain.structure(), "17");
  with.sets["beside"] = {further};
  const diagnosis::ReducedModel at_once(chain.structure(), with, {});
  diagnosis::ReducedModel grown(chain.structure(), chain.places(), {});
  const auto features = chain.measure(chain.as_modelled());
  const auto families = catalogue({"mass", "stiffness"});
  const diagnosis::FeatureMap map(grown, features, {});
  const auto before = map.predict(map.base(VectorXd::Zero(std::ssize(map.nuisances()))), {}, true);
  grown.extend(chain.structure(), "beside", {further});
  ASSERT_EQ(grown.size(), at_once.size());
  const diagnosis::FeatureMap other(at_once, features, {});
  const VectorXd x = VectorXd::Constant(std::ssize(map.nuisances()), 0.3);
  const auto entries = diagnosis::instantiate(families, at_once, features),
             own = diagnosis::instantiate(families, grown, features);
  const auto entry = [](const diagnosis::Instantiated& of, const std::string& id) -> const diagnosis::Candidate& {
    for (const auto& candidate : of.candidates)
      if (candidate->id() == id) return *candidate;
    throw std::runtime_error("no entry " + id);
  };
  const auto mass = [&](const diagnosis::Instantiated& of, const diagnosis::ReducedModel& model) {
    return diagnosis::elsewhere(entry(of, "mass@node:10"), "node:17", {model.place("beside", "node:17")}, features);
  };
  const diagnosis::Candidate there = mass(entries, at_once), here = mass(own, grown);
  const VectorXd kg = VectorXd::Constant(1, std::log(3000.0)), soft = VectorXd::Constant(1, std::log(0.5));
  // Beside a cause whose place was there before, so that both places' vectors meet.
  const auto expected = other.predict(other.base(x), {{&entry(entries, "stiffness@group:g40"), soft}, {&there, kg}}, true);
  const auto found = map.predict(map.base(x), {{&entry(own, "stiffness@group:g40"), soft}, {&here, kg}}, true);
  ASSERT_TRUE(expected.valid && found.valid);
  EXPECT_LT((expected.g - found.g).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((expected.jacobian - found.jacobian).cwiseAbs().maxCoeff(), 1e-7);
  // What was there before is predicted as before, to the last bit.
  const auto after = map.predict(map.base(VectorXd::Zero(std::ssize(map.nuisances()))), {}, true);
  EXPECT_EQ((before.g - after.g).cwiseAbs().maxCoeff(), 0.0);
}

/// Where eight tonnes are hidden: at nodes that are no candidate locations; seed i + 1 draws the errors of place i.
constexpr std::array<double, 10> kHidden_m = {6.0, 10.0, 18.0, 23.0, 28.0, 33.0, 43.0, 47.0, 52.0, 57.0};
constexpr double kEightTonnes = 8000.0, kMesh_m = 1.0;

struct FoundMass {
  bool is_mass = false, alone = false;
  double off_m = 0.0, within_m = 0.0;
  std::string text;
};

FoundMass find_hidden_mass(std::size_t i, bool with_refinement) {
  const ThreeSpans girder(kMesh_m), truth(0.5 * kMesh_m, kEightTonnes, kHidden_m[i], 1.03 * ThreeSpans::kModulus);
  std::mt19937_64 random(i + 1);
  Refined refined(girder.structure(), girder.places(12, 12), truth.measured(random), families_of_girders());
  const diagnosis::Diagnosis result = refined.diagnosed(with_refinement);
  FoundMass out;
  if (result.effects.empty()) return out;
  const diagnosis::Effect& effect = result.effects.front();
  const diagnosis::Candidate& cause = *effect.cause.candidate;
  out.is_mass = cause.hypothesis->id == "mass";
  out.within_m = effect.within_m;
  if (!cause.places.empty()) out.off_m = std::abs(cause.places[0]->x_m.x() - kHidden_m[i]);
  // A mass on a spring that is stiff enough says the same (prefer_mass_to_bound).
  out.alone = std::all_of(effect.cluster.begin(), effect.cluster.end(),
                          [&](const std::string& id) { return id == cause.id() || id == "osc@" + cause.location; });
  out.text = fmt::format("{} ({:.1f} nats, {} effects): {}", name_of(result.verdict), effect.log_odds, result.effects.size(),
                         fmt::join(effect.cluster, " "));
  if (!effect.parameters.empty()) out.text += fmt::format(", {:.0f}", effect.parameters[0].value);
  return out;
}

TEST(Refinement, NamesEightTonnesBetweenTheCandidateLocations) {
  // Seeds 1 to 10. A node of the model or its neighbour, as near as the result says where it says so.
  int right = 0, alone = 0;
  for (std::size_t i = 0; i < kHidden_m.size(); ++i) {
    const FoundMass found = find_hidden_mass(i, true);
    const bool here = found.is_mass && found.off_m <= std::max(kMesh_m, found.within_m) + 1e-9;
    right += here ? 1 : 0;
    alone += here && found.alone ? 1 : 0;
    std::printf("seed %zu, %.0f m: off %.1f m, within %.1f m, %s\n", i + 1, kHidden_m[i], found.off_m, found.within_m,
                found.text.c_str());
    EXPECT_LE(found.within_m, 3.0) << i + 1;  // half of the largest distance of two candidate locations
  }
  EXPECT_EQ(right, 10);
  EXPECT_GE(alone, 9);
}

TEST(Refinement, DISABLED_EightTonnesWithTheCataloguesLocationsAlone) {
  for (std::size_t i = 0; i < kHidden_m.size(); ++i) {
    const FoundMass found = find_hidden_mass(i, false);
    std::printf("seed %zu, %.0f m: off %.1f m, %s\n", i + 1, kHidden_m[i], found.off_m, found.text.c_str());
  }
}

TEST(Refinement, LaidEntriesShareThePriorOfTheirLocation) {
  const ThreeSpans girder(kMesh_m), truth(0.5 * kMesh_m, kEightTonnes, 28.0);
  std::mt19937_64 random(11);
  Refined refined(girder.structure(), girder.places(12, 12), truth.measured(random), families_of_girders());
  const diagnosis::Fit base = refined.inference.fit({}, {});
  std::vector<diagnosis::Scored> ranking = refined.inference.search(base, {});
  diagnosis::DiagnoseOptions options;
  options.refinement = &refined.refinement;
  const Index before = refined.reduced.size();
  diagnosis::look_round_leader(refined.inference, base, ranking, options);
  EXPECT_GT(refined.reduced.size(), before);
  std::map<const diagnosis::Candidate*, double> laid;
  for (const auto& scored : ranking)
    if (scored.candidate->refines != nullptr) laid[scored.candidate->refines] += std::exp(scored.candidate->log_prior);
  ASSERT_FALSE(laid.empty());  // one of them leads
  for (const auto& [entry, sum] : laid) EXPECT_LT(sum, std::exp(entry->log_prior)) << entry->id();
}

TEST(Refinement, NothingIsLaidWhereNothingIsDetected) {
  const ThreeSpans girder(kMesh_m), truth(0.5 * kMesh_m, 0.0, 0.0, 1.03 * ThreeSpans::kModulus);
  for (unsigned seed = 21; seed < 24; ++seed) {
    std::mt19937_64 random(seed);
    Refined refined(girder.structure(), girder.places(12, 12), truth.measured(random), families_of_girders());
    const Index before = refined.reduced.size();
    EXPECT_EQ(refined.diagnosed(true).verdict, diagnosis::Verdict::none) << seed;
    EXPECT_EQ(refined.reduced.size(), before) << seed;
  }
}

TEST(Refinement, AMassLeadsWhereAnOscillatorRunsToItsBound) {
  // An oscillator at the end of its range, put first by hand: the mass has its size, and leads unless the oscillator is better
  // by more than three nats. In the measured band the oscillator stays.
  const Chain chain({.masses = 10});
  std::mt19937_64 random(7);
  ChainTruth truth = chain.scattered(random);
  truth.mass[4] += 300.0;
  const Examined e = examine(chain, chain.measure(truth, &random), catalogue({"mass", "osc"}));
  const diagnosis::Fit base = e.inference->fit({}, {});
  diagnosis::Scored fitted;
  fitted.candidate = &e.entry("mass@node:5");
  fitted.a = VectorXd::Constant(1, std::log(300.0));
  e.inference->fit_with_base(base, fitted, {});
  ASSERT_EQ(fitted.stage, 3);
  const auto leader_beside = [&](double better, double hertz) {
    diagnosis::Scored oscillator, mass;
    oscillator.candidate = &e.entry("osc@node:5");
    oscillator.a = VectorXd(2);
    oscillator.a << std::log(300.0), std::log(hertz);
    oscillator.log_odds = fitted.log_odds + better;
    mass.candidate = fitted.candidate;
    mass.a = mass.candidate->low;
    mass.log_odds = -1e300;
    std::vector<diagnosis::Scored> ranking = {oscillator, mass};
    diagnosis::prefer_mass_to_bound(*e.inference, base, ranking, 1.0, {});
    return ranking.front();
  };
  const diagnosis::Scored mass = leader_beside(2.0, 59.9);
  EXPECT_EQ(mass.candidate->id(), "mass@node:5");
  EXPECT_NEAR(std::exp(mass.a[0]) / 300.0, 1.0, 0.25);
  EXPECT_EQ(leader_beside(4.0, 59.9).candidate->id(), "osc@node:5");
  EXPECT_EQ(leader_beside(2.0, 3.0).candidate->id(), "osc@node:5");
}

// The chain is symmetric about its middle: frequencies have the same signature for a tie and for its mirror image, and that one
// is listed first. Shapes tell them apart.
TEST(PromisingTies, ShapesTellATieFromItsMirrorImage) {
  const Chain chain({.masses = 24, .modes = 10, .parameters = false});
  for (const auto& [from, to] : {std::pair{14, 20}, {13, 22}, {16, 19}}) {
    ChainTruth truth = chain.as_modelled();
    truth.tie_from = from;
    truth.tie_to = to;
    truth.tie_N_m = 1e5;
    const Refined refined(chain.structure(), chain.places(), chain.measure(truth), catalogue({"tie", "mass"}));
    std::vector<const diagnosis::ReducedPlace*> nodes;
    for (const auto& place : refined.reduced.sets.at("nodes")) nodes.push_back(&place);
    ASSERT_EQ(std::ssize(nodes), 24);
    const auto ties = diagnosis::promising_ties(refined.inference, refined.inference.fit({}, {}), nodes, 3);
    ASSERT_FALSE(ties.empty());
    EXPECT_EQ(ties[0].first->id, fmt::format("node:{}", from + 1));
    EXPECT_EQ(ties[0].second->id, fmt::format("node:{}", to + 1));
  }
}

/// Eight ties between any two nodes that are no neighbours, drawn by seeds 1 to 8.
TEST(Refinement, FindsTiesBetweenAnyTwoNodes) {
  const Chain chain({.masses = 24, .modes = 10});
  int before = 0, after = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    std::mt19937_64 random(seed);
    ChainTruth truth = chain.scattered(random);
    do {
      truth.tie_from = static_cast<int>(random() % 24);
      truth.tie_to = static_cast<int>(random() % 24);
    } while (truth.tie_to < truth.tie_from + 2);
    truth.tie_N_m = 1e6;
    const auto features = chain.measure(truth, &random);
    const std::string id = fmt::format("tie@nodes:{},{}", truth.tie_from + 1, truth.tie_to + 1);
    std::string said;
    for (const bool refine : {false, true}) {
      Refined refined(chain.structure(), chain.places(), features, catalogue({"tie", "mass", "stiffness", "gain"}));
      const diagnosis::Diagnosis result = refined.diagnosed(refine);
      const bool found = !result.effects.empty() && result.effects.front().cause.candidate->id() == id;
      (refine ? after : before) += found ? 1 : 0;
      said += fmt::format("  {}: {} {}", refine ? "after" : "before", name_of(result.verdict),
                          result.effects.empty() ? "" : fmt::format("{}", fmt::join(result.effects.front().cluster, " ")));
    }
    std::printf("seed %u, %s%s\n", seed, id.c_str(), said.c_str());
  }
  std::printf("ties found: %d before, %d after\n", before, after);
  EXPECT_GE(after, 6);
}

TEST(Refinement, DISABLED_SecondsByCandidateLocations) {
  for (const int locations : {25, 50, 100, 200}) {
    std::printf("%d locations:", locations);
    for (const bool refine : {false, true}) {
      const ThreeSpans girder(0.25), truth(0.5, kEightTonnes, 28.0);
      std::mt19937_64 random(1);
      const auto rows = truth.measured(random);
      const auto begin = std::chrono::steady_clock::now();
      Refined refined(girder.structure(), girder.places(locations, locations), rows,
                      catalogue({"mass", "osc", "prop", "joint", "tie", "gain"}));
      const auto built = std::chrono::steady_clock::now();
      const auto result = refined.diagnosed(refine);
      const auto seconds = [](auto from, auto to) { return std::chrono::duration<double>(to - from).count(); };
      std::printf("  %s %.2f s (model %.2f s)", refine ? "after" : "before", seconds(built, std::chrono::steady_clock::now()),
                  seconds(begin, built));
    }
    std::printf("\n");
  }
}

}  // namespace
}  // namespace twindeck::tests
