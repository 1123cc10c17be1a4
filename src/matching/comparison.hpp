#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/reporter.hpp"
#include "dynamics/eigenmodes.hpp"
#include "dynamics/loaded_model.hpp"
#include "matching/measured.hpp"
#include "matching/mode_name.hpp"
#include "matching/pairing.hpp"

/// Measured modes against computed modes: pairs and their differences.
namespace twindeck::matching {

/// How measured modes were given their numerical partners.
struct Pairing {
  std::vector<ModePair> pairs;          ///< in the order of the measured modes
  std::string method;                   ///< "order" | "published" | "mac"
  Eigen::MatrixXd mac;                  ///< (n_N × n_X) at the sensors, NaN of a mode without a shape; empty if none has one
  Eigen::MatrixXd likeness;             ///< (n_N × n_X) the same, with the subspace MAC of close modes (Likeness)
  Eigen::MatrixXcd shapes;              ///< (n_channels × n_N) computed ones at the sensors; empty likewise
  std::vector<std::string> unmeasured;  ///< measured modes that a published list names but the measurement lacks
};

/// Lowest measured with lowest computed mode, and so on, in whatever order the measured modes are given; only the measured
/// modes for which `keep` is true (all if it is empty).
[[nodiscard]] Pairing pair_by_order(const Measured& measured, Eigen::Index n_numerical, const std::vector<bool>& keep = {});

/// A published assignment such as {"1X-1N", "7X-8N"}. Pairs whose measured mode is not in `measured` are passed over, and
/// listed in `unmeasured`.
/// @param place  where the list stands, for messages
/// @throws InputError  for an entry of another form, a mode named twice, or a numerical mode beyond `n_numerical`
[[nodiscard]] Pairing pair_as_published(const Measured& measured, Eigen::Index n_numerical,
                                        const std::vector<std::string>& published, const Place& place);

/// Refuses what the files alone show to be wrong, before anything is solved. @param n_modes  number of modes to be computed
/// @throws InputError  as pair_as_published, or as pair_at_sensors where shapes were measured
void check_pairing(const Measured& measured, const dynamics::ReadModel& model, const std::vector<std::string>& published,
                   const Place& place, long n_modes, double sensor_tolerance_m);

/// Names the pairs of a list that were passed over.
void warn_of_unmeasured(Reporter& reporter, const Pairing& pairing);

/// By MAC at the sensors, one-to-one.
/// @throws InputError  if no shape was measured, or a sensor can't be placed on the model
[[nodiscard]] Pairing pair_at_sensors(const Measured& measured, const dynamics::LoadedModel& model,
                                      const dynamics::EigenModes& modes, const PairingOptions& options,
                                      double sensor_tolerance_m);

/// A row of comparison.csv; error = (f_N - f_X)/f_X as in Tables 6, 7 and 9.
struct ComparisonRow {
  std::string stage, experimental, numerical;
  double measured_Hz = 0.0, computed_Hz = 0.0;
  std::optional<double> mac;
  std::string pairing;
  [[nodiscard]] double error_pct() const { return 100.0 * (computed_Hz - measured_Hz) / measured_Hz; }
};
[[nodiscard]] std::vector<ComparisonRow> compare(const std::string& stage, const Measured& measured,
                                                 const Eigen::VectorXd& computed_Hz, const Pairing& pairing);
/// Mean of |error| over the rows of a stage [%]; NaN for none.
[[nodiscard]] double mean_abs_error_pct(const std::vector<ComparisonRow>& rows, const std::string& stage);

}  // namespace twindeck::matching
