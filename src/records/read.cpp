#include <algorithm>
#include <fstream>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "io/npy.hpp"
#include "records/record.hpp"

namespace twindeck::records {
namespace fs = std::filesystem;
using Eigen::Index;

namespace {

std::string beginning(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || fs::is_directory(file))
    throw InputError({file.string(), 0, ""}, "cannot be read", "check its name and your permissions");
  std::string text(4096, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

/// The first line that is not empty is -1, alone in the first columns.
bool is_universal(const std::string& text) {
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string line = text.substr(at, end - at);
    at = end + 1;
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos) continue;
    const std::size_t last = line.find_last_not_of(" \t\r");
    return line.substr(first, last - first + 1) == "-1";
  }
  return false;
}

}  // namespace

RecordInfo scan_npy(const fs::path& file, const Visitor& visit) {
  RecordInfo info;
  info.format = "NPY";
  const auto [rows, columns] = io::visit_npy(file, visit);
  for (Index c = 0; c < columns; ++c) {
    ChannelInfo channel;
    channel.name = "column " + std::to_string(c + 1);
    channel.samples = rows;
    info.channels.push_back(channel);
  }
  if (columns > rows) info.notes.push_back("more columns than rows: samples x channels is expected, transpose the array");
  return info;
}

RecordInfo scan(const fs::path& file, const Visitor& visit) {
  const std::string text = beginning(file);
  if (text.empty()) throw InputError({file.string(), 0, ""}, "is empty", "check the record");
  if (text.starts_with("\x93NUMPY")) return scan_npy(file, visit);
  if (text.starts_with("MATLAB 5.0") || text.starts_with("MATLAB 7.3")) return scan_mat(file, visit);
  if (text.starts_with("\x89HDF\r\n\x1a\n")) return scan_hdf5(file, visit);
  if (is_universal(text)) return scan_universal(file, visit);
  return scan_text(file, visit);
}

namespace {

/// Samples as they come, part by part.
class Gathered {
 public:
  void add(Index row, Index column, const Eigen::MatrixXd& block) {
    const Index rows = row + block.rows(), columns = column + block.cols();
    if (rows > all_.rows() || columns > all_.cols()) {
      // Half as much again, so that a long text file is not copied at every part.
      const Index old_rows = all_.rows(), old_columns = all_.cols(),
                  room = rows > old_rows ? std::max(rows, old_rows + old_rows / 2) : old_rows;
      all_.conservativeResize(room, std::max(columns, old_columns));
      const double nan = std::numeric_limits<double>::quiet_NaN();
      all_.bottomRows(room - old_rows).setConstant(nan);
      all_.topRows(old_rows).rightCols(all_.cols() - old_columns).setConstant(nan);
    }
    all_.block(row, column, block.rows(), block.cols()) = block;
    used_ = std::max(used_, rows);
  }
  Eigen::MatrixXd take() {
    all_.conservativeResize(used_, Eigen::NoChange);
    return std::move(all_);
  }

 private:
  Eigen::MatrixXd all_;
  Index used_ = 0;
};

}  // namespace

Record read(const fs::path& file) {
  Record record;
  Gathered gathered;
  record.info = scan(file, [&](Index row, Index column, const Eigen::MatrixXd& block) { gathered.add(row, column, block); });
  record.samples = gathered.take();
  return record;
}

Record read(const fs::path& file, const std::vector<Index>& columns) {
  Record record;
  Gathered gathered;
  record.info = scan(file, [&](Index row, Index column, const Eigen::MatrixXd& block) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const Index at = columns[k] - column;
      if (at >= 0 && at < block.cols()) gathered.add(row, static_cast<Index>(k), block.col(at));
    }
  });
  record.samples = gathered.take();
  return record;
}

}  // namespace twindeck::records
