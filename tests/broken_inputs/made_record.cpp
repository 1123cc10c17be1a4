#include "broken_inputs/made_record.hpp"

#include <fmt/format.h>
#include <hdf5.h>
#include <matio.h>

#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <stdexcept>

#include "core/random.hpp"
#include "npy_double.hpp"
#include "records/record.hpp"
#include "records/universal.hpp"
#include "universal_responses.hpp"
#include "universal_series.hpp"

namespace twindeck::broken {
namespace {

namespace fs = std::filesystem;
using Eigen::MatrixXd;

constexpr Eigen::Index kSamples = 3000;
constexpr double kRate_Hz = 50.0;
const char* const kNames[] = {"A_x", "B_x", "C_z"};

/// Seconds as a time of day.
std::string time_of_day(double seconds, int decimals) {
  const double s = std::fmod(seconds, 86400.0);
  return fmt::format("{:02.0f}:{:02.0f}:{:0{}.{}f}", std::floor(s / 3600.0), std::floor(std::fmod(s, 3600.0) / 60.0),
                     std::fmod(s, 60.0), decimals > 0 ? 3 + decimals : 2, decimals);
}

/// The stamp of a sample, as some logger writes it. True rates of packets, late and seconds: 50.4 Hz.
std::string stamp_of(const std::string& kind, Eigen::Index t) {
  constexpr double true_rate_Hz = 50.4;
  const auto at = static_cast<double>(t);
  const double late = std::fmod(at * 0.6180339887498949, 1.0);  // evenly spread, in no order
  if (kind == "packets") {
    const double last = std::floor(at / 25.0) * 25.0;
    return fmt::format("{:.0f}", 1.7e12 + 1e3 * last / true_rate_Hz + 40.0 * std::fmod(last * 0.6180339887498949, 1.0));
  }
  if (kind == "late") return fmt::format("{:.3f}", at / true_rate_Hz + 0.008 * late);
  if (kind == "seconds") return fmt::format("{:.0f}", 1.7e9 + std::floor(at / true_rate_Hz));
  if (kind == "gap")  // five seconds are missing from sample 1000 on
    return "2024-05-17 " + time_of_day(36000.0 + std::floor((t < 1000 ? at : at + 250.0) / kRate_Hz), 0);
  if (kind == "midnight") return time_of_day(86390.0 + at / kRate_Hz, 2);
  if (kind == "parts")  // in columns of its parts, at 50.4 Hz
    return fmt::format("2024,5,17,10,{:.0f},{:.3f}", std::floor(at / true_rate_Hz / 60.0), std::fmod(at / true_rate_Hz, 60.0));
  if (kind == "reversed") return fmt::format("{:.2f}", static_cast<double>(kSamples - t) / kRate_Hz);
  return fmt::format("{:.2f}", at / kRate_Hz);
}

/// @param kind  of stamps; or of what C_z does: stuck, copy (of A_x), scaled (3 - 2.5 A_x), slow (one value in fifty); doubled
/// (the second half is the first again); or csv
void write_csv(const fs::path& file, const std::string& kind) {
  MatrixXd record = sound_record();
  std::ofstream out(file);
  out << (kind == "packets" || kind == "seconds" ? "timestamp"
          : kind == "midnight" || kind == "gap"  ? "time"
          : kind == "parts"                      ? "Year,Month,Day,Hour,Minute,Second"
                                                 : "time_s")
      << ",A_x,B_x,C_z\n";
  if (kind == "doubled") record.bottomRows(kSamples / 2) = record.topRows(kSamples / 2).eval();
  for (Eigen::Index t = 0; t < kSamples; ++t) {
    const double last = kind == "copy"                             ? record(t, 0)
                        : kind == "scaled"                         ? 3.0 - 2.5 * record(t, 0)
                        : kind == "stuck" && t >= 1000 && t < 1300 ? record(1000, 2)
                                                                   : record(t, 2);
    out << fmt::format("{},{:.9g},{:.9g},{}\n", stamp_of(kind, t), record(t, 0), record(t, 1),
                       kind == "slow" && t % 50 != 0 ? "" : fmt::format("{:.9g}", last));
  }
}

void write_mat(const fs::path& file, mat_ft version, matio_compression compression) {
  MatrixXd record = sound_record(), rate = MatrixXd::Constant(1, 1, kRate_Hz);
  mat_t* mat = Mat_CreateVer(file.c_str(), nullptr, version);
  if (mat == nullptr) throw std::runtime_error("no MAT file can be made");
  for (const auto& [name, values] : {std::pair<const char*, MatrixXd*>{"acc", &record}, {"fs", &rate}}) {
    std::size_t dims[2] = {static_cast<std::size_t>(values->rows()), static_cast<std::size_t>(values->cols())};
    matvar_t* variable = Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims, values->data(), 0);
    Mat_VarWrite(mat, variable, compression);
    Mat_VarFree(variable);
  }
  Mat_Close(mat);
}

/// MAT 4, which matio of this age does not write: a header of five numbers a matrix, a name, values by column.
void write_mat4(const fs::path& file) {
  std::ofstream out(file, std::ios::binary);
  const auto matrix = [&](const std::string& name, const MatrixXd& values) {
    const std::int32_t header[5] = {0, static_cast<std::int32_t>(values.rows()), static_cast<std::int32_t>(values.cols()), 0,
                                    static_cast<std::int32_t>(name.size() + 1)};
    out.write(reinterpret_cast<const char*>(header), sizeof header);
    out.write(name.c_str(), static_cast<std::streamsize>(name.size() + 1));
    out.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size()) * 8);
  };
  matrix("acc", sound_record());
  matrix("fs", MatrixXd::Constant(1, 1, kRate_Hz));
}

void write_hdf5(const fs::path& file) {
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = sound_record();
  const hid_t h5 = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hsize_t dims[2] = {kSamples, 3};
  const hid_t space = H5Screate_simple(2, dims, nullptr), scalar = H5Screate(H5S_SCALAR);
  const hid_t set = H5Dcreate2(h5, "acceleration", H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data());
  const hid_t attribute = H5Acreate2(set, "sampling_rate", H5T_IEEE_F64LE, scalar, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(attribute, H5T_NATIVE_DOUBLE, &kRate_Hz);
  H5Aclose(attribute);
  H5Dclose(set);
  H5Sclose(space);
  H5Sclose(scalar);
  H5Fclose(h5);
}

void write_uff(const fs::path& file, bool binary) {
  records::RecordInfo info;
  info.rate_Hz = kRate_Hz;
  for (const char* name : kNames) {
    records::ChannelInfo channel;
    channel.name = name;
    channel.unit = "m/s2";
    info.channels.push_back(channel);
  }
  records::write_universal_series(info, sound_record(), binary, file);
}

/// Accelerances of the same two oscillators: points 1+x, 2+x and 3+z to a hammer at 1+x, 0.5 to 12 Hz in steps of 0.0625 Hz.
void write_responses(const fs::path& file, bool binary) {
  test::ModalModel model;
  model.frequency_Hz = Eigen::Vector2d(2.0, 6.0);
  model.damping_ratio = Eigen::Vector2d(0.01, 0.01);
  model.shapes.resize(3, 2);
  model.shapes << 0.6, 1.0, 1.0, -0.6, 0.4, 0.2;
  std::string text;
  for (int point = 0; point < 3; ++point) {
    test::WrittenFunction w;
    w.response = point + 1;
    w.response_direction = point < 2 ? 1 : 3;
    w.reference_direction = 1;
    w.f = Eigen::VectorXd::LinSpaced(185, 0.5, 12.0);
    w.h = model.accelerance(point, 0, w.f);
    text += universal_function(w, binary);
  }
  std::ofstream(file, std::ios::binary) << text;
}

}  // namespace

MatrixXd sound_record() {
  constexpr double frequency_Hz[] = {2.0, 6.0}, damping = 0.01;
  constexpr double shape[][3] = {{0.6, 1.0, 0.4}, {1.0, -0.6, 0.2}};  // of each oscillator at the three channels
  MatrixXd record = MatrixXd::Zero(kSamples, 3);
  for (std::uint64_t m = 0; m < 2; ++m) {
    // Poles of a damped oscillator as an autoregressive filter of order two.
    const double omega = 2.0 * std::numbers::pi * frequency_Hz[m] / kRate_Hz, radius = std::exp(-damping * omega);
    double last = 0.0, before = 0.0;
    for (Eigen::Index t = -500; t < kSamples; ++t) {
      const double next = 2.0 * radius * std::cos(omega) * last - radius * radius * before +
                          normal_number(18, m, static_cast<std::uint64_t>(t + 500));
      before = last;
      last = next;
      if (t < 0) continue;
      for (Eigen::Index c = 0; c < 3; ++c) record(t, c) += 0.01 * shape[m][c] * next;
    }
  }
  for (Eigen::Index c = 0; c < 3; ++c) {
    for (Eigen::Index t = 0; t < kSamples; ++t) {
      record(t, c) += 0.002 * normal_number(18, 7 + static_cast<std::uint64_t>(c), static_cast<std::uint64_t>(t));
    }
    record.col(c).array() += 11.5 * static_cast<double>(c + 1) - record.col(c).mean();
  }
  return record;
}

void write_sound_record(const fs::path& file, const std::string& format) {
  fs::create_directories(file.parent_path());
  for (const char* kind : {"csv", "packets", "late", "seconds", "gap", "midnight", "reversed", "parts", "stuck", "copy",
                           "scaled", "doubled", "slow"}) {
    if (format == kind) return write_csv(file, format);
  }
  if (format == "timed") {  // time at 50.4 Hz in the last column
    MatrixXd timed(kSamples, 4);
    timed << sound_record(), Eigen::VectorXd::LinSpaced(kSamples, 0.0, (kSamples - 1) / 50.4);
    return io::write_npy(timed, file);
  }
  if (format == "npy") return io::write_npy(sound_record(), file);
  if (format == "mat4") return write_mat4(file);
  if (format == "mat5") return write_mat(file, MAT_FT_MAT5, MAT_COMPRESSION_NONE);
  if (format == "mat5z") return write_mat(file, MAT_FT_MAT5, MAT_COMPRESSION_ZLIB);
  if (format == "mat73") return write_mat(file, MAT_FT_MAT73, MAT_COMPRESSION_NONE);
  if (format == "hdf5") return write_hdf5(file);
  if (format == "frf" || format == "frfb") return write_responses(file, format == "frfb");
  if (format == "uff" || format == "uffb") return write_uff(file, format == "uffb");
  throw std::runtime_error("no record is written as '" + format + "'");
}

}  // namespace twindeck::broken
