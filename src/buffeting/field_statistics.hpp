#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "wind/simulation.hpp"

namespace twindeck::buffeting {

/// How well the samples have what they were asked to have.
struct FieldCheck {
  std::string event, quantity;
  double target = 0.0, found = 0.0, allowed = 0.0;
};

/// Collects what the samples have, seed by seed in any order; one instance an event.
class FieldStatistics {
 public:
  FieldStatistics(std::string event, const wind::Simulator& along, const wind::Simulator& vertical, long seeds);
  /// @param gusts  (n_samples × 2 n_points) v' of every point, then w'; may be called by several threads, for different seeds
  void add(long seed, const Eigen::MatrixXd& gusts);
  /// Standard deviation (mean and worst point), spectrum (rms over frequencies), coherence (rms over pairs and frequencies).
  [[nodiscard]] std::vector<FieldCheck> checks() const;

 private:
  struct Seed {
    Eigen::VectorXd mean_square;                         ///< (2 n_points)
    std::array<Eigen::VectorXd, 2> density;              ///< mean over points
    std::array<std::vector<Eigen::MatrixXcd>, 2> cross;  ///< of the chosen points
  };
  std::string event_;
  std::array<const wind::Simulator*, 2> simulators_;
  Eigen::Index stride_, segment_;
  double rate_Hz_;
  std::vector<Eigen::Index> chosen_;
  std::vector<Seed> seeds_;
};

}  // namespace twindeck::buffeting
