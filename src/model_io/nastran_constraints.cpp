#include "model_io/nastran_constraints.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "model_io/nastran_properties.hpp"
#include "model_io/nastran_supports.hpp"

namespace twindeck::model_io::nastran {
namespace {

constexpr double nothing = 1e-12;  ///< [-] of a factor next to 1: rounding of directions and sums

/// The motion of one component of a grid by the three displacements or rotations of its node.
std::vector<fe::Constraint::Term> terms_of(Parts& parts, const Card& card, long grid, int component, double factor) {
  const Eigen::RowVector3d direction = parts.displacement_axes(card, grid).row(component % 3);
  const int node = parts.node(card, grid), first = component < 3 ? 0 : 3;
  std::vector<fe::Constraint::Term> terms;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(direction[i]) > nothing) terms.push_back({node, first + i, factor * direction[i]});
  }
  return terms;
}

bool is_real(const std::string& field) { return field.find('.') != std::string::npos; }

/// The groups of the card: weight, components, grids, over again.
std::vector<DeckModel::Sample> samples_of(Parts& parts, const Card& card) {
  constexpr std::size_t first_weight = 4;
  std::vector<std::string> words;
  for (std::size_t i = first_weight; i < card.size(); ++i) {
    if (!card.blank(i)) words.push_back(card.word(i));
  }
  std::vector<DeckModel::Sample> samples;
  for (std::size_t i = 0; i < words.size() && words[i] != "ALPHA";) {
    if (words[i] == "UM") card.fail("moves dependency to other grids (UM), which is not read", "leave UM out");
    const DeckFields group{card, {"", words[i], i + 1 < words.size() ? words[i + 1] : ""}, card.dialect};
    const double weight = is_real(words[i]) ? group.number(1) : 0.0;
    if (!(weight > 0.0))
      card.fail(fmt::format("a weight is '{}', expected a number above 0 with its point", words[i]),
                "give weight, components, grids");
    const auto chosen = components(group, 2);
    const std::size_t before = samples.size();
    for (i += 2; i < words.size() && !is_real(words[i]) && words[i] != "UM" && words[i] != "ALPHA"; ++i) {
      if (!is_whole_number(words[i])) card.fail(fmt::format("'{}' is no grid", words[i]), "list the grids one by one");
      const long grid = std::stol(words[i]);
      for (int c = 0; c < 6; ++c) {
        if (chosen[fe::slot(c)])
          samples.push_back({parts.node(card, grid), parts.displacement_axes(card, grid).row(c % 3), c > 2, weight});
      }
    }
    if (samples.size() == before) card.fail("a group has no grid", "give weight, components, grids");
  }
  if (samples.empty()) card.fail("averages nothing", "give weight, components, grids");
  return samples;
}

/// The sets of MPC cards that the case control chooses.
std::set<long> chosen_multipoint(const Parts& parts) {
  const std::optional<long> chosen = parts.deck.case_control().mpc;
  std::set<long> sets;
  if (chosen) sets.insert(*chosen);
  for (const Card& card : parts.deck.cards()) {
    if (card.name == "MPCADD" && chosen && card.integer(0) == *chosen) {
      for (std::size_t i = 1; i < card.size(); ++i) sets.insert(card.integer(i));
    }
  }
  return sets;
}

/// A1 u1 + A2 u2 + … = 0. Fields: SID G1 C1 A1 G2 C2 A2, then from the second field of each further line.
void read_equation_card(Parts& parts, const Card& card) {
  const long grid = card.integer(1);
  const int component = card.component(2);
  const double own = card.number(3);
  if (own == 0.0) card.fail("the factor of the first displacement is 0", "begin with the one that follows the others");
  Directions flags{};
  flags[static_cast<std::size_t>(component)] = true;
  const Directions basic = basic_components(parts, card, grid, flags);
  const int direction = static_cast<int>(std::find(basic.begin(), basic.end(), true) - basic.begin());
  const double sign = parts.displacement_axes(card, grid)(component % 3, direction % 3) > 0.0 ? 1.0 : -1.0;
  fe::Constraint c{fmt::format("mpc_{}_grid_{}_{}", card.text(0), grid, component + 1), parts.node(card, grid), direction, {}};
  for (std::size_t i = 4; i < card.size(); i += i % 8 == 4 ? 5 : 3) {
    if (card.blank(i)) continue;
    const long other = card.integer(i);
    if (parts.scalar_points.contains(other))
      card.fail(fmt::format("follows the scalar point {}, which is not read", other), "put a GRID in its place");
    const double factor = -sign * card.number(i + 2) / own;
    if (factor == 0.0) continue;
    for (const auto& term : terms_of(parts, card, other, card.component(i + 1), factor)) c.terms.push_back(term);
  }
  if (c.terms.empty()) card.fail("follows nothing", "hold the displacement by SPC1");
  parts.add_constraint(c, card);
}

}  // namespace

void read_average(Parts& parts, const Card& card) {
  const long reference = card.integer(2);
  const Directions wanted = basic_components(parts, card, reference, components(card, 3));
  parts.tie_to_mean(
      card, [&](int d) { return fmt::format("rbe3_{}_{}", card.text(0), d + 1); }, parts.node(card, reference),
      samples_of(parts, card), wanted, "average grids that do not lie on one line, or take the component out of REFC");
}

void tie_some(Parts& parts, const Card& card, long independent, long dependent, const Directions& tied) {
  const Directions basic = basic_components(parts, card, dependent, tied);
  const int master = parts.node(card, independent), slave = parts.node(card, dependent);
  parts.tie_at_arm(
      card, [&](int d) { return fmt::format("rbe2_{}_{}_{}", card.text(0), dependent, d + 1); }, master, slave, basic);
}

void read_multipoint(Parts& parts) {
  const std::set<long> sets = chosen_multipoint(parts);
  for (const Card& card : parts.deck.cards()) {
    if (card.name != "MPC") continue;
    if (parts.deck.case_control().present && !sets.contains(card.integer(0))) {
      parts.note_once("MPC cards that the case control does not choose are left out");
    } else if (parts.scalar_points.contains(card.integer(1))) {
      parts.note_once("MPC cards that give a motion to a scalar point are left out: they measure and hold nothing");
    } else if (!parts.deck.case_control().present) {
      card.fail("ties grids by an equation, but no case control chooses its set",
                "put \"MPC = 1\" and \"BEGIN BULK\" above the cards; a rigid joint is RBE2 or RBAR");
    } else {
      read_equation_card(parts, card);
    }
  }
}

}  // namespace twindeck::model_io::nastran
