#include "model_io/modes_io.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>

#include "core/error.hpp"
#include "io/csv.hpp"
#include "io/spreadsheet.hpp"
#include "linalg/canonical_basis.hpp"
#include "matching/mode_name.hpp"
#include "model_io/names.hpp"

namespace twindeck::model_io {
namespace {

constexpr double kLargest = 1e15;             ///< of a component in any norm; squares of sums stay within doubles
constexpr double kHighestFrequency_Hz = 1e6;  ///< far above what any structure is tested at
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

std::optional<double> known(double value) { return std::isfinite(value) ? std::optional<double>(value) : std::nullopt; }
std::optional<double> percent(double ratio) { return known(100.0 * ratio); }

/// The component that becomes 1; 1 where there is none.
std::complex<double> largest_component(const Eigen::Ref<const Eigen::VectorXcd>& shape) {
  if (shape.size() == 0 || shape.isZero(0.0)) return 1.0;
  return shape[linalg::leading_entry(shape.cwiseAbs())];
}

void write_shapes(const modal::ModeSet& modes, const std::filesystem::path& file) {
  const bool complex = (modes.shapes.imag().array() != 0.0).any();
  std::vector<std::string> columns = {"mode", "point", "direction", "value"};
  if (complex) columns.emplace_back("value_imag");
  io::CsvWriter writer(columns);
  for (Eigen::Index mode = 0; mode < modes.size(); ++mode) {
    const Eigen::VectorXcd shape = modes.shapes.col(mode) / largest_component(modes.shapes.col(mode));
    for (std::size_t i = 0; i < modes.dofs.size(); ++i) {
      const std::complex<double> value = shape[static_cast<Eigen::Index>(i)];
      std::vector<io::Cell> row = {modes.names[static_cast<std::size_t>(mode)], modes.dofs[i].point, modes.dofs[i].direction,
                                   value.real()};
      if (complex) row.emplace_back(value.imag());
      writer.row(row);
    }
  }
  writer.save(file);
}

/// Of a shape, in any norm.
double component(const io::CsvTable& table, std::size_t row, const std::string& column) {
  const double value = column == "value" ? table.number(row, column) : table.number_or(row, column, 0.0);
  if (std::abs(value) > kLargest)
    table.fail(row, column, fmt::format("is {}, expected a magnitude of at most {:g}", table.text(row, column), kLargest),
               "scale the shape so that its largest component is 1");
  return value;
}

void read_shapes(const std::filesystem::path& file, const std::set<std::string>& left_out, modal::ModeSet& modes) {
  const auto table = io::CsvTable::read(file, {"mode", "point", "direction", "value"}, {"value_imag"}, true);
  std::map<std::string, Eigen::Index> mode_at;
  for (std::size_t i = 0; i < modes.names.size(); ++i) mode_at.emplace(modes.names[i], static_cast<Eigen::Index>(i));
  std::map<std::pair<std::string, std::string>, Eigen::Index> dof_at;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (left_out.contains(table.text(row, "mode"))) continue;
    const modal::ShapeDof dof{table.text(row, "point"), table.text(row, "direction")};
    if (dof_at.emplace(std::pair{dof.point, dof.direction}, std::ssize(modes.dofs)).second) modes.dofs.push_back(dof);
  }
  const auto n = std::ssize(modes.dofs);
  modes.shapes = Eigen::MatrixXcd::Constant(n, modes.size(), kUnknown);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (left_out.contains(table.text(row, "mode"))) continue;
    const auto mode = mode_at.find(table.text(row, "mode"));
    if (mode == mode_at.end())
      table.fail(row, "mode",
                 fmt::format("mode '{}' is not in modes.csv{}", table.text(row, "mode"),
                             did_you_mean(table.text(row, "mode"), modes.names)),
                 "shapes.csv lists modes of modes.csv");
    auto& value = modes.shapes(dof_at.at({table.text(row, "point"), table.text(row, "direction")}), mode->second);
    if (!std::isnan(value.real()))
      table.fail(row, "point", "this component of the mode stands twice", "remove one of the two rows");
    value = {component(table, row, "value"), component(table, row, "value_imag")};
  }
  for (Eigen::Index mode = 0; mode < modes.size(); ++mode) {
    if (n > 0 && modes.shapes.col(mode).isZero(0.0))
      throw InputError({file.string(), 0, "mode " + modes.names[static_cast<std::size_t>(mode)]},
                       "has a shape that is zero everywhere", "give its measured components, or take its rows out");
    for (Eigen::Index i = 0; i < n; ++i) {
      if (!std::isnan(modes.shapes(i, mode).real())) continue;
      const auto& dof = modes.dofs[static_cast<std::size_t>(i)];
      throw InputError({file.string(), 0, "mode " + modes.names[static_cast<std::size_t>(mode)]},
                       fmt::format("has no value at point {} direction {}, which another mode has", dof.point, dof.direction),
                       "give every mode the same components");
    }
  }
}

}  // namespace

void write_modes(const modal::ModeSet& modes, const std::filesystem::path& folder) {
  io::CsvWriter writer({"mode", "frequency_Hz", "frequency_std_Hz", "damping_ratio_pct", "damping_ratio_std_pct"});
  const auto at = [](const Eigen::VectorXd& v, Eigen::Index i) { return i < v.size() ? v[i] : kUnknown; };
  for (Eigen::Index i = 0; i < modes.size(); ++i)
    writer.row({modes.names[static_cast<std::size_t>(i)], modes.frequency_Hz[i], known(at(modes.frequency_std_Hz, i)),
                percent(at(modes.damping_ratio, i)), percent(at(modes.damping_ratio_std, i))});
  writer.save(folder / "modes.csv");
  if (modes.has_shapes()) write_shapes(modes, folder / "shapes.csv");
}

modal::ModeSet read_modes(const std::filesystem::path& folder, std::vector<long>* lines) {
  const auto table = io::CsvTable::read(folder / "modes.csv", {"mode", "frequency_Hz"},
                                        {"frequency_std_Hz", "damping_ratio_pct", "damping_ratio_std_pct"}, true);
  // A mode that some setups did not see has a shape with holes; it is listed for people and not for comparisons.
  std::set<std::string> left_out;
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (table.text(row, "partial") == "1") left_out.insert(table.text(row, "mode"));
  Eigen::Index n = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) n += left_out.contains(table.text(row, "mode")) ? 0 : 1;
  modal::ModeSet modes;
  for (auto* values : {&modes.frequency_Hz, &modes.frequency_std_Hz, &modes.damping_ratio, &modes.damping_ratio_std})
    values->resize(n);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string name = table.text(row, "mode");
    if (left_out.contains(name)) continue;
    if (name.empty()) table.fail(row, "mode", "is empty", "name the mode");
    if (!matching::is_mode_name(name))
      table.fail(row, "mode", fmt::format("is '{}', expected a whole number from 1 on, or a name that is no number", name),
                 "number or name the mode");
    if (position_of(name, modes.names) >= 0)
      table.fail(row, "mode", fmt::format("mode '{}' appears twice", name), "give each mode a name of its own");
    modes.names.push_back(name);
    if (lines != nullptr) lines->push_back(table.line(row));
    const auto i = std::ssize(modes.names) - 1;
    modes.frequency_Hz[i] = table.number(row, "frequency_Hz");
    if (modes.frequency_Hz[i] < 0.0 || modes.frequency_Hz[i] > kHighestFrequency_Hz)
      table.fail(row, "frequency_Hz",
                 fmt::format("is {}, expected a value from 0 to {:g}", table.text(row, "frequency_Hz"), kHighestFrequency_Hz),
                 "frequencies are in Hz");
    modes.frequency_std_Hz[i] = table.number_or(row, "frequency_std_Hz", kUnknown);
    if (modes.frequency_std_Hz[i] > kHighestFrequency_Hz)
      table.fail(row, "frequency_std_Hz",
                 fmt::format("is {}, expected at most {:g}", table.text(row, "frequency_std_Hz"), kHighestFrequency_Hz),
                 "state it in Hz");
    modes.damping_ratio[i] = table.number_or(row, "damping_ratio_pct", kUnknown) / 100.0;
    if (modes.damping_ratio[i] < 0.0 || modes.damping_ratio[i] >= 1.0)
      table.fail(row, "damping_ratio_pct",
                 fmt::format("is {}, expected a value from 0 to below 100", table.text(row, "damping_ratio_pct")),
                 "a mode that vibrates is damped less than critically; give the ratio in per cent");
    modes.damping_ratio_std[i] = table.number_or(row, "damping_ratio_std_pct", kUnknown) / 100.0;
  }
  if (io::has_table(folder / "shapes.csv")) read_shapes(folder / "shapes.csv", left_out, modes);
  return modes;
}

modal::ModeSet to_mode_set(const fe::Model* model, const fe::ParametricSystem& system, const dynamics::EigenModes& modes) {
  const Eigen::Index n = modes.frequency_Hz.size();
  modal::ModeSet set;
  for (Eigen::Index i = 0; i < n; ++i) set.names.push_back(std::to_string(i + 1));
  set.frequency_Hz = modes.frequency_Hz;
  set.frequency_std_Hz = set.damping_ratio = set.damping_ratio_std = Eigen::VectorXd::Constant(n, kUnknown);
  if (model == nullptr) {
    for (const auto& dof : system.dofs) set.dofs.push_back({dof.node, direction_names()[fe::slot(dof.direction)]});
    set.shapes = modes.shapes.cast<std::complex<double>>();
    return set;
  }
  set.shapes = system.expand(modes.shapes).cast<std::complex<double>>();
  for (const auto& node : model->nodes)
    for (const auto& direction : direction_names()) set.dofs.push_back({std::to_string(node.id), direction});
  TWINDECK_ASSERT(set.shapes.rows() == std::ssize(set.dofs));
  return set;
}

modal::ModeSet published_modes(const fe::Model* model, const fe::ParametricSystem& system, const dynamics::EigenModes& modes) {
  modal::ModeSet all = to_mode_set(model, system, modes);
  if (model == nullptr) return all;
  modal::ModeSet kept = all;
  kept.dofs.clear();
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < all.dofs.size(); ++i) {
    if (all.dofs[i].direction.front() == 'r') continue;
    kept.dofs.push_back(all.dofs[i]);
    rows.push_back(static_cast<Eigen::Index>(i));
  }
  kept.shapes = all.shapes(rows, Eigen::all);
  return kept;
}

}  // namespace twindeck::model_io
