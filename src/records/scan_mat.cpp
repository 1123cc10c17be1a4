#include "records/scan_mat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "core/lists.hpp"
#include "records/array_choice.hpp"
#include "records/mat_file.hpp"
#include "records/time_columns.hpp"

namespace twindeck::records {
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
  // One part of the values may hold the end of a channel and the beginning of the next.
  visit_values(mat, array, kValues, [&](Index first, const Eigen::VectorXd& values) {
    for (Index k = 0; k < values.size();) {
      const Index row = (first + k) % rows, channel = (first + k) / rows, n = std::min(rows - row, values.size() - k);
      visit(row, channel, values.segment(k, n));
      k += n;
    }
  });
}

}  // namespace

RecordInfo scan_mat(const std::filesystem::path& file, const Visitor& visit) {
  const MatFile mat = read_mat_contents(file);
  const auto shapes = each_of(mat.arrays, &MatArray::shape);
  const ArrayChoice choice = choose_arrays(shapes, mat.notes, file.string());
  const NamedArray& first = shapes[choice.data.front()];
  const bool matrix = choice.is_matrix();
  const Index channels = choice.channels(shapes);
  RecordInfo info;
  for (const std::string& other : mat.notes) info.notes.push_back(other + ", left out");
  info.format =
      fmt::format("MAT {}, ", mat.version) +
      (matrix ? fmt::format("array '{}' {} x {}", first.name, first.rows, first.columns) : fmt::format("{} vectors", channels));
  list_channels(shapes, choice, info);
  if (choice.transposed) info.notes.push_back("channels run along the rows");

  TimeColumns time_columns(visit, channels);
  if (matrix) visit_matrix(mat, mat.arrays[choice.data.front()], choice.transposed, std::ref(time_columns));
  for (std::size_t c = 0; c < choice.data.size() && !matrix; ++c)
    visit_values(mat, mat.arrays[choice.data[c]], kValues,
                 [&](Index sample, const Eigen::VectorXd& values) { time_columns(sample, static_cast<Index>(c), values); });
  time_columns.finish(info);
  for (const auto& texts : mat.texts) name_channels(texts, channels, info);
  read_rates(
      shapes, choice, [&](std::size_t at) { return values_of(mat, mat.arrays[at]); }, info);
  return info;
}

}  // namespace twindeck::records
