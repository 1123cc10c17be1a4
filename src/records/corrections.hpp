#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "modal/modes.hpp"
#include "records/feature_rows.hpp"
#include "records/measured_tables.hpp"

/// Corrects known faults of single channels before a step uses the measurement (`--correct FILE`). Input is corrections.toml,
/// which s9_diagnosis writes and which can be written by hand. Output are the corrected rows.
namespace twindeck::records {

/// One correction of corrections.toml. Corrections act in the order of the file; each refers to the
/// channels after the corrections before it.
struct Correction {
  enum class Action {
    reverse,   ///< the channel's sign is turned
    exchange,  ///< the values of `channel` and `with` are exchanged
    scale      ///< the channel's values are multiplied by `factor`
  };
  std::string channel;
  Action action = Action::reverse;
  std::string with;        ///< of an exchange, else empty
  double factor = 1.0;     ///< [-] of a scale, else 1; above 0
  std::string state = {};  ///< of the structure, when its records had the fault; "" for all states
  Place place = {};        ///< in the file, for messages
};

/// "reverse", "exchange" or "scale".
[[nodiscard]] std::string name_of(Correction::Action action);
/// In words: "A5 reversed", "A5 and A6 exchanged", "A5 multiplied by 0.714 in state repaired".
[[nodiscard]] std::string words_of(const Correction& correction);

/// Reads corrections.toml: `[[correction]]` with `channel`, `action` and, of an exchange, `with`, of a scale, `factor`; with
/// `state`, it holds for the records of that state alone.
/// @throws InputError  naming file, line and key: no correction at all, an unknown key or action, a key that is missing or does
/// not belong to the action, a factor that is not above 0, a channel exchanged with itself, a correction that stands twice
[[nodiscard]] std::vector<Correction> read_corrections(const std::filesystem::path& file);

/// The correction of a list that the next one would cancel, if any.
[[nodiscard]] std::optional<std::size_t> undone_by(const std::vector<Correction>& list, const Correction& next);

/// The text of a corrections.toml that reads back to the same corrections.
[[nodiscard]] std::string corrections_toml(const std::vector<Correction>& corrections);

/// Correction of a channel in a state: the channel to which its values belong, and their factor.
struct CorrectedChannel {
  std::string name;
  double factor = 1.0;  ///< [-] negative if the channel is reversed
};
[[nodiscard]] CorrectedChannel corrected(const std::vector<Correction>& corrections, const std::string& channel,
                                         const std::string& state);

/// @param known  names of the channels  @param source  where they stand, for the message
/// @throws InputError  naming file and line, for a channel that is not among them
void refuse_unknown_channels(const std::vector<Correction>& corrections, const std::vector<std::string>& known,
                             const std::string& source);

/// Corrects measured rows with their deviations and covariance: signed rows (shapes, load tests) by sign and factor, RMS by the
/// factor's size, spectral floors by its square. Frequencies, damping and stays have no channel and stay unchanged.
/// @param conditions  of the rows @throws InputError  naming file and line, for a state that none of the conditions has
void correct(const std::vector<Correction>& corrections, const std::vector<MeasuredCondition>& conditions,
             FeatureRows& features);
/// Corrects where amplitudes were measured, and how large they were.
void correct(const std::vector<Correction>& corrections, std::vector<MeasuredCondition>& conditions);
/// Corrects shapes whose rows are named by channel (`direction` of shapes.csv).
/// @throws InputError  for an unknown channel name, one that is used at several points, or a correction of one state: such
/// shapes name no state
void correct(const std::vector<Correction>& corrections, modal::ModeSet& modes, const std::string& source);

}  // namespace twindeck::records
