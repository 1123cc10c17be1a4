#include "model_io/nastran_attachments.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "core/lists.hpp"
#include "fe/beam_frame.hpp"
#include "model_io/names.hpp"
#include "model_io/nastran_elements.hpp"
#include "model_io/nastran_properties.hpp"
#include "model_io/spread_mass.hpp"

namespace twindeck::model_io::nastran {
namespace {

/// A spring or mass given by a matrix on the six displacements of each node; displacements that it does not touch are left out.
void add_matrix(Parts& parts, const std::string& name, const std::vector<int>& nodes, const Eigen::MatrixXd& stiffness,
                const Eigen::MatrixXd& mass) {
  fe::MatrixElement element;
  element.name = element.group = name;
  std::vector<Eigen::Index> kept;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    for (int d = 0; d < 6; ++d) {
      const auto row = static_cast<Eigen::Index>(6 * n) + d;
      const bool touched =
          (stiffness.size() > 0 && !stiffness.row(row).isZero(0.0)) || (mass.size() > 0 && !mass.row(row).isZero(0.0));
      if (!touched) continue;
      kept.push_back(row);
      element.dofs.push_back({nodes[n], d});
    }
  }
  if (kept.empty()) return;
  if (stiffness.size() > 0) element.stiffness = stiffness(kept, kept);
  if (mass.size() > 0) element.mass = mass(kept, kept);
  parts.model.matrix_elements.push_back(std::move(element));
}

/// [-] Distance of two grids over their distance from the origin: below, they are one place.
constexpr double coincident = 1e-9;

/// An end of a scalar spring: node, direction in basic axes, whether it turns.
struct ScalarEnd {
  int node = -1;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  bool rotation = false;
};

ScalarEnd scalar_end(Parts& parts, const Card& card, std::size_t i) {
  if (card.blank(i) || card.text(i) == "0") return {};
  const long grid = card.integer(i);
  const Eigen::Matrix3d axes = parts.displacement_axes(card, grid);
  const int component = card.component(i + 1);
  return {parts.node(card, grid), axes.row(component % 3).transpose(), component > 2};
}

/// Unit vector over the twelve displacements of two nodes.
Eigen::VectorXd unit_motion(const ScalarEnd& end, Eigen::Index first) {
  Eigen::VectorXd b = Eigen::VectorXd::Zero(12);
  b.segment<3>(first + (end.rotation ? 3 : 0)) = end.direction;
  return b;
}

/// The six stiffnesses of PBUSH.
std::array<double, 6> bush_stiffness(Parts& parts, const Card& p) {
  std::array<double, 6> k{};
  for (std::size_t row = 0; row < p.fields.size(); row += 8) {
    if (const std::string key = p.word(row + 1); key == "K") {
      for (std::size_t i = 0; i < 6; ++i) k[i] = p.number_or(row + 2 + i, 0.0);
    } else if (key == "B") {
      parts.note_once(property_name(p) + ": its damping (B) is left out; a damper goes into springs.csv of the model folder");
    } else if (key == "M") {
      p.fail("has a mass (M), which is not read", "give the mass by CONM2");
    } else if (!key.empty() && key != "GE" && key != "RCV") {
      p.fail(fmt::format("has a row '{}', expected K, B, GE or RCV", key), "check the columns of the card");
    }
  }
  for (const double value : k)
    if (value < 0.0) p.fail("a stiffness is negative", "check the sign");
  return k;
}

/// Element axes of a CBUSH, rows in basic axes. @param apart  the grids lie apart; `axial_only`: no stiffness but along x is
/// there
Eigen::Matrix3d bush_axes(Parts& parts, const Card& card, bool apart, bool axial_only) {
  const long a = card.integer(2);
  if (!card.blank(7)) return parts.system(card, card.integer(7)).axes_at(parts.grid_place(card, a));
  if (!apart) card.fail("has no system CID, and its grids do not lie apart", "give CID (0: the basic axes)");
  Eigen::Matrix3d axes;
  const Eigen::Vector3d x = (parts.grid_place(card, card.integer(3)) - parts.grid_place(card, a)).normalized();
  Eigen::Vector3d v = plane_vector(parts, card, 'G');
  if (v.isZero(0.0) && axial_only) v = x.unitOrthogonal();
  const Eigen::Vector3d z =
      DeckModel::local_z(card, "its line", x, v, "K2, K3, K5, K6 need a vector: give X1, X2, X3, G0 or CID");
  axes << x.transpose(), z.cross(x).transpose(), z.transpose();
  return axes;
}

/// Springs at one place, or one along the line of its nodes: no arms.
void add_bush_springs(Parts& parts, const Card& card, const std::string& group, const std::array<double, 6>& k,
                      const Eigen::Matrix3d& axes, int a, int b) {
  for (std::size_t i = 0; i < 6; ++i)
    if (k[i] != 0.0)
      parts.add_spring(fmt::format("cbush_{}_{}", card.text(0), direction_names()[i]), group, a, b, static_cast<int>(i), axes,
                       k[i]);
}

using MassMatrix = Eigen::Matrix<double, 6, 6>;

/// Axes of the system that a mass is given in: only a rectangular one has the same directions everywhere.
Eigen::Matrix3d mass_axes(Parts& parts, const Card& card) {
  const long id = card.integer_or(2, 0);
  if (id <= 0) return Eigen::Matrix3d::Identity();
  const System& system = parts.system(card, id);
  if (system.type != 'R') card.fail("is given in a system that is not rectangular, which is not read", "use CORD2R");
  return system.axes;
}

/// A point mass where the matrix is one, else the matrix.
void add_mass(Parts& parts, const std::string& name, int node, const MassMatrix& m) {
  const double small = 1e-12 * m.cwiseAbs().maxCoeff();
  const MassMatrix rest = m - MassMatrix(m.diagonal().asDiagonal());
  const bool one_mass = std::abs(m(0, 0) - m(1, 1)) <= small && std::abs(m(0, 0) - m(2, 2)) <= small;
  if (!one_mass || rest.cwiseAbs().maxCoeff() > small) return add_matrix(parts, name, {node}, {}, m);
  parts.model.masses.push_back({.group = name, .node = node, .mass_kg = m(0, 0), .inertia_kg_m2 = m.diagonal().tail<3>()});
}

/// The lower half of a symmetric matrix, row by row from field `first` on.
template <int n>
Eigen::Matrix<double, n, n> symmetric(const Card& card, std::size_t first) {
  Eigen::Matrix<double, n, n> m;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column <= row; ++column) m(row, column) = m(column, row) = card.number_or(first++, 0.0);
  return m;
}

/// CONM2: a mass off its grid, with inertia about its own centre.
MassMatrix offset_mass(Parts& parts, const Card& card) {
  const double mass = card.number_or(3, 0.0);
  Eigen::Vector3d arm = card.vector(4);
  Eigen::Matrix3d inertia = symmetric<3>(card, 8);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) inertia(i, j) *= i == j ? 1.0 : -1.0;  // the card has the products as integrals, without sign
  const Eigen::Matrix3d axes = mass_axes(parts, card);
  inertia = (axes.transpose() * inertia * axes).eval();
  arm = (axes.transpose() * arm).eval();
  // CID -1: the centre itself, in basic coordinates.
  if (card.integer_or(2, 0) < 0) arm -= parts.grid_place(card, card.integer(1));
  if (mass < 0.0 || inertia.diagonal().minCoeff() < 0.0) card.fail("a mass or an inertia is negative", "check the sign");
  MassMatrix m = MassMatrix::Zero();
  const Eigen::Matrix3d s = fe::beam::cross_matrix(arm);
  m.topLeftCorner<3, 3>() = mass * Eigen::Matrix3d::Identity();
  m.topRightCorner<3, 3>() = -mass * s;
  m.bottomLeftCorner<3, 3>() = mass * s;
  m.bottomRightCorner<3, 3>() = inertia - mass * s * s;
  return m;
}

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
  std::ranges::replace(text, '+', ',');
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
    const auto nodes = each_of(direct.grids, [&](long grid) { return parts.node(chosen, grid); });
    add_matrix(parts, "dmig_" + choice.name, nodes, mass ? Eigen::MatrixXd() : matrix, mass ? matrix : Eigen::MatrixXd());
  }
}

bool is_spread_mass(const std::string& name) { return name == "NSM" || name == "NSM1" || name == "NSML" || name == "NSML1"; }

/// The sets in force. NSMADD joins some.
std::set<long> spread_mass_sets(const Parts& parts) {
  std::set<long> all, chosen;
  for (const Card& card : parts.deck.cards())
    if (is_spread_mass(card.name)) all.insert(card.integer(0));
  const CaseControl& control = parts.deck.case_control();
  if (control.nsm) chosen.insert(*control.nsm);
  if (!control.present && all.size() == 1) chosen = all;
  for (const Card& card : parts.deck.cards())
    if (card.name == "NSMADD" && control.nsm && card.integer(0) == *control.nsm)
      for (std::size_t i = 1; i < card.size(); ++i) chosen.insert(card.integer(i));
  return chosen;
}

/// Elements of the deck by their own numbers (ELEMENT) or those of their properties (PSHELL, PBAR …), in fields from `first`
/// on.
std::vector<long> named_elements(const Parts& parts, const Card& card, std::size_t first, std::size_t end) {
  const std::string kind = card.word(1);
  std::vector<std::array<long, 3>> ranges;  // first, last, step
  for (std::size_t i = first; i < end; ++i) {
    if (card.blank(i)) continue;
    if (card.word(i) == "ALL") {
      ranges.push_back({0, std::numeric_limits<long>::max(), 1});
    } else if (card.word(i) == "THRU" && !ranges.empty()) {
      ranges.back()[1] = card.integer(++i);
      if (card.word(i + 1) == "BY") ranges.back()[2] = std::max(1L, card.integer(i += 2));
    } else {
      ranges.push_back({card.integer(i), card.integer(i), 1});
    }
  }
  std::vector<long> found;
  for (const fe::Element& e : parts.model.elements) {
    const std::size_t bar = e.group.rfind('_');  // "pbarl_7"
    const std::string of = upper_case(e.group.substr(0, bar));
    const bool is_kind = kind == "ELEMENT" || of == kind || of == kind + "L" || of + "L" == kind;
    const long number = kind == "ELEMENT" ? e.id : std::stol(e.group.substr(bar + 1));
    if (is_kind && parts.element_ids.contains(e.id) &&  // no further piece of an element of the deck
        std::ranges::any_of(ranges,
                            [&](const auto& r) { return number >= r[0] && number <= r[1] && (number - r[0]) % r[2] == 0; }))
      found.push_back(e.id);
  }
  return found;
}

void spread_card(Parts& parts, const Card& card) {
  const bool list = card.name.ends_with('1');
  const auto spread = [&](double value, std::size_t first, std::size_t end) {
    const std::vector<long> ids = named_elements(parts, card, first, end);
    const auto first_of = std::ranges::find_if(parts.model.elements, [&](const auto& e) { return contains(ids, e.id); });
    const bool shell = first_of != parts.model.elements.end() && first_of->type == fe::ElementType::shell;
    spread_mass(parts, card, ids,
                {.value = value,
                 .per = shell ? MassPer::area : MassPer::length,
                 .total = card.name.starts_with("NSML"),
                 .owner = "nsm_" + card.text(0)});
  };
  if (list) return spread(card.number(2), 3, card.size());
  for (std::size_t i = 2; i < card.size(); i += 2) spread(card.number(i + 1), i, i + 1);
}

}  // namespace

void read_scalar_spring(Parts& parts, const Card& card) {
  const bool by_property = card.name == "CELAS1";
  const auto [id, k] = by_property ? parts.constant(card, parts.spring_constants, "PELAS") : std::pair(0L, card.number(1));
  const std::string name = lower_case(card.name) + "_" + card.text(0), group = by_property ? fmt::format("pelas_{}", id) : name;
  ScalarEnd a = scalar_end(parts, card, 2), b = scalar_end(parts, card, 4);
  if (a.node < 0) std::swap(a, b);
  if (a.node < 0) card.fail("joins nothing: both grids are blank", "give G1 and C1");
  const bool same = b.node < 0 || (a.rotation == b.rotation && (a.direction - b.direction).norm() < 1e-9);
  if (same && k >= 0.0 && a.node != b.node) {
    Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
    axes.row(0) = a.direction;
    parts.add_spring(name, group, a.node, b.node, a.rotation ? 3 : 0, axes, k);
    return;
  }
  if (k < 0.0) card.fail(fmt::format("the stiffness is {:g}, expected 0 or more", k), "check the sign");
  if (a.node == b.node) card.fail("joins two components of one grid, which is not read", "join two grids");
  const Eigen::VectorXd motion = unit_motion(a, 0) - unit_motion(b, 6);
  add_matrix(parts, name, {a.node, b.node}, k * motion * motion.transpose(), {});
}

void read_bush(Parts& parts, const Card& card) {
  const Card& p = parts.property(card, card.integer_or(1, card.integer(0)), {"PBUSH"});
  const std::array<double, 6> k = bush_stiffness(parts, p);
  const bool axial_only = k[1] == 0.0 && k[2] == 0.0 && k[4] == 0.0 && k[5] == 0.0;
  if (card.integer_or(9, -1) >= 0)
    card.fail("has its spring beside the line of its grids (OCID), which is not read", "put a grid there, joined by RBE2");
  const long first = card.integer(2);
  const bool grounded = card.blank(3);
  const Eigen::Vector3d xa = parts.grid_place(card, first), xb = grounded ? xa : parts.grid_place(card, card.integer(3));
  const bool apart = (xb - xa).norm() > coincident * (1.0 + xa.norm());
  const Eigen::Matrix3d axes = bush_axes(parts, card, apart, axial_only);
  const int a = parts.node(card, first), b = grounded ? -1 : parts.node(card, card.integer(3));
  const bool along = apart && std::abs(axes.row(0).dot((xb - xa).normalized())) > 1.0 - 1e-9;
  if (!apart || (axial_only && along)) return add_bush_springs(parts, card, property_name(p), k, axes, a, b);
  // The spring sits at the share S of the line; rigid arms lead to it.
  const Eigen::Vector3d at = xa + card.number_or(8, 0.5) * (xb - xa);
  Eigen::Matrix<double, 6, 12> motion = Eigen::Matrix<double, 6, 12>::Zero();
  motion.block<3, 3>(0, 0) = -axes;
  motion.block<3, 3>(0, 3) = axes * fe::beam::cross_matrix(at - xa);
  motion.block<3, 3>(0, 6) = axes;
  motion.block<3, 3>(0, 9) = -axes * fe::beam::cross_matrix(at - xb);
  motion.block<3, 3>(3, 3) = -axes;
  motion.block<3, 3>(3, 9) = axes;
  const Eigen::Map<const Eigen::Matrix<double, 6, 1>> stiffness(k.data());
  add_matrix(parts, "cbush_" + card.text(0), {a, b}, motion.transpose() * stiffness.asDiagonal() * motion, {});
}

void read_mass(Parts& parts, const Card& card) {
  const long grid = card.integer(1);
  MassMatrix m;
  if (card.name == "CONM1") {
    MassMatrix turn = MassMatrix::Zero();
    turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = mass_axes(parts, card);
    m = turn.transpose() * symmetric<6>(card, 3) * turn;
  } else {
    m = offset_mass(parts, card);
  }
  add_mass(parts, lower_case(card.name) + "_" + card.text(0), parts.node(card, grid), m);
}

void read_scalar_mass(Parts& parts, const Card& card) {
  const double mass = card.name == "CMASS1" ? parts.constant(card, parts.scalar_masses, "PMASS").second : card.number(1);
  if (mass < 0.0) card.fail("the mass is negative", "check the sign");
  if (!card.blank(4) && card.text(4) != "0")
    card.fail("is a mass between two grids, which is not read", "give a mass to ground at one grid");
  const long grid = card.integer(2);
  const int component = card.component(3);
  const Eigen::Matrix3d axes = parts.displacement_axes(card, grid);
  MassMatrix& m = parts.added_mass.try_emplace(parts.node(card, grid), MassMatrix::Zero()).first->second;
  const Eigen::Vector3d direction = axes.row(component % 3).transpose();
  const Eigen::Index at = component > 2 ? 3 : 0;
  m.block<3, 3>(at, at) += mass * direction * direction.transpose();
}

void finish_masses(Parts& parts) {
  for (const auto& [node, m] : parts.added_mass)
    add_mass(parts, fmt::format("cmass_grid_{}", parts.model.nodes[fe::slot(node)].id), node, m);
  group_equal_masses(parts.model.masses);
}

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

void read_spread_masses(Parts& parts) {
  const std::set<long> chosen = spread_mass_sets(parts);
  std::set<long> left_out;
  for (const Card& card : parts.deck.cards()) {
    if (!is_spread_mass(card.name)) continue;
    if (chosen.contains(card.integer(0)))
      spread_card(parts, card);
    else
      left_out.insert(card.integer(0));
  }
  if (left_out.empty()) return;
  if (!parts.deck.case_control().present)
    parts.deck.whole("NSM").fail("holds several sets of nonstructural mass, and no case control chooses one",
                                 "put \"NSM = 1\" and \"BEGIN BULK\" above the cards");
  parts.notes.push_back(fmt::format("nonstructural mass of set {} is left out: NSM in the case control does not choose it",
                                    fmt::join(left_out, ", ")));
}

}  // namespace twindeck::model_io::nastran
