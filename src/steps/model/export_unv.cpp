#include "steps/model/export_unv.hpp"

#include <fmt/format.h>

#include <map>
#include <numeric>
#include <vector>

#include "core/error.hpp"
#include "records/universal.hpp"
#include "records/write_universal.hpp"

namespace twindeck::steps {

namespace {

using Eigen::Index;

/// The number of the kind of element in set 2412.
long descriptor_of(const fe::Element& element) {
  switch (element.type) {
    case fe::ElementType::beam:
      return 21;
    case fe::ElementType::bar:
    case fe::ElementType::stay:
      return 11;
    case fe::ElementType::shell:
      return element.nodes.size() == 3 ? 91 : 94;
    case fe::ElementType::solid:
      break;
  }
  constexpr long tetrahedron = 111, hexahedron = 115, of_ten = 118, of_twenty = 116;
  const std::size_t nodes = element.nodes.size();
  return nodes == 4 ? tetrahedron : nodes == 8 ? hexahedron : nodes == 10 ? of_ten : of_twenty;
}

/// Positions of the nodes in the order of set 2412: round the bottom with the nodes on its edges, those between, the top.
std::vector<std::size_t> order_of(std::size_t nodes) {
  if (nodes == 10) return {0, 4, 1, 5, 2, 6, 7, 8, 9, 3};
  if (nodes == 20) return {0, 8, 1, 9, 2, 10, 3, 11, 16, 17, 18, 19, 4, 12, 5, 13, 6, 14, 7, 15};
  std::vector<std::size_t> order(nodes);
  std::iota(order.begin(), order.end(), 0U);
  return order;
}

void add_mesh(const fe::Model& model, records::UniversalData& universal) {
  std::map<std::string, std::vector<long>> lines;  // of each group, its members parted by 0
  for (const fe::Node& node : model.nodes) universal.nodes[node.id] = node.x_m;
  for (const fe::Element& element : model.elements) {
    records::UniversalElement written{element.id, descriptor_of(element), {}};
    for (const std::size_t i : order_of(element.nodes.size()))
      written.nodes.push_back(model.nodes[static_cast<std::size_t>(element.nodes[i])].id);
    if (records::is_beam(written.descriptor)) {
      std::vector<long>& line = lines[element.group];
      if (!line.empty()) line.push_back(0);
      line.insert(line.end(), written.nodes.begin(), written.nodes.end());
    }
    universal.elements.push_back(std::move(written));
  }
  for (const auto& [group, line] : lines) universal.lines.push_back(line);
}

}  // namespace

void export_unv(const dynamics::LoadedModel& loaded, const dynamics::EigenModes& modes, const runner::StepContext& context) {
  const fe::Model* model = loaded.fe_model();
  if (model == nullptr)
    throw InputError({"command line", 0, "--export-unv"}, "a matrix model has no elements to export", "use --export-matrices");
  records::UniversalData universal;
  universal.title = model->title;
  add_mesh(*model, universal);
  const Eigen::MatrixXd full = loaded.system.expand(modes.shapes);
  constexpr Index directions = 6;  // of a node; the first three are translations
  for (Index m = 0; m < modes.frequency_Hz.size(); ++m) {
    records::NodalResult shape;
    shape.title = fmt::format("mode {}, {:.6g} Hz", m + 1, modes.frequency_Hz[m]);
    shape.mode = static_cast<int>(m) + 1;
    shape.frequency_Hz = modes.frequency_Hz[m];
    for (std::size_t i = 0; i < model->nodes.size(); ++i)
      shape.values[model->nodes[i].id] =
          full.col(m).segment<3>(directions * static_cast<Index>(i)).cast<std::complex<double>>();
    universal.results.push_back(std::move(shape));
  }
  records::write_universal(universal, context.out / "model.unv");
}

}  // namespace twindeck::steps
