#pragma once

#include <optional>
#include <string>
#include <vector>

namespace twindeck::diagnosis {

/// What a cause does to the model or to the measurement. A catalogue names them "scale.stiffness", "mass.add" …
enum class Primitive {
  scale_stiffness,      ///< factor on the stiffness of the place
  scale_mass,           ///< factor on the mass of the place
  field_stiffness,      ///< factor 1 + rate (v - reference) on its stiffness, v = `variable`
  step_stiffness,       ///< factor on its stiffness if v < below
  slip_stiffness,       ///< factor on its stiffness if v > above
  soften_stiffness,     ///< factor 1/(1 + v/half) on its stiffness
  support_move,         ///< the support stands elsewhere on its line of beams
  support_settle,       ///< the ground under the support rises; load tests show it
  mass_add,             ///< point mass
  mass_per_count,       ///< mass per person instead of the assumed one
  person_oscillator,    ///< people as masses on springs
  element_spring,       ///< spring to the ground, or between two nodes
  element_oscillator,   ///< tuned mass
  element_string,       ///< first mode of a cable whose lower end moves
  damper_friction,      ///< friction holds the damper's mount below a force
  damper_damping,       ///< factor on the damping constant
  damper_series,        ///< spring in series with the dashpot
  damper_absent,        ///< the damper does not act
  damper_move,          ///< the damper stands where the study allows it
  frequency_amplitude,  ///< f (1 + curvature A²)
  damping_add,          ///< added damping ratio
  stay_pull,            ///< factor on the tension of a stay
  stay_frequency,       ///< factor on the frequencies of a stay
  channel_gain,         ///< factor on the channel
  channel_sign,         ///< the channel is reversed
  channel_swap,         ///< two channels are exchanged
  channel_rotate,       ///< the sensor is turned [degrees] towards the horizontal direction beside it
  channel_delay,        ///< the channel is late [s]
  channel_floor,        ///< factor on the noise floor
  channel_limit,        ///< factor on the RMS of records above `above`
  modes_exchange,       ///< shapes of a mode and the next one are exchanged
  wind_speed_power,     ///< RMS ~ V^(2 + exponent)
  wind_skew_power,      ///< RMS ~ |cos beta|^exponent beyond the base's 1
  wind_drag,            ///< factor on horizontal against vertical motion
  wind_lift,            ///< factor on vertical against horizontal motion
  wind_length_scale,    ///< factor on the length scale of turbulence
  wind_intensity,       ///< factor on the intensity of turbulence above the middle wind speed
  wind_coherence,       ///< factor on the decay of coherence
  wind_resonance,       ///< extra response of a mode about a wind speed
  wind_damping,         ///< damping ratio per m/s
  wind_sheltered,       ///< factor on places to the lee of others
};

/// What primitives act on. varying: a stiffness that depends on a number of the condition.
enum class ActsOn { part, varying, support, mass, people, element, damper, mode, stay, channel, wind };

/// Name and properties of a primitive.
struct PrimitiveKind {
  Primitive primitive;
  std::string name;
  ActsOn acts_on;
  std::vector<std::string> numbers;  ///< names of its numbers in a catalogue
};

/// All primitives, in the order of the enumeration.
[[nodiscard]] const std::vector<PrimitiveKind>& primitives();
[[nodiscard]] inline const PrimitiveKind& kind_of(Primitive p) { return primitives()[static_cast<std::size_t>(p)]; }
[[nodiscard]] inline ActsOn acts_on(Primitive p) { return kind_of(p).acts_on; }
/// The primitive of a name; none if there is none.
[[nodiscard]] std::optional<Primitive> primitive_named(const std::string& name);

/// Whether it changes stiffness or mass in every condition alike.
[[nodiscard]] bool changes_structure(Primitive p);
/// Whether it adds a mass, a spring, an oscillator or a string.
[[nodiscard]] inline bool adds(Primitive p) { return acts_on(p) == ActsOn::mass || acts_on(p) == ActsOn::element; }
/// Whether it multiplies a stiffness of its place.
[[nodiscard]] inline bool scales_stiffness(Primitive p) {
  return p == Primitive::scale_stiffness || acts_on(p) == ActsOn::varying;
}
/// Whether it brings degrees of freedom of its own.
[[nodiscard]] inline bool has_own_motion(Primitive p) {
  return p == Primitive::element_oscillator || p == Primitive::element_string;
}

}  // namespace twindeck::diagnosis
