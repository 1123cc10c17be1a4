// Oracle: the NPY format (NEP 1), with files put together byte by byte as NumPy writes them; a round trip keeps every bit.
#include "io/npy.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>

#include "temporary_folder.hpp"

namespace twindeck::io {
namespace {

class Npy : public test::TemporaryFolder {
 protected:
  template <typename Number>
  static std::string file_of(const std::string& description, const std::vector<Number>& values) {
    std::string header = description;
    header.append(63 - (10 + header.size()) % 64, ' ');
    header += '\n';
    std::string content = std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header;
    content.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Number));
    return content;
  }
};

TEST_F(Npy, RoundTripKeepsEveryBit) {
  Eigen::MatrixXd array = Eigen::MatrixXd::Random(1237, 3);
  array(5, 1) = std::numeric_limits<double>::quiet_NaN();
  write_npy_single(array, folder_ / "a.npy");
  const Eigen::MatrixXd back = read_npy(folder_ / "a.npy");
  ASSERT_EQ(back.rows(), 1237);
  ASSERT_EQ(back.cols(), 3);
  const Eigen::MatrixXf written = array.cast<float>(), read = back.cast<float>();
  EXPECT_EQ(std::memcmp(read.data(), written.data(), sizeof(float) * 3711), 0);
  EXPECT_EQ((content(folder_ / "a.npy").size() - sizeof(float) * 3711) % 64, 0U);
}

TEST_F(Npy, ReadsSinglePrecisionAndFortranOrder) {
  const auto c =
      write("c.npy", file_of<float>("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }", {1, 2, 3, 4, 5, 6}));
  const auto f =
      write("f.npy", file_of<double>("{'descr': '<f8', 'fortran_order': True, 'shape': (2, 3), }", {1, 4, 2, 5, 3, 6}));
  const auto v = write("v.npy", file_of<double>("{'descr': '<f8', 'fortran_order': False, 'shape': (4,), }", {1, 2, 3, 4}));
  const Eigen::MatrixXd expected = (Eigen::MatrixXd(2, 3) << 1, 2, 3, 4, 5, 6).finished();
  EXPECT_EQ(read_npy(c), expected);
  for (const char* shape : {"(1, 2, 3)", "(2, 1, 3)", "(2, 3, 1, 1)"})  // a dimension of one holds nothing
    EXPECT_EQ(
        read_npy(write("s.npy", file_of<float>(fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': {}, }}", shape),
                                               {1, 2, 3, 4, 5, 6}))),
        expected)
        << shape;
  EXPECT_EQ(read_npy(f), expected);
  EXPECT_EQ(read_npy(v), Eigen::VectorXd::LinSpaced(4, 1, 4));
}

TEST_F(Npy, RefusesWhatItCannotRead) {
  EXPECT_NE(refusal([&] { (void)read_npy(folder_ / "none.npy"); }).find("cannot be read"), std::string::npos);
  EXPECT_NE(refusal([&] { (void)read_npy(write("t.npy", "time_s,c01\n0,1\n")); }).find("is no NPY file"), std::string::npos);
  const auto ints = write("i.npy", file_of<std::int64_t>("{'descr': '<i8', 'fortran_order': False, 'shape': (1,), }", {1}));
  EXPECT_NE(refusal([&] { (void)read_npy(ints); }).find("holds type '<i8', expected '<f8', '<f4', '<i2' or '<i4'"),
            std::string::npos);
  const auto cube = write(
      "3.npy", file_of<double>("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 1, 2, 2), }", {1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_NE(refusal([&] { (void)read_npy(cube); }).find("one or two dimensions"), std::string::npos);
  const auto cut = write("s.npy", file_of<double>("{'descr': '<f8', 'fortran_order': False, 'shape': (4, 1), }", {1, 2, 3}));
  EXPECT_NE(refusal([&] { (void)read_npy(cut); }).find("holds 24 bytes of data, expected 32 for 4 x 1 values"),
            std::string::npos);
}

// Oracle: the sizes that the file has. A header that claims more is refused before anything is allocated.
TEST_F(Npy, SizesInTheHeaderAreHeldAgainstTheFile) {
  const auto said = [&](const std::string& shape) {
    const auto file =
        write("h.npy", file_of<double>("{'descr': '<f8', 'fortran_order': False, 'shape': " + shape + ", }", {1, 2, 3}));
    return refusal([&] { (void)read_npy(file); });
  };
  EXPECT_NE(said("(1000000000000, 1000000)").find("h.npy: holds 24 bytes of data, expected 8000000000000000000"),
            std::string::npos);
  EXPECT_NE(said("(2305843009213693955, 8)").find("holds 24 bytes"),
            std::string::npos);  // 2^61 + 3: the product of bytes wraps to 24 * 8
  EXPECT_NE(said("(2305843009213693955,)").find("holds 24 bytes"), std::string::npos);
  EXPECT_NE(said("(99999999999999999999, 3)").find("another shape"), std::string::npos);
  EXPECT_NE(said("(1000000000000, 0)").find("without any value"), std::string::npos);
  EXPECT_NE(said("(-3, 1)").find("another shape"), std::string::npos);
  EXPECT_NE(said("(3, 1").find("another shape"), std::string::npos);
  EXPECT_EQ(said("( 3 , 1 )"), "");
}

// A regular expression on this header overflowed the stack.
TEST_F(Npy, ALongDescriptorIsRefusedInOneLine) {
  std::string header = "{'descr': '" + std::string(60000, 'f') + "', 'fortran_order': False, 'shape': (1,), }";
  std::string content = std::string("\x93NUMPY\x01\x00", 8);
  content += static_cast<char>(header.size() % 256);
  content += static_cast<char>(header.size() / 256);
  const auto file = write("l.npy", content + header);
  const std::string said = refusal([&] { (void)read_npy(file); });
  EXPECT_TRUE(said.starts_with("l.npy: holds type 'ffff")) << said.substr(0, 80);
  EXPECT_LT(said.size(), 4000U);
  const std::string blanks = "{'descr':" + std::string(60000, ' ') + "x}";
  content[8] = static_cast<char>(blanks.size() % 256);
  content[9] = static_cast<char>(blanks.size() / 256);
  const auto blank = write("b.npy", content + blanks);
  EXPECT_NE(refusal([&] { (void)read_npy(blank); }).find("without 'descr'"), std::string::npos);
}

TEST_F(Npy, APipeOrADeviceIsRefused) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe.npy").c_str(), 0600), 0);
  EXPECT_NE(refusal([&] { (void)read_npy(folder_ / "pipe.npy"); }).find("pipe.npy: is a pipe"), std::string::npos);
  EXPECT_NE(refusal([&] { (void)read_npy("/dev/zero"); }).find("/dev/zero: is a pipe, a socket or a device"),
            std::string::npos);
  EXPECT_NE(refusal([&] { (void)read_npy(folder_); }).find("is a folder"), std::string::npos);
}

}  // namespace
}  // namespace twindeck::io
