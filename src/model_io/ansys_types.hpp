#pragma once

#include <map>
#include <string>
#include <vector>

namespace twindeck::model_io::ansys {

/// What an element type becomes.
enum class Kind {
  beam,
  plane_beam,  ///< in the global X-Y plane; its nodes are held out of it
  bar,
  shell,
  solid,
  spring,
  mass,
  rigid,    ///< rigid link
  load,     ///< carries loads or nothing: left out
  layered,  ///< shells of several layers: refused with a hint
};

struct ElementType {
  std::string name;  ///< "SHELL181"
  Kind kind;
  std::size_t nodes;                        ///< that make the element, without one that only gives a direction
  std::map<int, std::vector<int>> options;  ///< KEYOPT(n): values that are read; an empty list: any, it changes no mode
};

/// By its name ("SHELL181", "181", in upper case); null for a type that is not read.
[[nodiscard]] const ElementType* element_type(const std::string& name);
/// "BEAM3, BEAM4 …": what is read, for messages.
[[nodiscard]] std::string element_type_list();

}  // namespace twindeck::model_io::ansys
