#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <filesystem>
#include <fstream>
#include <string>

/// A writer of arrays in double precision: the product reads them and writes single ones.
namespace twindeck::io {

/// A float64 array in C order, NPY version 1.
inline void write_npy(const Eigen::Ref<const Eigen::MatrixXd>& array, const std::filesystem::path& file) {
  std::string header =
      fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}), }}", array.rows(), array.cols());
  header.append(63 - (10 + header.size()) % 64, ' ');
  header += '\n';
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = array;
  std::ofstream out(file, std::ios::binary);
  out << std::string("\x93NUMPY\x01\x00", 8) << static_cast<char>(header.size()) << '\0' << header;
  out.write(reinterpret_cast<const char*>(rows.data()), static_cast<std::streamsize>(sizeof(double)) * rows.size());
}

}  // namespace twindeck::io
