#include "model_io/sap2000.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "core/lists.hpp"
#include "model_io/deck_model.hpp"
#include "model_io/deck_units.hpp"
#include "model_io/profiles.hpp"
#include "model_io/sap2000_constraints.hpp"
#include "model_io/sap2000_tables.hpp"

namespace twindeck::model_io {
namespace {

const std::array<std::string, 6> joint_directions = {"U1", "U2", "U3", "R1", "R2", "R3"};
const std::array<std::string, 6> global_directions = {"UX", "UY", "UZ", "RX", "RY", "RZ"};

/// Tables of the structure that are read, and beginnings of names of tables that say nothing about stiffness and mass.
const std::vector<std::string>& sap_tables_read() {
  static const std::vector<std::string> names = split_at(
      "JOINT COORDINATES|JOINT RESTRAINT ASSIGNMENTS|JOINT SPRING ASSIGNMENTS 1 - UNCOUPLED|JOINT ADDED MASS "
      "ASSIGNMENTS|CONNECTIVITY - FRAME|CONNECTIVITY - AREA|FRAME SECTION ASSIGNMENTS|FRAME SECTION PROPERTIES 01 - "
      "GENERAL|FRAME LOCAL AXES ASSIGNMENTS 1 - TYPICAL|FRAME RELEASE ASSIGNMENTS 1 - GENERAL|FRAME PROPERTY MODIFIERS|AREA "
      "SECTION ASSIGNMENTS|AREA SECTION PROPERTIES|MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES|MASS SOURCE|MASSES 1 - "
      "MASS SOURCE|CONSTRAINT DEFINITIONS - BODY|CONSTRAINT DEFINITIONS - DIAPHRAGM|JOINT CONSTRAINT ASSIGNMENTS",
      '|');
  return names;
}

bool says_nothing(const std::string& table) {
  static const std::vector<std::string> starts = split_at(  // axes of areas too: materials are isotropic
      "JOINT LOADS|JOINT PATTERN|FRAME LOADS|FRAME OUTPUT|FRAME DESIGN|FRAME AUTO MESH|FRAME SECTION PROPERTIES 02|"
      "FRAME SECTION PROPERTIES 03|AREA LOADS|AREA AUTO MESH|AREA DESIGN|AREA SECTION PROPERTY DESIGN|"
      "MATERIAL LIST|MATERIAL PROPERTIES|MASSES 2|AREA EDGE|AREA LOCAL AXES",
      '|');
  return std::ranges::any_of(starts, [&](const std::string& start) { return table.starts_with(start); });
}

void refuse_what_is_not_carried(const SapTables& tables) {
  static const std::vector<std::string> structural = {"JOINT ", "FRAME ", "AREA ", "CONNECTIVITY", "CABLE ",    "TENDON ",
                                                      "SOLID ", "LINK ",  "MASS",  "CONSTRAINT",   "MATERIAL ", "NONLINEAR"};
  for (const auto& [name, rows] : tables.all()) {
    const bool of_structure =
        std::ranges::any_of(structural, [&, &table = name](const auto& s) { return table.starts_with(s); });
    const bool read = contains(sap_tables_read(), name);
    if (!of_structure || read || says_nothing(name)) continue;
    const auto speaking = std::ranges::find_if(rows, [](const SapRow& row) { return !row.is_neutral(); });
    if (speaking == rows.end()) continue;
    speaking->fail("this table is not carried, and the structure would be another without it",
                   "take it out of the model, or say the same by joints, frames, areas, restraints, springs and masses");
  }
  for (const SapRow& row : tables.rows("LOAD CASE DEFINITIONS"))
    if (upper_case(row.get("Type")) == "LINMODAL" && upper_case(row.get("InitialCond", "Zero")) != "ZERO")
      row.fail("asks for modes about the state of another case, which is not read", "start the modal case from zero");
  for (const SapRow& row : tables.rows("MASS SOURCE"))
    if (row.yes("Loads") || upper_case(row.get("Elements", "Yes")) == "NO")
      row.fail("takes masses from loads, or none from elements, which is not read", "take them from elements and added masses");
  for (const SapRow& row : tables.rows("MASSES 1 - MASS SOURCE"))
    if (upper_case(row.get("MassFrom", "Elements")) != "ELEMENTS")
      row.fail("takes masses from loads, which is not read", "take them from elements and added masses");
}

class SapReader {
 public:
  explicit SapReader(const std::filesystem::path& file) : tables_(file) { deck_.model.source = file.string(); }

  ImportedModel read(const std::filesystem::path& file) {
    refuse_what_is_not_carried(tables_);
    fe::Formulation& formulation = deck_.model.formulation;
    formulation.lumped_mass = true;
    formulation.beam_rotary_inertia = formulation.shell_rotary_inertia = false;
    const DeckUnits units = units_of_file();
    read_joints();
    read_frames();
    read_areas();
    read_attachments();
    hold_inactive();
    read_constraints();
    deck_.drop_unused_nodes();
    to_si(deck_.model, units, 1.0);
    return deck_.finished({file}, "frames or areas");
  }

 private:
  [[nodiscard]] DeckUnits units_of_file() const {
    const auto& control = tables_.rows("PROGRAM CONTROL");
    const DeckPlace at = control.empty() ? tables_.whole("PROGRAM CONTROL") : static_cast<const DeckPlace&>(control.front());
    std::vector<std::string> names = split_at(control.empty() ? "" : control.front().get("CurrUnits"), ',');
    names.resize(2);
    return units_of(names[1], names[0], {at, at}, "write CurrUnits=\"KN, m, C\" into the table PROGRAM CONTROL");
  }

  /// The number that a name is; a number of its own for a name that is none.
  static long number_of_name(const std::string& name, long& last) {
    constexpr long above_names = 100'000'000;
    if (is_whole_number(name) && std::stol(name) > 0 && std::stol(name) < above_names) return std::stol(name);
    return last = std::max(last, above_names) + 1;
  }

  void read_joints() {
    for (const SapRow& row : tables_.rows("JOINT COORDINATES")) {
      const std::string name = row.required("Joint");
      const bool global = row.has("GlobalX") && row.has("GlobalY") && row.has("GlobalZ");
      if (!global && (upper_case(row.get("CoordType", "Cartesian")) != "CARTESIAN" ||
                      upper_case(row.get("CoordSys", "GLOBAL")) != "GLOBAL"))
        row.fail("is given in other axes than the global ones", "export the columns GlobalX, GlobalY, GlobalZ");
      const Eigen::Vector3d x =
          global ? Eigen::Vector3d(row.number_of("GlobalX"), row.number_of("GlobalY"), row.number_of("GlobalZ"))
                 : Eigen::Vector3d(row.number_of("XorR"), row.number_of("Y", 0.0), row.number_of("Z", 0.0));
      if (!joints_.emplace(name, deck_.add_node(number_of_name(name, deck_.last_node), x)).second)
        row.fail(fmt::format("joint {} is defined twice", name), "keep one of the two rows");
    }
  }

  int joint(const SapRow& row, const std::string& key) const {
    const auto found = joints_.find(row.required(key));
    if (found == joints_.end()) row.fail(fmt::format("joint {} is not defined", row.get(key)), "give it in JOINT COORDINATES");
    return found->second;
  }

  /// The row of a table whose `key` is `name`. @throws InputError at `from` where there is none
  const SapRow& row_of(const DeckPlace& from, const std::string& table, const std::string& key, const std::string& name) const {
    for (const SapRow& row : tables_.rows(table))
      if (upper_case(row.get(key)) == upper_case(name)) return row;
    from.fail(fmt::format("'{}' is in no row of the table {}", name, table), "give the row");
  }

  int material(const SapRow& section) {
    const std::string name = section.required("Material");
    if (const auto known = materials_.find(name); known != materials_.end()) return known->second;
    const SapRow& row = row_of(section, "MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES", "Material", name);
    if (row.has("E2")) row.fail("is not isotropic, which is not read", "give E1, G12 and U12 of an isotropic material");
    fe::Material m{.name = name, .youngs_modulus_Pa = row.number_of("E1"), .poisson_ratio = row.number_of("U12", 0.0)};
    m.shear_modulus_Pa = row.number_of("G12", m.youngs_modulus_Pa / (2.0 * (1.0 + m.poisson_ratio)));
    m.density_kg_m3 = row.number_of("UnitMass", 0.0);
    DeckModel::check_poisson_ratio(row, m.poisson_ratio);
    if (!(m.youngs_modulus_Pa > 0.0) || !(m.shear_modulus_Pa > 0.0) || m.density_kg_m3 < 0.0)
      row.fail("a modulus is not above 0, or a mass is negative", "check E1, G12 and UnitMass");
    deck_.model.materials.push_back(m);
    return materials_[name] = static_cast<int>(deck_.model.materials.size()) - 1;
  }

  /// @throws InputError  for a factor that is not 1
  static void refuse_factors(const SapRow& row, const std::vector<std::string>& keys) {
    for (const std::string& key : keys)
      if (row.number_of(key, 1.0) != 1.0)
        row.fail(fmt::format("{} is {}, and a factor on area or mass is not carried", key, row.get(key)),
                 "give the section or the material the value itself");
  }

  /// A section that is given by its shape and dimensions alone: depth t3 along local 2, width t2, flanges tf, webs tw.
  fe::Section drawn_section(const SapRow& row) {
    const std::string shape = upper_case(row.get("Shape"));
    const auto d = [&](const char* key) { return row.number_of(key, 0.0); };
    const double t3 = d("t3"), t2 = d("t2"), tf = d("tf"), tw = d("tw");
    Shape drawn;
    if (shape == "RECTANGULAR") drawn = rectangles({{0.0, 0.0, t2, t3}});
    if (shape == "CIRCLE") drawn = circle(t3 / 2.0);
    if (shape == "PIPE") drawn = circle(t3 / 2.0, t3 / 2.0 - tw);
    if (shape == "BOX/TUBE") drawn = box(t2, t3, {tw, tf, tw, tf});
    if (shape == "I/WIDE FLANGE") drawn = i_shape(t3, {row.number_of("t2b", t2), t2}, {row.number_of("tfb", tf), tf}, tw);
    if (shape == "CHANNEL") drawn = channel(t3, {t2, t2}, {tf, tf}, tw);
    if (shape == "TEE") drawn = i_shape(t3, {0.0, t2}, {0.0, tf}, tw);
    if (shape == "ANGLE") drawn = angle(t2, t3, tf, tw);
    const ProfileSection profile = profile_section(drawn, deck_.model.materials[fe::slot(material(row))].poisson_ratio);
    if (!profile.possible)
      row.fail(fmt::format("has no Area, and its Shape {} is not read or its dimensions do not fit", row.get("Shape")),
               "export Area, TorsConst, I33, I22, AS2 and AS3 too");
    if (profile.beside) deck_.note_once(note_beside(row.get("SectionName")));
    return upright(profile);
  }

  /// The section of a frame with the factors of the section and of the frame.
  int frame_section(const SapRow& row, const std::string& frame) {
    static const SapRow none{};
    const auto& modified = tables_.rows("FRAME PROPERTY MODIFIERS");
    const auto found = std::ranges::find_if(modified, [&](const SapRow& of) { return of.get("Frame") == frame; });
    const SapRow& own = found == modified.end() ? none : *found;
    const auto factor = [&](const char* of_section, const char* of_frame) {
      return row.number_of(of_section, 1.0) * own.number_of(of_frame, 1.0);
    };
    refuse_factors(row, {"AMod", "MMod"});
    refuse_factors(own, {"AMod", "MassMod"});
    fe::Section s;
    if (row.has("Shape") && !row.has("Area")) {
      s = drawn_section(row);
    } else {
      s.area_m2 = row.number_of("Area");
      s.inertia_z_m4 = row.number_of("I33");
      s.inertia_y_m4 = row.number_of("I22");
      s.inertia_yz_m4 = row.number_of("I23", 0.0);
      s.torsion_m4 = row.number_of("TorsConst");
      s.shear_area_y_m2 = row.number_of("AS2", 0.0);
      s.shear_area_z_m2 = row.number_of("AS3", 0.0);
    }
    const double about_3 = factor("I3Mod", "I33Mod"), about_2 = factor("I2Mod", "I22Mod");
    s.name = row.get("SectionName");
    s.inertia_z_m4 *= about_3;
    s.inertia_y_m4 *= about_2;
    s.inertia_yz_m4 *= std::sqrt(std::max(0.0, about_3 * about_2));
    s.torsion_m4 *= factor("JMod", "JMod");
    s.shear_area_y_m2 *= factor("A2Mod", "AS2Mod");
    s.shear_area_z_m2 *= factor("A3Mod", "AS3Mod");
    if (!(std::min({s.area_m2, s.inertia_z_m4, s.inertia_y_m4, s.torsion_m4}) > 0.0))
      row.fail("Area, I33, I22 or TorsConst is not above 0", "complete the section; a nonprismatic one is not read");
    return deck_.add_section(s);
  }

  fe::Element element(const SapRow& row, const std::string& kind, fe::ElementType type, const SapRow& section) {
    fe::Element e;
    e.id = number_of_name(row.required(kind), deck_.last_element);
    while (!element_ids_.insert(e.id).second) e.id = ++deck_.last_element;  // frames and areas are counted apart
    e.type = type;
    e.material = material(section);
    e.group = section.get(kind == "Frame" ? "SectionName" : "Section");
    return e;
  }

  std::uint16_t releases(const std::string& frame) const {
    unsigned bits = 0;
    for (const SapRow& row : tables_.rows("FRAME RELEASE ASSIGNMENTS 1 - GENERAL")) {
      if (row.get("Frame") != frame) continue;
      if (row.yes("PartialFix")) row.fail("has a partial fixity, which is not read", "release it, or do not");
      static const std::array<std::string, 6> forces = {"P", "V2", "V3", "T", "M2", "M3"};
      for (std::size_t i = 0; i < 12; ++i)
        if (row.yes(forces[i % 6] + (i < 6 ? "I" : "J"))) bits |= 1U << i;
    }
    return static_cast<std::uint16_t>(bits);
  }

  /// Whether SAP2000 divides a frame at the joints that lie on it, as it does unless it is told otherwise.
  [[nodiscard]] bool is_divided(const std::string& frame) const {
    return std::ranges::none_of(tables_.rows("FRAME AUTO MESH ASSIGNMENTS"), [&](const SapRow& row) {
      return row.get("Frame") == frame &&
             (upper_case(row.get("AutoMesh", "Yes")) == "NO" || upper_case(row.get("AtJoints", "Yes")) == "NO");
    });
  }

  /// Joints between the ends of a line, in their order along it.
  [[nodiscard]] std::vector<int> joints_between(int from, int to) const {
    constexpr double beside = 1e-4;  // [-] of the length: 1 mm of 10 m, SAP2000's own tolerance
    const Eigen::Vector3d a = deck_.place(from), along = deck_.place(to) - a;
    std::vector<std::pair<double, int>> found;
    for (const auto& [name, node] : joints_) {
      const Eigen::Vector3d x = deck_.place(node) - a;
      const double share = x.dot(along) / along.squaredNorm();
      if (share > beside && share < 1.0 - beside && (x - share * along).norm() <= beside * along.norm())
        found.emplace_back(share, node);
    }
    std::ranges::sort(found);
    return each_of(found, [](const auto& joint) { return joint.second; });
  }

  void read_frames() {
    constexpr std::uint16_t bending = 0b110000'110000;  // M2 and M3 of both ends: a bar
    for (const SapRow& row : tables_.rows("CONNECTIVITY - FRAME")) {
      if (row.yes("IsCurved")) row.fail("is curved, which is not read", "divide it into straight frames");
      const std::string frame = row.required("Frame");
      const SapRow& assigned = row_of(row, "FRAME SECTION ASSIGNMENTS", "Frame", frame);
      if (upper_case(assigned.get("MatProp", "Default")) != "DEFAULT")
        assigned.fail("overwrites the material of its section, which is not read", "give it a section of that material");
      const SapRow& section =
          row_of(assigned, "FRAME SECTION PROPERTIES 01 - GENERAL", "SectionName", assigned.required("AnalSect"));
      fe::Element e = element(row, "Frame", fe::ElementType::beam, section);
      e.section = frame_section(section, frame);
      e.nodes = {joint(row, "JointI"), joint(row, "JointJ")};
      e.releases = releases(frame);
      if ((e.releases & bending) == bending) {
        e.releases = 0;
        e.type = fe::ElementType::bar;
        deck_.add_element(e);
        continue;
      }
      const std::vector<int> between = is_divided(frame) ? joints_between(e.nodes[0], e.nodes[1]) : std::vector<int>{};
      e.nodes.insert(e.nodes.begin() + 1, between.begin(), between.end());
      const std::uint16_t at_ends = std::exchange(e.releases, 0);
      const std::size_t first = deck_.model.elements.size();
      deck_.add_beam(e, [&](fe::Element& piece, const Eigen::Vector3d& axis) { turn_frame(row, frame, piece, axis); });
      deck_.model.elements[first].releases = at_ends & 0b111111U;
      deck_.model.elements.back().releases =
          static_cast<std::uint16_t>(deck_.model.elements.back().releases | (at_ends & 0b111111'000000U));
    }
  }

  /// Local 2 of a frame lies in the vertical plane through it, of a vertical one along global X, and is turned by the angle.
  void turn_frame(const SapRow& row, const std::string& frame, fe::Element& piece, const Eigen::Vector3d& axis) const {
    constexpr double upright = 1e-3;  // [-] sine of the angle to global Z below which a frame is vertical
    const bool vertical = axis.head<2>().norm() <= upright * axis.norm();
    piece.orientation =
        DeckModel::local_z(row, "the frame", axis, vertical ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ(),
                           "give its two joints places apart");
    for (const SapRow& turned : tables_.rows("FRAME LOCAL AXES ASSIGNMENTS 1 - TYPICAL")) {
      if (turned.get("Frame") != frame) continue;
      if (turned.yes("AdvanceAxes")) turned.fail("has advanced axes, which are not read", "give the angle");
      piece.orientation =
          Eigen::AngleAxisd(turned.number_of("Angle", 0.0) * std::numbers::pi / 180.0, axis.normalized()) * piece.orientation;
    }
  }

  void read_areas() {
    for (const SapRow& row : tables_.rows("CONNECTIVITY - AREA")) {
      const SapRow& assigned = row_of(row, "AREA SECTION ASSIGNMENTS", "Area", row.required("Area"));
      const SapRow& section = row_of(assigned, "AREA SECTION PROPERTIES", "Section", assigned.required("Section"));
      const std::string type = upper_case(section.get("Type", "Shell-Thin"));
      if (!type.starts_with("SHELL-TH") && !type.starts_with("SHELLTH"))
        section.fail(fmt::format("is of type {}, of which Shell-Thin and Shell-Thick are read", section.get("Type")),
                     "make it a shell");
      refuse_factors(section, {"F11Mod", "F22Mod", "F12Mod", "V13Mod", "V23Mod", "MMod"});
      const double bending = section.number_of("M11Mod", 1.0);
      if (section.number_of("M22Mod", 1.0) != bending || section.number_of("M12Mod", 1.0) != bending || !(bending > 0.0))
        section.fail("M11Mod, M22Mod and M12Mod are not one number above 0", "give one factor of bending");
      fe::Section s{.name = section.get("Section"), .thickness_m = section.number_of("Thickness")};
      if (!(s.thickness_m > 0.0)) section.fail("the thickness is not above 0", "give it");
      if (type.ends_with("THICK")) s.shear_thickness_ratio = fe::homogeneous_shear_ratio;
      s.bending_inertia_ratio = bending * std::pow(section.number_of("BendThick", s.thickness_m) / s.thickness_m, 3);
      fe::Element e = element(row, "Area", fe::ElementType::shell, section);
      e.section = deck_.add_section(s);
      for (int i = 1; i <= 4 && row.has(fmt::format("Joint{}", i)); ++i)
        e.nodes.push_back(joint(row, fmt::format("Joint{}", i)));
      if (e.nodes.size() < 3 || row.has("Joint5")) row.fail("is no area of three or four joints", "divide it");
      const auto& edges = tables_.rows("AREA EDGE CONSTRAINT ASSIGNMENTS");
      if (std::ranges::any_of(edges,
                              [&](const SapRow& of) { return of.get("Area") == row.get("Area") && of.yes("EdgeConst"); }))
        for (std::size_t i = 0; i < e.nodes.size(); ++i)
          if (!joints_between(e.nodes[i], e.nodes[(i + 1) % e.nodes.size()]).empty())
            row.fail("has an edge constraint and a joint on its edge, which is not read", "divide the area at that joint");
      deck_.add_element(e);
    }
  }

  void read_attachments() {
    for (const SapRow& row : tables_.rows("JOINT RESTRAINT ASSIGNMENTS")) {
      Directions fixed{};
      for (std::size_t d = 0; d < 6; ++d) fixed[d] = row.yes(joint_directions[d]);
      deck_.hold("joint_" + row.get("Joint"), joint(row, "Joint"), fixed);
    }
    for (const SapRow& row : tables_.rows("JOINT SPRING ASSIGNMENTS 1 - UNCOUPLED"))
      for (int d = 0; d < 6; ++d) {
        const std::string &key = joint_directions[fe::slot(d)], group = "joint_" + row.get("Joint");
        const double stiffness = row.number_of(key, 0.0);
        if (stiffness < 0.0) row.fail(key + " is negative", "check the sign");
        if (stiffness > 0.0)
          deck_.add_spring(group + "_" + lower_case(key), group, joint(row, "Joint"), -1, d, Eigen::Matrix3d::Identity(),
                           stiffness);
      }
    for (const SapRow& row : tables_.rows("JOINT ADDED MASS ASSIGNMENTS")) read_mass(row);
    group_equal_masses(deck_.model.masses);
  }

  /// A point mass, or a matrix where the three masses differ.
  void read_mass(const SapRow& row) {
    const auto vector = [&](const char* key) {
      return Eigen::Vector3d(row.number_of(fmt::format("{}1", key), 0.0), row.number_of(fmt::format("{}2", key), 0.0),
                             row.number_of(fmt::format("{}3", key), 0.0));
    };
    const Eigen::Vector3d mass = vector("Mass"), inertia = vector("MMI");
    if (mass.minCoeff() < 0.0 || inertia.minCoeff() < 0.0) row.fail("a mass is negative", "check the sign");
    const std::string group = "joint_" + row.get("Joint");
    const int node = joint(row, "Joint");
    if (mass[0] == mass[1] && mass[0] == mass[2]) return deck_.model.masses.push_back({group, node, mass[0], inertia});
    fe::MatrixElement element;
    element.name = element.group = group + "_mass";
    Eigen::Matrix<double, 6, 1> diagonal;
    diagonal << mass, inertia;
    std::vector<int> heavy;  // a direction without mass needs nothing that holds it
    for (int d = 0; d < 6; ++d)
      if (diagonal[d] > 0.0) heavy.push_back(d), element.dofs.push_back({node, d});
    element.mass = diagonal(heavy).asDiagonal();
    deck_.model.matrix_elements.push_back(element);
  }

  /// Directions that the analysis leaves out are held at every joint.
  void hold_inactive() {
    for (const SapRow& row : tables_.rows("ACTIVE DEGREES OF FREEDOM")) {
      Directions inactive{};
      for (std::size_t d = 0; d < 6; ++d) inactive[d] = upper_case(row.get(global_directions[d], "Yes")) == "NO";
      if (inactive == Directions{}) continue;
      for (const auto& [name, node] : joints_) deck_.hold("inactive", node, inactive);
    }
  }

  void read_constraints() {
    std::map<long, SapConstraint> by_line;
    for (const SapRow& row : tables_.rows("JOINT CONSTRAINT ASSIGNMENTS")) {
      const std::string type = upper_case(row.required("Type"));
      if (type != "BODY" && type != "DIAPHRAGM")
        row.fail(fmt::format("is of Type {}, of which Body and Diaphragm are read", row.get("Type")), "say it by one of these");
      const SapRow& of = row_of(row, "CONSTRAINT DEFINITIONS - " + type, "Name", row.required("Constraint"));
      for (const std::string& key : global_directions)
        if (type == "BODY" && !of.yes(key))
          of.fail(fmt::format("does not tie {}, and a body is read that is rigid in all directions", key), "set it to Yes");
      if (type == "DIAPHRAGM" && upper_case(of.get("CoordSys", "GLOBAL")) != "GLOBAL")
        of.fail("is given in other axes than the global ones", "write CoordSys=GLOBAL");
      SapConstraint& constraint = by_line[of.line];
      constraint.at = of;
      constraint.name = lower_case(type) + "_" + of.get("Name");
      constraint.axis = type == "BODY" ? "" : upper_case(of.get("Axis", "Z"));
      constraint.by_level = of.yes("MultiLevel");
      if (const int node = joint(row, "Joint"); !contains(constraint.joints, node)) constraint.joints.push_back(node);
    }
    for (const auto& [line, constraint] : by_line) tie_joints(deck_, constraint);
  }

  SapTables tables_;
  DeckModel deck_;
  std::map<std::string, int> joints_, materials_;
  std::set<long> element_ids_;
};

}  // namespace

bool is_sap2000_file(const std::filesystem::path& file) {
  const std::string ending = upper_case(file.extension().string());
  return ending == ".S2K" || ending == ".$2K";
}

ImportedModel read_sap2000(const std::filesystem::path& path) { return SapReader(path).read(path); }

}  // namespace twindeck::model_io
