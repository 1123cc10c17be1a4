#include "records/recorded_unit.hpp"

#include <array>
#include <map>

#include "records/text_cells.hpp"

namespace twindeck::records {
namespace {

/// Lower case without blanks and brackets; µ, ², ° in any spelling as u, 2, deg.
std::string plain(const std::string& unit) {
  static const std::array<std::pair<std::string, std::string>, 11> spellings = {{{"\xC2\xB5", "u"},
                                                                                 {"\xCE\xBC", "u"},
                                                                                 {"\xC2\xB2", "2"},
                                                                                 {"\xC2\xB0", "deg"},
                                                                                 {"**", ""},
                                                                                 {"^", ""},
                                                                                 {" ", ""},
                                                                                 {"[", ""},
                                                                                 {"]", ""},
                                                                                 {"(", ""},
                                                                                 {")", ""}}};
  constexpr std::size_t longest = 40;  // bytes; no unit is as long
  if (unit.size() > longest) return "";
  std::string text = unit;
  for (const auto& [from, to] : spellings) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  }
  return lower(text);
}

struct Known {
  const char* spelling;
  const char* quantity;
  double si_factor;
};

constexpr double kG = 9.80665, kInch = 0.0254, kFoot = 0.3048,
                 kPoundForce = 4.4482216152605;  // [m/s²], [m], [m], [N]: exact by definition

const std::map<std::string, RecordedUnit>& known_units() {
  static constexpr Known list[] = {
      {"m/s2", "acceleration", 1.0},
      {"m/s/s", "acceleration", 1.0},
      {"ms-2", "acceleration", 1.0},
      {"m*s-2", "acceleration", 1.0},
      {"m/sec2", "acceleration", 1.0},
      {"m/s\xB2", "acceleration", 1.0},
      {"mm/s2", "acceleration", 1e-3},
      {"mm/s/s", "acceleration", 1e-3},
      {"mm/sec2", "acceleration", 1e-3},
      {"cm/s2", "acceleration", 1e-2},
      {"cm/s/s", "acceleration", 1e-2},
      {"cm/sec2", "acceleration", 1e-2},
      {"um/s2", "acceleration", 1e-6},
      {"gal", "acceleration", 1e-2},
      {"mgal", "acceleration", 1e-5},
      {"g", "acceleration", kG},
      {"gn", "acceleration", kG},
      {"g0", "acceleration", kG},
      {"mg", "acceleration", 1e-3 * kG},
      {"ug", "acceleration", 1e-6 * kG},
      {"in/s2", "acceleration", kInch},
      {"ft/s2", "acceleration", kFoot},
      {"m/s", "velocity", 1.0},
      {"ms-1", "velocity", 1.0},
      {"m/sec", "velocity", 1.0},
      {"cm/s", "velocity", 1e-2},
      {"cm/sec", "velocity", 1e-2},
      {"mm/s", "velocity", 1e-3},
      {"mm/sec", "velocity", 1e-3},
      {"um/s", "velocity", 1e-6},
      {"nm/s", "velocity", 1e-9},
      {"in/s", "velocity", kInch},
      {"ips", "velocity", kInch},
      {"ft/s", "velocity", kFoot},
      {"m", "displacement", 1.0},
      {"cm", "displacement", 1e-2},
      {"mm", "displacement", 1e-3},
      {"um", "displacement", 1e-6},
      {"nm", "displacement", 1e-9},
      {"in", "displacement", kInch},
      {"inch", "displacement", kInch},
      {"mil", "displacement", 1e-3 * kInch},
      {"ft", "displacement", kFoot},
      {"n", "force", 1.0},
      {"kn", "force", 1e3},
      {"lbf", "force", kPoundForce},
      {"kip", "force", 1e3 * kPoundForce},
      {"v", "", 0.0},
      {"mv", "", 0.0},
      {"uv", "", 0.0},
      {"volt", "", 0.0},
      {"volts", "", 0.0},
      {"vdc", "", 0.0},
      {"count", "", 0.0},
      {"counts", "", 0.0},
      {"cts", "", 0.0},
      {"cnt", "", 0.0},
      {"digit", "", 0.0},
      {"digits", "", 0.0},
      {"lsb", "", 0.0},
      {"adc", "", 0.0},
      {"raw", "", 0.0},
      {"v/v", "", 0.0},
      {"mv/v", "", 0.0},
      {"bit", "", 0.0},
      {"bits", "", 0.0},
      {"adu", "", 0.0},
      {"a", "", 0.0},
      {"ma", "", 0.0},
  };
  static const std::map<std::string, RecordedUnit> known = [] {
    std::map<std::string, RecordedUnit> built;
    for (const Known& unit : list) built.emplace(unit.spelling, RecordedUnit{unit.quantity, unit.si_factor});
    return built;
  }();
  return known;
}

}  // namespace

std::optional<RecordedUnit> recorded_unit(const std::string& unit) {
  const auto at = known_units().find(plain(unit));
  return at == known_units().end() ? std::nullopt : std::optional(at->second);
}

std::vector<std::string> units_of(const std::string& quantity) {
  if (quantity == "acceleration") return {"m/s^2", "mm/s^2", "cm/s^2", "Gal", "g", "mg"};
  if (quantity == "velocity") return {"m/s", "cm/s", "mm/s", "um/s", "in/s"};
  if (quantity == "displacement") return {"m", "cm", "mm", "um", "in"};
  if (quantity == "force") return {"N", "kN", "lbf", "kip"};
  return {"V", "mV", "counts"};
}

double si_factor(const std::string& unit) {
  const auto known = recorded_unit(unit);
  return known ? known->si_factor : 0.0;
}

}  // namespace twindeck::records
