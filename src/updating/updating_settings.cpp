#include "updating/updating_settings.hpp"

#include <utility>

#include "core/lists.hpp"

namespace twindeck::updating {

bool UpdatingSettings::weighs_shapes() const { return contains(residuals, "shape"); }

bool UpdatingSettings::weighs() const { return weights == "covariance" || weighs_shapes(); }

UpdatingOptions UpdatingSettings::options(std::uint64_t seed, std::vector<Eigen::VectorXd> elsewhere, bool regularised) const {
  UpdatingOptions options;
  options.elsewhere = std::move(elsewhere);
  options.trust_radius = trust_radius;
  options.starts = static_cast<int>(starts);
  options.n_modes = static_cast<int>(n_modes);
  options.max_iterations = static_cast<int>(max_iterations);
  options.outer_iterations = static_cast<int>(outer_iterations);
  options.optimality_tolerance = optimality_tolerance;
  options.seed = seed;
  options.leave_one_out = leave_one_out;
  options.regularised = regularised;
  return options;
}

}  // namespace twindeck::updating
