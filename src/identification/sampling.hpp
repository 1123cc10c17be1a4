#pragma once

#include <string>

#include "identification/identification.hpp"

namespace twindeck::identification {

/// [-] of the Nyquist frequency: where the passband of decimation's filter ends, and how far peaks are looked for in a record
/// as it is, whose last lines next to the Nyquist frequency hold the aliases of what lies right above it.
inline constexpr double kFilteredBand = 0.8, kUnfilteredBand = 0.97;

/// How finely a record is sampled and how long its blocks are, chosen from what moves in it.
struct Sampling {
  long decimation = 1, block_rows = 30;
  double lowest_Hz = 0.0, highest_Hz = 0.0;  ///< peaks of the spectrum that the choice rests on; 0: none was found
  std::string note;                          ///< what was chosen and why
};

/// [-] of the first singular value over its neighbourhood; ten segments reach half of it by chance.
inline constexpr double kClearPeak = 10.0;

/// Frequencies of the lines that stand above the median of those within a quarter of their frequency to either side, from the
/// ninth line on: below, nobody tells a peak from drift.
/// @param density  at each frequency, evenly spaced from 0 @param prominence  [-] over the median @param highest_Hz  0: any
[[nodiscard]] std::vector<double> spectral_peaks(const Eigen::VectorXd& frequency_Hz, const Eigen::VectorXd& density,
                                                 double prominence, double lowest_Hz, double highest_Hz);

/// Chooses what the configuration leaves open (decimation or block_rows 0): from the lowest to the highest peak of the spectrum
/// within the configured band, but no further than one model can follow. Every so many-th sample is kept that the highest peak
/// lies below a third of the rate; block rows span three periods of the lowest peak. Without a peak: the record as it is.
/// @param records  of one rate, detrended, not decimated @param config  of ambient records or, as stay_settings, of stays
[[nodiscard]] Sampling choose_sampling(const std::vector<Samples>& records, double rate_Hz,
                                       const IdentificationSettings& config);

/// The same of free decays: no average over segments, because the first seconds hold what is damped most, and a rate twelve
/// times the highest peak, because a filter smears the release over some fifty samples.
/// @param records  as recorded
[[nodiscard]] Sampling choose_decay_sampling(const std::vector<Samples>& records, double rate_Hz,
                                             const IdentificationSettings& config);

/// Chooses what the configuration leaves open, decimates the records and notes it. @param is_decay  of free decays
void settle_sampling(Conditioned& conditioned, const IdentificationSettings& config, bool is_decay);

}  // namespace twindeck::identification
