#include "model_io/read_elements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.hpp"
#include "io/spreadsheet.hpp"
#include "model_io/deck_card.hpp"
#include "model_io/names.hpp"

namespace twindeck::model_io {
namespace {

constexpr std::size_t kNodeColumns = 20;

std::string node_column(std::size_t i) { return fmt::format("node{}", i + 1); }

int position_by_name(const io::CsvTable& table, std::size_t row, const std::string& column,
                     const std::map<std::string, int>& known) {
  const std::string name = table.text(row, column);
  const std::string file = column.starts_with("section") ? "section" : column;  // section, section2: sections.csv
  if (const auto found = known.find(name); found != known.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [known_name, position] : known) names.push_back(known_name);
  table.fail(row, column, fmt::format("{} '{}' is not in {}s.csv{}", column, name, file, did_you_mean(name, names)),
             fmt::format("add it there or use one that is there"));
}

/// Solids have no section: the cell is empty.
int read_section(const io::CsvTable& table, std::size_t row, const NameIndex& index, fe::ElementType type) {
  if (type != fe::ElementType::solid) return position_by_name(table, row, "section", index.sections);
  if (!table.text(row, "section").empty())
    table.fail(row, "section", "is filled, but a solid has no section", "leave the cell empty");
  return -1;
}

fe::ElementType read_type(const io::CsvTable& table, std::size_t row) {
  const std::string type = table.text(row, "type");
  const int position = position_of(type, element_type_names());
  if (position < 0)
    table.fail(row, "type", fmt::format("unknown element type '{}'{}", type, did_you_mean(type, element_type_names())),
               "use " + one_of(element_type_names()));
  return static_cast<fe::ElementType>(position);
}

/// How many nodes the row names: a shell whose node4 is empty is a triangle; a solid has four, eight, ten or twenty.
std::size_t nodes_wanted(const io::CsvTable& table, std::size_t row, fe::ElementType type) {
  const auto is_empty = [&](std::size_t i) { return table.text(row, node_column(i)).empty(); };
  if (type == fe::ElementType::shell && is_empty(3)) return 3;
  if (type != fe::ElementType::solid) return fe::node_count(type);
  return is_empty(4) ? 4 : is_empty(8) && is_empty(9) ? 8 : is_empty(10) && is_empty(19) ? 10 : 20;
}

void read_element_nodes(const io::CsvTable& table, std::size_t row, const NameIndex& index, fe::Element& element) {
  const std::size_t wanted = nodes_wanted(table, row, element.type);
  for (std::size_t i = 0; i < wanted; ++i) element.nodes.push_back(index.node(table, row, node_column(i)));
  for (std::size_t i = wanted; i < kNodeColumns; ++i) {
    if (!table.text(row, node_column(i)).empty()) {
      const char* words = wanted == 2                              ? "two"
                          : element.type == fe::ElementType::shell ? "three or four"
                                                                   : "four, eight, ten or twenty";
      table.fail(
          row, node_column(i), fmt::format("is filled, but a {} has {} nodes", name_of(element.type), words),
          "leave the cell empty or make the element a shell (three or four nodes) or a solid (four, eight, ten or twenty)");
    }
  }
  if (std::set<int>(element.nodes.begin(), element.nodes.end()).size() != wanted)
    table.fail(row, "node1", fmt::format("element {} has the same node twice", element.id), "give it nodes that differ");
}

Eigen::Vector3d read_vector(const io::CsvTable& table, std::size_t row, const std::string& prefix, const std::string& suffix) {
  return {table.number_or(row, prefix + "_x" + suffix, 0.0), table.number_or(row, prefix + "_y" + suffix, 0.0),
          table.number_or(row, prefix + "_z" + suffix, 0.0)};
}

/// Two nodes at one place: said here, where the line is known.
void check_length(const io::CsvTable& table, std::size_t row, const fe::Model& model, const fe::Element& element) {
  if (fe::node_count(element.type) != 2) return;
  const auto& a = model.nodes[fe::slot(element.nodes[0])];
  const auto& b = model.nodes[fe::slot(element.nodes[1])];
  const double length = (b.x_m + element.offset_m[1] - a.x_m - element.offset_m[0]).norm();
  if (length > 1e-9) return;
  table.fail(
      row, "node2",
      fmt::format("{} {} has no length: nodes {} and {} lie at one place ({}, {}, {})", name_of(element.type), element.id, a.id,
                  b.id, io::format_number(a.x_m.x()), io::format_number(a.x_m.y()), io::format_number(a.x_m.z())),
      "move one of the nodes in nodes.csv, or join them by a row of links.csv instead");
}

void check_section(const io::CsvTable& table, std::size_t row, const fe::Model& model, const fe::Element& element) {
  if (element.type == fe::ElementType::solid) return;
  const fe::Section& section = model.sections[fe::slot(element.section)];
  if (element.type == fe::ElementType::shell && section.thickness_m <= 0.0)
    table.fail(row, "section", fmt::format("section '{}' has no thickness, which a shell needs", section.name),
               "fill thickness_m in sections.csv");
  if (element.type != fe::ElementType::shell && section.area_m2 <= 0.0)
    table.fail(row, "section", fmt::format("section '{}' has no area, which a {} needs", section.name, name_of(element.type)),
               "fill area_m2 in sections.csv");
}

/// A number that must not be negative (or, `strict`, must be positive).
double at_least_zero(const io::CsvTable& table, std::size_t row, const std::string& column, double fallback,
                     bool strict = false) {
  const double value = table.number_or(row, column, fallback);
  if (value < 0.0 || (strict && value == 0.0))
    table.fail(row, column,
               fmt::format("is {}, expected a value {} 0", io::format_number(value), strict ? "above" : "of at least"),
               "give the value in SI units, as the unit in the column's name says");
  return value;
}

double coordinate(const io::CsvTable& table, std::size_t row, const std::string& column) {
  constexpr double farthest_m = 1e9;  // as in fe::validate, which has no line to name
  const double value = table.number(row, column);
  if (std::abs(value) > farthest_m)
    table.fail(row, column, fmt::format("is {}, expected at most {:g} m from the origin", table.text(row, column), farthest_m),
               "give coordinates in metres");
  return value;
}

std::string unique_name(const io::CsvTable& table, std::size_t row, const std::string& column,
                        const std::map<std::string, int>& known) {
  const std::string name = table.text(row, column);
  if (name.empty()) table.fail(row, column, "is empty, expected a name", "name it so that elements.csv can refer to it");
  if (known.contains(name))
    table.fail(row, column, fmt::format("'{}' appears twice", name), "give each " + column + " a name of its own");
  return name;
}

/// What hangs on the elements may be left out altogether.
bool is_there(const std::filesystem::path& folder, const char* file) { return io::has_table(folder / file); }

bool read_flag(const io::CsvTable& table, std::size_t row, const std::string& column, bool fallback) {
  const auto value = table.integer_if(row, column);
  if (!value) return fallback;
  if (*value != 0 && *value != 1) table.fail(row, column, fmt::format("is {}, expected 0 or 1", *value), "1 means yes, 0 no");
  return *value == 1;
}

double not_negative(const io::CsvTable& table, std::size_t row, const std::string& column) {
  const double value = table.number_or(row, column, 0.0);
  if (value < 0.0)
    table.fail(row, column, fmt::format("is {}, expected a value of at least 0", io::format_number(value)), "check the sign");
  return value;
}

/// Refuses a row that says nothing: cells that are its point and are all empty. Where one is filled, the others are 0.
void require_one(const io::CsvTable& table, std::size_t row, const std::vector<std::string>& columns, const std::string& mend) {
  const auto is_empty = [&](const std::string& column) { return table.text(row, column).empty(); };
  if (!std::ranges::all_of(columns, is_empty)) return;
  table.fail(row, columns.front(), fmt::format("is empty, and so are {}", fmt::join(columns.begin() + 1, columns.end(), ", ")),
             mend);
}

/// One of two words; the first where the cell is empty.
bool is_second_word(const io::CsvTable& table, std::size_t row, const std::string& column, const std::string& first,
                    const std::string& second) {
  const std::string word = table.text(row, column);
  if (word.empty() || word == first) return false;
  if (word == second) return true;
  const std::vector<std::string> known = {first, second};
  table.fail(row, column, fmt::format("unknown {} '{}'{}", column, word, did_you_mean(word, known)), "use " + one_of(known));
}

}  // namespace

void read_elements(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index) {
  std::vector<std::string> optional = {"name",          "group",       "section2",    "orientation_x", "orientation_y",
                                       "orientation_z", "offset1_x_m", "offset1_y_m", "offset1_z_m",   "offset2_x_m",
                                       "offset2_y_m",   "offset2_z_m", "releases",    "pull_N",        "free_strain"};
  for (std::size_t i = 2; i < kNodeColumns; ++i) optional.push_back(node_column(i));
  const auto table =
      io::CsvTable::read(folder / "elements.csv", {"element", "type", "material", "section", "node1", "node2"}, optional);
  std::set<long> ids;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    fe::Element e;
    e.id = table.integer(row, "element");
    if (!ids.insert(e.id).second)
      table.fail(row, "element", fmt::format("element {} appears twice", e.id), "give each element a number of its own");
    e.type = read_type(table, row);
    e.name = table.text(row, "name");
    e.group = table.text(row, "group");
    e.material = position_by_name(table, row, "material", index.materials);
    e.section = read_section(table, row, index, e.type);
    if (!table.text(row, "section2").empty()) {
      if (e.type != fe::ElementType::beam)
        table.fail(row, "section2", "is filled, but only a beam can taper", "leave the cell empty");
      e.section2 = position_by_name(table, row, "section2", index.sections);
    }
    read_element_nodes(table, row, index, e);
    e.orientation = read_vector(table, row, "orientation", "");
    e.offset_m = {read_vector(table, row, "offset1", "_m"), read_vector(table, row, "offset2", "_m")};
    const long releases = table.integer_if(row, "releases").value_or(0);
    if (releases < 0 || releases > 4095)
      table.fail(row, "releases", fmt::format("is {}, expected a sum of powers of two from 0 to 4095", releases),
                 "bit 0-5 releases local x y z rx ry rz of the first end, bit 6-11 those of the second");
    e.releases = static_cast<std::uint16_t>(releases);
    e.pull_N = table.number_or(row, "pull_N", 0.0);
    if (e.pull_N != 0.0 && e.type != fe::ElementType::stay && e.type != fe::ElementType::bar)
      table.fail(row, "pull_N", fmt::format("is filled, but a {} has no pull", name_of(e.type)), "leave the cell empty");
    if (e.pull_N < 0.0)
      table.fail(row, "pull_N", fmt::format("is {}, expected a pull of at least 0", io::format_number(e.pull_N)),
                 "a stay cannot push");
    e.free_strain = table.number_or(row, "free_strain", 0.0);
    check_length(table, row, model, e);
    check_section(table, row, model, e);
    model.elements.push_back(std::move(e));
  }
}

int NameIndex::node(const io::CsvTable& table, std::size_t row, const std::string& column) const {
  const long id = table.integer(row, column);
  if (const auto found = nodes.find(id); found != nodes.end()) return found->second;
  const std::string range = nodes.empty() ? "which is empty"
                                          : fmt::format("which has {} nodes from {} to {}", nodes.size(), nodes.begin()->first,
                                                        nodes.rbegin()->first);
  table.fail(row, column, fmt::format("node {} is not in nodes.csv ({})", id, range),
             "add the node there or refer to one that is there");
}

std::pair<int, int> NameIndex::displacement(const std::string& text) const {
  const auto colon = text.find(':');
  const std::string node = text.substr(0, colon);
  const auto found = is_whole_number(node) ? nodes.find(std::stol(node)) : nodes.end();
  return {found == nodes.end() ? -1 : found->second,
          colon == std::string::npos ? -1 : position_of(text.substr(colon + 1), direction_names())};
}

void read_nodes(const std::filesystem::path& folder, fe::Model& model, NameIndex& index) {
  const auto table = io::CsvTable::read(folder / "nodes.csv", {"node", "x_m", "y_m", "z_m"});
  for (std::size_t row = 0; row < table.rows(); ++row) {
    fe::Node node;
    node.id = table.integer(row, "node");
    node.x_m = {coordinate(table, row, "x_m"), coordinate(table, row, "y_m"), coordinate(table, row, "z_m")};
    if (!index.nodes.emplace(node.id, static_cast<int>(row)).second)
      table.fail(row, "node", fmt::format("node {} appears twice", node.id), "give each node a number of its own");
    model.nodes.push_back(node);
  }
  if (model.nodes.empty()) throw InputError({table.file().string(), 0, ""}, "holds no node", "give one node a row");
}

void read_materials(const std::filesystem::path& folder, fe::Model& model, NameIndex& index) {
  const auto table = io::CsvTable::read(folder / "materials.csv", {"material", "youngs_modulus_Pa", "density_kg_m3"},
                                        {"shear_modulus_Pa", "poisson_ratio"});
  for (std::size_t row = 0; row < table.rows(); ++row) {
    fe::Material m;
    m.name = unique_name(table, row, "material", index.materials);
    (void)table.number(row, "youngs_modulus_Pa");
    m.youngs_modulus_Pa = at_least_zero(table, row, "youngs_modulus_Pa", 0.0, true);
    m.poisson_ratio = table.number_or(row, "poisson_ratio", 0.0);
    if (m.poisson_ratio <= -1.0 || m.poisson_ratio >= 0.5)
      table.fail(row, "poisson_ratio", fmt::format("is {}, expected a value in ]-1, 0.5[", io::format_number(m.poisson_ratio)),
                 "steel has 0.3, concrete 0.2");
    // An isotropic material needs two constants; the third follows where the column is empty.
    m.shear_modulus_Pa =
        at_least_zero(table, row, "shear_modulus_Pa", m.youngs_modulus_Pa / (2.0 * (1.0 + m.poisson_ratio)), true);
    (void)table.number(row, "density_kg_m3");
    m.density_kg_m3 = at_least_zero(table, row, "density_kg_m3", 0.0);
    index.materials.emplace(m.name, static_cast<int>(row));
    model.materials.push_back(m);
  }
}

void read_sections(const std::filesystem::path& folder, fe::Model& model, NameIndex& index) {
  const auto table =
      io::CsvTable::read(folder / "sections.csv", {"section"},
                         {"area_m2", "inertia_y_m4", "inertia_z_m4", "inertia_yz_m4", "torsion_m4", "shear_area_y_m2",
                          "shear_area_z_m2", "thickness_m", "bending_inertia_ratio", "shear_thickness_ratio"});
  for (std::size_t row = 0; row < table.rows(); ++row) {
    fe::Section s{.name = unique_name(table, row, "section", index.sections),
                  .area_m2 = at_least_zero(table, row, "area_m2", 0.0),
                  .inertia_y_m4 = at_least_zero(table, row, "inertia_y_m4", 0.0),
                  .inertia_z_m4 = at_least_zero(table, row, "inertia_z_m4", 0.0),
                  .inertia_yz_m4 = table.number_or(row, "inertia_yz_m4", 0.0)};
    if (s.inertia_yz_m4 * s.inertia_yz_m4 > s.inertia_y_m4 * s.inertia_z_m4)
      table.fail(row, "inertia_yz_m4", "is larger than sqrt(inertia_y inertia_z), which no section can have",
                 "check the three second moments of area");
    s.torsion_m4 = at_least_zero(table, row, "torsion_m4", 0.0);
    s.shear_area_y_m2 = at_least_zero(table, row, "shear_area_y_m2", 0.0);
    s.shear_area_z_m2 = at_least_zero(table, row, "shear_area_z_m2", 0.0);
    s.thickness_m = at_least_zero(table, row, "thickness_m", 0.0);
    s.bending_inertia_ratio = at_least_zero(table, row, "bending_inertia_ratio", 1.0, true);
    s.shear_thickness_ratio = at_least_zero(table, row, "shear_thickness_ratio", 0.0);
    index.sections.emplace(s.name, static_cast<int>(row));
    model.sections.push_back(s);
  }
}

void read_supports(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index) {
  if (!is_there(folder, "supports.csv")) return;
  const auto table = io::CsvTable::read(folder / "supports.csv", {"node", "x", "y", "z", "rx", "ry", "rz"}, {"support"});
  for (std::size_t row = 0; row < table.rows(); ++row) {
    fe::Support support{.name = table.text(row, "support"), .node = index.node(table, row, "node")};
    require_one(table, row, direction_names(), "write 1 for the directions that it holds");
    for (std::size_t i = 0; i < 6; ++i) support.fixed[i] = read_flag(table, row, direction_names()[i], false);
    model.supports.push_back(support);
  }
}

void read_springs(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index) {
  if (!is_there(folder, "springs.csv")) return;
  const auto table = io::CsvTable::read(folder / "springs.csv",
                                        {"spring", "node", "direction_x", "direction_y", "direction_z", "stiffness_N_m"},
                                        {"group", "node2", "quantity", "damping_N_s_m", "friction_N", "arrangement", "active"});
  std::map<std::string, std::size_t> names;  // with the row that each stands in first
  for (std::size_t row = 0; row < table.rows(); ++row) {
    fe::Spring s;
    s.name = table.text(row, "spring");
    if (const auto [first, is_new] = names.emplace(s.name, row); !is_new && !s.name.empty())
      table.fail(row, "spring", fmt::format("'{}' is the name of row {} too", s.name, first->second + 1),
                 "give each spring and damper a name of its own; springs of one kind share a group");
    s.group = table.text(row, "group");
    s.node = index.node(table, row, "node");
    s.node2 = table.text(row, "node2").empty() ? -1 : index.node(table, row, "node2");
    if (s.node == s.node2) table.fail(row, "node2", "is the node itself", "leave it empty for a spring to the ground");
    s.direction = {table.number(row, "direction_x"), table.number(row, "direction_y"), table.number(row, "direction_z")};
    if (s.direction.norm() < 1e-12)
      table.fail(row, "direction_x", "the direction has no length", "give the direction cosines of the spring's axis");
    // Rescaled only when it is not of unit length to the twelve digits of the file, so that a round trip changes nothing.
    if (std::abs(s.direction.norm() - 1.0) > 1e-11) s.direction.normalize();
    s.rotation = is_second_word(table, row, "quantity", "translation", "rotation");
    require_one(table, row, {"stiffness_N_m", "damping_N_s_m", "friction_N"}, "fill the one that it has; write 0 for none");
    s.stiffness = not_negative(table, row, "stiffness_N_m");
    s.damping = not_negative(table, row, "damping_N_s_m");
    s.friction_N = not_negative(table, row, "friction_N");
    s.series = is_second_word(table, row, "arrangement", "parallel", "series");
    if (s.series) (void)table.number(row, "stiffness_N_m");  // a spring of 0 in series would take the dashpot away
    s.active = read_flag(table, row, "active", true);
    model.springs.push_back(std::move(s));
  }
}

void read_links(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index) {
  if (!is_there(folder, "links.csv")) return;
  const auto table = io::CsvTable::read(folder / "links.csv", {"master", "slave"}, {"link"});
  std::map<int, std::size_t> slaves;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    fe::RigidLink link{table.text(row, "link"), index.node(table, row, "master"), index.node(table, row, "slave")};
    if (link.master == link.slave) table.fail(row, "slave", "is the master itself", "link two nodes that differ");
    if (!slaves.emplace(link.slave, row).second)
      table.fail(row, "slave", fmt::format("node {} is the slave of two links", table.text(row, "slave")),
                 "a node follows one master; turn one of the links around");
    model.links.push_back(std::move(link));
  }
}

void read_constraints(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index) {
  if (!is_there(folder, "constraints.csv")) return;
  const auto table = io::CsvTable::read(folder / "constraints.csv", {"node", "direction", "of_node", "of_direction", "factor"},
                                        {"constraint"});
  const auto direction = [&](std::size_t row, const std::string& column) {
    const int at = position_of(table.text(row, column), direction_names());
    if (at < 0)
      table.fail(row, column,
                 fmt::format("'{}' is no direction{}", table.text(row, column),
                             did_you_mean(table.text(row, column), direction_names())),
                 "use " + one_of(direction_names()));
    return at;
  };
  std::map<std::pair<int, int>, std::size_t> position;  // of the equation of a displacement
  for (std::size_t row = 0; row < table.rows(); ++row) {
    fe::Constraint c{table.text(row, "constraint"), index.node(table, row, "node"), direction(row, "direction"), {}};
    const auto [found, is_new] = position.try_emplace({c.node, c.direction}, model.constraints.size());
    if (is_new) model.constraints.push_back(c);
    fe::Constraint& whole = model.constraints[found->second];
    if (whole.name != c.name)
      table.fail(row, "constraint", fmt::format("this displacement depends by constraint '{}' already", whole.name),
                 "keep one of the two; the rows of one equation have one name");
    whole.terms.push_back({index.node(table, row, "of_node"), direction(row, "of_direction"), table.number(row, "factor")});
  }
}

void read_masses(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index) {
  if (!is_there(folder, "masses.csv")) return;
  const auto table = io::CsvTable::read(folder / "masses.csv", {"node", "mass_kg"},
                                        {"group", "inertia_x_kg_m2", "inertia_y_kg_m2", "inertia_z_kg_m2"});
  for (std::size_t row = 0; row < table.rows(); ++row) {
    fe::PointMass mass{.group = table.text(row, "group"), .node = index.node(table, row, "node")};
    require_one(table, row, {"mass_kg", "inertia_x_kg_m2", "inertia_y_kg_m2", "inertia_z_kg_m2"},
                "fill the mass; write 0 for none");
    mass.mass_kg = not_negative(table, row, "mass_kg");
    mass.inertia_kg_m2 = {not_negative(table, row, "inertia_x_kg_m2"), not_negative(table, row, "inertia_y_kg_m2"),
                          not_negative(table, row, "inertia_z_kg_m2")};
    model.masses.push_back(std::move(mass));
  }
}

void read_points(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index) {
  if (!is_there(folder, "points.csv")) return;
  const auto table = io::CsvTable::read(folder / "points.csv", {"point", "node"});
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string point = table.text(row, "point");
    if (!model.monitoring_points.emplace(point, index.node(table, row, "node")).second)
      table.fail(row, "point", fmt::format("point '{}' appears twice", point), "give each point a name of its own");
  }
}

}  // namespace twindeck::model_io
