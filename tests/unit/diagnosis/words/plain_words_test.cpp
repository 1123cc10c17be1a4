// Numbers, lists and ids in sentences. Oracle: how a person writes them, case by case.
#include "diagnosis/words/plain_words.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace twindeck::tests {
namespace {

TEST(PlainWords, NumbersHaveThreeDigitsAndNoExponentWherePeopleUseNone) {
  EXPECT_EQ(diagnosis::number_in_words(0.0), "0");
  EXPECT_EQ(diagnosis::number_in_words(0.61249), "0.612");
  EXPECT_EQ(diagnosis::number_in_words(1.0), "1");
  EXPECT_EQ(diagnosis::number_in_words(0.99961), "1");
  EXPECT_EQ(diagnosis::number_in_words(12.5), "12.5");
  EXPECT_EQ(diagnosis::number_in_words(433.7), "434");
  EXPECT_EQ(diagnosis::number_in_words(999.6), "1,000");
  EXPECT_EQ(diagnosis::number_in_words(18549.0), "18,500");
  EXPECT_EQ(diagnosis::number_in_words(800000.0), "800,000");
  EXPECT_EQ(diagnosis::number_in_words(5.4e6), "5.4 million");
  EXPECT_EQ(diagnosis::number_in_words(2.1e11), "2.1e+11");
  EXPECT_EQ(diagnosis::number_in_words(-0.0051), "-0.0051");
  EXPECT_EQ(diagnosis::number_in_words(1e-5), "1e-05");
  EXPECT_EQ(diagnosis::number_in_words(12.3449, 4), "12.34");
  EXPECT_EQ(diagnosis::number_in_words(std::nan("")), "unknown");
}

TEST(PlainWords, QuantitiesTakeThePrefixesThatEngineersUse) {
  EXPECT_EQ(diagnosis::quantity_in_words(2.1e11, "Pa"), "210 GPa");
  EXPECT_EQ(diagnosis::quantity_in_words(5.4e6, "N/m"), "5.4 MN/m");
  EXPECT_EQ(diagnosis::quantity_in_words(956350.0, "N/m"), "956 kN/m");
  EXPECT_EQ(diagnosis::quantity_in_words(434.0, "N"), "434 N");
  EXPECT_EQ(diagnosis::quantity_in_words(18549.0, "kg"), "18,500 kg");
  EXPECT_EQ(diagnosis::quantity_in_words(0.612, "-"), "0.612");
}

TEST(PlainWords, ListsAndSentences) {
  EXPECT_EQ(diagnosis::listed({}), "");
  EXPECT_EQ(diagnosis::listed({"A"}), "A");
  EXPECT_EQ(diagnosis::listed({"A", "B", "C"}), "A, B and C");
  EXPECT_EQ(diagnosis::capitalised("the pier."), "The pier.");
  EXPECT_EQ(diagnosis::ended("the pier"), "the pier.");
  EXPECT_EQ(diagnosis::ended("the pier."), "the pier.");
  EXPECT_EQ(diagnosis::ended(""), "");
}

TEST(PlainWords, IdsBecomeWordsAndLongerNamesAreLeftAlone) {
  diagnosis::IdsInWords ids;
  ids.add_location("support:pier", "the support pier");
  ids.add_location("support:pier_W", "the support pier_W");
  ids.add_location("global", "the whole structure");
  ids.add_cause("brg@support:pier_W", "Support softer or stiffer than modelled", "the support pier_W");
  EXPECT_EQ(
      ids.in_text("it acts like brg@support:pier_W; see support:pier, support:pier_W."),
      "it acts like support softer or stiffer than modelled at the support pier_W; see the support pier, the support pier_W.");
  EXPECT_EQ(ids.in_text("support:pier_East"), "support:pier_East");
  EXPECT_EQ(ids.in_text("mysupport:pier"), "mysupport:pier");
  ids.add_cause("tempE@global", "Stiffness that changes with temperature", "");
  EXPECT_EQ(ids.in_text("like tempE@global"), "like stiffness that changes with temperature");
  EXPECT_EQ(ids.in_text("a global change"), "a global change");  // a word of everyday, no id
}

}  // namespace
}  // namespace twindeck::tests
