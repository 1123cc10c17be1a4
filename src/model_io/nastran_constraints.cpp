#include "model_io/nastran_constraints.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "fe/beam_frame.hpp"
#include "model_io/inp_cards.hpp"
#include "model_io/nastran_properties.hpp"
#include "model_io/nastran_supports.hpp"

namespace twindeck::model_io::nastran {
namespace {

using SixMotions = Eigen::Matrix<double, 1, 6>;

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

/// Motions of the reference grid by the samples: q = (Sᵀ W S)⁺ Sᵀ W u, and which of q they determine.
struct Average {
  Eigen::MatrixXd of_samples;  ///< (6 × samples)
  std::array<bool, 6> determined{};
};

Average average_of(Parts& parts, const Card& card, long reference, const std::vector<Sample>& samples) {
  const auto n = static_cast<Eigen::Index>(samples.size());
  const Eigen::Vector3d at = parts.place(card, reference);
  double reach = 0.0;
  for (const Sample& sample : samples) reach += (parts.place(card, sample.grid) - at).norm() / static_cast<double>(n);
  if (!(reach > 0.0)) reach = 1.0;
  Eigen::Matrix<double, Eigen::Dynamic, 6> s(n, 6);
  Eigen::VectorXd root(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Sample& sample = samples[static_cast<std::size_t>(i)];
    const Eigen::RowVector3d direction = parts.displacement_axes(card, sample.grid).row(sample.component % 3);
    const Eigen::Vector3d arm = parts.place(card, sample.grid) - at;
    if (sample.component < 3)
      s.row(i) << direction, -direction * fe::beam::cross_matrix(arm) / reach;
    else
      s.row(i) << Eigen::RowVector3d::Zero(), direction / reach;
    root[i] = std::sqrt(sample.weight) * (sample.component < 3 ? 1.0 : reach);
  }
  // Rotations times the reach are of the size of displacements.
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> whole(root.asDiagonal() * s);
  whole.setThreshold(1e-9);
  const Eigen::MatrixXd inverse = whole.pseudoInverse();
  const Eigen::MatrixXd seen = inverse * root.asDiagonal() * s;
  Average average;
  average.of_samples = inverse * root.asDiagonal();
  average.of_samples.bottomRows<3>() /= reach;
  for (Eigen::Index k = 0; k < 6; ++k) {
    constexpr double determined = 1e-6;
    average.determined[static_cast<std::size_t>(k)] = (seen.row(k) - SixMotions::Unit(k)).norm() < determined;
  }
  return average;
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

int component_at(const Parts& parts, const Card& card, std::size_t i) {
  const long component = parts.deck.integer(card, i);
  if (component < 1 || component > 6)
    parts.deck.fail(card, fmt::format("component {} is none of 1 to 6", component), "1-3 displacements, 4-6 rotations");
  return static_cast<int>(component) - 1;
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
  const Average average = average_of(parts, card, reference, samples);
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
  const Eigen::Vector3d arm = parts.place(card, dependent) - parts.place(card, independent);
  for (int d = 0; d < 6; ++d) {
    if (!basic[static_cast<std::size_t>(d)]) continue;
    fe::Constraint c{fmt::format("rbe2_{}_{}_{}", Deck::text(card, 0), dependent, d + 1), slave, d, {{master, d, 1.0}}};
    for (int about = 0; about < 3 && d < 3; ++about) {
      const double factor = Eigen::Vector3d::Unit(about).cross(arm)[d];
      if (std::abs(factor) > nothing * arm.norm()) c.terms.push_back({master, 3 + about, factor});
    }
    parts.model.constraints.push_back(c);
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
