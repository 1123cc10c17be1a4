#include "model_io/ansys_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "model_io/ansys_stage.hpp"
#include "model_io/profiles.hpp"

/// Sections and real constants as cross-sections. ANSYS's element axes are ours: y and z across the beam, IYY = ∫ z² dA is
/// inertia_y, the first dimension of a rectangle lies along y.
namespace twindeck::model_io::ansys {
namespace {

/// The section of an element if it is of `type` ("BEAM", "SHELL", "LINK"); null if there is none.
const SectionDefinition* section_of(const Builder& builder, const Member& member, const std::string& type) {
  const auto found = builder.parts.sections.find(member.element.section);
  const bool fits = found != builder.parts.sections.end() && found->second.type.starts_with(type.substr(0, 4));
  return fits ? &found->second : nullptr;
}

std::string section_name(const Member& member, const SectionDefinition& section) {
  return section.name.empty() ? fmt::format("section_{}", member.element.section) : section.name;
}

[[noreturn]] void refuse_section(const Builder& builder, const Member& member, const SectionDefinition& section,
                                 const std::string& problem, const std::string& mend) {
  builder.parts.at(section.line, "SECTYPE").fail(fmt::format("section {} {}", member.element.section, problem), mend);
}

/// Constant `i` has to be 0 or blank.
void require_zero(const Builder& builder, const Member& member, const RealSet& set, std::size_t i, const char* what,
                  const char* mend) {
  if (set.at(i) == 0.0) return;
  builder.parts.at(set.line, "R")
      .fail(fmt::format("constant {} of set {} is {:g}: {} is not supported", i, member.element.real, set.at(i), what), mend);
}

double positive(const Builder& builder, const Member& member, const RealSet& set, std::size_t i, const char* what) {
  if (set.at(i) > 0.0) return set.at(i);
  builder.parts.at(set.line, "R")
      .fail(fmt::format("constant {} of set {} ({} of {}) is {:g}, expected a value above 0", i, member.element.real, what,
                        member.type().name, set.at(i)),
            "complete the set");
}

constexpr const char* give_density = "give the mass by the density or by MASS21";

/// BEAM3: A, IZZ, height, SHEARZ, strain, added mass. What lies out of the plane is held and any number will do.
fe::Section plane_beam(const Builder& builder, const Member& member, double& strain) {
  const RealSet& r = builder.reals(member);
  fe::Section s;
  s.area_m2 = positive(builder, member, r, 1, "area");
  s.inertia_z_m4 = s.inertia_y_m4 = s.torsion_m4 = positive(builder, member, r, 2, "IZZ");
  if (r.at(4) > 0.0) s.shear_area_y_m2 = s.area_m2 / r.at(4);
  strain = initial_strain(builder, member, r, 5);
  require_zero(builder, member, r, 6, "added mass", give_density);
  return s;
}

/// BEAM4: A, IZZ, IYY, thicknesses, angle, strain, IXX, SHEARZ (of bending by IZZ), SHEARY, spin, added mass.
CrossSection space_beam(const Builder& builder, const Member& member) {
  const RealSet& r = builder.reals(member);
  CrossSection cross;
  fe::Section& s = cross.section;
  s.area_m2 = positive(builder, member, r, 1, "area");
  s.inertia_z_m4 = positive(builder, member, r, 2, "IZZ");
  s.inertia_y_m4 = positive(builder, member, r, 3, "IYY");
  cross.turn_rad = r.at(6) * std::numbers::pi / 180.0;
  cross.initial_strain = initial_strain(builder, member, r, 7);
  s.torsion_m4 = r.at(8) > 0.0 ? r.at(8) : s.inertia_y_m4 + s.inertia_z_m4;
  if (r.at(9) > 0.0) s.shear_area_y_m2 = s.area_m2 / r.at(9);
  if (r.at(10) > 0.0) s.shear_area_z_m2 = s.area_m2 / r.at(10);
  require_zero(builder, member, r, 11, "spin", "leave it 0: gyroscopic effects are not modelled");
  require_zero(builder, member, r, 12, "added mass", give_density);
  return cross;
}

/// PIPE16: outer diameter, wall, then stress factors; what adds mass (insulation, fluid) is refused.
fe::Section pipe_of_reals(const Builder& builder, const Member& member, double poisson_ratio) {
  const RealSet& r = builder.reals(member);
  for (std::size_t i = 5; i <= 10; ++i)
    require_zero(builder, member, r, i, "a fluid, an insulation or a corrosion allowance", give_density);
  const double radius = positive(builder, member, r, 1, "outer diameter") / 2.0;
  const ProfileSection s = profile_section(circle(radius, radius - positive(builder, member, r, 2, "wall")), poisson_ratio);
  if (!s.possible)
    builder.parts.at(r.line, "R").fail("is wrong: the wall is thicker than the radius", "give the outer diameter and the wall");
  return s.section;
}

/// SECDATA of a pipe: outer diameter, wall, cells around, stress stiffness, cells across; then insulation and its material.
void refuse_filled_pipe(const Builder& builder, const Member& member, const SectionDefinition& section,
                        const std::vector<double>& values) {
  for (std::size_t i = 5; i < values.size(); ++i)
    if (values[i] != 0.0)
      refuse_section(builder, member, section, "has an insulation or another temperature model, which is not supported",
                     give_density);
}

/// ASEC: A, Iyy, Iyz, Izz, Iw, J, centroid y z, shear centre y z, thicknesses, shear corrections xz xy (1 if blank).
fe::Section general_section(const Builder& builder, const Member& member, const SectionDefinition& section,
                            const std::vector<double>& values) {
  const auto at = [&](std::size_t i) { return i < values.size() ? values[i] : 0.0; };
  if (at(0) <= 0.0 || at(1) <= 0.0 || at(3) <= 0.0 || at(5) <= 0.0)
    refuse_section(builder, member, section, "has an area or a moment of area that is not above 0",
                   "give SECDATA,A,Iyy,Iyz,Izz,Iw,J");
  constexpr double beside = 1e-6;  // of the shear centre, in parts of the section's size
  if (std::hypot(at(8) - at(6), at(9) - at(7)) > beside * std::sqrt(at(0)))
    refuse_section(builder, member, section, "has a shear centre beside its centroid, which is not supported",
                   "put both at one place, or model the section by shells");
  fe::Section s{.name = {}, .area_m2 = at(0), .inertia_y_m4 = at(1), .inertia_yz_m4 = at(2)};
  s.inertia_z_m4 = at(3);
  s.torsion_m4 = at(5);
  s.shear_area_z_m2 = s.area_m2 * (at(12) > 0.0 ? at(12) : 1.0);
  s.shear_area_y_m2 = s.area_m2 * (at(13) > 0.0 ? at(13) : 1.0);
  return s;
}

/// A shape of SECTYPE,,BEAM from its SECDATA, twelve values and more.
std::optional<Shape> draw(const std::string& subtype, const std::vector<double>& d) {
  if (subtype == "RECT") return rectangles({{0.0, 0.0, d[0], d[1]}});
  if (subtype == "CSOLID") return circle(d[0]);
  if (subtype == "CTUBE") return circle(d[1], d[0]);
  // lower and upper flange, depth, their thicknesses, web
  if (subtype == "I") return i_shape(d[2], {d[0], d[1]}, {d[3], d[4]}, d[5]);
  if (subtype == "CHAN" || subtype == "Z") return channel(d[2], {d[0], d[1]}, {d[3], d[4]}, d[5], subtype == "Z");
  if (subtype == "L") return angle(d[0], d[1], d[2], d[3]);
  if (subtype == "T") return i_shape(d[1], {d[0], 0.0}, {d[2], 0.0}, d[3]);
  if (subtype == "HATS") return hat(d[3], d[2], {d[0], d[1]}, {d[4], d[5], d[6], d[7], d[8]});
  if (subtype == "HREC") return box(d[0], d[1], {d[3], d[5], d[2], d[4]});  // walls left, right, lower, upper
  if (subtype != "QUAD") return std::nullopt;
  Shape shape;
  for (std::size_t i = 0; i < 8; i += 2) shape.outline.emplace_back(d[i], d[i + 1]);
  return shape;
}

/// Where the node lies in the section, from the centroid.
Eigen::Vector2d node_place(const Builder& builder, const Member& member, const SectionDefinition& section,
                           const ProfileSection& profile) {
  const std::string &where = section.offset, &shape = section.subtype;
  if (where.empty() || where == "CENT" || (where == "SHRC" && !profile.beside)) return {0.0, 0.0};
  const bool centred = shape == "RECT" || shape == "CSOLID" || shape == "CTUBE";
  if ((!centred && shape != "QUAD") || (where != "USER" && where != "ORIG"))
    refuse_section(builder, member, section, fmt::format("is offset by '{}', which is not supported for this shape", where),
                   "use CENT, and rigid links for the eccentricity");
  const Eigen::Vector2d origin = centred ? Eigen::Vector2d(0.0, 0.0) : profile.centroid;
  return (where == "USER" ? Eigen::Vector2d(section.offset_m[0], section.offset_m[1]) : Eigen::Vector2d(0.0, 0.0)) - origin;
}

}  // namespace

CrossSection beam_section(Builder& builder, const Member& member, double poisson_ratio) {
  CrossSection cross;
  const bool plane = member.type().kind == Kind::plane_beam, space = member.is("BEAM4"), old_pipe = member.is("PIPE16");
  if (plane) cross.section = plane_beam(builder, member, cross.initial_strain);
  if (space) cross = space_beam(builder, member);
  if (old_pipe) cross.section = pipe_of_reals(builder, member, poisson_ratio);
  if (plane || space || old_pipe) {
    cross.section.name = fmt::format("real_{}", member.element.real);
    return cross;
  }
  const bool pipe = member.is("PIPE288") || member.is("PIPE289");
  const SectionDefinition* section = section_of(builder, member, pipe ? "PIPE" : "BEAM");
  if (const auto any = builder.parts.sections.find(member.element.section); section == nullptr)
    builder.fail(
        member,
        fmt::format("its section {} is {}, which is no section of a beam that is read", member.element.section,
                    any == builder.parts.sections.end() ? "not defined" : "of type " + any->second.type),
        pipe ? "give SECTYPE,number,PIPE and SECDATA,outer diameter,wall" : "give SECTYPE,number,BEAM,shape and SECDATA");
  std::vector<double> values;
  for (const auto& row : section->data) values.insert(values.end(), row.begin(), row.end());
  ProfileSection profile;
  if (section->subtype == "ASEC") {
    profile.section = general_section(builder, member, *section, values);
  } else {
    if (pipe) refuse_filled_pipe(builder, member, *section, values);
    values.resize(std::max<std::size_t>(values.size(), 12));
    const std::optional<Shape> shape =
        pipe ? circle(values.at(0) / 2.0, values.at(0) / 2.0 - values.at(1)) : draw(section->subtype, values);
    if (!shape)
      refuse_section(builder, member, *section, fmt::format("is a '{}' that is not supported", section->subtype),
                     "supported are RECT, QUAD, CSOLID, CTUBE, CHAN, I, Z, L, T, HATS, HREC and ASEC, which any section can "
                     "be given as");
    profile = profile_section(*shape, poisson_ratio);
    if (!profile.possible)
      refuse_section(builder, member, *section, "is wrong: a dimension is not above 0, or the dimensions do not fit together",
                     "check its SECDATA");
    if (profile.beside) builder.parts.note_once(note_beside(section_name(member, *section)));
  }
  cross.section = profile.section;
  cross.node = node_place(builder, member, *section, profile);
  cross.section.name = section_name(member, *section);
  return cross;
}

CrossSection bar_section(Builder& builder, const Member& member) {
  CrossSection cross;
  const SectionDefinition* section = member.is("LINK180") ? section_of(builder, member, "LINK") : nullptr;
  if (section != nullptr) {
    if (section->data.empty() || section->data[0].empty() || section->data[0][0] <= 0.0)
      refuse_section(builder, member, *section, "has no area above 0", "give SECDATA,area");
    cross.section.area_m2 = section->data[0][0];
    cross.section.name = section_name(member, *section);
    return cross;
  }
  const RealSet& r = builder.reals(member);
  cross.section.area_m2 = positive(builder, member, r, 1, "area");
  cross.section.name = fmt::format("real_{}", member.element.real);
  if (member.is("LINK180")) {
    require_zero(builder, member, r, 2, "added mass", give_density);
    if (r.at(3) != 0.0) builder.parts.note_once("LINK180 of tension or compression only is read as a bar that takes both");
  } else {
    cross.initial_strain = initial_strain(builder, member, r, 2);
    if (member.is("LINK10")) builder.parts.note_once("LINK10 is read as a bar that takes tension and compression");
  }
  return cross;
}

CrossSection shell_section(Builder& builder, const Member& member) {
  CrossSection cross;
  if (!member.is("SHELL63")) cross.section.shear_thickness_ratio = fe::homogeneous_shear_ratio;
  const SectionDefinition* section =
      member.is("SHELL181") || member.is("SHELL281") ? section_of(builder, member, "SHELL") : nullptr;
  if (section != nullptr) {
    if (section->data.size() != 1 || section->data[0].empty() || section->data[0][0] <= 0.0)
      refuse_section(builder, member, *section,
                     fmt::format("has {} layers, expected one of a thickness above 0", section->data.size()),
                     "give one SECDATA,thickness,material");
    const bool shifted =
        section->offset == "TOP" || section->offset == "BOT" || (section->offset == "USER" && section->offset_m[0] != 0.0);
    if (shifted)
      refuse_section(builder, member, *section, "is offset from its nodes, which is not supported",
                     "put the nodes into the middle surface (SECOFFSET,MID), or use rigid links");
    constexpr double largest_number = 1e9;  // of a material
    const double material = section->data[0].size() > 1 ? section->data[0][1] : 0.0;
    if (!(material >= 0.0 && material <= largest_number))
      refuse_section(builder, member, *section, fmt::format("names material {:g}", material),
                     "give the number of an MP command");
    cross.section.thickness_m = section->data[0][0];
    cross.material = static_cast<long>(material);
    cross.section.name = section_name(member, *section);
    return cross;
  }
  const RealSet& r = builder.reals(member);
  cross.section.thickness_m = positive(builder, member, r, 1, "thickness");
  for (std::size_t i = 2; i <= 4; ++i)
    if (r.at(i) != 0.0 && r.at(i) != r.at(1))
      require_zero(builder, member, r, i, "a thickness that varies over an element", "give each element one thickness");
  if (member.is("SHELL63")) {
    require_zero(builder, member, r, 5, "an elastic foundation", "use COMBIN14 below the nodes");
    if (r.at(7) > 0.0) cross.section.bending_inertia_ratio = r.at(7);
  }
  require_zero(builder, member, r, member.is("SHELL63") ? 18 : 6, "added mass", give_density);
  cross.section.name = fmt::format("real_{}", member.element.real);
  return cross;
}

}  // namespace twindeck::model_io::ansys
