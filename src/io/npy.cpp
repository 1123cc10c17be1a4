#include "io/npy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/letters.hpp"
#include "io/atomic.hpp"
#include "io/regular_file.hpp"

namespace twindeck::io {
namespace fs = std::filesystem;
using Eigen::Index;
static_assert(std::endian::native == std::endian::little, "NPY data are read and written as they lie in memory");

namespace {

constexpr char kMagic[] = "\x93NUMPY";
constexpr std::size_t kLongestHeader = 1000000;  ///< [bytes] NumPy writes some hundred; a longer one is no header

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
  if (!in || length > kLongestHeader) refuse(file, "ends within its header, or has none", "write the file again");
  std::string text(length, ' ');
  if (!in.read(text.data(), static_cast<std::streamsize>(length)))
    refuse(file, "ends within its header", "write the file again");
  return text;
}

/// What follows `'key':` in the header, a Python dictionary; empty if the key is not there.
std::string_view value_of_key(std::string_view header, const std::string& key) {
  const std::size_t at = header.find("'" + key + "'");
  if (at == std::string_view::npos) return {};
  const std::string_view rest = without_blanks(header.substr(at + key.size() + 2));
  return rest.starts_with(':') ? without_blanks(rest.substr(1)) : std::string_view{};
}

/// "(12, 3)" or "(12,)" as numbers, "(1, 12, 3)" without its dimension of one; empty for any other number of dimensions or a
/// size that no file can have.
std::vector<std::uintmax_t> shape_of(std::string_view text) {
  std::vector<std::uintmax_t> shape;
  const std::size_t close = text.find(')');
  if (!text.starts_with('(') || close == std::string_view::npos) return {};
  text = text.substr(1, close - 1);
  while (!without_blanks(text).empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const std::string_view cell = without_blanks(text.substr(0, comma));
    std::uintmax_t size = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), size);
    if (error != std::errc() || end != cell.data() + cell.size()) return {};
    if (size > static_cast<std::uintmax_t>(std::numeric_limits<Index>::max())) return {};
    shape.push_back(size);
    text = text.substr(std::min(comma + 1, text.size()));
  }
  for (std::size_t d = shape.size(); d-- > 0 && shape.size() > 2;)
    if (shape[d] == 1) shape.erase(shape.begin() + static_cast<std::ptrdiff_t>(d));
  return shape.size() > 2 ? std::vector<std::uintmax_t>{} : shape;
}

Header parse(const std::string& text, const fs::path& file) {
  Header header;
  const std::string_view description = value_of_key(text, "descr");
  const std::size_t quote = description.find('\'', 1);
  if (!description.starts_with('\'') || quote == std::string_view::npos)
    refuse(file, "has a header without 'descr' of one type of number: its rows may be records of several fields",
           "give a plain array: numpy.column_stack([data[name] for name in data.dtype.names])");
  const std::string type(description.substr(1, quote - 1));
  if (type != "<f8" && type != "<f4" && type != "<i2" && type != "<i4")
    refuse(file, fmt::format("holds type '{}', expected '<f8', '<f4', '<i2' or '<i4'", type),
           "convert it with array.astype('<f8')");
  header.type = type.substr(1);
  header.item_size = static_cast<std::size_t>(type.back() - '0');
  header.fortran_order = value_of_key(text, "fortran_order").starts_with("True");
  const std::vector<std::uintmax_t> shape = shape_of(value_of_key(text, "shape"));
  if (shape.empty())
    refuse(file, "has an array of another shape than one or two dimensions", "reshape it to samples x channels");
  header.rows = static_cast<Index>(shape[0]);
  if (shape.size() == 2) header.columns = static_cast<Index>(shape[1]);
  return header;
}

/// An open file, its header read and its size held against the header's, so that no size in a header is ever asked of the
/// memory.
struct OpenArray {
  std::ifstream in;
  Header header;
};

OpenArray open_array(const fs::path& file) {
  const std::uintmax_t bytes = require_regular_file(file);
  OpenArray array{std::ifstream(file, std::ios::binary), {}};
  if (!array.in) refuse(file, "cannot be read", "check its name and your permissions");
  array.header = parse(header_text(array.in, file), file);
  const Header& header = array.header;
  const auto rows = static_cast<std::uintmax_t>(header.rows), columns = static_cast<std::uintmax_t>(header.columns);
  if (rows == 0 || columns == 0)
    refuse(file, fmt::format("holds an array of {} x {}, without any value", rows, columns), "write the file again");
  const std::uintmax_t found = bytes - static_cast<std::uintmax_t>(array.in.tellg());
  if (columns > found / header.item_size / rows || rows * columns * header.item_size != found)
    refuse(file,
           fmt::format("holds {} bytes of data, expected {:.0f} for {} x {} values", found,
                       static_cast<double>(rows) * static_cast<double>(columns) * static_cast<double>(header.item_size), rows,
                       columns),
           "the file was cut off or is damaged; copy it again");
  return array;
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

std::pair<Index, Index> shape_of_npy(const fs::path& file) {
  const Header header = open_array(file).header;
  return {header.rows, header.columns};
}

std::pair<Index, Index> visit_npy(const fs::path& file, const BlockVisitor& visit) {
  OpenArray array = open_array(file);
  std::ifstream& in = array.in;
  const Header& header = array.header;
  constexpr Index kValues = 131072;
  std::vector<char> buffer;
  const auto read = [&](Index values) {
    buffer.resize(static_cast<std::size_t>(values) * header.item_size);
    if (!in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())))
      refuse(file, "cannot be read to its end", "copy it again");
  };
  const auto value = [&](Index k) {
    return value_of(header.type, buffer.data() + static_cast<std::size_t>(k) * header.item_size);
  };
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
    for (Index k = 0; k < n; ++k)
      for (Index c = 0; c < header.columns; ++c) block(k, c) = value(k * header.columns + c);
    visit(row, 0, block);
  }
  return {header.rows, header.columns};
}

Eigen::MatrixXd read_npy(const fs::path& file) {
  const Header header = open_array(file).header;
  Eigen::MatrixXd array(header.rows, header.columns);
  visit_npy(file, [&](Index row, Index column, const Eigen::MatrixXd& block) {
    array.block(row, column, block.rows(), block.cols()) = block;
  });
  return array;
}

void write_npy_single(const Eigen::Ref<const Eigen::MatrixXd>& array, const fs::path& file) {
  std::string header =
      fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}), }}", array.rows(), array.cols());
  // Magic, version, two bytes of length: the data begin at a multiple of 64.
  header.append(63 - (10 + header.size()) % 64, ' ');
  header.push_back('\n');
  std::string content(kMagic, 6);
  content += std::string("\x01\x00", 2);
  content.push_back(static_cast<char>(header.size() % 256));
  content.push_back(static_cast<char>(header.size() / 256));
  content += header;
  const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = array.cast<float>();
  content.append(reinterpret_cast<const char*>(rows.data()), static_cast<std::size_t>(rows.size()) * sizeof(float));
  write_file_atomically(file, content);
}

}  // namespace twindeck::io
