/// Oracle: counting by hand; and that a file of a million levels is a message, where the parser alone runs off the stack.
#include <gtest/gtest.h>

#include "io/toml_value.hpp"
#include "temporary_folder.hpp"

namespace twindeck::io {
namespace {

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

class TomlNesting : public test::TemporaryFolder {};

TEST_F(TomlNesting, CountsBracketsAndDots) {
  EXPECT_FALSE(line_nested_too_deep("a = 1.5\nb.c.d = [[1, 2], [3, 4]]\n[[x.y]]\nz = { p.q = {} }\n"));
  EXPECT_FALSE(line_nested_too_deep("a = " + repeated("[", most_toml_levels) + repeated("]", most_toml_levels)));
  EXPECT_EQ(line_nested_too_deep("b = 1\na = " + repeated("[", most_toml_levels + 1)), 2);
  EXPECT_EQ(line_nested_too_deep("\n\n[" + repeated("a.", most_toml_levels) + "a]"), 3);
  EXPECT_EQ(line_nested_too_deep(repeated("\"a\".", most_toml_levels) + "a = 1"), 1);
  EXPECT_FALSE(line_nested_too_deep("a = [" + repeated("1.5, [2.5], {b = 3.5}, ", 1000) + "]"));
}

TEST_F(TomlNesting, PassesOverStringsAndComments) {
  const std::string deep = repeated("[.", 100);
  EXPECT_FALSE(line_nested_too_deep("a = \"" + deep + "\\\"" + deep + "\" # " + deep + "\nb = '" + deep + "'\n"));
  EXPECT_FALSE(line_nested_too_deep("a = \"\"\"" + deep + "\n\"" + deep + "\"\"\"\nb = '''" + deep + "\n'" + deep + "'''\n"));
  EXPECT_EQ(line_nested_too_deep("a = \"\"\"\n\n\"\"\"\nb = " + deep), 4);
}

TEST_F(TomlNesting, FilesAndCommandLinesAreRefused) {
  for (const std::string& text : {"a = " + repeated("[", 1000000), "x = 1\n" + repeated("a.", 1000000) + "a = 1\n",
                                  "[" + repeated("a.", 1000000) + "a]\n", "a = " + repeated("{a=", 1000000)}) {
    const auto file = write("deep.toml", text);
    const std::string said = refusal([&] { (void)read_toml(file); });
    EXPECT_NE(said.find("deep.toml:"), std::string::npos) << said;
    EXPECT_NE(said.find("levels"), std::string::npos) << said;
  }
  EXPECT_NE(refusal([] { (void)toml_of_command_line(repeated("[", 1000000), "modes"); }).find("levels"), std::string::npos);
}

}  // namespace
}  // namespace twindeck::io
