#include "aero/laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/units.hpp"

namespace twindeck::aero {
namespace {

/// [V/(f B)] From this reduced velocity on, the size of derivatives is compared with their quasi-steady limit. Those of a thin
/// plate are then within a fifth of it (Theodorsen's C(k) at k = 0.16 is 0.80 - 0.19i).
constexpr double steady_from = 20.0;
/// [-] A derivative may differ from its limit by this share of the limit. Bluff decks differ by more than a plate; a wrong sign
/// differs by twice the limit.
constexpr double share_of_limit = 0.5;
/// [-] A smaller difference is always allowed: it is the scatter of wind tunnel tests for coefficients near zero.
constexpr double least_difference = 0.15;
/// [-] A slope may differ from the difference quotient of the coefficients by this share of the largest slope. Rows 5 degrees
/// apart on a stalling polar come near it.
constexpr double share_of_slope = 0.25;
constexpr double least_slope = 0.05;  ///< [1/rad] the rounding of coefficients with three decimals, half a degree apart

double nearest_to_zero(const std::vector<double>& alpha) {
  return *std::ranges::min_element(alpha, [](double a, double b) { return std::abs(a) < std::abs(b); });
}

std::optional<std::string> drag(const Polar& polar) {
  for (const double alpha : polar.alpha_rad())
    if (const double c = polar.at(alpha).drag; !(c > 0.0))
      return fmt::format("{}: C_D is {:.4g} at {:.3g} degrees, expected a positive drag", polar.source(), c, alpha * degrees);
  return std::nullopt;
}

std::optional<std::string> slopes(const Polar& polar) {
  struct Column {
    const char* name;
    double StaticCoefficients::*value;
    double StaticCoefficients::*slope;
  };
  const std::array<Column, 3> columns = {{{"C_D", &StaticCoefficients::drag, &StaticCoefficients::drag_slope},
                                          {"C_L", &StaticCoefficients::lift, &StaticCoefficients::lift_slope},
                                          {"C_M", &StaticCoefficients::moment, &StaticCoefficients::moment_slope}}};
  const std::vector<double>& alpha = polar.alpha_rad();
  for (const Column& column : columns) {
    double largest = 0.0;
    for (const double a : alpha) largest = std::max(largest, std::abs(polar.at(a).*column.slope));
    for (std::size_t i = 1; i + 1 < alpha.size(); ++i) {
      const double found =
          (polar.at(alpha[i + 1]).*column.value - polar.at(alpha[i - 1]).*column.value) / (alpha[i + 1] - alpha[i - 1]);
      const double said = polar.at(alpha[i]).*column.slope;
      if (std::abs(said - found) > share_of_slope * largest + least_slope)
        return fmt::format(
            "{}: d{}/dalpha is given as {:.4g} per radian at {:.3g} degrees, the coefficients beside it rise by {:.4g}",
            polar.source(), column.name, said, alpha[i] * degrees, found);
    }
  }
  return std::nullopt;
}

std::optional<std::string> moment_slope(const Polar& polar) {
  const double alpha = nearest_to_zero(polar.alpha_rad()), slope = polar.at(alpha).moment_slope;
  if (slope >= 0.0) return std::nullopt;
  return fmt::format(
      "{}: dC_M/dalpha is {:.4g} per radian at {:.3g} degrees, expected one that is not negative (nose-up moment, pressure "
      "upwind of mid-chord)",
      polar.source(), slope, alpha * degrees);
}

Derivatives18 zasso_at(const FlutterDerivatives& derivatives, double alpha, double v) {
  return from_block(Convention::zasso, derivatives.at(alpha, v), v);
}

std::optional<std::string> pitching_damping(const DerivativeTable& table) {
  constexpr std::size_t a2 = 13;
  const double alpha = nearest_to_zero(table.alpha_rad()), v = table.range_v_over_omegaB().first;
  const double found = zasso_at(table, alpha, v)[a2];
  if (found >= 0.0) return std::nullopt;
  return fmt::format(
      "{}: a2 is {:.4g} at V/(f B) = {:.3g} and {:.3g} degrees, expected a damping of pitching that is not negative "
      "(a2 >= 0, A2 <= 0)",
      table.source(), found, 2.0 * std::numbers::pi * v, alpha * degrees);
}

// The derivatives that have a quasi-steady limit: none of displacements, those of the rotational rate only with a known arm.
std::vector<std::size_t> with_limit(const QuasiSteady::Arms& arms) {
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < Derivatives18().size(); ++i) {
    const std::size_t number = i % 6 + 1;
    const double arm = i < 6 ? arms.lift : i < 12 ? arms.drag : arms.moment;
    if (number != 4 && number != 6 && !(number == 2 && arm == 0.0)) which.push_back(i);
  }
  return which;
}

std::optional<std::string> quasi_steady(const Polar& polar, const DerivativeTable& table, const QuasiSteady::Arms& arms) {
  const double v = table.range_v_over_omegaB().second, v_f = 2.0 * std::numbers::pi * v;
  const QuasiSteady limit_of(polar, arms);
  const bool by_size = v_f >= steady_from;
  for (const double alpha : table.alpha_rad()) {
    if (alpha < polar.alpha_rad().front() || alpha > polar.alpha_rad().back()) continue;
    const Derivatives18 found = zasso_at(table, alpha, v), limit = zasso_at(limit_of, alpha, v);
    for (const std::size_t i : with_limit(arms)) {
      const double allowed = std::max(share_of_limit * std::abs(limit[i]), least_difference);
      const bool of_rotation = i % 6 == 2;
      const bool other_sign = found[i] * limit[i] < 0.0 && std::abs(found[i] - limit[i]) > least_difference;
      if (by_size ? std::abs(found[i] - limit[i]) <= allowed : !(of_rotation && other_sign)) continue;
      return fmt::format(
          "{}: {} is {:.4g} at V/(f B) = {:.3g} and {:.3g} degrees, where the polar gives {:.4g} by quasi-steady theory",
          table.source(), name_of(Convention::zasso, static_cast<int>(i)), found[i], v_f, alpha * degrees, limit[i]);
    }
  }
  return std::nullopt;
}

}  // namespace

const std::vector<std::string>& law_names() {
  static const std::vector<std::string> list = {"drag", "slopes", "moment_slope", "pitching_damping", "quasi_steady"};
  return list;
}

std::vector<BrokenLaw> broken_laws(const Polar& polar, const DerivativeTable& table, const QuasiSteady::Arms& arms) {
  std::vector<BrokenLaw> broken = broken_laws(polar);
  if (const auto told = pitching_damping(table)) broken.push_back({"pitching_damping", *told});
  if (const auto told = quasi_steady(polar, table, arms)) broken.push_back({"quasi_steady", *told});
  return broken;
}

std::vector<BrokenLaw> broken_laws(const Polar& polar) {
  std::vector<BrokenLaw> broken;
  if (const auto told = drag(polar)) broken.push_back({"drag", *told});
  if (const auto told = slopes(polar)) broken.push_back({"slopes", *told});
  if (const auto told = moment_slope(polar)) broken.push_back({"moment_slope", *told});
  return broken;
}

}  // namespace twindeck::aero
