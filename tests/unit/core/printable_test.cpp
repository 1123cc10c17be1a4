// Oracle: the definition of UTF-8 (RFC 3629) and the escapes promised in core/printable.hpp, worked by hand.
#include "core/printable.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace twindeck {
namespace {

using std::string_literals::operator""s;

TEST(Printable, KeepsLettersOfAnyLanguage) { EXPECT_EQ(printable("Brücke, m/s² 5 µm — 橋"), "Brücke, m/s² 5 µm — 橋"); }

TEST(Printable, EscapesControlCharactersAndStrayBytes) {
  EXPECT_EQ(printable("a\x1b[31mb\0c\x7f"s), "a\\x1b[31mb\\x00c\\x7f");
  EXPECT_EQ(printable("one\r\ntwo\tthree"), "one  two three");
  EXPECT_EQ(printable("latin \xFC"), "latin \\xfc");
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m"),
            "\\xc2\\x9b31m");  // the one-letter form of escape [
  EXPECT_EQ(printable("\xE2\x80\xAE"
                      "gpj.exe"),
            "\\xe2\\x80\\xaegpj.exe");                                        // right-to-left override
  EXPECT_EQ(printable("\xC0\x9B\xED\xA0\x80"), "\\xc0\\x9b\\xed\\xa0\\x80");  // an overlong form, a surrogate
}

TEST(Printable, CutsWhatIsLong) { EXPECT_EQ(printable(std::string(1000000, 'x'), 10), "xxxxxxxxxx..."); }

TEST(Printable, MessagesOfBadInputPassThroughIt) {
  const InputError error({"a\x1b.csv", 3, "k\0y"s}, "is '\x1b]0;owned\x07'", "mend\nit");
  EXPECT_STREQ(error.what(), "a\\x1b.csv:3: k\\x00y: is '\\x1b]0;owned\\x07'; mend it");
  EXPECT_LT(std::string(InputError({"a", 0, ""}, std::string(1000000, 'x')).what()).size(), 2000U);
}

}  // namespace
}  // namespace twindeck
