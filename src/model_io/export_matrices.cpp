#include "model_io/export_matrices.hpp"

#include <cmath>
#include <optional>

#include "fe/dynamic_system.hpp"
#include "io/csv.hpp"
#include "matrix_io/matrix_market.hpp"
#include "model_io/names.hpp"

namespace twindeck::model_io {

namespace {

void save_dofs(const std::vector<fe::DofLabel>& labels, const std::vector<std::string>& own,
               const std::filesystem::path& file) {
  const auto known = [](double x) { return std::isfinite(x) ? std::optional<double>(x) : std::nullopt; };
  io::CsvWriter dofs({"dof", "node", "direction", "x_m", "y_m", "z_m"});
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const fe::DofLabel& dof = labels[i];
    dofs.row({i + 1, dof.node, direction_names()[fe::slot(dof.direction)], known(dof.x_m.x()), known(dof.x_m.y()),
              known(dof.x_m.z())});
  }
  for (std::size_t i = 0; i < own.size(); ++i)
    dofs.row({labels.size() + i + 1, own[i], "own", std::optional<double>(), std::optional<double>(), std::optional<double>()});
  dofs.save(file);
}

}  // namespace

void write_dofs(const fe::ParametricSystem& system, const std::filesystem::path& folder) {
  save_dofs(system.dofs, {}, folder / "dofs.csv");
}

void write_damping(const fe::Model& model, const fe::ParametricSystem& system, const Eigen::VectorXd& theta,
                   const std::filesystem::path& folder) {
  const fe::DynamicSystem dynamic = fe::assemble_dynamic(model, system, theta);
  if (dynamic.damping.nonZeros() == 0 || dynamic.damping.coeffs().isZero(0.0)) return;
  matrix_io::write_full_matrix_market(dynamic.damping, folder / "C.mtx");
  if (dynamic.own.empty()) return;
  matrix_io::write_full_matrix_market(dynamic.stiffness, folder / "K_damped.mtx");
  matrix_io::write_full_matrix_market(dynamic.mass, folder / "M_damped.mtx");
  save_dofs(dynamic.dofs, dynamic.own, folder / "dofs_damped.csv");
}

void write_matrices(const fe::ParametricSystem& system, const Eigen::VectorXd& theta, const std::filesystem::path& folder) {
  matrix_io::write_matrix_market(system.stiffness(theta), folder / "K.mtx");
  matrix_io::write_matrix_market(system.mass(theta), folder / "M.mtx");
  write_dofs(system, folder);
}

}  // namespace twindeck::model_io
