#include "model_io/ansys_mesh.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "model_io/ansys_properties.hpp"

/// Nodes and elements, one command each or in blocks: a command, the format of its lines, the lines.
namespace twindeck::model_io::ansys {
namespace {

void add_node(Parts& parts, long id, const Node& node) {
  parts.nodes[id] = node;
  if (!parts.selected_nodes.all) parts.selected_nodes.ids.insert(id);
}

void add_element(Parts& parts, long id, Element element) {
  parts.elements[id] = std::move(element);
  if (!parts.selected_elements.all) parts.selected_elements.ids.insert(id);
}

void drop_blank_end(Element& element) {
  while (!element.nodes.empty() && element.nodes.back() == 0) element.nodes.pop_back();
}

void append_nodes(const Command& command, Element& element) {
  for (std::size_t i = 0; i < command.fields.size(); ++i) element.nodes.push_back(command.integer_or(i, 0));
  drop_blank_end(element);
}

/// Axes of a node, turned about z, then about its own x, then about its own y [degrees].
Eigen::Matrix3d turned_axes(const Eigen::Vector3d& angles) {
  if (angles.isZero(0.0)) return Eigen::Matrix3d::Identity();
  const auto by = [&](int i, int axis) {
    return Eigen::AngleAxisd(angles[i] * std::numbers::pi / 180.0, Eigen::Vector3d::Unit(axis));
  };
  return (by(0, 2) * by(1, 0) * by(2, 1)).toRotationMatrix().transpose();
}

Node& known_node(Parts& parts, const Command& command, long id, const char* mend = "define it before, or correct the number") {
  const auto found = parts.nodes.find(id);
  if (found == parts.nodes.end()) command.fail(fmt::format("node {} is not defined", id), mend);
  return found->second;
}

/// N,R5.3,LOC,node,x,y,z, or N,UNBL,LOC,…: how an archive without blocks writes them; node -1 ends a block.
bool read_archived_node(Parts& parts, const Command& command) {
  if (!command.word(0).starts_with("R5.") && command.word(0) != "UNBL") return false;
  const long id = command.integer(2);
  if (id < 1) return true;
  const Eigen::Vector3d values = command.vector(3);
  if (command.word(1) == "LOC") {
    add_node(parts, id, {values});
  } else if (command.word(1) == "ANG") {
    known_node(parts, command, id, "give its LOC line before").axes = turned_axes(values);
  } else {
    command.fail(fmt::format("'{}' is neither LOC nor ANG", command.fields[1]), "check the archive");
  }
  return true;
}

constexpr long most_copies = 1'000'000;  ///< of one command: more is a slip of the pen

long copies_of(const Command& command, std::size_t field) {
  const long copies = command.integer_or(field, 1);
  if (copies < 1 || copies > most_copies)
    command.fail(fmt::format("{} is no number of copies", copies), "give how often it is repeated, the first included");
  return copies;
}

void require_global_axes(Parts& parts, const Command& command) {
  if (parts.own_axes)
    command.fail("stands where CSYS is not 0, and other axes are not supported", "repeat in global Cartesian axes");
}

void refuse_ratio(const Command& command, std::size_t field) {
  if (const double ratio = command.number_or(field, 1.0); ratio != 1.0 && ratio != 0.0)
    command.fail(fmt::format("has a spacing ratio of {:g}, which is not supported", ratio), "space nodes evenly");
}

constexpr long largest_list = 10'000'000;  ///< numbers that a component may list: more is a slip of the pen

std::string needed_line(Parts& parts, const Command& block) {
  std::string text;
  if (!parts.deck.next_line(text)) block.fail("the file ends within this block", "complete it");
  return text;
}

/// The line that was read last.
DeckPlace here(const Parts& parts, const Command& block) { return parts.at(parts.deck.line(), block.name); }

Columns format_below(Parts& parts, const Command& block, std::size_t least_integers) {
  Columns columns;
  const std::string text = needed_line(parts, block);
  if (!parse_columns(text, columns) || columns.integers < least_integers)
    here(parts, block)
        .fail(fmt::format("'{}' is no format of this block", trimmed(text)),
              "expected so many whole numbers and reals with their widths, for example (3i9,6e21.13e3)");
  return columns;
}

DeckFields needed_cells(Parts& parts, const Command& block, const Columns& columns) {
  return columns.cells(here(parts, block), needed_line(parts, block));
}

/// The line that ends a block of nodes: -1, or the command N,R5.3,LOC,-1 or N,UNBL,LOC,-1 of an unblocked node.
bool ends_nodes(const std::string& text) {
  const std::string start = upper_case(trimmed(text).substr(0, 2));
  return start == "-1" || (start == "N," && text.find("-1") != std::string::npos);
}

}  // namespace

void read_node(Parts& parts, const Command& command) {
  if (read_archived_node(parts, command)) return;
  if (parts.own_axes)
    command.fail("stands where CSYS is not 0, and other axes are not supported", "give nodes in global Cartesian axes");
  const long id = command.integer_or(0, parts.nodes.empty() ? 1 : parts.nodes.rbegin()->first + 1);
  if (id < 1) command.fail(fmt::format("{} is no node number", id), "give 1 or more");
  add_node(parts, id, {command.vector(1), turned_axes(command.vector(4))});
  parts.last_nodes = {parts.last_nodes[1], id};
}

void read_element(Parts& parts, const Command& command) {
  Element element = parts.active;
  element.line = command.line;
  append_nodes(command, element);
  add_element(parts, parts.elements.empty() ? 1 : parts.elements.rbegin()->first + 1, element);
}

void read_numbered_element(Parts& parts, const Command& command) {
  if (command.word(0).starts_with("R5.") || command.word(0) == "UNBL")
    command.fail("elements of an archive without blocks are not read", "write it by CDWRITE with the option BLOCKED");
  const long id = command.integer(0);
  if (id < 1) command.fail(fmt::format("{} is no element number", id), "give 1 or more");
  Command rest = command;
  rest.drop(1);
  Element element = parts.active;
  element.line = command.line;
  append_nodes(rest, element);
  add_element(parts, id, element);
}

void read_attribute(Parts& parts, const Command& command) {
  const long value = command.integer_or(0, 1);
  (command.key == "TYPE"   ? parts.active.type
   : command.key == "MAT"  ? parts.active.material
   : command.key == "REAL" ? parts.active.real
                           : parts.active.section) = value;
}

void read_axes(Parts& parts, const Command& command) {
  // LOCAL, CLOCAL and CS make the axes that they define the active ones.
  parts.own_axes = command.key != "CSYS" || command.integer_or(0, 0) != 0;
}

void fill_nodes(Parts& parts, const Command& command) {
  // FILL,node1,node2,number,first,step,times,increment,ratio
  require_global_axes(parts, command);
  refuse_ratio(command, 7);
  const long from = command.integer_or(0, parts.last_nodes[0]), to = command.integer_or(1, parts.last_nodes[1]);
  const long count = command.integer_or(2, std::abs(to - from) - 1);
  if (count < 0 || count > most_copies)
    command.fail(fmt::format("fills in {} nodes", count), "give two nodes with a gap between, and how many fill it");
  if (count == 0) return;
  const long step = command.integer_or(4, (to - from) / (count + 1));
  const long first = command.integer_or(3, from + step), times = copies_of(command, 5);
  const long increment = command.integer_or(6, 0);
  for (long copy = 0; copy < times; ++copy) {
    const Eigen::Vector3d a = known_node(parts, command, from + copy * increment).x_m,
                          b = known_node(parts, command, to + copy * increment).x_m;
    for (long i = 1; i <= count; ++i)
      add_node(parts, first + (i - 1) * step + copy * increment,
               {a + (b - a) * (static_cast<double>(i) / static_cast<double>(count + 1))});
  }
}

void generate_nodes(Parts& parts, const Command& command) {
  // NGEN,times,increment,node1,node2,step,dx,dy,dz,ratio
  require_global_axes(parts, command);
  refuse_ratio(command, 8);
  const long times = copies_of(command, 0), increment = command.integer(1);
  Command range = command;
  range.drop(2);
  if (range.fields.size() > 3) range.fields.resize(3);
  const Eigen::Vector3d shift = command.vector(5);
  for (const long id : parts.nodes_of(range, 0, 1)) {
    const Node original = parts.nodes.at(id);
    for (long copy = 1; copy < times; ++copy)
      add_node(parts, id + copy * increment, {original.x_m + static_cast<double>(copy) * shift, original.axes});
  }
}

void generate_elements(Parts& parts, const Command& command) {
  // EGEN,times,node increment,element1,element2,step,material,type,real,axes,section; element1 < 0: the last so many
  const long times = copies_of(command, 0), increment = command.integer(1);
  std::vector<long> ids;
  const long first = command.word(2) == "ALL" ? 0 : command.integer_or(2, -1);
  if (first > 0) {
    const long last = std::max(first, command.integer_or(3, first)), step = std::max(1L, command.integer_or(4, 1));
    for (long id = first; id <= last; id += step)
      if (parts.elements.contains(id)) ids.push_back(id);
  } else {
    for (const auto& [id, element] : parts.elements) ids.push_back(id);
    if (first < 0 && std::ssize(ids) > -first) ids.erase(ids.begin(), ids.end() + first);
  }
  if (ids.empty()) command.fail("repeats no element", "name elements that are defined");
  for (long copy = 1; copy < times; ++copy)
    for (const long id : ids) {
      Element element = parts.elements.at(id);
      element.line = command.line;
      for (long& node : element.nodes) node += node == 0 ? 0 : copy * increment;
      element.material += copy * command.integer_or(5, 0);
      element.type += copy * command.integer_or(6, 0);
      element.real += copy * command.integer_or(7, 0);
      element.section += copy * command.integer_or(9, 0);
      add_element(parts, parts.elements.rbegin()->first + 1, element);
    }
}

void read_more_nodes(Parts& parts, const Command& command) {
  constexpr std::size_t of_e = 8;  // nodes that E holds
  if (parts.elements.empty()) command.fail("stands before any E", "give E with the first eight nodes before it");
  Element& element = parts.elements.rbegin()->second;
  if (element.nodes.size() < of_e) element.nodes.resize(of_e, 0);
  append_nodes(command, element);
}

void read_type_block(Parts& parts, const Command& block) {
  const Columns columns = format_below(parts, block, 2);
  while (true) {
    const auto cells = needed_cells(parts, block, columns);
    const long id = cells.integer_or(0, 0);
    if (id < 1) break;
    TypeDefinition definition{cells.word(1), element_type(cells.word(1)), {}, parts.deck.line()};
    for (std::size_t i = 2; i < cells.fields.size(); ++i)
      if (const long value = cells.integer_or(i, 0); value != 0)
        definition.options[static_cast<int>(i) - 1] = {value, definition.line};
    parts.types[id] = definition;
  }
}

void read_node_block(Parts& parts, const Command& block) {
  const Columns columns = format_below(parts, block, 1);
  if (columns.reals < 3) here(parts, block).fail("its format has fewer than three coordinates", "give x, y, z of each node");
  while (true) {
    const std::string text = needed_line(parts, block);
    if (ends_nodes(text)) break;
    const auto cells = columns.cells(here(parts, block), text);
    const long id = cells.integer_or(0, 0);
    if (id < 1)
      here(parts, block)
          .fail(fmt::format("'{}' is neither a node nor the end of the block", trimmed(text)), "end the block by -1");
    add_node(parts, id, {cells.vector(columns.integers), turned_axes(cells.vector(columns.integers + 3))});
  }
}

void read_element_block(Parts& parts, const Command& block) {
  const bool solid = block.word(1) == "SOLID";
  const std::size_t header = solid ? 11 : 5;
  const Columns columns = format_below(parts, block, header + 1);
  while (true) {
    DeckFields cells = needed_cells(parts, block, columns);
    if (cells.integer_or(0, 0) < 0) break;
    const auto at = [&](std::size_t i) { return cells.integer_or(i, 0); };
    Element element;
    element.line = parts.deck.line();
    long id = 0;
    std::size_t count = 0;
    if (solid) {
      // material, type, real, section, axes, death, geometry, shape, number of nodes, nothing, element
      element.material = at(0), element.type = at(1), element.real = at(2), element.section = at(3);
      count = static_cast<std::size_t>(std::clamp(at(8), 0L, 20L));
      id = at(10);
    } else {
      // element, type or section, real, material, axes
      id = at(0), element.type = element.section = at(1), element.real = at(2), element.material = at(3);
      const auto definition = parts.types.find(element.type);
      const bool known = definition != parts.types.end() && definition->second.type != nullptr;
      count = known ? definition->second.type->nodes : columns.integers - header;
    }
    if (id < 1)
      parts.at(element.line, block.name)
          .fail(fmt::format("{} is no element number", id),
                "end the block by -1, or compare the line with the format below " + block.name);
    for (std::size_t i = header; element.nodes.size() < count || !solid; ++i) {
      if (i >= columns.integers) {
        if (element.nodes.size() >= count) break;
        cells = needed_cells(parts, block, columns);
        i = 0;
      }
      if (i >= cells.fields.size() && !solid) break;
      element.nodes.push_back(cells.integer_or(i, 0));
    }
    drop_blank_end(element);
    add_element(parts, id, element);
  }
}

void read_component_block(Parts& parts, const Command& block) {
  if (block.blank(0)) block.fail("has no name", "write CMBLOCK,name,NODE,count");
  const long count = block.integer(2);
  if (count < 0 || count > largest_list)
    block.fail(fmt::format("{} is no number of members", count), "give how many numbers follow");
  const Columns columns = format_below(parts, block, 1);
  Component component{block.fields[0], block.word(1) == "NODE", {}};
  const auto add = [&](const auto& defined, long from, long to) {
    for (auto it = defined.lower_bound(from); it != defined.end() && it->first <= to; ++it) component.members.insert(it->first);
  };
  long last = 0;
  for (long read = 0; read < count;) {
    const auto cells = needed_cells(parts, block, columns);
    if (cells.fields.empty()) here(parts, block).fail("this line is empty", "the block lists more members");
    for (std::size_t i = 0; i < cells.fields.size() && read < count; ++i, ++read) {
      const long member = cells.integer_or(i, 0);
      if (member < 0 && (last < 1 || -member < last))
        here(parts, block)
            .fail(fmt::format("'{} {}' is no range of members", last, member),
                  "a negative number ends a range that the number before begins");
      const long from = member < 0 ? last + 1 : member;
      if (component.of_nodes)
        add(parts.nodes, from, std::abs(member));
      else
        add(parts.elements, from, std::abs(member));
      last = member;
    }
  }
  if (block.word(1) == "NODE" || block.word(1).starts_with("ELEM")) parts.components.push_back(std::move(component));
}

void read_real_block(Parts& parts, const Command& block) {
  constexpr long most_constants = 1000;  // of one set: a shell of 250 layers
  const long sets = block.integer(0);
  const Columns first = format_below(parts, block, 2), next = format_below(parts, block, 0);
  if (first.reals == 0 || next.reals == 0) block.fail("its formats hold no reals", "expected (2i8,6g16.9) and (7g16.9)");
  for (long i = 0; i < sets; ++i) {
    auto cells = needed_cells(parts, block, first);
    const long id = cells.integer_or(0, 0), count = cells.integer_or(1, 0);
    if (id < 1 || count < 0 || count > most_constants)
      here(parts, block)
          .fail(fmt::format("set {} of {} constants is none", id, count),
                "expected the number of the set, the number of its constants, the constants");
    RealSet set;
    set.line = parts.deck.line();
    std::size_t at = first.integers;
    while (std::ssize(set.values) < count) {
      if (at >= (set.values.size() < first.reals ? first.integers + first.reals : next.reals)) {
        cells = needed_cells(parts, block, next);
        at = 0;
      }
      set.values.push_back(cells.number_or(at++, 0.0));
    }
    parts.reals[id] = std::move(set);
  }
}

void read_section_block(Parts& parts, const Command& block) {
  const long rows = block.integer_or(0, 1);
  for (long i = 0; i < rows; ++i) {
    Command row = block;
    row.fields = split_fields(needed_line(parts, block), ',');
    row.line = parts.deck.line();
    read_section_data(parts, row);
  }
}

}  // namespace twindeck::model_io::ansys
