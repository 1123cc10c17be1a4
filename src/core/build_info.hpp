#pragma once

#include <map>
#include <string>

namespace twindeck {

/// "1.0.0": the version that CITATION.cff states, from the build.
[[nodiscard]] std::string version();

/// Commit of the source tree that this program was built from (40 hexadecimal digits). "" if the tree is not a git checkout or
/// no longer exists. It is read from the files of .git at run time, so that a commit does not force a rebuild.
[[nodiscard]] std::string source_commit();

/// Name -> version of the compiler and the numerical libraries, for the manifest.
[[nodiscard]] std::map<std::string, std::string> library_versions();

}  // namespace twindeck
