#include "model_io/inp_coupling.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/error.hpp"
#include "model_io/rigid_arm.hpp"
#include "model_io/weighted_mean.hpp"

namespace twindeck::model_io {
namespace {

using Directions = std::array<bool, 6>;

/// The range that two fields name, added to `chosen`; one alone is itself. @param first_field  all six where it is empty
void choose_range(const InpParts& parts, const InpCard& card, const InpLine& line, std::size_t first_field,
                  Directions& chosen) {
  const auto given = [&](std::size_t i) { return i < line.fields.size() && !line.fields[i].empty(); };
  const long first = given(first_field) ? parts.file.integer(card, line, first_field) : 1;
  const long last = given(first_field + 1) ? parts.file.integer(card, line, first_field + 1) : given(first_field) ? first : 6;
  if (first < 1 || last > 6 || last < first)
    parts.file.fail(card, line.line, fmt::format("'{}, {}' are no degrees of freedom", first, last),
                    "1-3 displacements, 4-6 rotations; nothing for all");
  for (long dof = first; dof <= last; ++dof) chosen[static_cast<std::size_t>(dof) - 1] = true;
}

bool all(const Directions& d, std::size_t first, std::size_t end) {
  for (std::size_t i = first; i < end; ++i) {
    if (!d[i]) return false;
  }
  return true;
}

/// A slave that follows the reference node in some directions: a link where they are all that it has.
void follow(InpParts& parts, const InpCard& card, long line, int master, long slave_id, const Directions& tied) {
  const int slave = parts.node(card, line, slave_id);
  if (slave == master) return;
  if (all(tied, 0, 3) && (all(tied, 3, 6) || !parts.turning_nodes().contains(slave_id))) return parts.add_link(master, slave);
  if (parts.scopes[static_cast<std::size_t>(parts.scope)].turned())
    parts.file.fail(card, line, "ties some directions in an instance that is rotated, where they are not sure",
                    "write the card at the level of the assembly");
  for (int d = 0; d < 6; ++d) {
    if (tied[static_cast<std::size_t>(d)])
      parts.add_constraint(
          at_rigid_arm(fmt::format("coupling_{}", parts.model.constraints.size() + 1), parts.model, master, slave, d), card,
          line);
  }
}

/// The reference node as the mean of nodes, in its displacements and the rotations that are asked for.
void take_mean(InpParts& parts, const InpCard& card, const InpCard& kind, int reference, const std::vector<long>& nodes,
               const Directions& wanted) {
  const Eigen::Vector3d at = parts.model.nodes[static_cast<std::size_t>(reference)].x_m;
  std::vector<MeanSample> samples;
  std::vector<fe::Constraint::Term> displacements;
  for (const long id : nodes) {
    const int node = parts.node(card, card.line, id);
    if (node == reference)
      parts.file.fail(card, card.line, "the reference node lies on its own surface", "take a node beside the surface");
    for (int d = 0; d < 3; ++d) {
      samples.push_back({Eigen::RowVector3d::Unit(d), parts.model.nodes[static_cast<std::size_t>(node)].x_m - at, false, 1.0});
      displacements.push_back({node, d, 0.0});
    }
  }
  const WeightedMean mean = weighted_mean(samples);
  for (int d = 0; d < 6; ++d) {
    if (!wanted[static_cast<std::size_t>(d)]) continue;
    if (!mean.determined[static_cast<std::size_t>(d)])
      parts.file.fail(kind, kind.line,
                      fmt::format("its nodes do not determine degree of freedom {} of the reference node", d + 1),
                      "couple nodes that do not lie on one line, or name the degrees of freedom that are coupled");
    constexpr double nothing = 1e-12;  ///< [-] of the largest factor: rounding
    const double largest = mean.of_samples.row(d).cwiseAbs().maxCoeff();
    fe::Constraint c{fmt::format("coupling_{}", parts.model.constraints.size() + 1), reference, d, {}};
    for (std::size_t i = 0; i < displacements.size(); ++i) {
      const double factor = mean.of_samples(d, static_cast<Eigen::Index>(i));
      if (std::abs(factor) > nothing * largest) c.terms.push_back({displacements[i].node, displacements[i].direction, factor});
    }
    parts.add_constraint(c, card, card.line);
  }
}

}  // namespace

void attach_inp_coupling(InpParts& parts, const InpCard& card) {
  parts.file.allow(card, {"CONSTRAINT NAME", "REF NODE", "SURFACE"});
  const InpSurface& surface = parts.surface(card, card.line, parts.file.required(card, "SURFACE"));
  const int reference = parts.reference_node(card);
  const InpCard* kind = parts.card_after(card);
  if (kind == nullptr || (kind->keyword != "KINEMATIC" && kind->keyword != "DISTRIBUTING"))
    parts.file.fail(card, card.line, "is followed by neither *KINEMATIC nor *DISTRIBUTING", "say how the surface is coupled");
  Directions chosen{};
  for (const InpLine& line : kind->data) choose_range(parts, *kind, line, 0, chosen);
  if (kind->data.empty()) chosen.fill(true);
  if (kind->keyword == "KINEMATIC") {
    parts.file.allow(*kind, {});
    for (const long id : surface.nodes) follow(parts, card, card.line, reference, id, chosen);
    return;
  }
  parts.file.allow(*kind, {"WEIGHTING METHOD", "COUPLING", "ROTATIONAL COUPLING"});
  const auto only = [&](const char* parameter, const char* word) {
    if (upper_case(kind->get(parameter, word)) != word)
      parts.file.fail(*kind, kind->line, fmt::format("unsupported {}={}", parameter, kind->get(parameter)),
                      fmt::format("{} is read", word));
  };
  only("WEIGHTING METHOD", "UNIFORM");
  only("COUPLING", "CONTINUUM");
  only("ROTATIONAL COUPLING", "CONTINUUM");
  // Displacements of the reference node are coupled whatever the data lines say, as in Abaqus.
  for (std::size_t d = 0; d < 3; ++d) chosen[d] = true;
  take_mean(parts, card, *kind, reference, surface.nodes, chosen);
  parts.notes.push_back(
      fmt::format("*DISTRIBUTING (line {}): every node of '{}' has the same weight", kind->line, surface.name));
}

void attach_inp_kinematic_coupling(InpParts& parts, const InpCard& card) {
  parts.file.allow(card, {"REF NODE"});
  const int reference = parts.reference_node(card);
  for (const InpLine& line : card.data) {
    Directions chosen{};
    choose_range(parts, card, line, 1, chosen);
    for (const long id : parts.nodes_of(card, line, 0)) follow(parts, card, line.line, reference, id, chosen);
  }
}

}  // namespace twindeck::model_io
