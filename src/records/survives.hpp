#pragma once

#include <functional>

namespace twindeck::records {

/// Does work in a child process first, whose end costs nothing: for libraries that break down on damaged files.
/// @return whether the child came to the work's end: false after a crash, or after a minute. True where no process can be had.
///         What the work throws is no crash: the caller, who does it again, sees it.
[[nodiscard]] bool survives(const std::function<void()>& work);

}  // namespace twindeck::records
