#include "model_io/inp_elements.hpp"

#include <map>

#include "core/lists.hpp"

namespace twindeck::model_io {
namespace {

struct Type {
  InpKind kind;
  int nodes;
};

/// Reduced integration and hybrid variants describe the same member; which formulation is used is ours to say. A B32 becomes
/// two beams, through its middle node; shells with such nodes become smaller ones (DeckModel::add_element). STRI3 is Abaqus'
/// thin triangle, US3 CalculiX' own (a *USER ELEMENT).
const std::map<std::string, Type>& types() {
  static const std::map<std::string, Type> known = {
      {"B31", {InpKind::beam, 2}},         {"B31R", {InpKind::beam, 2}},        {"B31H", {InpKind::beam, 2}},
      {"B33", {InpKind::beam, 2}},         {"B32", {InpKind::beam, 3}},         {"B32R", {InpKind::beam, 3}},
      {"B32H", {InpKind::beam, 3}},        {"T3D2", {InpKind::truss, 2}},       {"S4", {InpKind::shell, 4}},
      {"S4R", {InpKind::shell, 4}},        {"S3", {InpKind::shell, 3}},         {"S3R", {InpKind::shell, 3}},
      {"S8", {InpKind::shell, 8}},         {"S8R", {InpKind::shell, 8}},        {"S8R5", {InpKind::shell, 8}},
      {"S6", {InpKind::shell, 6}},         {"STRI65", {InpKind::shell, 6}},     {"C3D20", {InpKind::solid, 20}},
      {"C3D20R", {InpKind::solid, 20}},    {"C3D20H", {InpKind::solid, 20}},    {"C3D20RH", {InpKind::solid, 20}},
      {"C3D10", {InpKind::solid, 10}},     {"C3D10M", {InpKind::solid, 10}},    {"C3D10H", {InpKind::solid, 10}},
      {"C3D10I", {InpKind::solid, 10}},    {"C3D10HS", {InpKind::solid, 10}},   {"C3D10MH", {InpKind::solid, 10}},
      {"STRI3", {InpKind::shell, 3}},      {"US3", {InpKind::shell, 3}},        {"C3D8", {InpKind::solid, 8}},
      {"C3D8I", {InpKind::solid, 8}},      {"C3D8R", {InpKind::solid, 8}},      {"C3D4", {InpKind::solid, 4}},
      {"JOINTC", {InpKind::joint, 2}},     {"SPRINGA", {InpKind::spring, 2}},   {"SPRING1", {InpKind::spring, 1}},
      {"SPRING2", {InpKind::spring, 2}},   {"DASHPOTA", {InpKind::dashpot, 2}}, {"DASHPOT1", {InpKind::dashpot, 1}},
      {"DASHPOT2", {InpKind::dashpot, 2}}, {"MASS", {InpKind::mass, 1}},        {"ROTARYI", {InpKind::mass, 1}},
      {"S4R5", {InpKind::shell, 4}},       {"B31OS", {InpKind::beam, 2}},       {"B31OSH", {InpKind::beam, 2}},
      {"B32OS", {InpKind::beam, 3}},       {"B32OSH", {InpKind::beam, 3}},      {"PIPE31", {InpKind::beam, 2}},
      {"PIPE32", {InpKind::beam, 3}}};
  return known;
}

}  // namespace

InpKind inp_kind(const std::string& type) {
  const auto found = types().find(type);
  return found == types().end() ? InpKind::none : found->second.kind;
}

int inp_node_count(const std::string& type) {
  const auto found = types().find(type);
  return found == types().end() ? 0 : found->second.nodes;
}

bool inp_shear_flexible(const std::string& type) { return !type.ends_with("R5") && !type.starts_with("STRI"); }

std::string inp_linear_type(const std::string& type) {
  if (type.starts_with("C3D27")) return "C3D20 (hexahedra)";
  if (type.starts_with("C3D15")) return "C3D20 (hexahedra) or C3D10 (tetrahedra)";
  if (type.starts_with("S9")) return "S8R";
  if (type.starts_with("T3D3")) return "T3D2";
  return "";
}

std::vector<std::string> inp_element_types() {
  return each_of(types(), [](const auto& known) { return known.first; });
}

}  // namespace twindeck::model_io
