#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "wind/simulation.hpp"

namespace twindeck::buffeting {

/// A statistic of the samples beside its target and the allowed difference.
struct FieldCheck {
  std::string event, quantity;
  double target = 0.0, found = 0.0, allowed = 0.0;
};

/// Collects the statistics of the samples, seed by seed in any order. Each event has an instance of its own.
class FieldStatistics {
 public:
  /// @param simulators  one a component, which outlive this
  FieldStatistics(std::string event, const std::vector<wind::Simulator>& simulators, long seeds);
  /// @param gusts  (n_samples × n_components n_points) in the order of the simulators; may be called by several threads, for
  ///               different seeds
  void add(long seed, const Eigen::Ref<const Eigen::MatrixXd>& gusts);
  /// Standard deviation (mean and worst point), spectrum (rms over frequencies), coherence (rms over pairs and frequencies).
  [[nodiscard]] std::vector<FieldCheck> checks() const;

 private:
  struct Seed {
    Eigen::VectorXd mean_square;                       ///< (n_components n_points)
    std::vector<Eigen::VectorXd> density;              ///< mean over points, by component
    std::vector<std::vector<Eigen::MatrixXcd>> cross;  ///< of the chosen points, by component
  };
  std::string event_;
  const std::vector<wind::Simulator>& simulators_;
  Eigen::Index stride_, segment_;
  double rate_Hz_;
  std::vector<Eigen::Index> chosen_;
  std::vector<Seed> seeds_;
};

/// Mean of replicates with its confidence interval, mean ± t s / sqrt(n).
struct Interval {
  double mean = 0.0, low = 0.0, high = 0.0;
  double deviation = 0.0;  ///< s: of one replicate
};
/// @param level  e.g. 0.95 @throws InputError for fewer than two replicates
[[nodiscard]] Interval confidence_interval(const Eigen::Ref<const Eigen::VectorXd>& replicates, double level);

}  // namespace twindeck::buffeting
