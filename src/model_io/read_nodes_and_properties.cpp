#include "model_io/read_nodes_and_properties.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "model_io/deck_card.hpp"
#include "model_io/names.hpp"

namespace twindeck::model_io {
namespace {

/// A number that must not be negative (or, `strict`, must be positive).
double at_least_zero(const io::CsvTable& table, std::size_t row, const std::string& column, double fallback,
                     bool strict = false) {
  const double value = table.number_or(row, column, fallback);
  if (value < 0.0 || (strict && value == 0.0)) {
    table.fail(row, column,
               fmt::format("is {}, expected a value {} 0", io::format_number(value), strict ? "above" : "of at least"),
               "give the value in SI units, as the unit in the column's name says");
  }
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
  if (known.contains(name)) {
    table.fail(row, column, fmt::format("'{}' appears twice", name), "give each " + column + " a name of its own");
  }
  return name;
}

}  // namespace

int NameIndex::node(const io::CsvTable& table, std::size_t row, const std::string& column) const {
  const long id = table.integer(row, column);
  const auto found = nodes.find(id);
  if (found != nodes.end()) return found->second;
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
    if (!index.nodes.emplace(node.id, static_cast<int>(row)).second) {
      table.fail(row, "node", fmt::format("node {} appears twice", node.id), "give each node a number of its own");
    }
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
    if (m.poisson_ratio <= -1.0 || m.poisson_ratio >= 0.5) {
      table.fail(row, "poisson_ratio", fmt::format("is {}, expected a value in ]-1, 0.5[", io::format_number(m.poisson_ratio)),
                 "steel has 0.3, concrete 0.2");
    }
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
  const auto table = io::CsvTable::read(folder / "sections.csv", {"section"},
                                        {"area_m2", "inertia_y_m4", "inertia_z_m4", "inertia_yz_m4", "torsion_m4",
                                         "shear_area_y_m2", "shear_area_z_m2", "thickness_m", "bending_inertia_ratio"});
  for (std::size_t row = 0; row < table.rows(); ++row) {
    fe::Section s;
    s.name = unique_name(table, row, "section", index.sections);
    s.area_m2 = at_least_zero(table, row, "area_m2", 0.0);
    s.inertia_y_m4 = at_least_zero(table, row, "inertia_y_m4", 0.0);
    s.inertia_z_m4 = at_least_zero(table, row, "inertia_z_m4", 0.0);
    s.inertia_yz_m4 = table.number_or(row, "inertia_yz_m4", 0.0);
    if (s.inertia_yz_m4 * s.inertia_yz_m4 > s.inertia_y_m4 * s.inertia_z_m4) {
      table.fail(row, "inertia_yz_m4", "is larger than sqrt(inertia_y inertia_z), which no section can have",
                 "check the three second moments of area");
    }
    s.torsion_m4 = at_least_zero(table, row, "torsion_m4", 0.0);
    s.shear_area_y_m2 = at_least_zero(table, row, "shear_area_y_m2", 0.0);
    s.shear_area_z_m2 = at_least_zero(table, row, "shear_area_z_m2", 0.0);
    s.thickness_m = at_least_zero(table, row, "thickness_m", 0.0);
    s.bending_inertia_ratio = at_least_zero(table, row, "bending_inertia_ratio", 1.0, true);
    index.sections.emplace(s.name, static_cast<int>(row));
    model.sections.push_back(s);
  }
}

}  // namespace twindeck::model_io
