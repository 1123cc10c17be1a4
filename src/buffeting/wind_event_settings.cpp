#include "buffeting/wind_event_settings.hpp"

namespace twindeck::buffeting {

aero::Equations WindEventSettings::equation_choice() const {
  return equations == "as_printed" ? aero::Equations::as_printed : aero::Equations::consistent;
}

}  // namespace twindeck::buffeting
