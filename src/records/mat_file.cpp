#include "records/mat_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstring>
#include <fstream>
#include <optional>

#include "core/error.hpp"
#include "io/regular_file.hpp"
#include "records/byte_source.hpp"
#include "records/mat_level_5.hpp"

namespace twindeck::records {
namespace fs = std::filesystem;
using Eigen::Index;
static_assert(std::endian::native == std::endian::little, "numbers of a file are turned where its order of bytes is the other");

namespace {

constexpr const char* kCutOff = "the file was cut off or is damaged; copy it again";

std::uint32_t word_at(std::string_view bytes, std::size_t at, bool swapped) {
  std::array<unsigned char, 4> b{};
  std::memcpy(b.data(), bytes.data() + at, 4);
  if (swapped) std::reverse(b.begin(), b.end());
  return std::bit_cast<std::uint32_t>(b);
}

/// The twenty bytes before each variable of version 4.
struct Level4Header {
  std::uint32_t type = 0, rows = 0, columns = 0, imaginary = 0, name = 0;
  bool swapped = false;
  [[nodiscard]] std::uint32_t order() const { return type / 1000; }
  [[nodiscard]] std::uint32_t number() const { return type / 10 % 10; }
  [[nodiscard]] std::uint32_t kind() const { return type % 10; }  ///< 0 numbers, 1 text, 2 sparse
};
constexpr std::uint64_t kLevel4Header = 20;

/// The header if it can be one: the order of bytes fits to the digit that states it, the sizes can be.
std::optional<Level4Header> level_4_header(std::string_view bytes) {
  if (bytes.size() < kLevel4Header) return {};
  constexpr std::uint32_t most = 0x7FFFFFFF, longest_name = 256;
  for (const bool swapped : {false, true}) {
    const auto word = [&](std::size_t k) { return word_at(bytes, 4 * k, swapped); };
    const Level4Header h{word(0), word(1), word(2), word(3), word(4), swapped};
    const bool type =
        h.type < 5000 && h.order() == (swapped ? 1U : 0U) && h.type / 100 % 10 == 0 && h.number() <= 5 && h.kind() <= 2;
    if (type && h.rows <= most && h.columns <= most && h.imaginary <= 1 && h.name >= 1 && h.name <= longest_name) return h;
  }
  return {};
}

/// Code of version 5 for a type of numbers of version 4: double, single, int32, int16, uint16, uint8.
constexpr std::array<int, 6> kLevel4Storage = {9, 7, 5, 3, 4, 2};

MatFile level_4(const fs::path& file, std::uint64_t size) {
  MatFile mat{file, 4, false, {}, {}, {}};
  std::ifstream in(file, std::ios::binary);
  const auto fail = [&](std::size_t k, const std::string& problem) {
    throw InputError({file.string(), 0, ""}, fmt::format("{} in variable number {}", problem, k), kCutOff);
  };
  std::size_t k = 0;
  for (std::uint64_t at = 0; at < size;) {
    ++k;
    std::string bytes(std::min<std::uint64_t>(kLevel4Header, size - at), '\0');
    in.seekg(static_cast<std::streamoff>(at));
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (bytes.size() < kLevel4Header) fail(k, "breaks off");
    const auto header = level_4_header(bytes);
    if (!header) {
      fail(k, "has a damaged header");
      continue;
    }
    const int storage = kLevel4Storage[header->number()];
    const std::uint64_t values = std::uint64_t{header->rows} * header->columns * (1 + header->imaginary);
    const std::uint64_t left = size - at - kLevel4Header, item = storage_bytes(storage);
    if (header->name > left || values > (left - header->name) / item) fail(k, "breaks off");
    std::string name(header->name, '\0');
    in.read(name.data(), static_cast<std::streamsize>(name.size()));
    name.resize(std::min(name.find('\0'), name.size()));
    const std::uint64_t data = at + kLevel4Header + header->name;
    const NamedArray shape{name, static_cast<Index>(header->rows), static_cast<Index>(header->columns)};
    if (header->imaginary == 1 || header->kind() == 2) {
      mat.notes.push_back(fmt::format("'{}' is {}", name, header->kind() == 2 ? "sparse" : "complex"));
    } else if (header->kind() == 0 && values > 0) {
      mat.arrays.push_back({shape, storage, data, values * item, false, 0, true});
    }
    mat.swapped = header->swapped;
    at = data + values * item;
  }
  return mat;
}

}  // namespace

std::uint64_t storage_bytes(int storage) {
  constexpr std::array<std::uint8_t, 14> bytes = {0, 1, 1, 2, 2, 4, 4, 4, 0, 8, 0, 0, 8, 8};
  return storage < 0 || storage >= std::ssize(bytes) ? 0 : bytes[static_cast<std::size_t>(storage)];
}

bool is_mat_4(std::string_view beginning) {
  const auto header = level_4_header(beginning);
  if (!header || beginning.size() < kLevel4Header + header->name) return false;
  const std::string_view name = beginning.substr(kLevel4Header, header->name);
  const auto of_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  return name.back() == '\0' && name.size() > 1 &&
         std::all_of(name.begin(), name.begin() + static_cast<long>(std::min(name.find('\0'), name.size())), of_name);
}

bool is_mat_5(std::string_view beginning) {
  if (beginning.starts_with("MATLAB 5.0")) return true;
  if (beginning.size() < kLevel5Header) return false;
  const std::string_view order = beginning.substr(kLevel5Header - 4, 4);
  return order == std::string_view("\x00\x01IM", 4) || order == std::string_view("\x01\x00MI", 4);
}

MatFile read_mat_contents(const fs::path& file) {
  const std::uint64_t size = io::require_regular_file(file);
  std::ifstream in(file, std::ios::binary);
  std::string beginning(std::min<std::uint64_t>(size, 4096), '\0');
  if (!in.read(beginning.data(), static_cast<std::streamsize>(beginning.size()))) {
    throw InputError({file.string(), 0, ""}, "cannot be read", "check its name and your permissions");
  }
  return is_mat_5(beginning) ? read_level_5(file, size) : level_4(file, size);
}

namespace {

template <typename Number>
double value_at(const char* at, bool swapped) {
  std::array<char, sizeof(Number)> bytes{};
  std::memcpy(bytes.data(), at, sizeof(Number));
  if (swapped) std::reverse(bytes.begin(), bytes.end());
  return static_cast<double>(std::bit_cast<Number>(bytes));
}

double value_of(int storage, const char* at, bool swapped) {
  switch (storage) {
    case 1:
      return value_at<std::int8_t>(at, swapped);
    case 2:
      return value_at<std::uint8_t>(at, swapped);
    case 3:
      return value_at<std::int16_t>(at, swapped);
    case 4:
      return value_at<std::uint16_t>(at, swapped);
    case 5:
      return value_at<std::int32_t>(at, swapped);
    case 6:
      return value_at<std::uint32_t>(at, swapped);
    case 7:
      return value_at<float>(at, swapped);
    case 9:
      return value_at<double>(at, swapped);
    case 12:
      return value_at<std::int64_t>(at, swapped);
    case 13:
      return value_at<std::uint64_t>(at, swapped);
    default:
      throw InternalError("a type of numbers that storage_bytes does not know");
  }
}

}  // namespace

void visit_values(const MatFile& mat, const MatArray& array, Index n, const ValueVisitor& visit) {
  const std::string what = "array '" + array.shape.name + "'";
  ByteSource source(mat.file, array.offset, array.length, array.compressed);
  source.skip(array.data, what);
  const Index all = array.shape.rows * array.shape.columns;
  const std::uint64_t item = storage_bytes(array.storage);
  for (Index first = 0; first < all; first += n) {
    Eigen::VectorXd values(std::min(n, all - first));
    const std::string bytes = source.read(static_cast<std::size_t>(values.size()) * item, what);
    for (Index k = 0; k < values.size(); ++k)
      values[k] = value_of(array.storage, bytes.data() + static_cast<std::size_t>(k) * item, mat.swapped);
    visit(first, values);
  }
  if (array.alone) source.check_end(what);
}

Eigen::VectorXd values_of(const MatFile& mat, const MatArray& array) {
  Eigen::VectorXd all(array.shape.rows * array.shape.columns);
  visit_values(mat, array, 65536,
               [&](Index first, const Eigen::VectorXd& values) { all.segment(first, values.size()) = values; });
  return all;
}

}  // namespace twindeck::records
