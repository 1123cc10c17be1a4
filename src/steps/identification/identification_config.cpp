#include "steps/identification/identification_config.hpp"

#include <optional>

#include "io/limits.hpp"
#include "steps/shared/config_parts.hpp"

namespace twindeck::steps {

io::FieldTable IdentificationConfig::fields() {
  io::FieldTable table;
  table.text("setup", setup, "setup whose records are used; empty: all, merged over the reference channels")
      .texts("setups", setups, "setups that are merged; empty: all, or the one named by `setup`")
      .text("condition", condition, "condition whose records are used; empty: all, the first one's modes in modes.csv")
      .text("kind", kind,
            "kind of record: ambient, wind, earthquake or another whose excitation is broad; free_decay: by ERA; stay: stays "
            "alone")
      .choice("method", method, {"covariance", "data"},
              "subspace identification from correlations or from the data (inputs, where measured, are used)")
      .choice("selection", selection, {"automatic", "paper"}, "modes by the automatic rule, or by paper Eqs. (3)-(4)")
      .choice("merge", merge, {"poser", "preger"}, "setups merged after or before identification")
      .texts("references", references, "reference channels; empty: those marked in channels.csv, or all")
      .texts("exclude", exclude, "channels that are left out")
      .text("keep", keep,
            "CSV file of poles that a person kept or deleted (setup,order,frequency_Hz,damping_ratio_pct,action), as the "
            "report's "
            "stabilisation diagram writes it; empty: none")
      .number("imported_std_pct", imported_std_pct, "", {0.0, 50.0},
              "standard deviation in per cent that frequencies of a universal file (--modes FILE) are given; 0: none")
      .integer("longest_gap", longest_gap, io::non_negative(),
               "samples missing in a row that may be bridged by a straight line")
      .number("largest_clipping", largest_clipping, "", {0.0, 1.0},
              "share of a channel's samples that may stand at its largest or smallest value, three or more in a row or far "
              "more than at the next values")
      .number("largest_lone", largest_lone, "", {10.0, 1e300},
              "robust standard deviations from the median that a sample may stand off alone, between quiet neighbours")
      .integer("decimation", decimation, {0.0, 1000.0},
               "every so many-th sample is kept, after a zero-phase low-pass; 0: chosen from the highest peak of the spectrum")
      .number("band.lowest", lowest_Hz, "Hz", io::non_negative(), "poles below are left out")
      .number("band.highest", highest_Hz, "Hz", io::non_negative(),
              "poles above are left out; 0: up to where the sensors move together, at most 0.8 of the Nyquist frequency, or "
              "all of it where a record as it is has a peak above")
      .integer("block_rows", block_rows, {0.0, 500.0},
               "block rows of the Toeplitz or Hankel matrix; twice as many lags are used; 0: three periods of the lowest peak")
      .integer("minimum_order", minimum_order, {2.0, 500.0}, "smallest model order")
      .integer("maximum_order", maximum_order, {2.0, 500.0}, "largest model order")
      .integer("order_step", order_step, {1.0, 100.0}, "step of the order")
      .integer("blocks", blocks, {2.0, 1000.0}, "blocks a record is cut into for the standard deviations")
      .integer("welch_segment", welch_segment, {8.0, 1e7}, "samples of a Welch segment, after decimation")
      .number("stable.frequency", criteria.frequency, "", io::positive(), "paper 3.1: relative change of a stable frequency")
      .number("stable.damping", criteria.damping, "", io::positive(),
              "paper 3.1: change of a stable damping ratio (0.01 = 1 % of critical)")
      .number("stable.mac", criteria.mac, "", {0.0, 1.0}, "paper 3.1: MAC of a stable shape")
      .number("largest_damping", largest_damping, "", {0.0, 1.0, true}, "poles with a larger damping ratio are left out")
      .number("cleaning.mac", cleaning.mac, "", {0.0, 1.0}, "paper Eq. (3): MAC of shapes that count as the same")
      .number("cleaning.frequency", cleaning.frequency, "", io::positive(),
              "relative distance of frequencies that may count as the same")
      .number("cleaning.recursion", cleaning.recursion, "", io::non_negative(),
              "paper Eq. (4): index of recursion that a mode exceeds")
      .number("cleaning.share", cleaning.share, "", {0.0, 1.0},
              "share of the orders that a mode is found at, from its first; 0: paper's rule")
      .number("cleaning.deviation", largest_deviation, "", io::non_negative(),
              "largest relative standard deviation of a mode's frequency; automatic rule: or what the record's length allows; "
              "0: any (the paper's rule as printed)")
      .number("automatic.collinearity", automatic.collinearity, "", {0.0, 1.0},
              "automatic rule: smallest modal phase collinearity")
      .number("automatic.share", automatic.share, "", {0.0, 1.0},
              "automatic rule: share of the orders from a mode's first that it is found at")
      .number("automatic.law_ratio", largest_law_ratio, "", io::non_negative(),
              "automatic rule: largest standard deviation of a frequency in units of the least that the record's length "
              "allows; 0: any")
      .number("automatic.shape_deviation", largest_shape_deviation, "", io::non_negative(),
              "automatic rule: largest standard deviation of a mode shape of unit norm; 0: any")
      .integer("decay.decimation", decay_decimation, {0.0, 1000.0}, "free decays: as decimation; 0: the same, or chosen")
      .integer("decay.block_rows", decay_block_rows, {0.0, 1000.0},
               "free decays: block rows of the Hankel matrix; 0: half a period of the lowest peak")
      .integer("decay.maximum_order", decay_maximum_order, {2.0, 500.0}, "free decays: largest model order")
      .number("decay.start", decay_start_s, "s", {0.0, io::longest_record_s},
              "free decays are read from this time after the release on")
      .number("decay.length", decay_length_s, "s", {0.0, io::longest_record_s},
              "length that is read; 0: until the motion is down to what is left at the end of the record")
      .number("decay.band", decay_band_Hz, "Hz", io::positive(),
              "half width of the filter that isolates a mode for frequency and damping by amplitude")
      .integer("decay.bands", decay_bands, {1.0, 50.0}, "bands of amplitude")
      .integer("stay.decimation", stay_decimation, {0.0, 1000.0}, "stays: as decimation; 0: chosen")
      .integer("stay.block_rows", stay_block_rows, {0.0, 1000.0}, "stays: block rows; 0: chosen")
      .integer("stay.maximum_order", stay_maximum_order, {2.0, 500.0}, "stays: largest model order")
      .integer("stay.harmonics", stay_harmonics, {2.0, 40.0}, "stays: harmonics that are used at most")
      .number("stay.lowest", stay_lowest_Hz, "Hz", io::non_negative(),
              "stays: smallest frequency of the taut string that is thought of")
      .number("stay.highest", stay_highest_Hz, "Hz", io::non_negative(), "stays: largest; 0: any")
      .number("stay.level", stay_level, "", {0.5, 0.9999}, "probability of the intervals of tension and sag")
      .tables("stay_length",
              rows_of(stays,
                      [](io::FieldTable& entry, identification::StaySettings& stay) {
                        entry.text("name", stay.name, "setup, point or channel of the stay's records", true)
                            .number("length", stay.length_m, "m", io::positive(), "free length", true)
                            .choice("ends", stay.ends, {"unknown", "hinged", "clamped"},
                                    "how the ends are held; unknown: both are compared")
                            .number("bending_stiffness", stay.bending_stiffness_N_m2, "N m^2", io::non_negative(),
                                    "EI of the section, known to ten per cent; 0: fitted to the harmonics")
                            .number("mass", stay.mass_kg_m, "kg/m", io::non_negative(),
                                    "mass per length; wanted with bending_stiffness");
                      }),
              "a stay's length; without one its tension can't be told", "name")
      .rule([this] { return orders_exchanged("", minimum_order, maximum_order); })
      .rule([this]() -> std::optional<io::FieldTable::Broken> {
        if (block_rows != 1) return std::nullopt;
        return io::FieldTable::Broken{"block_rows", "is 1, expected 2 or more, or 0", "leave it out, and the step chooses it"};
      })
      .rule([this]() -> std::optional<io::FieldTable::Broken> {
        for (const identification::StaySettings& stay : stays) {
          if (stay.bending_stiffness_N_m2 > 0.0 && stay.mass_kg_m <= 0.0)
            return io::FieldTable::Broken{"stay_length.bending_stiffness",
                                          "of " + stay.name + " is given without a mass, expected both",
                                          "give mass in kg/m too, or leave bending_stiffness out"};
        }
        return std::nullopt;
      });
  return table;
}

}  // namespace twindeck::steps
