#include "steps/model/model_tables.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "io/csv.hpp"
#include "matching/measured.hpp"
#include "matching/solved_model.hpp"
#include "model_io/names.hpp"
#include "ponte/generator.hpp"

namespace twindeck::steps {

namespace {

std::string stay_name(const fe::Element& element) { return element.name.empty() ? std::to_string(element.id) : element.name; }

/// Number of nodes, elements of each type and springs of a part.
struct PartCount {
  std::set<int> nodes;
  std::map<std::string, std::size_t> pieces;
};

const char* arrangement_of(const fe::Spring& spring) {
  if (spring.stiffness == 0.0) return "viscous";
  return spring.series ? "series" : "parallel";
}

void write_stays(const fe::Model* model, const fe::PrestressState& state, const std::filesystem::path& folder) {
  io::CsvWriter stays(
      {"stay", "group", "length_m", "pull_N", "site_pull_N", "stress_Pa", "equivalent_modulus_Pa", "deviation_from_site_pct"});
  for (std::size_t i = 0; model != nullptr && i < model->elements.size(); ++i) {
    const fe::Element& e = model->elements[i];
    if (e.type != fe::ElementType::stay) continue;
    const Eigen::Vector3d chord =
        model->nodes[static_cast<std::size_t>(e.nodes[1])].x_m - model->nodes[static_cast<std::size_t>(e.nodes[0])].x_m;
    const fe::Material& material = model->materials[static_cast<std::size_t>(e.material)];
    const auto at = static_cast<Eigen::Index>(i);
    const double pull = state.stay_pull_N.size() > at ? state.stay_pull_N[at] : 0.0;
    const double stress = pull / model->sections[static_cast<std::size_t>(e.section)].area_m2;
    const fe::Dischinger law{material.density_kg_m3 * model->gravity_m_s2, chord.head<2>().norm(), stress};
    // Without pull the model has no sag either, and the stay has the modulus of its material.
    const double modulus = stress > 0.0 ? law.modulus(material.youngs_modulus_Pa) : material.youngs_modulus_Pa;
    const auto where_measured = [&](double value) { return e.pull_N > 0.0 ? std::optional<double>(value) : std::nullopt; };
    stays.row({stay_name(e), e.group, chord.norm(), pull, where_measured(e.pull_N), stress, modulus,
               where_measured(100.0 * (pull / e.pull_N - 1.0))});
  }
  stays.save(folder / "stays.csv");
}

void write_member_forces(const fe::Model* model, const fe::PrestressState& state, const std::filesystem::path& folder) {
  io::CsvWriter members({"element", "group", "x_m", "y_m", "z_m", "length_m", "axial_force_N"});
  for (std::size_t i = 0; model != nullptr && i < model->elements.size(); ++i) {
    const fe::Element& e = model->elements[i];
    if (e.type != fe::ElementType::beam && e.type != fe::ElementType::bar) continue;
    const auto end = [&](std::size_t k) -> Eigen::Vector3d {
      return model->nodes[static_cast<std::size_t>(e.nodes[k])].x_m + e.offset_m[k];
    };
    const Eigen::Vector3d middle = 0.5 * (end(0) + end(1));
    const auto at = static_cast<Eigen::Index>(i);
    const double force = state.axial_force_N.size() > at ? state.axial_force_N[at] : 0.0;
    members.row({e.id, e.group, middle.x(), middle.y(), middle.z(), (end(1) - end(0)).norm(), force});
  }
  members.save(folder / "member_forces.csv");
}

void write_dampers(const fe::Model* model, const std::filesystem::path& folder) {
  io::CsvWriter dampers({"damper", "group", "damping_N_s_m", "stiffness_N_m", "arrangement"});
  if (model != nullptr)
    for (const auto& s : model->springs)
      if (s.group.starts_with("damper")) dampers.row({s.name, s.group, s.damping, s.stiffness, arrangement_of(s)});
  dampers.save(folder / "dampers.csv");
}

void write_summary(const fe::Model* model, const fe::ParametricSystem& system, const PartOf& part_of,
                   const std::filesystem::path& folder) {
  io::CsvWriter summary({"quantity", "value", "unit"});
  const auto count = [&](const std::string& quantity, std::size_t value) {
    summary.row({quantity, static_cast<long>(value), "-"});
  };
  count("degrees_of_freedom", static_cast<std::size_t>(system.size()));
  count("parameters", system.parameters.size());
  if (model == nullptr) {
    std::set<std::string> nodes;
    for (const auto& dof : system.dofs) nodes.insert(dof.node);
    count("nodes", nodes.size());
    summary.save(folder / "summary.csv");
    return;
  }
  const std::vector<std::string>& types = model_io::element_type_names();
  std::vector<std::size_t> of_type(types.size(), 0);
  std::map<std::string, PartCount> parts;
  for (const fe::Element& e : model->elements) {
    const auto type = static_cast<std::size_t>(e.type);
    ++of_type[type];
    if (!part_of) continue;
    PartCount& part = parts[part_of(e.group)];
    part.nodes.insert(e.nodes.begin(), e.nodes.end());
    ++part.pieces[types[type] + "s"];
  }
  if (part_of)
    for (const fe::Spring& spring : model->springs) ++parts[part_of(spring.group)].pieces["springs"];
  count("nodes", model->nodes.size());
  count("elements", model->elements.size());
  for (std::size_t type = 0; type < types.size(); ++type) count(types[type] + "s", of_type[type]);
  count("springs", model->springs.size());
  count("rigid_links", model->links.size());
  if (!model->constraints.empty()) count("constraints", model->constraints.size());
  count("point_masses", model->masses.size());
  for (const auto& [name, part] : parts) {
    if (!part.nodes.empty()) count("nodes_" + name, part.nodes.size());
    for (const auto& [kind, number] : part.pieces) count(kind + "_" + name, number);
  }
  summary.save(folder / "summary.csv");
}

}  // namespace

void write_model_tables(const dynamics::LoadedModel& loaded, const PartOf& part_of, const std::filesystem::path& folder) {
  const fe::Model* model = loaded.fe_model();
  write_stays(model, loaded.state, folder);
  write_member_forces(model, loaded.state, folder);
  write_dampers(model, folder);
  write_summary(model, loaded.system, part_of, folder);
}

void refuse_unknown_meshes(const runner::Study& study, const std::string& variant, const std::vector<std::string>& meshes) {
  for (const std::string& mesh : meshes) static_cast<void>(ponte::generate(study.model_file, variant, mesh));
}

void write_mesh_convergence(const runner::Study& study, const std::string& variant, const std::vector<std::string>& meshes,
                            int n_modes, const std::filesystem::path& file) {
  constexpr int beyond = 5;  // modes solved for above those shown, so that a mode that rises is still among them
  const auto solved = [&](const std::string& mesh) {
    return matching::solve_modes(dynamics::from_model(ponte::generate(study.model_file, variant, mesh)), n_modes + beyond);
  };
  const matching::SolvedModel own = solved(study.model_mesh);
  io::CsvWriter csv({"mesh", "degrees_of_freedom", "mode", "frequency_Hz", "change_pct", "mac"});
  using matching::known;
  const auto write = [&](const std::string& mesh, const matching::SolvedModel& model) {
    const Eigen::Index count = std::min<Eigen::Index>(n_modes, own.modes.frequency_Hz.size());  // a small model may have fewer
    const matching::TrackedModes followed = follow(own, model, count);
    for (Eigen::Index i = 0; i < count; ++i)
      csv.row({mesh, std::ssize(model.loaded.system), static_cast<long>(i + 1), known(followed.frequency_Hz[i]),
               known(100.0 * (followed.frequency_Hz[i] / own.modes.frequency_Hz[i] - 1.0)), known(followed.mac[i])});
  };
  write(study.model_mesh, own);
  for (const std::string& mesh : meshes) write(mesh, solved(mesh));
  csv.save(file);
}

}  // namespace twindeck::steps
