/// Oracle: NAFEMS' standard problems of free vibration (Abbassian, Dawswell and Knowles 1987, "Selected Benchmarks for Natural
/// Frequency Analysis", R0015; the Standard NAFEMS Benchmarks, TNSB Rev. 3, 1990; targets compared with what the verification
/// manuals of OptiStruct, Abaqus, SolidWorks, CATIA, Fusion and Code_Aster print of them). E = 200 GPa, ν = 0.3, 8000 kg/m³
/// throughout. Tolerances: 1 % where the mesh is fine against the mode, more where the note says why.
#include "verification_models.hpp"

namespace twindeck::fe::verification {
namespace {

Model steel() { return with_material(200e9, 0.3, 8000.0); }

void compare(const char* name, const Eigen::VectorXd& ours, int first_mode, const std::vector<double>& targets,
             double tolerance) {
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const int mode = first_mode + static_cast<int>(i);
    check(fmt::format("NAFEMS {}, mode {} [Hz]", name, mode), targets[i], ours[mode - 1], tolerance);
  }
}

// Eight arms of 5 m from a common centre, tips pinned, in plane; square 0.125 m. Sixteen modes, mostly of arms alone.
TEST(NafemsVibration, FV2PinEndedDoubleCross) {
  Model model = steel();
  const double d = 0.125, i = std::pow(d, 4) / 12.0;
  model.sections.push_back(beam_section(d * d, i, i, 2.0 * i, 0.0));  // the targets are Euler's
  model.formulation.beam_rotary_inertia = false;
  const int centre = add_node(model, 0, 0, 0);
  std::vector<int> tips;
  for (int arm = 0; arm < 8; ++arm)
    tips.push_back(add_beams(model, centre, 5.0 * Eigen::Vector3d(std::cos(arm * kPi / 4), std::sin(arm * kPi / 4), 0), 8));
  fix_everywhere(model, {2, 3, 4});
  for (const int tip : tips) fix(model, tip, {0, 1});
  compare("FV2 pin-ended double cross", frequencies_Hz(model, 16), 1,
          {11.336, 17.709, 17.709, 17.709, 17.709, 17.709, 17.709, 17.709, 45.345, 57.390, 57.390, 57.390, 57.390, 57.390,
           57.390, 57.390},
          0.01);
}

// Cantilever 10 m, round 0.5 m, with 10,000 kg and 1,000 kg on rigid arms of 2 m to both sides of its tip.
TEST(NafemsVibration, FV4CantileverWithOffCentreMasses) {
  Model model = steel();
  const double a = kPi * 0.25 / 4, i = kPi * std::pow(0.5, 4) / 64;
  model.sections.push_back(beam_section(a, i, i, 2.0 * i, 0.9 * a));
  const int foot = add_node(model, 0, 0, 0), tip = add_beams(model, foot, {10, 0, 0}, 10);
  const int heavy = add_node(model, 10, 2, 0), light = add_node(model, 10, -2, 0);
  model.links = {{"heavy", tip, heavy}, {"light", tip, light}};
  model.masses = {{"m", heavy, 10000.0, Eigen::Vector3d::Zero()}, {"m", light, 1000.0, Eigen::Vector3d::Zero()}};
  fix(model, foot, {0, 1, 2, 3, 4, 5});
  compare("FV4 off-centre masses", frequencies_Hz(model, 6), 1, {1.723, 1.727, 7.413, 9.972, 18.155, 26.957}, 0.01);
}

// Free ring of radius 1 m, round 0.1 m; the targets are those of a thin ring (Timoshenko, no shear), which ours is a little
// below.
TEST(NafemsVibration, FV6CircularRing) {
  Model model = steel();
  const double a = kPi * 0.01 / 4, i = kPi * 1e-4 / 64;
  model.sections.push_back(beam_section(a, i, i, 2.0 * i, 0.0));
  model.formulation.beam_rotary_inertia = false;
  const int n = 60;
  for (int k = 0; k < n; ++k) add_node(model, std::cos(2 * kPi * k / n), std::sin(2 * kPi * k / n), 0);
  for (int k = 0; k < n; ++k) add_element(model, ElementType::beam, "ring", 0, 0, {k, (k + 1) % n});
  compare("FV6 circular ring", frequencies_Hz(model, 14), 7, {51.849, 51.849, 53.382, 53.382, 148.77, 148.77, 150.99, 150.99},
          0.01);
}

Model plate(int n, double thickness, bool clamped_left, bool skew) {
  Model model = steel();
  const double c = skew ? std::cos(kPi / 4) : 0.0, s = skew ? std::sin(kPi / 4) : 1.0;
  add_shells(model, n, n, thickness, [&](double x, double y) { return Eigen::Vector3d(10 * (x + c * y), 10 * s * y, 0); });
  fix_everywhere(model, {0, 1, 5});
  for (int j = 0; j <= n && clamped_left; ++j) fix(model, j * (n + 1), {2, 3, 4});
  return model;
}

TEST(NafemsVibration, FV12FreeThinSquarePlate) {
  compare("FV12 free thin square plate", frequencies_Hz(plate(16, 0.05, false, false), 10), 4,
          {1.622, 2.360, 2.922, 4.233, 4.233, 7.416, 7.416}, 0.01);
}

TEST(NafemsVibration, FV13SimplySupportedThinSquarePlate) {
  const int n = 32;
  Model model = plate(n, 0.05, false, false);
  for (int i = 0; i <= n; ++i) {
    fix(model, i, {2, 4}), fix(model, n * (n + 1) + i, {2, 4});
    fix(model, i * (n + 1), {2, 3}), fix(model, i * (n + 1) + n, {2, 3});
  }
  compare("FV13 simply supported thin square plate", frequencies_Hz(model, 8), 1,
          {2.377, 5.942, 5.942, 9.507, 11.884, 11.884, 15.449, 15.449}, 0.01);
}

// 45 degrees skew. The moments are singular at the clamped obtuse corners and DKQ comes from below at first order there: 3.3 %
// off with 24 elements a side, 1.7 % with 48.
TEST(NafemsVibration, FV15ClampedThinRhombicPlate) {
  const int n = 48;
  Model model = plate(n, 0.05, false, true);
  for (int i = 0; i <= n; ++i)
    for (const int node : {i, n * (n + 1) + i, i * (n + 1), i * (n + 1) + n}) fix(model, node, {2, 3, 4});
  compare("FV15 clamped thin rhombic plate", frequencies_Hz(model, 6), 1, {7.938, 12.835, 17.941, 19.133, 24.009, 27.922},
          0.02);
}

TEST(NafemsVibration, FV16CantileveredThinSquarePlate) {
  compare("FV16 cantilevered thin square plate", frequencies_Hz(plate(16, 0.05, true, false), 6), 1,
          {0.421, 1.029, 2.582, 3.306, 3.753, 6.555}, 0.01);
}

// Thick plate (t/a = 0.1) with shear flexibility, which the thin shell has not: solids. Bending moves points odd in z, so the
// upper half with u = v = 0 on the middle plane is all of it and has no other modes (the benchmark holds u and v of a plate).
// Solids of 45 degrees lose bending as every parallelogram does: 7.3 % off with 16 elements a side, 3.7 % with 32.
TEST(NafemsVibration, FV22ClampedThickRhombicPlateOfSolids) {
  const int n = 32;
  Model model = steel();
  const double c = std::cos(kPi / 4);
  add_solids(model, n, n, 2,
             [&](double x, double y, double z) { return Eigen::Vector3d(10 * (x + c * y), 10 * c * y, 0.5 * z); });
  const int layer = (n + 1) * (n + 1);
  for (int node = 0; node < layer; ++node) fix(model, node, {0, 1});
  for (int k = 0; k <= 2; ++k)
    for (int i = 0; i <= n; ++i)
      for (const int node : {i, n * (n + 1) + i, i * (n + 1), i * (n + 1) + n}) fix(model, k * layer + node, {0, 1, 2});
  compare("FV22 clamped thick rhombic plate (solids)", frequencies_Hz(model, 4), 1, {133.95, 201.41, 265.81, 283.68}, 0.04);
}

// Plane stress in its plane: depth 5 m at the clamp to 1 m at the tip, 10 m long.
TEST(NafemsVibration, FV32CantileveredTaperedMembrane) {
  Model model = steel();
  const int nx = 40, ny = 20;
  add_shells(model, nx, ny, 0.05, [](double x, double y) { return Eigen::Vector3d(10 * x, (y - 0.5) * (5 - 4 * x), 0); });
  fix_everywhere(model, {2, 3, 4});
  for (int j = 0; j <= ny; ++j) fix(model, j * (nx + 1), {0, 1});
  compare("FV32 cantilevered tapered membrane", frequencies_Hz(model, 6), 1, {44.623, 130.03, 162.70, 246.05, 379.90, 391.44},
          0.01);
}

// 10 × 10 × 1 m, held in z along the lower edges alone: three rigid modes, then four plate modes with shear and, eighth to
// tenth, three in the plane. 4 %: the bending targets are closed forms of a thick plate held at its middle plane; held at a
// lower edge a solid is softer (44.76 Hz with the benchmark's own bricks of 20 nodes).
TEST(NafemsVibration, FV52SimplySupportedSolidPlate) {
  const int n = 16;
  Model model = steel();
  add_solids(model, n, n, 3, [](double x, double y, double z) { return Eigen::Vector3d(10 * x, 10 * y, z); });
  for (int i = 0; i <= n; ++i)
    for (const int node : {i, n * (n + 1) + i, i * (n + 1), i * (n + 1) + n}) fix(model, node, {2});
  compare("FV52 simply supported solid plate", frequencies_Hz(model, 10), 4,
          {45.897, 109.44, 109.44, 167.89, 193.59, 206.19, 206.19}, 0.04);
}

/// Holds a node along a direction that is not an axis: a spring some thousand times as stiff as the solids beside it.
void hold(Model& model, int node, const Eigen::Vector3d& direction) {
  Spring spring;
  spring.name = fmt::format("hold_{}", model.springs.size() + 1);
  spring.group = "hold";
  spring.node = node;
  spring.direction = direction.normalized();
  spring.stiffness = 1e14;
  model.springs.push_back(spring);
}

// Free cylinder 10 m long, mean radius 2 m, wall 0.4 m; modes that keep its symmetry: a sector of 3 degrees, both faces held
// across. The first is rigid, then length, and four of the wall's bending with hardly any distance between them.
TEST(NafemsVibration, FV41FreeCylinder) {
  Model model = steel();
  const int nr = 6, nz = 80;
  const double angle = kPi / 60;
  add_solids(model, nr, 1, nz, [&](double x, double y, double z) {
    return Eigen::Vector3d((1.8 + 0.4 * x) * std::cos(angle * y), (1.8 + 0.4 * x) * std::sin(angle * y), 10 * z);
  });
  for (int k = 0; k <= nz; ++k) {
    for (int i = 0; i <= nr; ++i) {
      fix(model, 2 * k * (nr + 1) + i, {1});
      hold(model, (2 * k + 1) * (nr + 1) + i, {-std::sin(angle), std::cos(angle), 0});
    }
  }
  compare("FV41 free cylinder (solids)", frequencies_Hz(model, 6), 2, {243.53, 377.41, 394.11, 397.72, 405.28}, 0.01);
}

// Hollow sphere, radii 1.8 and 6 m, breathing: a spike of 3 by 3 degrees whose edges move along themselves alone. The closed
// form (spherical Bessel functions, no stress at either radius) gives the published targets but for the fourth, 2117.0 for
// 2111.7.
TEST(NafemsVibration, FV42ThickHollowSphere) {
  Model model = steel();
  const int nr = 40;
  const double half = std::tan(kPi / 120);
  const auto direction = [&](double x, double y) {
    return Eigen::Vector3d(half * (2 * x - 1), half * (2 * y - 1), 1.0).normalized();
  };
  add_solids(model, 1, 1, nr, [&](double x, double y, double z) { return Eigen::Vector3d((1.8 + 4.2 * z) * direction(x, y)); });
  for (int node = 0; node < 4 * (nr + 1); ++node) {
    const Eigen::Vector3d along = direction(node % 2, node / 2 % 2);
    hold(model, node, along.cross(Eigen::Vector3d::UnitX()));
    hold(model, node, along.cross(along.cross(Eigen::Vector3d::UnitX())));
  }
  compare("FV42 thick hollow sphere (solids)", frequencies_Hz(model, 5), 1, {369.91, 838.03, 1451.2, 2117.0, 2795.8}, 0.01);
}

}  // namespace
}  // namespace twindeck::fe::verification
