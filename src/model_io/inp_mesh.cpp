#include "model_io/inp_mesh.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "model_io/inp_elements.hpp"

namespace twindeck::model_io {
namespace {

/// Adds to the set of that name in the scope at hand.
void add_to_set(const InpParts& parts, std::map<std::string, InpSet>& sets, const std::string& name, long member) {
  InpSet& set = sets[parts.key_here(name)];
  if (set.name.empty()) set.name = name;
  set.scope = parts.scope;
  set.members.push_back(member);
}

/// Scope of the instance "BEAM-2" of a reference "BEAM-2.17", or -1.
int instance_of(const std::vector<InpScope>& scopes, const std::string& reference) {
  for (std::size_t i = 1; i < scopes.size(); ++i) {
    const std::string prefix = upper_case(scopes[i].name) + ".";
    if (upper_case(reference).starts_with(prefix)) return static_cast<int>(i);
  }
  return -1;
}

/// Scope and number of a reference "BEAM-2.17"; of "17" the scope at hand.
std::pair<int, long> referred(const InpParts& parts, const InpCard& card, const InpLine& line, std::size_t field) {
  const std::string text = field < line.fields.size() ? line.fields[field] : "";
  const int instance = instance_of(parts.scopes, text);
  if (instance < 0) return {parts.scope, parts.file.integer(card, line, field)};
  const std::size_t prefix = parts.scopes[static_cast<std::size_t>(instance)].name.size() + 1;
  return {instance, parts.file.integer(card, {line.line, {text.substr(prefix)}}, 0)};
}

/// Scope of the instance that INSTANCE= names, else the one at hand.
int instance_named(const InpParts& parts, const InpCard& card) {
  const std::string wanted = card.get("INSTANCE");
  if (wanted.empty() || parts.scopes.size() == 1) return parts.scope;
  std::vector<std::string> known;
  for (std::size_t i = 1; i < parts.scopes.size(); ++i) {
    if (upper_case(parts.scopes[i].name) == upper_case(wanted)) return static_cast<int>(i);
    known.push_back(parts.scopes[i].name);
  }
  parts.file.fail(card, card.line, fmt::format("no instance is called '{}'{}", wanted, did_you_mean(wanted, known)),
                  "name one of the instances above");
}

/// What is added to the numbers of a range that begins with `first`: those of the only instance where the assembly has no such
/// number.
long generate_offset(const InpParts& parts, const InpCard& card, const InpLine& line, int scope, bool of_nodes) {
  const auto offset = [&](int in) {
    const InpScope& of = parts.scopes[static_cast<std::size_t>(in)];
    return of_nodes ? of.node_offset : of.element_offset;
  };
  if (scope > 0 || parts.scopes.size() == 1) return offset(scope);
  const long id = parts.file.integer(card, line, 0) + offset(0);
  const auto node = parts.scope_of_node.find(id);
  const auto element = parts.elements.find(id);
  const bool known = of_nodes ? node != parts.scope_of_node.end() && node->second == 0
                              : element != parts.elements.end() && element->second.scope == 0;
  if (known) return offset(0);
  if (parts.scopes.size() == 2) return offset(1);
  parts.file.fail(card, line.line,
                  fmt::format("{} {} is not defined in the assembly", of_nodes ? "node" : "element", line.fields[0]),
                  "name the instance by INSTANCE= on the card");
}

}  // namespace

void read_inp_nodes(InpParts& parts, const InpCard& card) {
  parts.file.allow(card, {"NSET"});
  const InpScope& scope = parts.scopes[static_cast<std::size_t>(parts.scope)];
  for (const InpLine& line : card.data) {
    fe::Node node;
    const long written = parts.file.integer(card, line, 0);
    node.id = written + scope.node_offset;
    Eigen::Vector3d x;
    for (int i = 0; i < 3; ++i) x[i] = parts.file.number_or(card, line, static_cast<std::size_t>(i) + 1, 0.0);
    node.x_m = scope.turned() ? Eigen::Vector3d(scope.rotation * x + scope.shift_m) : Eigen::Vector3d(x + scope.shift_m);
    if (!parts.node_position.emplace(node.id, static_cast<int>(parts.model.nodes.size())).second) {
      parts.file.fail(card, line.line, fmt::format("node {} is defined twice", written), "keep one of the two lines");
    }
    parts.model.nodes.push_back(node);
    parts.scope_of_node.emplace(node.id, parts.scope);
    if (card.has("NSET")) add_to_set(parts, parts.node_sets, card.get("NSET"), node.id);
  }
}

void read_inp_elements(InpParts& parts, const InpCard& card) {
  parts.file.allow(card, {"TYPE", "ELSET"});
  const std::string type = upper_case(parts.file.required(card, "TYPE"));
  const int wanted = inp_node_count(type);
  if (wanted == 0) {
    if (const std::string linear = inp_linear_type(type); !linear.empty())
      parts.file.fail(card, card.line, fmt::format("{} has nodes between its corners, which is not read", type),
                      "mesh with " + linear);
    parts.file.fail(card, card.line,
                    fmt::format("unsupported element type {}{}", type, did_you_mean(type, inp_element_types())),
                    "supported are " + inp_element_type_list());
  }
  InpElement element;
  bool open = false;
  for (const InpLine& line : card.data) {
    std::size_t field = 0;
    if (!open) {
      element = {};
      element.id = parts.file.integer(card, line, 0) + parts.scopes[static_cast<std::size_t>(parts.scope)].element_offset;
      element.scope = parts.scope;
      element.type = type;
      element.card = &card;
      element.line = line.line;
      field = 1;
    }
    for (; field < line.fields.size(); ++field) element.nodes.push_back(parts.node_id(card, line, field));
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
    if (card.has("ELSET")) add_to_set(parts, parts.element_sets, card.get("ELSET"), element.id);
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
  // INSTANCE= says whose numbers stand below; the set itself belongs to where the card stands.
  const int here = parts.scope, numbered = instance_named(parts, card);
  const auto id_of = [&](const InpLine& line, std::size_t field) {
    parts.scope = numbered;
    const long id = of_nodes ? parts.node_id(card, line, field) : parts.element_id(card, line, field);
    parts.scope = here;
    return id;
  };
  for (const InpLine& line : card.data) {
    if (card.has("GENERATE")) {
      const long first = parts.file.integer(card, line, 0), last = parts.file.integer(card, line, 1);
      const long step = line.fields.size() > 2 ? parts.file.integer(card, line, 2) : 1;
      if (step < 1 || last < first || (last - first) / step > 10'000'000) {
        parts.file.fail(card, line.line, fmt::format("'{}, {}, {}' is no range: first, last, step", first, last, step),
                        "first must not lie above last, step is 1 or more");
      }
      const long offset = generate_offset(parts, card, line, numbered, of_nodes);
      for (long id = first; id <= last; id += step) add_to_set(parts, sets, name, id + offset);
      continue;
    }
    for (std::size_t i = 0; i < line.fields.size(); ++i) {
      if (line.fields[i].empty()) continue;
      if (parts.is_number(line.fields[i])) {
        add_to_set(parts, sets, name, id_of(line, i));
        continue;
      }
      parts.scope = numbered;
      const std::vector<long> members = parts.set(sets, card, line.line, line.fields[i]).members;  // a copy: the map may move
      parts.scope = here;
      for (const long member : members) add_to_set(parts, sets, name, member);
    }
  }
}

std::string InpParts::key_in(int in, const std::string& name) const {
  const std::string& instance = scopes[static_cast<std::size_t>(in)].name;
  return upper_case(instance.empty() ? name : instance + "." + name);
}

bool InpParts::is_number(const std::string& field) const {
  const int instance = instance_of(scopes, field);
  return InpFile::is_integer(instance < 0 ? field : field.substr(scopes[static_cast<std::size_t>(instance)].name.size() + 1));
}

long InpParts::node_id(const InpCard& card, const InpLine& line, std::size_t field) const {
  const auto [in, written] = referred(*this, card, line, field);
  const long id = written + scopes[static_cast<std::size_t>(in)].node_offset;
  const auto is_of = [&](long node, int where) {
    const auto found = scope_of_node.find(node);
    return found != scope_of_node.end() && found->second == where;
  };
  if (is_of(id, in)) return id;
  // A deck of one instance may leave its name out.
  if (in == 0 && scopes.size() == 2 && is_of(written + scopes[1].node_offset, 1)) return written + scopes[1].node_offset;
  no_node(card, line.line, id);
}

long InpParts::element_id(const InpCard& card, const InpLine& line, std::size_t field) const {
  const auto [in, written] = referred(*this, card, line, field);
  const long id = written + scopes[static_cast<std::size_t>(in)].element_offset;
  const auto found = elements.find(id);
  if (in > 0 || scopes.size() == 1 || (found != elements.end() && found->second.scope == in)) return id;
  if (scopes.size() == 2) return written + scopes[1].element_offset;
  file.fail(card, line.line, fmt::format("element {} is not defined in the assembly", written),
            "write INSTANCE.number for an element of an instance, or INSTANCE= on the card");
}

std::string InpParts::node_name(long id) const {
  for (const InpScope& in : scopes) {
    if (in.node_offset > 0 && id > in.node_offset && id <= in.node_offset + in.last_node)
      return fmt::format("{} of {}", id - in.node_offset, in.name.empty() ? "the assembly" : "instance " + in.name);
  }
  return std::to_string(id);
}

int InpParts::node(const InpCard& card, long line, long id) const {
  const auto found = node_position.find(id);
  if (found == node_position.end()) no_node(card, line, id);
  return found->second;
}

void InpParts::no_node(const InpCard& card, long line, long id) const {
  const bool several = scope == 0 && scopes.size() > 2;
  file.fail(card, line, fmt::format("node {} is not defined by any *NODE", node_name(id)),
            several ? "define it, or write INSTANCE.number for a node of an instance" : "define it, or correct the number");
}

const InpSet& InpParts::set(const std::map<std::string, InpSet>& sets, const InpCard& card, long line,
                            const std::string& name) const {
  if (const std::string key = find_key(sets, name); !key.empty()) return sets.at(key);
  std::vector<std::string> known;
  for (const auto& [key, set] : sets) known.push_back(set_name(sets, set));
  file.fail(card, line, fmt::format("no set is called '{}'{}", name, did_you_mean(name, known)),
            "define it by *NSET or *ELSET, or on the *NODE or *ELEMENT card");
}

std::vector<long> InpParts::nodes_of(const InpCard& card, const InpLine& line, std::size_t field) const {
  if (field >= line.fields.size() || line.fields[field].empty()) {
    file.fail(card, line.line, fmt::format("field {} is missing, expected a node or a set of nodes", field + 1), "name it");
  }
  if (is_number(line.fields[field])) return {node_id(card, line, field)};
  return set(node_sets, card, line.line, line.fields[field]).members;
}

int InpParts::reference_node(const InpCard& card) const {
  const std::vector<long> nodes = nodes_of(card, {card.line, {file.required(card, "REF NODE")}}, 0);
  if (nodes.size() != 1) file.fail(card, card.line, "REF NODE names more than one node", "give one");
  return node(card, card.line, nodes.front());
}

void InpParts::refuse_kind(const InpCard& card, const InpElement& element, const std::string& mend) const {
  file.fail(card, card.line, fmt::format("element {} of its set is a {}", element.id, element.type), mend);
}

const InpSet& InpParts::group_set(const InpCard& card, const InpElement& element) const {
  const bool by_element = element.card->has("ELSET");
  const InpCard& by = by_element ? *element.card : card;
  if (by_element) return element_sets.at(key_in(element.scope, by.get("ELSET")));
  return set(element_sets, by, by.line, by.get("ELSET"));
}

std::string InpParts::group_of(const InpCard& card, const InpElement& element) const {
  return set_name(element_sets, group_set(card, element));
}

std::string InpParts::set_name(const std::map<std::string, InpSet>& sets, const InpSet& set) const {
  if (set.scope == 0) return set.name;
  int same = 0;
  for (std::size_t i = 0; i < scopes.size(); ++i) same += sets.contains(key_in(static_cast<int>(i), set.name)) ? 1 : 0;
  return same > 1 ? scopes[static_cast<std::size_t>(set.scope)].name + "." + set.name : set.name;
}

std::set<long> InpParts::turning_nodes() const {
  std::set<long> nodes;
  for (const auto& [id, element] : elements) {
    const InpKind kind = inp_kind(element.type);
    if (kind == InpKind::beam || kind == InpKind::shell) nodes.insert(element.nodes.begin(), element.nodes.end());
  }
  return nodes;
}

void InpParts::add_link(int master, int slave) {
  model.links.push_back({fmt::format("link_{}", model.links.size() + 1), master, slave});
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
