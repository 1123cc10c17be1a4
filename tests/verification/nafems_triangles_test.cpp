/// Oracle: NAFEMS' plates and membrane of free vibration (sources in nafems_vibration_test.cpp) with every four-node shell cut
/// into two triangles, and with every second one cut.
#include "verification_models.hpp"

namespace twindeck::fe::verification {
namespace {

struct TrianglePlate {
  int n;              ///< four-node shells a side before they are cut
  std::size_t each;   ///< every `each`-th is cut
  bool skew = false;  ///< 45 degrees
};

Model triangle_plate(const TrianglePlate& p) {
  Model model = with_material(200e9, 0.3, 8000.0);
  const double c = p.skew ? std::cos(kPi / 4) : 0.0, s = p.skew ? std::sin(kPi / 4) : 1.0;
  add_shells(model, p.n, p.n, 0.05, [&](double x, double y) { return Eigen::Vector3d(10 * (x + c * y), 10 * s * y, 0); });
  cut_shells(model, p.each);
  fix_everywhere(model, {0, 1, 5});
  return model;
}

void compare_triangles(const std::string& name, const Eigen::VectorXd& ours, int first_mode, const std::vector<double>& targets,
                       double tolerance) {
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const int mode = first_mode + static_cast<int>(i);
    check(fmt::format("{}, mode {} [Hz]", name, mode), targets[i], ours[mode - 1], tolerance);
  }
}

const char* mesh_words(std::size_t each) { return each == 1 ? "triangles" : "mixed mesh"; }

TEST(NafemsTriangles, FV12FreeThinSquarePlate) {
  for (const std::size_t each : {1U, 2U})
    compare_triangles(fmt::format("NAFEMS FV12 free plate ({})", mesh_words(each)),
                      frequencies_Hz(triangle_plate({16, each}), 10), 4, {1.622, 2.360, 2.922, 4.233, 4.233, 7.416, 7.416},
                      0.02);
}

TEST(NafemsTriangles, FV16CantileveredThinSquarePlate) {
  for (const std::size_t each : {1U, 2U}) {
    Model model = triangle_plate({16, each});
    for (int j = 0; j <= 16; ++j) fix(model, j * 17, {2, 3, 4});
    compare_triangles(fmt::format("NAFEMS FV16 cantilevered plate ({})", mesh_words(each)), frequencies_Hz(model, 6), 1,
                      {0.421, 1.029, 2.582, 3.306, 3.753, 6.555}, 0.02);
  }
}

// Closed form (Navier): halving the elements leaves a quarter of the error.
TEST(NafemsTriangles, FV13SimplySupportedPlateConverges) {
  const auto modes = [](int n, std::size_t each) {
    Model model = triangle_plate({n, each});
    for (int i = 0; i <= n; ++i) {
      fix(model, i, {2, 4}), fix(model, n * (n + 1) + i, {2, 4});
      fix(model, i * (n + 1), {2, 3}), fix(model, i * (n + 1) + n, {2, 3});
    }
    return frequencies_Hz(model, 4);
  };
  for (const std::size_t each : {1U, 2U}) {
    const Eigen::VectorXd coarse = modes(12, each), fine = modes(24, each);
    compare_triangles(fmt::format("NAFEMS FV13 supported plate ({})", mesh_words(each)), fine, 1, {2.377, 5.942, 5.942, 9.507},
                      0.01);
    EXPECT_GT(std::abs(coarse[3] / 9.5066 - 1.0), 2.5 * std::abs(fine[3] / 9.5066 - 1.0));
  }
}

// 20 x 10, half as fine as with four-node shells: the fifth mode is 3 % high.
TEST(NafemsTriangles, FV32CantileveredTaperedMembrane) {
  for (const std::size_t each : {1U, 3U}) {
    Model model = with_material(200e9, 0.3, 8000.0);
    const int nx = 20, ny = 10;
    add_shells(model, nx, ny, 0.05, [](double x, double y) { return Eigen::Vector3d(10 * x, (y - 0.5) * (5 - 4 * x), 0); });
    cut_shells(model, each);
    fix_everywhere(model, {2, 3, 4});
    for (int j = 0; j <= ny; ++j) fix(model, j * (nx + 1), {0, 1});
    compare_triangles(fmt::format("NAFEMS FV32 tapered membrane ({})", mesh_words(each)), frequencies_Hz(model, 6), 1,
                      {44.623, 130.03, 162.70, 246.05, 379.90, 391.44}, 0.04);
  }
}

}  // namespace
}  // namespace twindeck::fe::verification
