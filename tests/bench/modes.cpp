/// Times of one process on the study's bridge, printed as `name value` lines; tests/bench/modes.py runs it several times, since
/// a first solve is first once a process, and compares with peers.
#include <sys/resource.h>

#include <cstdio>
#include <ctime>
#include <functional>
#include <string>

#include "dynamics/eigen_sensitivity.hpp"
#include "dynamics/eigenmodes.hpp"
#include "fe/structure.hpp"
#include "linalg/one_thread.hpp"
#include "ponte/generator.hpp"

namespace {

using namespace twindeck;
constexpr int kModes = 15;

/// Processor time of one thread: what else runs on the machine hardly matters.
double seconds(const std::function<void()>& work) {
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

double peak_MB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string bridge = argc > 1 ? argv[1] : "data/ponte_del_mare/bridge.toml";
  linalg::use_one_thread();
  fe::ParametricSystem system;
  std::printf("assemble_s %.6f\n", seconds([&] {
                const fe::Structure structure(ponte::generate(bridge, "refined"));
                system = structure.system(structure.prestress(fe::initial_parameters(structure.model())));
              }));
  std::printf("degrees_of_freedom %ld\n", static_cast<long>(system.size()));

  // The matrices are made before the clock runs, as they are for the peer.
  const Eigen::VectorXd theta = system.initial();
  const auto stiffness = system.stiffness(theta), mass = system.mass(theta);
  dynamics::ModalSolver solver(system);
  dynamics::EigenModes modes;
  std::printf("first_solve_s %.6f\n", seconds([&] { modes = solver.solve(theta, kModes); }));
  if (!modes.status.converged) return 1;
  for (int i = 0; i < kModes; ++i) std::printf("frequency_%d_Hz %.15g\n", i + 1, modes.frequency_Hz[i]);
  std::printf("peak_MB %.1f\n", peak_MB());

  Eigen::VectorXd changed = theta;
  for (Eigen::Index p = 0; p < changed.size(); ++p) changed[p] *= p % 2 == 0 ? 1.01 : 0.99;
  std::printf("resolve_s %.6f\n", seconds([&] { static_cast<void>(solver.solve(changed, kModes)); }));
  std::printf("resolve_again_s %.6f\n", seconds([&] { static_cast<void>(solver.solve(theta, kModes)); }));

  Eigen::MatrixXd exact, differences(kModes, theta.size());
  std::printf("jacobian_s %.6f\n", seconds([&] { exact = dynamics::frequency_jacobian(system, theta, modes); }));
  std::printf("jacobian_by_differences_s %.6f\n", seconds([&] {
                for (Eigen::Index p = 0; p < theta.size(); ++p) {
                  Eigen::VectorXd moved = theta;
                  const double step = 1e-4 * theta[p];
                  moved[p] += step;
                  differences.col(p) = (solver.solve(moved, kModes).frequency_Hz - modes.frequency_Hz) / step;
                }
              }));
  const Eigen::VectorXd scale = theta;
  std::printf("jacobian_deviation %.3e\n", ((exact - differences) * scale.asDiagonal()).cwiseAbs().maxCoeff());
  return 0;
}
