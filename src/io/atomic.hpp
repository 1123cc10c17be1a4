#pragma once

#include <filesystem>
#include <string_view>

namespace twindeck::io {

/// Writes a whole file under a temporary name beside it and renames it, so that a reader sees the old content or the new, never
/// half of it. Makes the folder if it is not there. Where `file` is a link, its target is replaced and the link stays.
/// @throws InputError  if it cannot be written (no permission, disk full)
void write_file_atomically(const std::filesystem::path& file, std::string_view content);

/// A folder that is built beside its final place and put there at once when it is finished:
///
///     FolderReplacement replacement("results/x/s1_model");   // makes results/x/s1_model.partial-<pid>
///     ... write into replacement.partial() ...
///     replacement.publish();                                 // swaps; only now are the earlier results removed
///
/// Without `publish` the partial folder is removed and the earlier results stay whole. What a killed process of this machine has left
/// beside the place is removed first. Where the place is a link, its target is replaced and the link stays.
class FolderReplacement {
 public:
  /// @throws InputError  if the folder cannot be made
  explicit FolderReplacement(const std::filesystem::path& final_place);
  ~FolderReplacement();
  FolderReplacement(const FolderReplacement&) = delete;
  FolderReplacement& operator=(const FolderReplacement&) = delete;

  /// Where the partial folder of this process will be, known before it is made.
  [[nodiscard]] static std::filesystem::path partial_place(const std::filesystem::path& final_place);
  [[nodiscard]] const std::filesystem::path& partial() const { return partial_; }
  /// Puts the partial folder at its final place, or at `elsewhere` if given.
  void publish();
  void publish(const std::filesystem::path& elsewhere);

 private:
  void bring_beside(const std::filesystem::path& place);

  std::filesystem::path final_;
  std::filesystem::path partial_;
};

/// "dir/" -> "dir": a path that can be given a suffix.
[[nodiscard]] std::filesystem::path without_trailing_slash(const std::filesystem::path& path);

}  // namespace twindeck::io
