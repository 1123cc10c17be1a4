#include "steps/model/exports.hpp"

#include <fmt/format.h>

#include <map>
#include <numeric>
#include <string>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "model_io/export_matrices.hpp"
#include "model_io/inp.hpp"
#include "records/universal.hpp"
#include "records/write_universal.hpp"

namespace twindeck::steps {

namespace {

using Eigen::Index;

/// The number of the kind of element in set 2412.
long descriptor_of(const fe::Element& element) {
  if (element.type == fe::ElementType::beam) return 21;
  if (element.type == fe::ElementType::bar || element.type == fe::ElementType::stay) return 11;
  if (element.type == fe::ElementType::shell) return element.nodes.size() == 3 ? 91 : 94;
  constexpr long tetrahedron = 111, hexahedron = 115, of_ten = 118, of_twenty = 116;
  const std::size_t nodes = element.nodes.size();
  return nodes == 4 ? tetrahedron : nodes == 8 ? hexahedron : nodes == 10 ? of_ten : of_twenty;
}

/// Positions of the nodes in the order of set 2412: bottom with the nodes on its edges, then the nodes between, then the top.
std::vector<std::size_t> order_of(std::size_t nodes) {
  if (nodes == 10) return {0, 4, 1, 5, 2, 6, 7, 8, 9, 3};
  if (nodes == 20) return {0, 8, 1, 9, 2, 10, 3, 11, 16, 17, 18, 19, 4, 12, 5, 13, 6, 14, 7, 15};
  std::vector<std::size_t> order(nodes);
  std::iota(order.begin(), order.end(), 0U);
  return order;
}

void add_mesh(const fe::Model& model, records::UniversalData& universal) {
  std::map<std::string, std::vector<long>> lines;  // members of each group, separated by 0
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

void export_inp(const dynamics::LoadedModel& loaded, int n_modes, const runner::StepContext& context) {
  if (loaded.fe_model() == nullptr)
    throw InputError({"command line", 0, "--export-inp"}, "a matrix model has no elements to export", "use --export-matrices");
  const auto write = [&](model_io::InpFlavour flavour, const char* file) {
    return model_io::write_inp(*loaded.model, loaded.state, flavour, n_modes, context.out / file);
  };
  const auto calculix = write(model_io::InpFlavour::calculix, "model.inp");
  const auto abaqus = write(model_io::InpFlavour::abaqus, "model_abaqus.inp");
  for (const std::string& note : calculix)
    context.say((contains(abaqus, note) ? "model.inp, model_abaqus.inp: " : "model.inp: ") + note);
  for (const std::string& note : abaqus)
    if (!contains(calculix, note)) context.say("model_abaqus.inp: " + note);
}

/// Nodes (set 2411), elements (2412), a trace line a group of beams and bars (82), and each mode's translations (55),
/// mass-normalised.
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

}  // namespace

std::vector<runner::Flag> export_flags() {
  return {{"export-matrices", false,
           "also write K.mtx, M.mtx, dofs.csv of the state whose modes are in modes.csv, and C.mtx where there are dampers"},
          {"export-inp", false, "also write the model for CalculiX (model.inp) and Abaqus (model_abaqus.inp)"},
          {"export-unv", false, "also write mesh and modes as a universal file, model.unv (sets 2411, 2412, 82, 55)"}};
}

void write_exports(const dynamics::LoadedModel& loaded, const dynamics::EigenModes& modes, int n_modes,
                   const runner::StepContext& context) {
  if (context.has_flag("export-matrices")) {
    model_io::write_matrices(loaded.system, loaded.theta, context.out);
    if (const fe::Model* model = loaded.fe_model(); model != nullptr)
      model_io::write_damping(*model, loaded.system, loaded.theta, context.out);
  }
  if (context.has_flag("export-inp")) export_inp(loaded, n_modes, context);
  if (context.has_flag("export-unv")) export_unv(loaded, modes, context);
}

}  // namespace twindeck::steps
