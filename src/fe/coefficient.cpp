#include "fe/coefficient.hpp"

#include <cmath>

namespace twindeck::fe {

namespace {

double power_of(double x, double power) { return power == 1.0 ? x : std::pow(x, power); }

/// A property that a parameter scales. The quotient comes first: where the model's value is the reference, the parameter's own
/// value comes out to the last digit.
double scaled(double own, const std::optional<ParameterFactor>& by, const Eigen::VectorXd& theta) {
  return by ? theta[by->parameter] * (own / by->reference) : own;
}

bool is_of(const std::optional<ParameterFactor>& factor, int parameter) { return factor && factor->parameter == parameter; }

/// A stay's law and modulus at parameter values.
struct StayValues {
  Dischinger law;
  double youngs_modulus_Pa;
};

StayValues at(const StayModulus& stay, const Eigen::VectorXd& theta) {
  Dischinger law = stay.law;
  law.weight_density_N_m3 = scaled(law.weight_density_N_m3, stay.density, theta);
  if (stay.area) law.stress_Pa /= stay.area->value(theta);
  return {law, scaled(stay.youngs_modulus_Pa, stay.modulus, theta)};
}

}  // namespace

double ParameterFactor::value(const Eigen::VectorXd& theta) const { return power_of(theta[parameter] / reference, power); }

double ParameterFactor::derivative(const Eigen::VectorXd& theta) const {
  return power * std::pow(theta[parameter] / reference, power - 1.0) / reference;
}

double Dischinger::sag_number(double youngs_modulus_Pa) const {
  const double sag = weight_density_N_m3 * horizontal_length_m;
  return sag * sag * youngs_modulus_Pa / (12.0 * stress_Pa * stress_Pa * stress_Pa);
}

double Dischinger::modulus(double youngs_modulus_Pa) const { return youngs_modulus_Pa / (1.0 + sag_number(youngs_modulus_Pa)); }

double Dischinger::modulus_derivative(double youngs_modulus_Pa) const {
  const double ratio = modulus(youngs_modulus_Pa) / youngs_modulus_Pa;
  return ratio * ratio;
}

double StayModulus::ratio(const Eigen::VectorXd& theta) const {
  const StayValues now = at(*this, theta);
  return now.law.modulus(now.youngs_modulus_Pa) / law.modulus(youngs_modulus_Pa);
}

double StayModulus::ratio_derivative(const Eigen::VectorXd& theta, int parameter) const {
  if (!is_of(modulus, parameter) && !is_of(density, parameter) && !is_of(area, parameter)) return 0.0;
  const StayValues now = at(*this, theta);
  const double equivalent = now.law.modulus(now.youngs_modulus_Pa), q = now.law.sag_number(now.youngs_modulus_Pa);
  const double loss = equivalent * q / (1.0 + q);  // -dE_eq/d(ln q) at a fixed E
  double slope = 0.0;
  if (is_of(modulus, parameter))
    slope += now.law.modulus_derivative(now.youngs_modulus_Pa) * (youngs_modulus_Pa / modulus->reference);
  if (is_of(density, parameter)) slope -= 2.0 * loss / theta[parameter];
  if (is_of(area, parameter)) slope -= 3.0 * loss / theta[parameter];
  return slope / law.modulus(youngs_modulus_Pa);
}

double Coefficient::value(const Eigen::VectorXd& theta) const {
  double product = base;
  if (stay) product *= stay->ratio(theta);
  for (const ParameterFactor& factor : factors) product *= factor.value(theta);
  return product;
}

double Coefficient::derivative(const Eigen::VectorXd& theta, int parameter) const {
  double sum = 0.0;  // product rule; a parameter may stand in several factors (thickness in t and t³, a stay's area in E_eq A)
  if (stay) {
    double product = base * stay->ratio_derivative(theta, parameter);
    for (const ParameterFactor& factor : factors) product *= factor.value(theta);
    sum += product;
  }
  for (std::size_t i = 0; i < factors.size(); ++i) {
    if (factors[i].parameter != parameter) continue;
    double product = base * factors[i].derivative(theta);
    if (stay) product *= stay->ratio(theta);
    for (std::size_t j = 0; j < factors.size(); ++j)
      if (j != i) product *= factors[j].value(theta);
    sum += product;
  }
  return sum;
}

bool Coefficient::is_constant() const { return factors.empty() && !(stay && (stay->modulus || stay->density || stay->area)); }

}  // namespace twindeck::fe
