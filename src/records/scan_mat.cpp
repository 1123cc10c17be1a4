#include "records/scan_mat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "records/array_choice.hpp"
#include "records/mat_file.hpp"

namespace twindeck::records {
namespace fs = std::filesystem;
using Eigen::Index;

namespace {

constexpr Index kValues = 131072;  // a part

/// The samples of a matrix of several channels. Its columns lie one after another in the file: channels, or samples where it is
/// transposed.
void visit_matrix(const MatFile& mat, const MatArray& array, bool transposed, const Visitor& visit) {
  const Index rows = array.shape.rows;
  if (transposed) {
    const Index samples = std::max<Index>(1, kValues / rows);
    visit_values(mat, array, samples * rows, [&](Index first, const Eigen::VectorXd& values) {
      visit(first / rows, 0, values.reshaped(rows, values.size() / rows).transpose());
    });
    return;
  }
  // A part of the values may end one channel and begin the next.
  visit_values(mat, array, kValues, [&](Index first, const Eigen::VectorXd& values) {
    for (Index k = 0; k < values.size();) {
      const Index row = (first + k) % rows, channel = (first + k) / rows, n = std::min(rows - row, values.size() - k);
      visit(row, channel, values.segment(k, n));
      k += n;
    }
  });
}

/// The rate by the vector of times, or by a scalar whose name says so.
void read_rate(const MatFile& mat, const ArrayChoice& choice, RecordInfo& info) {
  if (choice.time >= 0) {
    const MatArray& times = mat.arrays[static_cast<std::size_t>(choice.time)];
    info.rate_Hz = rate_of_times(values_of(mat, times));
    info.rate_source = "'" + times.shape.name + "'";
    if (info.rate_Hz == 0.0) info.notes.push_back(info.rate_source + " does not run evenly");
  }
  for (const std::size_t at : choice.scalars) {
    const std::string& name = mat.arrays[at].shape.name;
    const double rate = rate_of(name, values_of(mat, mat.arrays[at])[0]);
    if (rate <= 0.0) continue;
    if (info.rate_Hz > 0.0 && std::abs(rate / info.rate_Hz - 1.0) > 0.01) {
      info.notes.push_back(fmt::format("'{}' says {} Hz, the times {} Hz", name, rate, info.rate_Hz));
    } else if (info.rate_Hz == 0.0) {
      info.rate_Hz = rate;
      info.rate_source = "'" + name + "'";
    }
  }
}

}  // namespace

RecordInfo scan_mat(const fs::path& file, const Visitor& visit) {
  const MatFile mat = read_mat_contents(file);
  std::vector<NamedArray> shapes;
  for (const MatArray& array : mat.arrays) shapes.push_back(array.shape);
  const ArrayChoice choice = choose_arrays(shapes, file.string());
  const NamedArray& first = shapes[choice.data.front()];
  const bool matrix = choice.data.size() == 1;
  const Index channels = matrix ? first.shorter() : static_cast<Index>(choice.data.size());
  RecordInfo info;
  info.notes = mat.notes;
  info.format =
      fmt::format("MAT {}, ", mat.version) +
      (matrix ? fmt::format("array '{}' {} x {}", first.name, first.rows, first.columns) : fmt::format("{} vectors", channels));
  info.names_channels = info.has_header = !matrix;
  for (const std::size_t at : choice.left_out)
    info.notes.push_back(fmt::format("'{}' has as many samples, left out", shapes[at].name));
  if (choice.transposed) info.notes.push_back("channels run along the rows");
  for (Index c = 0; c < channels; ++c) {
    ChannelInfo channel;
    channel.samples = first.longer();
    channel.position = c + 1;
    channel.name =
        channels > 1 && matrix ? "column " + std::to_string(c + 1) : shapes[choice.data[static_cast<std::size_t>(c)]].name;
    info.channels.push_back(channel);
  }
  if (matrix) {
    visit_matrix(mat, mat.arrays[choice.data.front()], choice.transposed, visit);
  } else {
    for (std::size_t c = 0; c < choice.data.size(); ++c) {
      visit_values(mat, mat.arrays[choice.data[c]], kValues,
                   [&](Index sample, const Eigen::VectorXd& values) { visit(sample, static_cast<Index>(c), values); });
    }
  }
  for (const auto& texts : mat.texts) {
    if (static_cast<Index>(texts.size()) != channels) continue;
    for (std::size_t c = 0; c < texts.size(); ++c) info.channels[c].name = texts[c];
    info.names_channels = info.has_header = true;
  }
  read_rate(mat, choice, info);
  return info;
}

}  // namespace twindeck::records
