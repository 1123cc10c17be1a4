#include "blind/form/plane_frame.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace twindeck::blind::form {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
constexpr std::array<int, 4> kBending = {1, 2, 4, 5};  // w1, turn1, w2, turn2 among a beam's six unknowns
constexpr double kMassless = 1e-12;                    // of the largest 1/omega²: a mode without mass

/// 12 EI / (kappa G A L²).
double shear_number(const BeamPart& beam, double length) {
  return beam.shear_N > 0.0 ? 12.0 * beam.bending_N_m2 / (beam.shear_N * length * length) : 0.0;
}

Matrix6 local_stiffness(const BeamPart& beam, double length) {
  const double phi = shear_number(beam, length), l = length, l2 = length * length;
  Eigen::Matrix4d b;
  b << 12, 6 * l, -12, 6 * l, 6 * l, (4 + phi) * l2, -6 * l, (2 - phi) * l2, -12, -6 * l, 12, -6 * l, 6 * l, (2 - phi) * l2,
      -6 * l, (4 + phi) * l2;
  b *= beam.bending_N_m2 / ((1 + phi) * l2 * l);
  Eigen::Matrix4d g;  // of an axial force, cubic shapes
  g << 36, 3 * l, -36, 3 * l, 3 * l, 4 * l2, -3 * l, -l2, -36, -3 * l, 36, -3 * l, 3 * l, -l2, -3 * l, 4 * l2;
  b -= beam.compression_N / (30.0 * l) * g;
  Matrix6 k = Matrix6::Zero();
  for (Index i = 0; i < 4; ++i)
    for (Index j = 0; j < 4; ++j) k(kBending[static_cast<std::size_t>(i)], kBending[static_cast<std::size_t>(j)]) = b(i, j);
  const double axial = beam.axial_N / length;
  k(0, 0) = k(3, 3) = axial;
  k(0, 3) = k(3, 0) = -axial;
  return k;
}

/// Consistent mass of a Timoshenko beam (Friedman and Kosmatka 1993, Computers & Structures 47, 473-481).
Matrix6 local_mass(const BeamPart& beam, double length) {
  const double p = shear_number(beam, length), l = length, l2 = length * length;
  const double m1 = 13.0 / 35 + 7 * p / 10 + p * p / 3, m2 = (11.0 / 210 + 11 * p / 120 + p * p / 24) * l,
               m3 = 9.0 / 70 + 3 * p / 10 + p * p / 6, m4 = (13.0 / 420 + 3 * p / 40 + p * p / 24) * l,
               m5 = (1.0 / 105 + p / 60 + p * p / 120) * l2, m6 = (1.0 / 140 + p / 60 + p * p / 120) * l2;
  const double r1 = 6.0 / 5, r2 = (1.0 / 10 - p / 2) * l, r3 = (2.0 / 15 + p / 6 + p * p / 3) * l2,
               r4 = (1.0 / 30 + p / 6 - p * p / 6) * l2;
  Eigen::Matrix4d translation, rotation;
  translation << m1, m2, m3, -m4, m2, m5, m4, -m6, m3, m4, m1, -m2, -m4, -m6, -m2, m5;
  rotation << r1, r2, -r1, r2, r2, r3, -r2, -r4, -r1, -r2, r1, -r2, r2, -r4, -r2, r3;
  const double scale = 1.0 / ((1 + p) * (1 + p));
  const Eigen::Matrix4d b = scale * (beam.mass_kg_m * l * translation + beam.rotary_kg_m / l * rotation);
  Matrix6 m = Matrix6::Zero();
  for (Index i = 0; i < 4; ++i)
    for (Index j = 0; j < 4; ++j) m(kBending[static_cast<std::size_t>(i)], kBending[static_cast<std::size_t>(j)]) = b(i, j);
  m(0, 0) = m(3, 3) = beam.mass_kg_m * l / 3.0;
  m(0, 3) = m(3, 0) = beam.mass_kg_m * l / 6.0;
  return m;
}

/// Adds a beam's matrix to the whole, turned into global directions.
void add_turned(const PlaneFrame& frame, const BeamPart& beam, const Matrix6& local, MatrixXd& whole) {
  const Eigen::Vector2d axis = (frame.position(beam.to) - frame.position(beam.from)).normalized();
  Matrix6 turn = Matrix6::Zero();
  for (const Index at : {Index{0}, Index{3}}) {
    turn(at, at) = turn(at + 1, at + 1) = axis.x();
    turn(at, at + 1) = axis.y();
    turn(at + 1, at) = -axis.y();
    turn(at + 2, at + 2) = 1.0;
  }
  const Matrix6 global = turn.transpose() * local * turn;
  const std::array<int, 6> at = {frame.unknown(beam.from, 0),
                                 frame.unknown(beam.from, 1),
                                 beam.turn_from >= 0 ? beam.turn_from : frame.unknown(beam.from, 2),
                                 frame.unknown(beam.to, 0),
                                 frame.unknown(beam.to, 1),
                                 beam.turn_to >= 0 ? beam.turn_to : frame.unknown(beam.to, 2)};
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) whole(at[i], at[j]) += global(static_cast<Index>(i), static_cast<Index>(j));
}

double length_of(const PlaneFrame& frame, const BeamPart& beam) {
  return (frame.position(beam.to) - frame.position(beam.from)).norm();
}

void add_rank(const Movement& movement, double amount, MatrixXd& whole) {
  for (const Part& a : movement)
    for (const Part& b : movement) whole(a.unknown, b.unknown) += amount * a.factor * b.factor;
}

}  // namespace

int PlaneFrame::add_node(const Eigen::Vector2d& x_m) {
  nodes_.push_back(x_m);
  first_.push_back(unknowns_);
  unknowns_ += 3;
  return static_cast<int>(nodes_.size()) - 1;
}

int PlaneFrame::add_unknown() { return unknowns_++; }

MatrixXd PlaneFrame::stiffness() const {
  MatrixXd k = MatrixXd::Zero(unknowns_, unknowns_);
  for (const BeamPart& beam : beams_) add_turned(*this, beam, local_stiffness(beam, length_of(*this, beam)), k);
  for (const Rank& spring : springs_) add_rank(spring.movement, spring.amount, k);
  return k;
}

MatrixXd PlaneFrame::mass() const {
  MatrixXd m = MatrixXd::Zero(unknowns_, unknowns_);
  for (const BeamPart& beam : beams_) add_turned(*this, beam, local_mass(beam, length_of(*this, beam)), m);
  for (const Rank& mass : masses_) add_rank(mass.movement, mass.amount, m);
  return m;
}

std::vector<int> PlaneFrame::free() const {
  std::vector<int> free;
  for (int i = 0; i < unknowns_; ++i)
    if (std::find(fixed_.begin(), fixed_.end(), i) == fixed_.end()) free.push_back(i);
  return free;
}

FrameModes PlaneFrame::modes() const {
  const std::vector<int> at = free();
  const MatrixXd k = stiffness()(at, at), m = mass()(at, at);
  if (Eigen::LLT<MatrixXd>(k).info() != Eigen::Success) throw std::runtime_error("a truth is a mechanism or buckles");
  // M x = K x / omega²: the stiffness is the definite one of the two, and the lowest modes come out best.
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(m, k);
  const VectorXd& inverse = eigen.eigenvalues();
  const Index n = inverse.size();
  Index kept = 0;
  while (kept < n && inverse[n - 1 - kept] > kMassless * inverse[n - 1]) ++kept;
  FrameModes out{VectorXd(kept), MatrixXd::Zero(unknowns_, kept)};
  for (Index i = 0; i < kept; ++i) {
    const double value = inverse[n - 1 - i];
    out.omega2[i] = 1.0 / value;
    for (std::size_t r = 0; r < at.size(); ++r)
      out.shapes(at[r], i) = eigen.eigenvectors()(static_cast<Index>(r), n - 1 - i) / std::sqrt(value);
  }
  return out;
}

VectorXd PlaneFrame::displacement(const VectorXd& load) const {
  const std::vector<int> at = free();
  const VectorXd moved = Eigen::LLT<MatrixXd>(stiffness()(at, at)).solve(VectorXd(load(at)));
  VectorXd out = VectorXd::Zero(unknowns_);
  for (std::size_t r = 0; r < at.size(); ++r) out[at[r]] = moved[static_cast<Index>(r)];
  return out;
}

FrameModes with_varying_spring(const FrameModes& modes, const Movement& stretch, const std::function<double(double)>& N_m,
                               int count, int keep) {
  constexpr int kSteps = 3;  // the stiffness changes slowly with frequency: the third step moves less than 1e-4 of the second
  const Index n = std::min<Index>(keep, modes.omega2.size());
  VectorXd b = VectorXd::Zero(n);
  for (const Part& part : stretch) b += part.factor * modes.shapes.row(part.unknown).head(n).transpose();
  FrameModes out{VectorXd(count), MatrixXd(modes.shapes.rows(), count)};
  for (Index mode = 0; mode < count; ++mode) {
    double omega2 = modes.omega2[mode];
    for (int step = 0; step < kSteps; ++step) {
      MatrixXd k = N_m(std::sqrt(omega2)) * b * b.transpose();
      k.diagonal() += modes.omega2.head(n);
      const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(k);
      omega2 = eigen.eigenvalues()[mode];
      out.shapes.col(mode) = modes.shapes.leftCols(n) * eigen.eigenvectors().col(mode);
    }
    out.omega2[mode] = omega2;
  }
  return out;
}

}  // namespace twindeck::blind::form
