#include "aero/follow_mode.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "aero/aeroelastic_system.hpp"

namespace twindeck::aero {
namespace {

using Complex = std::complex<double>;

constexpr int max_iterations = 200;
constexpr double tolerance = 1e-12;  // of |λ|: the last Newton step
constexpr double least_mac = 0.5;    // below it another mode was found
constexpr int most_halvings = 7;
constexpr double no_inverse = 1e100;        // of the inverse on a unit vector: beyond it squares overflow
constexpr double least_oscillation = 0.02;  // Im λ over |λ|: a mode with less no longer oscillates for any purpose of ours

// D(λ) and dD/dλ with the self-excited forces of one frequency.
struct Dynamic {
  Eigen::MatrixXcd value, slope;
};

Dynamic dynamic_matrix(const ReducedStructure& s, const Eigen::MatrixXd& damping, const AeroelasticSystem::Block& air,
                       Complex lambda) {
  const Eigen::MatrixXd c = damping - air.damping;
  Dynamic d;
  d.value = lambda * c.cast<Complex>() - air.stiffness.cast<Complex>();
  d.value.diagonal() += (s.omega_rad_s.cwiseAbs2().cast<Complex>().array() + lambda * lambda).matrix();
  d.slope = c.cast<Complex>();
  d.slope.diagonal().array() += 2.0 * lambda;
  for (const MaxwellUnit& unit : s.maxwell) {
    const double k = unit.stiffness_N_m, dash = unit.damping_N_s_m;
    const Complex below = k + lambda * dash;
    const Eigen::MatrixXcd outer = (unit.direction * unit.direction.transpose()).cast<Complex>();
    d.value += k * lambda * dash / below * outer;
    d.slope += k * k * dash / (below * below) * outer;
  }
  return d;
}

double shape_agreement(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) {
  return std::norm(a.dot(b)) / (a.squaredNorm() * b.squaredNorm());
}

std::optional<ComplexMode> iterate(const AeroelasticSystem& system, const ComplexMode& start, double speed,
                                   const FrequencyRange& range = {}) {
  const ReducedStructure& structure = system.structure();
  const Eigen::MatrixXd damping = structure.damping();
  Complex lambda = start.lambda;
  Eigen::VectorXcd v = start.vector.normalized();
  const Eigen::VectorXcd normal = v;
  for (int i = 0; i < max_iterations; ++i) {
    if (!(lambda.imag() > least_oscillation * std::abs(lambda))) return std::nullopt;
    const double omega = std::clamp(lambda.imag(), range.lowest, range.highest);
    const Dynamic d = dynamic_matrix(structure, damping, system.self_excited(speed, omega), lambda);
    const Eigen::VectorXcd x = d.value.partialPivLu().solve(d.slope * v);
    if (!x.allFinite() ||
        x.cwiseAbs().maxCoeff() > no_inverse) {  // λ is an eigenvalue to its last digit, where the matrix has no inverse
      lambda += 0.1 * tolerance * std::abs(lambda);
      continue;
    }
    const Complex along = normal.dot(x);
    if (std::abs(along) == 0.0) return std::nullopt;
    const Complex step = 1.0 / along;
    lambda -= step;
    v = x / along;
    if (std::abs(step) < tolerance * std::abs(lambda)) {
      if (!(lambda.imag() > least_oscillation * std::abs(lambda))) return std::nullopt;
      return ComplexMode{lambda, v.normalized()};
    }
  }
  return std::nullopt;
}

std::optional<ComplexMode> advance(const AeroelasticSystem& system, const ComplexMode& from, double from_speed, double speed,
                                   int halvings) {
  std::optional<ComplexMode> found = iterate(system, from, speed);
  if (found && shape_agreement(found->vector, from.vector) >= least_mac) return found;
  if (halvings == 0) return std::nullopt;
  const double middle = 0.5 * (from_speed + speed);
  const std::optional<ComplexMode> half = advance(system, from, from_speed, middle, halvings - 1);
  return half ? advance(system, *half, middle, speed, halvings - 1) : std::nullopt;
}

}  // namespace

double ComplexMode::frequency_Hz() const { return lambda.imag() / (2.0 * std::numbers::pi); }
double ComplexMode::damping_ratio() const { return -lambda.real() / std::abs(lambda); }

std::vector<ComplexMode> still_air_modes(const ReducedStructure& structure) {
  const Eigen::Index m = structure.size();
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(state_matrix(structure));
  std::vector<ComplexMode> modes;
  for (Eigen::Index i = 0; i < solver.eigenvalues().size(); ++i) {
    const Complex lambda = solver.eigenvalues()(i);
    if (!(lambda.imag() > least_oscillation * std::abs(lambda))) continue;
    modes.push_back({lambda, solver.eigenvectors().col(i).head(m).normalized()});
  }
  std::sort(modes.begin(), modes.end(),
            [](const ComplexMode& a, const ComplexMode& b) { return std::abs(a.lambda) < std::abs(b.lambda); });
  return modes;
}

std::optional<ComplexMode> mode_at(const AeroelasticSystem& system, const ComplexMode& from, double from_speed_m_s,
                                   double speed_m_s) {
  return advance(system, from, from_speed_m_s, speed_m_s, most_halvings);
}

std::optional<ComplexMode> mode_near(const AeroelasticSystem& system, const ComplexMode& start, double speed_m_s,
                                     const FrequencyRange& range) {
  return iterate(system, start, speed_m_s, range);
}

Branch follow_mode(const AeroelasticSystem& system, const ComplexMode& still_air, int mode,
                   const std::vector<double>& speed_m_s) {
  Branch branch;
  branch.mode = mode;
  branch.still_air = still_air;
  ComplexMode last = still_air;
  double last_speed = 0.0;
  for (const double speed : speed_m_s) {
    const std::optional<ComplexMode> found = mode_at(system, last, last_speed, speed);
    if (!found) {
      branch.status = {false, "mode " + std::to_string(mode) + " cannot be followed beyond " + std::to_string(last_speed) +
                                  " m/s: it stops oscillating or merges with another"};
      return branch;
    }
    branch.speed_m_s.push_back(speed);
    branch.points.push_back(*found);
    last = *found;
    last_speed = speed;
  }
  return branch;
}

}  // namespace twindeck::aero
