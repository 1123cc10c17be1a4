#include "aero/files/aero_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/units.hpp"
#include "io/csv.hpp"

namespace twindeck::aero {
namespace {

/// A number without a dimension.
double coefficient(const io::CsvTable& table, std::size_t row, const std::string& column) {
  constexpr double largest = 1e6;  // of derivatives at high reduced velocities, which grow with its square, and of the velocity
  const double value = table.number(row, column);
  if (std::abs(value) > largest)
    table.fail(row, column, fmt::format("is {}, expected a magnitude of at most {:g}", table.text(row, column), largest),
               "coefficients and reduced velocities have no dimension");
  return value;
}

std::string reduced_velocity_column(const io::CsvTable& table) {
  const bool f = table.has("V_over_fB"), omega = table.has("V_over_omegaB");
  if (f != omega) return f ? "V_over_fB" : "V_over_omegaB";
  for (const std::string& column : table.columns())
    if (!f && (column.starts_with("V") || column.starts_with("U") || column.starts_with("K")))
      throw InputError({table.file().string(), 1, column},
                       "does not say which reduced velocity it is: the two in use differ by 2 pi",
                       "name the column V_over_fB or V_over_omegaB");
  throw InputError({table.file().string(), 1, "V_over_fB"},
                   f ? "stands beside V_over_omegaB, expected one of them" : "is missing, and so is V_over_omegaB",
                   "give the reduced velocity in one column named V_over_fB or V_over_omegaB");
}

Convention convention_of(const io::CsvTable& table) {
  const bool zasso = table.has("h1"), scanlan = table.has("H1");
  if (zasso == scanlan)
    throw InputError({table.file().string(), 1, "h1"}, zasso ? "stands beside H1: two conventions" : "is missing, and so is H1",
                     "give h1 ... a6 (Zasso) or H1 ... A6 (Scanlan)");
  return zasso ? Convention::zasso : Convention::scanlan;
}

// Central differences inside, one-sided at the ends.
void fill_slopes(const std::vector<double>& alpha, std::vector<StaticCoefficients>& rows) {
  const std::size_t last = rows.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const std::size_t a = i == 0 ? 0 : i - 1, b = std::min(i + 1, last);
    const double h = alpha[b] - alpha[a];
    rows[i].drag_slope = h > 0.0 ? (rows[b].drag - rows[a].drag) / h : 0.0;
    rows[i].lift_slope = h > 0.0 ? (rows[b].lift - rows[a].lift) / h : 0.0;
    rows[i].moment_slope = h > 0.0 ? (rows[b].moment - rows[a].moment) / h : 0.0;
  }
}

}  // namespace

Polar read_polar(const std::filesystem::path& file) {
  const std::vector<std::string> slopes = {"dC_D_per_rad", "dC_L_per_rad", "dC_M_per_rad"};
  const io::CsvTable table = io::CsvTable::read(file, {"alpha_deg", "C_D", "C_L", "C_M"}, slopes);
  const auto given = std::ranges::count_if(slopes, [&](const std::string& name) { return table.has(name); });
  if (given != 0 && given != 3)
    throw InputError({file.string(), 1, "dC_L_per_rad"}, "only some of the three slopes are given", "give all three or none");
  if (table.rows() == 1)
    throw InputError({file.string(), 2, "alpha_deg"}, "is the only angle of attack, expected two or more",
                     "add the angles that the deck turns to");
  std::vector<double> alpha;
  std::vector<StaticCoefficients> rows;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    alpha.push_back(table.number(i, "alpha_deg") * radians);
    StaticCoefficients row{
        coefficient(table, i, "C_D"), coefficient(table, i, "C_L"), coefficient(table, i, "C_M"), 0.0, 0.0, 0.0};
    if (given == 3) {
      row.drag_slope = coefficient(table, i, slopes[0]);
      row.lift_slope = coefficient(table, i, slopes[1]);
      row.moment_slope = coefficient(table, i, slopes[2]);
    }
    rows.push_back(row);
    if (i > 0 && alpha[i] <= alpha[i - 1]) table.fail(i, "alpha_deg", "does not ascend", "sort the rows by angle of attack");
  }
  if (rows.empty()) throw InputError({file.string(), 1, "alpha_deg"}, "no row follows the header", "give the coefficients");
  if (given == 0) fill_slopes(alpha, rows);
  return {std::move(alpha), std::move(rows), file.string()};
}

DerivativeTable read_flutter_derivatives(const std::filesystem::path& file, OutOfRange below, OutOfRange above) {
  const io::CsvTable table = io::CsvTable::read(file, {}, {}, true);
  const std::string velocity = reduced_velocity_column(table);
  const Convention convention = convention_of(table);
  for (int i = 0; i < 18; ++i)
    if (!table.has(name_of(convention, i)))
      throw InputError({file.string(), 1, name_of(convention, i)}, "is missing; all eighteen derivatives are needed",
                       "add the column, with 0 where it was not measured");
  const double to_omega = velocity == "V_over_fB" ? 1.0 / (2.0 * std::numbers::pi) : 1.0;

  std::map<std::pair<double, double>, std::size_t> row_at;
  std::vector<double> alpha, speed;
  const auto add = [](std::vector<double>& axis, double value) {
    const auto place = std::ranges::lower_bound(axis, value);
    if (place == axis.end() || *place != value) axis.insert(place, value);
  };
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double a = table.has("alpha_deg") ? table.number(i, "alpha_deg") * radians : 0.0;
    const double v = coefficient(table, i, velocity) * to_omega;
    if (!(v > 0.0)) table.fail(i, velocity, "is not positive", "a reduced velocity is V over frequency times chord");
    if (!row_at.emplace(std::pair{a, v}, i).second)
      table.fail(i, velocity, "stands twice at this angle of attack", "keep one of the rows");
    add(alpha, a);
    add(speed, v);
  }
  if (row_at.size() != alpha.size() * speed.size() || row_at.empty())
    throw InputError({file.string(), 0, velocity},
                     "the rows are not a full grid: " + std::to_string(row_at.size()) + " rows for " +
                         std::to_string(alpha.size()) + " angles and " + std::to_string(speed.size()) + " reduced velocities",
                     "give each angle of attack the same reduced velocities");
  std::array<DerivativeCurve, 18> curves;
  for (std::size_t d = 0; d < 18; ++d) {
    curves[d].v_over_omegaB = speed;
    curves[d].value.resize(std::ssize(alpha), std::ssize(speed));
    for (std::size_t i = 0; i < alpha.size(); ++i)
      for (std::size_t j = 0; j < speed.size(); ++j)
        curves[d].value(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            coefficient(table, row_at.at({alpha[i], speed[j]}), name_of(convention, static_cast<int>(d)));
  }
  return {convention, std::move(alpha), std::move(curves), file.string(), below, above};
}

}  // namespace twindeck::aero
