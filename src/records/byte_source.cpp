#include "records/byte_source.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "core/error.hpp"

namespace twindeck::records {

namespace {

constexpr std::size_t kBuffer = 65536;
/// Deflate codes at most 258 bytes in two bits. Reference: zlib, "Technical details", maximum compression factor.
constexpr std::uint64_t kMostInflation = 1032;

}  // namespace

struct ByteSource::State {
  std::filesystem::path file;
  std::ifstream in;
  std::uint64_t left = 0;  ///< bytes of the part that are still to be read from the file
  std::uint64_t position = 0;
  bool compressed = false, ended = false;
  z_stream stream{};
  std::array<char, kBuffer> buffer{};

  ~State() {
    if (compressed) inflateEnd(&stream);
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError({file.string(), 0, ""}, problem, "the file was cut off or is damaged; copy it again");
  }

  std::size_t take(char* to, std::size_t n, const std::string& what) {
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(n, left));
    if (!in.read(to, static_cast<std::streamsize>(wanted))) fail("breaks off in " + what);
    left -= wanted;
    return wanted;
  }

  /// @return bytes written to `to`, fewer than n at the end of the data only
  std::size_t inflated(char* to, std::size_t n, const std::string& what) {
    stream.next_out = reinterpret_cast<Bytef*>(to);
    stream.avail_out = static_cast<uInt>(n);
    while (stream.avail_out > 0 && !ended) {
      if (stream.avail_in == 0 && left > 0) {
        stream.avail_in = static_cast<uInt>(take(buffer.data(), buffer.size(), what));
        stream.next_in = reinterpret_cast<Bytef*>(buffer.data());
      }
      if (const int code = inflate(&stream, Z_NO_FLUSH); code == Z_STREAM_END) {
        ended = true;
      } else if (code == Z_BUF_ERROR || (code == Z_OK && stream.avail_in == 0 && left == 0 && stream.avail_out > 0)) {
        break;
      } else if (code != Z_OK) {
        fail("has damaged compressed data in " + what);
      }
    }
    return n - stream.avail_out;
  }
};

ByteSource::ByteSource(const std::filesystem::path& file, std::uint64_t offset, std::uint64_t length, bool compressed)
    : state_(std::make_unique<State>()) {
  state_->file = file;
  state_->in.open(file, std::ios::binary);
  state_->in.seekg(static_cast<std::streamoff>(offset));
  state_->left = length;
  if (compressed && inflateInit(&state_->stream) != Z_OK) throw InternalError("zlib cannot be started");
  state_->compressed = compressed;
}

ByteSource::~ByteSource() = default;
ByteSource::ByteSource(ByteSource&&) noexcept = default;

void ByteSource::read(char* to, std::size_t n, const std::string& what) {
  std::size_t done = 0;
  while (done < n) {
    const std::size_t part = std::min(n - done, kBuffer);
    const std::size_t got = state_->compressed ? state_->inflated(to + done, part, what) : state_->take(to + done, part, what);
    if (got < part) state_->fail("breaks off in " + what);
    done += got;
  }
  state_->position += n;
}

std::string ByteSource::read(std::size_t n, const std::string& what) {
  if (n > most_left()) state_->fail("breaks off in " + what);
  std::string bytes(n, '\0');
  read(bytes.data(), n, what);
  return bytes;
}

void ByteSource::skip(std::uint64_t n, const std::string& what) {
  if (!state_->compressed) {
    if (n > state_->left) state_->fail("breaks off in " + what);
    state_->in.seekg(static_cast<std::streamoff>(n), std::ios::cur);
    state_->left -= n;
    state_->position += n;
    return;
  }
  std::array<char, 4096> dropped{};
  for (std::uint64_t left = n; left > 0;) {
    const auto part = static_cast<std::size_t>(std::min<std::uint64_t>(left, dropped.size()));
    read(dropped.data(), part, what);
    left -= part;
  }
}

void ByteSource::check_end(const std::string& what) {
  if (!state_->compressed) return;
  std::array<char, 4096> dropped{};
  while (state_->inflated(dropped.data(), dropped.size(), what) == dropped.size()) {
  }
  if (!state_->ended) state_->fail("breaks off in " + what);
}

std::uint64_t ByteSource::position() const { return state_->position; }

std::uint64_t ByteSource::most_left() const {
  if (!state_->compressed) return state_->left;
  return (state_->left + state_->stream.avail_in + 1) * kMostInflation;
}

}  // namespace twindeck::records
