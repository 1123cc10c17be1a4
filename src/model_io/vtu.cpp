#include "model_io/vtu.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/error.hpp"
#include "io/atomic.hpp"
#include "model_io/names.hpp"

/// VTK XML unstructured grid in ASCII ("VTK File Formats", chapter 19 of the VTK User's Guide): opens in ParaView as it is, and
/// a text tool can compare two of them.
namespace twindeck::model_io {
namespace {

/// VTK_LINE, VTK_TRIANGLE, VTK_QUAD, VTK_TETRA, VTK_HEXAHEDRON, and the two solids with nodes on edges, VTK_QUADRATIC_TETRA and
/// VTK_QUADRATIC_HEXAHEDRON: nodes in the order of the model's.
int vtk_cell(const fe::Element& e) {
  const std::size_t nodes = e.nodes.size();
  if (nodes == 4) return e.type == fe::ElementType::solid ? 10 : 9;
  return nodes == 20 ? 25 : nodes == 10 ? 24 : nodes == 8 ? 12 : nodes == 3 ? 5 : 3;
}

/// One DataArray; `body` is its text.
std::string data_array(const std::string& type, const std::string& name, int components, const std::string& body) {
  std::string attributes = components > 1 ? fmt::format(" NumberOfComponents=\"{}\"", components) : "";
  return fmt::format("<DataArray type=\"{}\" Name=\"{}\"{} format=\"ascii\">\n{}</DataArray>\n", type, name, attributes, body);
}

template <class Range, class Text>
std::string lines(const Range& range, Text text) {
  std::string body;
  for (const auto& item : range) {
    body += text(item);
    body += '\n';
  }
  return body;
}

/// Names behind the numbers of the cell fields, for people: an XML comment, since readers other than VTK's own (meshio) refuse
/// string arrays.
std::string names_comment(const std::string& field, const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) text += fmt::format("{}{} {}", i == 0 ? "" : ", ", i, names[i]);
  // "--" and tags must not stand in a comment
  for (std::size_t i = 0; i + 1 < text.size(); ++i)
    if (text[i] == '-' && text[i + 1] == '-') text[i + 1] = '_';
  std::ranges::replace(text, '<', '(');
  std::ranges::replace(text, '>', ')');
  return fmt::format("<!-- {}: {} -->\n", field, text);
}

/// Groups in alphabetical order, so that the numbers do not depend on the order of the elements.
std::map<std::string, int> number_groups(const fe::Model& model) {
  std::map<std::string, int> groups;
  for (const auto& e : model.elements) groups.emplace(e.group, 0);
  int next = 0;
  for (auto& [name, number] : groups) number = next++;
  return groups;
}

std::string field_data(const fe::Model& model, const std::map<std::string, int>& groups, const dynamics::EigenModes& modes) {
  std::vector<std::string> names;
  for (const auto& [name, number] : groups) names.push_back(name.empty() ? "(none)" : name);
  const std::vector<double> frequencies(modes.frequency_Hz.data(), modes.frequency_Hz.data() + modes.frequency_Hz.size());
  return names_comment("title", {model.title}) + names_comment("group", names) + names_comment("type", element_type_names()) +
         "<FieldData>\n" +
         fmt::format(
             "<DataArray type=\"Float64\" Name=\"frequency_Hz\" NumberOfTuples=\"{}\" format=\"ascii\">\n{}</DataArray>\n",
             frequencies.size(), lines(frequencies, [](double f) { return fmt::format("{:.12g}", f); })) +
         "</FieldData>\n";
}

/// Translations of one mode at every node, scaled so that the longest vector has length 1 and its largest component is
/// positive.
std::string mode_vectors(const Eigen::Ref<const Eigen::VectorXd>& full) {
  const Eigen::Index nodes = full.size() / 6;
  const Eigen::Matrix<double, 6, Eigen::Dynamic> at =
      Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>>(full.data(), 6, nodes);
  const double longest = at.topRows(3).colwise().norm().maxCoeff();
  const double scale = longest > 0.0 ? 1.0 / longest : 1.0;
  std::string body;
  for (Eigen::Index i = 0; i < nodes; ++i)
    fmt::format_to(std::back_inserter(body), "{:.7g} {:.7g} {:.7g}\n", scale * at(0, i), scale * at(1, i), scale * at(2, i));
  return body;
}

std::string points_and_cells(const fe::Model& model) {
  long offset = 0;
  const auto& elements = model.elements;
  const auto connectivity = [](const fe::Element& e) { return fmt::format("{}", fmt::join(e.nodes, " ")); };
  return "<Points>\n" +
         data_array(
             "Float64", "Points", 3,
             lines(model.nodes,
                   [](const fe::Node& n) { return fmt::format("{:.12g} {:.12g} {:.12g}", n.x_m.x(), n.x_m.y(), n.x_m.z()); })) +
         "</Points>\n<Cells>\n" + data_array("Int64", "connectivity", 1, lines(elements, connectivity)) +
         data_array(
             "Int64", "offsets", 1,
             lines(elements, [&offset](const fe::Element& e) { return std::to_string(offset += std::ssize(e.nodes)); })) +
         data_array("UInt8", "types", 1, lines(elements, [](const fe::Element& e) { return std::to_string(vtk_cell(e)); })) +
         "</Cells>\n";
}

}  // namespace

void write_vtu(const fe::Model& model, const fe::ParametricSystem& system, const dynamics::EigenModes& modes,
               const std::filesystem::path& file) {
  const Eigen::MatrixXd full = system.expand(modes.shapes);
  TWINDECK_ASSERT(full.rows() == 6 * std::ssize(model.nodes));
  const auto groups = number_groups(model);
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n";
  text += field_data(model, groups, modes);
  text += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<PointData>\n", model.nodes.size(),
                      model.elements.size());
  text += data_array("Int64", "node", 1, lines(model.nodes, [](const fe::Node& n) { return std::to_string(n.id); }));
  for (Eigen::Index mode = 0; mode < full.cols(); ++mode)
    text += data_array("Float64", fmt::format("mode_{:02d}_{:.4f}_Hz", mode + 1, modes.frequency_Hz[mode]), 3,
                       mode_vectors(full.col(mode)));
  text += "</PointData>\n<CellData>\n";
  text += data_array("Int64", "element", 1, lines(model.elements, [](const fe::Element& e) { return std::to_string(e.id); }));
  text += data_array("Int32", "group", 1,
                     lines(model.elements, [&](const fe::Element& e) { return std::to_string(groups.at(e.group)); }));
  text += data_array("Int32", "type", 1,
                     lines(model.elements, [](const fe::Element& e) { return std::to_string(static_cast<int>(e.type)); }));
  text += "</CellData>\n" + points_and_cells(model) + "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  io::write_file_atomically(file, text);
}

}  // namespace twindeck::model_io
