#pragma once

#include "io/config.hpp"
#include "updating/updating_settings.hpp"

namespace twindeck::steps {

/// Configuration of s6_updating.
struct UpdatingConfig : updating::UpdatingSettings {
  [[nodiscard]] io::FieldTable fields();
};

}  // namespace twindeck::steps
