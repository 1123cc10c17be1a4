#pragma once

#include <string>

namespace twindeck {

/// Takes what a computation says while it runs: lines for people, warnings, progress. A library prints nothing; who calls it
/// decides where the lines go. The steps print them (StepContext). This base takes them and does nothing.
class Reporter {
 public:
  Reporter() = default;
  Reporter(const Reporter&) = default;
  Reporter& operator=(const Reporter&) = default;
  virtual ~Reporter() = default;

  /// A line for people.
  virtual void say(const std::string& /*line*/) const {}
  /// A doubtful input that is used unchanged.
  virtual void warn(const std::string& /*line*/) {}
  /// @param what  is being done  @param done, total  in any unit
  virtual void progress(const std::string& /*what*/, double /*done*/, double /*total*/) const {}
};

}  // namespace twindeck
