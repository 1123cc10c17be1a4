#pragma once

#include <string>

namespace twindeck::model_io::ansys {

/// Why a command says nothing about stiffness and mass.
struct Ignored {
  std::string reason;
  bool told;  ///< worth a note to the user: a load, damping
};

/// @param key  Command::key
/// @return null for a command that may matter
[[nodiscard]] const Ignored* ignored(const std::string& key);

/// Whether it is a load: it stiffens or softens the structure where a static stage is asked for.
[[nodiscard]] bool is_load(const std::string& key);

}  // namespace twindeck::model_io::ansys
