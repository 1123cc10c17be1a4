#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace twindeck {

/// Position of a bad input: file, line (1-based, 0 = unknown) and key or column (empty = unknown).
struct Place {
  std::string file;
  long line = 0;
  std::string key;
};

/// Bad input, which the user can correct. `run_step` catches it, prints it on one line and returns exit code 2.
///
/// `what()` reads "file:line: key: problem; mend" without the unknown parts. It is always one line of valid UTF-8:
/// control characters are escaped and long texts are cut (core/printable.hpp).
class InputError : public std::runtime_error {
 public:
  /// @param place    position of the bad input
  /// @param problem  what was found and what was expected ("is -3 GPa, expected a value in ]0, 1e13]")
  /// @param mend     how to correct it ("give the modulus with its unit, for example \"210 GPa\"")
  InputError(Place place, const std::string& problem, const std::string& mend = "");

  [[nodiscard]] const Place& place() const { return place_; }

 private:
  Place place_;
};

/// Our own mistake: exit code 3. Raised by TWINDECK_ASSERT, never for bad input.
class InternalError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Whether a computation converged, with one line that says why not. Numerical functions return it; they do not throw.
struct Status {
  bool converged = true;
  std::string message;
};

/// The known name nearest to `name` by edit distance. "" if each is further than a third of its letters, case apart.
[[nodiscard]] std::string nearest_name(std::string_view name, std::span<const std::string> known);

/// " (did you mean 'x'?)" or "", to be appended to a message about an unknown name.
[[nodiscard]] std::string did_you_mean(std::string_view name, std::span<const std::string> known);

[[noreturn]] void assertion_failed(const char* condition, const char* file, int line);

}  // namespace twindeck

#define TWINDECK_ASSERT(condition) \
  ((condition) ? static_cast<void>(0) : ::twindeck::assertion_failed(#condition, __FILE__, __LINE__))
