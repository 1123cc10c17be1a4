#include "model_io/nastran_constraints.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "model_io/inp_cards.hpp"
#include "model_io/nastran_properties.hpp"
#include "model_io/nastran_supports.hpp"
#include "model_io/rigid_arm.hpp"
#include "model_io/weighted_mean.hpp"

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

/// One displacement that an RBE3 averages.
struct Sample {
  long grid;
  int component;
  double weight;
};

bool is_real(const std::string& field) { return field.find('.') != std::string::npos; }

/// The groups of the card: weight, components, grids, over again.
std::vector<Sample> samples_of(const Parts& parts, const Card& card) {
  constexpr std::size_t first_weight = 4;
  std::vector<std::string> words;
  for (std::size_t i = first_weight; i < Deck::size(card); ++i) {
    if (!Deck::blank(card, i)) words.push_back(upper_case(Deck::text(card, i)));
  }
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < words.size() && words[i] != "ALPHA";) {
    if (words[i] == "UM") parts.deck.fail(card, "moves dependency to other grids (UM), which is not read", "leave UM out");
    Card group{card.name, {"", words[i], i + 1 < words.size() ? words[i + 1] : ""}, card.file, card.line, ""};
    group.fields[0] = Deck::text(card, 0);
    const double weight = is_real(words[i]) ? parts.deck.number(group, 1) : 0.0;
    if (!(weight > 0.0))
      parts.deck.fail(card, fmt::format("a weight is '{}', expected a number above 0 with its point", words[i]),
                      "give weight, components, grids");
    const auto chosen = components(parts, group, 2);
    const std::size_t before = samples.size();
    for (i += 2; i < words.size() && !is_real(words[i]) && words[i] != "UM" && words[i] != "ALPHA"; ++i) {
      if (!Deck::is_integer(words[i]))
        parts.deck.fail(card, fmt::format("'{}' is no grid", words[i]), "list the grids one by one");
      for (int c = 0; c < 6; ++c) {
        if (chosen[static_cast<std::size_t>(c)]) samples.push_back({std::stol(words[i]), c, weight});
      }
    }
    if (samples.size() == before) parts.deck.fail(card, "a group has no grid", "give weight, components, grids");
  }
  if (samples.empty()) parts.deck.fail(card, "averages nothing", "give weight, components, grids");
  return samples;
}

WeightedMean average_of(Parts& parts, const Card& card, long reference, const std::vector<Sample>& samples) {
  const Eigen::Vector3d at = parts.place(card, reference);
  std::vector<MeanSample> means;
  for (const Sample& sample : samples)
    means.push_back({parts.displacement_axes(card, sample.grid).row(sample.component % 3), parts.place(card, sample.grid) - at,
                     sample.component > 2, sample.weight});
  return weighted_mean(means);
}

/// The sets of MPC cards that the case control chooses.
std::set<long> chosen_multipoint(const Parts& parts) {
  const std::optional<long> chosen = parts.deck.case_control().mpc;
  std::set<long> sets;
  if (chosen) sets.insert(*chosen);
  for (const Card& card : parts.deck.cards()) {
    if (card.name == "MPCADD" && chosen && parts.deck.integer(card, 0) == *chosen) {
      for (std::size_t i = 1; i < Deck::size(card); ++i) sets.insert(parts.deck.integer(card, i));
    }
  }
  return sets;
}

/// A1 u1 + A2 u2 + … = 0. Fields: SID G1 C1 A1 G2 C2 A2, then from the second field of each further line.
void read_equation_card(Parts& parts, const Card& card) {
  const long grid = parts.deck.integer(card, 1);
  const int component = component_at(parts, card, 2);
  const double own = parts.deck.number(card, 3);
  if (own == 0.0)
    parts.deck.fail(card, "the factor of the first displacement is 0", "begin with the one that follows the others");
  std::array<bool, 6> flags{};
  flags[static_cast<std::size_t>(component)] = true;
  const std::array<bool, 6> basic = basic_components(parts, card, grid, flags);
  const int direction = static_cast<int>(std::find(basic.begin(), basic.end(), true) - basic.begin());
  const double sign = parts.displacement_axes(card, grid)(component % 3, direction % 3) > 0.0 ? 1.0 : -1.0;
  fe::Constraint c{
      fmt::format("mpc_{}_grid_{}_{}", Deck::text(card, 0), grid, component + 1), parts.node(card, grid), direction, {}};
  for (std::size_t i = 4; i < Deck::size(card); i += i % 8 == 4 ? 5 : 3) {
    if (Deck::blank(card, i)) continue;
    const long other = parts.deck.integer(card, i);
    if (parts.scalar_points.contains(other))
      parts.deck.fail(card, fmt::format("follows the scalar point {}, which is not read", other), "put a GRID in its place");
    const double factor = -sign * parts.deck.number(card, i + 2) / own;
    if (factor == 0.0) continue;
    for (const auto& term : terms_of(parts, card, other, component_at(parts, card, i + 1), factor)) c.terms.push_back(term);
  }
  if (c.terms.empty()) parts.deck.fail(card, "follows nothing", "hold the displacement by SPC1");
  parts.model.constraints.push_back(c);
}

}  // namespace

void read_average(Parts& parts, const Card& card) {
  const long reference = parts.deck.integer(card, 2);
  const std::array<bool, 6> wanted = basic_components(parts, card, reference, components(parts, card, 3));
  const std::vector<Sample> samples = samples_of(parts, card);
  const WeightedMean average = average_of(parts, card, reference, samples);
  for (int k = 0; k < 6; ++k) {
    if (!wanted[static_cast<std::size_t>(k)]) continue;
    if (!average.determined[static_cast<std::size_t>(k)])
      parts.deck.fail(card, fmt::format("its grids do not determine component {} of grid {}", k + 1, reference),
                      "average grids that do not lie on one line, or take the component out of REFC");
    fe::Constraint c{fmt::format("rbe3_{}_{}", Deck::text(card, 0), k + 1), parts.node(card, reference), k, {}};
    const double largest = average.of_samples.row(k).cwiseAbs().maxCoeff();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double factor = average.of_samples(k, static_cast<Eigen::Index>(i));
      if (std::abs(factor) <= nothing * largest) continue;
      for (const auto& term : terms_of(parts, card, samples[i].grid, samples[i].component, factor)) c.terms.push_back(term);
    }
    parts.model.constraints.push_back(c);
  }
}

void tie_some(Parts& parts, const Card& card, long independent, long dependent, const std::array<bool, 6>& tied) {
  const std::array<bool, 6> basic = basic_components(parts, card, dependent, tied);
  const int master = parts.node(card, independent), slave = parts.node(card, dependent);
  for (int d = 0; d < 6; ++d) {
    if (!basic[static_cast<std::size_t>(d)]) continue;
    const std::string name = fmt::format("rbe2_{}_{}_{}", Deck::text(card, 0), dependent, d + 1);
    parts.model.constraints.push_back(at_rigid_arm(name, parts.model, master, slave, d));
  }
}

void read_multipoint(Parts& parts) {
  const std::set<long> sets = chosen_multipoint(parts);
  for (const Card& card : parts.deck.cards()) {
    if (card.name != "MPC") continue;
    if (parts.deck.case_control().present && !sets.contains(parts.deck.integer(card, 0))) {
      note_once(parts, "MPC cards that the case control does not choose are left out");
    } else if (parts.scalar_points.contains(parts.deck.integer(card, 1))) {
      note_once(parts, "MPC cards that give a motion to a scalar point are left out: they measure and hold nothing");
    } else if (!parts.deck.case_control().present) {
      parts.deck.fail(card, "ties grids by an equation, but no case control chooses its set",
                      "put \"MPC = 1\" and \"BEGIN BULK\" above the cards; a rigid joint is RBE2 or RBAR");
    } else {
      read_equation_card(parts, card);
    }
  }
}

}  // namespace twindeck::model_io::nastran
