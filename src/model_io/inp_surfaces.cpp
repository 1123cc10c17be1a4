#include "model_io/inp_surfaces.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "model_io/deck_stage.hpp"
#include "model_io/inp_elements.hpp"

namespace twindeck::model_io {
namespace {

/// The facet that "S3" of an element names.
InpFacet facet_of(const DeckPlace& at, const InpElement& element, const std::string& face) {
  const InpKind kind = inp_kind(element.type);
  const bool numbered = face.size() == 2 && face[1] >= '1' && face[1] <= '6';
  const std::size_t number = numbered ? static_cast<std::size_t>(face[1] - '1') : 0;
  InpFacet facet{{}, element.id, kind == InpKind::shell};
  const bool of_solid = kind == InpKind::solid && numbered && face[0] == 'S';
  if (of_solid && number < solid_faces(element.nodes.size()).size()) {
    for (const std::size_t i : solid_faces(element.nodes.size())[number]) facet.nodes.push_back(element.nodes[i]);
  } else if (kind == InpKind::shell && element.nodes.size() < 5 && (face.empty() || face == "SPOS" || face == "SNEG")) {
    facet.nodes = element.nodes;
    if (face == "SNEG") std::ranges::reverse(facet.nodes);
  } else if (kind == InpKind::shell && element.nodes.size() < 5 && numbered && face[0] == 'E' &&
             number < element.nodes.size()) {
    facet.nodes = {element.nodes[number], element.nodes[(number + 1) % element.nodes.size()]};
  } else {
    at.fail(fmt::format("'{}' is no face of element {}, a {}", face, element.id, element.type),
            "hexahedra have S1 to S6, tetrahedra S1 to S4, shells SPOS, SNEG and edges E1 to E4; shells with nodes on their "
            "edges have none; name nodes by TYPE=NODE");
  }
  return facet;
}

void add_faces(InpParts& parts, const InpLine& line, InpSurface& surface) {
  const std::string face = line.fields.size() > 1 ? line.word(1) : "";
  for (const long id : parts.elements_at(line)) {
    const auto element = parts.elements.find(id);
    if (element == parts.elements.end()) line.fail(fmt::format("element {} is not defined by any *ELEMENT", id), "define it");
    surface.facets.push_back(facet_of(line, element->second, face));
    const auto& nodes = surface.facets.back().nodes;
    surface.nodes.insert(surface.nodes.end(), nodes.begin(), nodes.end());
  }
}

using Local = Eigen::Vector2d;  ///< xi, eta: [-1, 1]² of a quadrilateral, [0, 1] areas of a triangle, [-1, 1] of an edge

/// Shape functions and their derivatives.
void shape(std::size_t n, const Local& at, std::vector<double>& share, Eigen::Matrix<double, Eigen::Dynamic, 2>& slope) {
  share.assign(n, 0.0);
  slope.setZero(static_cast<Eigen::Index>(n), 2);
  if (n == 2) {
    share = {0.5 * (1.0 - at[0]), 0.5 * (1.0 + at[0])};
    slope << -0.5, 0.0, 0.5, 0.0;
    return;
  }
  std::array<double, 8> shares{};
  std::array<Eigen::Vector2d, 8> slopes;
  facet_functions(n, at[0], at[1], shares, slopes);
  for (std::size_t i = 0; i < n; ++i) {
    share[i] = shares[i];
    slope.row(static_cast<Eigen::Index>(i)) = slopes[i].transpose();
  }
}

/// The nearest place within the facet's own bounds.
Local within(std::size_t n, Local at) {
  if (n % 3 != 0) return at.cwiseMax(-1.0).cwiseMin(1.0);
  at = at.cwiseMax(0.0);
  const double sum = at.sum();
  return sum > 1.0 ? Local(at / sum) : at;
}

/// Tangents at a foot (3 × 1 of an edge, else 3 × 2).
Eigen::Matrix<double, 3, Eigen::Dynamic> tangents(const Facet& facet, const Eigen::Matrix<double, Eigen::Dynamic, 2>& slope) {
  Eigen::Matrix<double, 3, Eigen::Dynamic> t = Eigen::Matrix<double, 3, Eigen::Dynamic>::Zero(3, facet.x_m.size() == 2 ? 1 : 2);
  for (std::size_t i = 0; i < facet.x_m.size(); ++i)
    for (Eigen::Index a = 0; a < t.cols(); ++a) t.col(a) += slope(static_cast<Eigen::Index>(i), a) * facet.x_m[i];
  return t;
}

}  // namespace

const InpSurface& InpParts::surface(const DeckPlace& at, const std::string& name) const {
  if (const std::string key = find_key(surfaces, name); !key.empty()) return surfaces.at(key);
  const auto known = each_of(surfaces, [](const auto& each) { return each.second.name; });
  at.fail(fmt::format("no surface is called '{}'{}", name, did_you_mean(name, known)),
          at.label == "*TIE" ? "write slave, master, and define both by *SURFACE" : "define it by *SURFACE");
}

void read_inp_surface(InpParts& parts, const InpCard& card) {
  card.allow({"NAME", "TYPE", "INTERNAL"});
  const std::string type = upper_case(card.get("TYPE", "ELEMENT"));
  if (type != "ELEMENT" && type != "NODE")
    card.fail(fmt::format("unsupported TYPE={}", type), "give faces of elements, or nodes");
  InpSurface surface;
  surface.name = card.required("NAME");
  for (const InpLine& line : card.data) {
    if (line.fields[0].empty())
      line.fail("names no element or set: the free faces of everything are not read", "name the faces, as in: SET, S1");
    if (type == "ELEMENT") {
      add_faces(parts, line, surface);
      continue;
    }
    const std::vector<long> nodes = parts.nodes_of(line, 0);
    surface.nodes.insert(surface.nodes.end(), nodes.begin(), nodes.end());
  }
  std::ranges::sort(surface.nodes);
  surface.nodes.erase(std::unique(surface.nodes.begin(), surface.nodes.end()), surface.nodes.end());
  if (surface.nodes.empty()) card.fail("holds nothing", "name faces or nodes below it");
  if (!parts.surfaces.emplace(parts.key_here(surface.name), surface).second)
    card.fail(fmt::format("surface '{}' is defined twice", surface.name), "keep one of the two");
}

double Facet::size_m() const {
  if (x_m.size() == 2) return (x_m[1] - x_m[0]).norm();
  if (x_m.size() % 3 == 0) return std::sqrt(0.5 * (x_m[1] - x_m[0]).cross(x_m[2] - x_m[0]).norm());
  return std::sqrt(0.5 * (x_m[2] - x_m[0]).cross(x_m[3] - x_m[1]).norm());
}

Eigen::Vector3d Facet::point(const Foot& foot) const {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < x_m.size(); ++i) p += foot.share[i] * x_m[i];
  return p;
}

Foot Facet::foot_of(const Eigen::Vector3d& x) const {
  constexpr int most_steps = 20;      // Gauss-Newton; a flat facet needs one step, a warped one a few
  constexpr double still = 1e-12;     // [-] step at which the place is found
  constexpr double far_beside = 3.0;  // [-] beyond it the node belongs to another facet
  Foot foot;
  Local at = x_m.size() % 3 == 0 ? Local(1.0 / 3.0, 1.0 / 3.0) : Local(0.0, 0.0);
  for (int step = 0; step < most_steps; ++step) {
    shape(x_m.size(), at, foot.share, foot.slope);
    const auto t = tangents(*this, foot.slope);
    const Eigen::VectorXd move = t.colPivHouseholderQr().solve(x - point(foot));
    at.head(move.size()) += move;
    at = at.cwiseMax(-far_beside).cwiseMin(far_beside);
    if (!(move.norm() > still)) break;
  }
  shape(x_m.size(), within(x_m.size(), at), foot.share, foot.slope);
  foot.distance_m = (x - point(foot)).norm();
  shape(x_m.size(), at, foot.share, foot.slope);
  return foot;
}

std::vector<Eigen::Matrix3d> Facet::motion(const Foot& foot, const Eigen::Vector3d& gap) const {
  std::vector<Eigen::Matrix3d> of_nodes;
  const auto t = tangents(*this, foot.slope);
  const bool bridged = t.cols() == 2 && gap.norm() > 0.0;
  const Eigen::Vector3d normal =
      bridged ? Eigen::Vector3d(t.col(0).cross(t.col(1)).normalized()) : Eigen::Vector3d::Zero().eval();
  const Eigen::Matrix<double, 3, Eigen::Dynamic> dual = bridged ? (t * (t.transpose() * t).inverse()).eval() : t;
  for (std::size_t i = 0; i < x_m.size(); ++i) {
    Eigen::Matrix3d a = foot.share[i] * Eigen::Matrix3d::Identity();
    for (Eigen::Index k = 0; bridged && k < 2; ++k)
      a -= gap.dot(normal) * foot.slope(static_cast<Eigen::Index>(i), k) * dual.col(k) * normal.transpose();
    of_nodes.push_back(a);
  }
  return of_nodes;
}

Facet make_facet(const InpParts& parts, const DeckPlace& at, const InpFacet& facet) {
  Facet made{.turning = facet.turning, .middle_m = Eigen::Vector3d::Zero()};
  for (const long id : facet.nodes) {
    made.nodes.push_back(parts.node(at, id));
    made.x_m.push_back(parts.place(made.nodes.back()));
    made.middle_m += made.x_m.back() / static_cast<double>(facet.nodes.size());
  }
  for (const Eigen::Vector3d& x : made.x_m) made.radius_m = std::max(made.radius_m, (x - made.middle_m).norm());
  if (!(made.size_m() > 1e-9 * made.radius_m))
    at.fail(fmt::format("a facet of element {} has no area", facet.element), "check the element's nodes");
  return made;
}

std::optional<std::pair<const Facet*, Foot>> nearest_facet(const std::vector<Facet>& facets, const Eigen::Vector3d& x,
                                                           double tolerance) {
  std::optional<std::pair<const Facet*, Foot>> nearest;
  double least = tolerance;
  for (const Facet& facet : facets) {
    if ((x - facet.middle_m).norm() > facet.radius_m + least) continue;
    Foot foot = facet.foot_of(x);
    if (foot.distance_m > least || (nearest && foot.distance_m >= least)) continue;
    least = foot.distance_m;
    nearest = {&facet, std::move(foot)};
  }
  return nearest;
}

}  // namespace twindeck::model_io
