#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"

/// Names of modes and pairs as configurations and tables write them: measured modes "7X", computed modes "8N", pairs "7X-8N".
namespace twindeck::matching {

/// Whether a text may name a measured mode. Any text may, but a number must be a whole number from 1 ("3", "3X", "heave"; not
/// "1.5", "-1", "0"). Otherwise a typing error in a number would create a further mode.
[[nodiscard]] bool is_mode_name(const std::string& text);
/// "7X" of the measured mode "7" or "7X".
[[nodiscard]] std::string experimental_label(const std::string& mode);
/// "8N" of the computed mode at position 7: computed modes are named by their position in the model, from 1.
[[nodiscard]] std::string numerical_label(Eigen::Index position);
/// The position that such a label names, 7 of "8N"; nothing for any other text ("08N").
[[nodiscard]] std::optional<Eigen::Index> numerical_position(const std::string& label);

/// One entry of a list of pairs.
struct NamedPair {
  std::string experimental;    ///< "7X", as written in the list
  Eigen::Index numerical = 0;  ///< position, from 0
};

/// Reads a list such as {"1X-1N", "7X-8N"}. All steps use this reader.
/// @param n_numerical  how many computed modes there are
/// @param place        position of the list, for messages
/// @param more_modes   ends the message about a computed mode beyond `n_numerical` ("raise n_modes")
/// @throws InputError  for an entry of another form, a mode named twice, or a computed mode beyond `n_numerical`
[[nodiscard]] std::vector<NamedPair> read_pairs(const std::vector<std::string>& entries, Eigen::Index n_numerical,
                                                const Place& place, const std::string& more_modes);

}  // namespace twindeck::matching
