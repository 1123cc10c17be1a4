#include "diagnosis/files/catalogue_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "core/units.hpp"
#include "diagnosis/features/features.hpp"
#include "io/toml_value.hpp"

namespace twindeck::diagnosis {

namespace {

/// Reads one file. Each function refuses unknown content, with the line.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : file_(file) {}

  Hypothesis read() {
    h_.file = file_.string();
    take(io::read_toml(file_), {{"hypothesis", [&](const auto& e) { hypothesis(table(e)); }},
                                {"location", [&](const auto& e) { location(table(e)); }},
                                {"parameter", [&](const auto& e) { each(e, [&](const auto& t) { parameter(t); }); }},
                                {"action", [&](const auto& e) { each(e, [&](const auto& t) { action(t); }); }},
                                {"needs", [&](const auto& e) { needs(table(e)); }},
                                {"report", [&](const auto& e) { report(table(e)); }}});
    if (h_.id.empty()) fail(1, "hypothesis.id", "is missing", "name the cause: [hypothesis] id = \"…\"");
    if (h_.set.empty()) fail(1, "location.set", "is missing", "say where the cause can sit: [location] set = \"nodes\"");
    if (h_.actions.empty()) fail(1, "action", "is missing", "say what the cause does: [[action]] kind = \"…\"");
    for (const auto& a : h_.actions) check_numbers(a);
    return h_;
  }

 private:
  using Table = io::TomlValue::Table;

  [[noreturn]] void fail(long line, const std::string& key, const std::string& problem, const std::string& mend) const {
    throw InputError({file_.string(), line, key}, problem, mend);
  }
  /// The keys that a table may have, each with what is done with its entry.
  using Keys = std::vector<std::pair<std::string, std::function<void(const io::TomlEntry&)>>>;
  void take(const Table& entries, const Keys& keys) const {
    for (const io::TomlEntry& entry : entries) {
      if (const auto key = std::ranges::find(keys, entry.key, &Keys::value_type::first); key != keys.end()) {
        key->second(entry);
        continue;
      }
      const std::vector<std::string> known = each_of(keys, &Keys::value_type::first);
      const std::string nearest = nearest_name(entry.key, known);
      fail(entry.line, "", "unknown key '" + entry.key + "'",
           nearest.empty() ? fmt::format("known keys are {}", fmt::join(known, ", ")) : "did you mean '" + nearest + "'?");
    }
  }
  /// Puts the text of an entry into a member.
  std::function<void(const io::TomlEntry&)> text_into(std::string& member) const {
    return [this, &member](const io::TomlEntry& entry) { member = text(entry); };
  }
  const Table& table(const io::TomlEntry& entry) const {
    const auto* found = entry.value.as<Table>();
    if (found == nullptr)
      fail(entry.line, entry.key, "is " + io::shown(entry.value) + ", expected a table", "write [" + entry.key + "]");
    return *found;
  }
  template <typename Use>
  void each(const io::TomlEntry& entry, Use use) const {
    const auto* list = entry.value.as<io::TomlValue::Array>();
    if (list == nullptr)
      fail(entry.line, entry.key, "is " + io::shown(entry.value) + ", expected tables", "write [[" + entry.key + "]]");
    for (const io::TomlValue& value : *list) {
      const auto* entries = value.as<Table>();
      if (entries == nullptr)
        fail(entry.line, entry.key, "holds " + io::shown(value) + ", expected tables", "write [[" + entry.key + "]]");
      use(*entries);
    }
  }
  std::string text(const io::TomlEntry& entry) const {
    const auto* found = entry.value.as<std::string>();
    if (found == nullptr) fail(entry.line, entry.key, "is " + io::shown(entry.value) + ", expected text", "write it in quotes");
    return *found;
  }
  Expression expression(const io::TomlEntry& entry) const { return expression(entry.value, entry.line, entry.key); }
  Expression expression(const io::TomlValue& value, long line, const std::string& key) const {
    Expression e;
    e.line = line;
    if (const auto* number = value.as<double>())
      e.factor = *number;
    else if (const auto* whole = value.as<long>())
      e.factor = static_cast<double>(*whole);
    else if (const auto* t = value.as<std::string>()) {
      const auto star = t->find('*');
      e.name = star == std::string::npos ? *t : t->substr(star + 1);
      if (star != std::string::npos) {
        const auto [end, error] = std::from_chars(t->data(), t->data() + star, e.factor);
        if (error != std::errc() || end != t->data() + star)
          fail(line, key, fmt::format("is '{}', expected a number, a name or \"number*name\"", *t), "");
      }
    } else {
      fail(line, key, "is " + io::shown(value) + ", expected a number or a text", "write 1.5, a name, or \"1.5*name\"");
    }
    if (!(std::abs(e.factor) <= largest_number))
      fail(line, key, "is " + io::shown(value) + ", expected a finite number", "correct the value");
    return e;
  }
  double positive(const io::TomlEntry& entry) const {
    const Expression e = expression(entry);
    if (!e.name.empty() || !(e.factor > 0.0))
      fail(entry.line, entry.key, "is " + io::shown(entry.value) + ", expected a number above 0",
           "1 is the weight of most causes");
    return e.factor;
  }

  void hypothesis(const Table& entries) {
    const auto side = [&](const io::TomlEntry& e) {
      const std::string word = text(e);
      if (word != "model" && word != "measurement")
        fail(e.line, "side", fmt::format("is '{}', expected model or measurement", word), "");
      h_.measurement = word == "measurement";
    };
    take(entries,
         {{"id", text_into(h_.id)}, {"title", text_into(h_.title)}, {"side", side}, {"prior_weight", [&](const auto& e) {
                                                                                       h_.prior_weight = positive(e);
                                                                                     }}});
  }
  void location(const Table& entries) {
    const auto set = [&](const auto& e) {
      h_.set = known_name(text(e), e.line, "location.set", "is no set of locations", location_sets());
    };
    take(entries, {{"set", set}, {"filter", text_into(h_.filter)}});
  }
  void parameter(const Table& entries) {
    UnknownSpec u;
    const auto start = [&](const io::TomlEntry& e) {
      const auto* list = e.value.as<io::TomlValue::Array>();
      if (list == nullptr || list->empty())
        fail(e.line, "start", "is no list of values", "give values between low and high, or leave start out");
      for (const auto& value : *list) u.start.push_back(expression(value, e.line, "start"));
    };
    take(entries, {{"name", text_into(u.name)},
                   {"unit", text_into(u.unit)},
                   {"low", [&](const auto& e) { u.low = expression(e); }},
                   {"high", [&](const auto& e) { u.high = expression(e); }},
                   {"scale", [&](const auto& e) { u.log = is_log(e); }},
                   {"start", start}});
    const auto has = [&](const char* key) { return std::ranges::find(entries, key, &io::TomlEntry::key) != entries.end(); };
    if (u.name.empty() || !has("low") || !has("high"))
      fail(entries.empty() ? 0 : entries.front().line, "parameter", "lacks name, low or high", "");
    check_bounds(u);
    h_.unknowns.push_back(u);
  }
  void check_name(const Expression& e, const std::string& key) const {
    if (e.name.empty() || e.name == "f_measured" || is_place_number(e.name)) return;
    fail(e.line, key, fmt::format("'{}' is no number of a place{}", e.name, did_you_mean(e.name, place_numbers())),
         fmt::format("use a number, or one of {}", fmt::join(place_numbers(), ", ")));
  }
  /// Checks the bounds as far as the file shows them. Values that depend on a location are checked there.
  void check_bounds(const UnknownSpec& u) const {
    check_name(u.low, "low");
    check_name(u.high, "high");
    for (const Expression& e : u.start) {
      check_name(e, "start");
      const bool below = e.name == u.low.name && e.factor < u.low.factor,
                 above = e.name == u.high.name && e.factor > u.high.factor;
      const bool sign_known = e.name.empty() || !e.name.starts_with("x_");
      if (sign_known && (below || above))
        fail(e.line, u.name + ".start",
             fmt::format("{:g} is {} {:g}", e.factor, below ? "below low," : "above high,",
                         below ? u.low.factor : u.high.factor),
             "give a value between low and high");
    }
    const bool comparable = u.low.name == u.high.name && !u.low.name.starts_with("x_");  // a coordinate may be negative
    if (comparable && !(u.low.factor < u.high.factor))
      fail(u.low.line, u.name + ".low", fmt::format("{:g} is not below high, {:g}", u.low.factor, u.high.factor),
           "exchange them, or correct one");
    if (u.log && !(u.low.factor > 0.0) && !u.low.name.starts_with("x_"))
      fail(u.low.line, u.name + ".low", fmt::format("{:g} has no logarithm", u.low.factor),
           "give a value above 0, or scale = \"lin\"");
  }
  bool is_log(const io::TomlEntry& entry) const {
    const std::string scale = text(entry);
    if (scale != "log" && scale != "lin" && scale != "linear")
      fail(entry.line, "scale", "is '" + scale + "', expected \"lin\" or \"log\"", "log suits what may be off by a factor");
    return scale == "log";
  }
  void action(const Table& entries) {
    ActionSpec a;
    std::string kind;
    for (const auto& e : entries) {
      a.line = a.line == 0 ? e.line : a.line;
      if (e.key == "kind") {
        a.line = e.line;
        kind = text(e);
      } else if (e.key == "variable")
        a.text[e.key] = condition_key(text(e), e.line, "action.variable");
      else if (e.key == "direction") {
        a.text[e.key] = text(e);
        if (a.text[e.key] != "vertical")
          fail(e.line, "direction", fmt::format("is '{}', expected \"vertical\"", a.text[e.key]),
               "leave it out for all directions");
      } else if (e.key != "at")
        a.number[e.key] = expression(e);
    }
    a.primitive = primitive(kind, a.line);
    h_.actions.push_back(a);
  }
  Primitive primitive(const std::string& name, long line) const {
    if (const auto known = primitive_named(name)) return *known;
    auto names = each_of(primitives(), &PrimitiveKind::name);
    std::ranges::sort(names);
    fail(line, "action.kind", fmt::format("unknown primitive '{}'{}", name, did_you_mean(name, names)),
         fmt::format("use one of {}", fmt::join(names, ", ")));
  }
  void check_numbers(const ActionSpec& a) const {
    const PrimitiveKind& kind = kind_of(a.primitive);
    for (const std::string& name : kind.numbers)
      if (!a.number.contains(name))
        fail(a.line, "action." + name, fmt::format("is missing; {} takes {}", kind.name, fmt::join(kind.numbers, ", ")), "");
    for (const auto& number : a.number) {
      const std::string& name = number.first;
      const Expression& value = number.second;
      if (!contains(kind.numbers, name))
        fail(value.line, "action." + name, fmt::format("is no number of {}{}", kind.name, did_you_mean(name, kind.numbers)),
             "");
      if (value.name.starts_with('$') &&
          std::ranges::none_of(h_.unknowns, [&](const auto& u) { return "$" + u.name == value.name; }))
        fail(value.line, "action." + name, fmt::format("names '{}', which is no [[parameter]]", value.name), "");
      if (!value.name.starts_with('$')) check_name(value, "action." + name);
    }
  }
  /// The name. @throws InputError  if it is none of those that are known
  std::string known_name(const std::string& name, long line, const std::string& key, const char* problem,
                         const std::vector<std::string>& known) const {
    if (!contains(known, name))
      fail(line, key, fmt::format("'{}' {}{}", name, problem, did_you_mean(name, known)),
           fmt::format("use one of {}", fmt::join(known, ", ")));
    return name;
  }
  /// One of the keys of a condition. @param key  of the catalogue that names it
  std::string condition_key(const std::string& name, long line, const std::string& key) const {
    return known_name(name, line, key, "is no key of a condition", condition_keys());
  }
  std::string demand(const io::TomlEntry& entry) const {
    const auto& known = condition_demands();
    const std::string asked = text(entry);
    if (!contains(known, asked))
      fail(entry.line, "needs.conditions." + entry.key, fmt::format("is '{}'{}", asked, did_you_mean(asked, known)),
           fmt::format("use one of {}", fmt::join(known, ", ")));
    return asked;
  }
  int count(const io::TomlEntry& entry) const {
    constexpr long most = 1000;  // different values of a condition; no measurement has more
    const auto* whole = entry.value.as<long>();
    if (whole == nullptr || *whole < 1 || *whole > most)
      fail(entry.line, "needs.distinct." + entry.key,
           fmt::format("is {}, expected a whole number from 1 to {}", io::shown(entry.value), most),
           "say how many different values the rows must have");
    return static_cast<int>(*whole);
  }
  void needs(const Table& entries) {
    const auto conditions = [&](const auto& e) {
      for (const auto& c : table(e)) h_.needs.conditions[condition_key(c.key, c.line, "needs.conditions")] = demand(c);
    };
    const auto distinct = [&](const auto& e) {
      for (const auto& c : table(e)) h_.needs.distinct[condition_key(c.key, c.line, "needs.distinct")] = count(c);
    };
    const auto rows = [&](const io::TomlEntry& e) {
      const auto* list = e.value.as<io::TomlValue::Array>();
      if (list == nullptr) fail(e.line, "rows", "is no list", "");
      for (const auto& value : *list) {
        const auto& known = row_type_names();
        const std::string type = value.as<std::string>() ? *value.as<std::string>() : "";
        if (!contains(known, type))
          fail(e.line, "needs.rows", fmt::format("'{}' is no type of row{}", type, did_you_mean(type, known)), "");
        h_.needs.rows.push_back(type);
      }
    };
    take(entries, {{"conditions", conditions}, {"distinct", distinct}, {"rows", rows}});
  }
  void report(const Table& entries) { take(entries, {{"sentence", text_into(h_.sentence)}, {"remedy", text_into(h_.remedy)}}); }

  std::filesystem::path file_;
  Hypothesis h_;
};

}  // namespace

std::vector<Hypothesis> read_catalogue(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder))
    throw InputError({folder.string(), 0, ""}, "is no folder, expected the catalogue of hypotheses", "give --catalogue DIR");
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  if (files.empty()) throw InputError({folder.string(), 0, ""}, "holds no *.toml, expected one for each cause", "");
  std::sort(files.begin(), files.end());
  std::vector<Hypothesis> catalogue;
  std::set<std::string> ids;
  for (const auto& file : files) {
    catalogue.push_back(Reader(file).read());
    if (!ids.insert(catalogue.back().id).second)
      throw InputError({file.string(), 0, "id"}, fmt::format("'{}' is the id of another file too", catalogue.back().id),
                       "give each its own");
  }
  return catalogue;
}

}  // namespace twindeck::diagnosis
