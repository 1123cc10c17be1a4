#include "model_io/matrix_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <set>

#include "core/error.hpp"
#include "io/atomic.hpp"
#include "io/config.hpp"
#include "io/csv.hpp"
#include "io/toml_value.hpp"
#include "matrix_io/matrix_market.hpp"
#include "matrix_io/op4.hpp"
#include "model_io/export_matrices.hpp"
#include "model_io/folder_parts.hpp"
#include "model_io/names.hpp"
#include "model_io/parameter_entry.hpp"

namespace twindeck::model_io {
namespace {

/// [[parameter]] of a matrix model: K gains theta · matrix (or M does).
struct MatrixParameter : ParameterEntry {
  std::string matrix, target = "stiffness", group;

  io::FieldTable fields() {
    unit = "-";
    io::FieldTable table;
    add_to(table);
    table.text("matrix", matrix, "file of K_i or M_i: Matrix Market, or .op4 of Nastran", true)
        .choice("target", target, {"stiffness", "mass"}, "which matrix the parameter adds to")
        .text("group", group, "name of what the parameter stands for (default: its own name)");
    return table;
  }
};

struct MatrixModelEntry {
  std::string title, stiffness, mass;
  std::deque<MatrixParameter> parameters;

  io::FieldTable fields() {
    io::FieldTable table;
    table.text("title", title, "what the model is")
        .text("matrices.K", stiffness, "file of K0: Matrix Market, or .op4 of Nastran", true)
        .text("matrices.M", mass, "file of M0: Matrix Market, or .op4 of Nastran", true)
        .tables(
            "parameter", [this] { return parameters.emplace_back().fields(); }, "K = K0 + sum theta_i K_i, M likewise");
    return table;
  }
};

std::vector<fe::DofLabel> read_dofs(const std::filesystem::path& folder) {
  const auto table = io::CsvTable::read(folder / "dofs.csv", {"dof", "node", "direction"}, {"x_m", "y_m", "z_m"});
  std::vector<fe::DofLabel> dofs;
  std::set<std::pair<std::string, int>> seen;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.integer(row, "dof") != static_cast<long>(row) + 1)
      table.fail(row, "dof", fmt::format("is {}, expected {}", table.text(row, "dof"), row + 1),
                 "rows stand in the order of the matrices and count from 1");
    fe::DofLabel dof;
    dof.node = table.text(row, "node");
    if (dof.node.empty()) table.fail(row, "node", "is empty", "name the node that the degree of freedom belongs to");
    const std::string direction = table.text(row, "direction");
    dof.direction = position_of(direction, direction_names());
    if (dof.direction < 0)
      table.fail(row, "direction", fmt::format("unknown direction '{}'", direction), "use " + one_of(direction_names()));
    if (!seen.emplace(dof.node, dof.direction).second)
      table.fail(row, "direction", fmt::format("node {} has direction {} twice", dof.node, direction), "each may appear once");
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    dof.x_m = {table.number_or(row, "x_m", unknown), table.number_or(row, "y_m", unknown),
               table.number_or(row, "z_m", unknown)};
    dofs.push_back(dof);
  }
  if (dofs.empty()) throw InputError({table.file().string(), 0, ""}, "holds no degree of freedom", "give each one a row");
  return dofs;
}

/// Position of the parameter in the system; a name may stand once for the stiffness and once for the mass.
int add_parameter(const std::filesystem::path& file, const MatrixParameter& entry, fe::ParametricSystem& system,
                  std::set<std::pair<std::string, std::string>>& seen) {
  const auto refuse = [&](const std::string& problem, const std::string& mend) {
    return parameter_error(file, entry.name, problem, mend);
  };
  if (!seen.emplace(entry.name, entry.target).second)
    throw refuse("appears twice with target " + entry.target, "give each parameter a name of its own");
  fe::Parameter parameter = entry.parameter(file);
  parameter.target = entry.target == "mass" ? fe::Target::matrix_mass : fe::Target::matrix_stiffness;
  parameter.of = {entry.group.empty() ? entry.name : entry.group};
  for (std::size_t i = 0; i < system.parameters.size(); ++i) {
    const auto& known = system.parameters[i];
    if (known.name != entry.name) continue;
    if (known.initial != entry.initial || known.lower != entry.lower || known.upper != entry.upper ||
        known.nominal != parameter.nominal)
      throw refuse("has other values for the mass than for the stiffness",
                   "give both entries the same initial value and bounds");
    return static_cast<int>(i);
  }
  system.parameters.push_back(std::move(parameter));
  return static_cast<int>(system.parameters.size()) - 1;
}

linalg::SparseMatrix read_sized(const std::filesystem::path& file, std::size_t n) {
  const matrix_io::MatrixMarketSize size =
      matrix_io::is_op4(file) ? matrix_io::MatrixMarketSize{matrix_io::op4_rows(file), 1} : matrix_io::matrix_market_size(file);
  if (size.rows == static_cast<Eigen::Index>(n))
    return matrix_io::is_op4(file) ? matrix_io::read_op4(file) : matrix_io::read_matrix_market(file);
  throw InputError({file.string(), size.line, ""}, fmt::format("is {0} x {0}, but dofs.csv has {1} rows", size.rows, n),
                   "matrices and dofs.csv must be of one model");
}

/// A matrix waiting for its place in the common pattern.
struct LooseTerm {
  fe::Term term;
  linalg::SparseMatrix matrix;
  bool mass;
};

/// Union of the patterns with a full diagonal: every matrix of the family, and any K - sigma M, fits into it.
linalg::SparseMatrix union_pattern(const std::vector<LooseTerm>& terms, int n) {
  std::vector<Eigen::Triplet<double, int>> entries;
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, 0.0);
  for (const auto& loose : terms)
    for (int column = 0; column < n; ++column)
      for (linalg::SparseMatrix::InnerIterator e(loose.matrix, column); e; ++e) entries.emplace_back(e.row(), e.col(), 0.0);
  linalg::SparseMatrix pattern(n, n);
  pattern.setFromTriplets(entries.begin(), entries.end());
  pattern.makeCompressed();
  return pattern;
}

void place_in_pattern(const linalg::SparseMatrix& matrix, const linalg::SparseMatrix& pattern, fe::Term& term) {
  for (int column = 0; column < matrix.outerSize(); ++column) {
    const int* first = pattern.innerIndexPtr() + pattern.outerIndexPtr()[column];
    const int* last = pattern.innerIndexPtr() + pattern.outerIndexPtr()[column + 1];
    for (linalg::SparseMatrix::InnerIterator e(matrix, column); e; ++e) {
      const int* at = std::lower_bound(first, last, static_cast<int>(e.row()));
      TWINDECK_ASSERT(at != last && *at == e.row());
      term.position.push_back(static_cast<int>(at - pattern.innerIndexPtr()));
      term.value.push_back(e.value());
    }
  }
}

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

bool is_zero(const linalg::SparseMatrix& matrix) { return matrix.coeffs().isZero(0.0); }

std::string parameter_text(const fe::Parameter& p, const std::string& matrix, const char* target) {
  std::string text = fmt::format("\n[[parameter]]\nname = {}\nmatrix = {}\ntarget = \"{}\"\n", io::toml_text(p.name),
                                 io::toml_text(matrix), target);
  if (p.of.size() == 1 && p.of[0] != p.name) text += fmt::format("group = {}\n", io::toml_text(p.of[0]));
  // Shortest decimal form that reads back to the same bits: these numbers multiply matrices of 17 digits.
  return text + parameter_lines(p, io::toml_number);
}

}  // namespace

fe::ParametricSystem read_matrix_model(const std::filesystem::path& folder) {
  const auto file = folder / "model.toml";
  MatrixModelEntry entry;
  entry.fields().load(file);
  fe::ParametricSystem system;
  system.dofs = read_dofs(folder);
  const std::size_t n = system.dofs.size();

  std::vector<LooseTerm> terms;
  terms.push_back({{"K0", {}, {}, {}}, read_sized(folder / entry.stiffness, n), false});
  terms.push_back({{"M0", {}, {}, {}}, read_sized(folder / entry.mass, n), true});
  std::set<std::pair<std::string, std::string>> seen;
  for (const auto& parameter : entry.parameters) {
    fe::Term term;
    term.label = parameter.name + " " + parameter.target;
    // theta itself is the coefficient: base 1 times (theta / 1)^1.
    term.coefficient.factors.push_back({add_parameter(file, parameter, system, seen), 1.0, 1.0});
    terms.push_back({term, read_sized(folder / parameter.matrix, n), parameter.target == "mass"});
  }
  system.pattern = union_pattern(terms, static_cast<int>(n));
  for (auto& loose : terms) {
    place_in_pattern(loose.matrix, system.pattern, loose.term);
    (loose.mass ? system.mass_terms : system.stiffness_terms).push_back(std::move(loose.term));
  }
  return system;
}

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
    const auto write = [&](const linalg::SparseMatrix& matrix, char letter, const char* target) {
      const std::string file = fmt::format("{}{}.mtx", letter, p + 1);
      matrix_io::write_matrix_market(matrix, folder / file);
      text += parameter_text(parameter, file, target);
    };
    if (!is_zero(stiffness.slope[p]) || !in_mass) write(stiffness.slope[p], 'K', "stiffness");
    if (in_mass) write(mass.slope[p], 'M', "mass");
  }
  io::write_file_atomically(folder / "model.toml", text);
}

}  // namespace twindeck::model_io
