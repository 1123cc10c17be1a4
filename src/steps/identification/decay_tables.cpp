#include "steps/identification/decay_tables.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "io/csv.hpp"

namespace twindeck::steps {

void write_decays(const std::vector<identification::DecayResult>& decays,
                  const std::vector<identification::ConditionResult>& results,
                  const identification::IdentificationSettings& config, const std::filesystem::path& folder) {
  io::CsvWriter modes({"condition", "setup", "mode", "frequency_Hz", "frequency_std_Hz", "damping_ratio_pct",
                       "damping_ratio_std_pct", "orders", "ambient_mode", "ambient_frequency_Hz", "ambient_frequency_std_Hz",
                       "mac"});
  io::CsvWriter levels({"source", "condition", "setup", "record", "mode", "amplitude", "quantity", "frequency_Hz",
                        "frequency_std_Hz", "damping_ratio_pct", "damping_ratio_std_pct", "seconds"});
  for (const identification::DecayResult& decay : decays) {
    const identification::ConditionResult* ambient = identification::condition_named(results, decay.conditioned.condition);
    for (std::size_t m = 0; m < decay.found.modes.size(); ++m) {
      const identification::Cluster& mode = decay.found.modes[m];
      const identification::ModeDeviation& deviation = decay.found.deviations[m];
      const auto partner = identification::partner_of(mode, decay.conditioned.channels, ambient);
      const auto known = [&](double value) { return partner ? std::optional(value) : std::nullopt; };
      const std::size_t at = partner ? partner->mode : 0;
      modes.row({decay.conditioned.condition, decay.conditioned.setup, std::to_string(m + 1), mode.frequency_Hz,
                 deviation.frequency_Hz, 100.0 * mode.damping_ratio, 100.0 * deviation.damping_ratio, mode.members.size(),
                 partner ? std::to_string(at + 1) : "", known(partner ? ambient->modes[at].frequency_Hz : 0.0),
                 known(partner ? ambient->modes[at].deviation.frequency_Hz : 0.0), known(partner ? partner->mac : 0.0)});
    }
    for (const identification::DecayResult::ByAmplitude& by : decay.by_amplitude) {
      const Eigen::VectorXcd& shape = decay.found.modes[by.found].shape;
      for (const identification::AmplitudePoint& point : by.points) {
        levels.row({"free_decay", decay.conditioned.condition, decay.conditioned.setup, by.record, by.mode, point.amplitude,
                    identification::quantity_at_largest(decay.conditioned.channels, shape), point.frequency_Hz,
                    point.frequency_std_Hz, 100.0 * point.damping_ratio, 100.0 * point.damping_ratio_std, point.seconds});
      }
    }
  }
  for (const identification::AmbientAmplitude& ambient : identification::ambient_amplitudes(results, config)) {
    const identification::MergedMode& mode = identification::condition_named(results, ambient.condition)->modes[ambient.mode];
    levels.row({"ambient", ambient.condition, ambient.setup, "", std::to_string(ambient.mode + 1), ambient.amplitude,
                ambient.quantity, mode.frequency_Hz, mode.deviation.frequency_Hz, 100.0 * mode.damping_ratio,
                100.0 * mode.deviation.damping_ratio, ambient.seconds});
  }
  modes.save(folder / "decays.csv");
  levels.save(folder / "amplitude.csv");
}

}  // namespace twindeck::steps
