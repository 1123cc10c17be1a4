#pragma once

#include <map>
#include <string>

namespace twindeck {

/// "0.1.0".
[[nodiscard]] std::string version();

/// Commit of the source tree this program was built from (40 hexadecimal digits), "" when the tree is no git checkout or is
/// gone. Read from the files of .git when asked, so that a commit does not force a rebuild.
[[nodiscard]] std::string source_commit();

/// Name -> version of the compiler and the numerical libraries, for the manifest.
[[nodiscard]] std::map<std::string, std::string> library_versions();

}  // namespace twindeck
