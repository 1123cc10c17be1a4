/// *COUPLING and JOINTC. Oracles: closed forms of masses on springs, and the same structure with *RIGID BODY or single springs.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <set>

#include "model_io/inp.hpp"
#include "nastran_deck.hpp"

namespace twindeck::model_io::test::inp_couplings {
namespace {

using std::numbers::pi;

ImportedModel deck_model(const std::string& deck) {
  const TestFolder folder;
  folder.write("deck.inp", deck);
  return read_inp(folder.path() / "deck.inp");
}

std::string refusal_of(const std::string& deck) {
  return message_of([&] { (void)deck_model(deck); });
}

/// A mass of 2 kg at node 2, 3 m beside the reference node 1, which turns about z on a spring of 450 N m/rad.
std::string pendulum(const std::string& coupling) {
  return "*NODE\n1, 0, 0, 0\n2, 3, 0, 0\n*ELEMENT, TYPE=SPRING1, ELSET=HINGE\n1, 1\n*SPRING, ELSET=HINGE\n6\n450.\n"
         "*ELEMENT, TYPE=MASS, ELSET=BOB\n2, 2\n*MASS, ELSET=BOB\n2.\n*SURFACE, TYPE=NODE, NAME=ARM\n2\n" +
         coupling + "*BOUNDARY\n1, 1, 5\n";
}

TEST(InpCouplings, KinematicIsARigidArm) {
  const double f = std::sqrt(450.0 / (2.0 * 9.0)) / (2.0 * pi);
  for (const char* coupling : {"*COUPLING, REF NODE=1, SURFACE=ARM, CONSTRAINT NAME=C\n*KINEMATIC\n",
                               "*COUPLING, REF NODE=1, SURFACE=ARM, CONSTRAINT NAME=C\n*KINEMATIC\n1, 3\n",
                               "*KINEMATIC COUPLING, REF NODE=1\n2, 1, 6\n"}) {
    EXPECT_NEAR(frequencies(deck_model(pendulum(coupling)).model, 1).at(0) / f, 1.0, 1e-9) << coupling;
  }
}

/// CalculiX: the displacements of ROT NODE are the body's rotations. Two of them are held there, the third has the spring.
TEST(InpCouplings, RigidBodyWithANodeOfItsRotations) {
  const double f = std::sqrt(450.0 / (2.0 * 9.0)) / (2.0 * pi);
  const std::string body = "*NSET, NSET=BODY\n2\n*NODE\n7, 0, 0, 0\n*RIGID BODY, NSET=BODY, REF NODE=1, ROT NODE=7\n";
  std::string deck = pendulum(body);
  deck.replace(deck.find("1, 1, 5\n"), 8, "1, 1, 3\n7, 1, 2\n");
  EXPECT_NEAR(frequencies(deck_model(deck).model, 1).at(0) / f, 1.0, 1e-9);
  std::string held = deck;
  held.replace(held.find("7, 1, 2\n"), 8, "7, 1, 3\n");
  EXPECT_TRUE(deck_model(held).model.supports.front().fixed[5]);
  // A spring at that node is refused; at the reference node, as the message says, it is the pendulum's.
  std::string sprung = deck;
  sprung.replace(sprung.find("1, 1\n*SPRING, ELSET=HINGE\n6"), 27, "1, 7\n*SPRING, ELSET=HINGE\n3");
  EXPECT_NE(refusal_of(sprung).find("ROT NODE 7 carries an element, spring or mass too"), std::string::npos)
      << refusal_of(sprung);
}

/// Its displacements are three rotations: a load or movement of a fourth to sixth is none.
TEST(InpCouplings, ANodeOfRotationsHasThreeDegreesOfFreedom) {
  const std::string body = "*NSET, NSET=BODY\n2\n*NODE\n7, 0, 0, 0\n*RIGID BODY, NSET=BODY, REF NODE=1, ROT NODE=7\n";
  std::string deck = pendulum(body);
  deck.replace(deck.find("1, 1, 5\n"), 8, "1, 1, 3\n7, 1, 2\n");
  const auto loaded = [&](const std::string& load) {
    return deck + "*STEP\n*STATIC\n" + load + "*END STEP\n*STEP, PERTURBATION\n*FREQUENCY\n1\n*END STEP\n";
  };
  const fe::Prestress::Load moment = deck_model(loaded("*CLOAD\n7, 3, 1.5\n")).model.prestress.loads.at(0);
  EXPECT_EQ(moment.node, 0);
  EXPECT_EQ(moment.direction, 5);
  EXPECT_EQ(moment.value, 1.5);
  for (const char* load : {"*CLOAD\n7, 4, 1.0\n", "*BOUNDARY\n7, 4, 4, 0.1\n"}) {
    const std::string said = refusal_of(loaded(load));
    EXPECT_NE(said.find("uses degree of freedom 4 of a ROT NODE, which has 1 to 3"), std::string::npos) << load << said;
  }
  EXPECT_TRUE(deck_model(loaded("*BOUNDARY\n7, 1, 6, 0.\n")).model.prestress.loads.empty());
}

/// The springs hold the reference node; every set that is given belongs to the body.
TEST(InpCouplings, RigidBodyOfSeveralSets) {
  const std::string head =
      "*NODE\n1, 0, 0, 0\n2, 3, 0, 0\n3, 0, 3, 0\n4, 0, 0, 3\n*NSET, NSET=N\n2\n*NSET, NSET=T\n3\n"
      "*ELEMENT, TYPE=MASS, ELSET=E\n4, 4\n*ELEMENT, TYPE=MASS, ELSET=M\n2, 2\n3, 3\n"
      "*MASS, ELSET=E\n2.\n*MASS, ELSET=M\n2.\n*BOUNDARY\n1, 1, 3\n*ELEMENT, TYPE=SPRING1, ELSET=H\n5, 1\n"
      "*SPRING, ELSET=H\n6\n450.\n";
  const auto slaves = [&](const std::string& sets) {
    std::set<long> ids;
    const fe::Model model = deck_model(head + "*RIGID BODY, REF NODE=1" + sets + "\n").model;
    for (const fe::RigidLink& link : model.links) ids.insert(model.nodes[static_cast<std::size_t>(link.slave)].id);
    return ids;
  };
  EXPECT_EQ(slaves(", ELSET=E, TIE NSET=T"), (std::set<long>{3, 4}));
  EXPECT_EQ(slaves(", ELSET=E, NSET=N"), (std::set<long>{2, 4}));
  EXPECT_EQ(slaves(", NSET=N, TIE NSET=T"), (std::set<long>{2, 3}));
  EXPECT_NE(refusal_of(head + "*RIGID BODY, REF NODE=1\n").find("NSET"), std::string::npos);
}

TEST(InpCouplings, KinematicInSomeDirectionsLeavesTheOthers) {
  // Only y follows; in x and z the mass hangs on springs of its own.
  const std::string deck = pendulum(
      "*COUPLING, REF NODE=1, SURFACE=ARM, CONSTRAINT NAME=C\n*KINEMATIC\n2, 2\n"
      "*ELEMENT, TYPE=SPRING1, ELSET=X\n3, 2\n*SPRING, ELSET=X\n1\n800.\n"
      "*ELEMENT, TYPE=SPRING1, ELSET=Z\n4, 2\n*SPRING, ELSET=Z\n3\n3200.\n");
  const std::vector<double> f = frequencies(deck_model(deck).model, 3);
  EXPECT_NEAR(f.at(0) * 2.0 * pi, 5.0, 1e-6);
  EXPECT_NEAR(f.at(1) * 2.0 * pi, 20.0, 1e-6);
  EXPECT_NEAR(f.at(2) * 2.0 * pi, 40.0, 1e-6);
}

/// Four masses of 1 kg at the corners of a square of 2 m in the plane, each on a spring in z of 100 N/m; the reference node
/// hangs above them.
std::string square(const std::string& rest) {
  return "*NODE, NSET=CORNERS\n1, -1, -1, 0\n2, 1, -1, 0\n3, 1, 1, 0\n4, -1, 1, 0\n*NODE\n9, 0.5, 0, 1\n"
         "*ELEMENT, TYPE=SPRING1, ELSET=Z\n1, 1\n2, 2\n3, 3\n4, 4\n*SPRING, ELSET=Z\n3\n100.\n"
         "*ELEMENT, TYPE=MASS, ELSET=M\n11, 1\n12, 2\n13, 3\n14, 4\n*MASS, ELSET=M\n1.\n"
         "*ELEMENT, TYPE=MASS, ELSET=TOP\n15, 9\n*MASS, ELSET=TOP\n4.\n*SURFACE, TYPE=NODE, NAME=FACE\nCORNERS\n"
         "*BOUNDARY\nCORNERS, 1, 2\n" +
         rest;
}

TEST(InpCouplings, DistributingIsTheMean) {
  // The top's u_z is the mean + 0.5 (u of the right - u of the left)/2 = (1/8, 3/8, 3/8, 1/8) u, its u_x the height times the
  // slope, and so on: M = I + 4 Sᵀ S over the corners, S of displacements of the top by those of the corners.
  const ImportedModel read =
      deck_model(square("*COUPLING, REF NODE=9, SURFACE=FACE, CONSTRAINT NAME=C\n*DISTRIBUTING, WEIGHTING METHOD=UNIFORM\n"));
  Eigen::Matrix<double, 3, 4> s;
  s.row(0) << 0.25, -0.25, -0.25, 0.25;  // theta_y = -du_z/dx; u_x = theta_y times the height of 1 m
  s.row(1) << 0.25, 0.25, -0.25, -0.25;  // theta_x = du_z/dy; u_y = -theta_x
  s.row(2) << 0.125, 0.375, 0.375, 0.125;
  const Eigen::Matrix4d mass = Eigen::Matrix4d::Identity() + 4.0 * s.transpose() * s;
  const Eigen::Vector4d inverse = Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(mass).eigenvalues();
  const std::vector<double> f = frequencies(read.model, 4);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(f.at(i) * 2.0 * pi, std::sqrt(100.0 / inverse[3 - static_cast<Eigen::Index>(i)]), 1e-6) << i;
  EXPECT_NE(fmt::format("{}", fmt::join(read.notes, " ")).find("every node of 'FACE' has the same weight"), std::string::npos);
}

TEST(InpCouplings, RefusalsNameTheirLine) {
  const std::string head = "*COUPLING, REF NODE=9, SURFACE=FACE, CONSTRAINT NAME=C\n";
  const auto expect = [](const std::string& deck, const std::string& words) {
    const std::string said = refusal_of(deck);
    EXPECT_NE(said.find("deck.inp:"), std::string::npos) << said;
    EXPECT_NE(said.find(words), std::string::npos) << said;
  };
  expect(square(head), "is followed by neither *KINEMATIC nor *DISTRIBUTING");
  expect(square("*DISTRIBUTING\n"), "unsupported card");
  expect(square("*COUPLING, REF NODE=9, SURFACE=FASE\n*DISTRIBUTING\n"), "no surface is called 'FASE' (did you mean 'FACE'?)");
  expect(square("*COUPLING, REF NODE=9, SURFACE=FACE, INFLUENCE RADIUS=1.\n*DISTRIBUTING\n"), "INFLUENCE RADIUS");
  expect(square(head + "*DISTRIBUTING, WEIGHTING METHOD=LINEAR\n"), "unsupported WEIGHTING METHOD=LINEAR");
  expect(square(head + "*KINEMATIC\n3, 7\n"), "'3, 7' are no degrees of freedom");
  expect(square("*SURFACE, TYPE=NODE, NAME=SIDE\n1\n2\n*COUPLING, REF NODE=9, SURFACE=SIDE\n*DISTRIBUTING\n"),
         "its nodes do not determine component");
}

TEST(InpJoints, AreSpringsAlongTheAxesOfTheirOrientation) {
  const std::string deck =
      "*NODE\n1, 0, 0, 0\n2, 0, 0, 0\n7, 0, 1, 0\n8, -1, 0, 0\n9, 0, 0, 0\n*ELEMENT, TYPE=JOINTC, ELSET=J\n1, 1, 2\n"
      "*ORIENTATION, NAME=TURNED, DEFINITION=NODES\n7, 8, 9\n*JOINT, ELSET=J, ORIENTATION=TURNED\n*SPRING\n1, 1\n200.\n"
      "*SPRING\n2, 2\n800.\n*SPRING\n3, 3\n1800.\n*DASHPOT\n1, 1\n5.\n"
      "*ELEMENT, TYPE=MASS, ELSET=M\n2, 2\n*MASS, ELSET=M\n2.\n*BOUNDARY\n1, 1, 6\n";
  const fe::Model model = deck_model(deck).model;
  const std::vector<double> f = frequencies(model, 3);
  EXPECT_NEAR(f.at(0) * 2.0 * pi, 10.0, 1e-6);
  EXPECT_NEAR(f.at(1) * 2.0 * pi, 20.0, 1e-6);
  EXPECT_NEAR(f.at(2) * 2.0 * pi, 30.0, 1e-6);
  EXPECT_NEAR(std::abs(model.springs.at(0).direction.y()), 1.0, 1e-12);  // x' lies along global y
  EXPECT_EQ(model.springs.at(3).damping, 5.0);
  const auto without = [&](const std::string& what, const std::string& put) {
    std::string other = deck;
    other.replace(other.find(what), what.size(), put);
    return refusal_of(other);
  };
  EXPECT_NE(without("*JOINT, ELSET=J, ORIENTATION=TURNED\n", "").find("ELSET is missing"), std::string::npos)
      << without("*JOINT, ELSET=J, ORIENTATION=TURNED\n", "");
  EXPECT_NE(without("1, 1\n200.", "1, 2\n200.").find("names no single degree of freedom"), std::string::npos);
  EXPECT_NE(without("TYPE=JOINTC", "TYPE=SPRING2").find("element 1 of its set is a SPRING2"), std::string::npos);
}

}  // namespace
}  // namespace twindeck::model_io::test::inp_couplings
