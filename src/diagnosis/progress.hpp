#pragma once

#include <functional>

namespace twindeck::diagnosis {

/// Is told what is being done and how much of it, never twice at a time.
using Progress = std::function<void(const char* what, int done, int of)>;

}  // namespace twindeck::diagnosis
