#include "aero/stability.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <vector>

#include "aero/aeroelastic_system.hpp"
#include "core/parallel.hpp"

namespace twindeck::aero {
namespace {

/// [-] growth over |λ|: rounding of an eigenvalue. In a thousand periods a motion that grows no faster gains less than 1e-4.
constexpr double kNoGrowth = 1e-8;

/// Every motion of the equations with derivatives of one frequency; of conjugate pairs the one that turns forwards.
std::vector<ComplexMode> frozen_motions(const AeroelasticSystem& system, double speed_m_s, double omega_rad_s) {
  const Eigen::Index m = system.structure().size();
  Eigen::MatrixXd a = state_matrix(system.structure(), system.self_excited(speed_m_s, omega_rad_s));
  // Displacements times their frequency: without that the squares of high frequencies round away a small damping.
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(a.rows());
  scale.head(m) = system.structure().omega_rad_s.cwiseMax(1.0);
  a = (scale.asDiagonal() * a * scale.cwiseInverse().asDiagonal()).eval();
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(a);
  TWINDECK_ASSERT(solver.info() == Eigen::Success);
  std::vector<ComplexMode> motions;
  for (Eigen::Index i = 0; i < solver.eigenvalues().size(); ++i) {
    const std::complex<double> lambda = solver.eigenvalues()(i);
    if (lambda.imag() < 0.0) continue;
    const Eigen::VectorXcd shape = solver.eigenvectors().col(i).head(m).cwiseQuotient(scale.head(m));
    motions.push_back({lambda, shape.normalized()});
  }
  return motions;
}

bool grows(const ComplexMode& motion) { return motion.lambda.real() > kNoGrowth * std::abs(motion.lambda); }

void keep_the_faster(std::optional<ComplexMode>& fastest, const ComplexMode& motion) {
  if (grows(motion) && (!fastest || motion.lambda.real() > fastest->lambda.real())) fastest = motion;
}

/// 0 where there is no mode.
int nearest_mode(const std::vector<ComplexMode>& modes, const ComplexMode& motion) {
  int nearest = 0;
  double best = 0.0;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const double agreement = std::norm(modes[i].vector.dot(motion.vector));
    if (agreement <= best) continue;
    best = agreement;
    nearest = static_cast<int>(i) + 1;
  }
  return nearest;
}

}  // namespace

std::string Growth::in_words() const {
  const std::string mode = still_air_mode > 0 ? fmt::format("mode {}", still_air_mode) : "a motion";
  if (motion.lambda.imag() == 0.0) return mode + " diverges without oscillating";
  return fmt::format("{} grows at {:.4g} Hz, damping ratio {:.3g} %", mode, motion.frequency_Hz(),
                     100.0 * motion.damping_ratio());
}

std::optional<Growth> find_growth(const AeroelasticSystem& system, double speed_m_s, const DerivativeFrequencies& frequencies) {
  const std::vector<ComplexMode> frozen = frozen_motions(system, speed_m_s, frequencies.frozen_omega);
  std::optional<ComplexMode> fastest;
  for (const ComplexMode& motion : frozen)
    if (motion.lambda.imag() <= frequencies.frozen_to) keep_the_faster(fastest, motion);
  const bool of_frozen = fastest.has_value();
  if (!of_frozen) {
    std::vector<std::optional<ComplexMode>> own(frozen.size());
    parallel_for(std::ssize(frozen), [&](Eigen::Index i) {
      const ComplexMode& start = frozen[static_cast<std::size_t>(i)];
      const double omega = start.lambda.imag();
      const bool above = omega > frequencies.frozen_to;
      if (above ? !grows(start) : omega < frequencies.own.lowest || omega > frequencies.own.highest) return;
      const FrequencyRange range = above ? FrequencyRange{frequencies.own.lowest} : frequencies.own;
      std::optional<ComplexMode>& found = own[static_cast<std::size_t>(i)];
      found = mode_near(system, start, speed_m_s, range);
      if (above && !found) found = start;
    });
    for (const std::optional<ComplexMode>& motion : own)
      if (motion) keep_the_faster(fastest, *motion);
  }
  if (!fastest) return std::nullopt;
  return Growth{*fastest, nearest_mode(still_air_modes(system.structure()), *fastest), !of_frozen};
}

}  // namespace twindeck::aero
