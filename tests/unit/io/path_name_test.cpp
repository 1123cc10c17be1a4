#include "io/path_name.hpp"

#include "temporary_folder.hpp"

namespace twindeck::io {
namespace {

using PathNameTest = test::TemporaryFolder;

// Oracle: below a folder, "folder / name" is the folder's own child for the first list and something else, or nothing, for the
// second.
TEST_F(PathNameTest, OnlyNamesOfOneFolderArePassed) {
  const auto said = [&](const std::string& name) {
    return refusal([&] { check_path_name(name, "condition", {"c.toml", 3, "condition"}); });
  };
  for (const char* name : {"low_with_dampers", "ST1", "oct1979_484", "Süd-Deck 2", "a..b", "x.y"})
    EXPECT_EQ(said(name), "") << name;
  const std::string slash = "c.toml:3: condition: is '../../x', which ";
  EXPECT_TRUE(said("../../x").starts_with(slash)) << said("../../x");
  EXPECT_NE(said("../../x").find("choose another condition name"), std::string::npos);
  for (const std::string& name :
       {std::string("/x"), std::string("a/b"), std::string("a\\b"), std::string(".."), std::string("."), std::string(".hidden"),
        std::string("a\nb"), std::string("a\0b", 3), std::string(101, 'a')})
    EXPECT_NE(said(name), "") << name;
  EXPECT_TRUE(said("").starts_with("c.toml:3: condition: is empty"));
}

// Oracle: "folder / name" stays below the folder for the first list and not for the second.
TEST_F(PathNameTest, InnerNamesStayBelowTheirFolder) {
  const auto said = [&](const std::string& name) {
    return refusal([&] { check_inner_name(name, "channel", {"channels.csv", 2, "channel"}); });
  };
  for (const char* name : {"A_x", "Dev1/ai0", "run/acc/1", "a..b", "..a", "x.", "Süd-Deck 2"})
    EXPECT_EQ(said(name), "") << name;
  EXPECT_EQ(said("../../x"),
            "channels.csv:2: channel: is '../../x', which leads out of a folder; choose another channel name, such as A_x");
  for (const std::string& name : {std::string("/x"), std::string("a/../b"), std::string("a\\..\\b"), std::string(".."),
                                  std::string("a/.."), std::string("a\nb"), std::string("a\0b", 3), std::string()})
    EXPECT_NE(said(name), "") << name;
}

}  // namespace
}  // namespace twindeck::io
