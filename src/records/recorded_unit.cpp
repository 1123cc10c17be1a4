#include "records/recorded_unit.hpp"

#include <string_view>
#include <utility>

#include "core/letters.hpp"
#include "records/text_cells.hpp"

namespace twindeck::records {
namespace {

/// Lower case without blanks and brackets; µ, ², ° in any spelling as u, 2, deg.
std::string plain(const std::string& unit) {
  static constexpr std::pair<std::string_view, std::string_view> spellings[] = {
      {"\xC2\xB5", "u"}, {"\xCE\xBC", "u"}, {"\xC2\xB2", "2"}, {"\xC2\xB0", "deg"}, {"**", ""}, {"^", ""},
      {" ", ""},         {"[", ""},         {"]", ""},         {"(", ""},           {")", ""}};
  constexpr std::size_t longest = 40;  // bytes; no unit is as long
  if (unit.size() > longest) return "";
  std::string text = unit;
  for (const auto& [from, to] : spellings)
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  return lower_case(text);
}

constexpr double kG = 9.80665, kInch = 0.0254, kFoot = 0.3048,
                 kPoundForce = 4.4482216152605;  // [m/s²], [m], [m], [N]: exact by definition

/// Units of one quantity and one factor. @param spellings  with '|' before and behind each
struct Known {
  const char *quantity, *spellings;
  double si_factor;
};

constexpr Known kKnown[] = {
    {"acceleration", "|m/s2|m/s/s|ms-2|m*s-2|m/sec2|m/s\xB2|", 1.0},
    {"acceleration", "|mm/s2|mm/s/s|mm/sec2|", 1e-3},
    {"acceleration", "|cm/s2|cm/s/s|cm/sec2|gal|", 1e-2},
    {"acceleration", "|um/s2|", 1e-6},
    {"acceleration", "|mgal|", 1e-5},
    {"acceleration", "|g|gn|g0|", kG},
    {"acceleration", "|mg|", 1e-3 * kG},
    {"acceleration", "|ug|", 1e-6 * kG},
    {"acceleration", "|in/s2|", kInch},
    {"acceleration", "|ft/s2|", kFoot},
    {"velocity", "|m/s|ms-1|m/sec|", 1.0},
    {"velocity", "|cm/s|cm/sec|", 1e-2},
    {"velocity", "|mm/s|mm/sec|", 1e-3},
    {"velocity", "|um/s|", 1e-6},
    {"velocity", "|nm/s|", 1e-9},
    {"velocity", "|in/s|ips|", kInch},
    {"velocity", "|ft/s|", kFoot},
    {"displacement", "|m|", 1.0},
    {"displacement", "|cm|", 1e-2},
    {"displacement", "|mm|", 1e-3},
    {"displacement", "|um|", 1e-6},
    {"displacement", "|nm|", 1e-9},
    {"displacement", "|in|inch|", kInch},
    {"displacement", "|mil|", 1e-3 * kInch},
    {"displacement", "|ft|", kFoot},
    {"force", "|n|", 1.0},
    {"force", "|kn|", 1e3},
    {"force", "|lbf|", kPoundForce},
    {"force", "|kip|", 1e3 * kPoundForce},
    {"", "|v|mv|uv|volt|volts|vdc|v/v|mv/v|a|ma|", 0.0},
    {"", "|count|counts|cts|cnt|digit|digits|lsb|adc|raw|bit|bits|adu|", 0.0},
};

}  // namespace

std::optional<RecordedUnit> recorded_unit(const std::string& unit) {
  const std::string spelling = plain(unit);
  for (const Known& known : kKnown)
    if (is_one_of(known.spellings, spelling)) return RecordedUnit{known.quantity, known.si_factor};
  return {};
}

std::vector<std::string> units_of(const std::string& quantity) {
  if (quantity == "acceleration") return {"m/s^2", "mm/s^2", "cm/s^2", "Gal", "g", "mg"};
  if (quantity == "velocity") return {"m/s", "cm/s", "mm/s", "um/s", "in/s"};
  if (quantity == "displacement") return {"m", "cm", "mm", "um", "in"};
  if (quantity == "force") return {"N", "kN", "lbf", "kip"};
  return {"V", "mV", "counts"};
}

double si_factor(const std::string& unit) { return recorded_unit(unit).value_or(RecordedUnit{}).si_factor; }

}  // namespace twindeck::records
