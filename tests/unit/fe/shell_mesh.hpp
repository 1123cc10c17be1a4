#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <functional>
#include <vector>

#include "fe/beam.hpp"
#include "fe/shell_quad.hpp"
#include "fe/shell_triangle.hpp"

/// Small meshes and dense algebra for tests of elements: assembly as in a textbook, apart from the product's own.
namespace twindeck::fe::testing_mesh {

struct Mesh {
  std::vector<Eigen::Vector3d> node_m;
  std::vector<std::vector<int>> element;  ///< 2, 3 or 4 nodes each
  [[nodiscard]] int dofs() const { return 6 * static_cast<int>(node_m.size()); }
};

[[nodiscard]] inline ShellGeometry shell_of(const Mesh& mesh, const std::vector<int>& e) {
  ShellGeometry g;
  for (std::size_t i = 0; i < 4; ++i) g.node_m[i] = mesh.node_m[static_cast<std::size_t>(e[i])];
  return g;
}

[[nodiscard]] inline TriangleGeometry triangle_of(const Mesh& mesh, const std::vector<int>& e) {
  TriangleGeometry g;
  for (std::size_t i = 0; i < 3; ++i) g.node_m[i] = mesh.node_m[static_cast<std::size_t>(e[i])];
  return g;
}

/// The mesh with every `each`-th quadrilateral cut into two triangles, along one diagonal and the other in turn.
[[nodiscard]] inline Mesh cut(const Mesh& mesh, std::size_t each) {
  Mesh result{mesh.node_m, {}};
  for (std::size_t i = 0; i < mesh.element.size(); ++i) {
    const std::vector<int>& q = mesh.element[i];
    if (i % each != 0) {
      result.element.push_back(q);
    } else if (i / each % 2 == 0) {
      result.element.push_back({q[0], q[1], q[2]});
      result.element.push_back({q[0], q[2], q[3]});
    } else {
      result.element.push_back({q[1], q[2], q[3]});
      result.element.push_back({q[1], q[3], q[0]});
    }
  }
  return result;
}

[[nodiscard]] inline BeamGeometry beam_of(const Mesh& mesh, const std::vector<int>& e) {
  BeamGeometry g;
  for (std::size_t i = 0; i < 2; ++i) g.node_m[i] = mesh.node_m[static_cast<std::size_t>(e[i])];
  return g;
}

/// nx × ny quadrilaterals over the unit square, carried to space by `map`; node (i, j) has number j (nx + 1) + i.
[[nodiscard]] inline Mesh grid(int nx, int ny, const std::function<Eigen::Vector3d(double, double)>& map) {
  Mesh mesh;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) mesh.node_m.push_back(map(static_cast<double>(i) / nx, static_cast<double>(j) / ny));
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int a = j * (nx + 1) + i;
      mesh.element.push_back({a, a + 1, a + nx + 2, a + nx + 1});
    }
  return mesh;
}

/// n two-node elements from the origin along X.
[[nodiscard]] inline Mesh line(int n, double length_m) {
  Mesh mesh;
  for (int i = 0; i <= n; ++i) mesh.node_m.emplace_back(length_m * i / n, 0.0, 0.0);
  for (int i = 0; i < n; ++i) mesh.element.push_back({i, i + 1});
  return mesh;
}

/// Sum of element matrices (6 dofs a node).
[[nodiscard]] inline Eigen::MatrixXd assemble(const Mesh& mesh,
                                              const std::function<Eigen::MatrixXd(const std::vector<int>&)>& matrix) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(mesh.dofs(), mesh.dofs());
  for (const std::vector<int>& e : mesh.element) {
    const Eigen::MatrixXd k = matrix(e);
    for (std::size_t a = 0; a < e.size(); ++a)
      for (std::size_t b = 0; b < e.size(); ++b)
        sum.block<6, 6>(6 * e[a], 6 * e[b]) +=
            k.block<6, 6>(6 * static_cast<Eigen::Index>(a), 6 * static_cast<Eigen::Index>(b));
  }
  return sum;
}

/// The numbers of the degrees of freedom that are not fixed.
class Freedom {
 public:
  explicit Freedom(const Mesh& mesh) : free_(static_cast<std::size_t>(mesh.dofs()), true) {}
  void fix(int node, const std::vector<int>& directions) {
    for (const int d : directions) free_[static_cast<std::size_t>(6 * node + d)] = false;
  }
  void fix_everywhere(const std::vector<int>& directions) {
    for (std::size_t node = 0; node < free_.size() / 6; ++node) fix(static_cast<int>(node), directions);
  }
  [[nodiscard]] std::vector<int> numbers() const {
    std::vector<int> n;
    for (std::size_t i = 0; i < free_.size(); ++i)
      if (free_[i]) n.push_back(static_cast<int>(i));
    return n;
  }

 private:
  std::vector<bool> free_;
};

/// Displacements (all dofs, `prescribed` where fixed) of K u = f.
[[nodiscard]] inline Eigen::VectorXd solve(const Eigen::MatrixXd& k, const Eigen::VectorXd& f, const Freedom& freedom,
                                           const Eigen::VectorXd& prescribed) {
  const std::vector<int> n = freedom.numbers();
  Eigen::VectorXd u = prescribed;
  for (const int i : n) u[i] = 0.0;
  const Eigen::VectorXd load = f - k * u;
  const Eigen::MatrixXd reduced = k(n, n);
  const Eigen::VectorXd right = load(n);
  const Eigen::VectorXd x = reduced.ldlt().solve(right);
  u(n) = x;
  return u;
}

[[nodiscard]] inline Eigen::VectorXd solve(const Eigen::MatrixXd& k, const Eigen::VectorXd& f, const Freedom& freedom) {
  return solve(k, f, freedom, Eigen::VectorXd::Zero(k.rows()));
}

/// The lowest `count` eigenvalues λ of K x = λ M x, M semi-definite allowed (solved as M x = K x / λ).
[[nodiscard]] inline Eigen::VectorXd lowest_eigenvalues(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m,
                                                        const Freedom& freedom, int count) {
  const std::vector<int> n = freedom.numbers();
  const Eigen::MatrixXd kr = k(n, n), mr = m(n, n);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(mr, kr, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().reverse().head(count).cwiseInverse();
}

/// MacNeal and Harder (1985), figure 1: five quadrilaterals, none rectangular, over 0.24 × 0.12; nodes 0-3 are the corners.
[[nodiscard]] inline Mesh macneal_patch() {
  Mesh mesh;
  mesh.node_m = {{0.0, 0.0, 0.0},   {0.24, 0.0, 0.0},  {0.24, 0.12, 0.0}, {0.0, 0.12, 0.0},
                 {0.04, 0.02, 0.0}, {0.18, 0.03, 0.0}, {0.16, 0.08, 0.0}, {0.08, 0.08, 0.0}};
  mesh.element = {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}};
  return mesh;
}

/// Displacements (6 a node) of a rigid motion: d = 0-2 along x y z, 3-5 a small turn about them.
template <typename Nodes>
[[nodiscard]] Eigen::VectorXd rigid_motion_of(const Nodes& node_m, int d) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(6 * static_cast<Eigen::Index>(node_m.size()));
  const Eigen::Vector3d e = Eigen::Vector3d::Unit(d % 3);
  for (std::size_t i = 0; i < node_m.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(6 * i);
    u.segment<3>(at) = d < 3 ? e : e.cross(node_m[i]);
    if (d >= 3) u.segment<3>(at + 3) = e;
  }
  return u;
}

/// Linear u, v with the drilling rotation that belongs to them: u,x = exx, u,y = uy, v,x = vx, v,y = eyy.
struct LinearMembrane {
  double exx, eyy, uy, vx;
  [[nodiscard]] Eigen::VectorXd at(const std::vector<Eigen::Vector3d>& node_m) const {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(6 * static_cast<Eigen::Index>(node_m.size()));
    for (std::size_t i = 0; i < node_m.size(); ++i) {
      const auto first = static_cast<Eigen::Index>(6 * i);
      const Eigen::Vector3d& x = node_m[i];
      u[first] = exx * x.x() + uy * x.y();
      u[first + 1] = vx * x.x() + eyy * x.y();
      u[first + 5] = 0.5 * (vx - uy);
    }
    return u;
  }
};

/// Rank of a stiffness matrix that must not have a negative eigenvalue.
[[nodiscard]] inline int shell_rank(const Eigen::MatrixXd& k) {
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
  EXPECT_GT(values.minCoeff(), -1e-10 * values.maxCoeff());
  return static_cast<int>((values.array() > 1e-9 * values.maxCoeff()).count());
}

}  // namespace twindeck::fe::testing_mesh
