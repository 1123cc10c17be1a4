#pragma once

#include <algorithm>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace twindeck {
struct Place;
}

namespace twindeck::io {

/// Closed interval that a number must lie in.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool open_lower = false;  ///< true: the lower end itself is not allowed (a modulus is > 0)
};
[[nodiscard]] inline Range positive() { return {0.0, std::numeric_limits<double>::infinity(), true}; }
[[nodiscard]] inline Range non_negative() { return {0.0, std::numeric_limits<double>::infinity(), false}; }

// Limits of values in a configuration. A larger value is a typing or unit error (milliseconds for seconds) that would fill the
// memory or run without end.
constexpr double longest_record_s = 86400.0;  ///< [s] a day: ten times the longest ambient record that is usual
constexpr double highest_rate_Hz = 1e4;       ///< [Hz] hundred times what loggers of structures sample at
constexpr double lowest_rate_Hz =
    1e-3;  ///< [Hz] about one sample in a quarter of an hour, far slower than any structure vibrates
constexpr double highest_wind_m_s = 200.0;  ///< [m/s] the fastest gust measured at the ground was 113 m/s (WMO, 1996)

/// The only description of a configuration struct. Each key is bound to a member, with unit, range, default (the member's value
/// when it is bound) and a sentence. TOML files, `--set`, `--print-config`, `--describe` and the reference page all use it.
///
///     UpdatingConfig c;
///     FieldTable t;
///     t.number("trust_radius", c.trust_radius, "", positive(), "initial trust radius of the dogleg, in normalised
///     parameters"); t.number("added_mass", c.added_mass_kg, "kg", non_negative(), "...");   // TOML: 120.0 or "0.12 t"
///     t.load("workflows/ponte_del_mare/s6_updating.toml");
///
/// Numbers may be given in TOML as a number in the SI unit of the field or as a string with unit ("210 GPa").
/// Keys may be dotted ("solver.max_iterations" is [solver] max_iterations).
class FieldTable {
 public:
  FieldTable();
  FieldTable& number(const std::string& key, double& target, const std::string& unit, Range range, const std::string& meaning,
                     bool required = false);
  /// @tparam Whole  int, long or std::uint64_t; the range must lie in it
  template <typename Whole>
  FieldTable& integer(const std::string& key, Whole& target, Range range, const std::string& meaning, bool required = false);
  FieldTable& boolean(const std::string& key, bool& target, const std::string& meaning);
  FieldTable& text(const std::string& key, std::string& target, const std::string& meaning, bool required = false);
  /// A name that becomes part of a path below the step's folder (io/path_name.hpp). @param what  "condition", for the message
  FieldTable& path_name(const std::string& key, std::string& target, const std::string& what, const std::string& meaning,
                        bool required = false);
  /// A text that must be one of `allowed`.
  FieldTable& choice(const std::string& key, std::string& target, const std::vector<std::string>& allowed,
                     const std::string& meaning);
  /// A value of an enumeration. @param words  of its values, in their order
  template <typename Enum>
  FieldTable& choice(const std::string& key, Enum& target, const std::vector<std::string>& words, const std::string& meaning) {
    return choice(
        key,
        [&target, words](const std::string& word) {
          target = static_cast<Enum>(std::ranges::find(words, word) - words.begin());
        },
        [&target, words] { return words.at(static_cast<std::size_t>(target)); }, words, meaning);
  }
  FieldTable& numbers(const std::string& key, std::vector<double>& target, const std::string& unit, Range range,
                      const std::string& meaning);
  FieldTable& texts(const std::string& key, std::vector<std::string>& target, const std::string& meaning);
  /// An array of texts, each of which must be one of `allowed`.
  FieldTable& choices(const std::string& key, std::vector<std::string>& target, const std::vector<std::string>& allowed,
                      const std::string& meaning);
  /// `[[key]]` array of tables: for each table, `add` appends an element to the caller's list and returns the FieldTable
  /// bound to that element. `describe` calls `add` once for the keys of an element, so it is for programs that end after it.
  /// @param named_by  key of an element that no two elements may have the same value of; "" for none
  FieldTable& tables(const std::string& key, std::function<FieldTable()> add, const std::string& meaning,
                     const std::string& named_by = "");

  /// A key of an earlier version. `load` and `set` refuse it, and it is listed nowhere.
  /// @param problem  what has become of it @param mend  what to do instead
  FieldTable& retired(const std::string& key, const std::string& problem, const std::string& mend);

  /// Result of a broken rule between keys: the key at fault, what is wrong with it, how to correct it.
  struct Broken {
    std::string key, problem, mend;
  };
  /// A rule between several keys. `require` checks it after all keys are read. @param broken  returns nothing if the rule holds
  FieldTable& rule(std::function<std::optional<Broken>()> broken);

  /// Reads a TOML file into the bound members.
  /// @throws InputError for an unknown key (naming the nearest known one), a wrong type or unit, a value out of range,
  ///         a required key that is missing, two elements of one name; each with file, line, key, value and what is allowed.
  void load(const std::filesystem::path& file);
  /// Applies one `key=value` of the command line; the value is TOML (a bare word is taken as text).
  void set(const std::string& key_equals_value);
  /// Call it after the last `load` and `set`. @throws InputError  if a required key is missing, or a rule between keys is
  /// broken.
  void require() const;
  /// Where a key was given last: file and line, or "--set"; an empty file if it was not given. `key` may also be an element
  /// ("pairs[2]"), a key of an array of tables ("record.point"), or the last part of a dotted key ("maximum_order" of
  /// "decay.maximum_order").
  /// @return  nothing if the key is unknown
  [[nodiscard]] std::optional<Place> place_of(const std::string& key) const;
  /// The resolved configuration as TOML, in SI units. `load` reads it back to the same values.
  [[nodiscard]] std::string print() const;
  /// Meaning, unit, range and default of one key, or of all.
  [[nodiscard]] std::string describe(const std::string& key = "") const;

  struct Field;

 private:
  friend struct FieldAccess;
  FieldTable& choice(const std::string& key, std::function<void(const std::string&)> read, std::function<std::string()> write,
                     const std::vector<std::string>& allowed, const std::string& meaning);
  [[nodiscard]] std::vector<std::string> lines(const std::string& above = "") const;

  std::vector<std::shared_ptr<Field>> fields_;
  std::vector<Broken> retired_;
  std::vector<std::function<std::optional<Broken>()>> rules_;
};

}  // namespace twindeck::io
