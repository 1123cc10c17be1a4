#include "model_io/deck_stage.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/lists.hpp"
#include "fe/assembly_elements.hpp"
#include "fe/beam_frame.hpp"

namespace twindeck::model_io {
namespace {

/// Four Gauss points on [0, 1]: exact for the cubic shapes times a linear load.
struct StagePoint {
  double at, weight;
};
constexpr std::array<StagePoint, 4> line_points = {{{0.069431844202973712, 0.173927422568726929},
                                                    {0.330009478207571868, 0.326072577431273071},
                                                    {0.669990521792428132, 0.326072577431273071},
                                                    {0.930568155797026288, 0.173927422568726929}}};

constexpr std::uint16_t rotations_of_first = 0b111000, rotations_of_second = 0b111000 << 6;

const Eigen::Vector3d& stage_place(const fe::Model& model, int node) { return model.nodes[fe::slot(node)].x_m; }

/// Of each node of a facet: its area vector ∫ N_i n dA and its area ∫ N_i dA, which is negative at the corners of eight nodes.
struct FacetAreas {
  std::vector<Eigen::Vector3d> vector;
  std::vector<double> size;
};

/// Corners first, then the nodes in the middles of 1-2, 2-3, …; n points to where they run anticlockwise. Three points a
/// direction: exact for facets with straight edges.
FacetAreas facet_areas(const fe::Model& model, const std::vector<int>& nodes) {
  const std::size_t n = nodes.size();
  const bool triangle = n % 3 == 0;
  const double outer = std::sqrt(0.6);
  const std::array<double, 3> at = {-outer, 0.0, outer}, weight = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
  FacetAreas area{std::vector<Eigen::Vector3d>(n, Eigen::Vector3d::Zero()), std::vector<double>(n, 0.0)};
  std::array<double, 8> share{};
  std::array<Eigen::Vector2d, 8> slope;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double r = triangle ? 0.5 * (1.0 + at[i]) : at[i], s = triangle ? 0.5 * (1.0 + at[j]) * (1.0 - r) : at[j];
      facet_functions(n, r, s, share, slope);
      Eigen::Vector3d along_r = Eigen::Vector3d::Zero(), along_s = along_r;
      for (std::size_t k = 0; k < n; ++k) {
        along_r += slope[k][0] * stage_place(model, nodes[k]);
        along_s += slope[k][1] * stage_place(model, nodes[k]);
      }
      const double w = weight[i] * weight[j] * (triangle ? 0.25 * (1.0 - r) : 1.0);
      const Eigen::Vector3d normal = along_r.cross(along_s);
      for (std::size_t k = 0; k < n; ++k) {
        area.vector[k] += w * share[k] * normal;
        area.size[k] += w * share[k] * normal.norm();
      }
    }
  return area;
}

/// Forces and moments at both ends of a member. @return what stands against it, or ""
std::string end_loads(const fe::Model& model, const fe::Element& member, const LineLoad& load,
                      std::array<Eigen::Vector3d, 2>& force, std::array<Eigen::Vector3d, 2>& moment) {
  const bool turns = member.type == fe::ElementType::beam;
  const bool free1 = (member.releases & rotations_of_first) != 0, free2 = (member.releases & rotations_of_second) != 0;
  if (turns && free1 != free2)
    return "is loaded along its length and has a released rotation at one end, which together are not read";
  const std::array<Eigen::Vector3d, 2> arm = turns ? member.offset_m : fe::Element{}.offset_m;
  const std::array<Eigen::Vector3d, 2> ends = {stage_place(model, member.nodes[0]) + arm[0],
                                               stage_place(model, member.nodes[1]) + arm[1]};
  const double length = (ends[1] - ends[0]).norm(), part = load.to - load.from;
  const Eigen::Vector3d axis = (ends[1] - ends[0]) / length;
  for (auto& v : {&force, &moment}) v->fill(Eigen::Vector3d::Zero());
  for (const StagePoint& point : line_points) {
    const double x = load.from + part * point.at;
    const Eigen::Vector3d q = (load.q1 + (load.q2 - load.q1) * point.at) * (point.weight * part * length);
    const Eigen::Vector3d along = axis * axis.dot(q), across = q - along;
    const bool clamped = turns && !free1;
    const double second = clamped ? x * x * (3.0 - 2.0 * x) : x;
    force[0] += (1.0 - x) * along + (1.0 - second) * across;
    force[1] += x * along + second * across;
    if (!clamped) continue;
    moment[0] += length * x * (1.0 - x) * (1.0 - x) * axis.cross(across);
    moment[1] -= length * x * x * (1.0 - x) * axis.cross(across);
  }
  for (std::size_t end = 0; end < 2; ++end) moment[end] += arm[end].cross(force[end]);
  return "";
}

/// Large displacements are not computed with constraints, movements of supports, or free strains of other elements than bars.
/// @return a note of it, or ""
std::string settle_displacements(fe::Model& model) {
  if (model.prestress.displacements == fe::Displacements::linear) return "";
  const bool moves = std::ranges::any_of(model.prestress.loads, [](const auto& load) { return load.movement; });
  const bool strains = std::ranges::any_of(
      model.elements, [](const fe::Element& e) { return e.free_strain != 0.0 && e.type != fe::ElementType::bar; });
  if (model.constraints.empty() && !moves && !strains) return "";
  model.prestress.displacements = fe::Displacements::linear;
  return fmt::format(
      "the static displacements are taken as small, though the deck asks for large ones: with {} they are not computed",
      moves     ? "moved supports"
      : strains ? "temperatures or initial stresses"
                : "ties or equations");
}

}  // namespace

DeckStage::DeckStage(DeckModel& deck, bool large, std::string remedy)
    : deck_(deck), model_(deck.model), large_(large), remedy_(std::move(remedy)) {
  for (std::size_t i = 0; i < model_.elements.size(); ++i) position_.emplace(model_.elements[i].id, i);
  model_.gravity_m_s2 = 0.0;
  fe::Prestress& stage = model_.prestress;
  stage.rule = fe::PullRule::given;
  stage.load_case = "static";
  stage.shells_and_solids = true;
  stage.displacements = large ? fe::Displacements::large : fe::Displacements::linear;
  if (large) stage.load_steps = 10;
}

int DeckStage::node(const DeckPlace& at, long id) const {
  const auto found = deck_.node_position.find(id);
  if (found == deck_.node_position.end())
    at.fail(fmt::format("loads node {}, which no element joins", id), "load a node of the structure");
  return found->second;
}

std::vector<fe::Element*> DeckStage::pieces(long id) {
  std::vector<fe::Element*> found;
  const auto at = position_.find(id);
  if (at == position_.end()) return found;
  const std::size_t count = deck_.pieces.contains(id) ? deck_.pieces.at(id) : 1;
  for (std::size_t i = 0; i < count; ++i) found.push_back(&model_.elements[at->second + i]);
  return found;
}

fe::Element& DeckStage::element(const DeckPlace& at, long id) {
  if (!position_.contains(id)) at.fail(fmt::format("loads element {}, which is not in the model", id), "mend its number");
  return *pieces(id).front();
}

void DeckStage::refuse(const DeckPlace& at, long id, const std::string& what) const {
  at.fail(fmt::format("{} on element {} stiffens or softens the structure and is not read", what, id), remedy_);
}

void DeckStage::load(int node, int direction, double value) {
  if (value == 0.0) return;
  for (fe::Prestress::Load& load : model_.prestress.loads)
    if (load.node == node && load.direction == direction && !load.movement) {
      load.value += value;
      return;
    }
  model_.prestress.loads.push_back({node, direction, value, false});
}

void DeckStage::load(int node, const Eigen::Vector3d& force, const Eigen::Vector3d& moment) {
  for (int d = 0; d < 3; ++d) load(node, d, force[d]);
  for (int d = 0; d < 3; ++d) load(node, 3 + d, moment[d]);
}

void DeckStage::move(const DeckPlace& at, int node, int direction, double value, const Eigen::Matrix3d& axes) {
  constexpr double aligned = 1.0 - 1e-9;
  Eigen::Index along = 0;
  const bool skew = axes.row(direction % 3).cwiseAbs().maxCoeff(&along) < aligned;
  if ((direction > 2 || skew) && value != 0.0)
    at.fail("turns a support, or moves it along an axis that is skew to the global ones, which is not read",
            "load the model by forces, or move its supports along the global axes");
  if (skew || direction > 2) return;
  value *= axes(direction, along);
  direction = static_cast<int>(along);
  std::erase_if(model_.prestress.loads, [&](const fe::Prestress::Load& load) {
    return load.node == node && load.direction == direction && load.movement;
  });
  if (value != 0.0) model_.prestress.loads.push_back({node, direction, value, true});
}

void DeckStage::accelerate(const Eigen::Vector3d& acceleration) {
  const Eigen::Vector3d sum = model_.gravity_m_s2 * model_.gravity_direction + acceleration;
  model_.gravity_m_s2 = sum.norm();
  if (model_.gravity_m_s2 > 0.0) model_.gravity_direction = sum.normalized();
}

void DeckStage::accelerate(long id, const Eigen::Vector3d& acceleration) {
  for (const fe::Element* piece : pieces(id)) {
    const fe::ElementMatrix mass = fe::element_mass(model_, *piece);
    Eigen::VectorXd fall = Eigen::VectorXd::Zero(std::ssize(mass.dofs));
    for (Eigen::Index i = 0; i < fall.size(); ++i)
      if (const int d = mass.dofs[static_cast<std::size_t>(i)] % 6; d < 3) fall[i] = acceleration[d];
    const Eigen::VectorXd force = mass.matrix * fall;
    for (Eigen::Index i = 0; i < fall.size(); ++i) {
      const int dof = mass.dofs[static_cast<std::size_t>(i)];
      load(dof / 6, dof % 6, force[i]);
    }
  }
}

void DeckStage::load_line(const DeckPlace& at, long id, const std::function<LineLoad(const fe::Element& piece)>& of) {
  (void)element(at, id);
  for (const fe::Element* piece : pieces(id)) {
    if (piece->type != fe::ElementType::beam && piece->type != fe::ElementType::bar) refuse(at, id, "a load along its length");
    std::array<Eigen::Vector3d, 2> force, moment;
    if (const std::string problem = end_loads(model_, *piece, of(*piece), force, moment); !problem.empty())
      at.fail(fmt::format("element {} {}", id, problem), "write the load as forces and moments of nodes");
    for (std::size_t end = 0; end < 2; ++end) load(piece->nodes[end], force[end], moment[end]);
  }
}

void DeckStage::press_shell(const DeckPlace& at, long id, double pressure) {
  (void)element(at, id);
  for (const fe::Element* piece : pieces(id)) {
    if (piece->type != fe::ElementType::shell) refuse(at, id, "a pressure without a face");
    press(piece->nodes, -pressure);
  }
}

void DeckStage::press_solid(const DeckPlace& at, long id, std::size_t face, double pressure) {
  const fe::Element& e = element(at, id);
  if (pieces(id).size() > 1 || e.type != fe::ElementType::solid || face >= solid_faces(e.nodes.size()).size())
    refuse(at, id, fmt::format("a pressure on face {} (P{})", face + 1, face + 1));
  press(each_of(solid_faces(e.nodes.size())[face], [&](std::size_t i) { return e.nodes[i]; }), pressure);
}

void DeckStage::press(const std::vector<int>& nodes, double pressure) {
  const FacetAreas area = facet_areas(model_, nodes);
  for (std::size_t i = 0; i < nodes.size(); ++i) load(nodes[i], -pressure * area.vector[i]);
}

void DeckStage::draw(const std::vector<int>& nodes, const Eigen::Vector3d& direction, double traction) {
  const FacetAreas area = facet_areas(model_, nodes);
  for (std::size_t i = 0; i < nodes.size(); ++i) load(nodes[i], traction * area.size[i] * direction);
}

void DeckStage::strain(const DeckPlace& at, long id, double value, bool is_stress) {
  for (fe::Element* e : pieces(id)) {
    if (e->type != fe::ElementType::beam && e->type != fe::ElementType::bar)
      at.fail(fmt::format("strains element {}, and an initial strain or stress is read for beams and bars alone", id),
              "load the model by forces, imposed movements or temperatures");
    e->free_strain -= is_stress ? value / model_.materials[fe::slot(e->material)].youngs_modulus_Pa : value;
  }
}

void DeckStage::warm(const std::function<double(const fe::Element&, long, const Expansion&)>& rise_K) {
  for (fe::Element& e : model_.elements) {
    const auto expansion = deck_.expansion.find(e.material);
    if (expansion == deck_.expansion.end() || expansion->second.per_K == 0.0) continue;
    double rise = 0.0, nodes = 0.0;
    for (const int node : e.nodes) {
      const long id = model_.nodes[fe::slot(node)].id;
      if (deck_.made_nodes.contains(id)) continue;
      rise += rise_K(e, id, expansion->second);
      nodes += 1.0;
    }
    e.free_strain += expansion->second.per_K * (rise / nodes);
  }
}

void DeckStage::close(const std::string& of, bool strained) {
  if (const std::string note = settle_displacements(model_); !note.empty()) deck_.notes.push_back(note);
  deck_.notes.push_back(fmt::format("the modes are those about the state under the loads of {}{}: {} loads of nodes{}{}", of,
                                    large_ ? " (in the deformed geometry)" : "", model_.prestress.loads.size(),
                                    model_.gravity_m_s2 > 0.0 ? ", gravity" : "",
                                    strained ? ", temperatures or initial stresses" : ""));
}

void facet_functions(std::size_t n, double r, double s, std::array<double, 8>& share, std::array<Eigen::Vector2d, 8>& slope) {
  if (n % 3 == 0) {
    const std::array<double, 3> l = {1.0 - r - s, r, s};
    const std::array<Eigen::Vector2d, 3> d = {Eigen::Vector2d(-1.0, -1.0), Eigen::Vector2d::UnitX(), Eigen::Vector2d::UnitY()};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t next = (i + 1) % 3;
      share[i] = n == 3 ? l[i] : l[i] * (2.0 * l[i] - 1.0);
      slope[i] = (n == 3 ? 1.0 : 4.0 * l[i] - 1.0) * d[i];
      share[i + 3] = 4.0 * l[i] * l[next];
      slope[i + 3] = 4.0 * (l[i] * d[next] + l[next] * d[i]);
    }
    return;
  }
  constexpr std::array<double, 8> xi = {-1.0, 1.0, 1.0, -1.0, 0.0, 1.0, 0.0, -1.0},
                                  eta = {-1.0, -1.0, 1.0, 1.0, -1.0, 0.0, 1.0, 0.0};
  for (std::size_t i = 0; i < n; ++i) {
    // Products of a linear function along each direction, or 1 - r² along an edge; corners of eight less half of both middles.
    const double a = xi[i] == 0.0 ? 1.0 - r * r : 0.5 * (1.0 + xi[i] * r),
                 b = eta[i] == 0.0 ? 1.0 - s * s : 0.5 * (1.0 + eta[i] * s);
    share[i] = a * b;
    slope[i] = {(xi[i] == 0.0 ? -2.0 * r : 0.5 * xi[i]) * b, a * (eta[i] == 0.0 ? -2.0 * s : 0.5 * eta[i])};
  }
  for (std::size_t i = 4; i < n; ++i)
    for (const std::size_t corner : {i - 4, (i - 3) % 4}) share[corner] -= 0.5 * share[i], slope[corner] -= 0.5 * slope[i];
}

Eigen::Matrix3d member_axes(const fe::Model& model, const fe::Element& member) {
  return fe::beam_axes(fe::beam_geometry(model, member));
}

const std::vector<std::vector<std::size_t>>& solid_faces(std::size_t nodes) {
  using Faces = std::vector<std::vector<std::size_t>>;
  static const Faces hexahedron = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}},
                     tetrahedron = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}},
                     hexahedron_20 = {{0, 3, 2, 1, 11, 10, 9, 8},  {4, 5, 6, 7, 12, 13, 14, 15}, {0, 1, 5, 4, 8, 17, 12, 16},
                                      {1, 2, 6, 5, 9, 18, 13, 17}, {2, 3, 7, 6, 10, 19, 14, 18}, {3, 0, 4, 7, 11, 16, 15, 19}},
                     tetrahedron_10 = {{0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 9, 8}, {2, 0, 3, 6, 7, 9}};
  return nodes == 20 ? hexahedron_20 : nodes == 10 ? tetrahedron_10 : nodes == 8 ? hexahedron : tetrahedron;
}

}  // namespace twindeck::model_io
