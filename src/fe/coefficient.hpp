#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace twindeck::fe {

/// (theta_p / reference)^power.
struct ParameterFactor {
  int parameter = -1;
  double power = 1.0, reference = 1.0;
  [[nodiscard]] double value(const Eigen::VectorXd& theta) const;
  /// With respect to its own parameter.
  [[nodiscard]] double derivative(const Eigen::VectorXd& theta) const;
};

/// Ernst/Dischinger tangent modulus at a frozen cable force:  E_eq = E / (1 + q),  q = (gamma l)² E / (12 sigma³),
/// gamma = weight per volume [N/m³], l = horizontal projection [m], sigma = T/A [Pa].
/// d E_eq/dE = (E_eq/E)². Reference: Ernst (1965), Der Bauingenieur 40, 52-55.
struct Dischinger {
  double weight_density_N_m3 = 0.0, horizontal_length_m = 0.0, stress_Pa = 0.0;
  [[nodiscard]] double sag_number(double youngs_modulus_Pa) const;  ///< q [-]
  [[nodiscard]] double modulus(double youngs_modulus_Pa) const;
  [[nodiscard]] double modulus_derivative(double youngs_modulus_Pa) const;
};

/// E_eq of a stay whose modulus, density or area are parameters. The cable force alone is frozen with the prestress: the weight
/// goes with the density and the stress T/A with the area, so that q ~ E density² area³.
struct StayModulus {
  Dischinger law;                  ///< at the model's own values
  double youngs_modulus_Pa = 0.0;  ///< likewise
  std::optional<ParameterFactor> modulus, density, area;
  /// E_eq(theta) / E_eq at the model's own values, and its derivative.
  [[nodiscard]] double ratio(const Eigen::VectorXd& theta) const;
  [[nodiscard]] double ratio_derivative(const Eigen::VectorXd& theta, int parameter) const;
};

/// Coefficient of one matrix term: base * prod of factors, and for a stay under its cable force times the ratio of its E_eq.
struct Coefficient {
  double base = 1.0;
  std::vector<ParameterFactor> factors;
  std::optional<StayModulus> stay;
  [[nodiscard]] double value(const Eigen::VectorXd& theta) const;
  [[nodiscard]] double derivative(const Eigen::VectorXd& theta, int parameter) const;
  /// Whether no parameter changes it.
  [[nodiscard]] bool is_constant() const;
};

}  // namespace twindeck::fe
