#include "records/mat_level_5.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "core/error.hpp"
#include "records/byte_source.hpp"
#include "records/text_cells.hpp"

namespace twindeck::records {
namespace fs = std::filesystem;
using Eigen::Index;

namespace {

// Codes of the format.
constexpr std::uint32_t kMatrix = 14, kCompressed = 15;
constexpr std::uint32_t kCell = 1, kStructure = 2, kText = 4, kSparse = 5, kFirstNumber = 6, kLastNumber = 15;
constexpr std::uint32_t kComplexFlag = 0x0800;

// What a sound file stays far below; more is damage. [bytes], [levels]
constexpr std::uint64_t kLongestName = 4096, kLongestFieldList = 1U << 20U, kLongestText = 4096, kMostDimensions = 32;
constexpr int kDeepest = 8;

struct Tag {
  std::uint32_t type = 0, bytes = 0;
  bool small = false;  ///< up to four bytes of data stand in the tag itself
};

/// Texts of a cell array; `all` ends when a cell is no text.
struct CellTexts {
  std::vector<std::string> texts;
  bool all = true;
};

/// One variable of the file.
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
    throw InputError({mat_.file.string(), 0, ""}, problem + " in " + what_,
                     "the file was cut off or is damaged; copy it again");
  }

  std::uint32_t word() {
    std::array<char, 4> bytes{};
    source_.read(bytes.data(), bytes.size(), what_);
    if (mat_.swapped) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<std::uint32_t>(bytes);
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

  /// The data of a small element. @param most  bytes that it may have
  std::string data(const Tag& tag, std::uint64_t end, std::uint64_t most) {
    require_within(tag, end);
    if (tag.bytes > most) fail("has a damaged header");
    std::string bytes = source_.read(tag.bytes, what_);
    source_.skip(std::min(padded(tag) - tag.bytes, end - source_.position()), what_);
    return bytes;
  }

  [[nodiscard]] std::uint32_t word_of(const std::string& bytes, std::size_t k) const {
    std::array<char, 4> b{};
    std::memcpy(b.data(), bytes.data() + 4 * k, 4);
    if (mat_.swapped) std::reverse(b.begin(), b.end());
    return std::bit_cast<std::uint32_t>(b);
  }

  void skip_to(std::uint64_t end) { source_.skip(end - std::min(end, source_.position()), what_); }

  /// A matrix up to the place `end`. @param outer  name of the structure's field that it is, "" for a variable @param texts  of
  /// the cell array that it stands in
  void matrix(std::uint64_t end, const std::string& outer, int depth, CellTexts* texts) {
    if (texts != nullptr) texts->all = texts->all && source_.position() < end;
    if (source_.position() >= end) return;  // an empty field or cell
    const Tag flags_tag = tag();
    const std::string flags = data(flags_tag, end, 8);
    if (flags.size() != 8) fail("has a damaged header");
    const std::uint32_t kind = word_of(flags, 0) & 0xFFU;
    if (kind == 0 || kind > kLastNumber) {  // objects and functions are laid out in another way
      if (texts != nullptr) texts->all = false;
      return skip_to(end);
    }
    const Tag dimensions_tag = tag();
    const std::string dimensions = data(dimensions_tag, end, 4 * kMostDimensions);
    if (dimensions.size() < 8 || dimensions.size() % 4 != 0) fail("has a damaged header");
    const Tag name_tag = tag();
    const std::string own = data(name_tag, end, kLongestName), name = outer.empty() ? own : outer;
    // Dimensions of length 1 are none.
    std::vector<std::uint64_t> lengths;
    for (std::size_t k = 0; k < dimensions.size() / 4; ++k) {
      if (dimensions.size() == 8 || word_of(dimensions, k) != 1) lengths.push_back(word_of(dimensions, k));
    }
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
      if (depth == 0) return;  // the data are read later, by those who want them
    } else if (kind == kSparse) {
      mat_.notes.push_back(fmt::format("'{}' is sparse", name));
    } else if (kind == kStructure) {
      mat_.notes.push_back(fmt::format("'{}' is an array of {} structures", name, rows * columns));
    }
    skip_to(end);
  }

  /// The matrix that comes next within `end`.
  void inner(std::uint64_t end, const std::string& name, int depth, CellTexts* texts) {
    const Tag next = tag();
    if (next.type != kMatrix || next.small) fail("has a field or cell that is no matrix");
    require_within(next, end);
    matrix(source_.position() + next.bytes, name, depth, texts);
  }

  void fields(std::uint64_t end, const std::string& name, int depth) {
    part_.alone = false;
    const Tag width_tag = tag();
    const std::string width_data = data(width_tag, end, 4);
    if (width_data.size() != 4) fail("has a damaged list of fields");
    const std::size_t width = word_of(width_data, 0);
    const Tag list_tag = tag();
    const std::string list = data(list_tag, end, kLongestFieldList);
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
    if (complex) {
      mat_.notes.push_back(fmt::format("'{}' is complex", name));
      return;
    }
    if (rows == 0 || columns == 0) return;
    const Tag values = tag();
    require_within(values, end);
    const std::uint64_t item = storage_bytes(static_cast<int>(std::min<std::uint32_t>(values.type, 99)));
    if (item == 0) fail(fmt::format("has numbers of a type {} that the format does not know", values.type));
    if (values.bytes % item != 0 || rows > values.bytes / item || values.bytes / item / rows != columns ||
        values.bytes / item % rows != 0) {
      fail(fmt::format("has an array '{}' of {} x {} values with {} bytes of data, expected {} a value", name, rows, columns,
                       values.bytes, item));
    }
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

}  // namespace

MatFile read_level_5(const fs::path& file, std::uint64_t size) {
  MatFile mat;
  mat.file = file;
  const auto fail = [&](const std::string& problem) {
    throw InputError({file.string(), 0, ""}, problem, "the file was cut off or is damaged; copy it again");
  };
  if (size < kLevel5Header) fail("breaks off in its header");
  ByteSource source(file, 0, size, false);
  const std::string header = source.read(kLevel5Header, "its header");
  mat.swapped = header.substr(kLevel5Header - 2) == "MI";
  if (!mat.swapped && header.substr(kLevel5Header - 2) != "IM") fail("has a header that does not say the order of its bytes");
  std::size_t number = 0;
  for (std::uint64_t at = kLevel5Header; at < size;) {
    ++number;
    if (size - at < 8) fail(fmt::format("breaks off in variable number {}", number));
    std::array<std::array<char, 4>, 2> words{};
    for (auto& word : words) {
      source.read(word.data(), word.size(), "a variable");
      if (mat.swapped) std::reverse(word.begin(), word.end());
    }
    const auto type = std::bit_cast<std::uint32_t>(words[0]);
    const std::uint64_t bytes = std::bit_cast<std::uint32_t>(words[1]);
    if (bytes > size - at - 8) {
      fail(fmt::format("breaks off in variable number {}: {} of its {} bytes are there", number, size - at - 8, bytes));
    }
    if (type == kMatrix || type == kCompressed) {
      MatArray part;
      part.offset = at + 8;
      part.length = bytes;
      part.compressed = type == kCompressed;
      Variable(mat, part, number).read();
    }
    source.skip(bytes, "a variable");
    at += 8 + bytes;
  }
  return mat;
}

}  // namespace twindeck::records
