#include "records/scan_hdf5.hpp"

#include <fmt/format.h>
#include <hdf5.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>

#include "core/error.hpp"
#include "records/array_choice.hpp"
#include "records/take_clock.hpp"
#include "records/text_cells.hpp"
#include "records/time_columns.hpp"

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

/// No error of HDF5's own goes to stderr while this lives: each becomes one of our messages.
class QuietErrors {
 public:
  QuietErrors() {
    H5Eget_auto(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietErrors() { H5Eset_auto(H5E_DEFAULT, print_, data_); }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

 private:
  H5E_auto_t print_ = nullptr;
  void* data_ = nullptr;
};

[[noreturn]] void refuse(const std::string& file, const std::string& problem, const std::string& mend = "") {
  throw InputError({file, 0, ""}, problem, mend.empty() ? "the file was cut off or is damaged; copy it again" : mend);
}

/// A text attribute of MATLAB's, "" if there is none.
std::string text_attribute(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return "";
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  constexpr std::size_t most = 64;  // the longest name of a class is "double"
  const std::size_t size = H5Tget_size(type.get());
  if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) > 0 || size > most) return "";
  std::string text(size, '\0');
  if (H5Aread(attribute.get(), type.get(), text.data()) < 0) return "";
  return text.c_str();
}

/// Whether this file holds all values of a dataset; missing values would be read as zeros.
/// @return the problem, "" for none
std::string what_is_missing(hid_t dataset, std::uint64_t values, std::uint64_t item) {
  const Handle settings(H5Dget_create_plist(dataset), H5Pclose);
  const H5D_layout_t layout = H5Pget_layout(settings.get());
  if (layout == H5D_VIRTUAL || H5Pget_external_count(settings.get()) > 0) return "keeps its values in other files";
  const std::uint64_t stored = H5Dget_storage_size(dataset);
  hsize_t whole_file = 0;
  const Handle file(H5Iget_file_id(dataset), H5Fclose);
  if (stored == 0) return "was never written";
  // The library allocates the size that the file states for a chunk.
  if (H5Fget_filesize(file.get(), &whole_file) < 0 || stored > whole_file) return "takes more bytes than the file has";
  if (layout != H5D_CHUNKED) return values > stored / item ? "has fewer values than it says" : "";
  hsize_t chunk[2] = {1, 1}, size[2] = {1, 1}, found = 0;
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (H5Pget_chunk(settings.get(), rank, chunk) != rank || H5Sget_simple_extent_dims(space.get(), size, nullptr) < 0)
    return "cannot be read";
  hsize_t wanted = 1;
  for (int k = 0; k < rank; ++k) wanted *= size[k] / chunk[k] + (size[k] % chunk[k] == 0 ? 0 : 1);
  if (H5Dget_num_chunks(dataset, space.get(), &found) < 0) return "cannot be read";
  if (found < wanted) return fmt::format("was written in {} of {} parts only", found, wanted);
  constexpr std::uint64_t most_compression = 1032;  // of deflate
  std::uint64_t in_a_chunk = 1;
  for (int k = 0; k < rank; ++k) in_a_chunk *= chunk[k];
  const std::uint64_t most = (stored / item + 1) * most_compression;
  return values > most || in_a_chunk > most ? "has fewer values than it says" : "";
}

/// Numbers of at most two dimensions. A dataset of MATLAB's has the other order of dimensions and may be text.
bool shape_of(hid_t dataset, bool matlab, NamedArray& array, std::string& problem) {
  const Handle type(H5Dget_type(dataset), H5Tclose), space(H5Dget_space(dataset), H5Sclose);
  const H5T_class_t kind = H5Tget_class(type.get());
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if ((kind != H5T_FLOAT && kind != H5T_INTEGER) || rank < 0 || rank > 2) return false;
  if (matlab && (text_attribute(dataset, "MATLAB_class") == "char" || H5Aexists(dataset, "MATLAB_empty") > 0)) return false;
  hsize_t dims[2] = {1, 1};
  H5Sget_simple_extent_dims(space.get(), dims, nullptr);
  constexpr hsize_t most = hsize_t{1} << 40U;  // values; more is damage, and products stay whole numbers
  if (dims[0] == 0 || dims[1] == 0) return false;
  array.rows = static_cast<Index>(std::min(dims[0], most));
  array.columns = rank == 2 ? static_cast<Index>(std::min(dims[1], most)) : 1;
  problem = dims[0] > most / dims[1] ? "has fewer values than it says"
                                     : what_is_missing(dataset, dims[0] * dims[1], H5Tget_size(type.get()));
  return true;
}

/// Description of a dataset that is no array of numbers of one or two dimensions; "" for texts and the like.
std::string what_else(hid_t dataset) {
  const Handle type(H5Dget_type(dataset), H5Tclose), space(H5Dget_space(dataset), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  const H5T_class_t kind = H5Tget_class(type.get());
  if (kind == H5T_COMPOUND) {
    std::string members;
    for (unsigned k = 0; k < static_cast<unsigned>(std::max(H5Tget_nmembers(type.get()), 0)) && k < 8; ++k) {
      char* member = H5Tget_member_name(type.get(), k);
      members += (k > 0 ? ", " : "") + std::string(member);
      H5free_memory(member);
    }
    return fmt::format("is a table of compound rows ({}): save its columns as an array, in pandas by to_csv", members);
  }
  return (kind == H5T_FLOAT || kind == H5T_INTEGER) && rank > 2 ? fmt::format("has {} dimensions", rank) : "";
}

/// Sets the properties `access` for opening a dataset: a cache for all chunks of one block of samples, so that each chunk is
/// decompressed once. A dataset must be opened anew to use it.
/// @param along_rows  samples follow each other along a row
void make_room(hid_t file, const NamedArray& array, bool along_rows, hid_t access) {
  const Handle dataset(H5Dopen(file, array.name.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle settings(H5Dget_create_plist(dataset.get()), H5Pclose), type(H5Dget_type(dataset.get()), H5Tclose);
  hsize_t chunk[2] = {1, 1};
  if (H5Pget_layout(settings.get()) != H5D_CHUNKED || H5Pget_chunk(settings.get(), 2, chunk) <= 0) return;
  constexpr hsize_t least = hsize_t{1} << 20U, most = hsize_t{1} << 30U;  // bytes
  constexpr hsize_t slots_of_a_chunk = 100, fewest_slots = 521;           // advice and default of the library
  const hsize_t bytes = chunk[0] * chunk[1] * H5Tget_size(type.get());    // decompressing one chunk needs as much memory anyway
  const auto across =
      1 + (along_rows ? static_cast<hsize_t>(array.rows) / chunk[0] : static_cast<hsize_t>(array.columns) / chunk[1]);
  H5Pset_chunk_cache(access, std::max(fewest_slots, slots_of_a_chunk * std::min(across, least) + 1),
                     std::max({least, bytes, std::min(most, bytes * across)}), 1.0);
}

Eigen::MatrixXd part(hid_t dataset, Index row, Index column, Index rows, Index columns, const std::string& file) {
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  const hsize_t start[2] = {static_cast<hsize_t>(row), static_cast<hsize_t>(column)},
                count[2] = {static_cast<hsize_t>(rows), static_cast<hsize_t>(columns)};
  const Handle memory(H5Screate_simple(2, count, nullptr), H5Sclose);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> block(rows, columns);
  if (rank > 0) H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start, nullptr, count, nullptr);
  if (H5Dread(dataset, H5T_NATIVE_DOUBLE, memory.get(), space.get(), H5P_DEFAULT, block.data()) < 0)
    refuse(file, "has values that cannot be read");
  return block;
}

struct Found {
  bool matlab = false;
  std::vector<NamedArray> arrays;
  std::vector<std::string> problems;  ///< why the values of each array cannot be read, "" if they can
  std::vector<std::string> cells;     ///< MATLAB's cell arrays
  std::vector<std::string> others;    ///< what is no array of numbers of two dimensions, and why
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
  if (found.matlab && name[0] == '#') return 0;  // objects that cells refer to
  const Handle object(H5Oopen(file, name, H5P_DEFAULT), H5Oclose);
  if (!object) return 0;
  hsize_t index = 0;
  H5Aiterate(object.get(), H5_INDEX_NAME, H5_ITER_NATIVE, &index, read_attribute, &found);
  if (info->type != H5O_TYPE_DATASET) return 0;
  NamedArray array;
  std::string problem;
  array.name = name;
  if (shape_of(object.get(), found.matlab, array, problem)) {
    found.arrays.push_back(array);
    found.problems.push_back(problem);
  } else if (const std::string other = what_else(object.get()); !other.empty()) {
    found.others.push_back(fmt::format("'{}' {}", name, other));
  } else if (found.matlab && text_attribute(object.get(), "MATLAB_class") == "cell") {
    found.cells.emplace_back(name);
  }
  return 0;
}

/// Texts that a cell array of MATLAB's refers to, or none.
std::vector<std::string> texts_of(hid_t file, const std::string& name) {
  const Handle cells(H5Dopen(file, name.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle type(H5Dget_type(cells.get()), H5Tclose), space(H5Dget_space(cells.get()), H5Sclose);
  const hssize_t n = H5Sget_simple_extent_npoints(space.get());
  constexpr hssize_t most = 10000;      // channels
  constexpr Index longest_text = 4096;  // letters of a name
  if (H5Tequal(type.get(), H5T_STD_REF_OBJ) <= 0 || n <= 0 || n > most) return {};
  std::vector<hobj_ref_t> references(static_cast<std::size_t>(n));
  if (H5Dread(cells.get(), H5T_STD_REF_OBJ, H5S_ALL, H5S_ALL, H5P_DEFAULT, references.data()) < 0) return {};
  std::vector<std::string> texts;
  for (hobj_ref_t& reference : references) {
    const Handle object(H5Rdereference2(cells.get(), H5P_DEFAULT, H5R_OBJECT, &reference), H5Oclose);
    if (!object || H5Iget_type(object.get()) != H5I_DATASET || text_attribute(object.get(), "MATLAB_class") != "char")
      return {};
    NamedArray letters;
    std::string problem, text;
    if (!shape_of(object.get(), false, letters, problem) || !problem.empty() || letters.rows * letters.columns > longest_text)
      return {};
    const Eigen::MatrixXd codes = part(object.get(), 0, 0, letters.rows, letters.columns, name);
    for (const double code : codes.reshaped())
      append_utf8(code >= 0.0 && code < 0x110000 ? static_cast<std::uint32_t>(code) : '?', text);
    texts.push_back(text);
  }
  return texts;
}

/// Name in the program that wrote the file: "run.acc" of the structure `run` in MATLAB.
std::string called(std::string name, bool matlab) {
  if (matlab) std::ranges::replace(name, '/', '.');
  return name;
}

RecordInfo info_of(const Found& found, const ArrayChoice& choice) {
  RecordInfo info;
  const NamedArray& first = found.arrays[choice.data.front()];
  const bool matrix = choice.is_matrix();
  const std::string kind = found.matlab ? "MAT 7.3" : "HDF5", item = found.matlab ? "array" : "dataset";
  // MATLAB's first dimension is the last in the file.
  const auto [rows, columns] = found.matlab ? std::pair(first.columns, first.rows) : std::pair(first.rows, first.columns);
  info.format = matrix ? fmt::format("{}, {} '{}' {} x {}", kind, item, called(first.name, found.matlab), rows, columns)
                       : fmt::format("{}, {} {}", kind, choice.channels(found.arrays), found.matlab ? "vectors" : "datasets");
  list_channels(found.arrays, choice, info);
  if (matrix && columns > rows) info.notes.emplace_back("channels run along the rows");
  for (const std::string& other : found.others) info.notes.push_back(other + ", left out");
  for (ChannelInfo& channel : info.channels) channel.name = called(channel.name, found.matlab);
  return info;
}

Handle opened(const fs::path& file) { return {H5Fopen(file.string().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose}; }

void look_through(hid_t file, Found& found) { H5Ovisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, visit_object, &found); }

/// Runs the work in the child process, then ends it: no handlers of its own (a step's would clean up its results), no core
/// file, an end after a minute.
[[noreturn]] void do_and_end(const std::function<void()>& work) {
  constexpr unsigned most_s = 60;  // to look through a file takes milliseconds
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGINT, SIGTERM, SIGHUP, SIGALRM})
    std::signal(number, SIG_DFL);
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  ::alarm(most_s);
  try {
    work();
  } catch (...) {
  }
  ::_exit(0);
}

}  // namespace

RecordInfo scan_hdf5(const fs::path& file, const Visitor& visit) {
  const QuietErrors quiet;
  // The library before 1.14 ends the whole program on some damaged files (github.com/HDFGroup/hdf5, issue 2529 and its kin).
  const bool sound = survives([&] {
    const Handle handle = opened(file);
    Found ignored;
    if (handle) look_through(handle.get(), ignored);
  });
  if (!sound) refuse(file.string(), "is damaged so that the HDF5 library breaks down on it", "copy it again, or write it anew");
  const Handle handle = opened(file);
  if (!handle) refuse(file.string(), "is no HDF5 file that can be opened", "it may be cut off; copy it again");
  Found found;
  std::string beginning(10, '\0');
  std::ifstream(file, std::ios::binary).read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  found.matlab = beginning == "MATLAB 7.3";
  look_through(handle.get(), found);
  const ArrayChoice choice = choose_arrays(found.arrays, found.others, file.string());
  for (const std::size_t at : choice.data)
    if (!found.problems[at].empty())
      throw InputError({file.string(), 0, found.arrays[at].name}, found.problems[at],
                       "write the file again, with all values in it");
  RecordInfo info = info_of(found, choice);
  const Index samples = found.arrays[choice.data.front()].longer();
  const bool matrix = choice.data.size() == 1;
  TimeColumns time_columns(visit, std::ssize(info.channels));
  const Index chunk = std::max<Index>(1, 131072 / (matrix ? std::ssize(info.channels) : 1));
  for (std::size_t k = 0; k < choice.data.size(); ++k) {
    const NamedArray& array = found.arrays[choice.data[k]];
    const bool along_rows = array.columns > array.rows;
    const Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
    make_room(handle.get(), array, along_rows, access.get());
    const Handle dataset(H5Dopen(handle.get(), array.name.c_str(), access.get()), H5Dclose);
    const Index first_channel = matrix ? 0 : static_cast<Index>(k);
    for (Index at = 0; at < samples; at += chunk) {
      const Index n = std::min(chunk, samples - at);
      if (along_rows)
        time_columns(at, first_channel, part(dataset.get(), 0, at, array.rows, n, file.string()).transpose());
      else
        time_columns(at, first_channel, part(dataset.get(), at, 0, n, array.columns, file.string()));
    }
  }
  const Index columns = std::ssize(info.channels);
  time_columns.finish(info);
  for (const std::string& cell : found.cells) name_channels(texts_of(handle.get(), cell), columns, info);
  const auto whole = [&](std::size_t at) -> Eigen::VectorXd {
    const NamedArray& array = found.arrays[at];
    if (!found.problems[at].empty() && array.longer() == 1) return Eigen::VectorXd::Constant(1, std::nan(""));
    if (!found.problems[at].empty()) throw InputError({file.string(), 0, array.name}, found.problems[at]);
    const Handle dataset(H5Dopen(handle.get(), array.name.c_str(), H5P_DEFAULT), H5Dclose);
    return part(dataset.get(), 0, 0, array.rows, array.columns, file.string()).reshaped();
  };
  read_rates(found.arrays, choice, whole, info);
  for (const auto& [name, value] : found.attributes) take_stated_rate(rate_of(name, value), "'" + name + "'", info);
  return info;
}

bool survives(const std::function<void()>& work) {
  const pid_t child = ::fork();
  if (child < 0) return true;
  if (child == 0) do_and_end(work);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return true;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace twindeck::records
