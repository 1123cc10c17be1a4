#include "model_io/ansys_types.hpp"

namespace twindeck::model_io::ansys {
namespace {

/// By number, which alone decides. Options that choose an integration rule, a shape function, a stress output or a stiffness
/// under load are read over: which formulation is used is ours to say (docs/import_ansys.md). An option that is not listed has
/// to be 0.
const std::map<int, ElementType>& types() {
  static const std::map<int, ElementType> known = {
      {3, {"BEAM3", Kind::plane_beam, 2, {{6, {}}, {9, {}}, {10, {}}}}},
      {4, {"BEAM4", Kind::beam, 2, {{2, {}}, {6, {}}, {9, {}}, {10, {}}}}},
      {188, {"BEAM188", Kind::beam, 2, {{2, {}}, {3, {0, 2, 3}}, {4, {}}, {6, {}}, {7, {}}, {9, {}}, {11, {}}, {15, {}}}}},
      {189, {"BEAM189", Kind::beam, 2, {{2, {}}, {4, {}}, {6, {}}, {7, {}}, {9, {}}, {11, {}}, {15, {}}}}},
      {16, {"PIPE16", Kind::beam, 2, {{2, {}}, {6, {}}, {8, {}}}}},
      {288,
       {"PIPE288",
        Kind::beam,
        2,
        {{1, {}}, {3, {}}, {4, {}}, {6, {}}, {7, {}}, {8, {}}, {9, {}}, {11, {}}, {12, {}}, {15, {}}}}},
      {289, {"PIPE289", Kind::beam, 2, {{1, {}}, {4, {}}, {6, {}}, {7, {}}, {8, {}}, {9, {}}, {11, {}}, {12, {}}, {15, {}}}}},
      {8, {"LINK8", Kind::bar, 2, {}}},
      {10, {"LINK10", Kind::bar, 2, {{2, {}}, {3, {}}}}},
      {180, {"LINK180", Kind::bar, 2, {{2, {}}}}},
      {63, {"SHELL63", Kind::shell, 4, {{2, {}}, {3, {}}, {5, {}}, {6, {}}, {8, {}}, {9, {}}, {11, {}}}}},
      {181, {"SHELL181", Kind::shell, 4, {{3, {}}, {5, {}}, {8, {}}, {9, {}}, {10, {}}, {11, {}}}}},
      {93, {"SHELL93", Kind::shell, 8, {{4, {}}, {5, {}}, {6, {}}, {8, {}}}}},
      {281, {"SHELL281", Kind::shell, 8, {{3, {}}, {5, {}}, {8, {}}, {9, {}}, {10, {}}, {11, {}}}}},
      {95, {"SOLID95", Kind::solid, 20, {{1, {}}, {5, {}}, {6, {}}, {11, {}}}}},
      {186, {"SOLID186", Kind::solid, 20, {{2, {}}, {6, {}}}}},
      {92, {"SOLID92", Kind::solid, 10, {{5, {}}, {6, {}}, {9, {}}}}},
      {187, {"SOLID187", Kind::solid, 10, {{6, {}}}}},
      {45, {"SOLID45", Kind::solid, 8, {{1, {}}, {2, {}}, {4, {}}, {5, {}}, {6, {}}, {9, {}}}}},
      {185, {"SOLID185", Kind::solid, 8, {{2, {}}, {6, {}}}}},
      {14, {"COMBIN14", Kind::spring, 2, {{2, {0, 1, 2, 3, 4, 5, 6}}, {3, {0, 1, 2}}}}},
      {40, {"COMBIN40", Kind::spring, 2, {{1, {}}, {3, {0, 1, 2, 3, 4, 5, 6}}, {4, {}}, {6, {0, 1, 2}}}}},
      {21, {"MASS21", Kind::mass, 1, {{2, {}}, {3, {0, 2, 3, 4}}}}},
      {184, {"MPC184", Kind::rigid, 2, {{1, {1}}, {2, {}}}}},
      {153, {"SURF153", Kind::load, 0, {}}},
      {154, {"SURF154", Kind::load, 0, {}}},
      {156, {"SURF156", Kind::load, 0, {}}},
      {200, {"MESH200", Kind::load, 0, {}}},
      {201, {"FOLLW201", Kind::load, 0, {}}},
      {91, {"SHELL91", Kind::layered, 0, {}}},
      {99, {"SHELL99", Kind::layered, 0, {}}}};
  return known;
}

}  // namespace

const ElementType* element_type(const std::string& name) {
  constexpr std::size_t longest_number = 6;                             // digits
  const std::size_t letters = name.find_last_not_of("0123456789") + 1;  // npos + 1 is 0: nothing but digits
  const std::string digits = name.substr(letters);
  if (digits.empty() || digits.size() > longest_number) return nullptr;
  const auto found = types().find(std::stoi(digits));
  if (found == types().end() || (letters > 0 && found->second.name != name)) return nullptr;
  return &found->second;
}

std::string element_type_list() {
  std::string list;
  for (const auto& [number, type] : types())
    if (type.kind != Kind::load && type.kind != Kind::layered) list += (list.empty() ? "" : ", ") + type.name;
  return list;
}

}  // namespace twindeck::model_io::ansys
