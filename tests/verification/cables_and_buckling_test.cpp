/// Geometric stiffness: sagging stays, Euler columns; observed orders of convergence of the linear elements.
#include <Eigen/Dense>

#include "fe/large_displacement.hpp"
#include "hanging_chain.hpp"
#include "verification_models.hpp"

namespace twindeck::fe::verification {
namespace {

constexpr double kSpan = 100.0, kMass = 10.0, kGravity = 9.81;

/// A horizontal stay of 80 bars that sags by 1/400 of its span, held at both ends.
struct Stay {
  Model model;
  double horizontal_N;
};
Stay sagging_stay(double axial_EA_N, int n = 80) {
  const double h = kMass * kGravity * kSpan / (8.0 / 400.0);
  const HangingChain chain = hang_chain({0, 0, 0}, {kSpan, 0, 0}, kMass * kGravity, h, n);
  Stay stay{with_material(axial_EA_N / 1e-3, 0.3, kMass / 1e-3), h};
  stay.model.gravity_m_s2 = kGravity;
  stay.model.formulation.lumped_mass = true;
  Section s;
  s.name = "cable";
  s.area_m2 = 1e-3;
  stay.model.sections.push_back(s);
  for (const Eigen::Vector3d& x : chain.node_m) add_node(stay.model, x.x(), x.y(), x.z());
  for (int i = 0; i < n; ++i)
    add_element(stay.model, ElementType::bar, "stay", 0, 0, {i, i + 1}).pull_N = chain.tension_N[static_cast<std::size_t>(i)];
  fix(stay.model, 0, {0, 1, 2});
  fix(stay.model, n, {0, 1, 2});
  return stay;
}

/// First symmetric in-plane root of tan(Ω/2) = Ω/2 - (4/λ²) (Ω/2)³ (Irvine 1981, equation 3.24), Ω between π and 3π.
double irvine_root(double lambda2) {
  const auto f = [lambda2](double half) {
    return std::sin(half) - std::cos(half) * (half - 4.0 / lambda2 * half * half * half);
  };
  double low = 0.5 * kPi + 1e-9, high = 1.5 * kPi - 1e-9;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    ((f(low) < 0.0) == (f(middle) < 0.0) ? low : high) = middle;
  }
  return 2.0 * low;
}

// Oracle: Irvine's theory of the shallow elastic cable, λ² = (m g l/H)² l EA/(H L_e). The bars hang in equilibrium, so their
// tangent is about the sagged shape. 0.1 %: sag 1/400 and 80 bars.
TEST(Cables, SaggingStayAgainstIrvine) {
  const double ratio = 8.0 / 400.0, effective = kSpan * (1.0 + ratio * ratio / 8.0);
  for (const double lambda2 : {0.1, 0.5, 2.6, 10.0}) {
    const double h = kMass * kGravity * kSpan / ratio;
    const Stay stay = sagging_stay(lambda2 * h * effective / (ratio * ratio * kSpan));
    const Eigen::VectorXd f = frequencies_Hz(stay.model, 4);
    const double string = std::sqrt(stay.horizontal_N / kMass) / (2.0 * kSpan);  // first mode across the plane
    const double symmetric = irvine_root(lambda2) / kPi * string;
    std::vector<double> targets = {string, symmetric, 2.0 * string, 2.0 * string};  // across, in plane, second ones
    std::vector<const char*> names = {"across the plane", "symmetric in plane", "second, in or across", "second, in or across"};
    for (std::size_t i = 0; i < 4; ++i)
      check(fmt::format("Irvine, lambda² = {:g}: {} [Hz]", lambda2, names[i]), targets[i], f[static_cast<Eigen::Index>(i)],
            1e-3);
  }
}

// Oracle: Ernst (1965): the horizontal stiffness at the end of a sagging stay is E_eq A / l with the modulus that one bar has.
TEST(Cables, ChainOfBarsHasErnstsModulus) {
  const double ea = 2e8;
  Stay stay = sagging_stay(ea);
  const int end = static_cast<int>(stay.model.nodes.size()) - 1;
  stay.model.supports.pop_back();
  fix(stay.model, end, {1, 2});
  Eigen::VectorXd load = no_load(stay.model);
  load[6 * end] = 1.0;
  const double stiffness = 1.0 / displacements(stay.model, load)[6 * end];
  const Dischinger ernst{kMass / 1e-3 * kGravity, kSpan, stay.horizontal_N / 1e-3};
  check("Ernst's modulus of a sagging stay, 80 bars [N/m]", ernst.modulus(ea / 1e-3) * 1e-3 / kSpan, stiffness, 2e-3);
}

// Oracle: equilibrium. The chain stays where it hangs under its own weight, in linear statics and with large displacements.
TEST(Cables, HangingChainsStayWhereTheyAre) {
  Stay stay = sagging_stay(2e8, 20);
  stay.model.prestress.rule = PullRule::given;
  for (const Displacements kind : {Displacements::linear, Displacements::large}) {
    stay.model.prestress.displacements = kind;
    const PrestressState state = find_prestress(stay.model, {});
    ASSERT_TRUE(state.status.converged) << state.status.message;
    check(
        fmt::format("hanging chain under its weight, {} displacement [m]", kind == Displacements::linear ? "linear" : "large"),
        0.0, state.displacement.cwiseAbs().maxCoeff(), 1e-8);
    EXPECT_NEAR(state.axial_force_N[10] / stay.model.elements[10].pull_N, 1.0, 1e-8);
  }
}

// Oracle: Euler's four columns, N = c EI/L², smallest eigenvalue of K φ = N (-K_G(-1)) φ; eight beams.
TEST(Buckling, EulerColumns) {
  struct Column {
    const char* name;
    double factor;
    std::vector<int> foot, head;
  };
  for (const Column& column :
       {Column{"clamped-free", kPi * kPi / 4, {0, 2, 4}, {}}, Column{"pinned-pinned", kPi * kPi, {0, 2}, {2}},
        Column{"clamped-pinned", 20.190728557, {0, 2, 4}, {2}}, Column{"clamped-clamped", 4 * kPi * kPi, {0, 2, 4}, {2, 4}}}) {
    Model model = with_material(210e9, 0.3, 7850.0);
    model.sections.push_back(beam_section(1e-2, 1e-5, 1e-5, 2e-5, 0.0));
    const int foot = add_node(model, 0, 0, 0), head = add_beams(model, foot, {4, 0, 0}, 8);
    fix_everywhere(model, {1, 3, 5});
    fix(model, foot, column.foot);
    fix(model, head, column.head);
    PrestressState state;
    state.stay_pull_N = Eigen::VectorXd::Zero(8);
    state.axial_force_N = Eigen::VectorXd::Constant(8, -1e3);
    const auto dense = [](const linalg::SparseMatrix& lower) {
      return Eigen::MatrixXd(linalg::SparseMatrix(lower.selfadjointView<Eigen::Lower>()));
    };
    const Eigen::MatrixXd k = dense(assemble(model, {}).stiffness({}));
    const Eigen::MatrixXd kg = (k - dense(assemble(model, state).stiffness({}))) / 1e3;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(kg, k, Eigen::EigenvaluesOnly);
    check(fmt::format("Euler column, {}: N L²/EI", column.name), column.factor,
          1.0 / solver.eigenvalues().maxCoeff() * 16.0 / (210e9 * 1e-5), 1e-3);
  }
}

/// Order of the error between meshes of n and 2n.
double order(double coarse, double fine, double exact) { return std::log2((coarse - exact) / (fine - exact)); }

// Oracle: theory. Frequencies of Hermite beams with consistent mass converge as h⁴, with lumped mass as h⁴ too when
// the ends are pinned (as h² with a free end, which the unit tests show), of thin plates and bricks as h² (Hughes 2000, section
// 7).
TEST(Convergence, FrequenciesOfEachElement) {
  const auto beam = [](int n, bool lumped) {
    Model model = with_material(200e9, 0.3, 8000.0);
    model.formulation.lumped_mass = lumped;
    model.formulation.beam_rotary_inertia = false;
    model.sections.push_back(beam_section(1e-2, 1e-5, 1e-5, 2e-5, 0.0));
    const int a = add_node(model, 0, 0, 0), b = add_beams(model, a, {10, 0, 0}, n);
    fix_everywhere(model, {0, 1, 3, 5});
    fix(model, a, {2}), fix(model, b, {2});
    return frequencies_Hz(model, 2)[1];
  };
  const double exact = 4 * kPi / 200.0 * std::sqrt(200e9 * 1e-5 / (8000 * 1e-2));
  check("observed order, beam with consistent mass, second mode, 4 to 8", 4.0, order(beam(4, false), beam(8, false), exact),
        0.1);
  check("observed order, beam with lumped mass, second mode, 8 to 16", 4.0, order(beam(8, true), beam(16, true), exact), 0.1);

  const auto plate = [](int n) {
    Model model = with_material(200e9, 0.3, 8000.0);
    model.formulation.shell_rotary_inertia = false;
    add_shells(model, n, n, 0.05, [](double x, double y) { return Eigen::Vector3d(10 * x, 10 * y, 0); });
    fix_everywhere(model, {0, 1, 5});
    for (int i = 0; i <= n; ++i) {
      fix(model, i, {2, 4}), fix(model, n * (n + 1) + i, {2, 4});
      fix(model, i * (n + 1), {2, 3}), fix(model, i * (n + 1) + n, {2, 3});
    }
    return frequencies_Hz(model, 1)[0];
  };
  const double rigidity = 200e9 * std::pow(0.05, 3) / (12 * 0.91);
  check("observed order, DKQ plate, first mode, 6 to 12", 2.0,
        order(plate(6), plate(12), kPi / 100.0 * std::sqrt(rigidity / (8000 * 0.05))), 0.1);

  // Longitudinal waves of a bar of solids with ν = 0: (1/4L) √(E/ρ), third mode.
  const auto bar = [](int n) {
    Model model = with_material(200e9, 0.0, 8000.0);
    add_solids(model, n, 1, 1, [](double x, double y, double z) { return Eigen::Vector3d(10 * x, y, z); });
    fix_everywhere(model, {1, 2});
    fix_where(model, {0}, [](const Eigen::Vector3d& x) { return x.x() == 0.0; });
    return frequencies_Hz(model, 2)[1];
  };
  check("observed order, solids, second longitudinal mode, 6 to 12", 2.0, order(bar(6), bar(12), 3.0 * 5000.0 / 40.0), 0.1);
}

}  // namespace
}  // namespace twindeck::fe::verification
