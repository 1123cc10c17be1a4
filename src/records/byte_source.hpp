#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace twindeck::records {

/// Bytes of a part of a file one after another: as they lie there, or inflated (zlib) on the way. Nothing is kept but a buffer
/// of some kilobytes.
class ByteSource {
 public:
  /// @param offset, length  the part of the file [bytes]
  ByteSource(const std::filesystem::path& file, std::uint64_t offset, std::uint64_t length, bool compressed);
  ~ByteSource();
  ByteSource(ByteSource&&) noexcept;

  /// @param what  is being read, for the message @throws InputError  "breaks off in <what>", or for compressed data that are
  /// damaged
  void read(char* to, std::size_t n, const std::string& what);
  std::string read(std::size_t n, const std::string& what);
  void skip(std::uint64_t n, const std::string& what);
  /// Reads compressed data to their end, which holds their checksum. @throws InputError  if the checksum is wrong or the data
  /// break off
  void check_end(const std::string& what);
  /// Bytes that were read or skipped.
  [[nodiscard]] std::uint64_t position() const;
  /// Upper bound of the bytes that follow: the rest of the part, times 1032 for compressed data (the most that zlib reaches).
  [[nodiscard]] std::uint64_t most_left() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace twindeck::records
