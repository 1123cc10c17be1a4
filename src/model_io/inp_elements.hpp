#pragma once

#include <string>
#include <vector>

namespace twindeck::model_io {

/// What an element type of an .inp file becomes.
enum class InpKind { none, beam, truss, shell, solid, spring, dashpot, joint, mass };

/// Kind of "B31", "S4R" …; none for a type that is not supported.
[[nodiscard]] InpKind inp_kind(const std::string& type);
/// Number of nodes that the type has; 0 for a type that is not supported.
[[nodiscard]] int inp_node_count(const std::string& type);
/// Whether a shell of this type is flexible in transverse shear: all but Abaqus' thin shells S4R5, S8R5, STRI3, STRI65.
[[nodiscard]] bool inp_shear_flexible(const std::string& type);
/// The linear type to use in place of a quadratic one ("C3D8 (hexahedra)" for "C3D20R"); "" for any other type.
[[nodiscard]] std::string inp_linear_type(const std::string& type);
/// "B31", "B32" …: the names of all types that are supported.
[[nodiscard]] std::vector<std::string> inp_element_types();

}  // namespace twindeck::model_io
