#pragma once

#include "identification/identification_settings.hpp"
#include "io/config.hpp"

namespace twindeck::steps {

/// Configuration of s3_identification.
struct IdentificationConfig : identification::IdentificationSettings {
  [[nodiscard]] io::FieldTable fields();
};

}  // namespace twindeck::steps
