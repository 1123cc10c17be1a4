#include "core/units.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <vector>

#include "core/letters.hpp"
#include "core/lists.hpp"

namespace twindeck {
namespace {

using Dimension = std::array<int, 5>;  // kg, m, s, K, rad
constexpr Dimension kOne{0, 0, 0, 0, 0}, kMass{1, 0, 0, 0, 0}, kLength{0, 1, 0, 0, 0}, kTime{0, 0, 1, 0, 0},
    kTemperature{0, 0, 0, 1, 0}, kAngle{0, 0, 0, 0, 1}, kFrequency{0, 0, -1, 0, 0}, kForce{1, 1, -2, 0, 0},
    kPressure{1, -1, -2, 0, 0}, kEnergy{1, 2, -2, 0, 0}, kPower{1, 2, -3, 0, 0};

struct Symbol {
  std::string name;
  Unit unit;
};

/// Every symbol, in the order in which alternatives are proposed to the user.
const std::vector<Symbol>& symbols() {
  static const std::vector<Symbol> all = [] {
    constexpr double pi = std::numbers::pi;
    std::vector<Symbol> list;
    const auto add = [&](const std::string& name, double factor, const Dimension& dimension, double offset = 0.0) {
      list.push_back({name, {factor, offset, dimension}});
    };
    const auto add_prefixed = [&](const std::string& name, double factor, const Dimension& dimension,
                                  const std::vector<std::pair<std::string, double>>& prefixes) {
      for (const auto& [prefix, scale] : prefixes) add(prefix + name, factor * scale, dimension);
    };
    const std::pair<std::string, double> none{"", 1.0}, k{"k", 1e3}, M{"M", 1e6}, G{"G", 1e9}, T{"T", 1e12}, h{"h", 1e2},
        c{"c", 1e-2}, d{"d", 1e-1}, m{"m", 1e-3}, u{"u", 1e-6}, mu{"µ", 1e-6}, n{"n", 1e-9};
    add_prefixed("m", 1.0, kLength, {none, m, c, k, d, u, mu, n});
    add("kg", 1.0, kMass);
    add("t", 1e3, kMass);
    add_prefixed("g", 1e-3, kMass, {none, m, M});
    add_prefixed("s", 1.0, kTime, {none, m, u, mu, n});
    add("min", 60.0, kTime);
    add("h", 3600.0, kTime);
    add("day", 86400.0, kTime);
    add_prefixed("N", 1.0, kForce, {none, k, M, G, m});
    add_prefixed("Pa", 1.0, kPressure, {none, k, M, G, T, h});
    add_prefixed("bar", 1e5, kPressure, {none, m});
    add_prefixed("Hz", 1.0, kFrequency, {none, k, m, M});
    add_prefixed("J", 1.0, kEnergy, {none, k, M, m});
    add_prefixed("W", 1.0, kPower, {none, k, M, m});
    add("K", 1.0, kTemperature);
    add("degC", 1.0, kTemperature, 273.15);
    add("°C", 1.0, kTemperature, 273.15);
    add_prefixed("rad", 1.0, kAngle, {none, m});
    add("deg", pi / 180.0, kAngle);
    add("°", pi / 180.0, kAngle);
    add("%", 1e-2, kOne);
    add("‰", 1e-3, kOne);
    add("-", 1.0, kOne);
    return list;
  }();
  return all;
}

const Unit* find_symbol(std::string_view name) {
  static const std::map<std::string, Unit, std::less<>> index = [] {
    std::map<std::string, Unit, std::less<>> built;
    for (const Symbol& symbol : symbols()) built.emplace(symbol.name, symbol.unit);
    return built;
  }();
  const auto found = index.find(name);
  return found == index.end() ? nullptr : &found->second;
}

std::string nearest_symbol(std::string_view name) {
  for (const Symbol& symbol : symbols()) {
    if (lower_case(symbol.name) == lower_case(name)) return symbol.name;  // "kn", "gpa", "HZ": the commonest slip
  }
  for (std::size_t cut = 1; cut < name.size(); ++cut) {  // products written without a blank: "kNm" for "kN m"
    if (find_symbol(name.substr(0, cut)) && find_symbol(name.substr(cut)))
      return std::string(name.substr(0, cut)) + " " + std::string(name.substr(cut));
  }
  return nearest_name(name, each_of(symbols(), &Symbol::name));
}

/// Recursive descent over   product := power { (" " | "*" | "·" | "/") power },   power := ( symbol | "1" | "(" product ")" ) [
/// "^" ] [integer].
class UnitParser {
 public:
  UnitParser(std::string_view text, const Place& place) : text_(text), place_(place) {}

  Unit parse() {
    skip_blanks();
    if (at_ == text_.size()) return {};
    Unit unit = product();
    if (at_ != text_.size()) fail("has '" + std::string(text_.substr(at_)) + "' left over");
    return unit;
  }

 private:
  Unit product() {
    const std::size_t start = at_;
    Unit result = power();
    int factors = 1;
    while (true) {
      const bool blank = skip_blanks();
      int sign = 1;
      if (take("/")) {
        sign = -1;
      } else if (!take("*") && !take("·") && !(blank && at_ < text_.size() && text_[at_] != ')')) {
        break;
      }
      skip_blanks();
      multiply(result, power(), sign);
      ++factors;
    }
    if (factors > 1 || text_.substr(start, at_ - start).find_first_of("^0123456789") != std::string_view::npos)
      result.offset = 0.0;
    return result;
  }

  Unit power() {
    Unit base;
    if (take("(")) {
      base = product();
      skip_blanks();
      if (!take(")")) fail("lacks a closing bracket");
    } else if (at_ < text_.size() && text_[at_] == '1') {
      ++at_;
      return base;
    } else {
      base = symbol();
    }
    int exponent = 1;
    if (take("²")) {
      exponent = 2;
    } else if (take("³")) {
      exponent = 3;
    } else {
      const bool caret = take("^");
      const char* begin = text_.data() + at_;
      const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), exponent);
      if (error == std::errc{}) {
        at_ += static_cast<std::size_t>(end - begin);
      } else if (caret) {
        fail("has no whole number after '^'");
      } else {
        exponent = 1;
      }
    }
    if (exponent == 1) return base;
    Unit result;
    for (int i = 0; i < std::min(std::abs(exponent), 12); ++i) multiply(result, base, exponent > 0 ? 1 : -1);
    return result;
  }

  Unit symbol() {
    const std::size_t start = at_;
    if (at_ < text_.size() && text_[at_] == '-') ++at_;
    while (at_ < text_.size() && text_.substr(start, at_ - start) != "-") {
      const std::string_view rest = text_.substr(at_);
      const auto ch = static_cast<unsigned char>(rest.front());
      if (rest.starts_with("²") || rest.starts_with("³") || rest.starts_with("·")) break;
      if (!(std::isalpha(ch) || ch == '%' || ch == '_' || ch >= 0x80)) break;
      ++at_;
    }
    const std::string_view name = text_.substr(start, at_ - start);
    const Unit* unit = find_symbol(name);
    if (unit == nullptr) {
      const std::string nearest = nearest_symbol(name);
      fail(name.empty() ? "cannot be read" : "has the unknown unit symbol '" + std::string(name) + "'",
           nearest.empty() ? "units are built of m kg t s N Pa Hz J W K degC rad deg % with SI prefixes, for example \"kN/m\""
                           : "did you mean '" + nearest + "'?");
    }
    return *unit;
  }

  static void multiply(Unit& left, const Unit& right, int sign) {
    left.factor = sign > 0 ? left.factor * right.factor : left.factor / right.factor;
    left.offset += sign > 0 ? right.offset : 0.0;  // kept for a lone symbol only; product() clears it otherwise
    for (std::size_t i = 0; i < left.dimension.size(); ++i) left.dimension[i] += sign * right.dimension[i];
  }

  bool take(std::string_view token) {
    if (!text_.substr(at_).starts_with(token)) return false;
    at_ += token.size();
    return true;
  }
  bool skip_blanks() {
    const std::size_t start = at_;
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    return at_ > start;
  }
  [[noreturn]] void fail(const std::string& problem,
                         const std::string& mend = "write units like \"kN/m\", \"N s/m\", \"m/s^2\"") {
    throw InputError(place_, "unit \"" + std::string(text_) + "\" " + problem, mend);
  }

  std::string_view text_;
  Place place_;
  std::size_t at_ = 0;
};

/// "GPa, MPa, ..." of the units that would have fitted.
std::string proposals(const Unit& wanted, std::string_view field_unit) {
  std::string list(field_unit.empty() ? "a plain number" : field_unit);
  int count = 1;
  for (const Symbol& symbol : symbols()) {
    if (count == 4) break;
    if (symbol.unit.same_dimension(wanted) && symbol.name != field_unit && symbol.name != "-") {
      list += ", " + symbol.name;
      ++count;
    }
  }
  return list;
}

std::string_view trimmed(std::string_view text) { return without_blanks(text, " \t\n\v\f\r"); }

}  // namespace

Unit parse_unit(std::string_view text, const Place& place) { return UnitParser(trimmed(text), place).parse(); }

double parse_quantity(std::string_view text, std::string_view field_unit, const Place& place) {
  const std::string_view written = trimmed(text);
  std::string_view digits = written;
  if (digits.size() > 1 && digits.front() == '+' && digits[1] != '-') digits.remove_prefix(1);  // from_chars refuses the plus
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const std::string quoted = "\"" + std::string(written) + "\"";
  const std::string example = field_unit.empty() ? "0.5" : "1.5 " + std::string(field_unit);
  if (error != std::errc{} || !std::isfinite(value)) {
    throw InputError(place, "is " + quoted + ", expected a finite number" + (field_unit.empty() ? "" : " with its unit"),
                     "write it like \"" + example + "\"");
  }
  const std::string_view rest = trimmed(digits.substr(static_cast<std::size_t>(end - digits.data())));
  const auto checked = [&](double result) {
    if (!(std::abs(result) <= largest_number))
      throw InputError(place, "is " + quoted + ", larger than any quantity of a structure", "correct the value or its unit");
    return result;
  };
  if (rest.empty()) return checked(value);
  if (rest.front() == ',') throw InputError(place, "is " + quoted + ", which has a decimal comma", "write a decimal point");
  const Unit given = parse_unit(rest, place);
  const Unit wanted = parse_unit(field_unit);
  if (!given.same_dimension(wanted)) {
    throw InputError(place,
                     "is " + quoted + ", whose unit is of another kind than " +
                         (field_unit.empty() ? std::string("a plain number") : "\"" + std::string(field_unit) + "\""),
                     "give it in " + proposals(wanted, field_unit));
  }
  if (given.factor == wanted.factor && given.offset == wanted.offset)
    return checked(value);  // no rounding where nothing is converted
  return checked((value * given.factor + given.offset - wanted.offset) / wanted.factor);
}

}  // namespace twindeck
