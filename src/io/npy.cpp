#include "io/npy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "io/atomic.hpp"

namespace twindeck::io {
namespace fs = std::filesystem;
using Eigen::Index;
static_assert(std::endian::native == std::endian::little, "NPY data are read and written as they lie in memory");

namespace {

constexpr char kMagic[] = "\x93NUMPY";

struct Header {
  std::string type;  // "f8", "f4", "i2", "i4"
  std::size_t item_size = 8;
  bool fortran_order = false;
  Index rows = 0, columns = 1;
};

[[noreturn]] void refuse(const fs::path& file, const std::string& problem, const std::string& mend) {
  throw InputError({file.string(), 0, ""}, problem, mend);
}

std::string header_text(std::ifstream& in, const fs::path& file) {
  char start[8] = {};
  if (!in.read(start, 8) || std::memcmp(start, kMagic, 6) != 0) refuse(file, "is no NPY file", "write it with numpy.save");
  const int size_bytes = start[6] == 1 ? 2 : 4;
  unsigned char digits[4] = {};
  in.read(reinterpret_cast<char*>(digits), size_bytes);
  const std::size_t length = digits[0] + 256UL * digits[1] + 65536UL * digits[2] + 16777216UL * digits[3];
  if (!in || length > 1000000) refuse(file, "ends within its header, or has none", "write the file again");
  std::string text(length, ' ');
  if (!in.read(text.data(), static_cast<std::streamsize>(length))) refuse(file, "ends within its header", "write the file again");
  return text;
}

Header parse(const std::string& text, const fs::path& file) {
  std::smatch match;
  Header header;
  if (!std::regex_search(text, match, std::regex("'descr':\\s*'([^']*)'"))) refuse(file, "has a header without 'descr'", "give a plain array");
  const std::string type = match[1];
  if (type != "<f8" && type != "<f4" && type != "<i2" && type != "<i4") {
    refuse(file, fmt::format("holds type '{}', expected '<f8', '<f4', '<i2' or '<i4'", type), "convert it with array.astype('<f8')");
  }
  header.type = type.substr(1);
  header.item_size = static_cast<std::size_t>(type.back() - '0');
  header.fortran_order = std::regex_search(text, std::regex("'fortran_order':\\s*True"));
  if (!std::regex_search(text, match, std::regex("'shape':\\s*\\(\\s*(\\d+)\\s*,\\s*(?:(\\d+)\\s*,?\\s*)?\\)"))) {
    refuse(file, "has an array of another shape than one or two dimensions", "reshape it to samples x channels");
  }
  header.rows = std::stol(match[1]);
  if (match[2].matched) header.columns = std::stol(match[2]);
  return header;
}

template <typename T>
double value_at(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof(T));
  return static_cast<double>(value);
}

double value_of(const std::string& type, const char* at) {
  if (type == "f8") return value_at<double>(at);
  if (type == "f4") return value_at<float>(at);
  return type == "i2" ? value_at<std::int16_t>(at) : value_at<std::int32_t>(at);
}

}  // namespace

std::pair<Index, Index> visit_npy(const fs::path& file, const BlockVisitor& visit) {
  std::ifstream in(file, std::ios::binary);
  if (!in) refuse(file, "cannot be read", "check its name and your permissions");
  const Header header = parse(header_text(in, file), file);
  const auto found = static_cast<std::uintmax_t>(fs::file_size(file) - static_cast<std::uintmax_t>(in.tellg()));
  const auto expected = static_cast<std::uintmax_t>(header.rows) * static_cast<std::uintmax_t>(header.columns) * header.item_size;
  if (found != expected) {
    refuse(file, fmt::format("holds {} bytes of data, expected {} for {} x {} values", found, expected, header.rows, header.columns),
           "the file was cut off or is damaged; copy it again");
  }
  constexpr Index kValues = 131072;
  std::vector<char> buffer;
  const auto read = [&](Index values) {
    buffer.resize(static_cast<std::size_t>(values) * header.item_size);
    in.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
  };
  const auto value = [&](Index k) { return value_of(header.type, buffer.data() + static_cast<std::size_t>(k) * header.item_size); };
  Eigen::MatrixXd block;
  if (header.fortran_order) {
    for (Index column = 0; column < header.columns; ++column) {
      for (Index row = 0; row < header.rows; row += kValues) {
        const Index n = std::min(kValues, header.rows - row);
        read(n);
        block.resize(n, 1);
        for (Index k = 0; k < n; ++k) block(k, 0) = value(k);
        visit(row, column, block);
      }
    }
    return {header.rows, header.columns};
  }
  const Index chunk = std::max<Index>(1, kValues / std::max<Index>(1, header.columns));
  for (Index row = 0; row < header.rows; row += chunk) {
    const Index n = std::min(chunk, header.rows - row);
    read(n * header.columns);
    block.resize(n, header.columns);
    for (Index k = 0; k < n; ++k) {
      for (Index c = 0; c < header.columns; ++c) block(k, c) = value(k * header.columns + c);
    }
    visit(row, 0, block);
  }
  return {header.rows, header.columns};
}

Eigen::MatrixXd read_npy(const fs::path& file) {
  Eigen::MatrixXd array;
  std::ifstream in(file, std::ios::binary);
  if (!in) refuse(file, "cannot be read", "check its name and your permissions");
  const Header header = parse(header_text(in, file), file);
  in.close();
  // The size is checked before anything is asked of the memory: a damaged header must not ask for all of it.
  const auto least = static_cast<std::uintmax_t>(header.rows) * static_cast<std::uintmax_t>(header.columns) * header.item_size;
  if (least <= fs::file_size(file)) array.resize(header.rows, header.columns);
  visit_npy(file, [&](Index row, Index column, const Eigen::MatrixXd& block) { array.block(row, column, block.rows(), block.cols()) = block; });
  return array;
}

namespace {

/// @tparam T  double or float @param type  its NPY name
template <typename T>
void write_array(const Eigen::Ref<const Eigen::MatrixXd>& array, const fs::path& file, const char* type) {
  std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}, {}), }}", type, array.rows(), array.cols());
  // Magic, version, two bytes of length: the data begin at a multiple of 64.
  header.append(63 - (10 + header.size()) % 64, ' ');
  header.push_back('\n');
  std::string content(kMagic, 6);
  content += std::string("\x01\x00", 2);
  content.push_back(static_cast<char>(header.size() % 256));
  content.push_back(static_cast<char>(header.size() / 256));
  content += header;
  const Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = array.cast<T>();
  content.append(reinterpret_cast<const char*>(rows.data()), static_cast<std::size_t>(rows.size()) * sizeof(T));
  write_file_atomically(file, content);
}

}  // namespace

void write_npy(const Eigen::Ref<const Eigen::MatrixXd>& array, const fs::path& file) { write_array<double>(array, file, "<f8"); }

void write_npy_single(const Eigen::Ref<const Eigen::MatrixXd>& array, const fs::path& file) { write_array<float>(array, file, "<f4"); }

}  // namespace twindeck::io
