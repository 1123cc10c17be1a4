#include "model_io/nastran_stage.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <set>

#include "core/error.hpp"
#include "model_io/deck_stage.hpp"
#include "model_io/inp_cards.hpp"
#include "model_io/nastran_properties.hpp"

namespace twindeck::model_io::nastran {
namespace {

constexpr const char* write_others =
    "read are FORCE, MOMENT, FORCE1, MOMENT1, PLOAD, PLOAD1, PLOAD2, PLOAD4, GRAV, SPCD, TEMP, "
    "TEMPD, TEMPRB; write others as FORCE";

class Stage {
 public:
  Stage(Parts& parts, const Subcase& subcase) : parts_(parts), model_(parts.model), subcase_(subcase) {
    for (std::size_t i = 0; i < model_.elements.size(); ++i) position_.emplace(model_.elements[i].id, i);
  }

  void read() {
    open_stage(model_, false);
    move_supports("SPC", parts_.deck.case_control().spc);
    if (const auto load = subcase_.chosen.find("LOAD"); load != subcase_.chosen.end()) {
      for (const auto& [set, factor] : combined(load->second)) read_set(set, factor);
      move_supports("SPCD", load->second);
    }
    warm_all();
    parts_.notes.push_back(
        fmt::format("the modes are those about the state under the loads of subcase {} (STATSUB): {} loads of nodes{}",
                    subcase_.id, model_.prestress.loads.size(), model_.gravity_m_s2 > 0.0 ? ", gravity" : ""));
  }

 private:
  /// Load sets with their factors: a LOAD card's, or the one itself.
  [[nodiscard]] std::map<long, double> combined(long set) const {
    std::map<long, double> sets;
    for (const Card& card : parts_.deck.cards()) {
      if (card.name != "LOAD" || parts_.deck.integer(card, 0) != set) continue;
      for (std::size_t i = 2; i + 1 < Deck::size(card); i += 2)
        sets[parts_.deck.integer(card, i + 1)] += parts_.deck.number(card, 1) * parts_.deck.number(card, i);
      return sets;
    }
    return {{set, 1.0}};
  }

  void read_set(long set, double factor) {
    using Handler = void (Stage::*)(const Card&, double);
    static const std::map<std::string, Handler> handlers = {
        {"FORCE", &Stage::read_force},     {"MOMENT", &Stage::read_force},   {"FORCE1", &Stage::read_force},
        {"MOMENT1", &Stage::read_force},   {"PLOAD1", &Stage::read_line},    {"PLOAD2", &Stage::read_pressure},
        {"PLOAD4", &Stage::read_pressure}, {"PLOAD", &Stage::read_pressure}, {"GRAV", &Stage::read_gravity}};
    static const std::set<std::string> refused = {"FORCE2", "MOMENT2", "RFORCE",  "SLOAD",
                                                  "ACCEL",  "ACCEL1",  "PLOADX1", "DEFORM"};
    bool any = false;
    for (const Card& card : parts_.deck.cards()) {
      const auto handler = handlers.find(card.name);
      const bool is_refused = refused.contains(card.name);
      if ((handler == handlers.end() && !is_refused) || parts_.deck.integer(card, 0) != set) continue;
      if (is_refused)
        parts_.deck.fail(card, "stiffens or softens the structure of the modes that STATSUB asks for, and is not read",
                         write_others);
      (this->*handler->second)(card, factor);
      any = true;
    }
    const bool moves = std::any_of(parts_.deck.cards().begin(), parts_.deck.cards().end(),
                                   [&](const Card& c) { return c.name == "SPCD" && parts_.deck.integer(c, 0) == set; });
    if (!any && !moves)
      throw InputError({parts_.deck.files().front().string(), 0, "LOAD"},
                       fmt::format("subcase {} chooses the loads {}, which no card has", subcase_.id, set),
                       "give the cards, or mend the number");
  }

  int node(const Card& card, long grid) const {
    const auto found = parts_.node_position.find(grid);
    if (found == parts_.node_position.end())
      parts_.deck.fail(card, fmt::format("loads grid {}, which no element joins", grid), "load a grid of the structure");
    return found->second;
  }

  void read_force(const Card& card, double factor) {
    const bool by_grids = card.name.ends_with('1'), turns = card.name.starts_with("MOMENT");
    const long grid = parts_.deck.integer(card, 1);
    Eigen::Vector3d f;
    if (by_grids) {
      const Eigen::Vector3d chord =
          parts_.place(card, parts_.deck.integer(card, 4)) - parts_.place(card, parts_.deck.integer(card, 3));
      f = parts_.deck.number(card, 2) * chord.normalized();
    } else {
      const long system = parts_.deck.integer_or(card, 2, 0);
      const Eigen::Vector3d local = parts_.deck.number(card, 3) * parts_.deck.vector(card, 4);
      f = system == 0 ? local
                      : Eigen::Vector3d(parts_.system(card, system).axes_at(parts_.place(card, grid)).transpose() * local);
    }
    const Eigen::Vector3d none = Eigen::Vector3d::Zero();
    add_load(model_, node(card, grid), turns ? none : factor * f, turns ? factor * f : none);
  }

  fe::Element& element(const Card& card, long id) {
    const auto found = position_.find(id);
    if (found == position_.end())
      parts_.deck.fail(card, fmt::format("loads element {}, which is not in the model", id), "mend its number");
    return model_.elements[found->second];
  }

  void read_line(const Card& card, double factor) {
    // SID, EID, TYPE, SCALE, X1, P1, X2, P2
    const fe::Element& e = element(card, parts_.deck.integer(card, 1));
    const std::string type = upper_case(Deck::text(card, 2)), scale = upper_case(Deck::text(card, 3));
    const bool local = type.size() == 3 && type[2] == 'E';
    if (type.size() < 2 || type[0] != 'F' || type[1] < 'X' || type[1] > 'Z' || (type.size() > 2 && !local))
      parts_.deck.fail(card, fmt::format("is of type {}, of which FX, FY, FZ, FXE, FYE, FZE are read", type),
                       "write it as FORCE and MOMENT of grids");
    if (scale != "LE" && scale != "FR")
      parts_.deck.fail(card, fmt::format("has the scale {}, of which LE and FR are read", scale), "give lengths or fractions");
    const auto& x = model_.nodes;
    const double length = (x[static_cast<std::size_t>(e.nodes[1])].x_m - x[static_cast<std::size_t>(e.nodes[0])].x_m).norm();
    const double per = scale == "LE" ? length : 1.0;
    const double x1 = parts_.deck.number_or(card, 4, 0.0) / per, p1 = factor * parts_.deck.number(card, 5);
    const double x2 = parts_.deck.number_or(card, 6, x1 * per) / per, p2 = factor * parts_.deck.number_or(card, 7, p1 / factor);
    Eigen::Vector3d direction = Eigen::Vector3d::Unit(type[1] - 'X');
    if (local) direction = member_axes(model_, e).row(type[1] - 'X').transpose();
    LineLoad load{p1 * direction, p2 * direction, x1, x2};
    if (x2 <= x1) {                   // a force at one place, as a short line of it
      constexpr double point = 1e-6;  // [-] of the length
      load.from = std::clamp(x1 - 0.5 * point, 0.0, 1.0 - point), load.to = load.from + point;
      load.q1 = load.q2 = p1 / (point * length) * direction;
    }
    if (const std::string problem = add_line_load(model_, e, load); !problem.empty())
      parts_.deck.fail(card, fmt::format("its element {} {}", e.id, problem), "write it as FORCE and MOMENT of grids");
  }

  void read_pressure(const Card& card, double factor) {
    if (card.name == "PLOAD") {
      std::vector<int> nodes;
      for (std::size_t i = 2; i < 6 && !Deck::blank(card, i); ++i) nodes.push_back(node(card, parts_.deck.integer(card, i)));
      if (nodes.size() < 3) parts_.deck.fail(card, "has fewer than three grids", "give three or four");
      return add_pressure(model_, nodes, -factor * parts_.deck.number(card, 1));
    }
    const bool four = card.name == "PLOAD4";
    const std::size_t first = four ? 1 : 2;
    const double p = factor * parts_.deck.number(card, four ? 2 : 1);
    for (std::size_t i = 3; four && i < 6; ++i)
      if (parts_.deck.number_or(card, i, p / factor) != p / factor)
        parts_.deck.fail(card, "has a pressure that varies over its face, which is not read", "give P1 alone");
    for (std::size_t i = 8; four && i < Deck::size(card); ++i)
      if (!Deck::blank(card, i) && Deck::text(card, i) != "0")
        parts_.deck.fail(card, "gives its pressure a direction, which is not read", "write it as FORCE of grids");
    std::vector<long> ids;
    if (four && upper_case(Deck::text(card, 6)) == "THRU") {
      for (long id = parts_.deck.integer(card, 1); id <= parts_.deck.integer(card, 7); ++id)
        if (position_.contains(id)) ids.push_back(id);
    } else if (four) {
      ids = {parts_.deck.integer(card, 1)};
    } else if (upper_case(Deck::text(card, first + 1)) == "THRU") {
      for (long id = parts_.deck.integer(card, first); id <= parts_.deck.integer(card, first + 2); ++id)
        if (position_.contains(id)) ids.push_back(id);
    } else {
      for (std::size_t i = first; i < Deck::size(card); ++i)
        if (!Deck::blank(card, i)) ids.push_back(parts_.deck.integer(card, i));
    }
    for (const long id : ids) {
      (void)element(card, id);
      const std::size_t at = position_.at(id), count = parts_.pieces.contains(id) ? parts_.pieces.at(id) : 1;
      for (std::size_t i = at; i < at + count; ++i) press(card, model_.elements[i], p, count);
    }
  }

  void press(const Card& card, const fe::Element& e, double p, std::size_t pieces) {
    if (e.type == fe::ElementType::shell) return add_pressure(model_, e.nodes, -p);
    if (e.type != fe::ElementType::solid || pieces > 1 || card.name != "PLOAD4" || Deck::blank(card, 6))
      parts_.deck.fail(card, fmt::format("loads element {}, on which it is not read", e.id), write_others);
    // G1 lies on the face; G3 is the corner opposite to it on a hexahedron's, G4 the corner off a tetrahedron's.
    const int g1 = node(card, parts_.deck.integer(card, 6));
    const int other = Deck::blank(card, 7) ? -1 : node(card, parts_.deck.integer(card, 7));
    const bool hexahedron = e.nodes.size() == 8;
    for (const auto& face : solid_faces(e.nodes.size())) {
      std::vector<int> nodes;
      for (const std::size_t i : face) nodes.push_back(e.nodes[i]);
      const auto at = std::find(nodes.begin(), nodes.end(), g1);
      const bool has_other = std::find(nodes.begin(), nodes.end(), other) != nodes.end();
      if (at == nodes.end() || has_other != hexahedron) continue;
      if (hexahedron && nodes[static_cast<std::size_t>((at - nodes.begin()) + 2) % 4] != other) continue;
      return add_pressure(model_, nodes, p);
    }
    parts_.deck.fail(card, fmt::format("names no face of element {}", e.id),
                     "give G1 and G3 at opposite corners of the face, of a tetrahedron G1 on it and G4 off it");
  }

  void read_gravity(const Card& card, double factor) {
    const long system = parts_.deck.integer_or(card, 1, 0);
    const Eigen::Vector3d local = parts_.deck.number(card, 2) * parts_.deck.vector(card, 3);
    const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    add_gravity(
        model_,
        factor * (system == 0 ? local : Eigen::Vector3d(parts_.system(card, system).axes_at(origin).transpose() * local)));
  }

  /// Movements of supports: G1, C1, D1, G2, C2, D2 of the cards with this name and set.
  void move_supports(const std::string& name, const std::optional<long>& set) {
    for (const Card& card : parts_.deck.cards()) {
      if (card.name != name || (set && parts_.deck.integer(card, 0) != *set)) continue;
      for (std::size_t i = 1; i < Deck::size(card); i += 3) {
        const double size = Deck::blank(card, i) ? 0.0 : parts_.deck.number_or(card, i + 2, 0.0);
        if (Deck::blank(card, i) || (size == 0.0 && name == "SPC")) continue;
        move_support(card, parts_.deck.integer(card, i), components(parts_, card, i + 1), size);
      }
    }
  }

  void move_support(const Card& card, long grid, const std::array<bool, 6>& flags, double size) {
    const Eigen::Matrix3d axes = parts_.displacement_axes(card, grid);
    for (std::size_t c = 0; c < 6; ++c) {
      if (!flags[c]) continue;
      Eigen::Index along = 0;
      constexpr double aligned = 1.0 - 1e-9;
      if (c > 2 || axes.row(static_cast<Eigen::Index>(c)).cwiseAbs().maxCoeff(&along) < aligned)
        parts_.deck.fail(card, "moves a support by a rotation or along a skew axis, which is not read",
                         "move it along a basic axis, or load the model by FORCE");
      set_movement(model_, node(card, grid), static_cast<int>(along), size * axes(static_cast<Eigen::Index>(c), along));
    }
  }

  /// Temperatures of grids in a set; `otherwise` from TEMPD.
  std::map<long, double> temperatures(long set, std::optional<double>& otherwise) const {
    std::map<long, double> of;
    for (const Card& card : parts_.deck.cards()) {
      if (card.name == "TEMP" && parts_.deck.integer(card, 0) == set)
        for (std::size_t i = 1; i + 1 < Deck::size(card); i += 2)
          if (!Deck::blank(card, i)) of[parts_.deck.integer(card, i)] = parts_.deck.number(card, i + 1);
      for (std::size_t i = 0; card.name == "TEMPD" && i + 1 < Deck::size(card); i += 2)
        if (parts_.deck.integer(card, i) == set) otherwise = parts_.deck.number(card, i + 1);
    }
    return of;
  }

  void warm_all() {
    const auto load = subcase_.chosen.find("TEMPERATURE(LOAD)"), initial = subcase_.chosen.find("TEMPERATURE(INITIAL)");
    if (load == subcase_.chosen.end()) return;
    std::optional<double> now_else, before_else;
    const std::map<long, double> now = temperatures(load->second, now_else);
    std::map<long, double> before;
    const bool has_initial = initial != subcase_.chosen.end();
    if (has_initial) before = temperatures(initial->second, before_else);
    std::map<long, double> by_element;
    for (const Card& card : parts_.deck.cards())
      if (card.name == "TEMPRB" && parts_.deck.integer(card, 0) == load->second)
        by_element[parts_.deck.integer(card, 1)] = 0.5 * (parts_.deck.number(card, 2) + parts_.deck.number_or(card, 3, 0.0));
    for (fe::Element& e : model_.elements) {
      const auto expansion = parts_.expansion.find(e.material);
      if (expansion == parts_.expansion.end() || expansion->second.per_K == 0.0) continue;
      double rise = 0.0, grids = 0.0;
      for (const int node : e.nodes) {
        const long grid = model_.nodes[static_cast<std::size_t>(node)].id;
        if (!parts_.grids.contains(grid)) continue;  // in the centre of a split element
        const auto mean = by_element.find(e.id);
        const double t1 = mean != by_element.end() ? mean->second : at(now, now_else, grid, load->second);
        const double t0 = has_initial ? at(before, before_else, grid, initial->second) : expansion->second.reference_K;
        rise += t1 - t0;
        grids += 1.0;
      }
      warm(e, expansion->second.per_K, rise / grids);
    }
  }

  double at(const std::map<long, double>& of, const std::optional<double>& otherwise, long grid, long set) const {
    if (const auto found = of.find(grid); found != of.end()) return found->second;
    if (otherwise) return *otherwise;
    throw InputError({parts_.deck.files().front().string(), 0, "TEMP"},
                     fmt::format("the set of temperatures {} has none for grid {}", set, grid), "give TEMPD for the others");
  }

  Parts& parts_;
  fe::Model& model_;
  const Subcase& subcase_;
  std::map<long, std::size_t> position_;
};

}  // namespace

void read_stage(Parts& parts) {
  const CaseControl& control = parts.deck.case_control();
  std::optional<long> wanted;
  for (const Subcase& subcase : control.subcases) {
    const auto statsub = subcase.chosen.find("STATSUB");
    if (statsub == subcase.chosen.end()) continue;
    if (wanted && *wanted != statsub->second)
      throw InputError({parts.deck.files().front().string(), 0, "STATSUB"},
                       fmt::format("names subcase {} in one subcase and {} in another", *wanted, statsub->second),
                       "leave one modal subcase in the deck");
    wanted = statsub->second;
  }
  if (!wanted) return;
  const auto found = std::find_if(control.subcases.begin(), control.subcases.end(),
                                  [&](const Subcase& subcase) { return subcase.id == *wanted; });
  if (found == control.subcases.end())
    throw InputError({parts.deck.files().front().string(), 0, "STATSUB"},
                     fmt::format("names subcase {}, which the case control does not have", *wanted),
                     "name the static subcase whose loads act");
  for (const char* refused : {"DEFORM"})
    if (found->chosen.contains(refused))
      throw InputError(
          {parts.deck.files().front().string(), 0, refused},
          fmt::format("of subcase {} strains the structure of the modes that STATSUB asks for, and is not read", *wanted),
          "write it as temperatures or forces");
  Stage(parts, *found).read();
}

}  // namespace twindeck::model_io::nastran
