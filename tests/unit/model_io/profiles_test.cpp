/// Oracles: Timoshenko and Goodier's table of torsion constants of rectangles (Theory of Elasticity, section 109), closed forms
/// of triangle and hexagon (Roark), Cowper's shear coefficients, Bredt; for every shape of every dialect area and second
/// moments by numerical integration over outlines that are written here by their corners.
#include "model_io/profiles.hpp"

#include <cmath>
#include <numbers>

#include "model_io/ansys.hpp"
#include "model_io/inp.hpp"
#include "model_io/sap2000.hpp"
#include "nastran_deck.hpp"

namespace twindeck::model_io::test::profiles {
namespace {

fe::Section section(const Shape& shape, double nu = 0.3) {
  const ProfileSection s = profile_section(shape, nu);
  EXPECT_TRUE(s.possible);
  return s.section;
}

Shape polygon(const std::vector<Eigen::Vector2d>& corners) {
  Shape shape;
  shape.outline = corners;
  return shape;
}

TEST(Profiles, TorsionOfRectangles) {
  // b/a -> k1 of J = k1 (2a)³ (2b), printed to three digits or four
  EXPECT_NEAR(rectangle_torsion(1.0, 1.0), 0.1406, 5e-5);
  EXPECT_NEAR(rectangle_torsion(2.0, 1.0), 2 * 0.229, 1e-3);
  EXPECT_NEAR(rectangle_torsion(1.0, 5.0), 5 * 0.291, 2.5e-3);
  EXPECT_NEAR(rectangle_torsion(1.0, 1000.0) / 1000.0, 1.0 / 3.0, 3e-4);
}

TEST(Profiles, TorsionOfPolygons) {
  const double root = std::sqrt(3.0);
  EXPECT_NEAR(section(polygon({{0, 0}, {1, 0}, {0.5, root / 2}})).torsion_m4, root / 80, 1e-6);
  EXPECT_NEAR(
      section(polygon({{1, 0}, {0.5, root / 2}, {-0.5, root / 2}, {-1, 0}, {-0.5, -root / 2}, {0.5, -root / 2}})).torsion_m4,
      1.0359, 1e-3);
  for (const double b : {1.0, 2.0, 5.0})
    EXPECT_NEAR(section(polygon({{3, 7}, {3, 8}, {3 + b, 8}, {3 + b, 7}})).torsion_m4 / rectangle_torsion(1.0, b), 1.0, 2e-3)
        << b;
}

TEST(Profiles, AxesOfARectangle) {
  const fe::Section s = section(rectangles({{0.0, 0.0, 0.2, 0.1}}));  // 0.2 along local y
  EXPECT_NEAR(s.inertia_z_m4, 0.1 * std::pow(0.2, 3) / 12, 1e-18);
  EXPECT_NEAR(s.inertia_y_m4, 0.2 * std::pow(0.1, 3) / 12, 1e-18);
}

TEST(Profiles, ThinSections) {
  const double r = 0.5, t = 1e-4;
  const fe::Section pipe = section(circle(r, r - t));
  EXPECT_NEAR(pipe.inertia_y_m4, std::numbers::pi * r * r * r * t, 1e-3 * pipe.inertia_y_m4);
  EXPECT_NEAR(pipe.shear_area_y_m2 / pipe.area_m2, 2 * 1.3 / (4 + 3 * 0.3), 1e-3);  // Cowper, thin tube
  const fe::Section square = section(box(1.0, 1.0, {t, t, t, t}));
  EXPECT_NEAR(square.torsion_m4, t, 1e-3 * t);  // Bredt: a³ t
  EXPECT_NEAR(square.inertia_y_m4, 2.0 / 3.0 * t, 1e-3 * t);
  // Two equal cells: the middle wall carries no flow, so that the tube is one of 2 a × a.
  EXPECT_NEAR(bredt(1.0, 4.0, 1.0, 4.0, 1.0), 4.0 * 4.0 / 6.0, 1e-12);
}

TEST(Profiles, RecognisesPipes) {
  const auto found = recognise_pipe(section(circle(0.1, 0.09)));
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->name, "PIPE");
  EXPECT_NEAR(found->values[0], 0.1, 1e-9);
  EXPECT_NEAR(found->values[1], 0.01, 1e-9);
  EXPECT_FALSE(recognise_pipe(section(circle(0.03))).has_value());
  EXPECT_FALSE(recognise_pipe(section(rectangles({{0, 0, 0.3, 0.12}}))).has_value());
  EXPECT_FALSE(recognise_pipe(section(i_shape(0.3, {0.15, 0.15}, {0.01, 0.01}, 0.007))).has_value());
}

TEST(Profiles, ImpossibleDimensions) {
  for (const Shape& shape : {circle(0.1, -0.1), circle(0.1, 0.1), box(0.2, 0.2, {0.1, 0.02, 0.1, 0.02}),
                             rectangles({{0, 0, -1, 1}}), i_shape(0.1, {0.1, 0.1}, {0.06, 0.06}, 0.01), Shape{},
                             i_shape(0.3, {0.1, 0.1}, {0.01, 0.01}, 0.2), channel(0.2, {0.1, 0.1}, {0.01, 0.01}, 0.15)})
    EXPECT_FALSE(profile_section(shape, 0.3).possible);
}

using Ring = std::vector<std::array<double, 2>>;

/// Area, ∫v², ∫h², ∫hv about the centroid: exact along h, by 4000 strips along v; rings within rings are holes.
std::array<double, 4> integrated(const std::vector<Ring>& rings) {
  double low = 1e9, high = -1e9;
  for (const Ring& ring : rings)
    for (const auto& [h, v] : ring) low = std::min(low, v), high = std::max(high, v);
  constexpr int strips = 4000;
  double a = 0, h1 = 0, v1 = 0, hh = 0, vv = 0, hv = 0;
  for (int i = 0; i < strips; ++i) {
    const double dv = (high - low) / strips, v = low + (i + 0.5) * dv;
    std::vector<double> cuts;
    for (const Ring& ring : rings)
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const auto &p = ring[k], &q = ring[(k + 1) % ring.size()];
        if ((p[1] > v) != (q[1] > v)) cuts.push_back(p[0] + (v - p[1]) / (q[1] - p[1]) * (q[0] - p[0]));
      }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t k = 0; k + 1 < cuts.size(); k += 2) {
      const double d1 = (cuts[k + 1] - cuts[k]) * dv, d2 = (std::pow(cuts[k + 1], 2) - std::pow(cuts[k], 2)) / 2 * dv;
      a += d1, h1 += d2, v1 += v * d1, vv += v * v * d1, hv += v * d2;
      hh += (std::pow(cuts[k + 1], 3) - std::pow(cuts[k], 3)) / 3 * dv;
    }
  }
  return {a, vv - v1 * v1 / a, hh - h1 * h1 / a, hv - h1 * v1 / a};
}

/// @param sign  of h along the second local axis: 1 where h is y and v is z, -1 where v is y and h is -z
void expect_integrated(const std::string& name, const fe::Section& s, const std::vector<Ring>& rings, bool up) {
  const auto [a, vv, hh, hv] = integrated(rings);
  const double near = 1e-3;  // strips that a horizontal edge cuts
  EXPECT_NEAR(s.area_m2 / a, 1.0, near) << name;
  EXPECT_NEAR((up ? s.inertia_z_m4 : s.inertia_y_m4) / vv, 1.0, 2 * near) << name;
  EXPECT_NEAR((up ? s.inertia_y_m4 : s.inertia_z_m4) / hh, 1.0, 2 * near) << name;
  EXPECT_NEAR((up ? -1.0 : 1.0) * s.inertia_yz_m4 / std::sqrt(hh * vv), hv / std::sqrt(hh * vv), 2 * near) << name;
}

Ring rectangle(double left, double low, double right, double high) {
  return {{left, low}, {right, low}, {right, high}, {left, high}};
}
const Ring channel_ring = {{0, 0}, {3, 0}, {3, .5}, {.4, .5}, {.4, 5.3}, {3, 5.3}, {3, 6}, {0, 6}};

const Ring tee = {{-.2, 0}, {.2, 0}, {.2, 3.5}, {2, 3.5}, {2, 4}, {-2, 4}, {-2, 3.5}, {-.2, 3.5}};
const Ring fallen = {{-.2, 0}, {.2, 0}, {.2, -3.5}, {2, -3.5}, {2, -4}, {-2, -4}, {-2, -3.5}, {-.2, -3.5}},
           turned_channel = {{0, 0}, {6, 0}, {6, 3}, {5.5, 3}, {5.5, .4}, {.5, .4}, {.5, 3}, {0, 3}};
const Ring hat_ring = {{-3, 0}, {-1.6, 0}, {-1.6, 3.6}, {1.6, 3.6}, {1.6, 0}, {3, 0},
                       {3, .4}, {2, .4},   {2, 4},      {-2, 4},    {-2, .4}, {-3, .4}};
const struct {
  const char *type, *dimensions;
  std::vector<Ring> rings;
  double torsion;
} nastran_shapes[] = {
    {"BAR", "2.,3.", {rectangle(0, 0, 2, 3)}, rectangle_torsion(2, 3)},
    {"BOX", "4.,6.,.5,.3", {rectangle(0, 0, 4, 6), rectangle(.3, .5, 3.7, 5.5)}, bredt(3.7 * 5.5, 2 * 3.7 / .5 + 2 * 5.5 / .3)},
    {"BOX1",
     "4.,6.,.5,.4,.3,.2",
     {rectangle(0, 0, 4, 6), rectangle(.3, .4, 3.8, 5.5)},
     bredt(3.75 * 5.55, 3.75 / .5 + 3.75 / .4 + 5.55 / .3 + 5.55 / .2)},
    {"I",
     "6.,3.,4.,.4,.5,.7",
     {{{-1.5, 0},
       {1.5, 0},
       {1.5, .5},
       {.2, .5},
       {.2, 5.3},
       {2, 5.3},
       {2, 6},
       {-2, 6},
       {-2, 5.3},
       {-.2, 5.3},
       {-.2, .5},
       {-1.5, .5}}},
     (3 * .125 + 4 * .343 + 4.8 * .064) / 3},
    {"I1",
     "2.6,.4,5.,6.",
     {{{-1.5, 0},
       {1.5, 0},
       {1.5, .5},
       {.2, .5},
       {.2, 5.5},
       {1.5, 5.5},
       {1.5, 6},
       {-1.5, 6},
       {-1.5, 5.5},
       {-.2, 5.5},
       {-.2, .5},
       {-1.5, .5}}},
     (6 * .125 + 5 * .064) / 3},
    {"H",
     "5.,1.,3.,.4",
     {{{0, 0}, {.5, 0}, {.5, 1.3}, {5.5, 1.3}, {5.5, 0}, {6, 0}, {6, 3}, {5.5, 3}, {5.5, 1.7}, {.5, 1.7}, {.5, 3}, {0, 3}}},
     (6 * .125 + 5 * .064) / 3},
    {"T", "4.,4.,.5,.4", {tee}, (4 * .125 + 3.5 * .064) / 3},
    {"T2", "4.,4.,.5,.4", {fallen}, (4 * .125 + 3.5 * .064) / 3},
    {"T1",
     "4.,3.5,.5,.4",
     {{{0, 1.8}, {3.5, 1.8}, {3.5, 0}, {4, 0}, {4, 4}, {3.5, 4}, {3.5, 2.2}, {0, 2.2}}},
     (4 * .125 + 3.5 * .064) / 3},
    {"CHAN",
     "3.,6.,.4,.5",
     {{{0, 0}, {3, 0}, {3, .5}, {.4, .5}, {.4, 5.5}, {3, 5.5}, {3, 6}, {0, 6}}},
     (6 * .125 + 5 * .064) / 3},
    {"CHAN1",
     "2.6,.4,5.,6.",
     {{{0, 0}, {3, 0}, {3, .5}, {.4, .5}, {.4, 5.5}, {3, 5.5}, {3, 6}, {0, 6}}},
     (6 * .125 + 5 * .064) / 3},
    {"CHAN2", ".5,.4,3.,6.", {turned_channel}, (6 * .125 + 5 * .064) / 3},
    {"Z",
     "2.6,.4,5.,6.",
     {{{0, 0}, {3, 0}, {3, .5}, {.4, .5}, {.4, 6}, {-2.6, 6}, {-2.6, 5.5}, {0, 5.5}}},
     (6 * .125 + 5 * .064) / 3},
    {"CROSS",
     "2.,.5,3.,.4",
     {{{-.25, -1.5},
       {.25, -1.5},
       {.25, -.2},
       {1.25, -.2},
       {1.25, .2},
       {.25, .2},
       {.25, 1.5},
       {-.25, 1.5},
       {-.25, .2},
       {-1.25, .2},
       {-1.25, -.2},
       {-.25, -.2}}},
     (3 * .125 + 2 * .064) / 3},
    {"HEXA",
     "1.,4.,3.4641016",
     {{{-2, 0}, {-1, -1.7320508}, {1, -1.7320508}, {2, 0}, {1, 1.7320508}, {-1, 1.7320508}}},
     16 * 1.0359},
    {"HAT", "4.,.4,4.,1.", {hat_ring}, (2 * 1.4 + 4 + 2 * 3.2) * .064 / 3},
    {"HAT1",
     "6.,4.,4.,.4,.5",
     {{{-3, 0}, {3, 0}, {3, .9}, {2, .9}, {2, 4}, {-2, 4}, {-2, .9}, {-3, .9}}, rectangle(-1.6, .5, 1.6, 3.6)},
     bredt(3.6 * 3.55, (3.6 + 7.1) / .4 + 3.6 / .5)},
    {"DBOX",
     "8.,3.,3.,.5,.625,.75,.375,.25\n,.5,.375",
     {rectangle(0, 0, 8, 3), rectangle(.5, .25, 2.6875, 2.625), rectangle(3.3125, .375, 7.25, 2.5)},
     0.0},
};
TEST(Profiles, NastranLibraryAgainstIntegration) {
  for (const auto& row : nastran_shapes) {
    const TestFolder folder;
    const std::string dimensions = row.dimensions;
    const fe::Section s =
        import_deck(
            folder,
            "BEGIN "
            "BULK\nGRID,1,,0.,0.,0.,,123456\nGRID,2,,9.,0.,0.\nMAT1,1,2.+11,,.3,7850.\nCBAR,1,4,1,2,0.,1.,0.\nPBARL,4,1,," +
                std::string(row.type) + "\n," + dimensions + "\nENDDATA\n")
            .model.sections.at(0);
    expect_integrated(std::string("Nastran ") + row.type, s, row.rings, true);
    if (row.torsion > 0.0) {
      EXPECT_NEAR(s.torsion_m4 / row.torsion, 1.0, 2e-3) << row.type;
    }
    EXPECT_GT(std::min(s.shear_area_y_m2, s.shear_area_z_m2), 0.2 * s.area_m2 * (std::string(row.type) == "BAR" ? 1 : 0.4))
        << row.type;
  }
}

TEST(Profiles, AnsysShapesAgainstIntegration) {
  const Ring i_ring = {{-1.5, 0}, {1.5, 0}, {1.5, .5}, {.2, .5},   {.2, 5.3}, {2, 5.3},
                       {2, 6},    {-2, 6},  {-2, 5.3}, {-.2, 5.3}, {-.2, .5}, {-1.5, .5}};
  const struct {
    const char *shape, *data;
    std::vector<Ring> rings;
  } rows[] = {{"RECT", "2,3", {rectangle(0, 0, 2, 3)}},
              {"QUAD", "0,0,4,0,3,2,1,2", {{{0, 0}, {4, 0}, {3, 2}, {1, 2}}}},
              {"I", "3,4,6,.5,.7,.4", {i_ring}},
              {"CHAN", "3,3,6,.5,.7,.4", {channel_ring}},
              {"Z", "3,3,6,.5,.7,.4", {{{0, 0}, {3, 0}, {3, .5}, {.4, .5}, {.4, 6}, {-2.6, 6}, {-2.6, 5.3}, {0, 5.3}}}},
              {"L", "3,4,.5,.4", {{{0, 0}, {3, 0}, {3, .5}, {.4, .5}, {.4, 4}, {0, 4}}}},
              {"T", "4,4,.5,.4", {{{-2, 0}, {2, 0}, {2, .5}, {.2, .5}, {.2, 4}, {-.2, 4}, {-.2, .5}, {-2, .5}}}},
              {"HATS",
               "1.4,1.4,4,4,.4,.4,.4,.4,.4",
               {{{-3, 0},
                 {-1.6, 0},
                 {-1.6, 3.6},
                 {1.6, 3.6},
                 {1.6, 0},
                 {3, 0},
                 {3, .4},
                 {2, .4},
                 {2, 4},
                 {-2, 4},
                 {-2, .4},
                 {-3, .4}}}},
              {"HREC", "4,6,.3,.2,.4,.5", {rectangle(0, 0, 4, 6), rectangle(.3, .4, 3.8, 5.5)}}};
  for (const auto& row : rows) {
    const TestFolder folder;
    folder.write("deck.dat",
                 fmt::format("/PREP7\nET,1,BEAM188\nMP,EX,1,2E11\nMP,PRXY,1,.3\nMP,DENS,1,7850\nSECTYPE,1,BEAM,{}\nSECDATA,{}\n"
                             "N,1\nN,2,9\nE,1,2\nD,1,ALL\n",
                             row.shape, row.data));
    expect_integrated(std::string("ANSYS ") + row.shape, read_ansys(folder.path() / "deck.dat").model.sections.at(0), row.rings,
                      false);
  }
}

fe::Model abaqus(const std::string& profile, const std::string& data, const std::string& type = "B31") {
  const TestFolder folder;
  folder.write(
      "deck.inp",
      "*NODE\n1, 0., 0., 0.\n2, 9., 0., 0.\n*ELEMENT, TYPE=" + type +
          ", ELSET=BEAM\n1, 1, 2\n*MATERIAL, NAME=M\n*ELASTIC\n2.E11, 0.3\n*DENSITY\n7850.\n*BEAM SECTION, ELSET=BEAM, "
          "MATERIAL=M, SECTION=" +
          profile + "\n" + data + "\n0., 1., 0.\n*BOUNDARY\n1, ENCASTRE\n");
  return read_inp(folder.path() / "deck.inp").model;
}

TEST(Profiles, AbaqusProfilesAgainstIntegration) {
  const Ring i_ring = {{-1.5, 0}, {1.5, 0}, {1.5, .5}, {.2, .5},   {.2, 5.3}, {2, 5.3},
                       {2, 6},    {-2, 6},  {-2, 5.3}, {-.2, 5.3}, {-.2, .5}, {-1.5, .5}};
  const double wall = .1 / std::sqrt(3.0);
  const auto hexagon = [](double r) {
    Ring ring;
    for (int i = 0; i < 6; ++i)
      ring.push_back({r * std::cos(i * std::numbers::pi / 3), r * std::sin(i * std::numbers::pi / 3)});
    return ring;
  };
  const struct {
    const char *profile, *data;
    std::vector<Ring> rings;
  } rows[] = {{"BOX", "4., 6., .2, .5, .3, .4", {rectangle(0, 0, 4, 6), rectangle(.3, .4, 3.8, 5.5)}},
              {"I", "1., 6., 3., 4., .5, .7, .4", {i_ring}},
              {"L", "3., 4., .5, .4", {{{0, 0}, {3, 0}, {3, .5}, {.4, .5}, {.4, 4}, {0, 4}}}},
              {"TRAPEZOID", "4., 2., 2., 0.", {{{0, 0}, {4, 0}, {3, 2}, {1, 2}}}},
              {"HEX", "3., .1", {hexagon(3), hexagon(3 - 2 * wall)}}};
  for (const auto& row : rows) {
    expect_integrated(std::string("Abaqus ") + row.profile, abaqus(row.profile, row.data).sections.at(0), row.rings, false);
  }
  // Two segments, an open section; the four of a square, a closed one.
  const fe::Model angle_of_lines = abaqus("ARBITRARY", "2, 0., 0., 3., 0., .2\n3., 4., .1", "B31OS");
  EXPECT_NEAR(angle_of_lines.sections.at(0).area_m2, 3 * .2 + 4 * .1, 1e-12);
  EXPECT_NEAR(angle_of_lines.sections.at(0).torsion_m4, (3 * .008 + 4 * .001) / 3, 1e-12);
  EXPECT_NEAR(angle_of_lines.elements.at(0).offset_m[0][1], (3 * .2 * 1.5 + 4 * .1 * 3) / 1.0, 1e-12);  // y of the centroid
  EXPECT_NEAR(angle_of_lines.elements.at(0).offset_m[1][2], 4 * .1 * 2 / 1.0, 1e-12);
  const fe::Section tube = abaqus("ARBITRARY", "4, 0., 0., 1., 0., .01\n1., 1., .01\n0., 1., .01\n0., 0., .01").sections.at(0);
  EXPECT_NEAR(tube.torsion_m4, .01, 1e-12);
  EXPECT_NEAR(tube.inertia_y_m4, 2.0 / 3.0 * .01, 1e-5);
}

TEST(Profiles, AnIMayLieBesideItsNode) {
  const fe::Model model = abaqus("I", "0., .3, .15, .15, .01, .01, .007");  // the node at the lower flange
  EXPECT_NEAR(model.elements.at(0).offset_m[0][2], .15, 1e-12);
  EXPECT_NEAR(model.elements.at(0).offset_m[0][1], 0.0, 1e-12);
  EXPECT_EQ(abaqus("I", ".15, .3, .15, .15, .01, .01, .007").elements.at(0).offset_m[0].norm(), 0.0);
}

TEST(Profiles, Sap2000ShapesWithoutNumbers) {
  const Ring i_ring = {{-1.5, 0}, {1.5, 0}, {1.5, .5}, {.2, .5},   {.2, 5.3}, {2, 5.3},
                       {2, 6},    {-2, 6},  {-2, 5.3}, {-.2, 5.3}, {-.2, .5}, {-1.5, .5}};
  const struct {
    const char* row;
    std::vector<Ring> rings;
  } rows[] = {{"Shape=Rectangular   t3=3   t2=2", {rectangle(0, 0, 2, 3)}},
              {"Shape=Box/Tube   t3=6   t2=4   tf=.5   tw=.3", {rectangle(0, 0, 4, 6), rectangle(.3, .5, 3.7, 5.5)}},
              {"Shape=\"I/Wide Flange\"   t3=6   t2=4   tf=.7   tw=.4   t2b=3   tfb=.5", {i_ring}},
              {"Shape=Channel   t3=6   t2=3   tf=.5   tw=.4",
               {{{0, 0}, {3, 0}, {3, .5}, {.4, .5}, {.4, 5.5}, {3, 5.5}, {3, 6}, {0, 6}}}},
              {"Shape=Tee   t3=4   t2=4   tf=.5   tw=.4",
               {{{-.2, 0}, {.2, 0}, {.2, 3.5}, {2, 3.5}, {2, 4}, {-2, 4}, {-2, 3.5}, {-.2, 3.5}}}},
              {"Shape=Angle   t3=4   t2=3   tf=.5   tw=.4", {{{0, 0}, {3, 0}, {3, .5}, {.4, .5}, {.4, 4}, {0, 4}}}}};
  for (const auto& row : rows) {
    const TestFolder folder;
    folder.write(
        "deck.s2k",
        "TABLE:  \"PROGRAM CONTROL\"\n   CurrUnits=\"N, m, C\"\nTABLE:  \"JOINT COORDINATES\"\n   Joint=1   XorR=0\n"
        "   Joint=2   XorR=9\nTABLE:  \"CONNECTIVITY - FRAME\"\n   Frame=1   JointI=1   JointJ=2\n"
        "TABLE:  \"FRAME SECTION ASSIGNMENTS\"\n   Frame=1   AnalSect=S\n"
        "TABLE:  \"MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES\"\n   Material=M   UnitMass=7850   E1=2E11   U12=0.3\n"
        "TABLE:  \"FRAME SECTION PROPERTIES 01 - GENERAL\"\n   SectionName=S   Material=M   " +
            std::string(row.row) + "\nEND TABLE DATA\n");
    expect_integrated(row.row, read_sap2000(folder.path() / "deck.s2k").model.sections.at(0), row.rings, true);
  }
}

/// A cantilever of an angle bends about the principal axes of its section, in every dialect: 6 m, legs 150 × 12 and 100 × 10
/// mm.
TEST(Profiles, AnAngleBendsAboutItsPrincipalAxes) {
  const auto [a, vv, hh, hv] = integrated({{{0, 0}, {.15, 0}, {.15, .012}, {.01, .012}, {.01, .1}, {0, .1}}});
  const double middle = (vv + hh) / 2, apart = std::hypot((vv - hh) / 2, hv);
  std::string nodes, elements, grids, bars;
  for (int i = 1; i <= 21; ++i) {
    nodes += fmt::format("{}, {}, 0., 0.\n", i, 0.3 * (i - 1));
    grids += fmt::format("GRID,{},,{:.2f},0.,0.\n", i, 0.3 * (i - 1));
    if (i == 21) break;
    elements += fmt::format("{0}, {0}, {1}\n", i, i + 1);
    bars += fmt::format("CBEAM,{0},1,{0},{1},0.,1.,0.\n", i, i + 1);
  }
  const TestFolder folder;
  folder.write(
      "angle.inp",
      "*NODE\n" + nodes + "*ELEMENT, TYPE=B31OS, ELSET=B\n" + elements +
          "*BEAM SECTION, ELSET=B, MATERIAL=S, SECTION=L\n.15, .1, .012, .01\n0., 1., 0.\n*MATERIAL, NAME=S\n*ELASTIC\n"
          "2.1E11, .3\n*DENSITY\n7850.\n*BOUNDARY\n1, ENCASTRE\n");
  folder.write("angle.dat",
               "/PREP7\nET,1,BEAM188\nKEYOPT,1,3,3\nSECTYPE,1,BEAM,L\nSECDATA,.15,.1,.012,.01\nMP,EX,1,2.1E11\nMP,PRXY,1,.3\n"
               "MP,DENS,1,7850\nN,1\nN,21,6\nFILL\nE,1,2\nEGEN,20,1,1\nD,1,ALL\n");
  const fe::Model by_dialect[] = {
      read_inp(folder.path() / "angle.inp").model, read_ansys(folder.path() / "angle.dat").model,
      import_deck(folder, "SPC = 1\nBEGIN BULK\n" + grids + bars +
                              "PBEAML,1,1,,L\n,.15,.1,.012,.01\nMAT1,1,2.1+11,,.3,7850.\nSPC1,1,123456,1\nENDDATA\n")
          .model};
  for (const fe::Model& model : by_dialect) {
    const std::vector<double> found = frequencies(model, 2);
    for (const auto& [mode, inertia] : {std::pair<std::size_t, double>(0, middle - apart), {1, middle + apart}})
      EXPECT_NEAR(
          found[mode] / (1.87510407 * 1.87510407 / (72.0 * std::numbers::pi) * std::sqrt(2.1e11 * inertia / (7850.0 * a))), 1.0,
          3e-3)
          << model.source;
  }
}

}  // namespace
}  // namespace twindeck::model_io::test::profiles
