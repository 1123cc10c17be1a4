#pragma once

#include <map>
#include <optional>
#include <string>

namespace twindeck::model_io {

/// Scalar parameters of a deck, by name in upper case.
using Parameters = std::map<std::string, double>;

/// Value of a field: a number (1.5, 4E9, 1.E-002, 2D3), a parameter, or arithmetic of both with + - * / ** and brackets, in the
/// usual precedence. None for everything else: text, functions, arrays, unknown parameters, values that are not finite.
[[nodiscard]] std::optional<double> evaluate(const std::string& text, const Parameters& parameters);

}  // namespace twindeck::model_io
