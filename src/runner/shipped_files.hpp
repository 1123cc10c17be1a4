#pragma once

#include <filesystem>

namespace twindeck::runner {

/// Where a file of the product's own lies: the catalogue of causes (`workflows/common/…`) and the turbulence sets
/// (`data/wind/…`), which a study names relative to the root of the source tree. A path that exists as given is returned
/// unchanged, so a source tree or a copy of the user's in the current folder comes first. Then follows the source tree that the
/// program was built in (`<tree>/build/bin`), then the prefix that it was installed to (`<prefix>/bin`, with the files in
/// `<prefix>/share/twindeck`). No other path is looked for elsewhere, so that a missing file of a study is never replaced by
/// another of the same name.
/// @param path     as a configuration names it, for example "data/wind/turbulence_sets.csv"
/// @param program  the executable, without symbolic links; empty: unknown
/// @return the file or folder found; `path` itself where there is none, or where it is none of the product's own
[[nodiscard]] std::filesystem::path shipped(const std::filesystem::path& path, const std::filesystem::path& program);

/// The same for the running program.
[[nodiscard]] std::filesystem::path shipped(const std::filesystem::path& path);

}  // namespace twindeck::runner
