#include "model_io/nastran_dmig.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "model_io/nastran_attachments.hpp"
#include "model_io/nastran_properties.hpp"

namespace twindeck::model_io::nastran {
namespace {

constexpr std::size_t most_grids = 500;  ///< the matrix of an element is dense: 3000 rows are 72 MB

/// "0.5*KBUSH" of the case control.
struct Choice {
  std::string name;
  double factor = 1.0;
};

std::vector<Choice> choices_of(const CaseControl::Matrices& chosen) {
  std::vector<Choice> choices;
  std::string text = chosen.text;
  std::erase(text, ' ');
  std::replace(text.begin(), text.end(), '+', ',');
  for (const std::string& word : text.empty() ? std::vector<std::string>{} : split_at(text, ',')) {
    Choice choice;
    const std::size_t star = word.find('*');
    const DeckFields at{chosen, {"", star == std::string::npos ? "1." : word.substr(0, star)}};
    choice.factor = at.number(1);
    choice.name = star == std::string::npos ? word : word.substr(star + 1);
    if (choice.name.empty()) at.fail("names no matrix", fmt::format("write {} = NAME, or a*NAME, b*OTHER", chosen.label));
    choices.push_back(choice);
  }
  return choices;
}

/// A matrix over the six displacements of its grids, in their displacement systems.
struct Direct {
  std::vector<long> grids;
  std::map<long, Eigen::Index> position;
  std::map<std::pair<Eigen::Index, Eigen::Index>, double> entries;  ///< both triangles
};

/// Row of a grid and component.
Eigen::Index row_of(Parts& parts, const Card& card, std::size_t i, Direct& direct) {
  const long grid = card.integer(i), component = card.integer_or(i + 1, 0);
  if (component < 1 || component > 6)
    card.fail(fmt::format("component {} of point {} is none of 1 to 6", component, grid),
              "scalar points are not read; give components of grids");
  const auto [found, is_new] = direct.position.try_emplace(grid, std::ssize(direct.grids));
  if (is_new) {
    (void)parts.node(card, grid);
    direct.grids.push_back(grid);
    if (direct.grids.size() > most_grids)
      card.fail(fmt::format("the matrix has more than {} grids", most_grids),
                "give the whole model as matrices (docs/my_model.md)");
  }
  return 6 * found->second + component - 1;
}

void check_header(const Card& header) {
  const long form = header.integer(2), kind = header.integer(3);
  if (form != 6)
    header.fail(fmt::format("has form IFO {}, expected 6: symmetric", form),
                "stiffness and mass of a structure are symmetric; write one triangle");
  if (kind != 1 && kind != 2)
    header.fail(fmt::format("has numbers of type TIN {}, expected 1 or 2: real", kind), "leave the damping out");
}

Direct read_direct(Parts& parts, const std::string& name, const CaseControl::Matrices& chosen) {
  Direct direct;
  const Card* header = nullptr;
  for (const Card& card : parts.deck.cards()) {
    if (card.name != "DMIG" || card.word(0) != name) continue;
    if (card.text(1) == "0") {
      if (header != nullptr) card.fail("is the second header of this matrix", "give each matrix one");
      header = &card;
      check_header(card);
      continue;
    }
    if (header == nullptr) card.fail("stands before the header of its matrix", "put DMIG,NAME,0,6,1 above it");
    const Eigen::Index column = row_of(parts, card, 1, direct);
    for (std::size_t i = 4; i < card.size(); i += 4) {
      if (card.blank(i)) continue;
      const Eigen::Index row = row_of(parts, card, i, direct);
      const double value = card.number(i + 2);
      const bool is_new = direct.entries.emplace(std::pair{row, column}, value).second;
      if (!is_new || (row != column && !direct.entries.emplace(std::pair{column, row}, value).second))
        card.fail(fmt::format("the term of grid {}, component {} stands twice", card.text(i), card.text(i + 1)),
                  "of a symmetric matrix give one triangle, each term once");
    }
  }
  if (header == nullptr)
    chosen.fail(fmt::format("chooses the matrix {}, which no DMIG card has", name), "give the cards, or mend the name");
  return direct;
}

/// In basic axes.
Eigen::MatrixXd assembled(Parts& parts, const Direct& direct, const DeckPlace& from) {
  const auto n = static_cast<Eigen::Index>(6 * direct.grids.size());
  Eigen::MatrixXd local = Eigen::MatrixXd::Zero(n, n), turn = Eigen::MatrixXd::Zero(n, n);
  for (const auto& [at, value] : direct.entries) local(at.first, at.second) = value;
  bool turned = false;
  for (std::size_t g = 0; g < direct.grids.size(); ++g) {
    const Eigen::Matrix3d axes = parts.displacement_axes(from, direct.grids[g]);
    turned = turned || !axes.isIdentity(0.0);
    for (const Eigen::Index at : {0, 3})
      turn.block<3, 3>(static_cast<Eigen::Index>(6 * g) + at, static_cast<Eigen::Index>(6 * g) + at) = axes;
  }
  return turned ? Eigen::MatrixXd(turn.transpose() * local * turn) : local;
}

void add_direct(Parts& parts, const CaseControl::Matrices& chosen, bool mass, std::set<std::string>& used) {
  for (const Choice& choice : choices_of(chosen)) {
    used.insert(choice.name);
    const Direct direct = read_direct(parts, choice.name, chosen);
    const Eigen::MatrixXd matrix = choice.factor / (mass ? parts.wtmass : 1.0) * assembled(parts, direct, chosen);
    std::vector<int> nodes;
    for (const long grid : direct.grids) nodes.push_back(parts.node(chosen, grid));
    add_matrix(parts, "dmig_" + choice.name, nodes, mass ? Eigen::MatrixXd() : matrix, mass ? matrix : Eigen::MatrixXd());
  }
}

}  // namespace

void read_direct_matrices(Parts& parts) {
  std::set<std::string> used;
  add_direct(parts, parts.deck.case_control().k2gg, false, used);
  add_direct(parts, parts.deck.case_control().m2gg, true, used);
  for (const Card& card : parts.deck.cards()) {
    if (card.name != "DMIG" || used.contains(card.word(0))) continue;
    if (!parts.deck.case_control().present)
      card.fail("is a matrix, but no case control chooses it",
                "put \"K2GG = NAME\" (or M2GG) and \"BEGIN BULK\" above the cards");
    parts.note_once(fmt::format("DMIG cards of {} are left out: neither K2GG nor M2GG chooses them", card.text(0)));
  }
}

}  // namespace twindeck::model_io::nastran
