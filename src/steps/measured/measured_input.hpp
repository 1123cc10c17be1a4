#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/eigenmodes.hpp"
#include "dynamics/unit_slips.hpp"
#include "io/config.hpp"
#include "matching/measured.hpp"
#include "matching/pairing_account.hpp"
#include "records/corrections.hpp"
#include "records/feature_rows.hpp"
#include "records/measured_features.hpp"
#include "runner/run_step.hpp"

/// The measured data of a step: the options that choose them, and the files that hold them.
namespace twindeck::steps {

/// `--condition NAME`, `--state NAME` and `--correct FILE`: the options of every step that reads measured modes or features.
[[nodiscard]] std::vector<runner::Flag> measured_flags();

/// Reads these options.
/// @param condition  of the step's configuration: used if neither --condition nor --state is given
/// @throws InputError  an empty name, a missing file; see read_corrections
[[nodiscard]] records::MeasuredChoice asked_choice(runner::StepContext& context, const std::string& condition = "");

/// The keys of a pairing by MAC, for a step that pairs measured modes with those of a model.
void add_pairing_keys(io::FieldTable& table, matching::PairingSettings& settings);

/// Reads modes.csv, and shapes.csv and channels.csv if they exist, from a folder (`--modes DIR`).
/// @throws InputError  as above
[[nodiscard]] matching::Measured read_measured_modes(const std::filesystem::path& folder,
                                                     const records::MeasuredChoice& choice);

/// The measured modes that a step works with: `--modes DIR`, else `--features DIR`, else the study's features, registered as
/// inputs. Empty if none of the three exists.
/// @param condition  of the step's configuration; --condition takes precedence
[[nodiscard]] std::optional<matching::Measured> find_measured(runner::StepContext& context, const std::string& condition);

inline constexpr double unseen =
    1e-9;  ///< [-] of a shape's largest value: a mode without motion at the sensors is rounding there

/// [-] (n_N × n_X) MAC of computed and measured shapes at the sensors, for the checks of units; NaN of a mode that was measured
/// at fewer than three channels, where any two shapes may agree.
/// @param phi_n (n_sensors × n_N), phi_x (n_sensors × n_X) with NaN where a mode was not measured
[[nodiscard]] Eigen::MatrixXd mac_for_units(const Eigen::MatrixXcd& phi_n, const Eigen::MatrixXcd& phi_x);

/// Input of warn_of_unit_slips for a step that compares with one condition: by shape or by the pairs of the configuration,
/// where there are such.
/// @throws InputError  as pair_as_published and shapes_at_sensors
[[nodiscard]] std::vector<dynamics::MeasuredFrequencies> frequencies_of(const std::optional<matching::Measured>& measured,
                                                                        const matching::PairingSettings& settings,
                                                                        const dynamics::LoadedModel& loaded,
                                                                        const dynamics::EigenModes& modes);

}  // namespace twindeck::steps
