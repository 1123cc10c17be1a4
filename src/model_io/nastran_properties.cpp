#include "model_io/nastran_properties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "core/lists.hpp"
#include "model_io/profiles.hpp"

/// Sections of CBAR and CBEAM. Nastran's element axes are ours: plane 1 is x-y, so that I1 is our inertia_z, I2 our inertia_y,
/// K1 belongs to shear along y, K2 along z.
namespace twindeck::model_io::nastran {
namespace {

/// Area, I1, I2, I12, J, mass per length that is not structural: a station of PBEAM.
using Station = std::array<double, 6>;

fe::Section to_section(const std::string& name, const Station& s, double k1, double k2) {
  return {.name = name,
          .area_m2 = s[0],
          .inertia_y_m4 = s[2],
          .inertia_z_m4 = s[1],
          .inertia_yz_m4 = s[3],
          .torsion_m4 = s[4],
          .shear_area_y_m2 = k1 * s[0],
          .shear_area_z_m2 = k2 * s[0]};
}

void check_station(const Card& card, const Station& s) {
  const std::array<const char*, 5> names = {"the area", "I1", "I2", "", "J"};
  for (const std::size_t i : {0U, 1U, 2U, 4U})
    if (!(s[i] > 0.0))
      card.fail(fmt::format("{} is {:g}, expected a value above 0", names[i], s[i]),
                i == 0 ? "give the area" : "a member without it is held by AUTOSPC there; give a small value, or use CROD");
  if (s[5] < 0.0) card.fail("the nonstructural mass is negative", "check the sign");
}

void refuse_values(const Card& card, std::size_t first, std::size_t count, const char* what) {
  for (std::size_t i = first; i < first + count; ++i)
    if (card.number_or(i, 0.0) != 0.0)
      card.fail(fmt::format("has {}, which is not read", what), "write the section without it");
}

/// A hat on a plate of the width d0: height d1, top d2, thicknesses of hat and plate d3, d4.
Shape closed_hat(const double* d) {
  const double a = d[2] / 2.0, w = d[2] - d[3], h = d[1] - (d[3] + d[4]) / 2.0, brim = d[3] + d[4], under = d[1] - d[3];
  Shape shape = rectangles({{-d[0] / 2.0, 0.0, d[0] / 2.0, d[4]},
                            {-d[0] / 2.0, d[4], d[3] - a, brim},
                            {a - d[3], d[4], d[0] / 2.0, brim},
                            {-a, brim, d[3] - a, under},
                            {a - d[3], brim, a, under},
                            {-a, under, a, d[1]}});
  shape.fits = shape.fits && d[2] > 2.0 * d[3] && d[0] >= d[2] && under > brim;
  shape.closed_torsion = bredt(w * h, (w + 2.0 * h) / d[3] + w / d[4]);
  return shape;
}

/// Width and height, place of the middle wall, walls left, middle, right, then top and bottom of the left and right cell.
Shape two_cells(const double* d) {
  const double middle = d[2] - d[4] / 2.0, beyond = d[2] + d[4] / 2.0;
  Shape shape = rectangles({{0.0, 0.0, d[3], d[1]},
                            {middle, 0.0, beyond, d[1]},
                            {d[0] - d[5], 0.0, d[0], d[1]},
                            {d[3], d[1] - d[6], middle, d[1]},
                            {d[3], 0.0, middle, d[7]},
                            {beyond, d[1] - d[8], d[0] - d[5], d[1]},
                            {beyond, 0.0, d[0] - d[5], d[9]}});
  shape.fits = shape.fits && shape.walls.size() == 7 && d[6] + d[7] < d[1] && d[8] + d[9] < d[1];
  const double w = d[2] - d[3] / 2.0, w2 = d[0] - d[2] - d[5] / 2.0, h = d[1] - (d[6] + d[7]) / 2.0,
               h2 = d[1] - (d[8] + d[9]) / 2.0, common = (h + h2) / 2.0 / d[4];
  shape.closed_torsion =
      bredt(w * h, w / d[6] + w / d[7] + h / d[3] + common, w2 * h2, w2 / d[8] + w2 / d[9] + h2 / d[5] + common, common);
  return shape;
}

Shape cross(const double* d) {
  const double arm = (d[0] + d[1]) / 2.0;
  return rectangles({{-d[1] / 2.0, -d[2] / 2.0, d[1] / 2.0, d[2] / 2.0},
                     {-arm, -d[3] / 2.0, -d[1] / 2.0, d[3] / 2.0},
                     {d[1] / 2.0, -d[3] / 2.0, arm, d[3] / 2.0}});
}

Shape hexagon(const double* d) {
  Shape shape;
  const double a = d[1] / 2.0, b = a - d[0], v = d[2] / 2.0;
  shape.outline = {{-a, 0.0}, {-b, -v}, {b, -v}, {a, 0.0}, {b, v}, {-b, v}};
  shape.fits = d[0] > 0.0 && b >= 0.0 && v > 0.0;
  return shape;
}

/// The shapes of PBARL and PBEAML and their numbers of dimensions.
const std::map<std::string, std::size_t>& library() {
  static const std::map<std::string, std::size_t> known = {
      {"ROD", 1}, {"TUBE", 2},  {"TUBE2", 2}, {"BAR", 2}, {"BOX", 4},  {"BOX1", 6},  {"I", 6},     {"I1", 4},
      {"H", 4},   {"T", 4},     {"T1", 4},    {"T2", 4},  {"CHAN", 4}, {"CHAN1", 4}, {"CHAN2", 4}, {"Z", 4},
      {"L", 4},   {"CROSS", 4}, {"HEXA", 3},  {"HAT", 4}, {"HAT1", 5}, {"DBOX", 10}};
  return known;
}

Shape draw(const std::string& type, const double* d) {
  // I1, CHAN1 and Z: outstanding flanges, web, clear height, height.
  const double flange = d[0] + d[1], half = (d[3] - d[2]) / 2.0;
  if (type == "ROD") return circle(d[0]);
  if (type == "TUBE") return circle(d[0], d[1]);
  if (type == "TUBE2") return circle(d[0], d[0] - d[1]);
  if (type == "BAR") return rectangles({{0.0, 0.0, d[0], d[1]}});
  if (type == "BOX") return box(d[0], d[1], {d[3], d[2], d[3], d[2]});
  if (type == "BOX1") return box(d[0], d[1], {d[5], d[2], d[4], d[3]});
  if (type == "I") return i_shape(d[0], {d[1], d[2]}, {d[4], d[5]}, d[3]);
  if (type == "I1") return i_shape(d[3], {flange, flange}, {half, half}, d[1]);
  if (type == "H") return turned(i_shape(flange, {d[2], d[2]}, {d[1] / 2.0, d[1] / 2.0}, d[3]));
  if (type == "T") return i_shape(d[1], {0.0, d[0]}, {0.0, d[2]}, d[3]);
  if (type == "T1") return turned(i_shape(d[1] + d[2], {0.0, d[0]}, {0.0, d[2]}, d[3]));
  if (type == "T2") return i_shape(d[1], {d[0], 0.0}, {d[2], 0.0}, d[3]);
  if (type == "CHAN") return channel(d[1], {d[0], d[0]}, {d[3], d[3]}, d[2]);
  if (type == "CHAN2") return turned(channel(d[3], {d[2], d[2]}, {d[0], d[0]}, d[1]));
  if (type == "CHAN1" || type == "Z") return channel(d[3], {flange, flange}, {half, half}, d[1], type == "Z");
  if (type == "L") return angle(d[0], d[1], d[2], d[3]);
  if (type == "CROSS") return cross(d);
  if (type == "HEXA") return hexagon(d);
  if (type == "HAT") return hat(d[0], d[2], {d[3] + d[1], d[3] + d[1]}, {d[1], d[1], d[1], d[1], d[1]});
  return type == "HAT1" ? closed_hat(d) : two_cells(d);
}

fe::Section library_section(Parts& parts, const Card& card, const std::string& type, std::vector<double> dimensions,
                            const std::string& name, double poisson_ratio) {
  dimensions.resize(10);
  const ProfileSection profile = profile_section(draw(type, dimensions.data()), poisson_ratio);
  if (!profile.possible)
    card.fail("a dimension is not above 0, or the dimensions do not fit together", "check the dimensions of the " + type);
  if (profile.beside) parts.note_once(note_beside(name));
  fe::Section s = upright(profile);
  s.name = name;
  return s;
}

/// Type and number of dimensions of PBARL, PBEAML.
std::pair<std::string, std::size_t> profile_of(const Card& card) {
  const std::string type = card.word(3);
  const auto found = library().find(type);
  if (found == library().end()) {
    const auto names = each_of(library(), [](const auto& known) { return known.first; });
    card.fail(fmt::format("section '{}' is not read, expected {}", type, fmt::join(names, ", ")),
              card.name == "PBARL" ? "give its A, I1, I2, J on a PBAR" : "give its A, I1, I2, J on a PBEAM");
  }
  return *found;
}

std::vector<double> numbers(const Card& card, std::size_t first, std::size_t count) {
  std::vector<double> values;
  for (std::size_t i = first; i < first + count; ++i) values.push_back(card.number(i));
  return values;
}

double poisson_ratio_of(Parts& parts, const Card& card) {
  return parts.model.materials[static_cast<std::size_t>(parts.material(card, card.integer(1)))].poisson_ratio;
}

/// Station at the fields from `i` on; blank ones as in `above`, which is end A.
Station station_at(const Card& card, std::size_t i, const Station& above) {
  Station s{};
  for (std::size_t k = 0; k < 6; ++k) s[k] = card.number_or(i + k, above[k]);
  return s;
}

bool is_output_word(const std::string& field) {
  const std::string word = upper_case(field);
  return word == "YES" || word == "YESA" || word == "NO";
}

MemberProperty member(Parts& parts, const Card& card, const fe::Section& a, const std::optional<fe::Section>& b, double nsm) {
  MemberProperty p;
  p.section = parts.add_section(a);
  if (b) p.section2 = parts.add_section(*b);
  p.material = parts.material(card, card.integer(1), nsm / a.area_m2, property_name(card));
  if (nsm > 0.0)
    parts.note_once(
        property_name(card) +
        ": the spread mass (NSM) turns with the section, which Nastran's does not, and lowers torsional frequencies; "
        "give it by CONM2 at the grids instead");
  return p;
}

MemberProperty tapered_library(Parts& parts, const Card& card) {
  const auto [type, n] = profile_of(card);
  const std::string name = property_name(card);
  const double nu = poisson_ratio_of(parts, card);
  const std::vector<double> first = numbers(card, 8, n);
  const double nsm = card.number_or(8 + n, 0.0);
  std::optional<fe::Section> other;
  for (std::size_t i = 9 + n; i < card.size(); i += 3 + n) {  // SO, X, the dimensions, NSM
    std::vector<double> values;
    for (std::size_t k = 0; k < n; ++k) values.push_back(card.number_or(i + 2 + k, first[k]));
    if (card.number_or(i + 2 + n, nsm) != nsm)
      card.fail("the nonstructural mass varies along the member, which is not read", "give one value");
    if (values == first) continue;
    if (card.number_or(i + 1, 1.0) != 1.0)
      card.fail("has a section of its own between its ends, which is not read", "split the members there");
    other = library_section(parts, card, type, values, name + "_b", nu);
  }
  return member(parts, card, library_section(parts, card, type, first, name, nu), other, nsm);
}

}  // namespace

std::string property_name(const Card& property) { return lower_case(property.name + "_" + property.text(0)); }

const Card& Parts::property(const DeckPlace& element, long id, const std::vector<std::string>& kinds) const {
  if (const auto found = properties.find(id); found != properties.end())
    for (const Card* card : found->second)
      if (contains(kinds, card->name)) return *card;
  element.fail(fmt::format("property {} is no {} of this deck", id, fmt::join(kinds, " or ")),
               "give the property, or mend its number");
}

std::pair<long, double> Parts::constant(const Card& card, const std::map<long, double>& of, const char* kind) const {
  const auto found = of.find(card.integer_or(1, card.integer(0)));
  if (found == of.end())
    card.fail(fmt::format("property {} is no {} of this deck", card.integer_or(1, card.integer(0)), kind),
              "give the property, or mend its number");
  return *found;
}

fe::Material Parts::elastic(const DeckPlace& from, long id) const {
  const auto found = materials.find(id);
  if (found == materials.end())
    from.fail(fmt::format("material {} is no MAT1 of this deck", id), "give an isotropic material by MAT1");
  const Card& card = *found->second;
  fe::Material m;
  const double e = card.number_or(1, 0.0), g = card.number_or(2, 0.0);
  const bool has_ratio = !card.blank(3);
  m.poisson_ratio = card.number_or(3, 0.0);
  check_poisson_ratio(card, m.poisson_ratio);
  m.youngs_modulus_Pa = e > 0.0 ? e : 2.0 * (1.0 + m.poisson_ratio) * g;
  if (!(m.youngs_modulus_Pa > 0.0)) card.fail("has no Young's modulus above 0", "give E in field 3");
  if (e > 0.0 && g > 0.0 && !has_ratio) m.poisson_ratio = std::clamp(e / (2.0 * g) - 1.0, -0.99, 0.499);
  m.shear_modulus_Pa = g > 0.0 ? g : m.youngs_modulus_Pa / (2.0 * (1.0 + m.poisson_ratio));
  m.density_kg_m3 = card.number_or(4, 0.0);
  return m;
}

int Parts::material(const DeckPlace& from, long id, double added_density, const std::string& owner) {
  const std::string name = fmt::format("mat1_{}{}", id, added_density > 0.0 ? "_" + owner : "");
  if (const auto known = material_position.find(name); known != material_position.end()) return known->second;
  fe::Material m = elastic(from, id);
  const Card& card = *materials.at(id);
  m.name = name;
  m.density_kg_m3 += added_density;
  if (!(m.density_kg_m3 >= 0.0) || added_density < 0.0) card.fail("a density is negative", "check the sign");
  material_position[name] = static_cast<int>(model.materials.size());
  expansion[material_position[name]] = {card.number_or(5, 0.0), card.number_or(6, 0.0)};
  model.materials.push_back(m);
  if (added_density > 0.0)
    notes.push_back(
        fmt::format("{}: its nonstructural mass is spread over the section, as density of material {}", owner, name));
  return material_position[name];
}

MemberProperty bar_property(Parts& parts, const Card& element, long id) {
  const Card& card = parts.property(element, id, {"PBAR", "PBARL"});
  const std::string name = property_name(card);
  if (card.name == "PBARL") {
    const auto [type, n] = profile_of(card);
    return member(parts, card, library_section(parts, card, type, numbers(card, 8, n), name, poisson_ratio_of(parts, card)),
                  std::nullopt, card.number_or(8 + n, 0.0));
  }
  const Station s = {card.number_or(2, 0.0),  card.number_or(3, 0.0), card.number_or(4, 0.0),
                     card.number_or(18, 0.0), card.number_or(5, 0.0), card.number_or(6, 0.0)};
  check_station(card, s);
  // K1, K2 blank: rigid in shear.
  const fe::Section section = to_section(name, s, card.number_or(16, 0.0), card.number_or(17, 0.0));
  return member(parts, card, section, std::nullopt, s[5]);
}

MemberProperty beam_property(Parts& parts, const Card& element, long id) {
  const Card& card = parts.property(element, id, {"PBEAM", "PBEAML"});
  if (card.name == "PBEAML") return tapered_library(parts, card);
  const std::string name = property_name(card);
  const Station a = station_at(card, 2, {});
  check_station(card, a);
  std::size_t i = is_output_word(card.text(8)) ? 8 : 16;  // the line of stress points at end A may be left out
  std::optional<Station> b;
  while (is_output_word(card.text(i))) {
    const Station s = station_at(card, i + 2, a);
    check_station(card, s);
    if (s != a && card.number_or(i + 1, 1.0) != 1.0)
      card.fail("has a section of its own between its ends, which is not read", "split the members there");
    if (s[5] != a[5]) card.fail("the nonstructural mass varies along the member, which is not read", "give one value");
    if (s != a) b = s;
    // YES: a line of stress points follows.
    i += upper_case(card.fields[i]) == "YES" ? 16 : 8;
  }
  // K1 K2 S1 S2 NSI(A) NSI(B) CW(A) CW(B), then M1 M2 N1 N2 of both ends. Blank K: 1.
  const double k1 = card.number_or(i, 1.0), k2 = card.number_or(i + 1, 1.0);
  refuse_values(card, i + 2, 2, "shear relief of a taper (S1, S2)");
  refuse_values(card, i + 4, 2, "rotary inertia of its nonstructural mass (NSI)");
  if (card.number_or(i + 6, 0.0) != 0.0 || card.number_or(i + 7, 0.0) != 0.0)
    parts.notes.push_back(name + ": its warping constant (CW) is left out");
  refuse_values(card, i + 8, 4, "nonstructural mass beside its axis (M1, M2)");
  refuse_values(card, i + 12, 4, "a neutral axis beside its shear centre (N1, N2)");
  std::optional<fe::Section> other;
  if (b) other = to_section(name + "_b", *b, k1, k2);
  return member(parts, card, to_section(name, a, k1, k2), other, a[5]);
}

}  // namespace twindeck::model_io::nastran
