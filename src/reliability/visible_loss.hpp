#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "dynamics/loaded_model.hpp"
#include "fe/model.hpp"
#include "reliability/worn_model.hpp"

/// The smallest loss of thickness by corrosion that two measurements of the frequencies distinguish from no loss.
namespace twindeck::reliability {

/// A mode whose frequency is measured before and after.
struct MonitoredMode {
  Eigen::Index mode = 0;   ///< column of the model's modes
  double deviation = 0.0;  ///< [-] standard deviation of one measurement over the frequency, > 0
};

/// Largest share of a wall that is searched: with less than a tenth of the wall the bridge no longer stands.
inline constexpr double kLargestLoss = 0.9;

/// The smallest visible loss of one wall.
struct VisibleLoss {
  double wall_m = 0.0;  ///< largest possible loss: thickness of the thinnest section of the wall, or half a rope's diameter
  std::optional<double> loss_m;     ///< of a surface; empty: not seen before `kLargestLoss` of the wall is gone
  std::optional<double> located_m;  ///< smallest loss that is also distinguished from losses of the other walls; empty as above
  Eigen::VectorXd change;           ///< (n_monitored) ln(f_after/f_before) at `loss_m`, or at the largest loss
  double distance = 0.0;            ///< [-] size of `change` in standard deviations of a difference of two measurements
};

/// d_m is the change of ln f of a monitored mode and s_m its deviation. With two measurements the loss is seen where
///   D = sqrt(sum d_m²/(2 s_m²)) >= 2 Phi^-1(0.95) = 3.29.
/// A test along the known direction d then errs in 5 % of the cases without a loss, and in 5 % of the cases with one. A loss is
/// located if the part of d that losses of the other walls cannot imitate is as large. Frequencies after a loss are those of
/// the worn model, its prestress found anew, within the span of the modes before.
/// @param modes      (n × m) M-normalised shapes of the model before, frequencies ascending  @param monitored  columns of them
/// @return a loss a wall, in the order of `walls`
/// Reference: matched filter and its receiver operating characteristic, Kay (1998), Fundamentals of Statistical Signal
/// Processing II, 4.3.
[[nodiscard]] std::vector<VisibleLoss> visible_losses(const fe::Model& model, const Eigen::MatrixXd& modes,
                                                      const Eigen::VectorXd& frequency_Hz, const std::vector<Wall>& walls,
                                                      const std::vector<MonitoredMode>& monitored);

}  // namespace twindeck::reliability
