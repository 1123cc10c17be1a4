#include "model_io/inp_mesh.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "model_io/inp_elements.hpp"
#include "model_io/inp_parts.hpp"

namespace twindeck::model_io {
namespace {

void add_to_set(std::map<std::string, InpSet>& sets, const std::string& name, long member) {
  InpSet& set = sets[upper_case(name)];
  if (set.name.empty()) set.name = name;
  set.members.push_back(member);
}

}  // namespace

void read_inp_nodes(InpParts& parts, const InpCard& card) {
  parts.file.allow(card, {"NSET"});
  for (const InpLine& line : card.data) {
    fe::Node node;
    node.id = parts.file.integer(card, line, 0);
    for (int i = 0; i < 3; ++i) node.x_m[i] = parts.file.number_or(card, line, static_cast<std::size_t>(i) + 1, 0.0);
    if (!parts.node_position.emplace(node.id, static_cast<int>(parts.model.nodes.size())).second) {
      parts.file.fail(card, line.line, fmt::format("node {} is defined twice", node.id), "keep one of the two lines");
    }
    parts.model.nodes.push_back(node);
    if (card.has("NSET")) add_to_set(parts.node_sets, card.get("NSET"), node.id);
  }
}

void read_inp_elements(InpParts& parts, const InpCard& card) {
  parts.file.allow(card, {"TYPE", "ELSET"});
  const std::string type = upper_case(parts.file.required(card, "TYPE"));
  const int wanted = inp_node_count(type);
  if (wanted == 0) {
    parts.file.fail(card, card.line,
                    fmt::format("unsupported element type {}{}", type, did_you_mean(type, inp_element_types())),
                    "supported are " + inp_element_type_list());
  }
  InpElement element;
  bool open = false;
  for (const InpLine& line : card.data) {
    std::size_t field = 0;
    if (!open) {
      element = {parts.file.integer(card, line, 0), type, {}, &card, line.line, 0};
      field = 1;
    }
    for (; field < line.fields.size(); ++field) element.nodes.push_back(parts.file.integer(card, line, field));
    open = static_cast<int>(element.nodes.size()) < wanted;
    if (open) continue;
    if (static_cast<int>(element.nodes.size()) > wanted) {
      parts.file.fail(card, line.line,
                      fmt::format("element {} has {} nodes, a {} has {}", element.id, element.nodes.size(), type, wanted),
                      "check TYPE and the data line");
    }
    if (!parts.elements.emplace(element.id, element).second) {
      parts.file.fail(card, element.line, fmt::format("element {} is defined twice", element.id), "keep one of the two");
    }
    if (card.has("ELSET")) add_to_set(parts.element_sets, card.get("ELSET"), element.id);
  }
  if (open) {
    parts.file.fail(card, element.line,
                    fmt::format("element {} has {} nodes, a {} has {}", element.id, element.nodes.size(), type, wanted),
                    "complete the data line");
  }
}

void read_inp_set(InpParts& parts, const InpCard& card) {
  const bool of_nodes = card.keyword == "NSET";
  parts.file.allow(card, {of_nodes ? "NSET" : "ELSET", "GENERATE", "INTERNAL", "INSTANCE", "UNSORTED"});
  auto& sets = of_nodes ? parts.node_sets : parts.element_sets;
  const std::string name = parts.file.required(card, of_nodes ? "NSET" : "ELSET");
  for (const InpLine& line : card.data) {
    if (card.has("GENERATE")) {
      const long first = parts.file.integer(card, line, 0), last = parts.file.integer(card, line, 1);
      const long step = line.fields.size() > 2 ? parts.file.integer(card, line, 2) : 1;
      if (step < 1 || last < first || (last - first) / step > 10'000'000) {
        parts.file.fail(card, line.line, fmt::format("'{}, {}, {}' is no range: first, last, step", first, last, step),
                        "first must not lie above last, step is 1 or more");
      }
      for (long id = first; id <= last; id += step) add_to_set(sets, name, id);
      continue;
    }
    for (std::size_t i = 0; i < line.fields.size(); ++i) {
      if (line.fields[i].empty()) continue;
      if (InpFile::is_integer(line.fields[i])) {
        add_to_set(sets, name, parts.file.integer(card, line, i));
        continue;
      }
      const std::vector<long> members = parts.set(sets, card, line.line, line.fields[i]).members;  // a copy: the map may move
      for (const long member : members) add_to_set(sets, name, member);
    }
  }
}

int InpParts::node(const InpCard& card, long line, long id) const {
  const auto found = node_position.find(id);
  if (found == node_position.end()) {
    file.fail(card, line, fmt::format("node {} is not defined by any *NODE", id), "define it, or correct the number");
  }
  return found->second;
}

const InpSet& InpParts::set(const std::map<std::string, InpSet>& sets, const InpCard& card, long line,
                            const std::string& name) const {
  auto found = sets.find(upper_case(name));
  if (const auto point = name.find('.'); found == sets.end() && point != std::string::npos) {
    found = sets.find(upper_case(name.substr(point + 1)));
  }
  if (found != sets.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [key, set] : sets) known.push_back(set.name);
  file.fail(card, line, fmt::format("no set is called '{}'{}", name, did_you_mean(name, known)),
            "define it by *NSET or *ELSET, or on the *NODE or *ELEMENT card");
}

std::vector<long> InpParts::nodes_of(const InpCard& card, const InpLine& line, std::size_t field) const {
  if (field >= line.fields.size() || line.fields[field].empty()) {
    file.fail(card, line.line, fmt::format("field {} is missing, expected a node or a set of nodes", field + 1), "name it");
  }
  if (InpFile::is_integer(line.fields[field])) return {file.integer(card, line, field)};
  return set(node_sets, card, line.line, line.fields[field]).members;
}

std::string InpParts::group_of(const InpCard& card, const InpElement& element) const {
  const InpCard& by = element.card->has("ELSET") ? *element.card : card;
  return set(element_sets, by, by.line, by.get("ELSET")).name;
}

const InpCard* InpParts::card_after(const InpCard& card) const {
  const auto next = static_cast<std::size_t>(&card - file.cards().data()) + 1;
  return next < file.cards().size() ? &file.cards()[next] : nullptr;
}

std::vector<InpElement*> InpParts::elements_of(const InpCard& card) {
  std::vector<InpElement*> found;
  for (const long id : set(element_sets, card, card.line, file.required(card, "ELSET")).members) {
    const auto element = elements.find(id);
    if (element == elements.end()) {
      file.fail(card, card.line, fmt::format("set '{}' holds element {}, which no *ELEMENT defines", card.get("ELSET"), id),
                "define it, or take it out of the set");
    }
    ++element->second.used;
    found.push_back(&element->second);
  }
  return found;
}

}  // namespace twindeck::model_io
