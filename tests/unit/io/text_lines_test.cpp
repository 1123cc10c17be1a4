// Oracles: files written here byte by byte, whose text is known.
#include "io/text_lines.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"
#include "temporary_folder.hpp"

namespace twindeck::io {
namespace {

class TextLinesTest : public test::TemporaryFolder {
 protected:
  [[nodiscard]] std::string read_back(const std::string& bytes) const { return text_of_file(write("a.txt", bytes)); }
};

TEST_F(TextLinesTest, EveryLineEndIsOne) {
  EXPECT_EQ(read_back("a\nb\n"), "a\nb\n");
  EXPECT_EQ(read_back("a\rb\r"), "a\nb\n");
  EXPECT_EQ(read_back("a\r\nb"), "a\r\nb");  // the reader of a line drops the return, as it did
}

TEST_F(TextLinesTest, BytesOfAFileWithoutAMarkStay) {
  for (const std::string& text :
       {std::string(), std::string("\n"), std::string("a"), std::string("\xE9\n\n"), std::string("a\0b\n", 4)})
    EXPECT_EQ(read_back(text), text);
}

TEST_F(TextLinesTest, MarksAreDroppedAndUtf16IsUtf8) {
  EXPECT_EQ(read_back("\xEF\xBB\xBF"
                      "a\n"),
            "a\n");
  EXPECT_EQ(read_back(std::string("\xFF\xFE"
                                  "a\0\xE9\0\n\0",
                                  8)),
            "a\xC3\xA9\n");
  EXPECT_EQ(read_back(std::string("\xFE\xFF"
                                  "\0a\0\n",
                                  6)),
            "a\n");
}

TEST_F(TextLinesTest, LongerThanIsReadIsRefusedBeforeItIsRead) {
  const std::filesystem::path file = write("a.txt", "12345");
  EXPECT_THROW(TextLines(file, 4), InputError);
  EXPECT_TRUE(TextLines(file, 5).opened());
  std::filesystem::resize_file(file, longest_text + 1);
  EXPECT_THROW(static_cast<void>(text_of_file(file)), InputError);
}

}  // namespace
}  // namespace twindeck::io
