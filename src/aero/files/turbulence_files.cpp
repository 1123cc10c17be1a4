#include "aero/files/turbulence_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "io/csv.hpp"

namespace twindeck::aero {

namespace {

constexpr double kVarianceTolerance = 0.05;  ///< [-] of a spectrum's integral: sigma is then off by 2.5 % at most
constexpr double kLastCoherence = 0.01;      ///< [-] largest in the last row: one interval further the coherence is 0
constexpr double kCoherenceAtZero = 1e-9;    ///< [-] how closely the first row has to be 1

/// The rows of one component, in the order of the file.
struct Curve {
  std::vector<std::size_t> rows;
  Eigen::VectorXd x, y;
};

/// @throws InputError  for an unknown letter, x that do not ascend, a wanted component with fewer than two rows
std::array<Curve, 3> read_curves(const io::CsvTable& table, const std::filesystem::path& file, const std::string& x,
                                 const std::string& y, const std::vector<wind::Component>& wanted) {
  std::array<Curve, 3> curves;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string letter = table.text(row, "component");
    Curve* curve = nullptr;
    for (const wind::Component c : wind::components)
      if (letter == wind::paper_letter(c)) curve = &curves[static_cast<std::size_t>(c)];
    if (curve == nullptr)
      table.fail(row, "component", "is '" + letter + "'", "write v (along the wind), u (across it) or w (vertical)");
    const Eigen::Index n = curve->x.size();
    curve->rows.push_back(row);
    curve->x.conservativeResize(n + 1);
    curve->y.conservativeResize(n + 1);
    curve->x[n] = table.number(row, x);
    curve->y[n] = table.number(row, y);
    if (n > 0 && !(curve->x[n] > curve->x[n - 1]))
      table.fail(row, x, fmt::format("is {} after {}, expected rows that ascend", curve->x[n], curve->x[n - 1]),
                 "sort the rows of each component, and take repeated ones out");
  }
  for (const wind::Component c : wind::components) {
    const auto rows = curves[static_cast<std::size_t>(c)].rows.size();
    if (rows < 2 && (rows > 0 || contains(wanted, c)))
      throw InputError({file.string(), 0, "component"},
                       fmt::format("has too few rows of {} ({}), expected at least two", wind::paper_letter(c), rows),
                       fmt::format("add rows with component = {}", wind::paper_letter(c)));
  }
  return curves;
}

}  // namespace

wind::TurbulenceSet read_turbulence_set(const std::filesystem::path& file, const std::string& name) {
  std::vector<std::string> columns = {
      "set",           "roughness_m", "minimum_height_m", "kappa", "sigma_u_over_v", "sigma_w_over_v", "scale_u_over_v",
      "scale_w_over_v"};
  for (const wind::Component c : wind::components)
    for (const char* axis : {"along", "across", "vertical"}) columns.push_back("decay_" + wind::paper_letter(c) + "_" + axis);
  const io::CsvTable table = io::CsvTable::read(file, columns, {"code"});
  std::vector<std::string> known;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    known.push_back(table.text(row, "set"));
    if (known.back() != name) continue;
    const auto positive = [&](const std::string& column) {
      const double value = table.number(row, column);
      if (!(value > 0.0)) table.fail(row, column, fmt::format("is {}, expected a positive number", value));
      return value;
    };
    wind::TurbulenceSet set{
        .name = name, .roughness_m = positive("roughness_m"), .minimum_height_m = positive("minimum_height_m")};
    if (set.minimum_height_m <= set.roughness_m) table.fail(row, "minimum_height_m", "lies below the roughness length");
    set.kappa = positive("kappa");
    set.sigma_ratio = {1.0, positive("sigma_u_over_v"), positive("sigma_w_over_v")};
    set.scale_ratio = {1.0, positive("scale_u_over_v"), positive("scale_w_over_v")};
    for (const wind::Component c : wind::components) {
      const std::string decay = "decay_" + wind::paper_letter(c) + "_";
      set.decay[static_cast<std::size_t>(c)] = {positive(decay + "along"), positive(decay + "across"),
                                                positive(decay + "vertical")};
    }
    return set;
  }
  throw InputError({file.string(), 0, "set"}, "has no set '" + name + "'" + did_you_mean(name, known),
                   fmt::format("choose one of {}", fmt::join(known, ", ")));
}

std::array<std::shared_ptr<const wind::SpectrumTable>, 3> read_spectra(const std::filesystem::path& file,
                                                                       const std::vector<wind::Component>& wanted) {
  const std::string at = "f_L_over_V", value = "f_S_over_variance";
  const io::CsvTable table = io::CsvTable::read(file, {"component", at, value});
  const std::array<Curve, 3> curves = read_curves(table, file, at, value, wanted);
  std::array<std::shared_ptr<const wind::SpectrumTable>, 3> out;
  for (const wind::Component c : wind::components) {
    const Curve& curve = curves[static_cast<std::size_t>(c)];
    for (std::size_t i = 0; i < curve.rows.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      for (const auto& [column, number] : {std::pair{at, curve.x[k]}, std::pair{value, curve.y[k]}})
        if (!(number > 0.0)) table.fail(curve.rows[i], column, fmt::format("is {}, expected a positive number", number));
    }
    if (curve.rows.empty()) continue;
    auto spectrum = std::make_shared<const wind::SpectrumTable>(curve.x, curve.y);
    if (const double sum = spectrum->variance(); !(std::abs(sum - 1.0) <= kVarianceTolerance))
      throw InputError(
          {file.string(), 0, value},
          fmt::format("of {} integrates to {:.4g} of the variance, expected 1 within {}", wind::paper_letter(c), sum,
                      kVarianceTolerance),
          "divide f S, one-sided in Hz, by the variance of the same record; give rows until f S is small at both ends");
    out[static_cast<std::size_t>(c)] = std::move(spectrum);
  }
  return out;
}

std::array<std::shared_ptr<const wind::CoherenceTable>, 3> read_coherences(const std::filesystem::path& file,
                                                                           const std::vector<wind::Component>& wanted) {
  const std::string at = "reduced_separation", value = "coherence";
  const io::CsvTable table = io::CsvTable::read(file, {"component", at, value});
  const std::array<Curve, 3> curves = read_curves(table, file, at, value, wanted);
  std::array<std::shared_ptr<const wind::CoherenceTable>, 3> out;
  for (const wind::Component c : wind::components) {
    const Curve& curve = curves[static_cast<std::size_t>(c)];
    if (curve.rows.empty()) continue;
    for (std::size_t i = 0; i < curve.rows.size(); ++i)
      if (const double gamma = curve.y[static_cast<Eigen::Index>(i)]; !(std::abs(gamma) <= 1.0))
        table.fail(curve.rows[i], value, fmt::format("is {}, expected a number from -1 to 1", gamma));
    if (curve.x[0] != 0.0 || !(std::abs(curve.y[0] - 1.0) <= kCoherenceAtZero))
      table.fail(curve.rows.front(), value, fmt::format("is {} at {}, expected 1 at 0", curve.y[0], curve.x[0]),
                 "begin each component with the separation 0");
    const Eigen::Index last = curve.y.size() - 1;
    if (std::abs(curve.y[last]) > kLastCoherence)
      table.fail(curve.rows.back(), value,
                 fmt::format("is {} in the last row of {}, expected at most {}: it ends at 0 one interval further",
                             curve.y[last], wind::paper_letter(c), kLastCoherence),
                 "go on to where the coherence has died out");
    // A jump to 0 would make it none: it ends one interval further.
    Eigen::VectorXd x(last + 2), gamma(last + 2);
    x << curve.x, 2.0 * curve.x[last] - curve.x[last - 1];
    gamma << curve.y, 0.0;
    gamma[0] = 1.0;
    out[static_cast<std::size_t>(c)] = std::make_shared<const wind::CoherenceTable>(std::move(x), std::move(gamma));
  }
  return out;
}

}  // namespace twindeck::aero
