/// Oracle: a matrix written out by hand in each of the three forms of OUTPUT4, whose numbers are integers that text holds
/// exactly.
#include "matrix_io/op4.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>

#include "matrix_io/matrix_market.hpp"
#include "unit/model_io/test_folder.hpp"

namespace twindeck::matrix_io::test {
namespace {

using model_io::test::message_of;
using model_io::test::TestFolder;

const std::string op4_header = "       3       3       6       2KGG     1P,3E23.16\n";
const std::string op4_end = "       4       1       1\n 1.0000000000000000E+00\n";

/// [4 -1 0; -1 5 -2; 0 -2 6]: as dense columns, as strings and as strings of BIGMAT.
const std::string dense_columns =
    "       1       1       4\n 4.0000000000000000E+00-1.0000000000000000E+00\n"
    "       2       1       6\n-1.0000000000000000E+00 5.0000000000000000E+00-2.0000000000000000E+00\n"
    "       3       2       4\n-2.0000000000000000E+00 6.0000000000000000E+00\n";
const std::string strings =
    "       1       0       5\n  327681\n 4.0000000000000000E+00-1.0000000000000000E+00\n"
    "       2       0       7\n  458753\n-1.0000000000000000E+00 5.0000000000000000E+00-2.0000000000000000E+00\n"
    "       3       0       6\n  196610\n-2.0000000000000000E+00\n  196611\n 6.0000000000000000E+00\n";
const std::string bigmat_strings =
    "       1       0       6\n       5       1\n 4.0000000000000000E+00-1.0000000000000000E+00\n"
    "       2       0       8\n       7       1\n-1.0000000000000000D+00 5.0000000000000000D+00-2.0000000000000000D+00\n"
    "       3       0       6\n       5       2\n-2.0000000000000000E+00 6.0000000000000000E+00\n";

Eigen::MatrixXd read_text_op4(const TestFolder& folder, const std::string& text) {
  folder.write("K.op4", text);
  return Eigen::MatrixXd(read_op4(folder.path() / "K.op4")).selfadjointView<Eigen::Lower>();
}

TEST(Op4, EveryFormHoldsTheSameMatrix) {
  const TestFolder folder;
  const Eigen::Matrix3d expected{{4.0, -1.0, 0.0}, {-1.0, 5.0, -2.0}, {0.0, -2.0, 6.0}};
  std::string big_header = op4_header;
  big_header.replace(8, 8, "      -3");
  EXPECT_EQ(read_text_op4(folder, op4_header + dense_columns + op4_end), expected);
  EXPECT_EQ(read_text_op4(folder, op4_header + strings + op4_end), expected);
  EXPECT_EQ(read_text_op4(folder, big_header + bigmat_strings + op4_end), expected);
  EXPECT_EQ(op4_rows(folder.path() / "K.op4"), 3);
  // One triangle of a symmetric form; columns without entries are left out.
  const std::string triangle =
      "       1       1       2\n 4.0000000000000000E+00-1.0000000000000000E+00\n"
      "       2       2       2\n 5.0000000000000000E+00-2.0000000000000000E+00\n"
      "       3       3       1\n 6.0000000000000000E+00\n";
  EXPECT_EQ(read_text_op4(folder, op4_header + triangle + op4_end), expected);
}

/// Fortran's unformatted records of the same matrix, with words of `word` bytes, in the other order of bytes if `reversed`.
class BinaryFile {
 public:
  BinaryFile(int word, bool reversed) : word_(word), reversed_(reversed) {}
  BinaryFile& whole(std::initializer_list<long> numbers) {
    for (const long number : numbers)
      word_ == 4 ? put(static_cast<std::int32_t>(number)) : put(static_cast<std::int64_t>(number));
    return *this;
  }
  BinaryFile& real(std::initializer_list<double> numbers) {
    for (const double number : numbers) put(number);
    return *this;
  }
  BinaryFile& single(std::initializer_list<double> numbers) {
    for (const double number : numbers) put(static_cast<float>(number));
    return *this;
  }
  BinaryFile& name() {
    record_ += word_ == 4 ? "KGG     " : "KGG             ";
    return *this;
  }
  BinaryFile& end_record() {
    const std::string body = record_;
    record_.clear();
    put(static_cast<std::int32_t>(body.size()));
    const std::string length = record_;
    record_.clear();
    bytes_ += length + body + length;
    return *this;
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  template <class T>
  void put(T value) {
    std::string raw(reinterpret_cast<const char*>(&value), sizeof(T));
    if (reversed_) std::reverse(raw.begin(), raw.end());
    record_ += raw;
  }
  int word_;
  bool reversed_;
  std::string record_, bytes_;
};

/// Dense columns (nonzero from the first to the last), strings, strings of BIGMAT. @param words  of a number
std::string binary_op4(int word, bool reversed, const std::string& form) {
  const long words = word == 4 ? 2 : 1;
  BinaryFile file(word, reversed);
  file.whole({3, form == "bigmat" ? -3 : 3, 6, 2}).name().end_record();
  const auto string_head = [&](long count, long row) {
    if (form == "bigmat")
      file.whole({count * words + 1, row});
    else
      file.whole({row + 65536 * (count * words + 1)});
  };
  if (form == "dense") {
    file.whole({1, 1, 2 * words}).real({4.0, -1.0}).end_record();
    file.whole({2, 1, 3 * words}).real({-1.0, 5.0, -2.0}).end_record();
    file.whole({3, 2, 2 * words}).real({-2.0, 6.0}).end_record();
  } else {
    file.whole({1, 0, 2 * words + 1});
    string_head(2, 1);
    file.real({4.0, -1.0}).end_record();
    file.whole({2, 0, 3 * words + 1});
    string_head(3, 1);
    file.real({-1.0, 5.0, -2.0}).end_record();
    file.whole({3, 0, 2 * words + 2});  // as two strings of one
    string_head(1, 2);
    file.real({-2.0});
    string_head(1, 3);
    file.real({6.0}).end_record();
  }
  return file.whole({4, 1, words}).real({1.0}).end_record().bytes();
}

TEST(Op4, BinaryFilesHoldTheSameMatrix) {
  const TestFolder folder;
  const Eigen::Matrix3d expected{{4.0, -1.0, 0.0}, {-1.0, 5.0, -2.0}, {0.0, -2.0, 6.0}};
  for (const int word : {4, 8})
    for (const bool reversed : {false, true})
      for (const char* form : {"dense", "strings", "bigmat"}) {
        EXPECT_EQ(read_text_op4(folder, binary_op4(word, reversed, form)), expected) << word << reversed << form;
        EXPECT_EQ(op4_rows(folder.path() / "K.op4"), 3);
      }
  // Single precision has one word a number.
  BinaryFile single(4, false);
  single.whole({1, 1, 6, 1}).name().end_record();
  single.whole({1, 1, 1}).single({2.5}).end_record();
  single.whole({2, 1, 1}).single({1.0}).end_record();
  EXPECT_EQ(read_text_op4(folder, single.bytes()), Eigen::MatrixXd::Constant(1, 1, 2.5));
}

TEST(Op4, DamagedBinaryFilesNameTheirByte) {
  const TestFolder folder;
  const auto expect = [&](const std::string& bytes, const std::string& words) {
    const std::string message = message_of([&] { (void)read_text_op4(folder, bytes); });
    EXPECT_NE(message.find("K.op4: byte "), std::string::npos) << message;
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  const std::string sound = binary_op4(4, false, "strings");
  for (std::size_t length = 4; length < sound.size(); length += 7) {  // cut anywhere
    const std::string message = message_of([&] { (void)read_text_op4(folder, sound.substr(0, length)); });
    EXPECT_NE(message.find("K.op4: byte "), std::string::npos) << length << message;
  }
  expect(sound + sound, "a second matrix follows");
  std::string other = sound;
  other.at(28) = 25;  // the header's second length
  expect(other, "two lengths differ");
  const auto headed = [](std::initializer_list<long> header) {
    return BinaryFile(4, false).whole(header).name().end_record().bytes();
  };
  expect(headed({3, 3, 6, 4}), "holds numbers of type 4");
  expect(headed({3, 2, 2, 2}), "is 2 x 3");
  expect(headed({1000000, 1000000, 6, 2}), "says 1000000 columns, more than a file of 32 bytes holds");
  BinaryFile far(4, false);
  far.whole({3, 3, 6, 2}).name().end_record().whole({1, 3, 4}).real({4.0, -1.0}).end_record();
  expect(far.bytes(), "row 4 lies outside");
  BinaryFile twice(4, false);
  twice.whole({3, 3, 6, 2}).name().end_record();
  twice.whole({1, 1, 2}).real({4.0}).end_record().whole({1, 1, 2}).real({4.0}).end_record();
  expect(twice.bytes(), "entry (1, 1) stands twice");
}

TEST(Op4, RefusalsNameTheirLine) {
  const TestFolder folder;
  const auto expect = [&](const std::string& text, const std::string& words) {
    const std::string message = message_of([&] { (void)read_text_op4(folder, text); });
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  const std::string sound = op4_header + dense_columns + op4_end;
  expect("", "K.op4:1: '' is no whole number");
  expect(std::string("\x17\0\0\0\x03\0\0\0", 8), "K.op4:1: is neither formatted nor a binary file");
  expect("       3       3       6       4KGG     1P,3E23.16\n", "K.op4:1: holds numbers of type 4");
  expect("       3       2       2       2KGG     1P,3E23.16\n", "K.op4:1: is 2 x 3");
  expect("       3       3       6       2KGG     free\n", "K.op4:1: ");
  expect(op4_header + dense_columns, "the file ends before the matrix does");
  expect(sound + sound, "K.op4:10: a second matrix follows");
  expect(op4_header + "       1       1       9\n 4.0000000000000000E+00\n" + op4_end, "K.op4:4: 1 values stand above");
  expect(op4_header + "       1       3       2\n 4.0000000000000000E+00 1.0000000000000000E+00\n" + op4_end,
         "K.op4:3: row 4 lies outside");
  expect(op4_header + "       1       1       1\n nan.                  \n" + op4_end, "K.op4:3: 'nan.");
  std::string lopsided = sound;
  lopsided.replace(lopsided.find("-1.0"), 4, "-3.0");
  expect(lopsided, "is not symmetric: entry (2, 1) is -3, entry (1, 2) is -1");
}

}  // namespace
}  // namespace twindeck::matrix_io::test
