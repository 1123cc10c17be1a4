#include "aero/derivative_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "core/error.hpp"
#include "core/units.hpp"

namespace twindeck::aero {
namespace {

bool ascends(const std::vector<double>& axis) {
  return !axis.empty() && std::ranges::adjacent_find(axis, std::greater_equal<>()) == axis.end();
}

// Position of a value between two neighbouring points of an axis. A value at or beyond an end gets that end.
struct Between {
  Eigen::Index lower, upper;
  double part;
};

Between locate(const std::vector<double>& axis, double x) {
  const auto last = std::ssize(axis) - 1;
  if (x <= axis.front()) return {0, 0, 0.0};
  if (x >= axis.back()) return {last, last, 0.0};
  const auto i = static_cast<Eigen::Index>(std::ranges::upper_bound(axis, x) - axis.begin());
  const double a = axis[static_cast<std::size_t>(i - 1)], b = axis[static_cast<std::size_t>(i)];
  return {i - 1, i, (x - a) / (b - a)};
}

double interpolate(const Eigen::MatrixXd& value, const Between& row, const Between& column) {
  const auto along = [&](Eigen::Index r) {
    return (1.0 - column.part) * value(r, column.lower) + column.part * value(r, column.upper);
  };
  return (1.0 - row.part) * along(row.lower) + row.part * along(row.upper);
}

}  // namespace

DerivativeTable::DerivativeTable(Convention convention, std::vector<double> alpha_rad, std::array<DerivativeCurve, 18> curves,
                                 std::string source, OutOfRange below, OutOfRange above)
    : convention_(convention),
      alpha_rad_(std::move(alpha_rad)),
      curves_(std::move(curves)),
      source_(std::move(source)),
      below_(below),
      above_(above) {
  if (!ascends(alpha_rad_))
    throw InputError({source_, 0, "alpha_deg"}, "is empty or does not ascend", "sort the angles of attack");
  for (int i = 0; i < 18; ++i) {
    const DerivativeCurve& curve = curves_[static_cast<std::size_t>(i)];
    if (!ascends(curve.v_over_omegaB) || curve.v_over_omegaB.front() <= 0.0)
      throw InputError({source_, 0, name_of(convention, i)}, "its reduced velocities are empty, not positive or do not ascend",
                       "give positive reduced velocities in ascending order");
    if (curve.value.rows() != std::ssize(alpha_rad_) || curve.value.cols() != std::ssize(curve.v_over_omegaB))
      throw InputError({source_, 0, name_of(convention, i)}, "has no value for each angle of attack and reduced velocity",
                       "give the full grid");
  }
}

bool DerivativeTable::covers_angle(double alpha_rad) const {
  // A table with a single angle of attack comes from a test at that angle only. It is used at every angle.
  return alpha_rad_.size() == 1 || (alpha_rad >= alpha_rad_.front() && alpha_rad <= alpha_rad_.back());
}

bool DerivativeTable::covers_velocity(const DerivativeCurve& curve, double v) const {
  const std::vector<double>& axis = curve.v_over_omegaB;
  return (v >= axis.front() || below_ == OutOfRange::hold) && (v <= axis.back() || above_ == OutOfRange::hold);
}

bool DerivativeTable::covers(double alpha_rad, double v) const {
  return covers_angle(alpha_rad) &&
         std::ranges::all_of(curves_, [&](const DerivativeCurve& curve) { return covers_velocity(curve, v); });
}

DerivativeBlock DerivativeTable::at(double alpha_rad, double v) const {
  if (!covers_angle(alpha_rad))
    throw InputError({source_, 0, "alpha_deg"},
                     fmt::format("covers {:.6g} to {:.6g} degrees, {:.6g} is needed", alpha_rad_.front() * degrees,
                                 alpha_rad_.back() * degrees, alpha_rad * degrees),
                     "extend the table, or lower the wind's angle of attack");
  const Between row = locate(alpha_rad_, alpha_rad);
  Derivatives18 values{};
  const std::vector<double>* last_axis = nullptr;
  Between column{0, 0, 0.0};
  for (int i = 0; i < 18; ++i) {
    const DerivativeCurve& curve = curves_[static_cast<std::size_t>(i)];
    const std::vector<double>& axis = curve.v_over_omegaB;
    if (!covers_velocity(curve, v))
      throw InputError(
          {source_, 0, name_of(convention_, i)},
          fmt::format("covers V/(omega B) from {:.6g} to {:.6g} (V/(f B) {:.6g} to {:.6g}), {:.6g} is needed", axis.front(),
                      axis.back(), 2 * std::numbers::pi * axis.front(), 2 * std::numbers::pi * axis.back(), v),
          "extend the table, narrow the speeds, or ask for the end values by `hold`");
    if (last_axis == nullptr || *last_axis != axis) column = locate(axis, v);
    last_axis = &axis;
    values[static_cast<std::size_t>(i)] = interpolate(curve.value, row, column);
  }
  return to_block(convention_, values, v);
}

DerivativeTable DerivativeTable::scaled(double factor) const {
  DerivativeTable out = *this;
  for (DerivativeCurve& curve : out.curves_) curve.value *= factor;
  return out;
}

std::pair<double, double> DerivativeTable::range_v_over_omegaB() const {
  std::pair<double, double> range = {curves_[0].v_over_omegaB.front(), curves_[0].v_over_omegaB.back()};
  for (const DerivativeCurve& curve : curves_) {
    range.first = std::max(range.first, curve.v_over_omegaB.front());
    range.second = std::min(range.second, curve.v_over_omegaB.back());
  }
  return range;
}

}  // namespace twindeck::aero
