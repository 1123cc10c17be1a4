// Oracle: the samples that went into each file, equal channel by channel and to the last bit. Files are written by other
// programs where they are installed (SciPy, Octave, h5py), by matio and the HDF5 library, and byte by byte here.
#include "same_samples.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>
#include <matio.h>

#include <array>
#include <cstring>

#include "core/error.hpp"
#include "io/npy.hpp"
#include "npy_double.hpp"
#include "test_places.hpp"
#include "universal_writer.hpp"

namespace twindeck::records {
namespace {

const Eigen::MatrixXd kSamples = same_samples();

void expect_same(const std::filesystem::path& file, double rate_Hz = 128.0, double factor = 1.0) {
  const Record record = read(file);
  const std::string what = file.filename().string() + ": " + record.info.format;
  ASSERT_EQ(record.samples.rows(), kSamples.rows()) << what;
  ASSERT_EQ(record.samples.cols(), kSamples.cols()) << what;
  for (int c = 0; c < kSamples.cols(); ++c)
    EXPECT_EQ(Eigen::VectorXd(record.samples.col(c)), Eigen::VectorXd(factor * kSamples.col(c))) << what << ", channel " << c;
  EXPECT_NEAR(record.info.rate_Hz, rate_Hz, 1e-9) << what;
  // Chosen columns in another order, as a campaign asks for them.
  const Samples some = read(file, {3, 0}, kSamples.rows());
  EXPECT_EQ(Eigen::VectorXd(some.col(0)), Eigen::VectorXd(factor * kSamples.col(3))) << what;
  EXPECT_EQ(Eigen::VectorXd(some.col(1)), Eigen::VectorXd(factor * kSamples.col(0))) << what;
  EXPECT_THROW(static_cast<void>(read(file, {0}, kSamples.rows() - 1)), InputError) << what;
}

bool runs(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()) == 0; }

TEST(SameSamples, MatFilesOfSciPy) {
  const Scratch scratch;
  const std::string python = TWINDECK_PYTHON;
  if (!runs(python + " -c 'import scipy.io'")) GTEST_SKIP() << "SciPy is not installed";
  ASSERT_TRUE(runs(python + " " + TWINDECK_SOURCE_DIR + "/tests/unit/records/write_arrays.py " + scratch.file("").string()));
  for (const char* name : {"scipy_4.mat", "scipy_5.mat", "scipy_5_compressed.mat", "scipy_5_fortran.mat"})
    expect_same(scratch.file(name));
  for (const char* ending : {".mat", "_compressed.mat"}) {
    for (const char* kind : {"transposed", "single", "structure", "vectors"})
      expect_same(scratch.file(std::string(kind) + ending));
    expect_same(scratch.file(std::string("whole") + ending), 128.0, 64.0);
    for (const char* kind : {"structure", "vectors"}) {
      const RecordInfo info = read(scratch.file(std::string(kind) + ending)).info;
      EXPECT_EQ(info.channels[0].name, "A_x") << kind << ending;
      EXPECT_EQ(info.channels[3].name,
                "Br\xC3\xBC"
                "cke")
          << kind << ending;
    }
  }
  if (std::filesystem::exists(scratch.file("h5py.h5"))) expect_same(scratch.file("h5py.h5"));
}

TEST(SameSamples, FilesOfOctave) {
  if (!runs("command -v octave-cli")) GTEST_SKIP() << "Octave is not installed";
  const Scratch scratch;
  const std::string program =
      "cd '" + scratch.file("").string() +
      "'; [c, t] = meshgrid(0:3, 0:399); acc = (mod(37 * t + 1001 * c, 4096) - 2048) / 64; fs = 128; "
      "save('-v4', 'v4.mat', 'acc', 'fs'); save('-v6', 'v6.mat', 'acc', 'fs'); save('-v7', 'v7.mat', 'acc', 'fs');";
  ASSERT_TRUE(runs("octave-cli --eval \"" + program + "\""));
  for (const char* name : {"v4.mat", "v6.mat", "v7.mat"}) expect_same(scratch.file(name));
}

TEST(SameSamples, MatFilesOfMatio) {
  const Scratch scratch;
  for (const bool transposed : {false, true}) {
    const Eigen::MatrixXd samples = transposed ? Eigen::MatrixXd(kSamples.transpose()) : kSamples;
    for (const bool compressed : {false, true}) {
      write_mat(scratch.file("5.mat"), samples, MAT_FT_MAT5, compressed);
      expect_same(scratch.file("5.mat"));
      write_mat(scratch.file("73.mat"), samples, MAT_FT_MAT73, compressed);
      expect_same(scratch.file("73.mat"));
      EXPECT_TRUE(read(scratch.file("73.mat"))
                      .info.format.starts_with("MAT 7.3, array 'acc' " + std::string(transposed ? "4 x 400" : "400 x 4")));
    }
  }
}

/// A variable of version 4 in either order of bytes.
std::string level_4(const std::string& name, const Eigen::MatrixXd& values, bool big_endian) {
  std::string bytes;
  const auto add = [&](auto number) {
    std::array<char, sizeof(number)> b{};
    std::memcpy(b.data(), &number, sizeof(number));
    if (big_endian) std::reverse(b.begin(), b.end());
    bytes.append(b.data(), b.size());
  };
  for (const std::int32_t word : {big_endian ? 1000 : 0, static_cast<int>(values.rows()), static_cast<int>(values.cols()), 0,
                                  static_cast<int>(name.size()) + 1})
    add(word);
  bytes += name + '\0';
  for (const double value : values.reshaped()) add(value);
  return bytes;
}

TEST(SameSamples, MatFilesOfBothOrdersOfBytes) {
  const Scratch scratch;
  const Eigen::MatrixXd fs = Eigen::MatrixXd::Constant(1, 1, 128.0);
  for (const bool big : {false, true})
    expect_same(scratch.write("4.mat", level_4("acc", kSamples, big) + level_4("fs", fs, big)));
  // Version 5 as a big-endian machine writes it: an uncompressed file of matio's with every number turned.
  write_mat(scratch.file("5.mat"), kSamples, MAT_FT_MAT5, false);
  std::string turned = content_of(scratch.file("5.mat"));
  const auto turn = [&](std::size_t at, std::size_t width, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k)
      std::reverse(turned.begin() + static_cast<long>(at + k * width),
                   turned.begin() + static_cast<long>(at + (k + 1) * width));
  };
  turn(124, 2, 2);
  for (std::size_t at = 128; at < turned.size();) {
    std::uint32_t bytes = 0, values = 0;
    std::memcpy(&bytes, turned.data() + at + 4, 4);
    std::size_t name = at + 40;  // tags and data of flags and dimensions are words; so is the tag of the name
    const bool small = turned[name + 2] != 0;
    const std::size_t data = small ? name + 8 : name + 8 + (static_cast<std::size_t>(turned[name + 4]) + 7) / 8 * 8;
    std::memcpy(&values, turned.data() + data + 4, 4);
    turn(at, 4, 10);
    turn(name, 4, small ? 1 : 2);
    turn(data, 4, 2);
    turn(data + 8, 8, values / 8);
    at += 8 + bytes;
  }
  expect_same(scratch.write("big.mat", turned));
}

/// Writes a dataset of HDF5. @param chunk  0 for none
void write_dataset(hid_t file, const char* name, const Eigen::MatrixXd& values, hid_t type, hsize_t chunk) {
  const hsize_t dims[2] = {static_cast<hsize_t>(values.rows()), static_cast<hsize_t>(values.cols())},
                part[2] = {chunk, dims[1]};
  const hid_t space = H5Screate_simple(values.cols() == 1 ? 1 : 2, dims, nullptr), settings = H5Pcreate(H5P_DATASET_CREATE);
  if (chunk > 0) {
    H5Pset_chunk(settings, values.cols() == 1 ? 1 : 2, part);
    H5Pset_deflate(settings, 6);
  }
  const hid_t set = H5Dcreate2(file, name, type, space, H5P_DEFAULT, settings, H5P_DEFAULT);
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = values;
  H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data());
  H5Dclose(set);
  H5Pclose(settings);
  H5Sclose(space);
}

TEST(SameSamples, Hdf5) {
  const Scratch scratch;
  const Eigen::MatrixXd fs = Eigen::MatrixXd::Constant(1, 1, 128.0);
  for (const hid_t type : {H5T_IEEE_F64LE, H5T_IEEE_F64BE, H5T_IEEE_F32LE}) {
    for (const hsize_t chunk : {0, 33}) {
      for (const bool transposed : {false, true}) {
        const hid_t file = H5Fcreate(scratch.file("a.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
        write_dataset(file, "acc", transposed ? Eigen::MatrixXd(kSamples.transpose()) : kSamples, type,
                      transposed ? std::min<hsize_t>(chunk, 3) : chunk);
        write_dataset(file, "fs", fs, H5T_IEEE_F64LE, 0);
        H5Fclose(file);
        expect_same(scratch.file("a.h5"));
      }
    }
  }
  const hid_t file = H5Fcreate(scratch.file("vectors.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  for (int c = 0; c < 4; ++c) write_dataset(file, fmt::format("a{}", c).c_str(), kSamples.col(c), H5T_IEEE_F64LE, 0);
  write_dataset(file, "fs", fs, H5T_IEEE_F64LE, 0);
  H5Fclose(file);
  expect_same(scratch.file("vectors.h5"));
  EXPECT_TRUE(read(scratch.file("vectors.h5")).info.names_channels);
}

TEST(SameSamples, Npy) {
  const Scratch scratch;
  io::write_npy(kSamples, scratch.file("a.npy"));
  expect_same(scratch.file("a.npy"), 0.0);
  io::write_npy_single(kSamples, scratch.file("b.npy"));
  expect_same(scratch.file("b.npy"), 0.0);
}

TEST(SameSamples, UniversalFiles) {
  const Scratch scratch;
  expect_same(scratch.write("58.uff", universal_58(kSamples, 128.0, false)));
  expect_same(scratch.write("58b.uff", universal_58(kSamples, 128.0, true)));
  expect_same(scratch.write("58b_big.uff", universal_58(kSamples, 128.0, true, true)));
  EXPECT_EQ(read(scratch.file("58b.uff")).info.channels[2].name, "A3");
}

/// A number as `digits` prints it, with the dialect's decimal sign.
std::string printed(double value, const char* digits, bool comma) {
  std::string text = fmt::format(fmt::runtime(digits), value);
  if (comma) std::replace(text.begin(), text.end(), '.', ',');
  return text;
}

struct Dialect {
  std::string name, header, separator, end;
  const char* digits = "{:.6f}";
  bool comma = false, time = true;
};

TEST(SameSamples, CsvInSixDialects) {
  const Scratch scratch;
  const std::vector<Dialect> dialects = {
      {"plain.csv", "time_s,A_x,B_x,C_z,D_z\n", ",", "\n"},
      {"semicolons.csv",
       "sep=;\r\nBr\xFC"
       "cke;;;;\r\nZeit;A_x;B_x;C_z;D_z\r\ns;m/s\xB2;m/s\xB2;m/s\xB2;m/s\xB2\r\n",
       ";", ";\r\n", "{:.6f}", true},
      {"tabs.txt", "# logger 7\n# fs = 128 Hz\nA_x [g]\tB_x [g]\tC_z (mm/s)\tD_z [V]\n", "\t", "\n", "{:.7E}", false, false},
      {"blanks.dat", "", "   ", "\n", "{:.6f}", false, true},
      {"pipes.csv", "\xEF\xBB\xBF\"t (ms)\"|\"A_x\"|\"B_x\"|\"C_z\"|\"D_z\"\n", "|", "\n"},
      {"stamps.csv", "Timestamp,A_x,B_x,C_z,D_z\n--------,---,---,---,---\n", ",", "\n"}};
  for (const Dialect& d : dialects) {
    std::string text = d.header;
    for (int t = 0; t < kSamples.rows(); ++t) {
      const double seconds = t / 128.0;
      std::string row;
      if (d.name == "stamps.csv") {
        row = fmt::format("2026-11-23T10:00:{:09.6f}Z", seconds);
      } else if (d.time) {
        row = printed(d.name == "pipes.csv" ? 1000.0 * seconds : seconds, "{:.9f}", d.comma);
      }
      for (int c = 0; c < 4; ++c) row += (row.empty() ? "" : d.separator) + printed(kSamples(t, c), d.digits, d.comma);
      text += row + d.end;
    }
    expect_same(scratch.write(d.name, text));
    const RecordInfo info = read(scratch.file(d.name)).info;
    EXPECT_EQ(info.names_channels, d.name != "blanks.dat") << d.name;
    EXPECT_EQ(info.channels[3].name, d.name == "blanks.dat" ? "column 5" : "D_z") << d.name;
    EXPECT_TRUE(info.notes.empty()) << d.name << ": " << info.notes.front();
  }
}

}  // namespace
}  // namespace twindeck::records
