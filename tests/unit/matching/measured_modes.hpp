#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dynamics/loaded_model.hpp"
#include "matching/measured.hpp"
#include "unit/dynamics/spring_chain.hpp"
#include "unit/heard_reporter.hpp"

/// Measured modes and chain models, built by hand.
namespace twindeck::matching {

/// Modes "1X", "2X", … without shapes.
inline Measured measured_frequencies(const Eigen::VectorXd& frequency_Hz) {
  Measured measured;
  measured.source = "measured";
  measured.modes.frequency_Hz = frequency_Hz;
  for (Eigen::Index i = 0; i < frequency_Hz.size(); ++i) measured.labels.push_back(std::to_string(i + 1) + "X");
  return measured;
}

/// The same with shapes at channels "c1", "c2", … of the points `points`. @param shapes (n_points × n_modes)
inline Measured measured_shapes(const Eigen::VectorXd& frequency_Hz, const Eigen::MatrixXcd& shapes,
                                const std::vector<std::string>& points) {
  Measured measured = measured_frequencies(frequency_Hz);
  measured.modes.shapes = shapes;
  for (const std::string& point : points)
    measured.modes.dofs.push_back({point, "c" + std::to_string(measured.modes.dofs.size() + 1)});
  return measured;
}

/// A system of matrices as a model. @param theta  empty: the initial values
inline dynamics::LoadedModel matrix_model(fe::ParametricSystem system, const std::vector<double>& theta = {}) {
  dynamics::LoadedModel model;
  model.theta = system.initial();
  for (std::size_t i = 0; i < theta.size(); ++i) model.theta[static_cast<Eigen::Index>(i)] = theta[i];
  model.system = std::move(system);
  model.source = "chain";
  return model;
}

using tests::HeardReporter;

/// Whether a text holds a part; shows the text if it does not.
inline testing::AssertionResult says(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "'" << part << "' is not in '" << text << "'";
}

/// The MAC as the definition has it, term by term.
inline double mac_by_hand(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    ab += a[i] * b[i];
    aa += a[i] * a[i];
    bb += b[i] * b[i];
  }
  return ab * ab / (aa * bb);
}

}  // namespace twindeck::matching
