/// Oracle: the definition of a covariance; matrices of two and three rows whose eigenvalues are known by hand.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.hpp"
#include "npy_double.hpp"
#include "records/feature_rows.hpp"

namespace twindeck::records {
namespace {

class Covariance : public ::testing::Test {
 protected:
  void SetUp() override {
    file_ = std::filesystem::temp_directory_path() /
            (std::string("twindeck_covariance_") + ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".npy");
  }
  void TearDown() override { std::filesystem::remove(file_); }

  std::string refusal(const Eigen::MatrixXd& c, Eigen::Index n_rows) const {
    io::write_npy(c, file_);
    try {
      (void)read_covariance(file_, n_rows);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path file_;
};

TEST_F(Covariance, IsReadWhole) {
  const Eigen::Matrix2d c{{4e-6, 1e-6}, {1e-6, 9e-6}};
  io::write_npy(c, file_);
  EXPECT_EQ(read_covariance(file_, 2), Eigen::MatrixXd(c));
  EXPECT_EQ(refusal(Eigen::Vector2d(1e-30, 1e12).asDiagonal(), 2), "");  // units of their own: only correlations are compared
}

TEST_F(Covariance, HasTheRowsOfTheTable) {
  EXPECT_NE(refusal(Eigen::Matrix2d::Identity(), 3).find("is 2 x 2, but rows.csv has 3 rows"), std::string::npos);
  EXPECT_NE(refusal(Eigen::MatrixXd::Ones(3, 1), 3).find("is 3 x 1, but rows.csv has 3 rows"), std::string::npos);
}

TEST_F(Covariance, HasPositiveVariances) {
  EXPECT_NE(refusal(Eigen::Vector3d(1.0, 0.0, 1.0).asDiagonal(), 3).find("the variance of row 2 of rows.csv is 0"),
            std::string::npos);
  EXPECT_NE(refusal(Eigen::Vector3d(1.0, 1.0, -4.0).asDiagonal(), 3).find("the variance of row 3 of rows.csv is -4"),
            std::string::npos);
  EXPECT_NE(refusal(Eigen::Vector2d(1.0, std::nan("")).asDiagonal(), 2).find("row 2"), std::string::npos);
  EXPECT_NE(refusal(Eigen::Vector2d(1.0, 1e300).asDiagonal(), 2).find("row 2 of rows.csv is 1e+300"), std::string::npos);
  EXPECT_NE(refusal(Eigen::Matrix2d{{1.0, INFINITY}, {INFINITY, 1.0}}, 2).find("not finite"), std::string::npos);
}

TEST_F(Covariance, IsSymmetric) {
  EXPECT_NE(
      refusal(Eigen::Matrix2d{{1.0, 0.1}, {0.2, 1.0}}, 2).find("is not symmetric: entry (1, 2) is 0.1, entry (2, 1) is 0.2"),
      std::string::npos);
  EXPECT_EQ(refusal(Eigen::Matrix2d{{1.0, 0.1}, {0.1 + 1e-12, 1.0}}, 2), "");  // rounding
}

TEST_F(Covariance, IsPositiveDefinite) {
  EXPECT_NE(refusal(Eigen::Matrix2d{{1.0, 2.0}, {2.0, 1.0}}, 2).find("rows 1 and 2 of rows.csv have a correlation of 2"),
            std::string::npos);
  EXPECT_NE(refusal(Eigen::Matrix2d{{1.0, 2.0}, {2.0, 4.0}}, 2).find("a correlation of 1"), std::string::npos);
  // Every pair is sound, the first three together are not (eigenvalue 1 - 2 x 0.9); then the sum of two rows as a third.
  Eigen::Matrix4d c = Eigen::Matrix4d::Identity();
  c.topLeftCorner<3, 3>() = Eigen::Matrix3d{{1.0, -0.9, -0.9}, {-0.9, 1.0, -0.9}, {-0.9, -0.9, 1.0}};
  EXPECT_NE(refusal(c, 4).find("is not positive definite: row 3 of rows.csv follows from the rows before it"),
            std::string::npos);
  Eigen::Matrix<double, 4, 3> from;
  from << 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.0;
  EXPECT_NE(refusal(from * from.transpose(), 4).find("row 4 of rows.csv follows"), std::string::npos);
}

}  // namespace
}  // namespace twindeck::records
