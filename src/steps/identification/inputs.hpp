#pragma once

#include <optional>
#include <vector>

#include "identification/condition.hpp"
#include "identification/identification_settings.hpp"
#include "io/config.hpp"
#include "runner/run_step.hpp"

namespace twindeck::steps {

/// What the step reads: the lists of a campaign, and its records made ready for identification.
struct IdentificationInputs {
  records::Campaign campaign;
  std::vector<identification::ConditionResult>
      conditions;  ///< not yet identified; of ambient records or of the other kind that the configuration asks for; empty if
                   ///< only decays or stays are there
  std::vector<identification::Conditioned> decays, stays;
  bool decays_are_main = false;  ///< true: the free decays give the modes
};

/// Reads the file of the key `keep`. @return  empty for no file
/// @throws InputError  for an action that is neither keep nor delete, or a number out of range
[[nodiscard]] std::vector<identification::ModeChoice> read_mode_choices(const std::string& file, runner::StepContext& context);

/// Reads a campaign: `--campaign`, else data/<study>/campaign, else what s0_campaign wrote.
/// @throws InputError  as read_campaign, record_groups, read_condition and condition_records
[[nodiscard]] IdentificationInputs read_identification_inputs(const identification::IdentificationSettings& config,
                                                              runner::StepContext& context);

/// Reads the modes of `--modes FILE`, a universal file of the program that identified them (universal_modes.hpp).
/// @param std_pct  [%] standard deviation of each frequency, which the file does not hold; 0: stays empty
/// @return writes modes.csv, shapes.csv and channels.csv, which every step takes by `--modes`; nothing without the option
/// @throws InputError  for a folder, and as read_universal_modes
[[nodiscard]] std::optional<runner::Computation> imported_modes(double std_pct, runner::StepContext& context);

/// Configuration of s3_identification.
struct IdentificationConfig : identification::IdentificationSettings {
  /// Defaults for users: sampling and blocks are chosen from the records.
  IdentificationConfig() {
    decimation = block_rows = decay_decimation = decay_block_rows = stay_decimation = stay_block_rows = 0;
    decay_length_s = 0.0;
  }
  std::string keep;               ///< file of choices by hand
  double imported_std_pct = 0.0;  ///< [%] of frequencies of `--modes FILE`; 0: unknown
  [[nodiscard]] io::FieldTable fields();
};

}  // namespace twindeck::steps
