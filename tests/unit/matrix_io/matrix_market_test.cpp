/// Oracles: identity of bits for the round trip; the format's own definition for what is read and refused.
#include "matrix_io/matrix_market.hpp"

#include "unit/model_io/test_folder.hpp"

namespace twindeck::matrix_io::test {
namespace {

using model_io::test::message_of;
using model_io::test::TestFolder;

linalg::SparseMatrix lower_of(const Eigen::MatrixXd& dense) {
  linalg::SparseMatrix lower = Eigen::MatrixXd(dense.triangularView<Eigen::Lower>()).sparseView();
  return lower;
}

std::string refusal(const TestFolder& folder, const std::string& text) {
  folder.write("A.mtx", text);
  return message_of([&] { (void)read_matrix_market(folder.path() / "A.mtx"); });
}

TEST(MatrixMarket, RoundTripKeepsEveryBit) {
  const TestFolder folder;
  Eigen::Matrix3d dense;
  dense << 1.0 / 3.0, 0.0, -2e-301, 0.0, 4e11 / 7.0, 0.1, -2e-301, 0.1, 0.0;
  write_matrix_market(lower_of(dense), folder.path() / "A.mtx");
  EXPECT_EQ(Eigen::MatrixXd(read_matrix_market(folder.path() / "A.mtx")), Eigen::MatrixXd(lower_of(dense)));
  EXPECT_TRUE(folder.read("A.mtx").starts_with("%%MatrixMarket matrix coordinate real symmetric\n3 3 4\n"));
}

TEST(MatrixMarket, ReadsGeneralFilesThatAreSymmetric) {
  const TestFolder folder;
  folder.write("A.mtx", "%%MatrixMarket matrix coordinate real general\n% a comment\n2 2 4\n1 1 2\n1 2 -1\n2 1 -1\n2 2 +3e0\n");
  Eigen::Matrix2d expected;
  expected << 2.0, 0.0, -1.0, 3.0;
  EXPECT_EQ(Eigen::MatrixXd(read_matrix_market(folder.path() / "A.mtx")), Eigen::MatrixXd(expected));
}

TEST(MatrixMarket, ReadsWhatOtherProgramsWrite) {
  // CRLF line ends, capitals, integers, blank lines.
  const TestFolder folder;
  folder.write("A.mtx", "%%matrixmarket MATRIX Coordinate Integer Symmetric\r\n2 2 2\r\n\r\n1 1 2\r\n2 1 -1\r\n");
  Eigen::Matrix2d expected;
  expected << 2.0, 0.0, -1.0, 0.0;
  EXPECT_EQ(Eigen::MatrixXd(read_matrix_market(folder.path() / "A.mtx")), Eigen::MatrixXd(expected));
}

TEST(MatrixMarket, RefusesWhatIsNotSymmetric) {
  const TestFolder folder;
  const std::string head = "%%MatrixMarket matrix coordinate real general\n";
  EXPECT_NE(refusal(folder, head + "2 2 4\n1 1 2\n1 2 -1\n2 1 -1.001\n2 2 3\n").find("not symmetric: entry (1, 2)"),
            std::string::npos);
  EXPECT_NE(refusal(folder, head + "2 2 3\n1 1 2\n1 2 -1\n2 2 3\n").find("not symmetric"), std::string::npos);
  // One part in 10^10 of the diagonal is rounding, not asymmetry.
  EXPECT_EQ(refusal(folder, head + "2 2 3\n1 1 2\n1 2 1e-10\n2 2 3\n"), "");
}

TEST(MatrixMarket, RefusesBadFilesWithTheirLine) {
  const TestFolder folder;
  const std::string head = "%%MatrixMarket matrix coordinate real symmetric\n";
  EXPECT_NE(refusal(folder, "1 1 1\n").find("A.mtx:1: is no Matrix Market file"), std::string::npos);
  EXPECT_NE(refusal(folder, "%%MatrixMarket matrix array real general\n1 1\n").find("array real general"), std::string::npos);
  EXPECT_NE(refusal(folder, "%%MatrixMarket matrix coordinate complex symmetric\n1 1 0\n").find("complex"), std::string::npos);
  EXPECT_NE(refusal(folder, head + "2 3 0\n").find("2 x 3"), std::string::npos);
  EXPECT_NE(refusal(folder, head + "2 2 1\n3 1 1.0\n").find("A.mtx:3: entry (3, 1) lies outside the 2 x 2"), std::string::npos);
  EXPECT_NE(refusal(folder, head + "2 2 1\n1 1 nan\n").find("A.mtx:3: 'nan' is not finite"), std::string::npos);
  EXPECT_NE(refusal(folder, head + "2 2 1\n1 1 x\n").find("'x' is no number"), std::string::npos);
  EXPECT_NE(refusal(folder, head + "2 2 1\n1 1\n").find("expected row, column and value"), std::string::npos);
  EXPECT_NE(refusal(folder, head + "2 2 2\n1 1 1.0\n").find("holds 1 entries, but its size line says 2"), std::string::npos);
  EXPECT_NE(refusal(folder, head + "2 2 2\n1 1 1.0\n1 1 2.0\n").find("A.mtx:4: entry (1, 1) stands twice"), std::string::npos);
  EXPECT_NE(refusal(folder, head + "2 2 1\n1 2 1.0\n").find("A.mtx:3: entry (1, 2) lies above the diagonal"),
            std::string::npos);
}

TEST(MatrixMarket, BelievesNoSizeLine) {
  const TestFolder folder;
  const std::string head = "%%MatrixMarket matrix coordinate real symmetric\n";
  EXPECT_NE(
      refusal(folder, head + "2 2 13\n1 1 1\n2 2 1\n").find("A.mtx:2: its size line says 13 entries, but 12 bytes follow"),
      std::string::npos);
  EXPECT_NE(refusal(folder, head + "2 2 9000000000000000000\n1 1 1\n").find("but 6 bytes follow"), std::string::npos);
  EXPECT_NE(refusal(folder, head + "2 2 -1\n1 1 1\n").find("says -1 entries"), std::string::npos);
  EXPECT_NE(refusal(folder, head + "2 2 1").find("but 0 bytes follow"), std::string::npos);
  EXPECT_NE(refusal(folder, head + "9999999999 9999999999 1\n1 1 1\n").find("is no number"), std::string::npos);
  // Rows cost memory each and may be empty: the caller knows how many there should be.
  folder.write("A.mtx", head + "2000000000 2000000000 1\n1 1 1\n");
  EXPECT_EQ(matrix_market_size(folder.path() / "A.mtx").rows, 2000000000);
  EXPECT_EQ(matrix_market_size(folder.path() / "A.mtx").line, 2);
}

}  // namespace
}  // namespace twindeck::matrix_io::test
