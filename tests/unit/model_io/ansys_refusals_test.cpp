/// Decks of ANSYS that are refused. Oracle: the message names line and command, and says how to mend it; a deck that differs in
/// this one line is read.
#include "model_io/ansys.hpp"
#include "test_folder.hpp"

namespace twindeck::model_io::test::ansys_refusing {
namespace {

/// Line 9 is `line`.
std::string refusable(const std::string& line) {
  return "/PREP7\nET,1,SHELL181\nSECTYPE,1,SHELL\nSECDATA,0.01\nMP,EX,1,210E9\nMP,DENS,1,7850\nN,1\nN,2,1\n" + line +
         "\nN,3,1,1\nN,4,0,1\nE,1,2,3,4\nD,1,ALL\n/SOLU\nSOLVE\n";
}

std::string answer_to(const std::string& deck) {
  const TestFolder folder;
  folder.write("deck.dat", deck);
  return message_of([&] { (void)read_ansys(folder.path() / "deck.dat"); });
}

TEST(AnsysRefusals, TheDeckItselfIsRead) { EXPECT_EQ(answer_to(refusable("! a comment")), ""); }

TEST(AnsysRefusals, NameLineAndCommand) {
  struct Case {
    const char *line, *words;
  };
  for (const Case& c : {
           Case{"TB,BKIN,1", "deck.dat:9: TB: material tables (BKIN)"},
           {"CE,1,0,1,UX,1,2,TEMP,-1", "deck.dat:9: CE: 'TEMP' is no degree of freedom"},
           {"CE,1,0.5,1,UX,1,2,UX,-1", "deck.dat:9: CE: has a constant that is not 0"},
           {"N,5,5,5,,30\nCE,1,0,2,UX,1,5,UX,-1", "deck.dat:10: CE: ties along the axes of node 5, which are turned"},
           {"CERIG,1,2,UX,TEMP", "deck.dat:9: CERIG: 'TEMP' is no degree of freedom"},
           {"VMESH,ALL", "deck.dat:9: VMESH: unsupported command"},
           {"N,5\nCP,1,UX,2,5", "deck.dat:10: CP: ties node 5, which no element holds"},
           {"CP,1,UX,2", "deck.dat:9: CP: ties less than two nodes"},
           {"*DO,I,1,3\nN,I,I\n*ENDDO", "deck.dat:10: N: depends on the *DO of line 9"},
           {"*IF,A,EQ,1,THEN\nN,9,9\n*ENDIF", "deck.dat:10: N: depends on the *IF of line 9"},
           {"*IF,A,EQ,1,EXIT", "deck.dat:9: *IF: depends on"},
           {"*GET,X,NODE,1,LOC,X\nN,9,X", "deck.dat:10: N: field 2 is 'X', expected a number"},
           {"N,9,SQRT(2)", "deck.dat:9: N: field 2 is 'SQRT(2)', expected a number"},
           {"CSYS,1\nN,9,1,90", "deck.dat:10: N: stands where CSYS is not 0"},
           {"/INPUT,mesh,cdb", "deck.dat:9: /INPUT: other files are not read"},
           {"PSTRES,ON", "deck.dat:9: PSTRES: asks for modes of the loaded structure"},
           {"D,2,UX,0.1", "deck.dat:9: D: prescribes a displacement that is not zero"},
           {"D,1,TEMP", "deck.dat:9: D: 'TEMP' is no degree of freedom"},
           {"D,77,UX", "deck.dat:9: D: node 77 is not defined"},
           {"CMSEL,S,TOP", "deck.dat:9: CMSEL: no component is called 'TOP'"},
           {"NSEL,S,EXT", "deck.dat:9: NSEL: selection by 'EXT'"},
           {"NSEL,X,NODE,,1", "deck.dat:9: NSEL: 'X' is no way to select"},
           {"KEYOPT,1,1,1", "deck.dat:9: KEYOPT: KEYOPT(1) = 1 of SHELL181 is not supported"},
           {"KEYOPT,7,1,1", "deck.dat:9: KEYOPT: type 7 is not defined"},
           {"SECOFFSET,TOP", "deck.dat:3: SECTYPE: section 1 is offset from its nodes"},
           {"SECDATA,0.02", "deck.dat:3: SECTYPE: section 1 has 2 layers"},
           {"SECCONTROL,1E9", "deck.dat:9: SECCONTROL: field 1 overrides a stiffness"},
           {"MP,EY,1,10E9", "deck.dat:9: mat_1: EY makes it orthotropic"},
           {"MP,GXY,1,10E9", "deck.dat:9: mat_1: GXY = 1e+10 does not follow"},
           {"MP,EX,1,210E9,-1E7", "deck.dat:9: MP: EX depends on temperature"},
           {"MP,PRXY,1,0.5", "Poisson's ratio is 0.5"},
           {"E,1,2,9,8", "deck.dat:9: node 8: is used here and defined nowhere"},
           {"E,1,2", "deck.dat:9: element 1: has 2 nodes, a SHELL181 has 4"},
           {"TYPE,3", "deck.dat:12: element 1: its type 3 is not defined"},
           {"ET,1,CONTA174", "deck.dat:12: element 1: is of type CONTA174 (line 9)"},
           {"ET,1,SHELL91", "deck.dat:12: element 1: is a SHELL91, which is not supported"},
           {"ET,1,SHELL281\nE,1,2,3,4,1,2", "deck.dat:10: element 1: "},
           {"ET,1,SHELL185", "is of type SHELL185"},
           {"ET,1,SHELL63", "its set of real constants 1 is not defined"},
           {"ET,1,SHELL63\nR,1,0.1,0.2,0.2,0.1", "deck.dat:10: R: constant 2 of set 1 is 0.2: a thickness that varies"},
           {"RMORE,1", "deck.dat:9: RMORE: stands before any R"},
           {"NBLOCK,3\n(1i9,3e20.9)\n        x", "deck.dat:11: NBLOCK: field 1 is 'x', expected a number"},
           {"NBLOCK,3\nnothing", "deck.dat:10: NBLOCK: 'nothing' is no format"},
           {"NBLOCK,3\n(1i9,3e20.9)", "NBLOCK: "},
           {"CMBLOCK,A,NODE,2\n(8i10)\n         5        -2", "deck.dat:11: CMBLOCK: '5 -2' is no range"},
           {"CMBLOCK,A,NODE,99999999999\n(8i10)", "is no number of members"},
           {"EN,R5.5,ATTR,4,1", "deck.dat:9: EN: elements of an archive without blocks"},
           {"E,1,2,2,1", "deck.dat:9: element 1: has fewer than three different nodes"},
           {"SECDATA,0.02,1E300\nSECT,1,SHELL\nSECD,0.1,-1", "deck.dat:10: SECTYPE: section 1 names material -1"},
           {"MAT,2", "deck.dat:12: element 1: its material 2 has no modulus"},
           {"SOLVE\nMP,EX,1,1", "deck.dat:10: MP: changes the structure between two solutions"},
       }) {
    EXPECT_NE(answer_to(refusable(c.line)).find(c.words), std::string::npos) << c.line << "\n" << answer_to(refusable(c.line));
  }
}

TEST(AnsysRefusals, SolutionsSymmetryAndMasses) {
  for (const auto& [line, words] : std::vector<std::pair<std::string, std::string>>{
           {"ANTYPE,2\nE,1,2,2,1\nSOLVE\nANTYPE,SPECTR\nD,1,UX\nSOLVE\nANTYPE,2\nSOLVE",
            "deck.dat:13: D: changes the structure between two solutions"},
           {"/CLEAR", "deck.dat:9: /CLEAR: throws away the model"},
           {"CORIOLIS,ON", "deck.dat:9: CORIOLIS: asks for the modes of a spinning structure"},
           {"DSYM,SYMM,X,11", "deck.dat:9: DSYM: is no plane of symmetry across a global axis"},
           {"DSYM,EVEN,X", "deck.dat:9: DSYM: is no plane of symmetry"},
           {"ET,2,COMBIN40\nR,2,1,0,1,.1\nTYPE,2\nREAL,2\nE,1,2\nTYPE,1", "deck.dat:10: R: set 2 is no linear spring"},
           {"ET,2,MASS21\nR,2,1,2,1\nN,5,5,5,,30\nTYPE,2\nREAL,2\nE,5\nTYPE,1",
            "differs by direction at a node whose axes are turned"},
           {"OMEGA,,,1,1", "deck.dat:9: OMEGA: asks for the modes of a spinning structure"}})
    EXPECT_NE(answer_to(refusable(line)).find(words), std::string::npos) << line << "\n" << answer_to(refusable(line));
}

TEST(AnsysRefusals, ModesUnderSpinAreThoseAtRest) {
  const std::string answer = answer_to(refusable("PSTRES,ON\nOMEGA,,,1") + "ANTYPE,2\nSOLVE\n");
  EXPECT_NE(answer.find("deck.dat:10: OMEGA: loads the structure"), std::string::npos) << answer;
  EXPECT_NE(answer.find("for the modes at rest"), std::string::npos) << answer;
}

TEST(AnsysRefusals, AnotherModelBehindTheModesIsLeftOut) {
  const TestFolder folder;
  folder.write("deck.dat", refusable("ANTYPE,2") + "/CLEAR,NOSTART\nET,1,SHELL281\nN,1,7\nSOLVE\n");
  const ImportedModel imported = read_ansys(folder.path() / "deck.dat");
  EXPECT_EQ(imported.model.nodes.at(0).x_m.x(), 0.0);
  EXPECT_EQ(imported.notes.front(), "what follows /CLEAR (line 16) is another model and is not read");
}

TEST(AnsysRefusals, CountFieldsAsTheyStand) {
  for (const auto& [line, words] : {std::pair{"EN,7,1,2,x,4", "deck.dat:9: EN: field 4 is 'x'"},
                                    {"R,1,0.1\nRMORE,x", "deck.dat:10: RMORE: field 1 is 'x'"},
                                    {"R,1,0.1\nRMODIF,1,1,x", "deck.dat:10: RMODIF: field 3 is 'x'"}})
    EXPECT_NE(answer_to(refusable(line)).find(words), std::string::npos) << line << "\n" << answer_to(refusable(line));
}

TEST(AnsysRefusals, SectionsOfBeams) {
  for (const auto& [line, words] : std::vector<std::pair<std::string, std::string>>{
           {"SECTYPE,1,TAPER\nSECDATA,0,0,0,2", "its section 1 is of type TAPE"},
           {"SECNUM,7", "its section 7 is not defined"},
           {"SECTYPE,1,BEAM,MESH", "'MESH' that is not supported"},
           {"SECTYPE,1,BEAM,HREC\nSECDATA,.2,.1,.06,.01,.01,.15", "the dimensions do not fit together"},
           {"SECTYPE,1,BEAM,CHAN\nSECDATA,.2,.2,.3,.01,.01,.008\nSECOFFSET,SHRC", "is offset by 'SHRC'"}}) {
    const std::string answer =
        answer_to("/PREP7\nET,1,BEAM188\nMP,EX,1,2E11\nMP,DENS,1,7850\nN,1\nN,2,1\n" + line + "\nE,1,2\nD,1,ALL\n");
    EXPECT_NE(answer.find(words), std::string::npos) << line << "\n" << answer;
  }
}

TEST(AnsysRefusals, NotesNameWhatIsLeftOut) {
  const TestFolder folder;
  folder.write("deck.dat", refusable("F,2,FZ,100\nMP,DMPR,1,0.02\nN,50,5,5\n/UNITS,BIN"));
  std::string all;
  for (const std::string& note : read_ansys(folder.path() / "deck.dat").notes) all += note + "\n";
  for (const char* words :
       {"F (line 9)", "MP,DMPR (line 10)", "1 nodes that no element holds", "/UNITS,BIN", "0.3, as ANSYS takes it"})
    EXPECT_NE(all.find(words), std::string::npos) << words << "\n" << all;
}

}  // namespace
}  // namespace twindeck::model_io::test::ansys_refusing
