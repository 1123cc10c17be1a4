// Oracle: each model has one wrong parameter made on purpose; the message must name it and what was found.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "assembly_models.hpp"
#include "core/error.hpp"
#include "fe/validate_parts.hpp"

namespace twindeck::fe {
namespace {

/// Parameters of one_of_everything: 0 E_s, 1 E_c, 2 E_stay, 3 rho_c, 4 t, 5 RMI, 6 A, 7 k, 8 m.
std::string parameter_fault(const std::function<void(Model&, std::vector<Parameter>&)>& spoil) {
  Model model = test::one_of_everything();
  spoil(model, model.parameters);
  try {
    validate_parameters(model);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void expect_refusal(const char* part, const std::function<void(Model&, std::vector<Parameter>&)>& spoil) {
  const std::string text = parameter_fault(spoil);
  EXPECT_NE(text.find(part), std::string::npos) << part << " / " << text;
}

TEST(ValidateParameters, SoundOnesPass) {
  EXPECT_EQ(parameter_fault([](Model&, auto&) {}), "");
  EXPECT_EQ(parameter_fault([](Model&, auto& p) { p[0].lower = p[0].upper = p[0].initial; }), "");  // fixed
  EXPECT_EQ(parameter_fault([](Model&, auto& p) { p[0].initial *= 1.0 + 1e-7; }), "");              // rounded in a table
  EXPECT_EQ(parameter_fault([](Model&, auto& p) { p[3].unit = "kg/m^3", p[6].unit = "", p[5].unit = "1"; }), "");
}

TEST(ValidateParameters, Names) {
  expect_refusal("parameter 'E_s': is defined twice", [](Model&, auto& p) { p[1].name = "E_s"; });
  expect_refusal("names nothing that it scales", [](Model&, auto& p) { p[4].of.clear(); });
  expect_refusal("there is no group of point masses 'rail'", [](Model&, auto& p) { p[8].of = {"rail"}; });
  expect_refusal("there is no material 'slab'", [](Model&, auto& p) { p[3].of = {"slab"}; });
  expect_refusal("'steel' is scaled by another parameter", [](Model&, auto& p) { p[1].of = {"concrete", "steel"}; });
  expect_refusal("scales a matrix", [](Model&, auto& p) { p[0].target = Target::matrix_stiffness; });
  EXPECT_EQ(parameter_fault([](Model& m, auto& p) {  // its modulus and its density are two properties
              p[3].of = {"steel"};
              p[3].initial = m.materials[0].density_kg_m3, p[3].upper = 1e4;
            }),
            "");
}

TEST(ValidateParameters, Units) {
  expect_refusal("its unit is 'GPa', expected Pa or N/m2", [](Model&, auto& p) { p[0].unit = "GPa"; });
  expect_refusal("its unit is 'mm'", [](Model&, auto& p) { p[4].unit = "mm"; });
  expect_refusal("its unit is 'm'", [](Model&, auto& p) { p[6].unit = "m"; });
  expect_refusal("its unit is 'N/m', expected - or 1", [](Model&, auto& p) { p[7].unit = "N/m"; });
}

TEST(ValidateParameters, Values) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refusal("the initial one not 0", [](Model&, auto& p) { p[7].initial = p[7].lower = 0.0; });
  expect_refusal("expected numbers", [nan](Model&, auto& p) { p[0].initial = nan; });
  expect_refusal("expected numbers", [nan](Model&, auto& p) { p[0].lower = nan; });
  expect_refusal("expected numbers", [](Model&, auto& p) { p[0].upper = std::numeric_limits<double>::infinity(); });
  expect_refusal("lies outside its bounds", [](Model&, auto& p) { p[0].lower = 1.01 * p[0].initial; });
  expect_refusal("lies outside its bounds", [](Model&, auto& p) { p[0].upper = 0.99 * p[0].initial; });
  expect_refusal("the lower bound is 0 Pa", [](Model&, auto& p) { p[0].lower = 0.0; });
  expect_refusal("'steel' stands at 2e+11", [](Model&, auto& p) { p[0].initial = 201e9; });
  expect_refusal("'girder' stands at 0.01", [](Model&, auto& p) { p[6].initial = 0.011; });
}

TEST(ValidateParameters, AreaOfATaperNamesBothEnds) {
  const auto taper = [](bool both) {
    return [both](Model& m, auto& p) {
      Section tip = m.sections[0];
      tip.name = "tip";
      m.sections.push_back(tip);
      m.elements[2].section2 = 3;
      if (both) p[6].of.push_back("tip");
    };
  };
  expect_refusal("at one end of the tapered beam 3 alone", taper(false));
  EXPECT_EQ(parameter_fault(taper(true)), "");
}

}  // namespace
}  // namespace twindeck::fe
