#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "io/config.hpp"
#include "io/toml_value.hpp"

/// Private to src/io: what a FieldTable keeps of each key. Not for other libraries.
namespace twindeck::io {

struct FieldTable::Field {
  std::string key;
  std::string type;     ///< for people: "number", "whole number", "text" …
  std::string unit;     ///< "" for a plain number or a key that is not a number
  std::string allowed;  ///< for people: "> 0", "one of a, b", "" if every value is allowed
  std::string meaning;
  std::string default_value;  ///< as TOML, taken when the key is bound
  bool required = false;
  bool given = false;
  Place place;                                               ///< where it was given last
  bool takes_text = false;                                   ///< a bare word of --set is the value itself
  std::function<void(const TomlValue&, const Place&)> read;  ///< checks and stores
  std::function<std::string()> write;                        ///< the present value as TOML
  std::function<FieldTable()> add;                           ///< of an array of tables only
  std::string named_by;  ///< of an array of tables: key whose value must differ between elements, or ""
  std::vector<std::vector<std::string>> elements;  ///< of an array of tables: each element's lines as printed
};

/// Refuses an unknown key. The message names the nearest known key, or else all known keys.
/// @param above  the text before the key in an array of tables ("damper[2].")
[[noreturn]] void refuse_unknown_key(const std::string& file, long line, const std::string& above, const std::string& key,
                                     const std::vector<std::string>& known);

}  // namespace twindeck::io
