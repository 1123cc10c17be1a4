// Oracle: properties of the vocabulary; every key of a condition can be read, every name is known once.
#include "diagnosis/causes/catalogue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "diagnosis/causes/candidate.hpp"

namespace twindeck::tests {
namespace {

TEST(Catalogue, NamesAreThereOnce) {
  for (const auto* names : {&diagnosis::condition_keys(), &diagnosis::condition_demands(), &diagnosis::place_numbers(),
                            &diagnosis::location_sets()})
    EXPECT_EQ(std::set<std::string>(names->begin(), names->end()).size(), names->size());
}

TEST(Catalogue, EveryKeyOfAConditionIsReadFromIt) {
  diagnosis::Condition all;
  all.dampers_on = true;
  all.amplitude_m = all.temperature_C = all.wind_m_s = all.direction_deg = all.people = 1.0;
  for (const std::string& key : diagnosis::condition_keys()) EXPECT_TRUE(number_of(all, key).has_value()) << key;
}

TEST(Catalogue, NumbersOfAPlaceAreThoseOfTheListAndThoseOfTheModel) {
  for (const char* name : {"k_drive", "f_own", "x_low", "node_3", "least_change", "most_change"})
    EXPECT_TRUE(diagnosis::is_place_number(name)) << name;
  for (const char* name : {"", "k_driv", "nodes", "f_measured", "change"})
    EXPECT_FALSE(diagnosis::is_place_number(name)) << name;
}

}  // namespace
}  // namespace twindeck::tests
