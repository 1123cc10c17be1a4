#pragma once

#include <matio.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "records/record.hpp"
#include "scratch.hpp"

namespace twindeck::records {

/// Samples that each format can hold exactly: whole multiples of 1/64 below 32.
inline Eigen::MatrixXd same_samples() {
  Eigen::MatrixXd data(400, 4);
  for (int t = 0; t < 400; ++t) {
    for (int c = 0; c < 4; ++c) data(t, c) = ((37 * t + 1001 * c) % 4096 - 2048) / 64.0;
  }
  return data;
}

inline std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline void add_variable(mat_t* mat, const char* name, const Eigen::MatrixXd& values, matio_compression compression) {
  Eigen::MatrixXd copy = values;
  std::size_t dims[2] = {static_cast<std::size_t>(copy.rows()), static_cast<std::size_t>(copy.cols())};
  matvar_t* variable = Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims, copy.data(), 0);
  Mat_VarWrite(mat, variable, compression);
  Mat_VarFree(variable);
}

/// `acc` and `fs` = 128 Hz, written by matio.
inline void write_mat(const std::filesystem::path& file, const Eigen::MatrixXd& samples, mat_ft version, bool compressed) {
  mat_t* mat = Mat_CreateVer(file.c_str(), nullptr, version);
  const auto compression = compressed ? MAT_COMPRESSION_ZLIB : MAT_COMPRESSION_NONE;
  add_variable(mat, "acc", samples, compression);
  add_variable(mat, "fs", Eigen::MatrixXd::Constant(1, 1, 128.0), compression);
  Mat_Close(mat);
}

}  // namespace twindeck::records
