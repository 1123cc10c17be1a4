#include "model_io/sap2000_constraints.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace twindeck::model_io {
namespace {

constexpr double level_width = 1e-4;  ///< [-] of the extent of all joints: below, two lie in one plane; files round coordinates

/// The global axis across the joints' plane.
int normal_of(const SapConstraint& constraint, const Eigen::AlignedBox3d& extent) {
  if (constraint.axis != "AUTO") {
    const std::size_t axis = std::string("XYZ").find(constraint.axis);
    if (constraint.axis.size() != 1 || axis > 2)
      constraint.at.fail(fmt::format("Axis is '{}', expected X, Y, Z or Auto", constraint.axis), "give the normal");
    return static_cast<int>(axis);
  }
  for (const int axis : {2, 0, 1})
    if (extent.sizes()[axis] <= level_width * extent.diagonal().norm()) return axis;
  constraint.at.fail("its Axis is Auto, and its joints lie in no plane across a global axis",
                     "give Axis=Z, X or Y, and MultiLevel=Yes for several floors");
}

void tie_rigid(DeckModel& deck, const SapConstraint& constraint, const std::vector<int>& joints, const Directions& tied) {
  std::map<int, Directions> supports;
  for (const fe::Support& support : deck.model.supports) supports[support.node] = support.fixed;
  const auto held = [&](int node, int d) { return supports.contains(node) && supports.at(node)[fe::slot(d)]; };
  const int master = *std::ranges::max_element(joints, {}, [&](int node) {
    int count = 0;
    for (int d = 0; d < 6; ++d) count += tied[fe::slot(d)] && held(node, d);
    return count;
  });
  for (const int slave : joints) {
    if (slave == master) continue;
    std::vector<fe::Constraint> equations;
    for (int d = 0; d < 6; ++d) {
      if (!tied[fe::slot(d)]) continue;
      const std::string name = fmt::format("{}_{}_{}", constraint.name, deck.model.nodes[fe::slot(slave)].id, d + 1);
      fe::Constraint c = at_rigid_arm(name, deck.model, master, slave, d);
      std::erase_if(c.terms, [&](const auto& term) { return !tied[fe::slot(term.direction)]; });  // in the plane alone
      if (!held(slave, d) || !std::ranges::all_of(c.terms, [&](const auto& term) { return held(master, term.direction); }))
        equations.push_back(c);
    }
    if (equations.size() == 6) deck.add_link(master, slave);
    for (std::size_t i = 0; i < equations.size() && equations.size() < 6; ++i) deck.add_constraint(equations[i], constraint.at);
  }
}

}  // namespace

void tie_joints(DeckModel& deck, const SapConstraint& constraint) {
  std::vector<int> joints = constraint.joints;
  if (constraint.axis.empty()) return tie_rigid(deck, constraint, joints, {true, true, true, true, true, true});
  Eigen::AlignedBox3d extent;
  for (const int node : joints) extent.extend(deck.place(node));
  const int normal = normal_of(constraint, extent);
  Directions tied = {true, true, true, false, false, false};
  tied[fe::slot(normal)] = false;
  tied[fe::slot(normal + 3)] = true;
  if (!constraint.by_level) return tie_rigid(deck, constraint, joints, tied);
  const auto height = [&](int node) { return deck.place(node)[normal]; };
  std::ranges::stable_sort(joints, {}, height);
  while (!joints.empty()) {
    const auto above = std::ranges::adjacent_find(
        joints, [&](int low, int high) { return height(high) - height(low) > level_width * extent.diagonal().norm(); });
    const auto end = above == joints.end() ? above : above + 1;
    tie_rigid(deck, constraint, {joints.begin(), end}, tied);
    joints.erase(joints.begin(), end);
  }
}

}  // namespace twindeck::model_io
