#include "model_io/nastran_ignored.hpp"

#include <initializer_list>
#include <span>

namespace twindeck::model_io::nastran {
namespace {

struct Reason {
  const char* reason;
  std::initializer_list<const char*> cards;
};

std::map<std::string, std::string> by_card(std::span<const Reason> reasons) {
  std::map<std::string, std::string> result;
  for (const Reason& reason : reasons) {
    for (const char* card : reason.cards) result.emplace(card, reason.reason);
  }
  return result;
}

}  // namespace

const std::map<std::string, std::string>& ignored_cards() {
  static const std::map<std::string, std::string> cards = [] {
    const Reason reasons[] = {
        {"say how modes are computed", {"EIGRL", "EIGR", "EIGB", "EIGC", "EIGP", "SUPORT", "SUPORT1"}},
        {"choose unknowns for a reduction, which is not done here",
         {"ASET", "ASET1", "OMIT", "OMIT1", "QSET", "QSET1", "USET", "USET1"}},
        {"are loads: they act on modes where STATSUB chooses their subcase",
         {"FORCE",  "FORCE1", "FORCE2", "MOMENT", "MOMENT1", "MOMENT2", "PLOAD",  "PLOAD1", "PLOAD2",
          "PLOAD4", "GRAV",   "RFORCE", "LOAD",   "LSEQ",    "DLOAD",   "SLOAD",  "SPCD",   "DAREA",
          "DELAY",  "DPHASE", "RLOAD1", "RLOAD2", "TLOAD1",  "TLOAD2",  "DEFORM", "ACCEL",  "ACCEL1"}},
        {"are random loads", {"RANDPS", "RANDT1", "TABRND1"}},
        {"are temperatures, which act on modes where STATSUB chooses them, or belong to heat",
         {"TEMP", "TEMPD", "TEMPRB", "TEMPP1", "MAT4", "MAT5", "CHBDYE", "CHBDYG", "CONV", "PCONV", "RADM", "RADBC"}},
        {"are tables of loads or damping", {"TABLED1", "TABLED2", "TABLED3", "TABLED4", "TABDMP1"}},
        {"are steps of a response", {"FREQ", "FREQ1", "FREQ2", "FREQ3", "FREQ4", "FREQ5", "TSTEP", "TSTEPNL", "NLPARM"}},
        {"are air, not structure",
         {"AERO", "AEROS", "CAERO1", "PAERO1", "SPLINE1", "SPLINE2", "MKAERO1", "MKAERO2", "FLUTTER", "FLFACT", "GUST", "TRIM",
          "AESTAT", "AESURF", "AELIST"}},
        {"are dampers: give them in springs.csv of the model folder",
         {"CDAMP1", "CDAMP2", "CDAMP3", "CDAMP4", "PDAMP", "CVISC", "PVISC"}},
        {"are control equations, which enter complex modes only", {"TF", "EPOINT"}},
        {"are lists, pictures or settings of the program", {"SET1", "SET3", "PLOTEL", "MDLPRM"}},
        {"are design variables and responses",
         {"DESVAR", "DVPREL1", "DVMREL1", "DRESP1", "DRESP2", "DCONSTR", "DCONADD", "DOPTPRM", "DLINK"}}};
    return by_card(reasons);
  }();
  return cards;
}

const std::map<std::string, std::string>& refused_cards() {
  static const std::map<std::string, std::string> cards = [] {
    const Reason reasons[] = {
        {"mesh the plate with quadrilaterals (CQUAD4)", {"CTRIAR"}},
        {"a CQUADR may be written as CQUAD4", {"CQUADR"}},
        {"mesh with hexahedra of 8 nodes (CHEXA)", {"CPENTA", "CPYRAM"}},
        {"give the plate as a PSHELL of one material", {"PCOMP", "PCOMPG", "MAT2", "MAT8", "CSHEAR"}},
        {"give an isotropic material by MAT1", {"MAT3", "MAT9", "MAT10", "MATT1"}},
        {"a rigid joint is RBE2 or RBAR", {"RBE1", "RROD", "RTRPLT", "RSPLINE", "CWELD", "CFAST"}},
        {"write a straight CBAR or CBEAM with PBAR or PBEAM", {"CBEND", "PBEND", "PBCOMP", "PBMSECT", "PBRSECT"}},
        {"write a CROD with the area of the tube", {"CTUBE", "PTUBE"}},
        {"give every element its own fields", {"BAROR", "BEAMOR"}},
        {"put a GRID in place of the scalar point", {"CELAS3", "CELAS4", "CMASS3", "CMASS4"}},
        {"give the whole model as matrices (docs/my_model.md), or the element by DMIG", {"GENEL"}},
        {"give DMIG, which is chosen by K2GG and M2GG", {"DMIJ", "DMIJI", "DMIK", "DMI"}},
        {"modes need a linear joint: CELAS2 or CBUSH", {"CGAP", "CBUSH1D", "BCTABLE", "BCONTACT", "BSURF"}}};
    return by_card(reasons);
  }();
  return cards;
}

bool scales_matrices(const std::string& parameter) {
  for (const char* name : {"CK1", "CK2", "CK3", "CM1", "CM2"}) {
    if (parameter == name) return true;
  }
  return false;
}

}  // namespace twindeck::model_io::nastran
