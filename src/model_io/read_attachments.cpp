#include "model_io/read_attachments.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "io/spreadsheet.hpp"
#include "model_io/names.hpp"

namespace twindeck::model_io {
namespace {

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
  if (value < 0.0) {
    table.fail(row, column, fmt::format("is {}, expected a value of at least 0", io::format_number(value)), "check the sign");
  }
  return value;
}

/// Refuses a row that says nothing: cells that are its point and are all empty. Where one is filled, the others are 0.
void require_one(const io::CsvTable& table, std::size_t row, const std::vector<std::string>& columns, const std::string& mend) {
  const auto is_empty = [&](const std::string& column) { return table.text(row, column).empty(); };
  if (!std::all_of(columns.begin(), columns.end(), is_empty)) return;
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

void read_supports(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index) {
  if (!is_there(folder, "supports.csv")) return;
  const auto table = io::CsvTable::read(folder / "supports.csv", {"node", "x", "y", "z", "rx", "ry", "rz"}, {"support"});
  for (std::size_t row = 0; row < table.rows(); ++row) {
    fe::Support support;
    support.name = table.text(row, "support");
    support.node = index.node(table, row, "node");
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
    if (s.direction.norm() < 1e-12) {
      table.fail(row, "direction_x", "the direction has no length", "give the direction cosines of the spring's axis");
    }
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
    if (!slaves.emplace(link.slave, row).second) {
      table.fail(row, "slave", fmt::format("node {} is the slave of two links", table.text(row, "slave")),
                 "a node follows one master; turn one of the links around");
    }
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
    fe::PointMass mass;
    mass.group = table.text(row, "group");
    mass.node = index.node(table, row, "node");
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
    if (!model.monitoring_points.emplace(point, index.node(table, row, "node")).second) {
      table.fail(row, "point", fmt::format("point '{}' appears twice", point), "give each point a name of its own");
    }
  }
}

}  // namespace twindeck::model_io
