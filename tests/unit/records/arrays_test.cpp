// Oracle: arrays written with matio and the HDF5 library, read back.
#include <gtest/gtest.h>
#include <hdf5.h>
#include <matio.h>

#include "core/error.hpp"
#include "npy_double.hpp"
#include "records/array_choice.hpp"
#include "records/inspect.hpp"
#include "scratch.hpp"

namespace twindeck::records {
namespace {

Eigen::MatrixXd samples() {
  Eigen::MatrixXd data(400, 3);
  for (int t = 0; t < 400; ++t) {
    for (int c = 0; c < 3; ++c) data(t, c) = t + 0.001 * c;
  }
  return data;
}

void add(mat_t* mat, const char* name, const Eigen::MatrixXd& values, matio_compression compression) {
  Eigen::MatrixXd copy = values;
  std::size_t dims[2] = {static_cast<std::size_t>(copy.rows()), static_cast<std::size_t>(copy.cols())};
  matvar_t* variable = Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims, copy.data(), 0);
  ASSERT_EQ(Mat_VarWrite(mat, variable, compression), 0);
  Mat_VarFree(variable);
}

TEST(NamedRates, AsProgramsCallThem) {
  for (const char* step : {"Signal_0.x_values.increment", "dt", "sampling_interval", "Xincrement"})
    EXPECT_NEAR(rate_of(step, 0.01), 100.0, 1e-9) << step;
  EXPECT_EQ(rate_of("samples", 100.0), 0.0);
}

TEST(MatRecord, Version5AndVersion73) {
  const Scratch scratch;
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    for (const bool transposed : {false, true}) {
      const std::string file = scratch.file(fmt::format("a{}{}.mat", static_cast<int>(version), transposed)).string();
      mat_t* mat = Mat_CreateVer(file.c_str(), nullptr, version);
      ASSERT_NE(mat, nullptr);
      const auto compression = version == MAT_FT_MAT5 ? MAT_COMPRESSION_ZLIB : MAT_COMPRESSION_NONE;
      add(mat, "acc", transposed ? Eigen::MatrixXd(samples().transpose()) : samples(), compression);
      add(mat, "fs", Eigen::MatrixXd::Constant(1, 1, 128.0), compression);
      Mat_Close(mat);
      const Record record = read(file);
      EXPECT_EQ(record.samples, samples()) << record.info.format;
      EXPECT_NEAR(record.info.rate_Hz, 128.0, 1e-12);
    }
  }
}

TEST(MatRecord, VectorsWithATime) {
  const Scratch scratch;
  const std::string file = scratch.file("v.mat").string();
  mat_t* mat = Mat_CreateVer(file.c_str(), nullptr, MAT_FT_MAT5);
  add(mat, "a1", samples().col(0), MAT_COMPRESSION_NONE);
  add(mat, "a2", samples().col(1), MAT_COMPRESSION_NONE);
  add(mat, "t", Eigen::VectorXd::LinSpaced(400, 0.0, 399.0 / 50.0), MAT_COMPRESSION_NONE);
  Mat_Close(mat);
  const Record record = read(file);
  EXPECT_EQ(record.samples, samples().leftCols(2));
  EXPECT_NEAR(record.info.rate_Hz, 50.0, 1e-9);
  EXPECT_EQ(record.info.channels[1].name, "a2");
}

TEST(MatRecord, UnitsOfTimesAndSteps) {
  const Scratch scratch;
  for (const char* name : {"time_ms", "timestamp (ms)", "dt", "dt_ms"}) {
    const std::string file = scratch.file("u.mat").string();
    mat_t* mat = Mat_CreateVer(file.c_str(), nullptr, MAT_FT_MAT5);
    add(mat, "acc", samples().array().sin().matrix(), MAT_COMPRESSION_NONE);
    const bool step = name[0] == 'd';
    add(mat, name, step ? Eigen::MatrixXd::Constant(1, 1, 20.0) : Eigen::MatrixXd(Eigen::VectorXd::LinSpaced(400, 0.0, 7980.0)),
        MAT_COMPRESSION_NONE);
    Mat_Close(mat);
    EXPECT_NEAR(read(file).info.rate_Hz, 50.0, 1e-9) << name;
  }
}

TEST(Hdf5Record, DatasetInAGroupWithARateAttribute) {
  const Scratch scratch;
  const std::string file = scratch.file("a.h5").string();
  const hid_t h5 = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT),
              group = H5Gcreate2(h5, "run1", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  const hsize_t dims[2] = {400, 3};
  const hid_t space = H5Screate_simple(2, dims, nullptr);
  const hid_t set = H5Dcreate2(group, "acceleration", H5T_IEEE_F32LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = samples();
  H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data());
  const hid_t scalar = H5Screate(H5S_SCALAR),
              attribute = H5Acreate2(set, "sampling_rate", H5T_IEEE_F64LE, scalar, H5P_DEFAULT, H5P_DEFAULT);
  const double rate = 250.0;
  H5Awrite(attribute, H5T_NATIVE_DOUBLE, &rate);
  H5Aclose(attribute);
  H5Sclose(scalar);
  H5Dclose(set);
  H5Sclose(space);
  H5Gclose(group);
  H5Fclose(h5);
  const Record record = read(file);
  EXPECT_LT((record.samples - samples()).cwiseAbs().maxCoeff(), 4e-5);  // single precision
  EXPECT_NEAR(record.info.rate_Hz, 250.0, 1e-12);
}

TEST(NpyRecord, ComesBack) {
  const Scratch scratch;
  io::write_npy(samples(), scratch.file("a.npy"));
  EXPECT_EQ(read(scratch.file("a.npy")).samples, samples());
  EXPECT_EQ(inspect(scratch.file("a.npy")).channels.size(), 3U);
}

TEST(NpyRecord, ChosenColumnsInTheOrderAskedFor) {
  const Scratch scratch;
  io::write_npy(samples(), scratch.file("a.npy"));
  const Samples some = read(scratch.file("a.npy"), {2, 0}, samples().rows());
  EXPECT_EQ(Eigen::MatrixXd(some), samples()(Eigen::all, std::vector<Eigen::Index>{2, 0}));
}

TEST(ArrayRecord, DamagedFilesAreRefused) {
  const Scratch scratch;
  EXPECT_THROW(static_cast<void>(read(scratch.write("a.mat", "MATLAB 5.0 MAT-file, nothing follows"))), InputError);
  EXPECT_THROW(static_cast<void>(read(scratch.write("a.h5", "\x89HDF\r\n\x1a\n and nothing"))), InputError);
}

int unpacked = 0;  ///< chunks that the filter below has read

/// A filter of the library that changes nothing and counts the chunks that are read through it.
std::size_t count_chunks(unsigned flags, std::size_t, const unsigned*, std::size_t bytes, std::size_t*, void**) {
  if ((flags & H5Z_FLAG_REVERSE) != 0) ++unpacked;
  return bytes;
}

// The file has one filtered chunk, and a scan reads some hundred blocks of it.
TEST(Hdf5Record, DecompressesAChunkOnceForAllBlocksInIt) {
  constexpr H5Z_filter_t number = 305;  // of those for tests
  const H5Z_class2_t counting = {H5Z_CLASS_T_VERS, number, 1, 1, "count", nullptr, nullptr, count_chunks};
  ASSERT_GE(H5Zregister(&counting), 0);
  const Scratch scratch;
  constexpr hsize_t rows = 2'000'000, columns = 8;
  for (const bool along_rows : {false, true}) {
    const std::string file = scratch.file("chunk.h5").string();
    const hsize_t dims[2] = {along_rows ? columns : rows, along_rows ? rows : columns};
    const hid_t h5 = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), settings = H5Pcreate(H5P_DATASET_CREATE),
                space = H5Screate_simple(2, dims, nullptr);
    H5Pset_chunk(settings, 2, dims);
    H5Pset_filter(settings, number, 0, 0, nullptr);
    const hid_t set = H5Dcreate2(h5, "a", H5T_STD_I16LE, space, H5P_DEFAULT, settings, H5P_DEFAULT);
    std::vector<std::int16_t> values(rows * columns);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::int16_t>(i % 1000);
    H5Dwrite(set, H5T_NATIVE_INT16, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(set);
    H5Pclose(settings);
    H5Sclose(space);
    H5Fclose(h5);
    Eigen::Index samples_seen = 0;
    unpacked = 0;
    static_cast<void>(
        scan(file, [&](Eigen::Index, Eigen::Index, const Eigen::MatrixXd& block) { samples_seen += block.rows(); }));
    EXPECT_EQ(samples_seen, static_cast<Eigen::Index>(rows));
    EXPECT_EQ(unpacked, 1) << along_rows;
  }
}

}  // namespace
}  // namespace twindeck::records
