#include <cmath>
#include <optional>

#include "io/csv.hpp"
#include "model_io/export.hpp"
#include "model_io/matrix_market.hpp"
#include "model_io/names.hpp"

namespace twindeck::model_io {

void write_dofs(const fe::ParametricSystem& system, const std::filesystem::path& folder) {
  const auto known = [](double x) { return std::isfinite(x) ? std::optional<double>(x) : std::nullopt; };
  io::CsvWriter dofs({"dof", "node", "direction", "x_m", "y_m", "z_m"});
  for (std::size_t i = 0; i < system.dofs.size(); ++i) {
    const auto& dof = system.dofs[i];
    dofs.row({i + 1, dof.node, direction_names()[static_cast<std::size_t>(dof.direction)], known(dof.x_m.x()),
              known(dof.x_m.y()), known(dof.x_m.z())});
  }
  dofs.save(folder / "dofs.csv");
}

void write_matrices(const fe::ParametricSystem& system, const Eigen::VectorXd& theta, const std::filesystem::path& folder) {
  write_matrix_market(system.stiffness(theta), folder / "K.mtx");
  write_matrix_market(system.mass(theta), folder / "M.mtx");
  write_dofs(system, folder);
}

}  // namespace twindeck::model_io
