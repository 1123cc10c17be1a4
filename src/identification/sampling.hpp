#pragma once

#include <string>

#include "identification/identification.hpp"

namespace twindeck::identification {

/// [-] of the Nyquist frequency. Decimated records: end of the filter's passband. Other records: end of the search for peaks,
/// because the last lines contain aliases of frequencies above.
inline constexpr double kFilteredBand = 0.8, kUnfilteredBand = 0.97;

/// [-] Least periods of the lowest mode in a block; a shorter block biases frequency and damping.
inline constexpr double kLeastPeriods = 2.0;

/// Block rows that span so many periods of a frequency.
/// @param rate_Hz  of the decimated record
[[nodiscard]] long block_rows_of(double periods, double rate_Hz, double frequency_Hz);

/// Decimation and block rows, chosen from the spectrum of a record.
struct Sampling {
  long decimation = 1, block_rows = 30;
  double lowest_Hz = 0.0, highest_Hz = 0.0;  ///< lowest and highest peak of the spectrum; 0: none was found
  std::string note;                          ///< what was chosen and why
};

/// [-] Least ratio of a peak of the first singular value to the values around it; with ten segments, half of it occurs by
/// chance.
inline constexpr double kClearPeak = 10.0;

/// Frequencies of the lines above `prominence` times the median within a quarter of their frequency to either side. The first
/// eight lines are skipped, where a peak cannot be distinguished from drift.
/// @param density  at each frequency, evenly spaced from 0 @param prominence  [-] over the median @param highest_Hz  0: any
[[nodiscard]] std::vector<double> spectral_peaks(const Eigen::VectorXd& frequency_Hz, const Eigen::VectorXd& density,
                                                 double prominence, double lowest_Hz, double highest_Hz);

/// Chooses what the configuration leaves open (decimation or block_rows 0): from the lowest to the highest peak of the spectrum
/// within the configured band, but no further than one model can follow. Decimation keeps the rate above three times the
/// highest peak; block rows span three periods of the lowest peak, or fewer where so many channels carry no more, which the
/// note says. Without a peak: the record as it is.
/// @param records  of one rate, detrended, not decimated @param config  of ambient records or, as stay_settings, of stays
[[nodiscard]] Sampling choose_sampling(const std::vector<Samples>& records, double rate_Hz,
                                       const IdentificationSettings& config);

/// The same for free decays. The spectrum is not averaged over segments, because the most damped modes are in the first
/// seconds. The rate stays above twelve times the highest frequency, because a filter smears the release over about fifty
/// samples.
/// @param records  as recorded
[[nodiscard]] Sampling choose_decay_sampling(const std::vector<Samples>& records, double rate_Hz,
                                             const IdentificationSettings& config);

/// Chooses the values that the configuration leaves open, decimates the records, and adds a note. @param is_decay  of free
/// decays
void settle_sampling(Conditioned& conditioned, const IdentificationSettings& config, bool is_decay);

}  // namespace twindeck::identification
