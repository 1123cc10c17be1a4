#include "aero/polar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "core/units.hpp"

namespace twindeck::aero {

namespace {

StaticCoefficients mix(const StaticCoefficients& a, const StaticCoefficients& b, double t) {
  const auto between = [t](double u, double v) { return u + t * (v - u); };
  return {between(a.drag, b.drag),
          between(a.lift, b.lift),
          between(a.moment, b.moment),
          between(a.drag_slope, b.drag_slope),
          between(a.lift_slope, b.lift_slope),
          between(a.moment_slope, b.moment_slope)};
}

}  // namespace

Polar::Polar(std::vector<double> alpha_rad, std::vector<StaticCoefficients> rows, std::string source)
    : alpha_rad_(std::move(alpha_rad)), rows_(std::move(rows)), source_(std::move(source)) {
  if (alpha_rad_.empty() || alpha_rad_.size() != rows_.size() ||
      std::ranges::adjacent_find(alpha_rad_, std::greater_equal<>()) != alpha_rad_.end())
    throw InputError({source_, 0, "alpha_deg"}, "is empty or does not ascend", "give one row an angle of attack, ascending");
}

bool Polar::covers(double alpha) const { return alpha >= alpha_rad_.front() && alpha <= alpha_rad_.back(); }

StaticCoefficients Polar::at(double alpha) const {
  if (!covers(alpha))
    throw InputError({source_, 0, "alpha_deg"},
                     fmt::format("covers {:.6g} to {:.6g} degrees, {:.6g} is needed", alpha_rad_.front() * degrees,
                                 alpha_rad_.back() * degrees, alpha * degrees),
                     "extend the table, or lower the wind's angle of attack");
  const auto upper = std::ranges::upper_bound(alpha_rad_, alpha);
  if (upper == alpha_rad_.end()) return rows_.back();
  const auto i = static_cast<std::size_t>(upper - alpha_rad_.begin());
  return mix(rows_[i - 1], rows_[i], (alpha - alpha_rad_[i - 1]) / (alpha_rad_[i] - alpha_rad_[i - 1]));
}

Polar Polar::with_lift_slope_factor(double factor) const {
  const double pivot = covers(0.0) ? at(0.0).lift : rows_[rows_.size() / 2].lift;
  Polar turned = *this;
  for (StaticCoefficients& row : turned.rows_) {
    row.lift = pivot + factor * (row.lift - pivot);
    row.lift_slope *= factor;
  }
  return turned;
}

QuasiSteady::QuasiSteady(Polar polar, const Arms& arms) : polar_(std::move(polar)), arms_(arms) {}

DerivativeBlock QuasiSteady::at(double alpha_rad, double v_over_omegaB) const {
  const StaticCoefficients c = polar_.at(alpha_rad);
  const double h1 = c.lift_slope + c.drag, p1 = c.drag_slope - c.lift, a1 = c.moment_slope;
  const Derivatives18 zasso = {h1, arms_.lift * h1,   c.lift_slope,   0, 2 * c.lift,   0,  //
                               p1, arms_.drag * p1,   c.drag_slope,   0, 2 * c.drag,   0,
                               a1, arms_.moment * a1, c.moment_slope, 0, 2 * c.moment, 0};
  return to_block(Convention::zasso, zasso, v_over_omegaB);
}

}  // namespace twindeck::aero
