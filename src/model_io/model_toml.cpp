#include "model_io/model_toml.hpp"

#include <fmt/format.h>

#include <deque>
#include <optional>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "fe/validate_parts.hpp"
#include "io/atomic.hpp"
#include "io/csv.hpp"
#include "io/path_name.hpp"
#include "io/toml_value.hpp"
#include "matrix_io/matrix_market.hpp"
#include "model_io/folder_parts.hpp"
#include "model_io/load_cases.hpp"
#include "model_io/names.hpp"
#include "model_io/parameter_entry.hpp"

namespace twindeck::model_io {
namespace {

/// [[parameter]] as it stands in the file.
struct ElementParameter : ParameterEntry {
  fe::Target target = fe::Target::youngs_modulus;
  std::vector<std::string> of;

  io::FieldTable fields() {
    io::FieldTable table;
    add_to(table);
    table.choice("target", target, target_names(), "what it scales")
        .texts("of", of, "names of the materials, sections or groups that it applies to");
    return table;
  }
};

/// [[matrix_element]] as it stands in the file: an element given by matrices, which lie in the folder matrices/ (Matrix Market,
/// general or symmetric).
struct MatrixElementEntry {
  std::string name, group, stiffness, damping, mass;  ///< the last three are files, relative to the model folder; "" = none
  std::vector<std::string> dofs;                      ///< "node:direction"
  int internal = 0;

  io::FieldTable fields() {
    io::FieldTable table;
    table.path_name("name", name, "matrix element", "name of the element, and of the files of its matrices", true)
        .text("group", group, "group, as of other elements")
        .texts("dofs", dofs, "degrees of freedom in the order of the matrices: \"node:direction\"")
        .integer("internal", internal, {0.0, 10000.0}, "unknowns of its own that follow them")
        .text("stiffness", stiffness, "file of K [N/m, N m/rad]")
        .text("damping", damping, "file of C [N s/m]")
        .text("mass", mass, "file of M [kg]");
    return table;
  }
};

/// What model.toml says in words of its own; the rest goes into the model at once.
struct ModelEntry {
  std::vector<double> gravity_direction = {0.0, 0.0, -1.0};
  std::vector<std::string> conditions;
  std::deque<MatrixElementEntry> matrix_elements;
  std::deque<ElementParameter> parameters;  // a deque: the field tables keep references while it grows

  io::FieldTable fields(fe::Model& model) {
    fe::Formulation& formulation = model.formulation;
    fe::Prestress& prestress = model.prestress;
    io::FieldTable table;
    table.text("title", model.title, "what the model is")
        .number("gravity", model.gravity_m_s2, "m/s2", io::non_negative(), "acceleration of gravity")
        .numbers("gravity_direction", gravity_direction, "", {-1.0, 1.0}, "unit vector along which things fall")
        .rule([this]() -> std::optional<io::FieldTable::Broken> {
          if (gravity_direction.size() == 3) return std::nullopt;
          return io::FieldTable::Broken{"gravity_direction", "has not three numbers", "write [0, 0, -1] for downwards along Z"};
        })
        .boolean("formulation.shear_flexible", formulation.shear_flexible,
                 "false: Euler-Bernoulli beams whatever the shear areas")
        .boolean("formulation.beam_rotary_inertia", formulation.beam_rotary_inertia,
                 "false: beams without rotary inertia of bending")
        .boolean("formulation.shell_rotary_inertia", formulation.shell_rotary_inertia,
                 "false: shells with translational mass only")
        .choice("formulation.drilling", formulation.drilling, {"penalty", "diagonal"},
                "stiffness of shell rotations about the normal")
        .number("formulation.drilling_factor", formulation.drilling_factor, "", io::non_negative(),
                "0: the formulation's default")
        .boolean("formulation.lumped_mass", formulation.lumped_mass, "true: masses at the nodes; false: consistent")
        .choice("prestress.rule", prestress.rule, pull_rule_names(), "where the pulls of the stays come from")
        .boolean("prestress.geometric_stiffness", prestress.geometric_stiffness, "axial forces stiffen stays and members")
        .number("prestress.minimum_pull", prestress.minimum_pull_N, "N", io::non_negative(), "no stay goes slack below it")
        .number("prestress.ridge", prestress.ridge, "", io::non_negative(), "weight of least pulls against zero displacement")
        .number("prestress.site_weight", prestress.site_weight, "", io::non_negative(),
                "weight of the pulls of elements.csv against zero displacement")
        .choice("prestress.displacements", prestress.displacements, {"linear", "large"},
                "equilibrium under dead load and pulls: in the geometry of nodes.csv, or in the deformed one")
        .boolean("prestress.shells_and_solids", prestress.shells_and_solids,
                 "the stresses of shells and solids stiffen and soften too")
        .text("prestress.load", prestress.load_case,
              "load case of loads.csv that acts beside dead load and pulls: forces, moments, movements of supports")
        .integer("prestress.load_steps", prestress.load_steps, {1.0, 1000.0},
                 "large displacements: dead load and pulls grow in so many equal steps")
        .texts("prestress.conditions", conditions, "displacements that the pulls should bring to zero: \"node:direction\"")
        .tables(
            "matrix_element", [this] { return matrix_elements.emplace_back().fields(); }, "elements given by their matrices")
        .tables(
            "parameter", [this] { return parameters.emplace_back().fields(); },
            "what may be updated, and between which bounds");
    return table;
  }
};

InputError key_error(const std::filesystem::path& file, const std::string& anchor, const std::string& key,
                     const std::string& problem, const std::string& mend) {
  return InputError({file.string(), line_of(file, anchor), key}, problem, mend);
}

fe::Parameter to_parameter(const std::filesystem::path& file, const fe::Model& model, const ElementParameter& entry) {
  const auto refuse = [&](const std::string& problem, const std::string& mend) {
    return parameter_error(file, entry.name, problem, mend);
  };
  fe::Parameter p = entry.parameter(file);
  p.target = entry.target;
  p.of = entry.of;
  if (p.of.empty())
    throw refuse("'of' is missing or empty", fmt::format("name the {} that it applies to", fe::kind_of(p.target)));
  const auto known = fe::names_of_target(model, p.target);
  for (const auto& name : p.of)
    if (position_of(name, known) < 0)
      throw refuse(fmt::format("no {} is called '{}'{}", fe::kind_of(p.target), name, did_you_mean(name, known)),
                   "'of' lists names of the model's own files");
  for (const auto& other : model.parameters)
    if (other.name == p.name) throw refuse("appears twice", "give each parameter a name of its own");
  return p;
}

fe::Prestress::Condition to_condition(const std::filesystem::path& file, const NameIndex& index, const std::string& text) {
  const auto [node, dof] = index.displacement(text);
  if (node < 0 || dof < 0 || dof > 2)
    throw key_error(
        file, "\"" + text + "\"", "prestress.conditions",
        fmt::format("'{}' is no displacement of a node of nodes.csv, expected \"node:direction\" with direction x, y or z",
                    text),
        "write for example \"17:z\"");
  return {node, dof};
}

/// The rows of loads.csv that are of the load case `name`, beside `file`.
std::vector<fe::Prestress::Load> loads_of_case(const std::filesystem::path& file, const NameIndex& index,
                                               const std::string& name) {
  std::vector<fe::Prestress::Load> loads;
  for (const LoadEntry& entry : read_load_cases(file.parent_path())) {
    if (entry.load != name) continue;
    const auto [node, dof] = index.displacement(entry.node + ":" + direction_names()[fe::slot(entry.direction)]);
    if (node < 0)
      throw InputError({(file.parent_path() / "loads.csv").string(), entry.line, "node"},
                       fmt::format("'{}' is no node of the model", entry.node), "name a node of nodes.csv");
    loads.push_back({node, dof, entry.value, entry.kind == LoadEntry::Kind::movement});
  }
  if (loads.empty())
    throw key_error(file, "\"" + name + "\"", "prestress.load",
                    fmt::format("no load case of loads.csv is called '{}'{}", name,
                                did_you_mean(name, load_case_names(file.parent_path()))),
                    "name a load case of the model folder's loads.csv");
  return loads;
}

std::string text_list(const std::vector<std::string>& texts) {
  return fmt::format("[{}]", fmt::join(each_of(texts, io::toml_text), ", "));
}

fe::MatrixElement to_matrix_element(const std::filesystem::path& folder, const NameIndex& index,
                                    const MatrixElementEntry& entry) {
  fe::MatrixElement element;
  const auto error = [&](const std::string& anchor, const std::string& problem, const std::string& mend) {
    return key_error(folder / "model.toml", "\"" + anchor + "\"", "matrix_element " + entry.name, problem, mend);
  };
  element.name = entry.name;
  element.group = entry.group;
  element.internal = entry.internal;
  for (const std::string& text : entry.dofs) {
    const auto [node, direction] = index.displacement(text);
    if (node < 0 || direction < 0)
      throw error(text,
                  fmt::format("'{}' is no degree of freedom of a node of nodes.csv, expected \"node:direction\" with {}", text,
                              one_of(direction_names())),
                  "write for example \"17:z\"");
    element.dofs.push_back({node, direction});
  }
  if (element.dofs.empty())
    throw error(entry.name, "'dofs' is missing or empty", "list the degrees of freedom that it acts on");
  const Eigen::Index n = std::ssize(element.dofs) + element.internal;
  const auto read = [&](const std::string& file) -> Eigen::MatrixXd {
    if (file.empty()) return {};
    if (const Eigen::Index rows = matrix_io::matrix_market_size(folder / file).rows; rows != n)
      throw error(file,
                  fmt::format("{} holds a {} x {} matrix, expected {} x {}: {} degrees of freedom and {} unknowns of its own",
                              file, rows, rows, n, n, element.dofs.size(), element.internal),
                  "mend the size, or list the degrees of freedom that belong to it");
    return matrix_io::read_square_matrix(folder / file);
  };
  element.stiffness = read(entry.stiffness);
  element.damping = read(entry.damping);
  element.mass = read(entry.mass);
  return element;
}

/// "17:z"
std::string displacement_name(const fe::Model& model, int node, int direction) {
  return fmt::format("{}:{}", model.nodes[fe::slot(node)].id, direction_names()[fe::slot(direction)]);
}

/// The tables of model.toml; the matrices are written to matrices/<name>_K.mtx, _C.mtx, _M.mtx.
std::string write_matrix_elements(const fe::Model& model, const std::filesystem::path& folder) {
  std::string text;
  if (!model.matrix_elements.empty()) std::filesystem::create_directories(folder / "matrices");
  for (const fe::MatrixElement& element : model.matrix_elements) {
    io::check_path_name(element.name, "matrix element", {model.source, 0, "matrix_element"});
    const auto dofs = each_of(element.dofs, [&](const auto& dof) { return displacement_name(model, dof.node, dof.direction); });
    text += fmt::format("\n[[matrix_element]]\nname = {}\ngroup = {}\ndofs = {}\ninternal = {}\n", io::toml_text(element.name),
                        io::toml_text(element.group), text_list(dofs), element.internal);
    const auto write = [&](const Eigen::MatrixXd& matrix, const char* key, const char* letter) {
      if (matrix.size() == 0) return;
      const std::string file = fmt::format("matrices/{}_{}.mtx", element.name, letter);
      matrix_io::write_square_matrix(matrix, folder / file);
      text += fmt::format("{} = \"{}\"\n", key, file);
    };
    write(element.stiffness, "stiffness", "K");
    write(element.damping, "damping", "C");
    write(element.mass, "mass", "M");
  }
  return text;
}

}  // namespace

std::string describe_model_toml() {
  fe::Model model;
  return ModelEntry{}.fields(model).describe();
}

void read_model_toml(const std::filesystem::path& file, fe::Model& model,
                     const std::function<void(io::FieldTable&)>& add_keys) {
  NameIndex index;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) index.nodes.emplace(model.nodes[i].id, static_cast<int>(i));
  ModelEntry entry;
  for (std::size_t i = 0; i < 3; ++i) entry.gravity_direction[i] = model.gravity_direction[static_cast<int>(i)];
  const std::string own_case = model.prestress.load_case;  // of a deck, whose loads are read already
  io::FieldTable table = entry.fields(model);
  if (add_keys) add_keys(table);
  table.load(file);
  for (std::size_t i = 0; i < 3; ++i) model.gravity_direction[static_cast<int>(i)] = entry.gravity_direction[i];
  if (const std::string& load = model.prestress.load_case; load != own_case)
    model.prestress.loads = loads_of_case(file, index, load);
  for (const auto& element : entry.matrix_elements)
    model.matrix_elements.push_back(to_matrix_element(file.parent_path(), index, element));
  for (const auto& text : entry.conditions) model.prestress.conditions.push_back(to_condition(file, index, text));
  for (const auto& parameter : entry.parameters) model.parameters.push_back(to_parameter(file, model, parameter));
}

void write_model_toml(const fe::Model& model, const std::filesystem::path& folder) {
  const auto number = [](double value) { return io::format_number(value); };
  std::string text = "# SI units throughout; see nodes.csv, elements.csv and their neighbours for the parts.\n";
  text += fmt::format("title = {}\ngravity = {}\n", io::toml_text(model.title), number(model.gravity_m_s2));
  if (const Eigen::Vector3d& down = model.gravity_direction; down != fe::Model{}.gravity_direction)
    text += fmt::format("gravity_direction = [{}, {}, {}]\n", number(down[0]), number(down[1]), number(down[2]));
  text += "\n";
  // Bound by position: a field that is added to the struct does not compile here until it is written too.
  const auto& [shear, beam_rotary, shell_rotary, drilling, factor, lumped] = model.formulation;
  text += fmt::format(
      "[formulation]\nshear_flexible = {}\nbeam_rotary_inertia = {}\nshell_rotary_inertia = {}\ndrilling = \"{}\"\n"
      "drilling_factor = {}\nlumped_mass = {}\n\n",
      shear, beam_rotary, shell_rotary, drilling == fe::Formulation::Drilling::penalty ? "penalty" : "diagonal", number(factor),
      lumped);
  const auto& p = model.prestress;
  const auto conditions = each_of(p.conditions, [&](const auto& c) { return displacement_name(model, c.node, c.dof); });
  text += fmt::format(
      "[prestress]\nrule = \"{}\"\ngeometric_stiffness = {}\nminimum_pull = {}\nridge = {}\nsite_weight = {}\ndisplacements = "
      "\"{}\"\nload_steps = {}\nconditions = {}\n",
      pull_rule_names()[static_cast<std::size_t>(p.rule)], p.geometric_stiffness, number(p.minimum_pull_N), number(p.ridge),
      number(p.site_weight), p.displacements == fe::Displacements::large ? "large" : "linear", p.load_steps,
      text_list(conditions));
  if (p.shells_and_solids) text += "shells_and_solids = true\n";
  if (!p.loads.empty()) text += fmt::format("load = {}\n", io::toml_text(p.load_case));
  text += write_matrix_elements(model, folder);
  for (const auto& q : model.parameters) {
    TWINDECK_ASSERT(static_cast<std::size_t>(q.target) < target_names().size());
    text += fmt::format("\n[[parameter]]\nname = {}\ntarget = \"{}\"\nof = {}\n", io::toml_text(q.name),
                        target_names()[static_cast<std::size_t>(q.target)], text_list(q.of)) +
            parameter_lines(q, io::format_number);
  }
  io::write_file_atomically(folder / "model.toml", text);
}

}  // namespace twindeck::model_io
