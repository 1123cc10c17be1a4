/// Oracle: the numbers of the two prints, as the programs lay them out.
#include "model_io/printed_mass.hpp"

#include "test_folder.hpp"

namespace twindeck::model_io::test {
namespace {

TEST(PrintedMass, IsFoundBesideTheDeck) {
  const TestFolder folder;
  EXPECT_EQ(printed_mass(folder.path() / "wing.bdf"), "");
  folder.write("wing.f06",
               "     M O D E S\n                               DIRECTION\n"
               "                          MASS AXIS SYSTEM (S)     MASS              X-C.G.        Y-C.G.        Z-C.G.\n"
               "                                  X            1.774604E+00     -6.022436E-18 -2.530596E+00 -1.846765E+01\n"
               "                                  Y            1.774604E+00     -3.385143E-02 -1.016094E-17 -1.846765E+01\n"
               "                                  Z            1.774604E+00     -3.385143E-02 -2.530596E+00 -6.562987E-20\n");
  EXPECT_EQ(printed_mass(folder.path() / "wing.bdf"),
            "wing.f06 has mass 1.7746, centre of mass (-0.0338514, -2.5306, -18.4676)");
  folder.write(
      "beam.dat",
      "                    TOTAL MASS OF MODEL\n\n       24000.    \n\n         LOCATION OF THE CENTER OF MASS OF THE MODEL\n\n"
      "       5.0000          0.2500          0.0000\n");
  EXPECT_EQ(printed_mass(folder.path() / "beam.inp"), "beam.dat has mass 24000, centre of mass (5, 0.25, 0)");
  folder.write("other.f06", "nothing of the kind\n");
  EXPECT_EQ(printed_mass(folder.path() / "other.bdf"), "");
}

}  // namespace
}  // namespace twindeck::model_io::test
