#pragma once

#include <filesystem>
#include <limits>
#include <string>

#include "fe/model.hpp"
#include "io/config.hpp"

/// Inside of the library: the keys of [[parameter]] that models of elements and of matrices share.
namespace twindeck::model_io {

struct ParameterEntry {
  std::string name, unit;
  double initial = 0.0, lower = 0.0, upper = 0.0;
  double nominal = std::numeric_limits<double>::quiet_NaN();  ///< NaN where the key is absent

  /// Adds the keys to a table.
  void add_to(io::FieldTable& table);

  /// Name, unit and values, the rest by default. A nominal value that the bounds exclude is left out: who set them knows
  /// better.
  /// @throws InputError unless the initial value lies between the bounds
  [[nodiscard]] fe::Parameter parameter(const std::filesystem::path& file) const;
};

/// Lines of the keys, from `unit` on. @param number  how a number is written
[[nodiscard]] std::string parameter_lines(const fe::Parameter& parameter, std::string (*number)(double));

/// What is wrong with a parameter, at the line that names it.
[[nodiscard]] InputError parameter_error(const std::filesystem::path& file, const std::string& name, const std::string& problem,
                                         const std::string& mend);

}  // namespace twindeck::model_io
