#include "model_io/nastran_springs.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "fe/beam_frame.hpp"
#include "model_io/names.hpp"
#include "model_io/nastran_properties.hpp"

namespace twindeck::model_io::nastran {
namespace {

constexpr double coincident =
    1e-9;  ///< [-] distance of two grids over their distance from the origin: below, they are one place

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
    const std::string key = p.word(row + 1);
    if (key == "K") {
      for (std::size_t i = 0; i < 6; ++i) k[i] = p.number_or(row + 2 + i, 0.0);
    } else if (key == "B") {
      parts.note_once(property_name(p) + ": its damping (B) is left out; a damper goes into springs.csv of the model folder");
    } else if (key == "M") {
      p.fail("has a mass (M), which is not read", "give the mass by CONM2");
    } else if (!key.empty() && key != "GE" && key != "RCV") {
      p.fail(fmt::format("has a row '{}', expected K, B, GE or RCV", key), "check the columns of the card");
    }
  }
  for (const double value : k) {
    if (value < 0.0) p.fail("a stiffness is negative", "check the sign");
  }
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
  Eigen::Vector3d v = card.vector(4);
  if (is_whole_number(card.text(4)) && card.blank(5) && card.blank(6) && card.text(4) != "0")
    v = parts.grid_place(card, card.integer(4)) - parts.grid_place(card, a);
  else
    v = (parts.displacement_axes(card, a).transpose() * v).eval();
  if (v.isZero(0.0) && axial_only) v = x.unitOrthogonal();
  const Eigen::Vector3d z =
      DeckModel::local_z(card, "its line", x, v, "K2, K3, K5, K6 need a vector: give X1, X2, X3, G0 or CID");
  axes << x.transpose(), z.cross(x).transpose(), z.transpose();
  return axes;
}

/// Springs at one place, or one along the line of its nodes: no arms.
void add_bush_springs(Parts& parts, const Card& card, const std::string& group, const std::array<double, 6>& k,
                      const Eigen::Matrix3d& axes, int a, int b) {
  for (std::size_t i = 0; i < 6; ++i) {
    if (k[i] == 0.0) continue;
    parts.add_spring(fmt::format("cbush_{}_{}", card.text(0), direction_names()[i]), group, a, b, static_cast<int>(i), axes,
                     k[i]);
  }
}

}  // namespace

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

void read_scalar_spring(Parts& parts, const Card& card) {
  double k = 0.0;
  std::string group = "celas2_" + card.text(0);
  if (card.name == "CELAS1") {
    const auto [id, constant] = parts.constant(card, parts.spring_constants, "PELAS");
    k = constant;
    group = fmt::format("pelas_{}", id);
  } else {
    k = card.number(1);
  }
  ScalarEnd a = scalar_end(parts, card, 2), b = scalar_end(parts, card, 4);
  if (a.node < 0) std::swap(a, b);
  if (a.node < 0) card.fail("joins nothing: both grids are blank", "give G1 and C1");
  const std::string name = fmt::format("{}_{}", card.name == "CELAS1" ? "celas1" : "celas2", card.text(0));
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

}  // namespace twindeck::model_io::nastran
