#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace twindeck::model_io {

/// Names of the load cases in a model folder's loads.csv (`load,node,direction,value,unit`; unit N, N m or, for an imposed
/// movement of a support, m), each once, in the order of the file. A folder of either kind of model may have the file; there
/// are no cases without it. No step computes the loads yet: what is read is which cases a condition's `load` may name.
/// @throws InputError  with file, line and column: another column, a case without a name, a value that is no number, an unknown
/// direction
///         or unit
[[nodiscard]] std::vector<std::string> load_case_names(const std::filesystem::path& folder);

/// Copies loads.csv, where `from` has one, into a model folder of the same nodes.
void carry_load_cases(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace twindeck::model_io
