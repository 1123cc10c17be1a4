#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/config.hpp"

/// Parts of configurations that several steps have.
namespace twindeck::steps {

/// The rows of a configured list, for FieldTable::tables. @param bind  adds the fields of a new row: bind(table, row)
template <typename Row, typename Bind>
[[nodiscard]] std::function<io::FieldTable()> rows_of(std::vector<Row>& rows, Bind bind) {
  return [&rows, bind] {
    io::FieldTable table;
    bind(table, rows.emplace_back());
    return table;
  };
}

/// Checks that `minimum_order` is not above `maximum_order`.
/// @param above  prefix of the two keys ("blind."), or ""
[[nodiscard]] inline std::optional<io::FieldTable::Broken> orders_exchanged(const std::string& above, long minimum,
                                                                            long maximum) {
  if (minimum <= maximum) return std::nullopt;
  const std::string smallest = above + "minimum_order";
  return io::FieldTable::Broken{
      above + "maximum_order",
      "is " + std::to_string(maximum) + ", expected at least " + smallest + ", which is " + std::to_string(minimum),
      "raise it, or lower " + smallest};
}

}  // namespace twindeck::steps
