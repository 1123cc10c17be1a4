#pragma once

namespace twindeck::steps {

/// Has the C library keep what a step frees for its next allocation. By default it gives large blocks back to the system at once; a step
/// that works through many histories of some megabytes spends a third of its time on fresh pages. Does nothing where the C library
/// is not glibc.
void keep_freed_memory();

}  // namespace twindeck::steps
