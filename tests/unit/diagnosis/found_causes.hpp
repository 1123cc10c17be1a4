#pragma once

#include <gtest/gtest.h>

#include "diagnosis/extended_model.hpp"
#include "dynamics/loaded_model.hpp"
#include "unit/diagnosis/prediction/hand_made.hpp"

namespace twindeck::tests {

inline constexpr double kExact = 1e-9;  // relative, of frequencies of two to four masses

/// A cause at a location of a set.
struct At : HandMade {
  At(const std::string& kind, const std::map<std::string, double>& numbers, const std::string& set, const std::string& location,
     const std::vector<const diagnosis::ReducedPlace*>& places = {})
      : HandMade(kind, numbers, places) {
    hypothesis.id = "h";
    hypothesis.set = set;
    candidate.location = location;
  }
};

inline diagnosis::Diagnosis diagnosis_with(const std::vector<const At*>& causes, const Eigen::VectorXd& theta = {}) {
  diagnosis::Diagnosis result;
  for (const At* at : causes) {
    diagnosis::Effect effect;
    effect.cause = at->cause();
    result.effects.push_back(effect);
  }
  result.after.base.theta = theta;
  return result;
}

inline diagnosis::DiagnosedModel ready(fe::Model model) {
  diagnosis::DiagnosedModel out;
  out.loaded = dynamics::from_model(std::move(model));
  return out;
}

inline Eigen::VectorXd model_hertz(const fe::Model& model, int modes) {
  const dynamics::LoadedModel loaded = dynamics::from_model(model);
  return dynamics::available_modes(loaded.system, loaded.theta, modes).frequency_Hz;
}

inline void expect_close(const Eigen::VectorXd& found, const Eigen::VectorXd& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (Eigen::Index i = 0; i < expected.size(); ++i) EXPECT_NEAR(found[i] / expected[i], 1.0, kExact) << "mode " << i + 1;
}

inline fe::Spring spring(const std::string& name, const std::string& group, int node, int node2, double stiffness,
                         const Eigen::Vector3d& direction = Eigen::Vector3d::UnitX()) {
  fe::Spring out;
  out.name = name;
  out.group = group;
  out.node = node;
  out.node2 = node2;
  out.stiffness = stiffness;
  out.direction = direction;
  return out;
}

}  // namespace twindeck::tests
