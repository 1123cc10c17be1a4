#include "fe/corotational.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "fe/beam_frame.hpp"

namespace twindeck::fe::corotational {

namespace {

using beam::cross_matrix;
using Spin = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// Axes of the frame as columns and the spin of the frame (in its own axes) from displacements and spins of the points (in its
/// own axes), (3 × 6p).
struct FrameState {
  Eigen::Matrix3d axes;
  Spin spin;
};

/// Orthonormal axes with the first along a and the third along a × b.
Eigen::Matrix3d axes_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Eigen::Matrix3d axes;
  axes.col(0) = a.normalized();
  axes.col(2) = axes.col(0).cross(b).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

/// For a frame made of two vectors a (first axis) and b (in the plane of the first two): δω from δa, δb in its own axes,
///   ω_z = δa_y/|a|,  ω_y = -δa_z/|a|,  ω_x = (δb_z + ω_y b_x)/b_y.
struct TwoVectors {
  double length, bx, by;
  [[nodiscard]] Eigen::Matrix3d from_a() const {
    Eigen::Matrix3d g = Eigen::Matrix3d::Zero();
    g(2, 1) = 1.0 / length;
    g(1, 2) = -1.0 / length;
    g(0, 2) = -bx / (by * length);
    return g;
  }
  [[nodiscard]] Eigen::Matrix3d from_b() const {
    Eigen::Matrix3d g = Eigen::Matrix3d::Zero();
    g(0, 2) = 1.0 / by;
    return g;
  }
};

/// The frame of two vectors, x along the first, and what its spin is made of; the spin is still zero.
std::pair<FrameState, TwoVectors> frame_along(const Eigen::Vector3d& a, const Eigen::Vector3d& b, std::size_t nodes) {
  FrameState f;
  f.axes = axes_of(a, b);
  const Eigen::Vector3d local = f.axes.transpose() * b;
  f.spin = Spin::Zero(3, 6 * static_cast<Eigen::Index>(nodes));
  return {f, {a.norm(), local.x(), local.y()}};
}

FrameState chord_frame(const std::vector<Eigen::Vector3d>& x, const Eigen::Vector3d& across, const Motion& motion) {
  const Eigen::Vector3d chord = x[1] - x[0];
  const Eigen::Vector3d q1 = motion.rotation[0] * across, q2 = motion.rotation[1] * across;
  auto [f, vectors] = frame_along(chord, 0.5 * (q1 + q2), 2);
  f.spin.block<3, 3>(0, 0) = -vectors.from_a();
  f.spin.block<3, 3>(0, 6) = vectors.from_a();
  for (int end = 0; end < 2; ++end) {  // δq = ½ (δω₁ × q₁ + δω₂ × q₂)
    const Eigen::Vector3d local = f.axes.transpose() * (end == 0 ? q1 : q2);
    f.spin.block<3, 3>(0, 6 * end + 3) = -0.5 * vectors.from_b() * cross_matrix(local);
  }
  return f;
}

FrameState quad_frame(const std::vector<Eigen::Vector3d>& x) {
  const Eigen::Vector3d d13 = x[2] - x[0], d24 = x[3] - x[1];
  FrameState f;
  f.axes.col(2) = d13.cross(d24).normalized();
  f.axes.col(0) = (d13 - d24).normalized();
  f.axes.col(1) = f.axes.col(2).cross(f.axes.col(0));
  const Eigen::Vector3d a = f.axes.transpose() * d13, b = f.axes.transpose() * d24;
  const double twice_area = a.x() * b.y() - a.y() * b.x(), length = (a - b).x();
  // The normal: δ(d13 × d24) turns it by ω_x = (a_x δb_z - b_x δa_z)/2A, ω_y = (a_y δb_z - b_y δa_z)/2A; in its plane the
  // first axis turns by ω_z = (δa_y - δb_y)/|d13 - d24|.
  Eigen::Matrix3d from_a = Eigen::Matrix3d::Zero(), from_b = Eigen::Matrix3d::Zero();
  from_a(0, 2) = -b.x() / twice_area;
  from_a(1, 2) = -b.y() / twice_area;
  from_b(0, 2) = a.x() / twice_area;
  from_b(1, 2) = a.y() / twice_area;
  from_a(2, 1) = 1.0 / length;
  from_b(2, 1) = -1.0 / length;
  f.spin = Spin::Zero(3, 24);
  f.spin.block<3, 3>(0, 0) = -from_a;
  f.spin.block<3, 3>(0, 12) = from_a;
  f.spin.block<3, 3>(0, 6) = -from_b;
  f.spin.block<3, 3>(0, 18) = from_b;
  return f;
}

/// Of three points; the further ones of a solid do not turn the frame.
FrameState triangle_frame(const std::vector<Eigen::Vector3d>& x) {
  auto [f, vectors] = frame_along(x[1] - x[0], x[2] - x[0], x.size());
  f.spin.block<3, 3>(0, 0) = -vectors.from_a() - vectors.from_b();
  f.spin.block<3, 3>(0, 6) = vectors.from_a();
  f.spin.block<3, 3>(0, 12) = vectors.from_b();
  return f;
}

/// Of the eight corners; the nodes on edges do not turn the frame.
FrameState box_frame(const std::vector<Eigen::Vector3d>& x) {
  constexpr std::array<double, 8> along = {-1, 1, 1, -1, -1, 1, 1, -1}, across = {-1, -1, 1, 1, -1, -1, 1, 1};
  Eigen::Vector3d a = Eigen::Vector3d::Zero(), b = a;
  for (std::size_t i = 0; i < 8; ++i) a += 0.25 * along[i] * x[i], b += 0.25 * across[i] * x[i];
  auto [f, vectors] = frame_along(a, b, x.size());
  for (int i = 0; i < 8; ++i) {
    const auto s = static_cast<std::size_t>(i);
    f.spin.block<3, 3>(0, 6 * i) = 0.25 * (along[s] * vectors.from_a() + across[s] * vectors.from_b());
  }
  return f;
}

FrameState frame_at(const Element& element, const std::vector<Eigen::Vector3d>& x, const Motion& motion) {
  switch (element.frame) {
    case Frame::chord:
      return chord_frame(x, element.across, motion);
    case Frame::quad:
      return quad_frame(x);
    case Frame::triangle:
    case Frame::corner:
      return triangle_frame(x);
    case Frame::box:
      return box_frame(x);
  }
  TWINDECK_ASSERT(false);
  return {};
}

Eigen::Vector3d mean_of(const std::vector<Eigen::Vector3d>& x) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& each : x) sum += each;
  return sum / static_cast<double>(x.size());
}

struct Means {
  Eigen::Vector3d start_m, displacement_m;
};

/// Deformation in the turned frame, with differences of displacements rather than of positions: those carry the digits.
/// @return H Rᵀ (6p × 6p), block by block
Eigen::MatrixXd deform(const Element& element, const Motion& motion, const Means& means, Response& response) {
  const auto n = static_cast<Eigen::Index>(6 * element.start_m.size());
  const Eigen::Matrix3d& r = response.rotation;
  const Eigen::Matrix3d turned_back = r.transpose() - Eigen::Matrix3d::Identity();
  const bool solid = element.frame == Frame::box || element.frame == Frame::corner;  // whose nodes have no rotations
  response.deformation.resize(n);
  Eigen::MatrixXd h = Eigen::MatrixXd::Identity(n, n);
  for (std::size_t a = 0; a < element.start_m.size(); ++a) {
    const auto at = static_cast<Eigen::Index>(6 * a);
    const Eigen::Vector3d theta =
        solid ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : rotation_vector(r.transpose() * motion.rotation[a]);
    response.deformation.segment<3>(at) =
        r.transpose() * (motion.displacement_m[a] - means.displacement_m) + turned_back * (element.start_m[a] - means.start_m);
    response.deformation.segment<3>(at + 3) = theta;
    h.block<3, 3>(at, at) = r.transpose();
    h.block<3, 3>(at + 3, at + 3) = spin_to_vector(theta) * r.transpose();
  }
  return h;
}

/// G: spin of the frame in global axes.
Spin turned_spin(const FrameState& frame) {
  Spin g(3, frame.spin.cols());
  for (Eigen::Index block = 0; block < g.cols(); block += 3)
    g.middleCols<3>(block) = frame.axes * frame.spin.middleCols<3>(block) * frame.axes.transpose();
  return g;
}

/// S (6p × 3): displacements and spins of the points in a rigid turn about `centre`, in global axes.
Eigen::MatrixXd levers(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& centre) {
  Eigen::MatrixXd s(6 * std::ssize(points), 3);
  for (std::size_t a = 0; a < points.size(); ++a) {
    const auto at = static_cast<Eigen::Index>(6 * a);
    s.block<3, 3>(at, 0) = -cross_matrix(points[a] - centre);
    s.block<3, 3>(at + 3, 0).setIdentity();
  }
  return s;
}

/// The symmetric part of the tangent: material stiffness and what the turning frame does to the force.
Eigen::MatrixXd tangent(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& h, const Eigen::MatrixXd& s, const Spin& g,
                        const Eigen::VectorXd& force) {
  const Eigen::Index n = force.size();
  const Eigen::MatrixXd hp = h - (h * s) * g;
  Spin fn = Spin::Zero(3, n);
  Eigen::MatrixXd fnm(n, 3);
  for (Eigen::Index at = 0; at < n; at += 6) {
    fnm.block<3, 3>(at, 0) = cross_matrix(force.segment<3>(at));
    fnm.block<3, 3>(at + 3, 0) = cross_matrix(force.segment<3>(at + 3));
    fn.middleCols<3>(at) = cross_matrix(force.segment<3>(at));
  }
  const Eigen::MatrixXd turned = fnm - g.transpose() * (s.transpose() * fnm);  // Pᵀ F_nm
  Eigen::MatrixXd sum;
  sum.noalias() = hp.transpose() * (stiffness * hp);
  sum.noalias() -= turned * g;
  sum.noalias() += g.transpose() * fn;
  return 0.5 * (sum + sum.transpose());
}

}  // namespace

Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& rotation) {
  // From the quaternion: accurate for small angles, where the trace is not.
  const Eigen::Quaterniond q(rotation);
  const double sine = q.vec().norm();
  if (sine < 1e-300) return Eigen::Vector3d::Zero();
  const double angle = 2.0 * std::atan2(sine, std::abs(q.w()));
  return (q.w() < 0.0 ? -1.0 : 1.0) * angle / sine * q.vec();
}

Eigen::Matrix3d rotation_of(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle == 0.0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

Eigen::Matrix3d spin_to_vector(const Eigen::Vector3d& theta) {
  const double angle = theta.norm();
  const double eta = angle < 0.05 ? 1.0 / 12.0 + angle * angle / 720.0  // next term angle⁴/30240
                                  : (1.0 - 0.5 * angle / std::tan(0.5 * angle)) / (angle * angle);
  const Eigen::Matrix3d s = cross_matrix(theta);
  return Eigen::Matrix3d::Identity() - 0.5 * s + eta * s * s;
}

Response respond(const Element& element, const Motion& motion, bool with_tangent) {
  const std::size_t p = element.start_m.size();
  std::vector<Eigen::Vector3d> now = element.start_m;
  for (std::size_t a = 0; a < p; ++a) now[a] += motion.displacement_m[a];
  const Motion still{std::vector<Eigen::Vector3d>(p, Eigen::Vector3d::Zero()),
                     std::vector<Eigen::Matrix3d>(p, Eigen::Matrix3d::Identity())};
  const FrameState frame = frame_at(element, now, motion);
  Response response;
  response.rotation = frame.axes * frame_at(element, element.start_m, still).axes.transpose();
  const Means means{mean_of(element.start_m), mean_of(motion.displacement_m)};
  const Eigen::MatrixXd h = deform(element, motion, means, response);
  const Eigen::VectorXd force = h.transpose() * (element.stiffness * response.deformation);

  // The projector I - G' S' takes out the rigid turn (the stiffness itself takes out translations).
  const Spin g = turned_spin(frame);
  const Eigen::MatrixXd s = levers(now, means.start_m + means.displacement_m);
  const Eigen::Vector3d unbalanced = s.transpose() * force;
  response.force = force - g.transpose() * unbalanced;
  if (with_tangent) response.tangent = tangent(element.stiffness, h, s, g, force);
  return response;
}

BarResponse respond_bar(const std::array<Eigen::Vector3d, 2>& start_m, const Motion& motion, double axial_EA_N,
                        double initial_tension_N) {
  const Eigen::Vector3d before = start_m[1] - start_m[0], stretch = motion.displacement_m[1] - motion.displacement_m[0];
  const Eigen::Vector3d now = before + stretch;
  const double l0 = before.norm(), l = now.norm();
  const Eigen::Vector3d e = now / l;
  // (l² - l0²)/(l + l0): the difference of two nearly equal lengths without loss of digits.
  const double elongation = stretch.dot(before + now) / (l + l0);
  BarResponse bar;
  bar.tension_N = initial_tension_N + axial_EA_N * elongation / l0;
  bar.force << -bar.tension_N * e, bar.tension_N * e;
  const Eigen::Matrix3d along = e * e.transpose();
  const Eigen::Matrix3d k = axial_EA_N / l0 * along + bar.tension_N / l * (Eigen::Matrix3d::Identity() - along);
  bar.tangent << k, -k, -k, k;
  return bar;
}

}  // namespace twindeck::fe::corotational
