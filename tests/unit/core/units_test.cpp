#include "core/units.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace twindeck {
namespace {

std::string message_of(const std::string& text, const std::string& unit) {
  try {
    static_cast<void>(parse_quantity(text, unit, {"a.toml", 4, "key"}));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

struct Conversion {
  const char* text;
  const char* unit;
  double expected;
};

// Oracle: definitions of the SI (BIPM brochure): prefixes, t = 1000 kg, h = 3600 s, 0 degC = 273.15 K, 180 deg = pi rad.
TEST(ParseQuantity, ConvertsToTheFieldsUnit) {
  for (const Conversion& c : std::vector<Conversion>{{"210 GPa", "Pa", 210e9},
                                                     {"0.12 t", "kg", 120.0},
                                                     {"5 mm", "m", 0.005},
                                                     {"1.5 kN/m", "N/m", 1500.0},
                                                     {"8289 kg/m3", "kg/m3", 8289},
                                                     {"2 %", "", 0.02},
                                                     {"2 %", "%", 2.0},
                                                     {"20 degC", "K", 293.15},
                                                     {"293.15 K", "degC", 20.0},
                                                     {"20 °C", "degC", 20.0},
                                                     {"20", "degC", 20.0},
                                                     {"-1.2e-5 1/degC", "1/K", -1.2e-5},
                                                     {"3 N s/mm", "N s/m", 3000.0},
                                                     {"3 kN*s/m", "N s/m", 3000.0},
                                                     {"1 N/mm^2", "Pa", 1e6},
                                                     {"1 N/mm²", "Pa", 1e6},
                                                     {"4 cm4", "m4", 4e-8},
                                                     {"180 deg", "rad", std::numbers::pi},
                                                     {"1 kN m/rad", "N m/rad", 1000.0},
                                                     {"1 J/(kg K)", "J/kg/K", 1.0},
                                                     {"36 min", "h", 0.6},
                                                     {"5mm", "m", 0.005},
                                                     {"  +5  mm ", "m", 0.005},
                                                     {"1 m s-2", "m/s2", 1.0},
                                                     {"7", "", 7.0},
                                                     {"1 t/m3", "kg/m3", 1000.0},
                                                     {"2 1/s", "Hz", 2.0}}) {
    EXPECT_NEAR(parse_quantity(c.text, c.unit), c.expected, 1e-12 * std::abs(c.expected)) << c.text;
  }
}

// Oracle: a value given in the field's own unit is not rounded by a conversion.
TEST(ParseQuantity, KeepsEveryDigitInTheSameUnit) {
  EXPECT_EQ(parse_quantity("0.1 degC", "degC"), 0.1);
  EXPECT_EQ(parse_quantity("0.1 %", "%"), 0.1);
}

// Oracle: dimensions differ; angle is a dimension, so rad/s is not Hz.
TEST(ParseQuantity, RefusesAnotherDimension) {
  EXPECT_EQ(message_of("3 kN", "Pa"),
            "a.toml:4: key: is \"3 kN\", whose unit is of another kind than \"Pa\"; give it in Pa, kPa, MPa, GPa");
  EXPECT_NE(message_of("3 rad/s", "Hz").find("another kind"), std::string::npos);
  EXPECT_NE(message_of("3 mm", "").find("a plain number"), std::string::npos);
  EXPECT_NE(message_of("3 mm", "m2").find("give it in m2"), std::string::npos);
}

// Oracle: the message texts, as a user reads them.
TEST(ParseQuantity, NamesTheNearestUnit) {
  EXPECT_EQ(message_of("3 Gpa", "Pa"), "a.toml:4: key: unit \"Gpa\" has the unknown unit symbol 'Gpa'; did you mean 'GPa'?");
  EXPECT_NE(message_of("3 kn", "N").find("did you mean 'kN'?"), std::string::npos);
  EXPECT_NE(message_of("3 kNm", "N m").find("did you mean 'kN m'?"), std::string::npos);
  EXPECT_NE(message_of("3 furlong", "m").find("units are built of"), std::string::npos);
}

// Oracle: none of these is a finite number with a well-formed unit.
TEST(ParseQuantity, RefusesWhatIsNoQuantity) {
  for (const char* text : {"", "abc", "nan", "inf", "-inf", "1e999", "+-3", "1,5 m", "1 m^", "1 (m", "1 m)", "1 m/"}) {
    EXPECT_THROW(static_cast<void>(parse_quantity(text, "m")), InputError) << text;
  }
  EXPECT_NE(message_of("1,5 m", "m").find("decimal comma"), std::string::npos);
}

}  // namespace
}  // namespace twindeck
