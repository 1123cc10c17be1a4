// Oracle: a model folder holds a stay that swings: written and read it has the same frequencies and pulls.
#include <gtest/gtest.h>

#include "dynamics/eigenmodes.hpp"
#include "fe/assembly.hpp"
#include "fe/cable.hpp"
#include "model_io/any_model_folder.hpp"
#include "model_io/write_model.hpp"
#include "test_folder.hpp"

namespace twindeck::model_io {
namespace {

/// A cantilever that a stay under 50 kN holds at its end.
fe::Model held_cantilever() {
  fe::Model model;
  model.source = "held_cantilever";
  model.materials = {{"steel", 200e9, 80e9, 0.25, 8000.0}, {"rope", 165e9, 65e9, 0.3, 8000.0}};
  fe::Section girder, rope;
  girder.name = "girder";
  girder.area_m2 = 0.01;
  girder.inertia_y_m4 = girder.inertia_z_m4 = 4e-5;
  girder.torsion_m4 = 3e-5;
  rope.name = "rope";
  rope.area_m2 = 5e-4;
  model.sections = {girder, rope};
  for (int i = 0; i < 5; ++i) model.nodes.push_back({i + 1, {5.0 * i, 0.0, 0.0}});
  model.nodes.push_back({6, {0.0, 0.0, 10.0}});
  for (int i = 0; i < 4; ++i) {
    fe::Element beam;
    beam.id = i + 1;
    beam.group = "girder";
    beam.material = beam.section = 0;
    beam.nodes = {i, i + 1};
    model.elements.push_back(beam);
  }
  fe::Element stay;
  stay.id = 5;
  stay.type = fe::ElementType::stay;
  stay.name = stay.group = "S1";
  stay.material = stay.section = 1;
  stay.nodes = {4, 5};
  stay.pull_N = 50e3;
  model.elements.push_back(stay);
  model.supports = {{"wall", 0, {true, true, true, true, true, true}}, {"head", 5, {true, true, true, false, false, false}}};
  model.prestress.rule = fe::PullRule::given;
  return model;
}

Eigen::VectorXd frequencies(const fe::Model& model) {
  const Eigen::VectorXd theta = fe::initial_parameters(model);
  const fe::ParametricSystem system = fe::assemble(model, fe::find_prestress(model, theta));
  return dynamics::ModalSolver(system).solve(theta, 8).frequency_Hz;
}

TEST(SwingingStays, AModelFolderHoldsThem) {
  const test::TestFolder folder;
  const fe::Model bars = held_cantilever();
  const fe::Model model = fe::with_swinging_stays(bars, {{4, 50e3}}, 6);
  write_model(model, folder.path() / "model");
  const fe::Model read = read_model(folder.path() / "model");
  const Eigen::VectorXd before = frequencies(model), after = frequencies(read);
  ASSERT_EQ(before.size(), after.size());
  EXPECT_LT(((after - before).array() / before.array()).abs().maxCoeff(), 1e-9);
  const auto pull = [](const fe::Model& m) { return fe::find_prestress(m, fe::initial_parameters(m)); };
  EXPECT_LT((pull(model).axial_force_N - pull(bars).axial_force_N).norm(), 1e-6 * pull(bars).axial_force_N.norm());
  EXPECT_GT((frequencies(bars) - before).norm(), 0.1);
}

}  // namespace
}  // namespace twindeck::model_io
