/// Times of one process, printed as `name value` lines; tests/bench/modes.py runs it several times, since a first solve is
/// first once a process, and compares with peers.
///
///     bench_modes matrices FOLDER   15 modes of K.mtx and M.mtx, ordering included, as the peers have them
///     bench_modes bridge [FILE]     the study's bridge: assembly, a solve after a change of parameters, derivatives
///     bench_modes machine           the machine's bandwidth and arithmetic on one thread, for the bound
#include <cholmod.h>

#include <Eigen/Dense>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>

#include "bench/cost.hpp"
#include "core/parallel.hpp"
#include "dynamics/eigenmodes.hpp"
#include "fe/structure.hpp"
#include "linalg/cholesky.hpp"
#include "linalg/dense.hpp"
#include "linalg/generalized_eigen.hpp"
#include "linalg/one_thread.hpp"
#include "linalg/sparse.hpp"
#include "matrix_io/matrix_market.hpp"
#include "ponte/generator.hpp"
#include "sensitivity/channel_sensitivity.hpp"
#include "sensitivity/frequency_jacobian.hpp"

namespace {

using namespace twindeck;
using bench::peak_MB;
using bench::seconds;
constexpr int kModes = 15;

/// Largest residual of the pairs, |K⁻¹ M x - x / λ| λ in the norm of M.
double residual(const linalg::SparseMatrix& stiffness, const linalg::SparseMatrix& mass, const Eigen::VectorXd& lambda,
                const Eigen::MatrixXd& shapes) {
  linalg::Cholesky factor;
  if (!factor.factorize(stiffness).converged) return -1.0;
  const Eigen::MatrixXd r = factor.solve(linalg::symmetric_product(mass, shapes)) - shapes * lambda.cwiseInverse().asDiagonal();
  const Eigen::VectorXd norm = r.cwiseProduct(linalg::symmetric_product(mass, r)).colwise().sum().cwiseAbs().cwiseSqrt();
  return norm.cwiseProduct(lambda).maxCoeff();
}

/// Entries of the factor and arithmetic of a factorisation, as CHOLMOD counts them in the ordering that `linalg::Cholesky`
/// takes.
void print_factor_size(const linalg::SparseMatrix& lower) {
  cholmod_common common{};
  cholmod_start(&common);
  common.supernodal = CHOLMOD_AUTO;
  cholmod_sparse a{};
  a.nrow = a.ncol = static_cast<std::size_t>(lower.rows());
  a.nzmax = static_cast<std::size_t>(lower.nonZeros());
  a.p = const_cast<int*>(lower.outerIndexPtr());
  a.i = const_cast<int*>(lower.innerIndexPtr());
  a.x = const_cast<double*>(lower.valuePtr());
  a.stype = -1;
  a.itype = CHOLMOD_INT;
  a.xtype = CHOLMOD_REAL;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = a.packed = 1;
  cholmod_factor* factor = cholmod_analyze(&a, &common);
  std::printf("factor_entries %.0f\nfactor_flops %.0f\n", common.lnz, common.fl);
  cholmod_free_factor(&factor, &common);
  cholmod_finish(&common);
}

int matrices(const std::string& folder) {
  const linalg::SparseMatrix stiffness = matrix_io::read_matrix_market(folder + "/K.mtx");
  const linalg::SparseMatrix mass = matrix_io::read_matrix_market(folder + "/M.mtx");
  linalg::Cholesky factor;
  linalg::EigenPairs pairs;
  std::printf("first_solve_s %.6f\n",
              seconds([&] { pairs = linalg::lowest_eigenpairs(stiffness, mass, kModes, 0.0, factor); }));
  if (!pairs.status.converged) return 1;
  std::printf("peak_MB %.1f\n", peak_MB());
  for (int i = 0; i < kModes; ++i)
    std::printf("frequency_%d_Hz %.15g\n", i + 1, std::sqrt(pairs.values[i]) / 6.283185307179586);
  std::printf("solves %d\n", pairs.operations);
  std::printf("factorise_s %.6f\n", seconds([&] { static_cast<void>(factor.factorize(stiffness)); }));
  print_factor_size(stiffness);
  std::printf("residual %.3e\n", residual(stiffness, mass, pairs.values, pairs.vectors));
  return 0;
}

/// A solve after a change of 1 % in every parameter, and back. @return whether they converged
bool print_solves(dynamics::ModalSolver& solver, const Eigen::VectorXd& theta, dynamics::EigenModes& modes) {
  modes = solver.solve(theta, kModes);
  if (!modes.status.converged) return false;
  Eigen::VectorXd changed = theta;
  for (Eigen::Index p = 0; p < changed.size(); ++p) changed[p] *= p % 2 == 0 ? 1.01 : 0.99;
  dynamics::EigenModes again;
  std::printf("resolve_from_parameters_s %.6f\n", seconds([&] { again = solver.solve(changed, kModes); }));
  if (!again.status.converged) return false;
  std::printf("resolve_again_s %.6f\n", seconds([&] { modes = solver.solve(theta, kModes); }));
  return true;
}

void print_frequency_jacobian(const fe::ParametricSystem& system, dynamics::ModalSolver& solver, const Eigen::VectorXd& theta,
                              const dynamics::EigenModes& modes) {
  Eigen::MatrixXd exact, differences(kModes, theta.size());
  std::printf("jacobian_s %.6f\n", seconds([&] { exact = sensitivity::frequency_jacobian(system, theta, modes); }));
  std::printf("jacobian_by_differences_s %.6f\n", seconds([&] {
                for (Eigen::Index p = 0; p < theta.size(); ++p) {
                  Eigen::VectorXd moved = theta;
                  const double step = 1e-4 * theta[p];
                  moved[p] += step;
                  differences.col(p) = (solver.solve(moved, kModes).frequency_Hz - modes.frequency_Hz) / step;
                }
              }));
  std::printf("jacobian_deviation %.3e\n", ((exact - differences) * theta.asDiagonal()).cwiseAbs().maxCoeff());
  std::printf("parameters %ld\n", static_cast<long>(theta.size()));
}

/// Derivatives at sixteen measured directions, spread over the degrees of freedom.
void print_channel_jacobian(const fe::ParametricSystem& system, const Eigen::VectorXd& theta,
                            const dynamics::EigenModes& modes) {
  constexpr Eigen::Index n_channels = 16;
  Eigen::MatrixXd channels = Eigen::MatrixXd::Zero(system.size(), n_channels);
  for (Eigen::Index c = 0; c < n_channels; ++c) channels((2 * c + 1) * system.size() / (2 * n_channels), c) = 1.0;
  std::printf("channel_jacobian_s %.6f\n",
              seconds([&] { (void)sensitivity::channel_shape_derivatives(system, theta, modes, channels); }));
}

int bridge(const std::string& file) {
  fe::ParametricSystem system;
  fe::Model model;
  std::printf("generate_s %.6f\n", seconds([&] { model = ponte::generate(file, "preliminary"); }));
  std::printf("assemble_s %.6f\n", seconds([&] {
                const fe::Structure structure(model);
                system = structure.system(structure.prestress(fe::initial_parameters(structure.model())));
              }));
  std::printf("degrees_of_freedom %ld\n", static_cast<long>(system.size()));
  const Eigen::VectorXd theta = system.initial();
  dynamics::ModalSolver solver(system);
  dynamics::EigenModes modes;
  if (!print_solves(solver, theta, modes)) return 1;
  print_frequency_jacobian(system, solver, theta, modes);
  print_channel_jacobian(system, theta, modes);
  return 0;
}

int machine() {
  constexpr Eigen::Index n = 32'000'000;  // three arrays of 256 MB: no cache holds them
  Eigen::VectorXd a = Eigen::VectorXd::Ones(n), b = Eigen::VectorXd::Constant(n, 2.0), c = Eigen::VectorXd::Zero(n);
  double best = 1e300;
  for (int i = 0; i < 5; ++i) best = std::min(best, seconds([&] { c = a + 3.0 * b; }));
  std::printf("bandwidth_B_s %.4g\n", 3.0 * 8.0 * static_cast<double>(n) / best);
  const Eigen::MatrixXd x = Eigen::MatrixXd::Random(1000, 1000);
  Eigen::MatrixXd y;
  best = 1e300;
  for (int i = 0; i < 5; ++i) best = std::min(best, seconds([&] { y = linalg::product(x, x); }));
  std::printf("arithmetic_flop_s %.4g\n", 2e9 / best);
  return c.sum() + y.sum() != 0.0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string task = argc > 1 ? argv[1] : "";
  linalg::use_one_thread();
  if (task == "matrices" && argc > 2) return matrices(argv[2]);
  if (task == "bridge") return bridge(argc > 2 ? argv[2] : "data/ponte_del_mare/bridge.toml");
  if (task == "machine") return machine();
  std::fprintf(stderr, "usage: bench_modes matrices FOLDER | bridge [FILE] | machine\n");
  return 2;
}
