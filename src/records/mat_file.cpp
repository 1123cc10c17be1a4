#include "records/mat_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

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
#include "records/text_cells.hpp"

namespace twindeck::records {
namespace fs = std::filesystem;
using Eigen::Index;
static_assert(std::endian::native == std::endian::little, "numbers of a file are turned where its order of bytes is the other");

namespace {

constexpr const char* kCutOff = "the file was cut off or is damaged; copy it again";

/// A number of the file. @param swapped  its byte order is not that of this machine
template <typename Number>
Number number_at(const char* at, bool swapped) {
  std::array<char, sizeof(Number)> bytes{};
  std::memcpy(bytes.data(), at, sizeof(Number));
  if (swapped) std::ranges::reverse(bytes);
  return std::bit_cast<Number>(bytes);
}

/// Bytes of a number with the code MatArray::storage; 0 for an unknown code.
std::uint64_t storage_bytes(int storage) {
  constexpr std::array<std::uint8_t, 14> bytes = {0, 1, 1, 2, 2, 4, 4, 4, 0, 8, 0, 0, 8, 8};
  return storage < 0 || storage >= std::ssize(bytes) ? 0 : bytes[static_cast<std::size_t>(storage)];
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

/// The header if it is plausible: byte order and sizes agree with the digits that state them.
std::optional<Level4Header> level_4_header(std::string_view bytes) {
  if (bytes.size() < kLevel4Header) return {};
  constexpr std::uint32_t most = 0x7FFFFFFF, longest_name = 256;
  for (const bool swapped : {false, true}) {
    const auto word = [&](std::size_t k) { return number_at<std::uint32_t>(bytes.data() + 4 * k, swapped); };
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

constexpr std::uint64_t kLevel5Header = 128;  // [bytes] text, version, order of bytes

constexpr std::uint32_t kMatrix = 14, kCompressed = 15;
constexpr std::uint32_t kCell = 1, kStructure = 2, kText = 4, kSparse = 5, kFirstNumber = 6, kLastNumber = 15;
constexpr std::uint32_t kComplexFlag = 0x0800;

// Limits far above those of a sound file; beyond them the file is damaged. [bytes], [levels]
constexpr std::uint64_t kLongestName = 4096, kLongestFieldList = 1U << 20U, kLongestText = 4096, kMostDimensions = 32;
constexpr int kDeepest = 8;

struct Tag {
  std::uint32_t type = 0, bytes = 0;
  bool small = false;  ///< up to four bytes of data stand in the tag itself
};

/// Texts of a cell array; `all` is false if a cell is no text.
struct CellTexts {
  std::vector<std::string> texts;
  bool all = true;
};

class Variable {
 public:
  /// @param part  where its bytes lie: offset, length, compressed
  Variable(MatFile& mat, const MatArray& part, std::size_t number)
      : mat_(mat),
        part_(part),
        source_(mat.file, part.offset, part.length, part.compressed),
        what_(fmt::format("variable number {}", number)) {}

  void read() {
    std::uint64_t end = part_.length;
    if (part_.compressed) {
      const Tag inner = tag();
      if (inner.type != kMatrix || inner.small || inner.bytes > source_.most_left()) fail("has a damaged header");
      end = 8 + std::uint64_t{inner.bytes};
    }
    part_.alone = true;
    matrix(end, "", 0, nullptr);
    if (part_.compressed && !part_.alone) source_.check_end(what_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError({mat_.file.string(), 0, ""}, problem + " in " + what_, kCutOff);
  }

  std::uint32_t word() {
    std::array<char, 4> bytes{};
    source_.read(bytes.data(), bytes.size(), what_);
    return number_at<std::uint32_t>(bytes.data(), mat_.swapped);
  }

  Tag tag() {
    const std::uint32_t first = word();
    if (first >> 16U != 0) return {first & 0xFFFFU, first >> 16U, true};  // its four bytes of data are next
    return {first, word(), false};
  }

  /// Bytes of an element with the blanks that fill it up.
  [[nodiscard]] static std::uint64_t padded(const Tag& tag) { return tag.small ? 4 : (std::uint64_t{tag.bytes} + 7) / 8 * 8; }

  void require_within(const Tag& tag, std::uint64_t end) const {
    if ((tag.small && tag.bytes > 4) || tag.bytes > end - std::min(end, source_.position()))
      fail("has an element that is larger than what it stands in");
  }

  /// The data of a small element. @param most  largest allowed number of bytes
  std::string data(const Tag& tag, std::uint64_t end, std::uint64_t most) {
    require_within(tag, end);
    if (tag.bytes > most) fail("has a damaged header");
    std::string bytes = source_.read(tag.bytes, what_);
    source_.skip(std::min(padded(tag) - tag.bytes, end - source_.position()), what_);
    return bytes;
  }

  [[nodiscard]] std::uint32_t word_of(const std::string& bytes, std::size_t k) const {
    return number_at<std::uint32_t>(bytes.data() + 4 * k, mat_.swapped);
  }

  void skip_to(std::uint64_t end) { source_.skip(end - std::min(end, source_.position()), what_); }

  /// A matrix up to the place `end`. @param outer  name if it is a field of a structure, "" for a variable @param texts  of the
  /// cell array that contains it; null for none
  void matrix(std::uint64_t end, const std::string& outer, int depth, CellTexts* texts) {
    if (texts != nullptr) texts->all = texts->all && source_.position() < end;
    if (source_.position() >= end) return;  // an empty field or cell
    const std::string flags = data(tag(), end, 8);
    if (flags.size() != 8) fail("has a damaged header");
    const std::uint32_t kind = word_of(flags, 0) & 0xFFU;
    if (kind == 0 || kind > kLastNumber) {  // objects and functions are laid out in another way
      if (texts != nullptr) texts->all = false;
      return skip_to(end);
    }
    const std::string dimensions = data(tag(), end, 4 * kMostDimensions);
    if (dimensions.size() < 8 || dimensions.size() % 4 != 0) fail("has a damaged header");
    const std::string own = data(tag(), end, kLongestName), name = outer.empty() ? own : outer;
    // Dimensions of length 1 are dropped.
    std::vector<std::uint64_t> lengths;
    for (std::size_t k = 0; k < dimensions.size() / 4; ++k)
      if (dimensions.size() == 8 || word_of(dimensions, k) != 1) lengths.push_back(word_of(dimensions, k));
    lengths.resize(std::max<std::size_t>(lengths.size(), 2), 1);
    const std::uint64_t rows = lengths[0], columns = lengths[1];
    if (texts != nullptr && kind != kText) texts->all = false;
    if (lengths.size() > 2) {
      if (kind >= kFirstNumber)
        mat_.notes.push_back(fmt::format("'{}' has {} dimensions ({})", name, lengths.size(), fmt::join(lengths, " x ")));
    } else if (kind == kStructure && rows == 1 && columns == 1 && depth < kDeepest) {
      fields(end, name, depth);
    } else if (kind == kCell && depth < kDeepest) {
      cells(end, name, rows * columns, depth);
    } else if (kind == kText && texts != nullptr) {
      texts->texts.push_back(text(end));
    } else if (kind >= kFirstNumber) {
      numbers(end, name, rows, columns, (word_of(flags, 0) & kComplexFlag) != 0);
      if (depth == 0) return;  // the data are read later, if needed
    } else if (kind == kSparse) {
      mat_.notes.push_back(fmt::format("'{}' is sparse", name));
    } else if (kind == kStructure) {
      mat_.notes.push_back(fmt::format("'{}' is an array of {} structures", name, rows * columns));
    }
    skip_to(end);
  }

  void inner(std::uint64_t end, const std::string& name, int depth, CellTexts* texts) {
    const Tag next = tag();
    if (next.type != kMatrix || next.small) fail("has a field or cell that is no matrix");
    require_within(next, end);
    matrix(source_.position() + next.bytes, name, depth, texts);
  }

  void fields(std::uint64_t end, const std::string& name, int depth) {
    part_.alone = false;
    const std::string width_data = data(tag(), end, 4);
    if (width_data.size() != 4) fail("has a damaged list of fields");
    const std::size_t width = word_of(width_data, 0);
    const std::string list = data(tag(), end, kLongestFieldList);
    if (width == 0 || width > kLongestName || list.size() % width != 0) fail("has a damaged list of fields");
    for (std::size_t at = 0; at < list.size(); at += width) {
      const std::string field = list.substr(at, std::min(list.substr(at, width).find('\0'), width));
      inner(end, name + "." + field, depth + 1, nullptr);
    }
  }

  void cells(std::uint64_t end, const std::string& name, std::uint64_t count, int depth) {
    part_.alone = false;
    CellTexts texts;
    for (std::uint64_t k = 0; k < count && source_.position() < end; ++k)
      inner(end, fmt::format("{}{{{}}}", name, k + 1), depth + 1, &texts);
    if (texts.all && texts.texts.size() == count) mat_.texts.push_back(texts.texts);
  }

  /// UTF-8 of the letters of a text of one byte or two a letter.
  std::string text(std::uint64_t end) {
    const Tag letters = tag();
    if (letters.bytes > kLongestText) return "";
    const std::string bytes = data(letters, end, kLongestText);
    if (letters.type != 4 && letters.type != 17) return is_utf8(bytes) ? bytes : from_latin1(bytes);
    std::string result;
    for (std::size_t k = 0; k + 1 < bytes.size(); k += 2) {
      const auto low = static_cast<unsigned char>(bytes[k + (mat_.swapped ? 1 : 0)]),
                 high = static_cast<unsigned char>(bytes[k + (mat_.swapped ? 0 : 1)]);
      append_utf8(low + 256U * high, result);
    }
    return result;
  }

  void numbers(std::uint64_t end, const std::string& name, std::uint64_t rows, std::uint64_t columns, bool complex) {
    if (complex) return mat_.notes.push_back(fmt::format("'{}' is complex", name));
    if (rows == 0 || columns == 0) return;
    const Tag values = tag();
    require_within(values, end);
    const std::uint64_t item = storage_bytes(static_cast<int>(std::min<std::uint32_t>(values.type, 99)));
    if (item == 0) fail(fmt::format("has numbers of a type {} that the format does not know", values.type));
    if (values.bytes % item != 0 || rows > values.bytes / item || values.bytes / item / rows != columns ||
        values.bytes / item % rows != 0)
      fail(fmt::format("has an array '{}' of {} x {} values with {} bytes of data, expected {} a value", name, rows, columns,
                       values.bytes, item));
    MatArray array = part_;
    array.shape = {name, static_cast<Index>(rows), static_cast<Index>(columns)};
    array.storage = static_cast<int>(values.type);
    array.data = source_.position();
    mat_.arrays.push_back(array);
  }

  MatFile& mat_;
  MatArray part_;
  ByteSource source_;
  std::string what_;
};

/// Walks through the elements of a file of version 5, compressed or not. @param size  of the file [bytes]
MatFile level_5(const fs::path& file, std::uint64_t size) {
  MatFile mat;
  mat.file = file;
  const auto fail = [&](const std::string& problem) { throw InputError({file.string(), 0, ""}, problem, kCutOff); };
  if (size < kLevel5Header) fail("breaks off in its header");
  ByteSource source(file, 0, size, false);
  const std::string header = source.read(kLevel5Header, "its header");
  mat.swapped = header.substr(kLevel5Header - 2) == "MI";
  if (!mat.swapped && header.substr(kLevel5Header - 2) != "IM") fail("has a header that does not say the order of its bytes");
  std::size_t number = 0;
  for (std::uint64_t at = kLevel5Header; at < size;) {
    ++number;
    if (size - at < 8) fail(fmt::format("breaks off in variable number {}", number));
    std::array<char, 8> words{};
    source.read(words.data(), words.size(), "a variable");
    const auto type = number_at<std::uint32_t>(words.data(), mat.swapped);
    const std::uint64_t bytes = number_at<std::uint32_t>(words.data() + 4, mat.swapped);
    if (bytes > size - at - 8)
      fail(fmt::format("breaks off in variable number {}: {} of its {} bytes are there", number, size - at - 8, bytes));
    if (type == kMatrix || type == kCompressed) {
      MatArray part{.shape = {}, .offset = at + 8, .length = bytes, .compressed = type == kCompressed};
      Variable(mat, part, number).read();
    }
    source.skip(bytes, "a variable");
    at += 8 + bytes;
  }
  return mat;
}

double value_of(int storage, const char* at, bool swapped) {
  const auto as = [&]<typename Number>(Number) { return static_cast<double>(number_at<Number>(at, swapped)); };
  if (storage == 1) return as(std::int8_t{});
  if (storage == 2) return as(std::uint8_t{});
  if (storage == 3) return as(std::int16_t{});
  if (storage == 4) return as(std::uint16_t{});
  if (storage == 5) return as(std::int32_t{});
  if (storage == 6) return as(std::uint32_t{});
  if (storage == 7) return as(float{});
  if (storage == 9) return as(double{});
  if (storage == 12) return as(std::int64_t{});
  if (storage == 13) return as(std::uint64_t{});
  throw InternalError("a type of numbers that storage_bytes does not know");
}

}  // namespace

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
  if (!in.read(beginning.data(), static_cast<std::streamsize>(beginning.size())))
    throw InputError({file.string(), 0, ""}, "cannot be read", "check its name and your permissions");
  return is_mat_5(beginning) ? level_5(file, size) : level_4(file, size);
}

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
