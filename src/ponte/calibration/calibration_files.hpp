#pragma once

#include <filesystem>
#include <string>

#include "io/csv.hpp"
#include "ponte/calibration/calibration.hpp"

namespace twindeck::ponte {

/// Reads calibration.toml: targets, sizes with their ranges, known forces and masses, forms and trials.
/// @throws InputError naming file and line
[[nodiscard]] Calibration read_calibration(const std::filesystem::path& file);

/// The tables of a calibration.
/// values.csv: `value,unit,untuned,lower,upper,fitted,edge,reason`.
void write_calibration_values(const Calibration& calibration, const CalibrationResult& result,
                              const std::filesystem::path& file);
/// frequencies.csv: printed, untuned and fitted frequencies and their errors.
void write_calibration_frequencies(const Calibration& calibration, const CalibrationResult& result,
                                   const std::filesystem::path& file);
/// known.csv: cable forces, masses per metre and largest displacement of the anchors beside what is known of them, with the
/// standard deviation, untuned and fitted.
void write_calibration_known(const Calibration& calibration, const CalibrationResult& result,
                             const std::filesystem::path& file);

/// The values of an earlier fit (values.csv), as parts of their ranges; those that it does not have begin at their start.
/// @throws InputError for a value of a logarithmic range that is not above 0
[[nodiscard]] Eigen::VectorXd parts_in(const std::filesystem::path& values_csv, const Calibration& calibration);

/// One row a trial: what it is fitted to, errors of the frequencies, forces, masses, displacement, values on an edge, parts of
/// the cost.
class TradeTable {
 public:
  explicit TradeTable(const Calibration& calibration);
  void add(const CalibrationTrial& trial, const std::string& mesh, const Calibration& calibration,
           const CalibrationResult& result);
  void save(const std::filesystem::path& file) const { csv_.save(file); }

 private:
  io::CsvWriter csv_;
};

}  // namespace twindeck::ponte
