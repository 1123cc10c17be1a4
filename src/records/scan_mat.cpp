#include <fmt/format.h>
#include <matio.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/error.hpp"
#include "records/array_choice.hpp"
#include "records/record.hpp"

namespace twindeck::records {
namespace fs = std::filesystem;
using Eigen::Index;

namespace {

struct CloseMat {
  void operator()(mat_t* mat) const { Mat_Close(mat); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

bool is_numeric(const matvar_t& v) { return v.class_type >= MAT_C_DOUBLE && v.class_type <= MAT_C_UINT64 && v.rank == 2 && v.isComplex == 0; }

double value_at(const matvar_t& v, std::size_t i) {
  switch (v.class_type) {
    case MAT_C_DOUBLE: return static_cast<const double*>(v.data)[i];
    case MAT_C_SINGLE: return static_cast<double>(static_cast<const float*>(v.data)[i]);
    case MAT_C_INT8: return static_cast<const std::int8_t*>(v.data)[i];
    case MAT_C_UINT8: return static_cast<const std::uint8_t*>(v.data)[i];
    case MAT_C_INT16: return static_cast<const std::int16_t*>(v.data)[i];
    case MAT_C_UINT16: return static_cast<const std::uint16_t*>(v.data)[i];
    case MAT_C_INT32: return static_cast<const std::int32_t*>(v.data)[i];
    case MAT_C_UINT32: return static_cast<const std::uint32_t*>(v.data)[i];
    case MAT_C_INT64: return static_cast<double>(static_cast<const std::int64_t*>(v.data)[i]);
    case MAT_C_UINT64: return static_cast<double>(static_cast<const std::uint64_t*>(v.data)[i]);
    default: return std::nan("");
  }
}

NamedArray shape_of(const std::string& name, const matvar_t& v) {
  return {name, static_cast<Index>(v.dims[0]), static_cast<Index>(v.dims[1])};
}

std::string text_of(const matvar_t& v) {
  std::string text;
  if (v.class_type != MAT_C_CHAR || v.data == nullptr) return text;
  const std::size_t n = v.dims[0] * v.dims[1], width = v.nbytes / std::max<std::size_t>(n, 1);
  for (std::size_t i = 0; i < n; ++i) text += static_cast<const char*>(v.data)[i * std::max<std::size_t>(width, 1)];
  return text;
}

/// Texts of a cell array, or none.
std::vector<std::string> texts_of(const matvar_t& v) {
  std::vector<std::string> texts;
  if (v.class_type != MAT_C_CELL || v.data == nullptr) return texts;
  const std::size_t n = v.dims[0] * v.dims[1];
  for (std::size_t i = 0; i < n; ++i) {
    const matvar_t* cell = static_cast<matvar_t**>(v.data)[i];
    if (cell == nullptr || cell->class_type != MAT_C_CHAR) return {};
    texts.push_back(text_of(*cell));
  }
  return texts;
}

/// Numeric arrays in a file: variables, and fields of structures one level down (those whole in memory).
struct Contents {
  std::vector<NamedArray> arrays;
  std::vector<std::string> variable;          ///< of each array
  std::vector<Variable> structures;
  std::vector<const matvar_t*> field;         ///< the field, or null for a variable of its own
  std::vector<std::vector<std::string>> texts;
};

void add_fields(Contents& contents, const std::string& name, Variable structure) {
  const unsigned n = Mat_VarGetNumberOfFields(structure.get());
  char* const* names = Mat_VarGetStructFieldnames(structure.get());
  for (unsigned i = 0; i < n && names != nullptr; ++i) {
    const matvar_t* field = Mat_VarGetStructFieldByIndex(structure.get(), i, 0);
    if (field == nullptr) continue;
    if (field->class_type == MAT_C_CELL) contents.texts.push_back(texts_of(*field));
    if (!is_numeric(*field) || field->data == nullptr) continue;
    contents.arrays.push_back(shape_of(name + "." + names[i], *field));
    contents.variable.push_back(name);
    contents.field.push_back(field);
  }
  contents.structures.push_back(std::move(structure));
}

Contents contents_of(mat_t* mat) {
  Contents contents;
  std::vector<std::string> structures, cells;
  while (matvar_t* info = Mat_VarReadNextInfo(mat)) {
    const Variable v(info);
    if (v->name == nullptr || v->name[0] == '#') continue;
    if (v->class_type == MAT_C_STRUCT && v->rank == 2 && v->dims[0] * v->dims[1] == 1) structures.emplace_back(v->name);
    if (v->class_type == MAT_C_CELL) cells.emplace_back(v->name);
    if (!is_numeric(*v)) continue;
    contents.arrays.push_back(shape_of(v->name, *v));
    contents.variable.emplace_back(v->name);
    contents.field.push_back(nullptr);
  }
  for (const std::string& name : structures) {
    if (Variable v{Mat_VarRead(mat, name.c_str())}) add_fields(contents, name, std::move(v));
  }
  for (const std::string& name : cells) {
    if (const Variable v{Mat_VarRead(mat, name.c_str())}) contents.texts.push_back(texts_of(*v));
  }
  return contents;
}

/// Values [start, start + count) of column `column`, or of a row if `along_row`.
Eigen::VectorXd values(mat_t* mat, const Contents& contents, std::size_t at, Index line, bool along_row, const std::string& file) {
  const NamedArray& array = contents.arrays[at];
  const Index n = along_row ? array.columns : array.rows;
  Eigen::VectorXd result(n);
  if (const matvar_t* field = contents.field[at]) {
    for (Index i = 0; i < n; ++i) {
      const Index row = along_row ? line : i, column = along_row ? i : line;
      result[i] = value_at(*field, static_cast<std::size_t>(column * array.rows + row));
    }
    return result;
  }
  const Variable v(Mat_VarReadInfo(mat, contents.variable[at].c_str()));
  int start[2] = {along_row ? static_cast<int>(line) : 0, along_row ? 0 : static_cast<int>(line)}, stride[2] = {1, 1};
  int edge[2] = {along_row ? 1 : static_cast<int>(n), along_row ? static_cast<int>(n) : 1};
  std::vector<char> buffer(static_cast<std::size_t>(n) * 8);
  if (!v || Mat_VarReadData(mat, v.get(), buffer.data(), start, stride, edge) != 0) {
    throw InputError({file, 0, array.name}, "cannot be read", "the file was cut off or is damaged; copy it again");
  }
  matvar_t part = *v;
  part.data = buffer.data();
  for (Index i = 0; i < n; ++i) result[i] = value_at(part, static_cast<std::size_t>(i));
  return result;
}

}  // namespace

RecordInfo scan_mat(const fs::path& file, const Visitor& visit) {
  const std::unique_ptr<mat_t, CloseMat> mat(Mat_Open(file.string().c_str(), MAT_ACC_RDONLY));
  if (!mat) throw InputError({file.string(), 0, ""}, "is no MAT file that can be read", "save it with -v7 or -v7.3; it may be cut off");
  const Contents contents = contents_of(mat.get());
  const ArrayChoice choice = choose_arrays(contents.arrays, file.string());
  RecordInfo info;
  info.format = Mat_GetVersion(mat.get()) == MAT_FT_MAT73 ? "MAT 7.3" : "MAT 5";
  const auto single = [&](std::size_t at) { return values(mat.get(), contents, at, 0, contents.arrays[at].columns > contents.arrays[at].rows, file.string()); };

  const NamedArray& first = contents.arrays[choice.data.front()];
  const bool matrix = choice.data.size() == 1;
  const Index channels = matrix ? first.shorter() : static_cast<Index>(choice.data.size());
  info.format += matrix ? fmt::format(", array '{}' {} x {}", first.name, first.rows, first.columns) : fmt::format(", {} vectors", channels);
  if (choice.transposed) info.notes.push_back("channels run along the rows");
  for (Index c = 0; c < channels; ++c) {
    ChannelInfo channel;
    channel.samples = first.longer();
    channel.name = matrix ? "column " + std::to_string(c + 1) : contents.arrays[choice.data[static_cast<std::size_t>(c)]].name;
    info.channels.push_back(channel);
    if (matrix) {
      visit(0, c, values(mat.get(), contents, choice.data.front(), c, choice.transposed, file.string()));
    } else {
      visit(0, c, single(choice.data[static_cast<std::size_t>(c)]));
    }
  }
  for (const auto& texts : contents.texts) {
    if (static_cast<Index>(texts.size()) != channels) continue;
    for (std::size_t c = 0; c < texts.size(); ++c) info.channels[c].name = texts[c];
  }
  if (choice.time >= 0) {
    info.rate_Hz = rate_of_times(single(static_cast<std::size_t>(choice.time)));
    info.rate_source = "'" + contents.arrays[static_cast<std::size_t>(choice.time)].name + "'";
    if (info.rate_Hz == 0.0) info.notes.push_back(info.rate_source + " does not run evenly");
  }
  for (const std::size_t at : choice.scalars) {
    const double rate = rate_of(contents.arrays[at].name, single(at)[0]);
    if (rate <= 0.0) continue;
    if (info.rate_Hz > 0.0 && std::abs(rate / info.rate_Hz - 1.0) > 0.01) {
      info.notes.push_back(fmt::format("'{}' says {} Hz, the times {} Hz", contents.arrays[at].name, rate, info.rate_Hz));
    } else if (info.rate_Hz == 0.0) {
      info.rate_Hz = rate;
      info.rate_source = "'" + contents.arrays[at].name + "'";
    }
  }
  return info;
}

}  // namespace twindeck::records
