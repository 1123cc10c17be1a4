#include "steps/campaign/wind_inputs.hpp"

#include "aero_io/turbulence_sets.hpp"
#include "steps/wind/aerodynamics_config.hpp"
#include "steps/wind/deck_files.hpp"

namespace twindeck::steps {

virtual_bridge::VirtualWind read_virtual_wind(runner::StepContext& context, const virtual_bridge::CampaignSettings& settings) {
  virtual_bridge::VirtualWind out;
  AerodynamicsConfig config;
  io::FieldTable fields = config.fields();
  fields.load(context.input(settings.wind_aerodynamics));
  fields.require();
  out.aerodynamics = config;
  out.data = read_deck_aerodynamics(out.aerodynamics, context);
  out.turbulence = aero_io::read_turbulence_set(context.input(settings.wind_turbulence_file), settings.wind_turbulence_set);
  return out;
}

}  // namespace twindeck::steps
