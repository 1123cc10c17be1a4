#pragma once

#include <optional>
#include <string>
#include <vector>

namespace twindeck::diagnosis {

/// What a cause does to the model or to the measurement. A catalogue names them "scale.stiffness", "mass.add" …
enum class Primitive {
  scale_stiffness,     ///< of the place's own stiffness
  scale_mass,          ///< of the place's own mass
  field_stiffness,     ///< factor 1 + rate (v - reference), v = `variable`
  step_stiffness,      ///< factor where v < below
  slip_stiffness,      ///< factor where v > above
  soften_stiffness,    ///< factor 1/(1 + v/half): half is left at v = half
  support_move,        ///< to another place on its line of beams
  support_settle,      ///< of the ground under it, upwards, as load tests see it
  mass_add,            ///< point mass
  mass_per_count,      ///< mass per person instead of the assumed one
  person_oscillator,   ///< people as masses on springs
  element_spring,      ///< to the ground, or between two nodes
  element_oscillator,  ///< tuned mass
  element_string,      ///< first mode of a cable on the moving anchorage
  damper_friction,     ///< the damper's mount, held by friction below a force
  damper_damping,
  damper_series,  ///< a spring in series with the dashpot
  damper_absent,
  damper_move,          ///< to where the study says that it might stand
  frequency_amplitude,  ///< f (1 + curvature A²)
  damping_add,          ///< of critical
  stay_pull,            ///< of its tension: its frequency goes with the root
  stay_frequency,       ///< of a stay's own frequencies
  channel_gain,
  channel_sign,
  channel_swap,
  channel_rotate,     ///< degrees, towards the horizontal direction beside it
  channel_delay,      ///< seconds
  channel_floor,      ///< of the noise floor
  channel_limit,      ///< RMS of records above `above`
  modes_exchange,     ///< shapes of a mode and the next one under wrong names
  wind_speed_power,   ///< RMS ~ V^(2 + exponent)
  wind_skew_power,    ///< RMS ~ |cos beta|^exponent beyond the base's 1
  wind_drag,          ///< horizontal against vertical motion
  wind_lift,          ///< vertical against horizontal motion
  wind_length_scale,  ///< spectrum of turbulence
  wind_intensity,     ///< of turbulence at winds above the middle one
  wind_coherence,     ///< decay of coherence
  wind_resonance,     ///< extra response of a mode about a wind speed
  wind_damping,       ///< damping ratio per m/s
  wind_sheltered,     ///< places on the lee side of others
};

/// What primitives act on. Varying: on a stiffness by a number of the condition.
enum class ActsOn { part, varying, support, mass, people, element, damper, mode, stay, channel, wind };

/// What is known of a primitive wherever it is used.
struct PrimitiveKind {
  Primitive primitive;
  std::string name;
  ActsOn acts_on;
  std::vector<std::string> numbers;  ///< that it takes
};

/// All primitives, in the order of the enumeration.
[[nodiscard]] const std::vector<PrimitiveKind>& primitives();
[[nodiscard]] inline const PrimitiveKind& kind_of(Primitive p) { return primitives()[static_cast<std::size_t>(p)]; }
[[nodiscard]] inline ActsOn acts_on(Primitive p) { return kind_of(p).acts_on; }
/// The primitive of a name; none if there is none.
[[nodiscard]] std::optional<Primitive> primitive_named(const std::string& name);

/// Whether it changes stiffness or mass in every condition alike.
[[nodiscard]] bool changes_structure(Primitive p);
/// Whether it puts something up that was not there: a mass, a spring, an oscillator, a string.
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
