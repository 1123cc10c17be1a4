#pragma once

#include <vector>

#include "blind/trial.hpp"

/// Blind trials from records: the truth vibrates, own identification reads the records, and the diagnosis sees what came of
/// that.
namespace twindeck::blind {

/// What sixteen channels wrote down in each condition of the bench.
struct Campaign {
  std::vector<diagnosis::Condition> conditions;  ///< as the bench's, with the amplitudes that the records have
  std::vector<Eigen::MatrixXd> records;          ///< (n_samples × n_channels) accelerations
  double rate_Hz = 10.0;
};

/// The truth integrated in time: modes of its own mesh with static corrections, dampers as they are (a dashpot that friction
/// holds, on its mount), white forces of the size that gives each condition its amplitude; 200 steps a second, decimated.
/// Nothing in it knows of harmonic balance or of the diagnosis' primitives.
[[nodiscard]] Campaign integrated_records(const Bench& bench, const Hidden& hidden);

/// Families whose effects these records can carry.
[[nodiscard]] const std::set<std::string>& families_of_integrated_records();

/// Rows by own identification (covariance-driven subspace, automatic selection): frequencies, damping ratios, shapes with their
/// deviations. Modes carry one name in all conditions by likeness. The strongest and the warmest condition and the highest mode
/// of the two with all shapes are held out.
[[nodiscard]] diagnosis::FeatureSet identified_rows(const Bench& bench, const Campaign& campaign);

/// Diagnosis of what was identified, scored against the seal.
[[nodiscard]] Score run_records(const Bench& bench, const Hidden& hidden, const Campaign& campaign);

}  // namespace twindeck::blind
