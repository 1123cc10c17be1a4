#pragma once

#include <string>
#include <vector>

#include "core/reporter.hpp"

namespace twindeck::tests {

/// Keeps what a computation says and warns of.
struct HeardReporter : Reporter {
  mutable std::vector<std::string> said;
  std::vector<std::string> warned;
  void say(const std::string& line) const override { said.push_back(line); }
  void warn(const std::string& line) override { warned.push_back(line); }
};

}  // namespace twindeck::tests
