#pragma once

#include <algorithm>
#include <functional>
#include <type_traits>
#include <vector>

namespace twindeck {

/// Whether a list holds a value.
template <class List, class Value>
[[nodiscard]] bool contains(const List& list, const Value& value) {
  return std::ranges::find(list, value) != std::ranges::end(list);
}

/// What `of` gives for each part, in their order: `each_of(channels, &Channel::name)` are the names of channels.
template <class Parts, class Of>
[[nodiscard]] auto each_of(const Parts& parts, const Of& of) {
  std::vector<std::decay_t<std::invoke_result_t<const Of&, decltype(*std::ranges::begin(parts))>>> all;
  for (const auto& part : parts) all.push_back(std::invoke(of, part));
  return all;
}

}  // namespace twindeck
