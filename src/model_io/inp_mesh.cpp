#include "model_io/inp_mesh.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/lists.hpp"
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
  for (std::size_t i = 1; i < scopes.size(); ++i)
    if (upper_case(reference).starts_with(upper_case(scopes[i].name) + ".")) return static_cast<int>(i);
  return -1;
}

/// Scope and number of a reference "BEAM-2.17"; of "17" the scope at hand.
std::pair<int, long> referred(const InpParts& parts, const InpLine& line, std::size_t field) {
  const std::string text = line.text(field);
  const int instance = instance_of(parts.scopes, text);
  if (instance < 0) return {parts.scope, line.integer(field)};
  const std::size_t prefix = parts.scopes[fe::slot(instance)].name.size() + 1;
  return {instance, InpLine{line, {text.substr(prefix)}}.integer(0)};
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
  card.fail(fmt::format("no instance is called '{}'{}", wanted, did_you_mean(wanted, known)),
            "name one of the instances above");
}

/// What is added to the numbers of a range that begins with `first`: those of the only instance where the assembly has no such
/// number.
long generate_offset(const InpParts& parts, const InpLine& line, int scope, bool of_nodes) {
  const auto offset = [&](int in) {
    const InpScope& of = parts.scopes[static_cast<std::size_t>(in)];
    return of_nodes ? of.node_offset : of.element_offset;
  };
  if (scope > 0 || parts.scopes.size() == 1) return offset(scope);
  const long id = line.integer(0) + offset(0);
  const auto node = parts.scope_of_node.find(id);
  const auto element = parts.elements.find(id);
  const bool known = of_nodes ? node != parts.scope_of_node.end() && node->second == 0
                              : element != parts.elements.end() && element->second.scope == 0;
  if (known) return offset(0);
  if (parts.scopes.size() == 2) return offset(1);
  line.fail(fmt::format("{} {} is not defined in the assembly", of_nodes ? "node" : "element", line.fields[0]),
            "name the instance by INSTANCE= on the card");
}

[[noreturn]] void refuse_count(const DeckPlace& at, const InpElement& element, int wanted, const char* mend) {
  at.fail(fmt::format("element {} has {} nodes, a {} has {}", element.id, element.nodes.size(), element.type, wanted), mend);
}

}  // namespace

void read_inp_nodes(InpParts& parts, const InpCard& card) {
  card.allow({"NSET"});
  const InpScope& scope = parts.scopes[fe::slot(parts.scope)];
  for (const InpLine& line : card.data) {
    const long written = line.integer(0), id = written + scope.node_offset;
    const Eigen::Vector3d x = line.vector(1);
    if (!line.vector(4).isZero(0.0)) parts.with_normal.insert(id);
    if (!parts.scope_of_node.emplace(id, parts.scope).second)
      line.fail(fmt::format("node {} is defined twice", written), "keep one of the two lines");
    parts.add_node(id,
                   scope.turned() ? Eigen::Vector3d(scope.rotation * x + scope.shift_m) : Eigen::Vector3d(x + scope.shift_m));
    if (card.has("NSET")) add_to_set(parts, parts.node_sets, card.get("NSET"), id);
  }
}

void read_inp_elements(InpParts& parts, const InpCard& card) {
  card.allow({"TYPE", "ELSET"});
  const std::string type = upper_case(card.required("TYPE"));
  const int wanted = inp_node_count(type);
  if (wanted == 0) {
    if (const std::string linear = inp_linear_type(type); !linear.empty())
      card.fail(fmt::format("{} has nodes between its corners, which is not read", type), "mesh with " + linear);
    card.fail(fmt::format("unsupported element type {}{}", type, did_you_mean(type, inp_element_types())),
              fmt::format("supported are {}", fmt::join(inp_element_types(), ", ")));
  }
  const bool turns = inp_kind(type) == InpKind::beam || inp_kind(type) == InpKind::shell;
  InpElement element;
  bool open = false;
  for (const InpLine& line : card.data) {
    if (!open)
      element = {line.integer(0) + parts.scopes[fe::slot(parts.scope)].element_offset, parts.scope, type, {}, &card, &line};
    for (std::size_t i = open ? 0 : 1; i < line.fields.size(); ++i) element.nodes.push_back(parts.node_id(line, i));
    open = static_cast<int>(element.nodes.size()) < wanted;
    if (open) continue;
    if (inp_kind(type) == InpKind::beam && static_cast<int>(element.nodes.size()) == wanted + 1) {
      element.towards = element.nodes.back();
      element.nodes.pop_back();
    }
    if (static_cast<int>(element.nodes.size()) > wanted) refuse_count(line, element, wanted, "check TYPE and the data line");
    if (!parts.elements.emplace(element.id, element).second)
      element.at->fail(fmt::format("element {} is defined twice", element.id), "keep one of the two");
    for (const long id : element.nodes)
      if (turns) parts.turning.insert(parts.node(line, id));
    if (card.has("ELSET")) add_to_set(parts, parts.element_sets, card.get("ELSET"), element.id);
  }
  if (open) refuse_count(*element.at, element, wanted, "complete the data line");
}

void read_inp_set(InpParts& parts, const InpCard& card) {
  const bool of_nodes = card.keyword == "NSET";
  card.allow({of_nodes ? "NSET" : "ELSET", "GENERATE", "INTERNAL", "INSTANCE", "UNSORTED"});
  auto& sets = of_nodes ? parts.node_sets : parts.element_sets;
  const std::string name = card.required(of_nodes ? "NSET" : "ELSET");
  // INSTANCE= says whose numbers stand below; the set itself belongs to where the card stands.
  const int here = parts.scope, numbered = instance_named(parts, card);
  const auto id_of = [&](const InpLine& line, std::size_t field) {
    parts.scope = numbered;
    const long id = of_nodes ? parts.node_id(line, field) : parts.element_id(line, field);
    parts.scope = here;
    return id;
  };
  for (const InpLine& line : card.data) {
    if (card.has("GENERATE")) {
      const long first = line.integer(0), last = line.integer(1);
      const long step = line.fields.size() > 2 ? line.integer(2) : 1;
      if (step < 1 || last < first || (last - first) / step > 10'000'000)
        line.fail(fmt::format("'{}, {}, {}' is no range: first, last, step", first, last, step),
                  "first must not lie above last, step is 1 or more");
      const long offset = generate_offset(parts, line, numbered, of_nodes);
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
      const std::vector<long> members = parts.set(sets, line, line.fields[i]).members;  // a copy: the map may move
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
  return is_whole_number(instance < 0 ? field : field.substr(scopes[fe::slot(instance)].name.size() + 1));
}

long InpParts::node_id(const InpLine& line, std::size_t field) const {
  const auto [in, written] = referred(*this, line, field);
  const long id = written + scopes[static_cast<std::size_t>(in)].node_offset;
  const auto is_of = [&](long node, int where) {
    const auto found = scope_of_node.find(node);
    return found != scope_of_node.end() && found->second == where;
  };
  if (is_of(id, in)) return id;
  // A deck of one instance may leave its name out.
  if (in == 0 && scopes.size() == 2 && is_of(written + scopes[1].node_offset, 1)) return written + scopes[1].node_offset;
  no_node(line, id);
}

long InpParts::element_id(const InpLine& line, std::size_t field) const {
  const auto [in, written] = referred(*this, line, field);
  const long id = written + scopes[static_cast<std::size_t>(in)].element_offset;
  const auto found = elements.find(id);
  if (in > 0 || scopes.size() == 1 || (found != elements.end() && found->second.scope == in)) return id;
  if (scopes.size() == 2) return written + scopes[1].element_offset;
  line.fail(fmt::format("element {} is not defined in the assembly", written),
            "write INSTANCE.number for an element of an instance, or INSTANCE= on the card");
}

std::string InpParts::node_name(long id) const {
  for (const InpScope& in : scopes)
    if (in.node_offset > 0 && id > in.node_offset && id <= in.node_offset + in.last_node)
      return fmt::format("{} of {}", id - in.node_offset, in.name.empty() ? "the assembly" : "instance " + in.name);
  return std::to_string(id);
}

int InpParts::node(const DeckPlace& at, long id) const {
  const auto found = node_position.find(id);
  if (found == node_position.end()) no_node(at, id);
  return found->second;
}

void InpParts::no_node(const DeckPlace& at, long id) const {
  const bool several = scope == 0 && scopes.size() > 2;
  at.fail(fmt::format("node {} is not defined by any *NODE", node_name(id)),
          several ? "define it, or write INSTANCE.number for a node of an instance" : "define it, or correct the number");
}

const InpSet& InpParts::set(const std::map<std::string, InpSet>& sets, const DeckPlace& at, const std::string& name) const {
  if (const std::string key = find_key(sets, name); !key.empty()) return sets.at(key);
  const auto known = each_of(sets, [&](const auto& set) { return set_name(sets, set.second); });
  at.fail(fmt::format("no set is called '{}'{}", name, did_you_mean(name, known)),
          "define it by *NSET or *ELSET, or on the *NODE or *ELEMENT card");
}

std::vector<long> InpParts::nodes_of(const InpLine& line, std::size_t field) const {
  if (field >= line.fields.size() || line.fields[field].empty())
    line.fail(fmt::format("field {} is missing, expected a node or a set of nodes", field + 1), "name it");
  if (is_number(line.fields[field])) return {node_id(line, field)};
  return set(node_sets, line, line.fields[field]).members;
}

std::vector<long> InpParts::elements_at(const InpLine& line) const {
  if (is_number(line.fields[0])) return {element_id(line, 0)};
  return set(element_sets, line, line.fields[0]).members;
}

long InpParts::named_node(const InpCard& card, const std::string& parameter) const {
  (void)card.required(parameter);
  const std::vector<long> nodes = nodes_of(card.value(parameter), 0);
  if (nodes.size() != 1) card.fail(parameter + " names more than one node", "give one");
  (void)node(card, nodes.front());
  return nodes.front();
}

void InpParts::refuse_turned(const DeckPlace& at) const {
  if (is_turned())
    at.fail("names a direction by its number in an instance that is rotated, which is not read",
            "write the card at the level of the assembly, or give a spring an ORIENTATION");
}

Eigen::Matrix3d InpParts::axes_of(const DeckPlace& at, long id, bool whole) const {
  const auto found = node_axes.find(id);
  if (found == node_axes.end() && !whole) refuse_turned(at);
  return found == node_axes.end() ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : found->second;
}

const InpSet& InpParts::group_set(const InpCard& card, const InpElement& element) const {
  if (element.card->has("ELSET")) return element_sets.at(key_in(element.scope, element.card->get("ELSET")));
  return set(element_sets, card, card.get("ELSET"));
}

std::string InpParts::group_of(const InpCard& card, const InpElement& element) const {
  return set_name(element_sets, group_set(card, element));
}

std::string InpParts::set_name(const std::map<std::string, InpSet>& sets, const InpSet& set) const {
  if (set.scope == 0) return set.name;
  int same = 0;
  for (std::size_t i = 0; i < scopes.size(); ++i) same += sets.contains(key_in(static_cast<int>(i), set.name)) ? 1 : 0;
  return same > 1 ? scopes[fe::slot(set.scope)].name + "." + set.name : set.name;
}

const InpCard* InpParts::card_after(const InpCard& card) const {
  const auto next = static_cast<std::size_t>(&card - file.cards().data()) + 1;
  return next < file.cards().size() ? &file.cards()[next] : nullptr;
}

std::vector<InpElement*> InpParts::elements_of(const InpCard& card, InpKind kind, InpKind or_kind) {
  std::vector<InpElement*> found;
  for (const long id : set(element_sets, card, card.required("ELSET")).members) {
    const auto element = elements.find(id);
    if (element == elements.end())
      card.fail(fmt::format("set '{}' holds element {}, which no *ELEMENT defines", card.get("ELSET"), id),
                "define it, or take it out of the set");
    if (const InpKind is = inp_kind(element->second.type); is != kind && is != or_kind)
      card.fail(fmt::format("element {} of its set is a {}", id, element->second.type), "such an element takes another card");
    ++element->second.used;
    found.push_back(&element->second);
  }
  return found;
}

}  // namespace twindeck::model_io
