#pragma once

#include <filesystem>
#include <mutex>
#include <string_view>

namespace twindeck::io {

/// Writes a whole file under a temporary name in the same folder and renames it. A reader sees either the old or the new
/// content, never a part. Creates the folder if it is missing. If `file` is a link, its target is replaced and the link stays.
/// @throws InputError  if it cannot be written (no permission, disk full)
void write_file_atomically(const std::filesystem::path& file, std::string_view content);

/// A folder that is built beside its final path and moved there in one step when it is finished:
///
///     FolderReplacement replacement("results/x/s1_model");   // makes results/x/s1_model.partial-<pid>
///     ... write into replacement.partial() ...
///     replacement.publish();                                 // swaps; only now are the earlier results removed
///
/// Without `publish` the partial folder is removed and the earlier results stay unchanged. Partial folders that a killed
/// process of this machine left behind are removed first. If the path is a link, its target is replaced and the link stays.
class FolderReplacement {
 public:
  /// @throws InputError  if the folder cannot be made
  explicit FolderReplacement(const std::filesystem::path& final_place);
  ~FolderReplacement();
  FolderReplacement(const FolderReplacement&) = delete;
  FolderReplacement& operator=(const FolderReplacement&) = delete;

  /// Path of the partial folder of this process, known before the folder is made.
  [[nodiscard]] static std::filesystem::path partial_place(const std::filesystem::path& final_place);
  [[nodiscard]] const std::filesystem::path& partial() const { return partial_; }
  /// Moves the partial folder to its final path, or to `elsewhere` if given.
  void publish();
  void publish(const std::filesystem::path& elsewhere);

 private:
  void bring_beside(const std::filesystem::path& place);

  std::filesystem::path final_;
  std::filesystem::path partial_;
};

/// Removes a partial folder from another thread than the one that builds it, for example after a signal. A folder that is being
/// published at this moment is published first, so that nothing is removed from results that have taken their place.
/// @return a lock: as long as it is held, nothing is published by this process
[[nodiscard]] std::unique_lock<std::mutex> abandon_partial(const std::filesystem::path& partial);

/// "dir/" -> "dir": a path to which a suffix can be appended.
[[nodiscard]] std::filesystem::path without_trailing_slash(const std::filesystem::path& path);

}  // namespace twindeck::io
