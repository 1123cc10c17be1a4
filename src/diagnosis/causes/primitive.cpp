#include "diagnosis/causes/primitive.hpp"

#include <algorithm>

namespace twindeck::diagnosis {

const std::vector<PrimitiveKind>& primitives() {
  using enum Primitive;
  static const std::vector<PrimitiveKind> all = {
      {scale_stiffness, "scale.stiffness", ActsOn::part, {"factor"}},
      {scale_mass, "scale.mass", ActsOn::part, {"factor"}},
      {field_stiffness, "field.stiffness", ActsOn::varying, {"rate", "reference"}},
      {step_stiffness, "step.stiffness", ActsOn::varying, {"factor", "below"}},
      {slip_stiffness, "slip.stiffness", ActsOn::varying, {"factor", "above"}},
      {soften_stiffness, "soften.stiffness", ActsOn::varying, {"half"}},
      {support_move, "support.move", ActsOn::support, {"position"}},
      {support_settle, "support.settle", ActsOn::support, {"rise"}},
      {mass_add, "mass.add", ActsOn::mass, {"mass"}},
      {mass_per_count, "mass.per_count", ActsOn::people, {"mass", "assumed"}},
      {person_oscillator, "person.oscillator", ActsOn::people, {"mass", "frequency", "damping"}},
      {element_spring, "element.spring", ActsOn::element, {"stiffness"}},
      {element_oscillator, "element.oscillator", ActsOn::element, {"mass", "frequency"}},
      {element_string, "element.string", ActsOn::element, {"mass", "frequency"}},
      {damper_friction, "damper.friction", ActsOn::damper, {"stiffness", "threshold"}},
      {damper_damping, "damper.damping", ActsOn::damper, {"factor"}},
      {damper_series, "damper.series", ActsOn::damper, {"stiffness"}},
      {damper_absent, "damper.absent", ActsOn::damper, {}},
      {damper_move, "damper.move", ActsOn::damper, {}},
      {frequency_amplitude, "frequency.amplitude", ActsOn::mode, {"curvature"}},
      {damping_add, "damping.add", ActsOn::mode, {"ratio"}},
      {stay_pull, "stay.pull", ActsOn::stay, {"factor"}},
      {stay_frequency, "stay.frequency", ActsOn::stay, {"factor"}},
      {channel_gain, "channel.gain", ActsOn::channel, {"factor"}},
      {channel_sign, "channel.sign", ActsOn::channel, {}},
      {channel_swap, "channel.swap", ActsOn::channel, {}},
      {channel_rotate, "channel.rotate", ActsOn::channel, {"angle"}},
      {channel_delay, "channel.delay", ActsOn::channel, {"delay"}},
      {channel_floor, "channel.floor", ActsOn::channel, {"factor"}},
      {channel_limit, "channel.limit", ActsOn::channel, {"factor"}},
      {modes_exchange, "modes.exchange", ActsOn::mode, {}},
      {wind_speed_power, "wind.speed_power", ActsOn::wind, {"exponent"}},
      {wind_skew_power, "wind.skew_power", ActsOn::wind, {"exponent"}},
      {wind_drag, "wind.drag", ActsOn::wind, {"factor"}},
      {wind_lift, "wind.lift", ActsOn::wind, {"factor"}},
      {wind_length_scale, "wind.length_scale", ActsOn::wind, {"factor"}},
      {wind_intensity, "wind.intensity", ActsOn::wind, {"factor"}},
      {wind_coherence, "wind.coherence", ActsOn::wind, {"factor"}},
      {wind_resonance, "wind.resonance", ActsOn::wind, {"speed", "ratio"}},
      {wind_damping, "wind.damping", ActsOn::wind, {"rate"}},
      {wind_sheltered, "wind.sheltered", ActsOn::wind, {"factor"}},
  };
  return all;
}

std::optional<Primitive> primitive_named(const std::string& name) {
  const auto found = std::ranges::find(primitives(), name, &PrimitiveKind::name);
  return found == primitives().end() ? std::nullopt : std::optional(found->primitive);
}

bool changes_structure(Primitive p) { return acts_on(p) == ActsOn::part || adds(p) || p == Primitive::support_move; }

}  // namespace twindeck::diagnosis
