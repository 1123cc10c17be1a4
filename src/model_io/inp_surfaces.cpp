#include "model_io/inp_surfaces.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "model_io/deck_stage.hpp"
#include "model_io/inp_elements.hpp"

namespace twindeck::model_io {
namespace {

/// The facet that "S3" of an element names.
InpFacet facet_of(const DeckPlace& at, const InpElement& element, const std::string& face) {
  const InpKind kind = inp_kind(element.type);
  const bool numbered = face.size() == 2 && face[1] >= '1' && face[1] <= '6';
  const std::size_t number = numbered ? static_cast<std::size_t>(face[1] - '1') : 0;
  InpFacet facet{{}, element.id, kind == InpKind::shell};
  const bool of_solid = kind == InpKind::solid && numbered && face[0] == 'S';
  if (of_solid && number < solid_faces(element.nodes.size()).size()) {
    for (const std::size_t i : solid_faces(element.nodes.size())[number]) facet.nodes.push_back(element.nodes[i]);
  } else if (kind == InpKind::shell && element.nodes.size() < 5 && (face.empty() || face == "SPOS" || face == "SNEG")) {
    facet.nodes = element.nodes;
    if (face == "SNEG") std::reverse(facet.nodes.begin(), facet.nodes.end());
  } else if (kind == InpKind::shell && element.nodes.size() < 5 && numbered && face[0] == 'E' &&
             number < element.nodes.size()) {
    facet.nodes = {element.nodes[number], element.nodes[(number + 1) % element.nodes.size()]};
  } else {
    at.fail(
        fmt::format("'{}' is no face of element {}, a {}", face, element.id, element.type),
        "hexahedra have S1 to S6, tetrahedra S1 to S4, shells SPOS, SNEG and edges E1 to E4; shells with nodes on their edges "
        "have none; name nodes by TYPE=NODE");
  }
  return facet;
}

void add_faces(InpParts& parts, const InpLine& line, InpSurface& surface) {
  const std::string face = line.fields.size() > 1 ? line.word(1) : "";
  std::vector<long> ids;
  if (parts.is_number(line.fields[0]))
    ids = {parts.element_id(line, 0)};
  else
    ids = parts.set(parts.element_sets, line, line.fields[0]).members;
  for (const long id : ids) {
    const auto element = parts.elements.find(id);
    if (element == parts.elements.end()) line.fail(fmt::format("element {} is not defined by any *ELEMENT", id), "define it");
    surface.facets.push_back(facet_of(line, element->second, face));
    const auto& nodes = surface.facets.back().nodes;
    surface.nodes.insert(surface.nodes.end(), nodes.begin(), nodes.end());
  }
}

}  // namespace

const InpSurface& InpParts::surface(const DeckPlace& at, const std::string& name) const {
  if (const std::string key = find_key(surfaces, name); !key.empty()) return surfaces.at(key);
  std::vector<std::string> known;
  for (const auto& [key, each] : surfaces) known.push_back(each.name);
  at.fail(fmt::format("no surface is called '{}'{}", name, did_you_mean(name, known)),
          at.label == "*TIE" ? "write slave, master, and define both by *SURFACE" : "define it by *SURFACE");
}

void read_inp_surface(InpParts& parts, const InpCard& card) {
  card.allow({"NAME", "TYPE", "INTERNAL"});
  const std::string type = upper_case(card.get("TYPE", "ELEMENT"));
  if (type != "ELEMENT" && type != "NODE")
    card.fail(fmt::format("unsupported TYPE={}", type), "give faces of elements, or nodes");
  InpSurface surface;
  surface.name = card.required("NAME");
  for (const InpLine& line : card.data) {
    if (line.fields[0].empty())
      line.fail("names no element or set: the free faces of everything are not read", "name the faces, as in: SET, S1");
    if (type == "ELEMENT") {
      add_faces(parts, line, surface);
      continue;
    }
    const std::vector<long> nodes = parts.nodes_of(line, 0);
    surface.nodes.insert(surface.nodes.end(), nodes.begin(), nodes.end());
  }
  std::sort(surface.nodes.begin(), surface.nodes.end());
  surface.nodes.erase(std::unique(surface.nodes.begin(), surface.nodes.end()), surface.nodes.end());
  if (surface.nodes.empty()) card.fail("holds nothing", "name faces or nodes below it");
  if (!parts.surfaces.emplace(parts.key_here(surface.name), surface).second)
    card.fail(fmt::format("surface '{}' is defined twice", surface.name), "keep one of the two");
}

}  // namespace twindeck::model_io
