#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/lists.hpp"

/// What the virtual bridge is and what its test campaign imposes.
namespace twindeck::ponte {

struct NamedMode {
  std::string name;            ///< "1", as in Table 4
  double frequency_Hz = 0.0;   ///< undamped; the corrections are fitted to it
  double damping_ratio = 0.0;  ///< imposed without dampers
  long deck_mode =
      0;  ///< what calibration starts from: position among the uncorrected bridge's modes that are not mostly stays, from 1
};

struct TemperatureEffect {
  std::string parameter;
  double per_K = 0.0;  ///< relative change
};

/// What the definition of the bridge does not say about a type of damper.
struct DamperSettings {
  std::string type;                ///< "A": its units are those of the group damper_A
  double mount_stiffness_N_m = 0;  ///< 0: the spring that Table 1 prints
  double mount_loss_factor = 0;    ///< at 1 Hz
  double friction_N = 0;
};

struct ConditionSettings {
  std::string name;
  bool dampers = false;
  double temperature_C = 0.0, wind_m_s = 0.0;
  long people = 0;
  double force_deck = 0.0, force_stay = 0.0, force_mast = 0.0;  ///< [N/sqrt(Hz)] white force on each loaded node and direction
};

struct RecordSettings {
  std::string setup, kind = "ambient", condition;
  double duration_s = 0.0;
  double mass_kg = 0.0;        ///< free_decay: the mass that is let go
  std::string point;           ///< free_decay: where it hung
  double speed_m_s = 0.0;      ///< wind: mean speed at the decks
  double direction_deg = 0.0;  ///< wind: where it blows to, anticlockwise from +X
};

struct StayTest {
  std::string stay, condition;
  double pull_N = 0.0, lambda_squared = 0.0, damping_ratio = 0.0;
  std::vector<double> imposed_Hz;  ///< frequencies that are not those of a string alone (sleeves)
};

struct CampaignSettings {
  std::string bridge, corrections, points, setups;
  std::vector<std::string> vibrating_stays;
  long zones = 5, stay_pieces = 8, modes = 120;
  double unevenness = 0.0, unevenness_wavelength_m = 30.0, reference_temperature_C = 18.0;
  double other_damping = 0.013, stay_damping = 0.004, correction_damping = 0.02;
  std::vector<NamedMode> named;
  std::vector<TemperatureEffect> temperature;
  std::vector<DamperSettings> dampers;
  std::vector<ConditionSettings> conditions;
  std::vector<RecordSettings> records;
  double rate_Hz = 100.0;
  long substeps = 2, second_logger_lag = 1;
  double noise = 0.0, converter_step = 0.0, range = 0.0, drift = 0.0;
  std::vector<StayTest> stays;
  double stay_duration_s = 600.0, stay_force = 1.0, stay_sensor = 0.13;
  std::string wind_aerodynamics, wind_turbulence_file = "data/wind/turbulence_sets.csv", wind_turbulence_set = "EN 0",
                                 wind_model = "C";
  double wind_height_m = 14.5, wind_level = 1.0;
  double correction_spread = 0.15, frequency_weight = 2e-4;

  /// @throws InputError  for a name that no condition has
  [[nodiscard]] const ConditionSettings& condition(const std::string& name) const {
    if (const auto at = std::ranges::find(conditions, name, &ConditionSettings::name); at != conditions.end()) return *at;
    throw InputError({"", 0, "condition"},
                     "'" + name + "' is not there" + did_you_mean(name, each_of(conditions, &ConditionSettings::name)),
                     "add a table [[condition]] of this name");
  }
};

}  // namespace twindeck::ponte
