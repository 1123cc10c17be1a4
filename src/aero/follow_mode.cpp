#include "aero/follow_mode.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

namespace twindeck::aero {
namespace {

using Complex = std::complex<double>;

constexpr int max_iterations = 200;
constexpr double tolerance = 1e-12;  // of |λ|: the last Newton step
constexpr double least_mac = 0.5;    // below it another mode was found
constexpr int most_halvings = 7;
constexpr double no_inverse = 1e100;        // of the inverse times a unit vector: the squares of larger numbers overflow
constexpr double least_oscillation = 0.02;  // Im λ over |λ|: below this value a mode counts as no longer oscillating

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

constexpr double no_growth = 1e-12;  ///< [-] damping ratio: rounding of an eigenvalue

// z² of each strip, whatever the phase.
std::vector<double> vertical_square(const AeroelasticSystem& system, const ComplexMode& motion) {
  std::vector<double> square;
  for (const StripMotion& strip : system.motions())
    square.push_back(std::norm((strip.row(2).cast<std::complex<double>>() * motion.vector)(0)));
  return square;
}

// sum over strips of z² times the lift per heave velocity.
double heave_damping(const AeroelasticSystem& system, const std::vector<double>& square, double speed, double omega) {
  double sum = 0.0;
  for (std::size_t i = 0; i < square.size(); ++i) {
    const Strip& strip = system.strips()[i];
    const SectionAero& section = system.sections()[static_cast<std::size_t>(strip.section)];
    sum +=
        square[i] * self_excited(section, strip, system.rule(strip), system.wind().density_kg_m3, speed, omega).damping(1, 1);
  }
  return sum;
}

}  // namespace

std::vector<ComplexMode> still_air_modes(const ReducedStructure& structure) {
  const Eigen::Index m = structure.size();
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(state_matrix(structure));
  std::vector<ComplexMode> modes;
  for (Eigen::Index i = 0; i < solver.eigenvalues().size(); ++i) {
    const Complex lambda = solver.eigenvalues()(i);
    if (!(lambda.imag() > least_oscillation * std::abs(lambda))) continue;
    modes.push_back({lambda, solver.eigenvectors().col(i).head(m).normalized()});
  }
  std::ranges::sort(modes, [](const ComplexMode& a, const ComplexMode& b) { return std::abs(a.lambda) < std::abs(b.lambda); });
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

std::optional<CriticalPoint> critical_point(const AeroelasticSystem& system, const Branch& branch) {
  if (branch.points.empty()) return std::nullopt;
  if (branch.still_air.damping_ratio() <= no_growth &&
      branch.points[0].damping_ratio() < -no_growth)  // from the first speed on
    return CriticalPoint{
        branch.mode,      branch.speed_m_s[0], branch.points[0].frequency_Hz(), branch.still_air.frequency_Hz(),
        branch.points[0], branch.speed_m_s[0]};
  for (std::size_t i = 0; i < branch.points.size(); ++i) {
    const ComplexMode& before = i == 0 ? branch.still_air : branch.points[i - 1];
    if (!(before.damping_ratio() > 0.0 && branch.points[i].damping_ratio() <= 0.0)) continue;
    double low = i == 0 ? 0.0 : branch.speed_m_s[i - 1], high = branch.speed_m_s[i];
    ComplexMode at_low = before, at_high = branch.points[i];
    // Illinois rule: false position that halves the weight of an end that stays.
    double f_low = at_low.lambda.real(), f_high = at_high.lambda.real();
    for (int k = 0; k < 200 && high - low > relative_bracket * high && f_high != 0.0; ++k) {
      double guess = k % 3 == 2 ? 0.5 * (low + high) : low - f_low * (high - low) / (f_high - f_low);
      std::optional<ComplexMode> middle = mode_at(system, at_low, low, guess);
      if (!middle) middle = mode_at(system, at_low, low, guess = 0.5 * (low + high));
      if (!middle) break;
      const bool below = middle->lambda.real() < 0.0;
      (below ? low : high) = guess;
      (below ? at_low : at_high) = *middle;
      (below ? f_low : f_high) = middle->lambda.real();
      (below ? f_high : f_low) *= 0.5;
    }
    return CriticalPoint{branch.mode,
                         high,
                         at_high.frequency_Hz(),
                         branch.still_air.frequency_Hz(),
                         at_high,
                         at_high.lambda.real() == 0.0 ? 0.0 : high - low};
  }
  return std::nullopt;
}

GallopingCharacter galloping_character(const AeroelasticSystem& system, const ComplexMode& motion, double speed_m_s) {
  const std::vector<double> square = vertical_square(system, motion);
  std::map<std::string, std::pair<double, double>> by_deck;  // sum of z² L, sum of z² L theta²
  double total = 0.0;
  for (std::size_t i = 0; i < square.size(); ++i) {
    const Strip& strip = system.strips()[i];
    auto& [weight, moment] = by_deck[strip.deck];
    const double w = square[i] * strip.length_m;
    weight += w;
    moment += w * strip.yaw_rad * strip.yaw_rad;
    total += w;
  }
  GallopingCharacter character;
  double largest = 0.0;
  for (const auto& [deck, sums] : by_deck) {
    if (sums.first <= largest) continue;
    largest = sums.first;
    character.deck = deck;
    character.theta_rms_rad = std::sqrt(sums.second / sums.first);
    character.deck_share = sums.first / total;
  }
  // Lift per heave velocity grows as V* h1*, so one power of V is not h1*'s.
  const double omega = motion.lambda.imag(), step = 1e-3;
  const double up = heave_damping(system, square, speed_m_s * (1.0 + step), omega);
  const double down = heave_damping(system, square, speed_m_s * (1.0 - step), omega);
  character.exponent = std::log(std::abs(up / down)) / std::log((1.0 + step) / (1.0 - step)) - 1.0;
  return character;
}

std::optional<double> divergence_speed(const AeroelasticSystem& system) {
  const Eigen::VectorXd inverse = system.structure().omega_rad_s.cwiseInverse();
  const Eigen::MatrixXd ratio = inverse.asDiagonal() * system.static_stiffness() * inverse.asDiagonal();
  const Eigen::VectorXcd values = Eigen::EigenSolver<Eigen::MatrixXd>(ratio, false).eigenvalues();
  double largest = 0.0;
  for (const std::complex<double>& value : values)
    if (std::abs(value.imag()) <= 1e-9 * std::abs(value)) largest = std::max(largest, value.real());
  if (largest <= 0.0) return std::nullopt;
  return 1.0 / std::sqrt(largest);
}

std::optional<double> den_hartog_speed(const AeroelasticSystem& system, Eigen::Index coordinate) {
  double sum = 0.0;
  for (std::size_t i = 0; i < system.strips().size(); ++i) {
    const Strip& strip = system.strips()[i];
    const SectionAero& section = system.sections()[static_cast<std::size_t>(strip.section)];
    const StaticCoefficients c = section.polar.at(strip.alpha_rad);
    const double z = system.motions()[i](2, coordinate);
    sum += section.chord_m * (c.lift_slope + c.drag) * z * z * strip.length_m;
  }
  if (sum >= 0.0) return std::nullopt;
  return -4.0 * system.structure().omega_rad_s(coordinate) * system.structure().damping_ratio(coordinate) /
         (system.wind().density_kg_m3 * sum);
}

}  // namespace twindeck::aero
