#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "fe/model.hpp"

/// The parametric generator of the Ponte del Mare: the only place that knows that there are two decks.
namespace twindeck::ponte {

/// A change between variants of bridge.toml, one that can be switched on alone.
struct Change {
  std::string name;        ///< "light_concrete"
  std::string paper_item;  ///< "4.1 (1)" or "" when section 4.1 does not name it (a fitted difference)
  std::string meaning;     ///< a sentence
};

/// The as-built changes that lead from `preliminary` to `refined`, in the order in which they are applied.
[[nodiscard]] std::vector<Change> as_built_changes(const std::filesystem::path& bridge_toml);
/// A variant of the bridge: preliminary, refined, refined_table8, fitted_to_measured.
/// @param mesh  a [[mesh_option]] of the file: full, medium, coarse; "": the file's own
/// @throws InputError for an unknown variant or mesh, or a bad value, naming file, line and key
[[nodiscard]] fe::Model generate(const std::filesystem::path& bridge_toml, const std::string& variant,
                                 const std::string& mesh = "");
/// The preliminary variant with the named changes switched on.
[[nodiscard]] fe::Model generate_with_changes(const std::filesystem::path& bridge_toml, const std::vector<std::string>& changes,
                                              const std::string& mesh = "");
/// Values [SI] by path of bridge.toml; "change.NAME.KEY" is what an as-built change sets.
using Values = std::map<std::string, double>;
/// A variant with some values replaced, the file left as it is.
/// @throws InputError for a path that is not there
[[nodiscard]] fe::Model generate_with_values(const std::filesystem::path& bridge_toml, const std::string& variant,
                                             const std::string& mesh, const Values& values);
/// Writes values into the file, each in its own line, with its unit, the rest of the line kept.
/// @param unit  of each path ("m", "N/m"; "-": none)
void write_values(const std::filesystem::path& bridge_toml, const Values& values,
                  const std::map<std::string, std::string>& unit);
/// The part of the bridge that a group of elements or springs belongs to: decks, mast, stays, end_blocks, piers, ramps,
/// bearings.
[[nodiscard]] std::string part_of(const std::string& group);

}  // namespace twindeck::ponte
