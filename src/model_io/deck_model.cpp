#include "model_io/deck_model.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "fe/beam_frame.hpp"
#include "model_io/model_toml.hpp"
#include "model_io/profiles.hpp"

namespace twindeck::model_io {
namespace {
constexpr const char* skew_support = "skew_support";  ///< constraints of supports along a node's own axes

/// Motions q of the reference node (x y z rx ry rz) that fit the samples u best.
struct WeightedMean {
  Eigen::MatrixXd of_samples;      ///< q = of_samples · u (6 × samples); [-], rotations [1/m] of displacements
  std::array<bool, 6> determined;  ///< whether the samples say what this motion is
};

WeightedMean weighted_mean(const DeckModel& deck, int reference, const std::vector<DeckModel::Sample>& samples) {
  constexpr double singular = 1e-9, settled = 1e-6;  ///< [-] of the largest singular value; of a unit motion
  const auto n = std::ssize(samples);
  double reach = 0.0;
  const auto arm_m = [&](const DeckModel::Sample& sample) {
    return Eigen::Vector3d(deck.place(sample.node) - deck.place(reference));
  };
  for (const DeckModel::Sample& sample : samples) reach += arm_m(sample).norm() / static_cast<double>(n);
  if (!(reach > 0.0)) reach = 1.0;
  Eigen::Matrix<double, Eigen::Dynamic, 6> s(n, 6);
  Eigen::VectorXd root(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const DeckModel::Sample& sample = samples[static_cast<std::size_t>(i)];
    if (sample.rotation)
      s.row(i) << Eigen::RowVector3d::Zero(), sample.direction / reach;
    else
      s.row(i) << sample.direction, -sample.direction * fe::beam::cross_matrix(arm_m(sample)) / reach;
    root[i] = std::sqrt(sample.weight) * (sample.rotation ? reach : 1.0);
  }
  // Rotations times the reach are of the size of displacements.
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> whole(root.asDiagonal() * s);
  whole.setThreshold(singular);
  const Eigen::MatrixXd inverse = whole.pseudoInverse();
  const Eigen::MatrixXd seen = inverse * root.asDiagonal() * s;
  WeightedMean mean;
  mean.of_samples = inverse * root.asDiagonal();
  mean.of_samples.bottomRows<3>() /= reach;
  for (Eigen::Index k = 0; k < 6; ++k)
    mean.determined[static_cast<std::size_t>(k)] = (seen.row(k) - Eigen::Matrix<double, 1, 6>::Unit(k)).norm() < settled;
  return mean;
}

}  // namespace

bool DeckModel::together(int a, int b, double tolerance) const {
  return (place(a) - place(b)).norm() <= tolerance * (1.0 + place(b).norm());
}

void DeckModel::note_once(const std::string& note) {
  if (!contains(notes, note)) notes.push_back(note);
}

int DeckModel::add_node(long id, const Eigen::Vector3d& x) {
  const auto [entry, is_new] = node_position.emplace(id, static_cast<int>(model.nodes.size()));
  if (is_new) model.nodes.push_back({id, x});
  return entry->second;
}

int DeckModel::add_section(const fe::Section& section) { return find_or_add_section(model.sections, section); }

long DeckModel::next_node() {
  if (!node_position.empty()) last_node = std::max(last_node, node_position.rbegin()->first);
  return ++last_node;
}

void DeckModel::add_element(const fe::Element& whole) {
  const bool shell = whole.type == fe::ElementType::shell;
  if (shell) turning.insert(whole.nodes.begin(), whole.nodes.end());
  if (!shell || whole.nodes.size() < 5) return model.elements.push_back(whole);
  const std::vector<int>& n = whole.nodes;
  std::vector<std::vector<int>> parts = {{n[0], n[3], n[5]}, {n[3], n[1], n[4]}, {n[5], n[4], n[2]}, {n[3], n[4], n[5]}};
  if (n.size() == 8) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < 8; ++i) centre += (i < 4 ? -0.25 : 0.5) * place(n[i]);
    made_nodes.insert(next_node());
    const int c = add_node(last_node, centre);
    turning.insert(c);
    parts = {{n[0], n[4], c, n[7]}, {n[4], n[1], n[5], c}, {c, n[5], n[2], n[6]}, {n[7], c, n[6], n[3]}};
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    fe::Element piece = whole;
    piece.nodes = parts[i];
    if (i > 0) piece.id = ++last_element;
    model.elements.push_back(std::move(piece));
  }
  pieces[whole.id] = parts.size();
}

void DeckModel::add_beam(const fe::Element& whole,
                         const std::function<void(fe::Element& piece, const Eigen::Vector3d& axis)>& turn) {
  turning.insert(whole.nodes.begin(), whole.nodes.end());
  for (std::size_t i = 0; i + 1 < whole.nodes.size(); ++i) {
    fe::Element piece = whole;
    piece.nodes = {whole.nodes[i], whole.nodes[i + 1]};
    turn(piece, place(piece.nodes[1]) - place(piece.nodes[0]));
    if (i > 0) piece.id = ++last_element;
    model.elements.push_back(std::move(piece));
  }
  if (whole.nodes.size() > 2) pieces[whole.id] = whole.nodes.size() - 1;
}

Eigen::Vector3d DeckModel::local_z(const DeckPlace& at, const std::string& member, const Eigen::Vector3d& axis,
                                   const Eigen::Vector3d& in_plane, const std::string& mend) {
  constexpr double least_across = 1e-6;  // [-] part of the vector that has to lie across the member
  const Eigen::Vector3d z = axis.cross(in_plane);
  if (!(z.norm() > least_across * axis.norm() * in_plane.norm()))
    at.fail(fmt::format("its vector ({:g}, {:g}, {:g}) lies along {}, or one of the two has no length", in_plane[0],
                        in_plane[1], in_plane[2], member),
            mend);
  return z.normalized();
}

void DeckModel::put_beside(fe::Element& piece, const Eigen::Vector3d& axis, const Eigen::Vector2d& point) {
  const Eigen::Vector3d offset = point[0] * piece.orientation.cross(axis.normalized()) + point[1] * piece.orientation;
  piece.offset_m = {offset, offset};
}

void DeckModel::check_poisson_ratio(const DeckPlace& at, double ratio) {
  if (!(ratio > -1.0 && ratio < 0.5))
    at.fail(fmt::format("Poisson's ratio is {}, expected a value in ]-1, 0.5[", ratio),
            "nu is 0.3 for steel, 0.2 for concrete");
}

void DeckModel::add_link(int master, int slave, const std::string& name) {
  model.links.push_back({name.empty() ? fmt::format("link_{}", model.links.size() + 1) : name, master, slave});
}

void DeckModel::add_constraint(const fe::Constraint& c, const DeckPlace& at) {
  model.constraints.push_back(c);
  constraint_origin.push_back(at);
}

std::string DeckModel::numbered(const std::string& kind) const {
  return fmt::format("{}_{}", kind, model.constraints.size() + 1);
}

bool DeckModel::is_whole(const Directions& tied, int slave) const {
  return tied[0] && tied[1] && tied[2] && ((tied[3] && tied[4] && tied[5]) || !turning.contains(slave));
}

void DeckModel::tie_at_arm(const DeckPlace& at, const std::function<std::string(int)>& name, int master, int slave,
                           const Directions& tied) {
  for (int d = 0; d < 6; ++d)
    if (tied[fe::slot(d)]) add_constraint(at_rigid_arm(name(d), model, master, slave, d), at);
}

std::vector<fe::Constraint::Term> DeckModel::free_terms(const std::vector<fe::Constraint::Term>& terms) const {
  constexpr int longest_chain = 200;
  std::vector<fe::Constraint::Term> now = terms, next;
  for (int round = 0; round < longest_chain; ++round, now = next) {
    next.clear();
    const auto add = [&](const fe::Constraint::Term& term) {
      const auto same = std::ranges::find_if(
          next, [&](const fe::Constraint::Term& t) { return t.node == term.node && t.direction == term.direction; });
      if (same == next.end()) return next.push_back(term);
      same->factor += term.factor;
    };
    bool any = false;
    for (const fe::Constraint::Term& term : now) {
      const auto by = std::ranges::find_if(model.constraints, [&](const fe::Constraint& c) {
        return c.node == term.node && c.direction == term.direction && c.name.starts_with(skew_support);
      });
      if (by == model.constraints.end()) {
        add(term);
        continue;
      }
      any = true;
      for (const fe::Constraint::Term& under : by->terms) add({under.node, under.direction, term.factor * under.factor});
    }
    if (!any) break;
  }
  return next;
}

void DeckModel::follow_first(const std::string& name, const DeckEquation& given) {
  const DeckEquation equation{given.at, free_terms(given.terms)};
  const fe::Constraint::Term& slave = equation.terms[0];
  if (slave.factor == 0.0)
    equation.at.fail("the coefficient of the first term is 0, so that nothing follows from it",
                     "begin with the displacement that depends on the others");
  fe::Constraint c{name, slave.node, slave.direction, {}};
  for (std::size_t i = 1; i < equation.terms.size(); ++i) {
    const fe::Constraint::Term& term = equation.terms[i];
    if (term.factor != 0.0) c.terms.push_back({term.node, term.direction, -term.factor / slave.factor});
  }
  if (c.terms.empty()) equation.at.fail("all coefficients but the first are 0", "hold the displacement by a support");
  add_constraint(c, equation.at);
}

bool DeckModel::is_rigid_link(const std::vector<const DeckEquation*>& equations, int master, int slave) const {
  constexpr double rounding = 1e-6;  // [-] of coefficients that are printed with nine digits
  const Eigen::Vector3d arm = place(slave) - place(master);
  Directions tied{};
  for (const DeckEquation* equation : equations) {
    const auto of_slave = [&](const fe::Constraint::Term& term) { return term.node == slave; };
    const auto own = std::ranges::find_if(equation->terms, of_slave);
    if (std::ranges::count_if(equation->terms, of_slave) != 1 || own->factor == 0.0) return false;
    std::array<double, 6> factors{};
    for (const fe::Constraint::Term& term : equation->terms) {
      if (term.node == slave) continue;
      if (term.node != master) return false;
      factors[fe::slot(term.direction)] -= term.factor / own->factor;
    }
    for (int from = 0; from < 6; ++from)
      if (std::abs(factors[fe::slot(from)] - rigid_arm_factor(arm, own->direction, from)) > rounding * (1.0 + arm.norm()))
        return false;
    tied[fe::slot(own->direction)] = true;
  }
  return is_whole(tied, slave);
}

void DeckModel::tie_to_mean(const DeckPlace& at, const std::function<std::string(int)>& name, int reference,
                            const std::vector<Sample>& samples, const Directions& wanted, const std::string& mend) {
  constexpr double nothing = 1e-12;  // [-] of the largest factor: rounding
  const WeightedMean mean = weighted_mean(*this, reference, samples);
  for (int d = 0; d < 6; ++d) {
    if (!wanted[fe::slot(d)]) continue;
    if (!mean.determined[fe::slot(d)])
      at.fail(fmt::format("its nodes do not determine component {} of node {}", d + 1, model.nodes[fe::slot(reference)].id),
              mend);
    fe::Constraint c{name(d), reference, d, {}};
    const double largest = mean.of_samples.row(d).cwiseAbs().maxCoeff();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double factor = mean.of_samples(d, static_cast<Eigen::Index>(i));
      for (int k = 0; k < 3 && std::abs(factor) > nothing * largest; ++k)
        if (std::abs(samples[i].direction[k]) > nothing)
          c.terms.push_back({samples[i].node, (samples[i].rotation ? 3 : 0) + k, factor * samples[i].direction[k]});
    }
    add_constraint(c, at);
  }
}

void DeckModel::hold(const std::string& name, int node, const Directions& fixed) {
  const auto [entry, is_new] = support_position_.emplace(node, model.supports.size());
  if (is_new) model.supports.push_back({name, node, {}});
  Directions& held = model.supports[entry->second].fixed;
  for (std::size_t d = 0; d < 6; ++d) held[d] = held[d] || fixed[d];
}

void DeckModel::hold_along(const DeckPlace& at, const std::string& name, int node, const Eigen::Matrix3d& axes,
                           const Directions& own) {
  constexpr double nothing = 1e-9;  // [-] of a unit vector
  Directions fixed{};
  for (std::size_t first = 0; first < 6; first += 3) {
    const auto is_held = [&](Eigen::Index d) { return own[first + static_cast<std::size_t>(d)]; };
    const int count = is_held(0) + is_held(1) + is_held(2);
    if (count % 3 == 0) {
      std::fill_n(fixed.begin() + static_cast<std::ptrdiff_t>(first), 3, count == 3);
      continue;
    }
    // The one axis that is held, or that is not: u has no part along it, or lies along it.
    Eigen::Index axis = 0, largest = 0;
    while (is_held(axis) != (count == 1)) ++axis;
    const Eigen::RowVector3d line = axes.row(axis);
    line.cwiseAbs().maxCoeff(&largest);
    for (Eigen::Index d = 0; d < 3; ++d) {
      if ((d == largest) != (count == 1)) continue;
      fe::Constraint c{"", node, static_cast<int>(first) + static_cast<int>(d), {}};
      for (Eigen::Index other = 0; other < 3; ++other) {
        const double factor = count == 1 ? -line[other] / line[d] : line[d] / line[other];
        const bool counts = count == 1 ? other != d : other == largest;
        if (counts && std::abs(factor) > nothing)
          c.terms.push_back({node, static_cast<int>(first + static_cast<std::size_t>(other)), factor});
      }
      c.name = numbered(skew_support);
      if (c.terms.empty())
        fixed[fe::slot(c.direction)] = true;
      else
        add_constraint(c, at);
    }
  }
  if (fixed != Directions{}) hold(name, node, fixed);
}

void DeckModel::add_spring(const std::string& name, const std::string& group, int node, int node2, int direction,
                           const Eigen::Matrix3d& axes, double stiffness, double damping) {
  fe::Spring s{name, group, node, node2, axes.row(direction % 3).transpose(), direction > 2};
  s.stiffness = stiffness;
  s.damping = damping;
  model.springs.push_back(s);
}

void DeckModel::drop_unused_nodes() {
  std::vector<int> now(model.nodes.size(), -1);
  for_each_joined_node(model, [&](int& node) { now[fe::slot(node)] = 0; });
  int kept = 0;
  for (int& to : now)
    if (to >= 0) to = kept++;
  const std::size_t unused = now.size() - fe::slot(kept);
  if (unused == 0) return;
  notes.push_back(fmt::format("nodes that no element, link or tie uses are left out: {}", unused));
  renumber_nodes(model, now);
  for (auto& [id, position] : node_position) position = now[fe::slot(position)];
  std::erase_if(node_position, [](const auto& entry) { return entry.second < 0; });
}

ImportedModel DeckModel::finished(std::vector<std::filesystem::path> files, const std::string& expected) {
  if (model.elements.empty() && model.springs.empty() && model.matrix_elements.empty())
    throw InputError({files.front().string(), 0, ""}, "holds no element", "expected " + expected);
  auto beside = files.front();
  beside.replace_extension(".toml");
  if (std::filesystem::exists(beside)) read_model_toml(beside, model);
  return {std::move(model), std::move(notes), std::move(files)};
}

void for_each_joined_node(fe::Model& model, const std::function<void(int&)>& f) {
  const auto named = [&](int& node) {
    if (node >= 0) f(node);
  };
  for (fe::Element& e : model.elements) std::ranges::for_each(e.nodes, named);
  for (fe::Spring& s : model.springs) named(s.node), named(s.node2);
  for (fe::MatrixElement& e : model.matrix_elements)
    for (fe::MatrixElement::Dof& dof : e.dofs) named(dof.node);
  for (fe::RigidLink& link : model.links) named(link.master), named(link.slave);
  for (fe::Constraint& c : model.constraints) {
    named(c.node);
    for (fe::Constraint::Term& term : c.terms) named(term.node);
  }
  for (fe::PointMass& mass : model.masses) named(mass.node);
}

void renumber_nodes(fe::Model& model, const std::vector<int>& now) {
  TWINDECK_ASSERT(now.size() == model.nodes.size());
  std::vector<fe::Node> nodes(static_cast<std::size_t>(std::ranges::count_if(now, [](int to) { return to >= 0; })));
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now[i] >= 0) nodes[fe::slot(now[i])] = std::move(model.nodes[i]);
  model.nodes = std::move(nodes);
  for_each_joined_node(model, [&](int& node) { node = now[static_cast<std::size_t>(node)]; });
  for (fe::Support& support : model.supports) support.node = now[fe::slot(support.node)];
  std::erase_if(model.supports, [](const fe::Support& support) { return support.node < 0; });
}

void group_equal_masses(std::vector<fe::PointMass>& masses) {
  std::map<double, int> count;
  for (const fe::PointMass& mass : masses) ++count[mass.mass_kg];
  for (fe::PointMass& mass : masses)
    if (count[mass.mass_kg] > 1) mass.group = fmt::format("mass_of_{:g}", mass.mass_kg);
}

}  // namespace twindeck::model_io
