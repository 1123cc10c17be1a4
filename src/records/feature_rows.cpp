#include "records/feature_rows.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "io/npy.hpp"
#include "matching/mode_name.hpp"

namespace twindeck::records {
namespace {

constexpr double highest_frequency_Hz = 1e6;  ///< far above what any structure is tested at; its square is a harmless number
constexpr double critical_damping_pct = 100.0;
constexpr double largest_value = 1e15;  ///< [SI] of any row: beyond it products of a few values leave the range of doubles
/// [-] Nothing is measured to twelve digits. Weights are squares of the inverse.
constexpr double least_relative_std = 1e-12;

bool is_frequency(const FeatureRow& row) { return row.type == "frequency_Hz" || row.type == "stay_frequency_Hz"; }

bool may_be_negative(const FeatureRow& row) { return row.is_shape() || row.is_static(); }

/// The condition or channel that a cell names.
template <class Part>
const Part& named(const io::CsvTable& table, std::size_t at, const std::string& column, const std::vector<Part>& parts,
                  const std::string& file) {
  const std::string text = table.text(at, column);
  if (const auto found = std::ranges::find(parts, text, &Part::name); found != parts.end()) return *found;
  table.fail(at, column,
             fmt::format("{} '{}' is not in {}{}", column, text, file, did_you_mean(text, each_of(parts, &Part::name))),
             "add it there, or mend the name");
}

double read_value(const io::CsvTable& table, std::size_t at, const FeatureRow& row) {
  const double value = table.number(at, "value");
  const std::string given = table.text(at, "value");
  if (!may_be_negative(row) && value <= 0.0)
    table.fail(at, "value", fmt::format("is {}, expected a {} above 0", given, is_frequency(row) ? "frequency" : "value"),
               "mend the value, or take the row out");
  if (row.type == "damping_ratio_pct" && value >= critical_damping_pct)
    table.fail(at, "value", fmt::format("is {}, expected a damping ratio below {:g} %", given, critical_damping_pct),
               "a mode that vibrates is damped less than critically; give the ratio in per cent");
  if (is_frequency(row) && value > highest_frequency_Hz)
    table.fail(at, "value", fmt::format("is {}, expected a frequency of at most {:g} Hz", given, highest_frequency_Hz),
               "give it in hertz");
  if (std::abs(value) > largest_value)
    table.fail(at, "value", fmt::format("is {}, expected a magnitude of at most {:g}", given, largest_value), "mend the value");
  return value;
}

double read_std(const io::CsvTable& table, std::size_t at, const FeatureRow& row) {
  const std::optional<double> std = table.number_if(at, "std");
  if (!std || *std <= 0.0)
    table.fail(at, "std", std ? fmt::format("is {}, expected a value above 0", table.text(at, "std")) : "is empty",
               "state the standard deviation of the value; a row without one can't be weighed");
  if (*std > largest_value || *std < least_relative_std * std::abs(row.value))
    table.fail(at, "std",
               fmt::format("is {}, expected at most {:g} and at least {:g} of the value", table.text(at, "std"), largest_value,
                           least_relative_std),
               "state the standard deviation in the unit of the value");
  return *std;
}

std::string read_mode(const io::CsvTable& table, std::size_t at, const FeatureRow& row) {
  const std::string mode = table.text(at, "mode");
  if (row.is_modal() && mode.empty()) table.fail(at, "mode", "is empty", "name the mode that the row belongs to");
  if (!matching::is_mode_name(mode))
    table.fail(at, "mode", fmt::format("is '{}', expected a whole number from 1 on, or a name that is no number", mode),
               "give every row of one mode the same number");
  if (row.type == "stay_frequency_Hz" && (mode.empty() || mode.find_first_not_of("0123456789") != std::string::npos))
    table.fail(at, "mode", fmt::format("is '{}', expected the harmonic of the stay, a whole number from 1 on", mode),
               "1 is the stay's lowest frequency");
  return mode;
}

/// Refuses a row of a load test whose channel cannot measure it.
void check_gauge(const io::CsvTable& table, std::size_t at, const FeatureRow& row,
                 const std::vector<matching::Channel>& channels) {
  const auto channel = std::ranges::find(channels, row.channel, &matching::Channel::name);
  const std::string needed = row.type == "static_strain"    ? "an element"
                             : row.type == "static_force_N" ? "a support"
                                                            : "a point";
  const bool there = row.type == "static_strain"    ? !channel->element.empty()
                     : row.type == "static_force_N" ? !channel->support.empty()
                                                    : channel->is_at_a_point();
  if (!there)
    table.fail(at, "channel",
               fmt::format("a row of type {} needs a channel at {}, which '{}' is not", row.type, needed, row.channel),
               "fill channels.csv: element, xi, y_m, z_m for a strain; support, dx, dy, dz for a force; a point or x_m, y_m, "
               "z_m for others");
}

FeatureRow read_row(const io::CsvTable& table, std::size_t at, const std::vector<MeasuredCondition>& conditions,
                    const std::vector<matching::Channel>& channels, bool has_covariance) {
  FeatureRow row;
  row.line = table.line(at);
  row.type = table.text(at, "type");
  if (const std::vector<std::string>& types = feature_types(); !contains(types, row.type))
    table.fail(at, "type", fmt::format("'{}' is not a known type of row{}", row.type, did_you_mean(row.type, types)),
               fmt::format("use {}", fmt::join(types, ", ")));
  row.mode = read_mode(table, at, row);
  const MeasuredCondition& condition = named(table, at, "condition", conditions, "conditions.toml");
  row.condition = condition.name;
  row.channel = table.text(at, "channel");
  if (row.is_shape() || (!row.is_modal() && row.type != "stay_frequency_Hz"))
    row.channel = named(table, at, "channel", channels, "channels.csv").name;
  if (row.is_static() && condition.load.empty())
    table.fail(at, "type", fmt::format("a row of type {} needs a load, but condition '{}' names none", row.type, row.condition),
               "name a load case of the model's loads.csv in conditions.toml: load = \"…\"");
  row.value = read_value(table, at, row);
  if (row.is_static()) check_gauge(table, at, row, channels);
  if (!has_covariance) row.std = read_std(table, at, row);
  const double held_out = table.number_or(at, "held_out", 0.0);
  if (held_out != 0.0 && held_out != 1.0)
    table.fail(at, "held_out", fmt::format("is {}, expected 0 or 1", table.text(at, "held_out")),
               "1 keeps the row from the fit, 0 or nothing uses it");
  row.held_out = held_out == 1.0;
  return row;
}

/// What a row measures, in the columns that count for its type.
std::string quantity_of(const FeatureRow& row) {
  const bool by_mode = row.is_modal() || row.type == "stay_frequency_Hz";
  const bool by_channel = row.type != "frequency_Hz" && row.type != "damping_ratio_pct";
  return fmt::format("{}|{}|{}|{}", row.type, row.condition, by_mode ? row.mode : "", by_channel ? row.channel : "");
}

void refuse_duplicates(const FeatureRows& read) {
  std::map<std::string, std::size_t> seen;
  for (std::size_t at = 0; at < read.rows.size(); ++at) {
    const auto [first, is_new] = seen.emplace(quantity_of(read.rows[at]), at);
    if (!is_new)
      read.table.fail(at, "type",
                      fmt::format("this row stands twice: {} {} {} in condition '{}' is row {} already", read.rows[at].type,
                                  read.rows[at].mode, read.rows[at].channel, read.rows[at].condition, first->second + 1),
                      "remove one of the two");
  }
}

void refuse_shapes_of_zeros(const FeatureRows& read) {
  struct Shape {
    std::size_t first = 0;
    double largest = 0.0;
  };
  std::map<std::pair<std::string, std::string>, Shape> shapes;
  for (std::size_t at = 0; at < read.rows.size(); ++at) {
    const FeatureRow& row = read.rows[at];
    if (!row.is_shape()) continue;
    Shape& shape = shapes.try_emplace({row.condition, row.mode}, Shape{at, 0.0}).first->second;
    shape.largest = std::max(shape.largest, std::abs(row.value));
  }
  for (const auto& [name, shape] : shapes)
    if (shape.largest == 0.0)
      read.table.fail(shape.first, "value",
                      fmt::format("the shape of mode {} in condition '{}' is zero at every channel", name.second, name.first),
                      "give its measured components, or take the rows out");
}

using Eigen::Index;

constexpr double asymmetry = 1e-9;        ///< [-] of sqrt(c_ii c_jj): rounding and single precision
constexpr double least_share = 1e-12;     ///< [-] of a variance that the earlier rows must leave unexplained; less is rounding
constexpr double least_variance = 1e-60;  ///< [SI²] the inverse of a smaller variance is too large to compute with
constexpr double most_variance = 1e30;    ///< [SI²]

struct Refusal {
  const std::filesystem::path& file;
  [[noreturn]] void operator()(const std::string& problem, const std::string& mend) const {
    throw InputError({file.string(), 0, ""}, problem, mend);
  }
};

/// Whether each of the first `n` rows keeps at least `least_share` of its variance, given the rows before it.
bool leading_part_is_definite(const Eigen::MatrixXd& correlation, Index n) {
  const Eigen::LLT<Eigen::MatrixXd> factor(correlation.topLeftCorner(n, n));
  if (factor.info() != Eigen::Success) return false;
  return (factor.matrixLLT().diagonal().array().square() > least_share).all();
}

/// The first row at which the elimination breaks down, which is the last row of the smallest leading part that is not definite.
Index first_dependent_row(const Eigen::MatrixXd& correlation) {
  Index definite = 0, broken = correlation.rows();
  while (broken - definite > 1) {
    const Index middle = (definite + broken) / 2;
    (leading_part_is_definite(correlation, middle) ? definite : broken) = middle;
  }
  return broken - 1;
}

void check_entries(const Eigen::MatrixXd& c, const Refusal& refuse) {
  for (Index i = 0; i < c.rows(); ++i)
    if (!std::isfinite(c(i, i)) || c(i, i) < least_variance || c(i, i) > most_variance)
      refuse(fmt::format("the variance of row {} of rows.csv is {:g}, expected a positive number from {:g} to {:g}", i + 1,
                         c(i, i), least_variance, most_variance),
             "entry (i, i) is the square of the standard deviation of row i, in the row's unit");
  for (Index i = 0; i < c.rows(); ++i) {
    for (Index j = 0; j < i; ++j) {
      const double scale = std::sqrt(c(i, i)) * std::sqrt(c(j, j));
      if (!std::isfinite(c(i, j)) || !std::isfinite(c(j, i)))
        refuse(fmt::format("the covariance of rows {} and {} of rows.csv is not finite", j + 1, i + 1),
               "replace NaN and infinity");
      if (std::abs(c(i, j) - c(j, i)) > asymmetry * scale)
        refuse(fmt::format("is not symmetric: entry ({0}, {1}) is {2:.9g}, entry ({1}, {0}) is {3:.9g}", j + 1, i + 1, c(j, i),
                           c(i, j)),
               "a covariance is symmetric; save (C + C.T) / 2 if the difference is rounding");
      if (std::abs(c(i, j)) >= scale)
        refuse(fmt::format("is not positive definite: rows {} and {} of rows.csv have a correlation of {:.6g}", j + 1, i + 1,
                           c(i, j) / scale),
               "a correlation lies between -1 and 1; leave one of the two rows out if they measure the same");
    }
  }
}

}  // namespace

const std::vector<std::string>& feature_types() {
  static const std::vector<std::string> types = {"frequency_Hz",        "damping_ratio_pct", "shape",           "shape_imag",
                                                 "stay_frequency_Hz",   "rms_m_s2",          "psd_floor_m2_s3", "static_m",
                                                 "static_rotation_rad", "static_strain",     "static_force_N"};
  return types;
}

FeatureRows read_feature_rows(const std::filesystem::path& folder, const std::vector<MeasuredCondition>& conditions,
                              const std::vector<matching::Channel>& channels) {
  FeatureRows read;
  read.table = io::CsvTable::read(folder / "rows.csv", {"type", "mode", "channel", "condition", "value", "std"}, {"held_out"});
  const std::filesystem::path covariance = folder / "covariance.npy";
  const bool has_covariance = std::filesystem::exists(covariance);
  for (std::size_t at = 0; at < read.table.rows(); ++at)
    read.rows.push_back(read_row(read.table, at, conditions, channels, has_covariance));
  refuse_duplicates(read);
  refuse_shapes_of_zeros(read);
  if (has_covariance) {
    read.covariance = read_covariance(covariance, std::ssize(read.rows));
    for (std::size_t at = 0; at < read.rows.size(); ++at) {
      const auto r = static_cast<Eigen::Index>(at);
      read.rows[at].std = std::sqrt(read.covariance(r, r));
    }
  }
  return read;
}

Eigen::MatrixXd read_covariance(const std::filesystem::path& file, Index n_rows) {
  const Refusal refuse{file};
  Eigen::MatrixXd c = io::read_npy(file);
  if (c.rows() != n_rows || c.cols() != n_rows)
    refuse(fmt::format("is {} x {}, but rows.csv has {} rows", c.rows(), c.cols(), n_rows),
           "give a square matrix in the order of rows.csv, or remove the file so that the column std counts");
  check_entries(c, refuse);
  c = (0.5 * (c + c.transpose())).eval();
  const Eigen::VectorXd root = c.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd correlation = root.asDiagonal() * c * root.asDiagonal();
  if (!leading_part_is_definite(correlation, n_rows))
    refuse(fmt::format("is not positive definite: row {} of rows.csv follows from the rows before it",
                       first_dependent_row(correlation) + 1),
           "leave rows out that are combinations of others, or add the variance of their noise to the diagonal");
  return c;
}

}  // namespace twindeck::records
