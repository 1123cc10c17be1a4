#include "steps/model/mesh_convergence.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/csv.hpp"
#include "matching/solved_model.hpp"
#include "ponte/generator.hpp"

namespace twindeck::steps {

void refuse_unknown_meshes(const runner::Study& study, const std::string& variant, const std::vector<std::string>& meshes) {
  for (const std::string& mesh : meshes) static_cast<void>(ponte::generate(study.model_file, variant, mesh));
}

void write_mesh_convergence(const runner::Study& study, const std::string& variant, const std::vector<std::string>& meshes,
                            int n_modes, const std::filesystem::path& file) {
  constexpr int beyond = 5;  // solved for beyond the modes shown, so that one that moves up is among them
  const auto solved = [&](const std::string& mesh) {
    return matching::solve_modes(dynamics::from_model(ponte::generate(study.model_file, variant, mesh)), n_modes + beyond);
  };
  const matching::SolvedModel own = solved(study.model_mesh);
  io::CsvWriter csv({"mesh", "degrees_of_freedom", "mode", "frequency_Hz", "change_pct", "mac"});
  const auto known = [](double value) { return std::isnan(value) ? std::nullopt : std::optional<double>(value); };
  const auto write = [&](const std::string& mesh, const matching::SolvedModel& model) {
    const Eigen::Index count = std::min<Eigen::Index>(n_modes, own.modes.frequency_Hz.size());  // a small model may have fewer
    const matching::TrackedModes followed = follow(own, model, count);
    for (Eigen::Index i = 0; i < count; ++i) {
      csv.row({mesh, static_cast<long>(model.loaded.system.size()), static_cast<long>(i + 1), known(followed.frequency_Hz[i]),
               known(100.0 * (followed.frequency_Hz[i] / own.modes.frequency_Hz[i] - 1.0)), known(followed.mac[i])});
    }
  };
  write(study.model_mesh, own);
  for (const std::string& mesh : meshes) write(mesh, solved(mesh));
  csv.save(file);
}

}  // namespace twindeck::steps
