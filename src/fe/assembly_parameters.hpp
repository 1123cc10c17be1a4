#pragma once

#include <Eigen/Core>

#include "fe/model.hpp"

namespace twindeck::fe {

/// Current values of the model's parameters in its materials, sections and springs.
[[nodiscard]] Eigen::VectorXd initial_parameters(const Model& model);

/// Gives the parameter a value that fits measurements. Its nominal value stays what it was before the first fit.
void set_fitted(Parameter& parameter, double value);

/// The model with parameter values written into its materials, sections, springs and masses (initial values follow).
[[nodiscard]] Model with_parameters(const Model& model, const Eigen::VectorXd& theta);

}  // namespace twindeck::fe
