#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "dynamics/loaded_model.hpp"
#include "fe/model.hpp"
#include "reliability/worn_model.hpp"

/// What monitoring would see of corrosion: the smallest loss of thickness that two measurements of the frequencies tell from
/// none.
namespace twindeck::reliability {

/// A mode whose frequency is measured before and after.
struct MonitoredMode {
  Eigen::Index mode = 0;   ///< column of the model's modes
  double deviation = 0.0;  ///< [-] standard deviation of one measurement over the frequency, > 0
};

/// Largest share of a wall that is searched: what is left of it then no longer carries the bridge.
inline constexpr double kLargestLoss = 0.9;

/// The smallest visible loss of one wall.
struct VisibleLoss {
  double wall_m = 0.0;  ///< thickness that there is to lose: of the thinnest section of the wall, half a rope's diameter
  std::optional<double> loss_m;     ///< of a surface; empty: not seen before `kLargestLoss` of the wall is gone
  std::optional<double> located_m;  ///< the same, told from losses of the other walls; empty as above
  Eigen::VectorXd change;           ///< (n_monitored) ln(f_after/f_before) at `loss_m`, or at the largest loss
  double distance = 0.0;            ///< [-] the change there in standard deviations of a difference of two measurements
};

/// With the changes d_m of ln f of the monitored modes, s_m their deviations and two measurements, the loss is seen where
///   D = sqrt(sum d_m²/(2 s_m²)) >= 2 Phi^-1(0.95) = 3.29:
/// a test along the known direction d then errs in 5 % of the cases without a loss, and in 5 % of those with one. Located: the
/// same with the part of d that changes of the other walls cannot imitate. Frequencies after a loss are those of the worn
/// model, its prestress found anew, within the span of the modes before.
/// @param modes      (n × m) M-normalised shapes of the model before, frequencies ascending  @param monitored  columns of them
/// @return a loss a wall, in the order of `walls`
/// Reference: matched filter and its receiver operating characteristic, Kay (1998), Fundamentals of Statistical Signal
/// Processing II, 4.3.
[[nodiscard]] std::vector<VisibleLoss> visible_losses(const fe::Model& model, const Eigen::MatrixXd& modes,
                                                      const Eigen::VectorXd& frequency_Hz, const std::vector<Wall>& walls,
                                                      const std::vector<MonitoredMode>& monitored);

}  // namespace twindeck::reliability
