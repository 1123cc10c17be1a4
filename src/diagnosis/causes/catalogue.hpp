#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "diagnosis/causes/primitive.hpp"

/// The catalogue of causes as data: content of the TOML files in workflows/common/hypotheses, independent of a model.
namespace twindeck::diagnosis {

/// `factor · name`: a number, a parameter ("$Fc"), an attribute of the place ("k_drive"), or a number times one
/// ("0.05*k_drive").
struct Expression {
  double factor = 1.0;
  std::string name;  ///< "" for a plain number; "$Fc" for a parameter
  long line = 0;
};

/// An unknown of a cause.
struct UnknownSpec {
  std::string name, unit;
  Expression low, high;
  bool log = true;                ///< prior uniform in ln, otherwise uniform
  std::vector<Expression> start;  ///< trial magnitudes of the screen
};

/// An action of a cause on the model or on the measurement.
struct ActionSpec {
  Primitive primitive = Primitive::scale_stiffness;
  std::map<std::string, std::string> text;
  std::map<std::string, Expression> number;
  long line = 0;
};

struct Needs {
  std::map<std::string, std::string> conditions;  ///< dampers = "on"; temperature_C = "known" …
  std::map<std::string, int> distinct;            ///< number of different values of a condition's key
  std::vector<std::string> rows;                  ///< row types; at least one row of them must exist
};

struct Hypothesis {
  std::string id, title;
  bool measurement = false;  ///< side
  double prior_weight = 1.0;
  std::string set;     ///< location set
  std::string filter;  ///< for pairs of channels: same_direction
  std::vector<UnknownSpec> unknowns;
  std::vector<ActionSpec> actions;
  Needs needs;
  std::string sentence, remedy;
  std::string file;

  /// Whether one of its actions does this.
  [[nodiscard]] bool does(Primitive p) const {
    return std::ranges::any_of(actions, [p](const ActionSpec& action) { return action.primitive == p; });
  }
};

/// Keys of a condition that a cause's needs may name. `conditions` may ask for: "known" for any value, "on" or "off" for
/// dampers, "above_zero" for a number.
[[nodiscard]] const std::vector<std::string>& condition_keys();
[[nodiscard]] const std::vector<std::string>& condition_demands();
/// Numbers of a location that a cause may name. is_place_number also accepts names that only the model has (x_low, node_0).
[[nodiscard]] const std::vector<std::string>& place_numbers();
[[nodiscard]] bool is_place_number(const std::string& name);
/// elements, nodes, stays, dampers, supports, support_moves, foundations, groups, all_stays, channels, modes, global,
/// pairs(channels), pairs(nodes).
[[nodiscard]] const std::vector<std::string>& location_sets();

}  // namespace twindeck::diagnosis
