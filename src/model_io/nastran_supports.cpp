#include "model_io/nastran_supports.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "model_io/nastran_properties.hpp"

/// Supports and rigid links.
namespace twindeck::model_io::nastran {
namespace {

/// Three of a grid's components in its displacement axes as components in basic axes. They are whole (all or none) or each axis
/// lies along a basic one; else the support is skew, which a model does not have.
std::array<bool, 3> in_basic(const Card& card, long grid, const Eigen::Matrix3d& axes, const std::array<bool, 3>& local) {
  if (local[0] == local[1] && local[1] == local[2]) return local;
  std::array<bool, 3> basic{};
  for (int i = 0; i < 3; ++i) {
    if (!local[static_cast<std::size_t>(i)]) continue;
    Eigen::Index along = 0;
    constexpr double aligned = 1.0 - 1e-9;
    if (axes.row(i).cwiseAbs().maxCoeff(&along) < aligned)
      card.fail(fmt::format("ties grid {} along an axis of its system CD that is skew to the basic ones", grid),
                "use a stiff CELAS2 there, which may be skew, or turn the model");
    basic[static_cast<std::size_t>(along)] = true;
  }
  return basic;
}

/// Six components of a grid in its displacement system as components in basic axes.
/// @throws InputError  where the axes are skew and only some of three components are meant
Directions basic_components(Parts& parts, const Card& card, long grid, const Directions& local) {
  const Eigen::Matrix3d axes = parts.displacement_axes(card, grid);
  const auto shift = in_basic(card, grid, axes, {local[0], local[1], local[2]});
  const auto turn = in_basic(card, grid, axes, {local[3], local[4], local[5]});
  return {shift[0], shift[1], shift[2], turn[0], turn[1], turn[2]};
}

void hold(Parts& parts, const Card& card, long grid, const Directions& local) {
  auto& [held, by] = parts.held[grid];
  by = &card;
  for (std::size_t i = 0; i < 6; ++i) held[i] = held[i] || local[i];
}

bool is_set_card(const Card& card) { return card.name == "SPC" || card.name == "SPC1"; }

/// Numbers of the sets that hold: the chosen one, with those that SPCADD puts together.
std::set<long> chosen_sets(Parts& parts) {
  std::set<long> all, chosen;
  for (const Card& card : parts.deck.cards())
    if (is_set_card(card)) all.insert(card.integer(0));
  const CaseControl& control = parts.deck.case_control();
  if (control.spc) {
    chosen.insert(*control.spc);
  } else if (!control.present && all.size() == 1) {
    chosen = all;
    parts.notes.push_back(fmt::format("the deck has no case control: its only set of supports, {}, is taken", *all.begin()));
  } else if (!control.present && all.size() > 1) {
    parts.deck.whole("SPC").fail(
        fmt::format("the deck has {} sets of supports and no case control that chooses one", all.size()),
        "put \"SPC = 1\" and \"BEGIN BULK\" above the cards");
  } else if (!all.empty()) {
    parts.notes.push_back("SPC and SPC1 cards are left out: the case control chooses no set of them");
  }
  for (const Card& card : parts.deck.cards()) {
    if (card.name != "SPCADD" || chosen.count(card.integer(0)) == 0) continue;
    for (std::size_t i = 1; i < card.size(); ++i) chosen.insert(card.integer(i));
  }
  if (control.spc && std::ranges::none_of(chosen, [&](long id) { return all.contains(id); }))
    parts.deck.whole("SPC").fail(
        fmt::format("the case control chooses the supports {}, which no SPC or SPC1 card has", *control.spc),
        "give the cards, or mend the number");
  return chosen;
}

void read_support_card(Parts& parts, const Card& card) {
  if (card.name == "SPC1") {
    const auto flags = components(card, 1);
    for (const long grid : parts.grid_list(card, 2, false)) hold(parts, card, grid, flags);
    return;
  }
  for (std::size_t i = 1; i < card.size(); i += 3) {
    if (card.blank(i)) continue;
    hold(parts, card, card.integer(i), components(card, i + 1));
    const auto& subcases = parts.deck.case_control().subcases;
    const bool loaded = std::ranges::any_of(subcases, [](const Subcase& s) { return s.chosen.contains("STATSUB"); });
    if (card.number_or(i + 2, 0.0) != 0.0 && !loaded)
      parts.note_once("prescribed displacements of SPC cards are taken as zero: they do not enter modes");
  }
}

void add_rigid(Parts& parts, const Card& card, long independent, long dependent) {
  parts.add_link(parts.node(card, independent), parts.node(card, dependent),
                 fmt::format("{}_{}_{}", card.name == "RBE2" ? "rbe2" : "rbar", card.text(0), dependent));
}

void read_rbar(Parts& parts, const Card& card) {
  const auto all_six = [&](std::size_t i) {
    std::string digits = card.text(i);
    std::ranges::sort(digits);
    return digits == "123456";
  };
  const bool a_leads = all_six(3) && card.blank(4) && (card.blank(6) || all_six(6)) && card.blank(5);
  const bool b_leads = all_six(4) && card.blank(3) && (card.blank(5) || all_six(5)) && card.blank(6);
  if (!a_leads && !b_leads)
    card.fail("shares its six motions between both ends, or ties some of them only, which is not read",
              "give 123456 to one end (CNA or CNB); hinges are pin flags of CBAR, or springs");
  const long a = card.integer(1), b = card.integer(2);
  add_rigid(parts, card, a_leads ? a : b, a_leads ? b : a);
}

constexpr double nothing = 1e-12;  ///< [-] of a factor next to 1: rounding of directions and sums

/// The motion of one component of a grid by the three displacements or rotations of its node.
std::vector<fe::Constraint::Term> terms_of(Parts& parts, const Card& card, long grid, int component, double factor) {
  const Eigen::RowVector3d direction = parts.displacement_axes(card, grid).row(component % 3);
  const int node = parts.node(card, grid), first = component < 3 ? 0 : 3;
  std::vector<fe::Constraint::Term> terms;
  for (int i = 0; i < 3; ++i)
    if (std::abs(direction[i]) > nothing) terms.push_back({node, first + i, factor * direction[i]});
  return terms;
}

bool is_real(const std::string& field) { return field.find('.') != std::string::npos; }

/// The groups of the card: weight, components, grids, over again.
std::vector<DeckModel::Sample> samples_of(Parts& parts, const Card& card) {
  constexpr std::size_t first_weight = 4;
  std::vector<std::string> words;
  for (std::size_t i = first_weight; i < card.size(); ++i)
    if (!card.blank(i)) words.push_back(card.word(i));
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
      for (int c = 0; c < 6; ++c)
        if (chosen[fe::slot(c)])
          samples.push_back({parts.node(card, grid), parts.displacement_axes(card, grid).row(c % 3), c > 2, weight});
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
  for (const Card& card : parts.deck.cards())
    if (card.name == "MPCADD" && chosen && card.integer(0) == *chosen)
      for (std::size_t i = 1; i < card.size(); ++i) sets.insert(card.integer(i));
  return sets;
}

/// A1 u1 + A2 u2 + … = 0. Fields: SID G1 C1 A1 G2 C2 A2, then from the second field of each further line.
void read_equation_card(Parts& parts, const Card& card) {
  const long grid = card.integer(1);
  const int component = card.component(2);
  const double own = card.number(3);
  if (own == 0.0) card.fail("the factor of the first displacement is 0", "begin with the one that follows the others");
  Directions flags{};
  flags[fe::slot(component)] = true;
  const Directions basic = basic_components(parts, card, grid, flags);
  const int direction = static_cast<int>(std::ranges::find(basic, true) - basic.begin());
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

/// RBE2 that ties some components only: those follow the independent grid as a rigid body, the others are free (hinges).
void tie_some(Parts& parts, const Card& card, long independent, long dependent, const Directions& tied) {
  const Directions basic = basic_components(parts, card, dependent, tied);
  const int master = parts.node(card, independent), slave = parts.node(card, dependent);
  parts.tie_at_arm(
      card, [&](int d) { return fmt::format("rbe2_{}_{}_{}", card.text(0), dependent, d + 1); }, master, slave, basic);
}

}  // namespace

void read_rigid(Parts& parts, const Card& card) {
  if (card.name == "RBAR") return read_rbar(parts, card);
  const long independent = card.integer(1);
  const auto tied = components(card, 2);
  std::size_t last = card.size();
  while (last > 3 && card.fields[last - 1].find('.') != std::string::npos) --last;  // ALPHA, TREF: they belong to heat
  Card list = card;
  list.fields.resize(last);
  for (const long grid : parts.grid_list(list, 3, true)) {
    // A dependent grid at which only rods and solids meet has no rotation to follow.
    if (parts.is_whole(tied, parts.node(card, grid)))
      add_rigid(parts, card, independent, grid);
    else
      tie_some(parts, card, independent, grid, tied);
  }
}

void read_supports(Parts& parts) {
  const std::set<long> chosen = chosen_sets(parts);
  for (const Card& card : parts.deck.cards())
    if (is_set_card(card) && chosen.contains(card.integer(0))) read_support_card(parts, card);
  for (const auto& [id, card] : parts.grids) {
    // PS of the grid, or of GRDSET.
    const Card& from = card->blank(6) && parts.grid_defaults != nullptr ? *parts.grid_defaults : *card;
    if (!from.blank(6) && from.text(6) != "0") hold(parts, *card, id, components(from, 6));
  }
  for (const auto& [grid, support] : parts.held) {
    const auto& [held, by] = support;
    if (const auto node = parts.node_position.find(grid); node != parts.node_position.end())
      parts.hold_along(*by, fmt::format("grid_{}", grid), node->second, parts.displacement_axes(*by, grid), held);
  }
}

void read_average(Parts& parts, const Card& card) {
  const long reference = card.integer(2);
  const Directions wanted = basic_components(parts, card, reference, components(card, 3));
  parts.tie_to_mean(
      card, [&](int d) { return fmt::format("rbe3_{}_{}", card.text(0), d + 1); }, parts.node(card, reference),
      samples_of(parts, card), wanted, "average grids that do not lie on one line, or take the component out of REFC");
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
