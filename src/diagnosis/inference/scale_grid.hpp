#pragma once

#include <Eigen/Core>
#include <vector>

/// Room diagnosis/inference: odds, verdict and gain. It takes residuals, columns of unknowns and signatures as plain matrices
/// and knows no structure. It gives evidences, a verdict, and the predictive gain of a name on left-out rows (decision 0013).
namespace twindeck::diagnosis {

/// One point of the scales that the evidence is summed over: of element scatter, of the form error in frequencies and in
/// shapes.
struct ScalePoint {
  double scatter = 1.0;
  int frequency = 0, shape = 0;  ///< positions in ScaleGrid
  double log_prior = 0.0;
};

struct ScaleGrid {
  Eigen::VectorXd frequency, shape, change;  ///< relative deviations: tau_f, tau_s, kappa
  std::vector<ScalePoint> points;            ///< every combination but kappa's; priors sum to one
};

/// The grid of the method: tau_f 0.05 to 8 %, tau_s 0.2 to 30 % with half-t priors of three degrees of freedom and scale 1 %,
/// scatter 1 and 2.5 times as stated with weights 0.7 and 0.3; kappa 0.05 to 20 %.
[[nodiscard]] ScaleGrid scale_grid();

/// Probabilities of a half-t law of three degrees of freedom on the cells around the points. The cells meet at geometric means;
/// the first begins at zero and the last is unbounded, so that the probabilities sum to one. @param points ascending, above
/// zero
[[nodiscard]] Eigen::VectorXd half_t_weights(const Eigen::VectorXd& points, double scale);

/// Points of kappa for the leftover of a cause (0.05 to 8 %) and of "something else changed" (0.2 to 20 %): first and count.
struct Part {
  Eigen::Index first, count;
};
[[nodiscard]] Part leftover_part();
[[nodiscard]] Part something_else_part();

}  // namespace twindeck::diagnosis
