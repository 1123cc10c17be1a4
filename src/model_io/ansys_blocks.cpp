#include "model_io/ansys_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "model_io/ansys_mesh.hpp"
#include "model_io/ansys_properties.hpp"

/// Blocks: a command, the format of its lines, the lines.
namespace twindeck::model_io::ansys {
namespace {

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
  if (!parse_columns(text, columns) || columns.integers < least_integers) {
    here(parts, block)
        .fail(fmt::format("'{}' is no format of this block", trimmed(text)),
              "expected so many whole numbers and reals with their widths, for example (3i9,6e21.13e3)");
  }
  return columns;
}

DeckFields needed_cells(Parts& parts, const Command& block, const Columns& columns) {
  const std::string text = needed_line(parts, block);
  return columns.cells(here(parts, block), text);
}

/// The line that ends a block of nodes: -1, or the command N,R5.3,LOC,-1 or N,UNBL,LOC,-1 of an unblocked node.
bool ends_nodes(const std::string& text) {
  const std::string start = upper_case(trimmed(text).substr(0, 2));
  return start == "-1" || (start == "N," && text.find("-1") != std::string::npos);
}

}  // namespace

void read_type_block(Parts& parts, const Command& block) {
  const Columns columns = format_below(parts, block, 2);
  while (true) {
    const auto cells = needed_cells(parts, block, columns);
    const long id = cells.integer_or(0, 0);
    if (id < 1) break;
    TypeDefinition definition;
    definition.line = parts.deck.line();
    definition.name = cells.word(1);
    definition.type = element_type(definition.name);
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
    Node node;
    node.x_m = cells.vector(columns.integers);
    for (std::size_t i = 3; i < columns.reals; ++i)
      node.rotated = node.rotated || cells.number_or(columns.integers + i, 0.0) != 0.0;
    add_node(parts, id, node);
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
    while (!element.nodes.empty() && element.nodes.back() == 0) element.nodes.pop_back();
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
      if (component.of_nodes) {
        add(parts.nodes, from, std::abs(member));
      } else {
        add(parts.elements, from, std::abs(member));
      }
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
    while (static_cast<long>(set.values.size()) < count) {
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
