#include "model_io/matrix_elements.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "io/csv.hpp"
#include "io/path_name.hpp"
#include "io/toml_value.hpp"
#include "matrix_io/matrix_market.hpp"
#include "model_io/names.hpp"

namespace twindeck::model_io {

namespace {

InputError at(const std::filesystem::path& folder, const std::string& anchor, const std::string& name,
              const std::string& problem, const std::string& mend) {
  const auto file = folder / "model.toml";
  return InputError({file.string(), line_of(file, "\"" + anchor + "\""), "matrix_element " + name}, problem, mend);
}

}  // namespace

io::FieldTable MatrixElementEntry::fields() {
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

fe::MatrixElement to_matrix_element(const std::filesystem::path& folder, const NameIndex& index,
                                    const MatrixElementEntry& entry) {
  fe::MatrixElement element;
  element.name = entry.name;
  element.group = entry.group;
  element.internal = static_cast<int>(entry.internal);
  for (const std::string& text : entry.dofs) {
    const auto [node, direction] = index.displacement(text);
    if (node < 0 || direction < 0)
      throw at(folder, text, entry.name,
               fmt::format("'{}' is no degree of freedom of a node of nodes.csv, expected \"node:direction\" with {}", text,
                           one_of(direction_names())),
               "write for example \"17:z\"");
    element.dofs.push_back({node, direction});
  }
  if (element.dofs.empty())
    throw at(folder, entry.name, entry.name, "'dofs' is missing or empty", "list the degrees of freedom that it acts on");
  const Eigen::Index n = std::ssize(element.dofs) + element.internal;
  const auto read = [&](const std::string& file) -> Eigen::MatrixXd {
    if (file.empty()) return {};
    if (const Eigen::Index rows = matrix_io::matrix_market_size(folder / file).rows; rows != n)
      throw at(folder, file, entry.name,
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

std::string write_matrix_elements(const fe::Model& model, const std::filesystem::path& folder) {
  std::string text;
  if (!model.matrix_elements.empty()) std::filesystem::create_directories(folder / "matrices");
  for (const fe::MatrixElement& element : model.matrix_elements) {
    io::check_path_name(element.name, "matrix element", {model.source, 0, "matrix_element"});
    std::string dofs;
    for (const fe::MatrixElement::Dof& dof : element.dofs)
      dofs += fmt::format("{}\"{}:{}\"", dofs.empty() ? "" : ", ", model.nodes[static_cast<std::size_t>(dof.node)].id,
                          direction_names()[static_cast<std::size_t>(dof.direction)]);
    text += fmt::format("\n[[matrix_element]]\nname = {}\ngroup = {}\ndofs = [{}]\ninternal = {}\n",
                        io::toml_text(element.name), io::toml_text(element.group), dofs, element.internal);
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

}  // namespace twindeck::model_io
