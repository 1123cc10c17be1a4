/// Oracle: the format of loads.csv (docs/my_model.md): cases in the order of the file, each once; one line for what is wrong.
#include "model_io/load_cases.hpp"

#include "test_folder.hpp"

namespace twindeck::model_io::test {
namespace {

const char* const kLoads = "load,node,direction,value,unit\nlorry,7,z,-1.2e5,N\nwind,3,y,2e3,N\nlorry,8,z,-1.2e5,N\n";

TEST(LoadCases, AreNamedOnceInTheOrderOfTheFile) {
  const TestFolder folder;
  EXPECT_TRUE(load_case_names(folder.path()).empty());
  folder.write("loads.csv", kLoads);
  EXPECT_EQ(load_case_names(folder.path()), (std::vector<std::string>{"lorry", "wind"}));
}

TEST(LoadCases, AreReadWithDirectionKindAndLine) {
  const TestFolder folder;
  folder.write("loads.csv", "load,node,direction,value,unit\nlorry,7,z,-1.2e5,N\nsun,1,ry,3e4,N m\nlowered,pier,z,-0.01,m\n");
  const auto entries = read_load_cases(folder.path());
  ASSERT_EQ(entries.size(), 3U);
  EXPECT_EQ(entries[0].direction, 2);
  EXPECT_EQ(entries[0].value, -1.2e5);
  EXPECT_EQ(entries[0].kind, LoadEntry::Kind::force);
  EXPECT_EQ(entries[1].direction, 4);
  EXPECT_EQ(entries[1].kind, LoadEntry::Kind::moment);
  EXPECT_EQ(entries[2].kind, LoadEntry::Kind::movement);
  EXPECT_EQ(entries[2].node, "pier");
  EXPECT_EQ(entries[2].line, 4);
}

TEST(LoadCases, AreCarriedToAnotherFolderAsTheyStand) {
  const TestFolder folder;
  std::filesystem::create_directories(folder.path() / "other");
  carry_load_cases(folder.path(), folder.path() / "other");  // there are none yet
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "other/loads.csv"));
  folder.write("loads.csv", kLoads);
  carry_load_cases(folder.path(), folder.path() / "other");
  EXPECT_EQ(folder.read("other/loads.csv"), kLoads);
}

TEST(LoadCases, AreRefusedWithLineAndColumn) {
  const TestFolder folder;
  const auto said = [&](const std::string& from, const std::string& to) {
    folder.write("loads.csv", kLoads);
    folder.edit("loads.csv", from, to);
    return message_of([&] { (void)load_case_names(folder.path()); });
  };
  EXPECT_NE(said("wind,3", ",3").find("loads.csv:3: load: is empty"), std::string::npos);
  EXPECT_NE(said("wind,3", "wind,").find("loads.csv:3: node: is empty"), std::string::npos);
  EXPECT_NE(said("3,y", "3,Y").find("loads.csv:3: direction: is 'Y' (did you mean 'y'?); use x, y, z"), std::string::npos);
  EXPECT_NE(said("2e3", "much").find("loads.csv:3: value: is \"much\""), std::string::npos);
  EXPECT_NE(said("2e3,N", "2e3,kN").find("loads.csv:3: unit: is 'kN'"), std::string::npos);
  EXPECT_NE(said("-1.2e5,N", "-1.2e5,N m").find("loads.csv:2: unit: is 'N m' in direction z"), std::string::npos);
  EXPECT_NE(said("3,y", "3,ry").find("loads.csv:3: unit: is 'N' in direction ry"), std::string::npos);
  EXPECT_NE(said("wind,3,y,2e3,N\n", "wind,3,y,2e3,N\nwind,3,y,2e3,N\n")
                .find("loads.csv:4: node: is loaded by 'wind' in direction y"),
            std::string::npos);
  EXPECT_NE(said("unit", "units").find("loads.csv:1: unknown column 'units'"), std::string::npos);
}

}  // namespace
}  // namespace twindeck::model_io::test
