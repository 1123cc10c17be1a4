#include "model_io/ansys_generate.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "model_io/ansys_mesh.hpp"

namespace twindeck::model_io::ansys {
namespace {

constexpr long most_copies = 1'000'000;  ///< of one command: more is a slip of the pen

const Node& known_node(Parts& parts, const Command& command, long id) {
  const auto found = parts.nodes.find(id);
  if (found == parts.nodes.end())
    command.fail(fmt::format("node {} is not defined", id), "define it before, or correct the number");
  return found->second;
}

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

}  // namespace

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
               {a + (b - a) * (static_cast<double>(i) / static_cast<double>(count + 1)), false});
  }
}

void generate_nodes(Parts& parts, const Command& command) {
  // NGEN,times,increment,node1,node2,step,dx,dy,dz,ratio
  require_global_axes(parts, command);
  refuse_ratio(command, 8);
  const long times = copies_of(command, 0), increment = command.integer(1);
  Command range = command;
  range.fields.erase(range.fields.begin(), range.fields.begin() + 2);
  if (range.fields.size() > 3) range.fields.resize(3);
  Eigen::Vector3d shift;
  for (std::size_t i = 0; i < 3; ++i) shift[static_cast<int>(i)] = command.number_or(5 + i, 0.0);
  for (const long id : parts.nodes_of(range, 0, 1)) {
    const Node original = parts.nodes.at(id);
    for (long copy = 1; copy < times; ++copy)
      add_node(parts, id + copy * increment, {original.x_m + static_cast<double>(copy) * shift, original.rotated});
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
  for (std::size_t i = 0; i < command.fields.size(); ++i) element.nodes.push_back(command.integer_or(i, 0));
  while (!element.nodes.empty() && element.nodes.back() == 0) element.nodes.pop_back();
}

}  // namespace twindeck::model_io::ansys
