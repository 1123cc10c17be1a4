#include "ponte/virtual_bridge/stay_records.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/random.hpp"
#include "fe/assembly_elements.hpp"
#include "transient/trapezoidal.hpp"

namespace twindeck::ponte {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kMostlyAcross =
    0.5;                          ///< [-] of a mode's kinetic energy: a mode that moves across the chord has most of it there
constexpr double kWarmUp = 10.0;  ///< times 1 / (zeta omega): the initial motion has decayed by e^-10

constexpr int kPieces = 96;  // the fifth mode is then within 1e-6 of the continuous string's
constexpr Index kModes = 5;
constexpr double kLeastLambda = 0.01;  // a chain without axial stiffness would not hold together

/// Chain in its vertical plane: coordinates along (horizontal) and z.
struct Chain {
  std::vector<Eigen::Vector3d> x_m;  // kPieces + 1
  double mass_per_length = 0.0, length_m = 0.0, axial_stiffness_N = 0.0;
  Eigen::Vector3d along, across;  // unit vectors along the chord, and across it in the vertical plane
};

Chain hang(const fe::Model& model, const fe::Element& stay, const StayTest& test) {
  const auto ends = fe::end_nodes(model, stay);
  Chain chain;
  const Eigen::Vector3d chord = ends[1] - ends[0];
  chain.length_m = chord.norm();
  chain.mass_per_length = fe::material_of(model, stay).density_kg_m3 * fe::section_of(model, stay).area_m2;
  const double cosine = std::hypot(chord.x(), chord.y()) / chain.length_m;
  const double weight = chain.mass_per_length * model.gravity_m_s2 * chain.length_m;
  const double slope = weight * cosine / test.pull_N;
  const double stretched = chain.length_m * (1.0 + slope * slope / 8.0);
  chain.axial_stiffness_N =
      std::max(test.lambda_squared, kLeastLambda) * test.pull_N * stretched / (slope * slope * chain.length_m);
  const double sag = weight * chain.length_m / (8.0 * test.pull_N);
  for (int k = 0; k <= kPieces; ++k) {
    const double xi = static_cast<double>(k) / kPieces;
    chain.x_m.emplace_back(ends[0] + xi * chord - 4.0 * sag * xi * (1.0 - xi) * Eigen::Vector3d::UnitZ());
  }
  chain.along = chord.normalized();
  chain.across = (Eigen::Vector3d::UnitZ() - chain.along.z() * chain.along).normalized();
  return chain;
}

/// In-plane modes: omega, and shapes across the chord at the inner nodes, mass-normalised. Motion out of the plane is left out:
/// it has modes of nearly the same frequencies, with which those of the plane would mix by rounding.
void solve(const Chain& chain, double pull_N, VectorXd& omega, MatrixXd& shapes) {
  const Index n = kPieces - 1;
  MatrixXd k = MatrixXd::Zero(3 * (kPieces + 1), 3 * (kPieces + 1)), mass = k;
  // Half lumped, half consistent: errors of the two in frequency, -x²/24 and +x²/24 with x the phase a piece, cancel.
  const double piece_kg = chain.mass_per_length * chain.length_m / kPieces;
  for (int i = 0; i < kPieces; ++i) {
    const std::array<Eigen::Vector3d, 2> ends = {chain.x_m[static_cast<std::size_t>(i)],
                                                 chain.x_m[static_cast<std::size_t>(i + 1)]};
    k.block<6, 6>(3 * i, 3 * i) += fe::bar_stiffness(ends, chain.axial_stiffness_N, 1.0) + fe::string_stiffness(ends, pull_N);
    mass.diagonal().segment<6>(3 * i).array() += 5.0 / 12.0 * piece_kg;
    mass.diagonal(3).segment<3>(3 * i).array() += piece_kg / 12.0;
    mass.diagonal(-3).segment<3>(3 * i).array() += piece_kg / 12.0;
  }
  MatrixXd in_plane = MatrixXd::Zero(3 * n, 2 * n);
  for (Index i = 0; i < n; ++i) in_plane.block<3, 2>(3 * i, 2 * i) << chain.along, chain.across;
  const MatrixXd inner = in_plane.transpose() * k.block(3, 3, 3 * n, 3 * n) * in_plane;
  const MatrixXd inner_mass = in_plane.transpose() * mass.block(3, 3, 3 * n, 3 * n) * in_plane;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eig(inner, inner_mass);
  const MatrixXd& phi = eig.eigenvectors();
  omega.resize(kModes);
  shapes.resize(n, kModes);
  Index found = 0;
  for (Index j = 0; j < phi.cols() && found < kModes; ++j) {
    const VectorXd across = phi.col(j)(Eigen::seqN(1, n, 2));
    // Modes that move along the chord have higher frequencies.
    if (across.squaredNorm() * piece_kg < kMostlyAcross) continue;
    omega[found] = std::sqrt(eig.eigenvalues()[j]);
    shapes.col(found++) = across;
  }
  TWINDECK_ASSERT(found == kModes);
}

}  // namespace

const fe::Element& stay_of(const fe::Model& model, const StayTest& test) {
  const auto stay = std::ranges::find_if(
      model.elements, [&](const fe::Element& e) { return e.type == fe::ElementType::stay && e.name == test.stay; });
  if (stay == model.elements.end())
    throw InputError({"", 0, "stay_test.stay"}, "'" + test.stay + "' is no stay of the virtual bridge", "name one such as NE8");
  return *stay;
}

StayRecord stay_record(const fe::Model& model, const StayTest& test, const CampaignSettings& settings, std::uint64_t seed,
                       std::uint64_t stream) {
  const Chain chain = hang(model, stay_of(model, test), test);
  VectorXd omega;
  MatrixXd shapes;
  solve(chain, test.pull_N, omega, shapes);
  for (std::size_t i = 0; i < test.imposed_Hz.size() && static_cast<Index>(i) < kModes; ++i)
    omega[static_cast<Index>(i)] = 2.0 * std::numbers::pi * test.imposed_Hz[i];

  StayRecord record;
  record.truth = {omega / (2.0 * std::numbers::pi), test.pull_N / chain.mass_per_length,
                  std::max(test.lambda_squared, kLeastLambda), chain.length_m, test.imposed_Hz.empty()};
  const auto sensor = static_cast<Index>(std::lround(settings.stay_sensor * kPieces));
  record.x_m = chain.x_m[static_cast<std::size_t>(sensor)];
  record.direction = chain.across;
  const Eigen::RowVectorXd seen = shapes.row(sensor - 1);

  // Independent forces on the inner nodes. The warm-up is ten times the decay time of the slowest mode.
  // Eight steps a sample. The trapezoidal rule lengthens periods, so it gets frequencies that come out as the wanted ones.
  constexpr long kSubsteps = 8;
  const double step_s = 1.0 / (settings.rate_Hz * static_cast<double>(kSubsteps));
  const VectorXd shortened = (0.5 * step_s * omega.array()).tan() * (2.0 / step_s);
  transient::TrapezoidalStepper stepper(shortened, VectorXd::Constant(kModes, test.damping_ratio), step_s);
  const auto warm_up = static_cast<Index>(kWarmUp / (test.damping_ratio * omega[0]) * settings.rate_Hz);
  const auto n_samples = static_cast<Index>(std::lround(settings.stay_duration_s * settings.rate_Hz));
  const double intensity = settings.stay_force * std::sqrt(0.5 * settings.rate_Hz);
  const Index n_forces = shapes.rows();
  VectorXd normal(n_forces), before = VectorXd::Zero(kModes), after = before;
  record.acceleration_m_s2.resize(n_samples);
  for (Index sample = -warm_up; sample < n_samples; ++sample) {
    for (Index i = 0; i < n_forces; ++i)
      normal[i] = normal_number(seed, stream, static_cast<std::uint64_t>((sample + warm_up) * n_forces + i));
    before = after;
    after = intensity * shapes.transpose() * normal;
    for (long k = 0; k < kSubsteps; ++k) {
      const double part = static_cast<double>(k + 1) / static_cast<double>(kSubsteps);
      stepper.step((1.0 - part) * before + part * after);
      if (sample >= 0 && k == 0) record.acceleration_m_s2[sample] = seen * stepper.acceleration();
    }
  }
  return record;
}

}  // namespace twindeck::ponte
