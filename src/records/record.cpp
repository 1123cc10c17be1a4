#include "records/record.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "core/letters.hpp"
#include "io/npy.hpp"
#include "io/regular_file.hpp"
#include "io/spreadsheet.hpp"
#include "records/array_choice.hpp"
#include "records/mat_file.hpp"
#include "records/scan_hdf5.hpp"
#include "records/scan_mat.hpp"
#include "records/scan_text.hpp"
#include "records/scan_universal.hpp"
#include "records/take_clock.hpp"
#include "records/time_columns.hpp"

namespace twindeck::records {
namespace fs = std::filesystem;
using Eigen::Index;

namespace {

std::string beginning(const fs::path& file) {
  io::require_regular_file(file);
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError({file.string(), 0, ""}, "cannot be read", "check its name and your permissions");
  std::string text(4096, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

/// The signature at the beginning, or behind a user block (512 bytes in MAT 7.3).
bool is_hdf5(std::string_view text) {
  for (const std::size_t at : {0UL, 512UL, 1024UL, 2048UL})
    if (text.size() > at && text.substr(at).starts_with("\x89HDF\r\n\x1a\n")) return true;
  return false;
}

/// The first line that is not empty is -1, alone in the first columns.
bool is_universal(const std::string& text) {
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = without_blanks(std::string_view(text).substr(at, end - at));
    at = end + 1;
    if (!line.empty()) return line == "-1";
  }
  return false;
}

/// Files of other programs, by their first bytes: what they are, and how to make a record of them.
void refuse_containers(const fs::path& file, std::string_view text) {
  struct Container {
    std::string_view begin;
    const char *what, *mend;
  };
  static constexpr const char *as_csv = "export it as CSV or MAT file", *unpack = "unpack it",
                              *python = "save the array by numpy.save, or the table by to_csv";
  static constexpr std::array<Container, 13> known = {
      {{"PK\3\4", "an archive (zip, NPZ)",
        "unpack it; of an NPZ, save the samples as one array (samples x channels) by numpy.save"},
       {"PAR1", "a Parquet file", "write it as a table: pandas.read_parquet(name).to_csv('record.csv', index=False)"},
       {"ARROW1", "a Feather file", "write it as a table: pandas.read_feather(name).to_csv('record.csv', index=False)"},
       {"\x80\3", "a pickle of Python", python},
       {"\x80\4", "a pickle of Python", python},
       {"\x80\5", "a pickle of Python", python},
       {"\x1F\x8B", "compressed by gzip", unpack},
       {"7z\xBC\xAF", "compressed by 7-Zip", unpack},
       {"\xD0\xCF\x11\xE0", "a workbook of old Excel (.xls)", "save it as .xlsx or CSV"},
       {"TDSm", "a TDMS file of LabVIEW", as_csv},
       {"MDF ", "an MDF file", as_csv},
       {"RIFF", "a WAV file", as_csv},
       {"SQLite format 3", "a database", as_csv}}};
  for (const Container& one : known)
    if (text.starts_with(one.begin) && !io::is_spreadsheet(file))
      throw InputError({file.string(), 0, ""}, std::string("is ") + one.what, one.mend);
}

}  // namespace

bool is_universal_file(const fs::path& file) { return is_universal(beginning(file)); }

RecordInfo scan_npy(const fs::path& file, const Visitor& visit) {
  const auto [rows, columns] = io::shape_of_npy(file);
  const bool along_rows = columns > rows;
  TimeColumns time_columns(visit, std::min(rows, columns));
  io::visit_npy(file, [&](Index row, Index column, const Eigen::MatrixXd& block) {
    if (along_rows) return time_columns(column, row, block.transpose());
    time_columns(row, column, block);
  });
  RecordInfo info;
  info.format = "NPY";
  ArrayChoice choice;
  choice.data = {0};
  list_channels({{"column 1", rows, columns}}, choice, info);
  if (along_rows) info.notes.emplace_back("channels run along the rows");
  time_columns.finish(info);
  return info;
}

RecordInfo scan(const fs::path& file, const Visitor& visit, const ReadOptions& options) {
  const std::string text = beginning(file);
  if (text.empty()) throw InputError({file.string(), 0, ""}, "is empty", "check the record");
  if (text.starts_with("\x93NUMPY")) return scan_npy(file, visit);
  if (is_hdf5(text)) return scan_hdf5(file, visit);
  if (is_mat_4(text) || is_mat_5(text)) return scan_mat(file, visit);
  if (is_universal(text)) return scan_universal(file, visit);
  refuse_containers(file, text);
  return scan_text(file, visit, options);
}

Record read(const fs::path& file, const ReadOptions& options) {
  Record record;
  Eigen::MatrixXd& all = record.samples;
  Index used = 0;
  const auto gather = [&](Index row, Index column, const Eigen::MatrixXd& block) {
    const Index rows = row + block.rows(), columns = column + block.cols();
    if (rows > all.rows() || columns > all.cols()) {
      // Half as much again, so that a long text file is not copied at every part.
      const Index old_rows = all.rows(), old_columns = all.cols(),
                  room = rows > old_rows ? std::max(rows, old_rows + old_rows / 2) : old_rows;
      all.conservativeResize(room, std::max(columns, old_columns));
      const double nan = std::numeric_limits<double>::quiet_NaN();
      all.bottomRows(room - old_rows).setConstant(nan);
      all.topRows(old_rows).rightCols(all.cols() - old_columns).setConstant(nan);
    }
    all.block(row, column, block.rows(), block.cols()) = block;
    used = std::max(used, rows);
  };
  record.info = scan(file, gather, options);
  all.conservativeResize(used, Eigen::NoChange);
  if (!record.info.clock.gaps.empty()) record.samples = on_the_clock(Samples(record.samples), record.info, file);
  return record;
}

Samples read(const fs::path& file, const std::vector<Index>& columns, Index n_samples, const ReadOptions& options) {
  Samples samples(n_samples, std::ssize(columns));
  samples.setConstant(std::numeric_limits<double>::quiet_NaN());
  const auto put = [&](Index row, Index column, const Eigen::MatrixXd& block) {
    if (row + block.rows() > n_samples) throw InputError({file.string(), 0, ""}, "grows while it is read", "copy it first");
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const Index at = columns[k] - column;
      if (at >= 0 && at < block.cols()) samples.col(static_cast<Index>(k)).segment(row, block.rows()) = block.col(at);
    }
  };
  const RecordInfo info = scan(file, put, options);
  return on_the_clock(std::move(samples), info, file);
}

}  // namespace twindeck::records
