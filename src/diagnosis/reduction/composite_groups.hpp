#pragma once

#include <string>
#include <vector>

namespace twindeck::diagnosis {

/// Groups that an engineer would name together. A name is read as parts: runs of letters and runs of digits. Names with the
/// same kinds of parts, of which some are equal, belong together: braces_1_x0 and braces_1_x2 (both faces of a
/// storey's direction), all braces_1 (a storey), all braces_*_x0 (a face), all braces.
/// @param names  of groups
/// @return each set of two names or more once, its names in their order
[[nodiscard]] std::vector<std::vector<std::string>> composite_groups(const std::vector<std::string>& names);

}  // namespace twindeck::diagnosis
