#include "model_io/write_model.hpp"

#include <algorithm>

#include "io/csv.hpp"
#include "model_io/folder_parts.hpp"
#include "model_io/model_toml.hpp"
#include "model_io/names.hpp"

namespace twindeck::model_io {
namespace {

using Row = std::vector<io::Cell>;

io::Cell node_id(const fe::Model& model, int node) {
  if (node < 0) return "";
  return model.nodes[fe::slot(node)].id;
}

void write_parts(const fe::Model& model, const std::filesystem::path& folder) {
  io::CsvWriter nodes({"node", "x_m", "y_m", "z_m"});
  for (const auto& n : model.nodes) nodes.row({n.id, n.x_m.x(), n.x_m.y(), n.x_m.z()});
  nodes.save(folder / "nodes.csv");

  io::CsvWriter materials({"material", "youngs_modulus_Pa", "shear_modulus_Pa", "poisson_ratio", "density_kg_m3"});
  for (const auto& m : model.materials)
    materials.row({m.name, m.youngs_modulus_Pa, m.shear_modulus_Pa, m.poisson_ratio, m.density_kg_m3});
  materials.save(folder / "materials.csv");

  // The last column is there only where a shell is flexible in transverse shear.
  const bool shears = std::ranges::any_of(model.sections, [](const fe::Section& s) { return s.shear_thickness_ratio != 0.0; });
  std::vector<std::string> header = {
      "section",    "area_m2",         "inertia_y_m4",    "inertia_z_m4", "inertia_yz_m4",
      "torsion_m4", "shear_area_y_m2", "shear_area_z_m2", "thickness_m",  "bending_inertia_ratio"};
  if (shears) header.emplace_back("shear_thickness_ratio");
  io::CsvWriter sections(header);
  for (const auto& s : model.sections) {
    Row row = {s.name,       s.area_m2,         s.inertia_y_m4,    s.inertia_z_m4, s.inertia_yz_m4,
               s.torsion_m4, s.shear_area_y_m2, s.shear_area_z_m2, s.thickness_m,  s.bending_inertia_ratio};
    if (shears) row.emplace_back(s.shear_thickness_ratio);
    sections.row(row);
  }
  sections.save(folder / "sections.csv");
}

void write_elements(const fe::Model& model, const std::filesystem::path& folder) {
  // Columns from node5 on are there only for solids that need them, section2 for tapered beams, free_strain for warmed parts.
  std::size_t node_columns = 4;
  for (const fe::Element& e : model.elements) node_columns = std::max(node_columns, e.nodes.size());
  std::vector<std::string> header = {"element", "type", "name", "group", "material", "section"};
  for (std::size_t i = 1; i <= node_columns; ++i) header.push_back("node" + std::to_string(i));
  const bool tapers = std::ranges::any_of(model.elements, [](const fe::Element& e) { return e.section2 >= 0; });
  if (tapers) header.emplace_back("section2");
  const bool strains = std::ranges::any_of(model.elements, [](const fe::Element& e) { return e.free_strain != 0.0; });
  for (const char* column : {"orientation_x", "orientation_y", "orientation_z", "offset1_x_m", "offset1_y_m", "offset1_z_m",
                             "offset2_x_m", "offset2_y_m", "offset2_z_m", "releases", "pull_N"})
    header.emplace_back(column);
  if (strains) header.emplace_back("free_strain");
  io::CsvWriter elements(header);
  for (const auto& e : model.elements) {
    Row row = {e.id,
               name_of(e.type),
               e.name,
               e.group,
               model.materials[fe::slot(e.material)].name,
               e.section < 0 ? "" : model.sections[fe::slot(e.section)].name};
    for (std::size_t i = 0; i < node_columns; ++i) row.push_back(node_id(model, i < e.nodes.size() ? e.nodes[i] : -1));
    if (tapers) row.emplace_back(e.section2 < 0 ? "" : model.sections[fe::slot(e.section2)].name);
    for (const Eigen::Vector3d& v : {e.orientation, e.offset_m[0], e.offset_m[1]})
      for (int i = 0; i < 3; ++i) row.emplace_back(v[i]);
    row.emplace_back(static_cast<int>(e.releases));
    row.emplace_back(e.pull_N);
    if (strains) row.emplace_back(e.free_strain);
    elements.row(row);
  }
  elements.save(folder / "elements.csv");
}

/// constraints.csv, which is there only where the model has constraints.
void write_constraints(const fe::Model& model, const std::filesystem::path& folder) {
  if (model.constraints.empty()) return;
  io::CsvWriter rows({"constraint", "node", "direction", "of_node", "of_direction", "factor"});
  for (const fe::Constraint& c : model.constraints)
    for (const fe::Constraint::Term& term : c.terms)
      rows.row({c.name, node_id(model, c.node), direction_names()[fe::slot(c.direction)], node_id(model, term.node),
                direction_names()[fe::slot(term.direction)], term.factor});
  rows.save(folder / "constraints.csv");
}

void write_attachments(const fe::Model& model, const std::filesystem::path& folder) {
  io::CsvWriter supports({"support", "node", "x", "y", "z", "rx", "ry", "rz"});
  for (const auto& s : model.supports) {
    Row row = {s.name, node_id(model, s.node)};
    for (const bool fixed : s.fixed) row.emplace_back(fixed ? 1 : 0);
    supports.row(row);
  }
  supports.save(folder / "supports.csv");

  io::CsvWriter springs({"spring", "group", "node", "node2", "direction_x", "direction_y", "direction_z", "quantity",
                         "stiffness_N_m", "damping_N_s_m", "friction_N", "arrangement", "active"});
  for (const auto& s : model.springs)
    springs.row({s.name, s.group, node_id(model, s.node), node_id(model, s.node2), s.direction.x(), s.direction.y(),
                 s.direction.z(), s.rotation ? "rotation" : "translation", s.stiffness, s.damping, s.friction_N,
                 s.series ? "series" : "parallel", s.active ? 1 : 0});
  springs.save(folder / "springs.csv");

  io::CsvWriter links({"link", "master", "slave"});
  for (const auto& l : model.links) links.row({l.name, node_id(model, l.master), node_id(model, l.slave)});
  links.save(folder / "links.csv");
  write_constraints(model, folder);

  io::CsvWriter masses({"group", "node", "mass_kg", "inertia_x_kg_m2", "inertia_y_kg_m2", "inertia_z_kg_m2"});
  for (const auto& m : model.masses)
    masses.row({m.group, node_id(model, m.node), m.mass_kg, m.inertia_kg_m2.x(), m.inertia_kg_m2.y(), m.inertia_kg_m2.z()});
  masses.save(folder / "masses.csv");

  io::CsvWriter points({"point", "node"});
  for (const auto& [name, node] : model.monitoring_points) points.row({name, node_id(model, node)});
  points.save(folder / "points.csv");
}

/// loads.csv with the load case of the static stage, where there is one.
void write_stage_loads(const fe::Model& model, const std::filesystem::path& folder) {
  if (model.prestress.loads.empty()) return;
  io::CsvWriter rows({"load", "node", "direction", "value", "unit"});
  for (const fe::Prestress::Load& l : model.prestress.loads)
    rows.row({model.prestress.load_case, node_id(model, l.node), direction_names()[fe::slot(l.direction)], l.value,
              l.movement        ? "m"
              : l.direction < 3 ? "N"
                                : "N m"});
  rows.save(folder / "loads.csv");
}

}  // namespace

void write_model(const fe::Model& model, const std::filesystem::path& folder) {
  write_parts(model, folder);
  write_elements(model, folder);
  write_attachments(model, folder);
  write_stage_loads(model, folder);
  write_model_toml(model, folder);
}

}  // namespace twindeck::model_io
