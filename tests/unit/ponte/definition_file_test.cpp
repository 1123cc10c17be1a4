// Oracle: texts that a user must see. Each case spoils one place of a real definition, prototype.toml.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "core/error.hpp"
#include "ponte/generator.hpp"
#include "prototype_bridge.hpp"

namespace twindeck::ponte {
namespace {

const std::filesystem::path kPrototypeFile = twindeck::tests::prototype_toml();

// Message of generating `variant` from bridge.toml with `from` (its first occurrence) replaced by `to`; the error must name the
// line of that place, or one so many lines below.
std::string message(const std::string& from, const std::string& to, const std::string& variant = "refined",
                    long lines_below = 0) {
  std::ifstream in(kPrototypeFile);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) /
      ("bridge_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".toml");
  std::ofstream(file) << text;
  try {
    (void)generate(file, variant);
  } catch (const InputError& error) {
    const long line = std::count(text.begin(), text.begin() + static_cast<long>(at), '\n') + 1 + lines_below;
    EXPECT_EQ(error.place().line, line) << error.what();
    return error.what();
  }
  return "accepted";
}

void expect_contains(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    EXPECT_NE(text.find(part), std::string::npos) << "no '" << part << "' in: " << text;
  }
}

TEST(DefinitionFile, UnknownKeyNamesTheNearest) {
  expect_contains(message("[mesh]\n", "[mesh]\nshell_across = 5\n", "refined", 1), {"mesh.shell_across", "mesh.shells_across"});
}

TEST(DefinitionFile, MisspeltKeyIsTakenForTheMissingOne) {
  expect_contains(message("shells_across = 4", "shell_across = 4"), {"mesh.shell_across", "'mesh.shells_across' is missing"});
}

TEST(DefinitionFile, UnknownOverrideNamesTheNearest) {
  expect_contains(message("\"mast.infill_z\" =", "\"mast.infil_z\" ="), {"mast.infil_z", "did you mean 'mast.infill_z'"});
}

TEST(DefinitionFile, OverridesOfOtherVariantsAreCheckedToo) {
  expect_contains(message("\"ground_cable.y\" =", "\"ground_cable.yy\" =", "preliminary"),
                  {"ground_cable.yy", "ground_cable.y"});
}

TEST(DefinitionFile, ValueOutOfRangeSaysWhatIsAllowed) {
  expect_contains(message("youngs_modulus = \"210 GPa\"", "youngs_modulus = \"-210 GPa\""),
                  {"material.steel.youngs_modulus", "-210 GPa", "expected"});
}

TEST(DefinitionFile, WrongUnitIsRefused) {
  expect_contains(message("truss_depth = \"1.8113321 m\"", "truss_depth = \"1.8113321 kg\""), {"deck.foot.truss_depth", "kg"});
}

TEST(DefinitionFile, OverrideOutOfRangeNamesTheLineOfTheOverride) {
  expect_contains(message("\"mast.infill_z\" = \"30 m\"", "\"mast.infill_z\" = \"70 m\""), {"mast.infill_z", "70 m"});
}

TEST(DefinitionFile, UnknownStayOfASitePullNamesTheNearest) {
  expect_contains(message("NE5 = \"368 kN\"", "NE55 = \"368 kN\""), {"site_pull.NE55", "no stay"});
}

TEST(DefinitionFile, FractionForAWholeNumberIsRefused) {
  expect_contains(message("shells_across = 4", "shells_across = 4.5"), {"mesh.shells_across", "whole number"});
}

TEST(DefinitionFile, UnknownMaterialNamesTheNearest) {
  expect_contains(message("material = \"concrete_light\"", "material = \"concrete_ligth\""),
                  {"deck.cycle.slab.all.material", "did you mean 'concrete_light'"});
}

TEST(DefinitionFile, BrokenTomlNamesTheLine) { expect_contains(message("[mast]\n", "[mast\n"), {"TOML"}); }

TEST(DefinitionFile, UnknownVariantAndChangeAreNamed) {
  try {
    (void)generate(kPrototypeFile, "refinde");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    expect_contains(error.what(), {"refinde", "did you mean 'refined'", "prototype.toml"});
  }
  try {
    (void)generate_with_changes(kPrototypeFile, {"light_concret"});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    expect_contains(error.what(), {"light_concret", "did you mean 'light_concrete'"});
  }
}

TEST(DefinitionFile, MissingFileIsSaid) {
  try {
    (void)generate("no_such_bridge.toml", "refined");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    expect_contains(error.what(), {"no_such_bridge.toml"});
  }
}

}  // namespace
}  // namespace twindeck::ponte
