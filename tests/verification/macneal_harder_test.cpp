/// Oracle: MacNeal and Harder (1985), Finite Elements in Analysis and Design 1, 3-20, the part that elements_published_test.cpp
/// does not hold: solids, curved beam of shells, pinched cylinder, hemisphere; and the patch tests of shells and solids through
/// the product's assembly.
#include <Eigen/Dense>

#include "verification_models.hpp"

namespace twindeck::fe::verification {
namespace {

double mean(const Eigen::VectorXd& u, const std::vector<int>& nodes, int direction) {
  double sum = 0.0;
  for (const int node : nodes) sum += u[6 * node + direction];
  return sum / static_cast<double>(nodes.size());
}

Eigen::VectorXd equal_loads(const Model& model, const std::vector<int>& nodes, int direction, double total) {
  Eigen::VectorXd f = no_load(model);
  for (const int node : nodes) f[6 * node + direction] += total / static_cast<double>(nodes.size());
  return f;
}

/// Slender bodies along x: `map` carries (along, across, up) of the unit cube, clamped at along = 0.
struct SolidBeam {
  Model model;
  std::vector<int> tip;
};
SolidBeam solid_beam(double nu, double e, int nx, int ny, int nz,
                     const std::function<Eigen::Vector3d(double, double, double)>& map) {
  SolidBeam beam{with_material(e, nu, 1.0), {}};
  add_solids(beam.model, nx, ny, nz, map);
  for (int k = 0; k < (ny + 1) * (nz + 1); ++k) {
    fix(beam.model, k * (nx + 1), {0, 1, 2});
    beam.tip.push_back(k * (nx + 1) + nx);
  }
  return beam;
}

double tip_displacement(const SolidBeam& beam, int direction) {
  return mean(displacements(beam.model, equal_loads(beam.model, beam.tip, direction, 1.0)), beam.tip, direction);
}

// Six bricks, 6 × 0.2 × 0.1. The clamp holds all displacements, so Poisson's ratio stiffens the end a little. Extension,
// bending in both planes; distorted bricks lose bending as every eight-node solid with these modes does (MacNeal 1987):
// recorded.
TEST(MacNealHarder, StraightBeamOfSolids) {
  const auto distorted = [](double sign_upper, bool alternating) {
    return [=](double x, double y, double z) {
      const int column = static_cast<int>(std::lround(6 * x));
      double shift = 0.0;
      if (column > 0 && column < 6) {
        if (alternating)
          shift = (column + static_cast<int>(std::lround(y))) % 2 == 0 ? 0.1 : -0.1;
        else
          shift = y < 0.5 ? -sign_upper * 0.1 : sign_upper * 0.1;
      }
      return Eigen::Vector3d(6 * x + shift, 0.2 * y, 0.1 * z);
    };
  };
  const SolidBeam regular = solid_beam(0.3, 1e7, 6, 1, 1, distorted(0.0, false));
  check("MacNeal-Harder straight beam, 6 solids, extension", 3e-5, tip_displacement(regular, 0), 0.02);
  check("MacNeal-Harder straight beam, 6 solids, in plane", 0.1081, tip_displacement(regular, 1), 0.03);
  check("MacNeal-Harder straight beam, 6 solids, out of plane", 0.4321, tip_displacement(regular, 2), 0.03);
  const SolidBeam parallelogram = solid_beam(0.3, 1e7, 6, 1, 1, distorted(1.0, false));
  record("MacNeal-Harder straight beam, 6 solids, parallelograms, in plane (weak)", 0.1081, tip_displacement(parallelogram, 1));
  record("MacNeal-Harder straight beam, 6 solids, parallelograms, out of plane (weak)", 0.4321,
         tip_displacement(parallelogram, 2));
  const SolidBeam trapezoid = solid_beam(0.3, 1e7, 6, 1, 1, distorted(1.0, true));
  record("MacNeal-Harder straight beam, 6 solids, trapezoids, in plane (locks)", 0.1081, tip_displacement(trapezoid, 1));
}

TEST(MacNealHarder, CurvedAndTwistedBeamsOfSolids) {
  const SolidBeam curved = solid_beam(0.25, 1e7, 24, 4, 2, [](double x, double y, double z) {
    const double angle = 0.5 * kPi * x, r = 4.12 + 0.2 * y;
    return Eigen::Vector3d(r * std::sin(angle), r * std::cos(angle), 0.1 * z);
  });
  check("MacNeal-Harder curved beam, 24x4x2 solids, in plane", 0.08734, tip_displacement(curved, 0), 0.03);
  check("MacNeal-Harder curved beam, 24x4x2 solids, out of plane", 0.5022, tip_displacement(curved, 2), 0.05);
  const SolidBeam twisted = solid_beam(0.22, 29e6, 24, 4, 2, [](double x, double y, double z) {
    const double turn = 0.5 * kPi * x, a = 1.1 * (y - 0.5), b = 0.32 * (z - 0.5);
    return Eigen::Vector3d(12 * x, a * std::cos(turn) - b * std::sin(turn), a * std::sin(turn) + b * std::cos(turn));
  });
  check("MacNeal-Harder twisted beam, 24x4x2 solids, along the tip's width", 0.005424, tip_displacement(twisted, 2), 0.02);
  check("MacNeal-Harder twisted beam, 24x4x2 solids, across the tip", 0.001754, tip_displacement(twisted, 1), 0.02);
}

TEST(MacNealHarder, CurvedBeamOfShells) {
  Model model = with_material(1e7, 0.25, 1.0);
  const int n = 24, m = 2;
  add_shells(model, n, m, 0.1, [](double x, double y) {
    const double angle = 0.5 * kPi * x, r = 4.12 + 0.2 * y;
    return Eigen::Vector3d(r * std::sin(angle), r * std::cos(angle), 0);
  });
  std::vector<int> tip;
  for (int j = 0; j <= m; ++j) {
    fix(model, j * (n + 1), {0, 1, 2, 3, 4, 5});
    tip.push_back(j * (n + 1) + n);
  }
  const auto tip_displacement = [&](int direction) {
    Eigen::VectorXd f = no_load(model);
    spread(f, tip, direction, 1.0);
    return mean(displacements(model, f), tip, direction);
  };
  check("MacNeal-Harder curved beam, 24x2 shells, in plane", 0.08734, tip_displacement(0), 0.03);
  // Twist of a strip half as thick as wide: a thin shell takes J = b t³/3, the real one is 0.69 of that.
  record("MacNeal-Harder curved beam, 24x2 shells, out of plane (thin-shell torsion)", 0.5022, tip_displacement(2));
}

// R = 300, L = 600, t = 3, E = 3e6, ν = 0.3, end diaphragms, two opposite unit forces at mid-length; target 1.8248e-5 (series
// of Flügge; Belytschko et al. 1985). An octant. Flat shells need a fine mesh here: the load's dimple is small.
TEST(MacNealHarder, PinchedCylinder) {
  double last = 0.0;
  for (const int n : {16, 40}) {
    Model model = with_material(3e6, 0.3, 1.0);
    add_shells(model, n, n, 3.0, [](double x, double y) {
      return Eigen::Vector3d(300 * x, 300 * std::sin(0.5 * kPi * y), 300 * std::cos(0.5 * kPi * y));
    });
    for (int i = 0; i <= n; ++i) {
      fix(model, i * (n + 1), {0, 4, 5});      // mid-length
      fix(model, i * (n + 1) + n, {1, 2, 3});  // diaphragm
      fix(model, i, {1, 3, 5});                // x-z plane, through the load
      fix(model, n * (n + 1) + i, {2, 3, 4});  // x-y plane
    }
    Eigen::VectorXd f = no_load(model);
    f[2] = -0.25;
    const double under_load = -displacements(model, f)[2];
    check(fmt::format("pinched cylinder, octant of {0}x{0} shells", n), 1.8248e-5, under_load, n == 40 ? 0.02 : 0.0);
    EXPECT_LT(std::abs(under_load - 1.8248e-5), n == 40 ? std::abs(last - 1.8248e-5) : 1.0);
    last = under_load;
  }
}

// R = 10, t = 0.04, hole of 18 degrees, E = 6.825e7, ν = 0.3, alternating forces of 2 at the equator; 0.0940 (MacNeal and
// Harder), 0.0930 (Simo, Fox and Rifai 1989). Nearly inextensional bending of a doubly curved shell: membranes that lock show
// it.
TEST(MacNealHarder, HemisphereWithAHole) {
  const int n = 24;
  Model model = with_material(6.825e7, 0.3, 1.0);
  add_shells(model, n, n, 0.04, [](double x, double y) -> Eigen::Vector3d {
    const double longitude = 0.5 * kPi * x, latitude = 0.4 * kPi * y;
    return 10.0 * Eigen::Vector3d(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                                  std::sin(latitude));
  });
  for (int j = 0; j <= n; ++j) {
    fix(model, j * (n + 1), {1, 3, 5});
    fix(model, j * (n + 1) + n, {0, 4, 5});
  }
  fix(model, n / 2, {2});
  Eigen::VectorXd f = no_load(model);
  f[0] = 1.0;
  f[6 * n + 1] = -1.0;
  check("hemisphere with a hole, quarter of 24x24 shells (Simo's target)", 0.0930, displacements(model, f)[0], 0.02);
}

Model patch_of_shells() {
  Model shells = with_material(1e6, 0.25, 1.0);
  Section s;
  s.name = "patch";
  s.thickness_m = 0.001;
  shells.sections.push_back(s);
  const double corners[8][2] = {{0, 0},       {0.24, 0},    {0.24, 0.12}, {0, 0.12},
                                {0.04, 0.02}, {0.18, 0.03}, {0.16, 0.08}, {0.08, 0.08}};
  for (const auto& x : corners) add_node(shells, x[0], x[1], 0);
  const std::vector<std::vector<int>> quads = {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}};
  for (const std::vector<int>& nodes : quads) add_element(shells, ElementType::shell, "patch", 0, 0, nodes);
  return shells;
}

Model patch_of_solids() {
  Model solids = with_material(1e6, 0.25, 1.0);
  add_solids(solids, 2, 2, 2, [](double x, double y, double z) {
    Eigen::Vector3d p(x, y, z);
    if (x == 0.5 && y == 0.5 && z == 0.5) p += Eigen::Vector3d(0.15, -0.12, 0.1);
    if (x == 0.5 && y == 0.5 && z == 0.0) p += Eigen::Vector3d(-0.1, 0.08, 0.0);
    return p;
  });
  return solids;
}

using Displacement = Eigen::Matrix<double, 6, 1>;

struct Patch {
  const char* name;
  Model model;
  std::function<Displacement(const Eigen::Vector3d&)> exact;
  std::vector<int> inner;
  double energy;
};

std::vector<Patch> patches() {
  const double d = 1e6 * 1e-9 / 12.0 / (1 - 0.0625);
  return {{"membrane",
           patch_of_shells(),
           [](const Eigen::Vector3d& x) -> Displacement {
             return (Displacement() << 1e-3 * (x.x() + 0.5 * x.y()), 1e-3 * (0.5 * x.x() + x.y()), 0, 0, 0, 0).finished();
           },
           {4, 5, 6, 7},
           0.5 * 0.24 * 0.12 * 0.001 * (2 * 1333.3333333333 * 1e-3 + 400 * 1e-3)},
          {"bending",
           patch_of_shells(),
           [](const Eigen::Vector3d& x) -> Displacement {
             return (Displacement() << 0, 0, 0.5e-3 * (x.x() * x.x() + x.x() * x.y() + x.y() * x.y()),
                     1e-3 * (0.5 * x.x() + x.y()), -1e-3 * (x.x() + 0.5 * x.y()), 0)
                 .finished();
           },
           {4, 5, 6, 7},
           0.5 * d * 0.24 * 0.12 * 1e-6 * (2.0 + 0.5 + 0.375)},
          {"solid, distorted",
           patch_of_solids(),
           [](const Eigen::Vector3d& x) -> Displacement {
             return (Displacement() << 1e-3 * (x.x() + 0.5 * (x.y() + x.z())), 1e-3 * (x.y() + 0.5 * (x.x() + x.z())),
                     1e-3 * (x.z() + 0.5 * (x.x() + x.y())), 0, 0, 0)
                 .finished();
           },
           {13},
           0.5 * (3 * 2000.0 * 1e-3 + 3 * 400.0 * 1e-3)}};
}

// Constant strain through a patch whose inner nodes are anywhere: energy of the exact answer, and the inner nodes' error.
TEST(MacNealHarder, PatchTests) {
  for (const Patch& patch : patches()) {
    const ParametricSystem system = assemble(patch.model, {});
    const Eigen::MatrixXd k = linalg::SparseMatrix(system.stiffness({}).selfadjointView<Eigen::Lower>());
    Eigen::VectorXd full = no_load(patch.model);
    for (int i = 0; i < std::ssize(patch.model.nodes); ++i)
      full.segment<6>(6 * i) = patch.exact(patch.model.nodes[static_cast<std::size_t>(i)].x_m);
    Eigen::VectorXd exact(system.size());
    std::vector<Eigen::Index> inner, outer;
    for (Eigen::Index i = 0; i < system.size(); ++i) {
      const DofLabel& dof = system.dofs[static_cast<std::size_t>(i)];
      const int node = static_cast<int>(std::stol(dof.node)) - 1;
      exact[i] = full[6 * node + dof.direction];
      (std::find(patch.inner.begin(), patch.inner.end(), node) != patch.inner.end() ? inner : outer).push_back(i);
    }
    const Eigen::MatrixXd kii = k(inner, inner), kio = k(inner, outer);
    const Eigen::VectorXd known = exact(outer), wanted = exact(inner);
    const Eigen::VectorXd found = kii.ldlt().solve(-kio * known);
    check(fmt::format("patch test, {}: inner nodes, relative error", patch.name), 0.0, (found - wanted).norm() / wanted.norm(),
          1e-10);
    check(fmt::format("patch test, {}: energy", patch.name), patch.energy, 0.5 * exact.dot(k * exact), 1e-10);
  }
}

}  // namespace
}  // namespace twindeck::fe::verification
