#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "records/array_choice.hpp"
#include "records/record.hpp"

namespace twindeck::records {
namespace fs = std::filesystem;
using Eigen::Index;

namespace {

/// An HDF5 identifier that is closed in the end.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  [[nodiscard]] hid_t get() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }

 private:
  hid_t id_;
  Close close_;
};

/// Numbers of at most two dimensions.
bool shape_of(hid_t dataset, NamedArray& array) {
  const Handle type(H5Dget_type(dataset), H5Tclose), space(H5Dget_space(dataset), H5Sclose);
  const H5T_class_t kind = H5Tget_class(type.get());
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if ((kind != H5T_FLOAT && kind != H5T_INTEGER) || rank < 0 || rank > 2) return false;
  hsize_t dims[2] = {1, 1};
  H5Sget_simple_extent_dims(space.get(), dims, nullptr);
  array.rows = static_cast<Index>(dims[0]);
  array.columns = rank == 2 ? static_cast<Index>(dims[1]) : 1;
  return true;
}

/// Values of a part, in C order.
Eigen::MatrixXd part(hid_t dataset, Index row, Index column, Index rows, Index columns, const std::string& what) {
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  const hsize_t start[2] = {static_cast<hsize_t>(row), static_cast<hsize_t>(column)}, count[2] = {static_cast<hsize_t>(rows), static_cast<hsize_t>(columns)};
  const Handle memory(H5Screate_simple(2, count, nullptr), H5Sclose);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> block(rows, columns);
  if (rank > 0) H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start, nullptr, count, nullptr);
  if (H5Dread(dataset, H5T_NATIVE_DOUBLE, memory.get(), space.get(), H5P_DEFAULT, block.data()) < 0) {
    throw InputError({what, 0, ""}, "cannot be read", "the file was cut off or is damaged; copy it again");
  }
  return block;
}

struct Found {
  std::vector<NamedArray> arrays;
  std::vector<std::pair<std::string, double>> attributes;
};

herr_t read_attribute(hid_t object, const char* name, const H5A_info_t*, void* data) {
  auto& found = *static_cast<Found*>(data);
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute.get()), H5Tclose), space(H5Aget_space(attribute.get()), H5Sclose);
  const H5T_class_t kind = H5Tget_class(type.get());
  if ((kind == H5T_FLOAT || kind == H5T_INTEGER) && H5Sget_simple_extent_npoints(space.get()) == 1) {
    double value = 0.0;
    if (H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &value) >= 0) found.attributes.emplace_back(name, value);
  }
  return 0;
}

herr_t visit_object(hid_t file, const char* name, const H5O_info_t* info, void* data) {
  auto& found = *static_cast<Found*>(data);
  const Handle object(H5Oopen(file, name, H5P_DEFAULT), H5Oclose);
  if (!object) return 0;
  hsize_t index = 0;
  H5Aiterate(object.get(), H5_INDEX_NAME, H5_ITER_NATIVE, &index, read_attribute, &found);
  if (info->type != H5O_TYPE_DATASET) return 0;
  NamedArray array;
  array.name = name;
  if (shape_of(object.get(), array)) found.arrays.push_back(array);
  return 0;
}

}  // namespace

RecordInfo scan_hdf5(const fs::path& file, const Visitor& visit) {
  H5Eset_auto(H5E_DEFAULT, nullptr, nullptr);
  const Handle handle(H5Fopen(file.string().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!handle) throw InputError({file.string(), 0, ""}, "is no HDF5 file that can be opened", "it may be cut off; copy it again");
  Found found;
  H5Ovisit(handle.get(), H5_INDEX_NAME, H5_ITER_NATIVE, visit_object, &found);
  const ArrayChoice choice = choose_arrays(found.arrays, file.string());
  const auto open = [&](std::size_t at) { return H5Dopen(handle.get(), found.arrays[at].name.c_str(), H5P_DEFAULT); };
  RecordInfo info;
  const NamedArray& first = found.arrays[choice.data.front()];
  const bool matrix = choice.data.size() == 1;
  const Index channels = matrix ? first.shorter() : static_cast<Index>(choice.data.size()), samples = first.longer();
  info.format = matrix ? fmt::format("HDF5, dataset '{}' {} x {}", first.name, first.rows, first.columns) : fmt::format("HDF5, {} datasets", channels);
  if (choice.transposed) info.notes.push_back("channels run along the rows");
  for (Index c = 0; c < channels; ++c) {
    ChannelInfo channel;
    channel.samples = samples;
    channel.name = matrix ? "column " + std::to_string(c + 1) : found.arrays[choice.data[static_cast<std::size_t>(c)]].name;
    info.channels.push_back(channel);
  }
  const Index chunk = std::max<Index>(1, 131072 / (matrix ? channels : 1));
  for (std::size_t k = 0; k < choice.data.size(); ++k) {
    const Handle dataset(open(choice.data[k]), H5Dclose);
    const NamedArray& array = found.arrays[choice.data[k]];
    const bool along_rows = array.columns > array.rows;
    for (Index at = 0; at < samples; at += chunk) {
      const Index n = std::min(chunk, samples - at);
      const Index first_channel = matrix ? 0 : static_cast<Index>(k);
      if (along_rows) {
        visit(at, first_channel, part(dataset.get(), 0, at, array.rows, n, file.string()).transpose());
      } else {
        visit(at, first_channel, part(dataset.get(), at, 0, n, array.columns, file.string()));
      }
    }
  }
  if (choice.time >= 0) {
    const auto at = static_cast<std::size_t>(choice.time);
    const Handle dataset(open(at), H5Dclose);
    const Eigen::MatrixXd times = part(dataset.get(), 0, 0, found.arrays[at].rows, found.arrays[at].columns, file.string());
    info.rate_Hz = rate_of_times(times.reshaped());
    info.rate_source = "'" + found.arrays[at].name + "'";
    if (info.rate_Hz == 0.0) info.notes.push_back(info.rate_source + " does not run evenly");
  }
  for (const std::size_t at : choice.scalars) {
    const Handle dataset(open(at), H5Dclose);
    found.attributes.emplace_back(found.arrays[at].name, part(dataset.get(), 0, 0, 1, 1, file.string())(0, 0));
  }
  for (const auto& [name, value] : found.attributes) {
    const double rate = rate_of(name, value);
    if (rate <= 0.0) continue;
    if (info.rate_Hz == 0.0) {
      info.rate_Hz = rate;
      info.rate_source = "'" + name + "'";
    } else if (std::abs(rate / info.rate_Hz - 1.0) > 0.01) {
      info.notes.push_back(fmt::format("'{}' says {} Hz, {} {} Hz", name, rate, info.rate_source, info.rate_Hz));
    }
  }
  return info;
}

}  // namespace twindeck::records
