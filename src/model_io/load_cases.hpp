#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace twindeck::model_io {

/// A row of loads.csv.
struct LoadEntry {
  enum class Kind { force, moment, movement };
  std::string load, node;
  int direction = 0;   ///< 0-5 = x y z rx ry rz
  double value = 0.0;  ///< [N, N m], of a movement of the ground under a support [m]
  Kind kind = Kind::force;
  long line = 0;
};

/// A model folder's loads.csv (`load,node,direction,value,unit`), in the order of the file. Unit N goes with x, y, z; N m with
/// rx, ry, rz; m, an imposed movement of a support, with x, y, z. A folder of either kind of model may have the file; there are
/// no cases without it.
/// @throws InputError  with file, line and column: another column, a case without a name, a value that is no number, an unknown
/// direction or unit, a unit that its direction cannot have
[[nodiscard]] std::vector<LoadEntry> read_load_cases(const std::filesystem::path& folder);

/// Names of the load cases, each once, in the order of the file.
/// @throws InputError  as above
[[nodiscard]] std::vector<std::string> load_case_names(const std::filesystem::path& folder);

/// Copies loads.csv, where `from` has one, into a model folder of the same nodes.
void carry_load_cases(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace twindeck::model_io
