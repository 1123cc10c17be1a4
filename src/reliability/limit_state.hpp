#pragma once

#include <Eigen/Core>
#include <functional>

namespace twindeck::reliability {

/// g(u) of independent standard normal numbers u (n): the limit is exceeded where g <= 0. A value that is not finite counts as
/// exceeded. Compose it with RandomVector::values for inputs of other laws.
using LimitState = std::function<double(const Eigen::VectorXd& u)>;

}  // namespace twindeck::reliability
