// Oracle: each model has one wrong property made on purpose; the message must name the part and what was found.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "assembly_models.hpp"
#include "core/error.hpp"
#include "fe/validate_parts.hpp"

namespace twindeck::fe {
namespace {

std::string property_fault(const std::function<void(Model&)>& spoil) {
  Model model = test::one_of_everything();
  spoil(model);
  try {
    validate_properties(model);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void expect_fault(const char* part, const std::function<void(Model&)>& spoil) {
  const std::string text = property_fault(spoil);
  EXPECT_NE(text.find(part), std::string::npos) << part << " / " << text;
}

TEST(ValidateProperties, SoundPropertiesPass) {
  EXPECT_EQ(property_fault([](Model&) {}), "");
  EXPECT_EQ(property_fault([](Model& m) { m.materials[0].density_kg_m3 = 0.0; }), "");
  EXPECT_EQ(property_fault([](Model& m) { m.sections[0].inertia_yz_m4 = 1.99e-5; }), "");  // Iy Iz = 4e-10 = (2e-5)²
  EXPECT_EQ(property_fault([](Model& m) { m.materials[2].poisson_ratio = 0.9; }), "");     // no shell has it
}

TEST(ValidateProperties, Materials) {
  expect_fault("material 'steel'", [](Model& m) { m.materials[0].youngs_modulus_Pa = 0.0; });
  expect_fault("Young's modulus is inf Pa",
               [](Model& m) { m.materials[0].youngs_modulus_Pa = std::numeric_limits<double>::infinity(); });
  expect_fault("shear modulus is -1 Pa", [](Model& m) { m.materials[0].shear_modulus_Pa = -1.0; });
  expect_fault("density is -1 kg/m3", [](Model& m) { m.materials[1].density_kg_m3 = -1.0; });
  expect_fault("density is nan", [](Model& m) { m.materials[1].density_kg_m3 = std::numeric_limits<double>::quiet_NaN(); });
  for (const double nu : {-0.1, 0.5}) expect_fault("Poisson's ratio", [nu](Model& m) { m.materials[1].poisson_ratio = nu; });
}

TEST(ValidateProperties, Sections) {
  expect_fault("section 'girder'", [](Model& m) { m.sections[0].area_m2 = 0.0; });
  expect_fault("inertia_y is -1", [](Model& m) { m.sections[0].inertia_y_m4 = -1.0; });
  expect_fault("inertia_z is nan", [](Model& m) { m.sections[0].inertia_z_m4 = std::numeric_limits<double>::quiet_NaN(); });
  expect_fault("torsion constant is 0", [](Model& m) { m.sections[0].torsion_m4 = 0.0; });
  expect_fault("no section has that", [](Model& m) { m.sections[0].inertia_yz_m4 = -2.01e-5; });
  expect_fault("shear areas are -1", [](Model& m) { m.sections[0].shear_area_y_m2 = -1.0; });
  expect_fault("and -2 m2", [](Model& m) { m.sections[0].shear_area_z_m2 = -2.0; });
  expect_fault("thickness is 0 m", [](Model& m) { m.sections[1].thickness_m = 0.0; });
  expect_fault("bending inertia ratio is 0", [](Model& m) { m.sections[1].bending_inertia_ratio = 0.0; });
  expect_fault("section 'girder': bending inertia ratio is 2", [](Model& m) { m.sections[0].bending_inertia_ratio = 2.0; });
  expect_fault("shear thickness ratio is -1", [](Model& m) { m.sections[1].shear_thickness_ratio = -1.0; });
  expect_fault("'girder': has a shear thickness ratio", [](Model& m) { m.sections[0].shear_thickness_ratio = 0.5; });
  expect_fault("section 'strand': area is 0", [](Model& m) { m.sections[2].area_m2 = 0.0; });
}

TEST(ValidateProperties, SecondSectionOfATaper) {
  expect_fault("section 'tip'", [](Model& m) {
    Section tip = m.sections[0];
    tip.name = "tip";
    tip.torsion_m4 = -1.0;
    m.sections.push_back(tip);
    m.elements[2].section2 = 3;
  });
}

TEST(ValidateProperties, Solids) {
  const auto solid_of = [](double nu) {
    return [nu](Model& m) {
      m.materials.push_back({"rock", 1e9, 0.0, nu, 2000.0});
      test::add_element(m, ElementType::solid, "rock", 3, -1, {0, 1, 2, 3});
    };
  };
  EXPECT_EQ(property_fault(solid_of(-0.5)), "");
  for (const double nu : {-1.0, 0.5}) expect_fault("material 'rock'", solid_of(nu));
}

// Oracle: no number is no property. A shear area of nan would make the beam rigid in shear without a word.
TEST(ValidateProperties, NumbersThatAreNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_fault("shear areas are", [nan](Model& m) { m.sections[0].shear_area_y_m2 = nan; });
  expect_fault("shear areas are", [nan](Model& m) { m.sections[0].shear_area_z_m2 = nan; });
  expect_fault("inertia_yz is nan", [nan](Model& m) { m.sections[0].inertia_yz_m4 = nan; });
  expect_fault("density is inf", [](Model& m) { m.materials[1].density_kg_m3 = std::numeric_limits<double>::infinity(); });
}

}  // namespace
}  // namespace twindeck::fe
