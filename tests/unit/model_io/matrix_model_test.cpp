/// Oracle: matrices written down by hand. Two masses between two walls, three springs:
///   K = [k1 + k2, -k2; -k2, k2 + k3],  M = diag(m1, m2),  with k2 = 1000 theta_a the first parameter and m2 = theta_b the
///   second.
#include "model_io/matrix_model.hpp"

#include "matrix_io/matrix_market.hpp"
#include "model_io/any_model_folder.hpp"
#include "model_io/export_matrices.hpp"
#include "test_folder.hpp"

namespace twindeck::model_io::test {
namespace {

const char* const kModel =
    "title = \"two masses\"\n[matrices]\nK = \"K0.mtx\"\nM = \"M0.mtx\"\n"
    "[[parameter]]\nname = \"a\"\nmatrix = \"Ka.mtx\"\ntarget = \"stiffness\"\ninitial = 2.0\nlower = 1.0\nupper = 4.0\n"
    "[[parameter]]\nname = \"b\"\nmatrix = \"Mb.mtx\"\ntarget = \"mass\"\ninitial = 5.0\nlower = 0.0\nupper = 9.0\n";
const char* const kHead = "%%MatrixMarket matrix coordinate real symmetric\n";

void write_two_masses(const TestFolder& folder) {
  folder.write("model.toml", kModel);
  folder.write("dofs.csv", "dof,node,direction,x_m,y_m,z_m\n1,left,x,0,,\n2,right,x,,,\n");
  folder.write("K0.mtx", std::string(kHead) + "2 2 2\n1 1 300\n2 2 500\n");
  folder.write("M0.mtx", std::string(kHead) + "2 2 1\n1 1 7\n");
  folder.write("Ka.mtx", std::string(kHead) + "2 2 3\n1 1 1000\n2 1 -1000\n2 2 1000\n");
  folder.write("Mb.mtx", std::string(kHead) + "2 2 1\n2 2 1\n");
}

Eigen::Matrix2d dense(const linalg::SparseMatrix& lower) {
  return Eigen::MatrixXd(Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>());
}

TEST(MatrixModel, AddsUpWhatWasWrittenByHand) {
  const TestFolder folder;
  write_two_masses(folder);
  EXPECT_TRUE(is_matrix_model(folder.path()));
  const fe::ParametricSystem system = read_matrix_model(folder.path());
  ASSERT_EQ(system.size(), 2);
  EXPECT_EQ(system.initial(), Eigen::Vector2d(2.0, 5.0));
  const Eigen::Vector2d theta(3.0, 6.0);
  Eigen::Matrix2d k, m;
  k << 3300.0, -3000.0, -3000.0, 3500.0;
  m << 7.0, 0.0, 0.0, 6.0;
  EXPECT_EQ(dense(system.stiffness(theta)), k);
  EXPECT_EQ(dense(system.mass(theta)), m);
  EXPECT_EQ(system.expand(Eigen::Vector2d(1.0, 2.0)), Eigen::MatrixXd(Eigen::Vector2d(1.0, 2.0)));
}

TEST(MatrixModel, DerivativesAreTheParametersMatrices) {
  const TestFolder folder;
  write_two_masses(folder);
  const fe::ParametricSystem system = read_matrix_model(folder.path());
  const Eigen::Vector2d x(1.0, -2.0);
  // Also where a coefficient is zero: theta = 0 is a value like any other.
  for (const Eigen::Vector2d& theta : {Eigen::Vector2d(3.0, 6.0), Eigen::Vector2d(0.0, 0.0)}) {
    EXPECT_EQ(system.stiffness_derivative_times(theta, 0, x), Eigen::MatrixXd(Eigen::Vector2d(3000.0, -3000.0)));
    EXPECT_EQ(system.mass_derivative_times(theta, 1, x), Eigen::MatrixXd(Eigen::Vector2d(0.0, -2.0)));
    EXPECT_EQ(system.stiffness_derivative_times(theta, 1, x), Eigen::MatrixXd(Eigen::Vector2d::Zero()));
  }
}

TEST(MatrixModel, CarriesLabelsAndParameters) {
  const TestFolder folder;
  write_two_masses(folder);
  const fe::ParametricSystem system = read_matrix_model(folder.path());
  EXPECT_EQ(system.dofs[1].node, "right");
  EXPECT_EQ(system.dofs[1].direction, 0);
  EXPECT_EQ(system.dofs[0].x_m.x(), 0.0);
  EXPECT_TRUE(std::isnan(system.dofs[1].x_m.x()));
  EXPECT_EQ(system.parameters[0].target, fe::Target::matrix_stiffness);
  EXPECT_EQ(system.parameters[1].target, fe::Target::matrix_mass);
  EXPECT_EQ(system.parameters[1].of, std::vector<std::string>{"b"});
  EXPECT_EQ(system.parameters[0].upper, 4.0);
}

TEST(MatrixModel, RoundTripKeepsEveryBit) {
  const TestFolder folder;
  write_two_masses(folder);
  folder.edit("Ka.mtx", "2 1 -1000", "2 1 -333.33333333333331");
  folder.edit("model.toml", "initial = 2.0", "initial = 1.1000000000000001");
  const fe::ParametricSystem a = read_matrix_model(folder.path());
  write_matrix_model(a, folder.path() / "again");
  const fe::ParametricSystem b = read_matrix_model(folder.path() / "again");
  EXPECT_EQ(a.initial(), b.initial());
  const Eigen::Vector2d theta(3.7, 6.1);
  EXPECT_EQ(dense(a.stiffness(theta)), dense(b.stiffness(theta)));
  EXPECT_EQ(dense(a.mass(theta)), dense(b.mass(theta)));
  EXPECT_EQ(folder.read("dofs.csv"), folder.read("again/dofs.csv"));
}

TEST(MatrixModel, OneParameterMayActOnBothMatrices) {
  // Oracle: K = K0 + t K1 and M = M0 + t M1 by hand, written as two entries of one name.
  const TestFolder folder;
  write_two_masses(folder);
  folder.edit("model.toml", "name = \"b\"", "name = \"a\"");
  EXPECT_NE(message_of([&] { (void)read_matrix_model(folder.path()); }).find("other values for the mass"), std::string::npos);
  folder.edit("model.toml", "initial = 5.0\nlower = 0.0\nupper = 9.0", "initial = 2.0\nlower = 1.0\nupper = 4.0");
  const fe::ParametricSystem system = read_matrix_model(folder.path());
  ASSERT_EQ(system.parameters.size(), 1u);
  const Eigen::VectorXd theta = Eigen::VectorXd::Constant(1, 3.0);
  EXPECT_EQ(dense(system.stiffness(theta))(1, 1), 3500.0);
  EXPECT_EQ(dense(system.mass(theta))(1, 1), 3.0);
}

TEST(MatrixModel, RefusesWhatDoesNotFit) {
  const TestFolder folder;
  const auto refused = [&](const std::string& file, const std::string& from, const std::string& to) {
    write_two_masses(folder);
    folder.edit(file, from, to);
    return message_of([&] { (void)read_matrix_model(folder.path()); });
  };
  EXPECT_NE(refused("Ka.mtx", "2 2 3\n", "3 3 3\n").find("Ka.mtx:2: is 3 x 3, but dofs.csv has 2 rows"), std::string::npos);
  EXPECT_NE(refused("Ka.mtx", "2 2 3\n", "2000000000 2000000000 3\n").find("but dofs.csv has 2 rows"), std::string::npos);
  EXPECT_NE(refused("dofs.csv", "2,right,x", "3,right,x").find("dofs.csv:3: dof: is 3, expected 2"), std::string::npos);
  EXPECT_NE(refused("dofs.csv", "2,right,x", "2,right,u").find("unknown direction 'u'"), std::string::npos);
  EXPECT_NE(refused("dofs.csv", "2,right,x", "2,left,x").find("twice"), std::string::npos);
  EXPECT_NE(refused("model.toml", "upper = 4.0", "upper = 1.5").find("lower <= initial <= upper"), std::string::npos);
  EXPECT_NE(refused("model.toml", "\"Mb.mtx\"\ntarget = \"mass\"", "\"Mb.mtx\"\ntarget = \"damping\"").find("damping"),
            std::string::npos);
  EXPECT_NE(refused("model.toml", "matrix = \"Ka.mtx\"", "matrix = \"Kx.mtx\"").find("Kx.mtx"), std::string::npos);
  EXPECT_NE(refused("model.toml", "M = \"M0.mtx\"", "").find("matrices.M"), std::string::npos);
  EXPECT_NE(message_of([&] { (void)read_model(folder.path()); }).find("matrix model"), std::string::npos);
}

// Oracle: the value of the first folder, through two fits.
TEST(MatrixModel, KeepsTheValueBeforeTheFirstFit) {
  const TestFolder folder;
  write_two_masses(folder);
  const fe::ParametricSystem system = read_matrix_model(folder.path());
  EXPECT_FALSE(system.parameters[0].nominal.has_value());
  dynamics::LoadedModel loaded = dynamics::solvable(read_model_folder(folder.path()));
  for (const double fitted : {3.0, 1.5}) {
    save_model(loaded, Eigen::Vector2d(fitted, system.parameters[1].initial), folder.path() / "fitted");
    loaded = dynamics::solvable(read_model_folder(folder.path() / "fitted"));
    EXPECT_EQ(loaded.system.parameters[0].initial, fitted);
    EXPECT_EQ(loaded.system.parameters[0].nominal, system.parameters[0].initial);
    EXPECT_FALSE(loaded.system.parameters[1].nominal.has_value());
  }
  folder.edit("fitted/model.toml", "upper = 4", "upper = 1.75");  // bounds about the fitted value
  EXPECT_FALSE(read_matrix_model(folder.path() / "fitted").parameters[0].nominal.has_value());
}

TEST(MatrixModel, ExportedMatricesAreThoseOfTheParameters) {
  const TestFolder folder;
  write_two_masses(folder);
  const fe::ParametricSystem system = read_matrix_model(folder.path());
  const Eigen::Vector2d theta(3.0, 0.0);
  write_matrices(system, theta, folder.path() / "out");
  EXPECT_EQ(dense(matrix_io::read_matrix_market(folder.path() / "out/K.mtx")), dense(system.stiffness(theta)));
  EXPECT_EQ(dense(matrix_io::read_matrix_market(folder.path() / "out/M.mtx")), dense(system.mass(theta)));
  EXPECT_EQ(folder.read("out/dofs.csv"), folder.read("dofs.csv"));
}

TEST(MatrixModel, TakesMatricesOfOutput4) {
  const TestFolder folder;
  folder.write("K.op4",
               "       3       3       6       2KGG     1P,3E23.16\n"
               "       1       1       4\n 4.0000000000000000E+00-1.0000000000000000E+00\n"
               "       2       1       6\n-1.0000000000000000E+00 5.0000000000000000E+00-2.0000000000000000E+00\n"
               "       3       2       4\n-2.0000000000000000E+00 6.0000000000000000E+00\n"
               "       4       1       1\n 1.0000000000000000E+00\n");
  folder.write("M.mtx", "%%MatrixMarket matrix coordinate real symmetric\n3 3 3\n1 1 1\n2 2 1\n3 3 1\n");
  folder.write("dofs.csv", "dof,node,direction\n1,a,x\n2,b,x\n3,c,x\n");
  folder.write("model.toml", "[matrices]\nK = \"K.op4\"\nM = \"M.mtx\"\n");
  const fe::ParametricSystem system = read_matrix_model(folder.path());
  EXPECT_EQ(system.stiffness(system.initial()).coeff(1, 0), -1.0);
  folder.write("dofs.csv", "dof,node,direction\n1,a,x\n2,b,x\n");
  const std::string message = message_of([&] { (void)read_matrix_model(folder.path()); });
  EXPECT_NE(message.find("K.op4:1: is 3 x 3, but dofs.csv has 2 rows"), std::string::npos) << message;
}

}  // namespace
}  // namespace twindeck::model_io::test
