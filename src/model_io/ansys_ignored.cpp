#include "model_io/ansys_ignored.hpp"

#include <map>
#include <sstream>

namespace twindeck::model_io::ansys {
namespace {

struct Row {
  const char* keys;  ///< Command::key, separated by blanks
  const char* reason;
  bool told = false;
};

constexpr const char* loads = "is a load";

constexpr Row rows[] = {
    {"/BATC /CONF /FILN /FILE /NERR /STAT /PMET /NOPR /GOPR /GO /NOLI /GOLI /WB /VERI /STIT /COPY /DELE /RENA /NPRO /CWD "
     "/MKDI "
     "/SYS "
     "/UIS /UI /ABBR *ABBR /MENU /REPL /AUTO /WAIT /PAGE /FORM /HEAD /OUT /OUTP /GST /XML XMLO SAVE PARS *STAT *LIST /DFLA",
     "governs the session, its files and its messages"},
    {"/SHOW /VIEW /ANG /PNUM /GRAP /COLO /RGB /TRIA /PSF /PBC /PSYM /DIST /FOCU /ESHA /EDGE /TYPE /CPLA /CTYP /ZOOM /USER /VUP "
     "/DEVI /NUMB /PLOP /TRLC /LIGH /SHAD /WIND /NOER /ERAS /ANNO /XRAN /YRAN /AXLA EPLO NPLO SECP GPLO",
     "draws"},
    {"NLIS ELIS DLIS MPLI RLIS ETLI SLIS CMLI CELI CPLI FLIS SFEL STAT EVAL CHEC SHPP /INQ", "lists or checks"},
    {"/PREP /SOLU /POST FINI ANTY MODO MXPA MODC QRDO EQSL EQSO RIGI SUBO HROU TRNO HARF MODS LANB BCSO PCGO CMAT DMPO ETCO "
     "NUMO MEMM",
     "says how and where to solve; twindeck asks for its own number of modes"},
    {"OUTR OUTP ERES RESC MONI RATE", "asks for results"},
    {"AUTO NSUB DELT TIME KBC CNVT NEQI LNSR PRED SOLC NROP TINT NCNV ARCL CUTC OPNC LSWR SSTI STAB KUSE TIMI",
     "steps through a static or transient solution"},
    {"MPTE MPTG MPTR TREF TOFF TUNI BFUN BF BFE BFEB BFBL BFCU BFDE BFED EBLD LDRE",
     "temperature: moduli are taken at one temperature"},
    {"EXTO LATT AATT VATT KATT MSHK MSHA ESIZ SMRT MOPT KSEL LSEL ASEL VSEL CMGR CMPL EXTN DESI DOF CGLO",
     "speaks of geometry and meshing, of which an archive holds the result"},
    {"F FDEL FCUM FJ SF SFE SFDE SFED SFGR SFCU SFA SFL SFBE ACEL CMAC OMEG DOME CGOM DCGO CMOM IRLF INER", loads, true},
    {"CRPL", "limits creep, which modes do not have", true},
    {"JPGP PNGR TIFF IMME BMPG PSCR /GRTY /GSAV /GRES /GLIN /DEVD /CMAP /IMAG /UDOC /CVAL /CFOR /AN3D /ANUM /SEG /NOCO /SHRI",
     "makes pictures", true},
    {"TOTA M MGEN MDEL MLIS", "chooses the unknowns of a reduction, which is not done here: all unknowns are kept", true},
    {"ALPH BETA DMPR DMPS MDAM DAMP SDAM", "is damping, which modes of a structure without it do not have", true}};

const std::map<std::string, Ignored>& table() {
  static const std::map<std::string, Ignored> known = [] {
    std::map<std::string, Ignored> list;
    for (const Row& row : rows) {
      std::istringstream keys(row.keys);
      for (std::string key; keys >> key;) list[key] = {row.reason, row.told};
    }
    return list;
  }();
  return known;
}

}  // namespace

const Ignored* ignored(const std::string& key) {
  const auto found = table().find(key);
  return found == table().end() ? nullptr : &found->second;
}

bool is_load(const std::string& key) {
  const Ignored* known = ignored(key);
  return known != nullptr && known->reason == loads;
}

}  // namespace twindeck::model_io::ansys
