#include "model_io/write_matrix_model.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "io/atomic.hpp"
#include "io/toml_value.hpp"
#include "matrix_io/matrix_market.hpp"
#include "model_io/export_matrices.hpp"
#include "model_io/folder_parts.hpp"

namespace twindeck::model_io {
namespace {

/// A(theta) = constant + sum_p theta_p slope_p, the tangent at theta0; exact where every coefficient is linear in one
/// parameter.
struct Decomposition {
  linalg::SparseMatrix constant;
  std::vector<linalg::SparseMatrix> slope;  ///< one a parameter, all zero where the matrix does not depend on it
};

void add(const fe::Term& term, double factor, linalg::SparseMatrix& matrix) {
  if (factor == 0.0) return;
  for (std::size_t i = 0; i < term.position.size(); ++i) matrix.valuePtr()[term.position[i]] += factor * term.value[i];
}

Decomposition decompose(const fe::ParametricSystem& system, const std::vector<fe::Term>& terms) {
  const Eigen::VectorXd theta0 = system.initial();
  linalg::SparseMatrix zero = system.pattern;
  std::fill_n(zero.valuePtr(), zero.nonZeros(), 0.0);
  Decomposition result{zero, std::vector<linalg::SparseMatrix>(system.parameters.size(), zero)};
  for (const auto& term : terms) {
    const double value = term.coefficient.value(theta0);
    double rest = value;
    for (std::size_t p = 0; p < system.parameters.size(); ++p) {
      const double slope = term.coefficient.derivative(theta0, static_cast<int>(p));
      add(term, slope, result.slope[p]);
      rest -= slope * theta0[static_cast<Eigen::Index>(p)];
    }
    // A coefficient that is linear leaves nothing behind but rounding.
    if (std::abs(rest) > 1e-13 * std::abs(value)) add(term, rest, result.constant);
  }
  return result;
}

bool is_zero(const linalg::SparseMatrix& matrix) {
  for (Eigen::Index i = 0; i < matrix.nonZeros(); ++i) {
    if (matrix.valuePtr()[i] != 0.0) return false;
  }
  return true;
}

std::string parameter_text(const fe::Parameter& p, const std::string& matrix, const char* target) {
  std::string text = fmt::format("\n[[parameter]]\nname = {}\nmatrix = {}\ntarget = \"{}\"\n", io::toml_text(p.name),
                                 io::toml_text(matrix), target);
  if (p.of.size() == 1 && p.of[0] != p.name) text += fmt::format("group = {}\n", io::toml_text(p.of[0]));
  // Shortest decimal form that reads back to the same bits: these numbers multiply matrices of 17 digits.
  return text + fmt::format("unit = {}\ninitial = {}\nlower = {}\nupper = {}\n", io::toml_text(p.unit),
                            io::toml_number(p.initial), io::toml_number(p.lower), io::toml_number(p.upper));
}

}  // namespace

void write_matrix_model(const fe::ParametricSystem& system, const std::filesystem::path& folder) {
  write_dofs(system, folder);
  const Decomposition stiffness = decompose(system, system.stiffness_terms);
  const Decomposition mass = decompose(system, system.mass_terms);
  matrix_io::write_matrix_market(stiffness.constant, folder / "K0.mtx");
  matrix_io::write_matrix_market(mass.constant, folder / "M0.mtx");
  std::string text =
      "# K = K0 + sum theta_i K_i, M = M0 + sum theta_j M_j; rows in the order of dofs.csv\n"
      "[matrices]\nK = \"K0.mtx\"\nM = \"M0.mtx\"\n";
  for (std::size_t p = 0; p < system.parameters.size(); ++p) {
    const auto& parameter = system.parameters[p];
    const bool in_mass = !is_zero(mass.slope[p]);
    if (!is_zero(stiffness.slope[p]) || !in_mass) {
      const std::string file = fmt::format("K{}.mtx", p + 1);
      matrix_io::write_matrix_market(stiffness.slope[p], folder / file);
      text += parameter_text(parameter, file, "stiffness");
    }
    if (in_mass) {
      const std::string file = fmt::format("M{}.mtx", p + 1);
      matrix_io::write_matrix_market(mass.slope[p], folder / file);
      text += parameter_text(parameter, file, "mass");
    }
  }
  io::write_file_atomically(folder / "model.toml", text);
}

}  // namespace twindeck::model_io
