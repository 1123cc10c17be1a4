#include "steps/identification/quality_table.hpp"

#include "io/csv.hpp"

namespace twindeck::steps {

void write_quality(const std::vector<identification::ChannelQuality>& rows, const std::filesystem::path& file) {
  io::CsvWriter csv({"setup", "record", "channel", "samples", "missing", "longest_gap", "clipped", "mean", "rms", "drift_rms",
                     "dead", "lag_s", "lag_std_s"});
  for (const identification::ChannelQuality& q : rows) {
    csv.row({q.setup, q.record, q.channel, q.samples, q.missing, q.longest_gap, q.clipped, q.mean, q.rms, q.drift,
             q.dead ? 1 : 0, q.lag_s, q.lag_std_s});
  }
  csv.save(file);
}

}  // namespace twindeck::steps
