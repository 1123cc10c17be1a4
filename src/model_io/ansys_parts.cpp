#include "model_io/ansys_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "model_io/inp_cards.hpp"

namespace twindeck::model_io::ansys {
namespace {

constexpr double largest_whole = 1e15;  ///< beyond, a double skips whole numbers

bool is_whole(double value) { return value == std::floor(value) && std::abs(value) <= largest_whole; }

}  // namespace

void Parts::fail(const Command& command, const std::string& problem, const std::string& mend) const {
  fail(command.line, command.name, problem, mend);
}

void Parts::fail(long line, const std::string& part, const std::string& problem, const std::string& mend) const {
  throw InputError({deck.path().string(), line, part}, problem, mend);
}

double Parts::number_or(const Command& command, std::size_t i, double fallback) const {
  if (command.blank(i)) return fallback;
  const auto value = evaluate(command.fields[i], parameters);
  if (!value) {
    fail(command, fmt::format("'{}' (field {}) is no number", command.fields[i], i + 1),
         "write the number: of parameters only those set to plain arithmetic are known, no functions, arrays or *GET");
  }
  return *value;
}

double Parts::number(const Command& command, std::size_t i) const {
  if (command.blank(i)) fail(command, fmt::format("field {} is missing, expected a number", i + 1), "complete the command");
  return number_or(command, i, 0.0);
}

long Parts::integer_or(const Command& command, std::size_t i, long fallback) const {
  if (command.blank(i)) return fallback;
  const double value = number(command, i);
  if (!is_whole(value))
    fail(command, fmt::format("'{}' (field {}) is no whole number", command.fields[i], i + 1), "check the command");
  return static_cast<long>(value);
}

long Parts::integer(const Command& command, std::size_t i) const {
  if (command.blank(i))
    fail(command, fmt::format("field {} is missing, expected a whole number", i + 1), "complete the command");
  return integer_or(command, i, 0);
}

long Parts::cell(const Command& block, const std::vector<std::string>& cells, std::size_t i) const {
  if (i >= cells.size() || cells[i].empty()) return 0;
  const auto value = evaluate(cells[i], {});
  if (!value || !is_whole(*value)) {
    fail(deck.line(), block.name, fmt::format("'{}' (column {}) is no whole number", cells[i], i + 1),
         "compare the line with the format below " + block.name);
  }
  return static_cast<long>(*value);
}

const Component* Parts::component(const std::string& name) const {
  const auto found = std::find_if(components.begin(), components.end(),
                                  [&](const Component& c) { return upper_case(c.name) == upper_case(name); });
  return found == components.end() ? nullptr : &*found;
}

std::set<long> Parts::nodes_of(const Command& command, std::size_t field, std::size_t end_field) const {
  std::set<long> chosen;
  const auto is_selected = [&](long id) { return selected_nodes.all || selected_nodes.ids.contains(id); };
  if (command.word(field) == "ALL") {
    for (const auto& [id, node] : nodes) {
      if (is_selected(id)) chosen.insert(id);
    }
    return chosen;
  }
  if (!command.blank(field)) {
    if (const Component* named = component(command.fields[field]); named != nullptr && named->of_nodes) return named->members;
  }
  const long first = integer(command, field), last = std::max(first, integer_or(command, end_field, first));
  const long step = integer_or(command, end_field + 1, 1);
  if (step < 1) fail(command, fmt::format("step {} is no step from node to node", step), "give 1 or more");
  if (first == last && !nodes.contains(first))
    fail(command, fmt::format("node {} is not defined", first), "define it before, or correct the number");
  for (auto it = nodes.lower_bound(first); it != nodes.end() && it->first <= last; ++it) {
    if ((it->first - first) % step == 0 && is_selected(it->first)) chosen.insert(it->first);
  }
  return chosen;
}

}  // namespace twindeck::model_io::ansys
