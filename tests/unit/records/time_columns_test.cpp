// Oracle: matrices with a column of time at a known rate, wherever it stands, in every format.
#include "records/time_columns.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "npy_double.hpp"
#include "same_samples.hpp"

namespace twindeck::records {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTimedRate_Hz = 128.0;

VectorXd even_seconds() { return VectorXd::LinSpaced(400, 0.0, 399.0 / kTimedRate_Hz); }

/// The samples with a column more.
MatrixXd with_column(const VectorXd& column, Index at) {
  const MatrixXd samples = same_samples();
  MatrixXd wide(samples.rows(), samples.cols() + 1);
  wide << samples.leftCols(at), column, samples.rightCols(samples.cols() - at);
  return wide;
}

TEST(TimeColumn, InAnyColumnOfAMatrixInEveryFormat) {
  const Scratch scratch;
  for (const bool transposed : {false, true}) {
    for (Index at = 0; at <= 4; ++at) {
      const MatrixXd timed = with_column(even_seconds(), at), matrix = transposed ? MatrixXd(timed.transpose()) : timed;
      io::write_npy(matrix, scratch.file("a.npy"));
      write_mat(scratch.file("5.mat"), matrix, MAT_FT_MAT5, true);
      write_mat(scratch.file("73.mat"), matrix, MAT_FT_MAT73, false);
      for (const char* name : {"a.npy", "5.mat", "73.mat"}) {
        const Record record = read(scratch.file(name));
        EXPECT_EQ(record.samples, same_samples()) << name << transposed << at;
        EXPECT_NEAR(record.info.rate_Hz, kTimedRate_Hz, 1e-6) << name << at;
        EXPECT_EQ(record.info.channels.back().position, at < 4 ? 5 : 4) << name << at;
      }
    }
  }
}

TEST(TimeColumn, InAnyUnit) {
  const Scratch scratch;
  for (const double per_second : {1.0, 1e3, 1e6, 1.0 / 86400.0}) {
    for (const double since : {0.0, 1.7e9}) {
      const VectorXd stamps = per_second * (even_seconds().array() + (per_second < 1.0 ? 0.0 : since));
      io::write_npy(with_column(stamps, 4), scratch.file("a.npy"));
      EXPECT_NEAR(read(scratch.file("a.npy")).info.rate_Hz, kTimedRate_Hz, 1e-2) << per_second << " " << since;
    }
  }
}

TEST(TimeColumn, TheFinestOfSeveralIsTheClock) {
  const Scratch scratch;
  MatrixXd matrix(400, 6);
  matrix << VectorXd((1.7e9 + even_seconds().array()).floor()), same_samples(), even_seconds();
  write_mat(scratch.file("a.mat"), matrix, MAT_FT_MAT5, true);
  const Record record = read(scratch.file("a.mat"));
  EXPECT_EQ(record.samples, same_samples());
  EXPECT_NEAR(record.info.rate_Hz, kTimedRate_Hz, 1e-6);
  EXPECT_NE(record.info.rate_source.find("column 6"), std::string::npos);
}

TEST(TimeColumn, VectorsOfWhichOneRunsLikeTime) {
  const Scratch scratch;
  const std::string file = scratch.file("v.mat").string();
  mat_t* mat = Mat_CreateVer(file.c_str(), nullptr, MAT_FT_MAT5);
  add_variable(mat, "P1", same_samples().col(0), MAT_COMPRESSION_NONE);
  add_variable(mat, "axis", even_seconds(), MAT_COMPRESSION_NONE);
  add_variable(mat, "P2", same_samples().col(1), MAT_COMPRESSION_NONE);
  Mat_Close(mat);
  const Record record = read(file);
  EXPECT_EQ(record.samples, same_samples().leftCols(2));
  EXPECT_EQ(record.info.channels.back().name, "P2");
  EXPECT_NEAR(record.info.rate_Hz, kTimedRate_Hz, 1e-6);
}

TEST(TimeColumn, ASlowMotionThatRisesIsAChannel) {
  const Scratch scratch;
  const VectorXd swell = (even_seconds().array() / 4.0).sin() + 0.001 * even_seconds().array(),
                 counter = VectorXd::LinSpaced(400, 1, 400);
  for (const VectorXd& column : {swell, counter}) {
    io::write_npy(with_column(column, 4), scratch.file("a.npy"));
    EXPECT_EQ(read(scratch.file("a.npy")).samples.cols(), 5);
  }
}

}  // namespace
}  // namespace twindeck::records
