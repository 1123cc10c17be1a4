#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "aero/wind_study.hpp"
#include "buffeting/bridge_in_wind.hpp"
#include "reliability/crossings.hpp"
#include "reliability/form.hpp"
#include "reliability/random_inputs.hpp"
#include "reliability/varied_structure.hpp"

namespace twindeck::reliability {

/// Names of the random inputs beside the model's parameters, which are called "parameter:NAME".
inline const std::string kDamping = "structural_damping", kSlope = "aerodynamic_level", kDampers = "damper_constants",
                         kTurbulence = "turbulence_intensity", kCorrosion = "corrosion_rate";

/// A bridge in wind whose random inputs are x.
struct UncertainBridge {
  RandomVector random;
  const dynamics::LoadedModel& loaded;
  std::vector<int> parameters;  ///< of the model, in the order of the inputs "parameter:NAME"
  std::function<std::vector<aero::SectionAero>(double factor)> sections;  ///< of the set at a factor of its level
  double damping_ratio = 0.0;                                             ///< where it is not random

  /// Changes of the inputs' values. @param u (dimension) standard normal numbers
  [[nodiscard]] WindVariation variation(const Eigen::VectorXd& u) const;

  /// Mean change of the inputs over one standard deviation of a number of u to either side: of parameters in their own units,
  /// of all other inputs of the logarithm.
  struct Change {
    Eigen::VectorXd parameters;
    double damping = 0.0, aerodynamic = 0.0, dampers = 0.0, turbulence = 0.0, corrosion = 0.0;
  };
  [[nodiscard]] std::vector<Change> changes() const;
};

/// A quantity as a function of u: its value, and the exact slopes of its logarithm at u = 0. Quantities of vibration are
/// products of powers of dampings and stiffnesses, so the logarithm is close to linear.
struct LogLinear {
  double value = 0.0;                                              ///< at u = 0
  Eigen::VectorXd slope;                                           ///< (dimension) d ln(value) / d u_i
  [[nodiscard]] double deviation() const { return slope.norm(); }  ///< of the logarithm
};

/// Critical speed of one deployment.
struct CriticalSpeed {
  std::string model;
  bool dampers = false;
  std::optional<LogLinear> speed_m_s;  ///< empty: stable to the highest speed at the medians of all inputs
  /// P(V_cr < V): Phi((ln V - ln V_cr)/deviation), the first-order reliability method on the logarithm.
  [[nodiscard]] double probability_below(double speed_m_s) const;
  /// Whether the bridge is stable in this wind, at the medians and with each input one deviation away.
  [[nodiscard]] bool stable_nearby(double speed_m_s) const;
};
/// The slopes are those of the complex eigenvalue's crossing of the imaginary axis: w'(Z_omega d omega + Z_V dV + dZ) v = 0
/// with the left and right vectors w and v of the impedance Z there.
[[nodiscard]] CriticalSpeed critical_speed(const UncertainBridge& bridge, const aero::WindSettings& settings,
                                           const aero::WindModel& model, const VariedStructure& structure,
                                           const aero::Deployment& deployment, bool dampers);

/// Spectral moments of responses in a mean wind: of all rows at u = 0, of some of them as functions of u.
struct UncertainMoments {
  bool stable = true;                 ///< at u = 0; if false, only this and `growth` are set
  std::string growth;                 ///< sentence that names the unstable mode at u = 0; empty if stable
  std::vector<SpectralMoments> mean;  ///< (n_rows) at u = 0
  std::vector<std::size_t> varied;    ///< (n_varied) the rows that the slopes below belong to
  std::vector<Eigen::VectorXd> variance_slope, rate_slope,
      bandwidth_slope;  ///< (n_varied) (dimension) slopes of ln lambda_0, ln nu, ln delta
  /// @param k  position in `varied`  @param u (dimension)
  [[nodiscard]] SpectralMoments at(std::size_t k, const Eigen::VectorXd& u) const;
  /// Adds the slopes with the rate of corrosion. To first order, the change since the year 0 is proportional to that rate.
  /// @param earlier  the same rows in the year 0  @param change  see UncertainBridge::Change
  void add_corrosion(const UncertainMoments& earlier, const std::vector<UncertainBridge::Change>& change);
};

/// Input of a response: the reduced bridge, its turbulence, a deployment, rows of sensors.
struct WindResponse {
  const buffeting::BridgeInWind& bridge;
  const VariedStructure& structure;
  const buffeting::WindEventSettings& settings;
  const wind::TurbulenceSet& turbulence;
  aero::Deployment deployment;
  Eigen::MatrixXd rows;            ///< (n_rows × m) of each sensor per unit of each coordinate
  Eigen::Index accelerations = 0;  ///< number of leading rows whose acceleration is computed; later rows are not differentiated
};
/// @param choose  selects the rows whose spread is computed, from the moments of all rows at u = 0
[[nodiscard]] UncertainMoments uncertain_moments(
    const UncertainBridge& bridge, const WindResponse& response, double speed_m_s,
    const std::function<std::vector<std::size_t>(const std::vector<SpectralMoments>& mean)>& choose);

/// Probability of a first excursion with its spread over the random inputs.
struct Excursion {
  double mean = 0.0, low = 0.0, high = 0.0;      ///< over the inputs; low and high are the 5 and 95 % quantiles
  double poisson = 0.0, crossing_rate_Hz = 0.0;  ///< at u = 0, of |x| and of x
};
/// @param k        position in `moments.varied`
/// @param samples  number of samples of u for the spread  @param seed  of these samples
[[nodiscard]] Excursion excursion(const UncertainMoments& moments, std::size_t k, double limit, double duration_s, int samples,
                                  std::uint64_t seed);

/// Limit state of an excursion over (dimension + 1) numbers: the last one decides whether it happens, g = u_last -
/// Phi^-1(P(excursion | u)).
/// Reference: Wen and Chen (1987), Prob. Eng. Mech. 2, 156-162.
[[nodiscard]] LimitState excursion_limit_state(const UncertainMoments& moments, std::size_t k, double limit, double duration_s);

}  // namespace twindeck::reliability
