#pragma once

#include "identification/identification_settings.hpp"
#include "io/config.hpp"

namespace twindeck::steps {

/// Configuration of s3_identification.
struct IdentificationConfig : identification::IdentificationSettings {
  /// As a user has it who configures nothing: sampling and blocks are chosen from the records.
  IdentificationConfig() {
    decimation = block_rows = decay_decimation = decay_block_rows = stay_decimation = stay_block_rows = 0;
    decay_length_s = 0.0;
  }
  std::string keep;               ///< file of choices by hand
  double imported_std_pct = 0.0;  ///< [%] of frequencies of `--modes FILE`; 0: unknown
  [[nodiscard]] io::FieldTable fields();
};

}  // namespace twindeck::steps
