#pragma once

#include <string>
#include <utility>
#include <vector>

#include "chain.hpp"
#include "dynamics/loaded_model.hpp"
#include "matching/measured.hpp"
#include "unit/heard_reporter.hpp"

namespace twindeck::updating {

using tests::HeardReporter;

/// A system of matrices at its initial values, as a step loads it.
inline dynamics::LoadedModel loaded(const SmallSystem& small) {
  dynamics::LoadedModel model;
  model.system = small.system();
  model.theta.resize(std::ssize(model.system.parameters));
  for (Eigen::Index j = 0; j < model.theta.size(); ++j)
    model.theta[j] = model.system.parameters[static_cast<std::size_t>(j)].initial;
  model.source = "chain";
  return model;
}

inline dynamics::EigenModes modes_of(const dynamics::LoadedModel& model) {
  return dynamics::available_modes(model.system, model.theta, static_cast<int>(model.system.size()));
}

/// Two equal masses of 1 kg between walls: springs left, middle and right of 400, 100 and 400 N/m, each with a factor of its
/// own. In closed form mode 1 is (1, 1) with omega² = 400 and mode 2 is (1, -1) with omega² = 600.
inline SmallSystem two_masses(double right = 1.0) {
  SmallSystem small(2);
  const int l = small.parameter("left", 1.0, 0.5, 1.5), m = small.parameter("middle", 1.0, 0.5, 1.5),
            r = small.parameter("right", right, 0.5 * right, 1.5 * right);
  return small.stiffness(400.0 * spring(2, 0, -1), l)
      .stiffness(100.0 * spring(2, 0, 1), m)
      .stiffness(400.0 * spring(2, 1, -1), r)
      .mass(Eigen::MatrixXd::Identity(2, 2));
}

/// Frequencies of measured modes 1X, 2X, … without shapes, all with one standard deviation.
inline matching::Measured measured_frequencies(const Eigen::VectorXd& frequency_Hz, double std_Hz) {
  matching::Measured measured;
  measured.source = "features";
  measured.modes.frequency_Hz = frequency_Hz;
  measured.modes.frequency_std_Hz = Eigen::VectorXd::Constant(frequency_Hz.size(), std_Hz);
  for (Eigen::Index i = 0; i < frequency_Hz.size(); ++i) {
    measured.labels.push_back(std::to_string(i + 1) + "X");
    measured.rows.push_back({i, -1, false, frequency_Hz[i]});
  }
  measured.covariance = std_Hz * std_Hz * Eigen::MatrixXd::Identity(frequency_Hz.size(), frequency_Hz.size());
  return measured;
}

/// The same with shapes (n_dofs × n_modes) at the dofs "1", "2", … along x, each component with a row and one standard
/// deviation.
inline matching::Measured measured_modes(const Eigen::VectorXd& frequency_Hz, double std_Hz, const Eigen::MatrixXd& shapes,
                                         double shape_std) {
  matching::Measured measured = measured_frequencies(frequency_Hz, std_Hz);
  for (Eigen::Index d = 0; d < shapes.rows(); ++d) measured.modes.dofs.push_back({std::to_string(d + 1), "x"});
  measured.modes.shapes = shapes.cast<std::complex<double>>();
  for (Eigen::Index i = 0; i < shapes.cols(); ++i)
    for (Eigen::Index d = 0; d < shapes.rows(); ++d) measured.rows.push_back({i, d, false, shapes(d, i)});
  const Eigen::Index n = std::ssize(measured.rows);
  Eigen::VectorXd variance = Eigen::VectorXd::Constant(n, shape_std * shape_std);
  variance.head(frequency_Hz.size()).setConstant(std_Hz * std_Hz);
  measured.covariance = variance.asDiagonal();
  return measured;
}

}  // namespace twindeck::updating
