#include "model_io/nastran_supports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "model_io/nastran_constraints.hpp"
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
      card.fail(fmt::format("holds or ties grid {} along an axis of its system CD that is skew to the basic ones", grid),
                "use a stiff CELAS2 there, which may be skew, or turn the model");
    basic[static_cast<std::size_t>(along)] = true;
  }
  return basic;
}

void hold(Parts& parts, const Card& card, long grid, const Directions& local) {
  const Directions basic = basic_components(parts, card, grid, local);
  auto& held = parts.held[grid];
  for (std::size_t i = 0; i < 6; ++i) held[i] = held[i] || basic[i];
}

bool is_set_card(const Card& card) { return card.name == "SPC" || card.name == "SPC1"; }

/// Numbers of the sets that hold: the chosen one, with those that SPCADD puts together.
std::set<long> chosen_sets(Parts& parts) {
  std::set<long> all, chosen;
  for (const Card& card : parts.deck.cards()) {
    if (is_set_card(card)) all.insert(card.integer(0));
  }
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
  if (control.spc && std::none_of(chosen.begin(), chosen.end(), [&](long id) { return all.contains(id); }))
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
    const bool loaded =
        std::any_of(subcases.begin(), subcases.end(), [](const Subcase& s) { return s.chosen.contains("STATSUB"); });
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
    std::sort(digits.begin(), digits.end());
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

}  // namespace

Directions basic_components(Parts& parts, const Card& card, long grid, const Directions& local) {
  const Eigen::Matrix3d axes = parts.displacement_axes(card, grid);
  const auto shift = in_basic(card, grid, axes, {local[0], local[1], local[2]});
  const auto turn = in_basic(card, grid, axes, {local[3], local[4], local[5]});
  return {shift[0], shift[1], shift[2], turn[0], turn[1], turn[2]};
}

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
    const bool whole = parts.is_whole(tied, parts.node(card, grid));
    if (whole)
      add_rigid(parts, card, independent, grid);
    else
      tie_some(parts, card, independent, grid, tied);
  }
}

void read_supports(Parts& parts) {
  const std::set<long> chosen = chosen_sets(parts);
  for (const Card& card : parts.deck.cards()) {
    if (is_set_card(card) && chosen.contains(card.integer(0))) read_support_card(parts, card);
  }
  for (const auto& [id, card] : parts.grids) {
    // PS of the grid, or of GRDSET.
    const Card& from = card->blank(6) && parts.grid_defaults != nullptr ? *parts.grid_defaults : *card;
    if (!from.blank(6) && from.text(6) != "0") hold(parts, *card, id, components(from, 6));
  }
  for (const auto& [grid, fixed] : parts.held) {
    const auto node = parts.node_position.find(grid);
    if (node != parts.node_position.end()) parts.hold(fmt::format("grid_{}", grid), node->second, fixed);
  }
}

}  // namespace twindeck::model_io::nastran
