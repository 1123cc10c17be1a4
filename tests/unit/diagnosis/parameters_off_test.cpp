// Causes where the fit has moved the parameters. Oracles: the extended model, which has the fitted values and the cause
// written into its materials and springs, as a finite element model of its own; central differences.
#include <gtest/gtest.h>

#include "diagnosis/full_check.hpp"
#include "diagnosis/reduction/diagnosed_model.hpp"
#include "unit/diagnosis/found_causes.hpp"
#include "unit/fe/assembly_models.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::FeatureMap;
using diagnosis::ReducedPlace;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// A girder of six beams in the plane of x and z, the middle two of another steel, on three bearings of one group, hung to
/// one stay. Its parameters are both moduli, the area, the bearings and the rope.
fe::Model hung_girder() {
  fe::Model model = fe::test::with_steel();
  model.prestress.rule = fe::PullRule::given;
  model.materials.push_back({"strong", 210e9, 84e9, 0.25, 8000.0});
  model.materials.push_back({"rope", 165e9, 60e9, 0.3, 8000.0});
  fe::Section rope = model.sections[0];
  rope.name = "rope";
  rope.area_m2 = 1e-3;
  model.sections.push_back(rope);
  for (int i = 0; i < 7; ++i) fe::test::add_node(model, 3.0 * i, 0.0, 0.0);
  const int anchor = fe::test::add_node(model, 15.0, 0.0, 8.0);
  for (int i = 0; i < 6; ++i)
    fe::test::add_element(model, fe::ElementType::beam, "girder", i == 2 || i == 3 ? 1 : 0, 0, {i, i + 1});
  fe::Element& stay = fe::test::add_element(model, fe::ElementType::stay, "ropes", 2, 1, {anchor, 4});
  stay.name = "A";
  stay.pull_N = 2e5;
  fe::test::fix(model, anchor);
  for (int i = 0; i < 7; ++i) model.supports.push_back({"", i, {false, true, false, true, false, true}});
  model.springs = {spring("stop", "stop", 0, -1, 4e7)};
  for (const int node : {0, 2, 6})
    model.springs.push_back(spring("z" + std::to_string(node), "pads", node, -1, 2e6, Vector3d::UnitZ()));
  model.springs[2].group = "pier";
  model.parameters = {{"E_s", fe::Target::youngs_modulus, {"steel"}, "Pa", 200e9, 140e9, 280e9},
                      {"E_strong", fe::Target::youngs_modulus, {"strong"}, "Pa", 210e9, 140e9, 280e9},
                      {"A", fe::Target::area, {"girder"}, "m2", 0.01, 0.005, 0.02},
                      {"k", fe::Target::spring_stiffness, {"pads", "pier"}, "-", 1.0, 0.3, 3.0},
                      {"E_r", fe::Target::youngs_modulus, {"rope"}, "Pa", 165e9, 100e9, 200e9}};
  return model;
}

/// The girder as it is diagnosed, in zones of several elements, with the first five frequencies as rows.
class HungGirder {
 public:
  explicit HungGirder(int zones = 3) : prepared(ready(hung_girder())), structure(prepared.structure()) {
    structure.sensors = [](const MatrixXd& v) { return MatrixXd(MatrixXd::Zero(0, v.cols())); };
    diagnosis::PlaceOptions options;
    options.max_zones = zones;
    places = diagnosis::find_places(structure, options);
    reduced = std::make_unique<diagnosis::ReducedModel>(structure, places, diagnosis::ReductionOptions{});
    diagnosis::FeatureSet features;
    features.conditions.emplace_back();
    for (int i = 0; i < 5; ++i)
      features.rows.push_back({diagnosis::RowType::frequency, std::to_string(i + 1), -1, "", 0, reduced->frequency_Hz[i],
                               0.01 * reduced->frequency_Hz[i], false});
    map = std::make_unique<FeatureMap>(*reduced, features, diagnosis::ScatterOptions{});
    for (int i = 0; i < 5; ++i) bound[std::to_string(i + 1)] = i;
    map->bind_modes(bound);
  }
  [[nodiscard]] const ReducedPlace* place(const std::string& set, std::size_t i) const { return &reduced->sets.at(set)[i]; }
  /// Parameters off their values by two fifths of their range and no scatter.
  [[nodiscard]] VectorXd off() const {
    VectorXd x = VectorXd::Zero(std::ssize(map->nuisances()));
    double sign = -1.0;
    for (Index j = 0; j < x.size(); ++j) {
      const auto& v = map->nuisances()[static_cast<std::size_t>(j)];
      if (v.kind != diagnosis::Nuisance::Kind::parameter) continue;
      x[j] = 0.8 * (sign < 0.0 ? v.lower : v.upper);
      sign = -sign;
    }
    return x;
  }
  /// The extended model has the frequencies that the fit and the full model have.
  void expect(const At& cause) const {
    diagnosis::Fit fit;
    fit.causes = {cause.cause()};
    fit.base = map->base(off());
    const auto check = diagnosis::check_against_full(structure, places, *map, fit, 12);
    const auto extended = diagnosis::extended_model(prepared, places, diagnosis_with({&cause}, fit.base.theta));
    ASSERT_EQ(extended.holds, std::vector<bool>{true}) << cause.candidate.location;
    const VectorXd expected = model_hertz(*extended.elements, 5);
    const auto predicted = map->predict(fit.base, fit.causes, false);
    ASSERT_TRUE(predicted.valid);
    for (int i = 0; i < 5; ++i) {
      EXPECT_NEAR(check.full_Hz[i] / expected[i], 1.0, 1e-7) << cause.candidate.location << " mode " << i + 1;
      EXPECT_NEAR(check.reduced_Hz[i] / expected[i], 1.0, 1e-7) << cause.candidate.location << " mode " << i + 1;
      EXPECT_NEAR(std::exp(predicted.g[i]) / check.reduced_Hz[predicted.paired[static_cast<std::size_t>(i)]], 1.0, 1e-7);
    }
  }
  /// Slopes of the frequencies by the parameters against central differences, whose error is 1e-7 of them.
  void expect_slopes(const At& cause) const {
    const VectorXd x = off();
    const MatrixXd slope = map->predict(map->base(x), {cause.cause()}, true).jacobian;
    for (Index j = 0; j < x.size(); ++j) {
      if (map->nuisances()[static_cast<std::size_t>(j)].kind != diagnosis::Nuisance::Kind::parameter) continue;
      constexpr double h = 1e-3;
      const auto moved = [&](double step) {
        return map->predict(map->base(x + step * VectorXd::Unit(x.size(), j)), {cause.cause()}, false).g;
      };
      const VectorXd difference = (moved(h) - moved(-h)) / (2.0 * h);
      EXPECT_LT((slope.col(j) - difference).norm(), 1e-5 * slope.norm())
          << cause.candidate.location << " by " << map->nuisances()[static_cast<std::size_t>(j)].name;
    }
  }

  diagnosis::DiagnosedModel prepared;
  diagnosis::Structure structure;
  diagnosis::Places places;
  std::unique_ptr<diagnosis::ReducedModel> reduced;
  std::unique_ptr<FeatureMap> map;
  std::map<std::string, int> bound;
};

At cause_at(const HungGirder& of, const std::string& kind, const std::map<std::string, double>& numbers, const std::string& set,
            std::size_t i) {
  return {kind, numbers, set, of.place(set, i)->id, {of.place(set, i)}};
}

TEST(ParametersOff, AFactorIsOnWhatTheParametersHaveMadeOfItsPart) {
  const HungGirder whole;
  for (const std::string set : {"elements", "supports", "groups"})
    for (std::size_t i = 0; i < whole.reduced->sets.at(set).size(); ++i) {
      if (const std::string& id = whole.place(set, i)->id; id == "group:A" || id == "group:E_r") continue;  // not by a factor
      At soft = cause_at(whole, "scale.stiffness", {{"factor", 0.3}}, set, i);
      whole.expect(soft);
      whole.expect_slopes(soft);
    }
  for (std::size_t i = 0; i < 3; ++i) {
    const At heavy = cause_at(whole, "scale.mass", {{"factor", 1.5}}, "elements", i);
    whole.expect(heavy);
    whole.expect_slopes(heavy);
  }
  whole.expect_slopes(cause_at(whole, "scale.stiffness", {{"factor", 0.3}}, "stays", 0));
  whole.expect_slopes(cause_at(whole, "scale.stiffness", {{"factor", 0.3}}, "groups", 2));
}

TEST(ParametersOff, ASupportIsMovedAsTheParameterHasMadeIt) {
  const HungGirder whole;
  const auto& moves = whole.reduced->sets.at("support_moves");
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (moves[i].id != "support:pier") continue;
    const At there =
        cause_at(whole, "support.move", {{"position", 9.0}}, "support_moves", i);  // at a node, as a model folder says it
    whole.expect(there);
    whole.expect_slopes(cause_at(whole, "support.move", {{"position", 10.3}}, "support_moves", i));
    return;
  }
  FAIL() << "the pier cannot be moved";
}

}  // namespace
}  // namespace twindeck::tests
