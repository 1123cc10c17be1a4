#pragma once

#include <functional>

namespace twindeck::diagnosis {

/// Reports the present task and its progress. Calls never overlap.
using Progress = std::function<void(const char* what, int done, int of)>;

}  // namespace twindeck::diagnosis
