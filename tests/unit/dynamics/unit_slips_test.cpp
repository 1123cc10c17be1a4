/// Oracle: numbers of real materials and structures, each with one slip put in; the same numbers without it are left in peace.
#include "dynamics/unit_slips.hpp"

#include <gtest/gtest.h>

namespace twindeck::dynamics {
namespace {

/// A steel beam of ten metres in ten elements, 0.2 m x 0.4 m.
fe::Model beam() {
  fe::Model model;
  for (int i = 0; i <= 10; ++i) model.nodes.push_back({i + 1, Eigen::Vector3d(i, 0.0, 0.0)});
  model.materials = {{"steel", 210e9, 81e9, 0.3, 7850.0}};
  fe::Section section;
  section.name = "box";
  section.area_m2 = 0.08;
  section.inertia_y_m4 = 1.0667e-3;
  section.inertia_z_m4 = 2.6667e-4;
  section.torsion_m4 = 7e-4;
  model.sections = {section};
  for (int i = 0; i < 10; ++i) {
    fe::Element element;
    element.id = i + 1;
    element.material = element.section = 0;
    element.nodes = {i, i + 1};
    model.elements.push_back(element);
  }
  return model;
}

std::string only(const std::vector<std::string>& slips) {
  EXPECT_EQ(slips.size(), 1U);
  return slips.empty() ? "" : slips.front();
}

void expect_slip(const fe::Model& model, const std::string& said) {
  const std::string slip = only(unit_slips(model));
  EXPECT_NE(slip.find(said), std::string::npos) << slip;
}

TEST(UnitSlips, SoundMaterialsPass) {
  const std::vector<std::pair<double, double>> materials = {
      {210e9, 7850.0}, {30e9, 2500.0}, {70e9, 2700.0}, {11e9, 450.0},   {36e9, 16000.0},  {3e6, 1100.0},   {50e6, 1800.0},
      {16e9, 11340.0}, {1e15, 7850.0}, {210e9, 0.0},   {140e9, 1600.0}, {400e9, 19300.0}, {79e9, 19300.0}, {190e9, 19050.0}};
  for (const auto& [modulus, density] : materials) {
    fe::Model model = beam();
    model.materials[0].youngs_modulus_Pa = modulus;
    model.materials[0].density_kg_m3 = density;
    EXPECT_TRUE(unit_slips(model).empty()) << modulus << " " << density << ": " << unit_slips(model)[0];
  }
}

TEST(UnitSlips, ModulusInAnotherUnit) {
  fe::Model model = beam();
  for (const auto& [modulus, unit] : {std::pair(210e3, "MPa"), std::pair(210.0, "GPa"), std::pair(210e6, "kPa")}) {
    model.materials[0].youngs_modulus_Pa = modulus;
    expect_slip(model, std::string("is E in ") + unit);
  }
  model.materials[0] = {"concrete", 33e3, 14e3, 0.2, 2500.0};
  expect_slip(model, "is E in MPa");
  model.materials[0] = {"spruce", 11e6, 0.7e6, 0.3, 450.0};
  expect_slip(
      model,
      "material 'spruce' has E = 1.1e+07 Pa, so that waves run at 156 m/s in it; steel has 5200, concrete 3500: is E in kPa");
}

/// Moduli in pascals of a model in kN and m, or in N and mm, as they come out in SI units.
TEST(UnitSlips, ModulusAThousandTimesTooLarge) {
  fe::Model model = beam();
  for (const auto& [modulus, density] : {std::pair(210e12, 7850.0), std::pair(33e12, 2500.0), std::pair(11e12, 450.0)}) {
    model.materials[0] = {"girder", modulus, modulus / 2.6, 0.3, density};
    expect_slip(model, "is E in Pa in a model in kN and m?");
  }
  model.materials[0].youngs_modulus_Pa = 210e15;
  model.materials[0].density_kg_m3 = 7850.0;
  expect_slip(model, "is E in Pa in a model in N and mm?");
}

/// All mass of 4.5 times the steel's own is in points: waves of the steel's stiffness run at 5172 m/s / sqrt(4.5) = 2440 m/s.
TEST(UnitSlips, ModulusOfAStructureWhoseMassIsInPoints) {
  fe::Model model = beam();
  model.materials[0].density_kg_m3 = 0.0;
  for (int i = 0; i <= 10; ++i) model.masses.push_back({"deck", i, 4.5 * 628.0 * 10.0 / 11.0, Eigen::Vector3d::Zero()});
  EXPECT_TRUE(unit_slips(model).empty());
  for (const auto& [factor, said] :
       {std::pair(1e-3, "is E in kPa"), std::pair(1e-6, "is E in MPa"), std::pair(1e3, "is E in Pa in a model in kN")}) {
    model.materials[0].youngs_modulus_Pa = factor * 210e9;
    expect_slip(model, said);
  }
  model.materials[0].youngs_modulus_Pa = 210e9;
  for (fe::PointMass& mass : model.masses) mass.mass_kg /= 1000.0;
  expect_slip(model, "or are the masses in tonnes?");
}

TEST(UnitSlips, DensityInAnotherUnit) {
  fe::Model model = beam();
  for (const auto& [density, unit] : {std::pair(7.85, "t/m3"), std::pair(77.0, "kN/m3")}) {
    model.materials[0].density_kg_m3 = density;
    expect_slip(model, std::string("is the density in ") + unit);
  }
  model.materials[0].youngs_modulus_Pa = 210e3;  // N, mm and t
  model.materials[0].density_kg_m3 = 7.85e-9;
  expect_slip(model, "is the density in t/mm3");
}

TEST(UnitSlips, DensityThatIsAWeight) {
  fe::Model model = beam();
  for (const auto& [modulus, density, said] :
       {std::tuple(210e9, 77000.0, "N/m3"), std::tuple(33e9, 25000.0, "N/m3"), std::tuple(70e9, 26500.0, "N/m3"),
        std::tuple(11e9, 5000.0, "N/m3"), std::tuple(15e9, 8000.0, "N/m3"), std::tuple(30e9, 22500.0, "N/m3"),
        std::tuple(30e9, 17000.0, "N/m3"), std::tuple(4e9, 18000.0, "N/m3"), std::tuple(1.2e9, 20000.0, "N/m3"),
        std::tuple(200e9, 3.02e6, "WTMASS"), std::tuple(210e9, 7.7e7, "N/mm3"), std::tuple(210e9, 7.85e6, "tonnes"),
        std::tuple(2.0e11, 490.0 * 515.379, "lbf/ft3 or kip/ft3 (divide by 32.174)"),
        std::tuple(2.76e10, 150.0 * 515.379, "lbf/ft3")}) {
    model.materials[0].youngs_modulus_Pa = modulus;
    model.materials[0].density_kg_m3 = density;
    expect_slip(model, said);
  }
}

TEST(UnitSlips, WeightsInADeckOfOtherUnits) {
  fe::Model model = beam();
  struct Case {
    double modulus, density;
    const char* said;
  };
  for (const Case& c : {Case{30e6, 0.283, "lbf/in3, among numbers in lbf and in? Divide it by 386.09"},
                        {3.8e6, 0.0868, "lbf/in3"},
                        {4.176e6, 0.49, "kip/ft3, among numbers in kip and ft? Divide it by 32.174"},
                        {5.76e5, 0.15, "kip/ft3"},
                        {2.1e6, 7.85e-3, "kgf/cm3"},
                        {3.06e6, 2.5, "tonf/m3"},
                        {2.1e8, 77.0, "kN/m3"},
                        {3e7, 25.0, "kN/m3"},
                        {5e6, 20.0, "kN/m3, among numbers in kN and m? Divide it by 9.80665"},  // masonry
                        {1.5e6, 18.0, "kN/m3, among numbers in kN and m"},
                        {2.1e5, 7.7e-5, "N/mm3"},
                        {29e6, 7.3e-4, "lbf and in, with densities in lbf s2/in4? Frequencies hold"},
                        {29e3, 7.3e-7, "kip and in, with densities in kip s2/in4?"},
                        {4.18e9, 15.2, "lbf and ft, with densities in slug/ft3?"},
                        {5.2e5, 4.66e-3, "kip and ft, with densities in kip s2/ft4?"}}) {
    model.materials[0] = {"m", c.modulus, c.modulus / 2.6, 0.3, c.density};
    expect_slip(model, c.said);
  }
  for (const double factor :
       {1e-3, 1e3})  // of both, so that waves are as fast as in the material: frequencies hold, masses do not
    for (const auto& [modulus, density] : {std::pair(2.1e11, 7850.0), std::pair(3e10, 2500.0)}) {
      model.materials[0] = {"m", factor * modulus, factor * modulus / 2.6, 0.3, factor * density};
      expect_slip(model, factor < 1.0 ? "are the numbers in kN and m, with densities in t/m3? Frequencies hold"
                                      : "are the numbers in N and m, with densities in kg/m3? Frequencies hold");
    }
  // Foams, beside the skins that they hold apart: no structure is of foam alone.
  model.materials.push_back({"skin", 7e10, 7e10 / 2.6, 0.3, 2700.0});
  model.elements[1].material = 1;
  for (const auto& [modulus, density] : {std::pair(9e7, 80.0), std::pair(2e7, 35.0), std::pair(4.2e6, 18.5)}) {
    model.materials[0] = {"m", modulus, modulus / 2.6, 0.3, density};
    EXPECT_TRUE(unit_slips(model).empty()) << modulus << " " << density;
  }
}

TEST(UnitSlips, MassesThatAreWeights) {
  fe::Model model = beam();  // 628 kg/m of steel
  for (int i = 0; i <= 10; ++i) model.masses.push_back({"deck", i, 2000.0, Eigen::Vector3d::Zero()});
  EXPECT_TRUE(unit_slips(model).empty());  // 2.2 t/m of deck on 0.6 t/m of girder
  for (fe::PointMass& mass : model.masses) mass.mass_kg *= 9.81 * 3.0;
  expect_slip(model, "are the masses weights in newtons?");
}

TEST(UnitSlips, CoordinatesInMillimetres) {
  fe::Model model = beam();
  for (fe::Node& node : model.nodes) node.x_m *= 1000.0;
  expect_slip(model,
              "spans 1e+04 m, and half of its elements are 2.5e+03 and more times as long as deep: are the coordinates in mm?");
  for (fe::Node& node : model.nodes) node.x_m *= 0.2;  // two kilometres in ten elements: a long bridge, drawn coarsely
  EXPECT_TRUE(unit_slips(model).empty());
}

TEST(UnitSlips, SectionsLargerThanTheStructure) {
  fe::Model model = beam();
  model.sections[0].area_m2 = 8e4;  // mm2
  expect_slip(model, "section 'box' is 283 m across");
}

TEST(UnitSlips, FirstFrequencyOfNoStructure) {
  const std::string slow = only(frequency_slips(Eigen::Vector3d(0.0042, 0.005, 0.02), 6280.0, 10.0));
  EXPECT_NE(slow.find("the first mode is computed at 0.0042 Hz (6280 kg move, span 10 m), slower than any structure"),
            std::string::npos)
      << slow;
  EXPECT_TRUE(frequency_slips(Eigen::Vector3d(1e-7, 1.2, 3.0), 6280.0, 10.0).empty());  // a rigid body's comes before it
  EXPECT_TRUE(frequency_slips(Eigen::Vector3d(0.03, 0.05, 0.1), 1e8, 3000.0).empty());
  EXPECT_TRUE(frequency_slips(Eigen::VectorXd(), 0.0, 0.0).empty());
}

}  // namespace
}  // namespace twindeck::dynamics
